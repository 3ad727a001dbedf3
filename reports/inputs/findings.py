"""Valid fields that the checks read, findings they yield, and accepted oddities."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

from reports.inputs.fields import Path, iter_fields, key_text
from reports.inputs.messages import kind, likely_word, shown
from reports.inputs.meta import hints
from reports.inputs.registry import SECTIONS, records
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.report import CHECKS, AcceptedEntry
from reports.shared.errors import Problem
from reports.shared.font_coverage import REPLACEMENT, unprintable

Keys = frozenset[str]
Entry = TypeVar("Entry", bound=tuple[Any, ...])  # begins with a path
_REGIME = re.compile(r"(?P<check>\w+?)_R[0-9]+")
_MAX_LISTED = 5  # signs that are listed one by one
MAX_REGIMES = 4


@dataclass(frozen=True, slots=True)
class Finding:
    """Error, or warning, at a path of the file."""

    path: Path
    what: str
    hint: str = ""
    warning: bool = False


@dataclass(slots=True)
class ValidValues:
    """The valid fields of a file by section and TOML key, defaults filled in.

    `broken` holds the (section, key) that are wrong in themselves, `unsure`
    the sections with unknown keys; `counts` the list lengths as
    written, known even where an entry is wrong.
    """

    sections: dict[str, dict[str, Any]] = field(default_factory=dict)
    counts: dict[tuple[str, str], int] = field(default_factory=dict)
    broken: set[tuple[str, str]] = field(default_factory=set)
    unsure: set[str] = field(default_factory=set)

    def get(self, section: str, key: str) -> Any:  # noqa: ANN401 - as various as the fields
        """Return a valid value, or None."""
        return self.sections.get(section, {}).get(key)

    def sure(self, section: str, *keys: str) -> bool:
        """Tell whether the absence of these keys may be judged."""
        if section not in self.sections or section in self.unsure:
            return False
        return not any((section, key) in self.broken for key in keys)


def journal_sizes(values: ValidValues, part: str, size: str) -> Sequence[float]:
    """Return the sizes of all journals of a part, or the one that they share."""
    each = values.get("crankshaft", f"{part}_{size}s_mm")
    one = values.get("crankshaft", f"{part}_{size}_mm")
    return tuple(each) if each else () if one is None else (one,)


def radius_and_rod(values: ValidValues) -> tuple[float, float] | None:
    """Return (r, L) [mm] if the geometry fixes them."""
    radius = values.get("geometry", "crank_radius_mm")
    stroke = values.get("geometry", "stroke_mm")
    rod = values.get("geometry", "rod_length_mm")
    lam = values.get("geometry", "lambda")
    if radius is None and stroke is not None:
        radius = stroke / 2
    if radius is None and rod is not None and lam is not None:
        radius = lam * rod
    if rod is None and radius is not None and lam is not None:
        rod = radius / lam
    return None if radius is None or rod is None else (radius, rod)


def accepted_keys(entries: Iterable[AcceptedEntry]) -> Keys:
    """Return accepted checks and keys."""
    return frozenset(entry.what for entry in entries)


def in_lines(entries: Iterable[Entry], accepted: Keys) -> list[list[Entry]]:
    """Entries grouped by the lines that report them: accepted ones alone, the rest together."""
    groups, others = list[list[Entry]](), list[Entry]()
    for entry in entries:
        if key_text(entry[0]) in accepted:
            groups.append([entry])
        else:
            others.append(entry)
    return [others, *groups] if others else groups


def explained(
    warnings: Iterable[tuple[str, Problem]], entries: Iterable[AcceptedEntry]
) -> tuple[list[Problem], list[tuple[Problem, str]]]:
    """Warnings without and with a reason; an entry silences one line of its key."""
    reasons: dict[str, list[str]] = {}
    for entry in entries:
        reasons.setdefault(entry.what, []).append(entry.reason)
    odd, taken = list[Problem](), list[tuple[Problem, str]]()
    for key, problem in warnings:
        if reasons.get(key):
            taken.append((problem, reasons[key].pop(0)))
        else:
            odd.append(problem)
    return odd, taken


def check_accepted(values: ValidValues) -> Iterator[Finding]:
    """Yield accepted entries that name nothing or give no reason."""
    entries: Sequence[AcceptedEntry] = values.get("checks", "accepted") or ()
    for index, entry in enumerate(entries):
        path = ("checks", "accepted", index)
        # Own books have checks of theirs, which `check_names` knows once the books are read.
        if not values.get("report", "books") and (unknown := _unknown(entry.what, ())):
            yield Finding((*path, "what"), *unknown)
        if not entry.reason.strip():
            problem = "причина не названа"
            yield Finding((*path, "reason"), problem, "напишите, почему это верно")


def check_names(model: InputFile, names: Collection[str]) -> Iterator[Problem]:
    """Accepted entries that name no check, key or check of own books, whose names are ``names``."""
    entries = () if model.checks is None else model.checks.accepted
    for index, entry in enumerate(entries):
        if unknown := _unknown(entry.what, names):
            yield Problem(key_text(("checks", "accepted", index, "what")), *unknown)


def _unknown(name: str, names: Collection[str]) -> tuple[str, str] | None:
    """Return what is said of an accepted entry that names nothing; None of one that does."""
    if name in names or _known(name):
        return None
    likely = likely_word(name, (*CHECKS, *names, *_keys()))
    hint = f"возможно, {likely}" if likely else "проверки: " + ", ".join((*CHECKS, *names))
    return f"нет проверки или ключа {shown(name)}", hint


def _known(name: str) -> bool:
    regime = _REGIME.fullmatch(name)
    if (regime["check"] if regime else name) in CHECKS:
        return True
    plain = re.sub(r"\[[0-9]+\]", "", name).removeprefix("regimes.")
    return plain in _keys() or plain in SECTIONS or f"regime.{plain}" in _keys()


def _keys() -> set[str]:
    """Every key of the file, the numbers of lists left out."""
    keys = set()
    for section in SECTIONS.values():
        for model in section.models:
            keys |= {f"{section.name}.{key}" for key in hints(model)}
            for key, inner in records(model):
                keys |= {f"{section.name}.{key}.{name}" for name in hints(inner)}
    return keys


def check_signs(model: InputFile) -> Iterator[Finding]:
    """Yield a warning for every text with characters that the report's font lacks."""
    for text in iter_fields(model):
        signs = unprintable(text.value) if isinstance(text.value, str) else ()
        if signs:
            listed = ", ".join(f"{sign} (U+{ord(sign):04X})" for sign in signs[:_MAX_LISTED])
            more = f" и ещё {len(signs) - _MAX_LISTED}" if len(signs) > _MAX_LISTED else ""
            problem = f"в шрифте отчёта нет: {listed}{more}"
            hint = f"уберите или замените, иначе напечатается {REPLACEMENT}"
            yield Finding(text.path, problem, hint, warning=True)


def regime_data(raw: object) -> Iterator[Finding | tuple[int, dict[str, Any]]]:
    """Numbered entries of the list, or findings about it."""
    if not isinstance(raw, list | tuple):
        yield Finding(("regimes",), f"нужен список разделов, а задано: {kind(raw)}",
                      "запишите [[regimes]]")  # fmt: skip
        return
    if len(raw) > MAX_REGIMES:
        problem = f"режимов {len(raw)}, а допустимо не больше {MAX_REGIMES}"
        yield Finding(("regimes",), problem, "уберите лишние")
        return
    for index, entry in enumerate(raw):
        if not isinstance(entry, dict):
            problem = f"нужен раздел, а задано: {kind(entry)}"
            yield Finding(("regimes", index), problem, "запишите [[regimes]]")
        elif "gas" not in entry:
            problem = "у режима нет данных о газах"
            yield Finding(("regimes", index, "gas"), problem, "добавьте раздел [regimes.gas]")
        elif not isinstance(entry["gas"], dict):
            problem = f"нужен раздел, а задано: {kind(entry['gas'])}"
            yield Finding(("regimes", index, "gas"), problem, "добавьте раздел [regimes.gas]")
        elif entry["gas"].get("source") == "cycle":
            problem = "расчёт цикла есть только у основного режима"
            yield Finding(("regimes", index, "gas", "source"), problem, "задайте давления")
        else:
            yield index, entry
