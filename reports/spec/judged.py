"""Values with the verdict that stands beside them."""

from __future__ import annotations

from collections.abc import Iterable

from reports.spec.blocks import Scalar, ScalarTable

YES, NO = "да", "НЕТ"


def judged(
    value_key: str,
    key: str,
    value: str,
    test: str,
    note: str,
    source: str = "проверка",
    words: tuple[str, str] = (YES, NO),
) -> tuple[Scalar, Scalar]:
    """A value and whether it passes; ``{value}`` in the test stands for it."""
    good, bad = words
    verdict = f'"{good}" if {test.format(value=value_key)} else "{bad}"'
    return (
        Scalar(value_key, value, source, note=note, of="check_value"),
        Scalar(key, verdict, note=note, of="check"),
    )


def allowed(
    id_: str, title: str, sheet: str, limit: str, lines: Iterable[tuple[str, str, str]]
) -> ScalarTable:
    """Key, formula and name of values that are held to an input, ``>= name`` or ``<= name``."""
    scalars = [
        scalar
        for key, value, note in lines
        for scalar in judged(f"value_{key}", f"allowed_{key}", value, f"{{value}} {limit}", note,
                             "сравнение с допускаемым")
    ]  # fmt: skip
    return ScalarTable(id_, title, sheet, tuple(scalars), verdicts=(YES, NO))
