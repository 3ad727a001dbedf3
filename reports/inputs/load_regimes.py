"""Reading and checking [[regimes]]: each regime like a file of its own with the same engine."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from reports.inputs import messages
from reports.inputs.checks.gas import check_gas
from reports.inputs.checks.pairs import check_pairs
from reports.inputs.findings import Finding, Path, Values
from reports.inputs.meta import Strictly
from reports.inputs.sections.gas import CycleGasSection
from reports.inputs.sections.input_file import RegimeSection, RegimeValues

MOST_REGIMES = 4


def inside(index: int, path: Path) -> Path:
    """Path in the file of a path within a regime: its own keys stand beside its gas."""
    if path and path[0] == "regime":
        return ("regimes", index, *path[1:])
    return ("regimes", index, *path)


def regime_data(raw: object) -> Iterator[Finding | tuple[int, dict[str, Any]]]:
    """The entries of the list with their numbers, or what is wrong about it."""
    if not isinstance(raw, list | tuple):
        yield Finding(("regimes",), f"нужен список разделов, а задано: {messages.kind(raw)}",
                      "запишите [[regimes]]")  # fmt: skip
        return
    if len(raw) > MOST_REGIMES:
        what = f"режимов {len(raw)}, а допустимо не больше {MOST_REGIMES}"
        yield Finding(("regimes",), what, "уберите лишние")
        return
    for index, entry in enumerate(raw):
        if not isinstance(entry, dict):
            what = f"нужен раздел, а задано: {messages.kind(entry)}"
            yield Finding(("regimes", index), what, "запишите [[regimes]]")
        elif "gas" not in entry:
            what = "у режима нет данных о газах"
            yield Finding(("regimes", index, "gas"), what, "добавьте раздел [regimes.gas]")
        elif not isinstance(entry["gas"], dict):
            what = f"нужен раздел, а задано: {messages.kind(entry['gas'])}"
            yield Finding(("regimes", index, "gas"), what, "добавьте раздел [regimes.gas]")
        elif entry["gas"].get("source") == "cycle":
            what = "расчёт цикла есть только у основного режима"
            yield Finding(("regimes", index, "gas", "source"), what, "задайте давления")
        else:
            yield index, entry


def checked(values: Values, own: Values) -> Iterator[Finding]:
    """Checks of a regime's gas with the engine of the file."""
    both = replace(own, sections={**values.sections, **own.sections})
    both.sections.pop("cycle", None)
    yield from check_gas(both)
    yield from (found for found in check_pairs(both) if found.path[0] in own.sections)


def joined(regime: Strictly, gas: Strictly) -> RegimeSection | None:
    """The regime from its two checked parts."""
    if not isinstance(regime, RegimeValues) or isinstance(gas, CycleGasSection):
        return None
    return RegimeSection.model_construct(**{**dict(regime), "gas": gas})
