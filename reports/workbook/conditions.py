"""Conditions of an open book: pairs of inputs and results that must be in order."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from reports.formula.excel import number
from reports.inputs.checks.pairs import PAIRS, Pair, Term, is_of, terms_of
from reports.inputs.fields import Field, regime_suffix
from reports.model.blocks import Model
from reports.workbook.layout import Layout, column_range

_Fields = Mapping[str, Sequence[Field]]
_POINTS = Pair("gas.points", "gas.points", "Углы точек диаграммы возрастают")


@dataclass(frozen=True, slots=True)
class Condition:
    """A pair of this book: what its formula tests, and the cells that it is about."""

    pair: Pair
    title: str
    formula: str
    fields: tuple[Field, ...]
    holds: bool  # with the values that the book is built with


def conditions(
    model: Model, layout: Layout, scalars: Mapping[str, float | str]
) -> Iterator[Condition]:
    """Every pair both of whose sides stand in the book, those of further regimes as well."""
    main, further = _by_key(model.inputs)
    for number_, regime in ((1, main), *further.items()):
        suffix, whose = (regime_suffix(number_), f", режим {number_}") if number_ > 1 else ("", "")
        shared = {key: of_key for key, of_key in main.items() if not suffix or not _of_regime(key)}
        fields = {**shared, **regime}
        for pair in PAIRS:
            if not is_of(pair, model.input.engine.strokes, fields.get):
                continue
            less, more = (
                _side(side, end, fields, layout, scalars, suffix)
                for side, end in ((pair.less, "MAX"), (pair.more, "MIN"))
            )
            if less is None or more is None or not (less.own or more.own):
                continue
            cells = (*less.fields, *more.fields)
            # A further regime is held to its own gas; what rests on a speed rests on the first.
            if suffix and not any(field.path[2:3] == ("gas",) for field in cells):
                continue
            sign = "<" if pair.strict else "<="
            text, holds = f"{less.text}{sign}{more.text}", pair.holds(less.value, more.value)
            yield Condition(pair, pair.title + whose, text, cells, holds)
        if angles := tuple(item for item in regime.get(_POINTS.less, ()) if item.path[-1] == 0):
            title = _POINTS.title + whose
            yield Condition(_POINTS, title, _rising(angles, layout), angles, holds=True)


def _rising(fields: Sequence[Field], layout: Layout) -> str:
    """Return that each of several cells of a column is greater than the one above it."""
    first, last = (layout.cells[item.name] for item in (fields[0], fields[-1]))
    above = column_range(first.sheet, first.column, first.row, last.row - 1)
    below = column_range(first.sheet, first.column, first.row + 1, last.row)
    return f"SUMPRODUCT(1*({below}<={above}))=0"


def _by_key(inputs: Sequence[Field]) -> tuple[_Fields, dict[int, _Fields]]:
    """Fields by their keys without numbers: the main ones, and those of each further regime."""
    grouped: dict[int, dict[str, list[Field]]] = defaultdict(lambda: defaultdict(list))
    for item in inputs:
        path, regime = item.path, 1
        if path[0] == "regimes":
            regime, path = int(path[1]) + 2, path[2:]
            path = path if path[0] == "gas" else ("regime", *path)
        key = ".".join(part for part in path if isinstance(part, str))
        grouped[regime][key].append(item)
    return grouped.pop(1), {key: dict(fields) for key, fields in grouped.items()}


def _of_regime(key: str) -> bool:
    """Whether each regime has this key for itself."""
    return key.startswith(("regime.", "gas."))


@dataclass(frozen=True, slots=True)
class _Side:
    text: str
    value: float
    fields: tuple[Field, ...]
    own: bool


def _side(
    side: str,
    end: str,
    fields: _Fields,
    layout: Layout,
    scalars: Mapping[str, float | str],
    suffix: str,
) -> _Side | None:
    """Return the first term of a side that the book holds, with its cells."""
    for index, term in enumerate(terms_of(side)):
        name = term.key.removeprefix("=") + suffix
        if term.key[0] == "=" and name in layout.model.scalars:
            value = term.of(float(scalars[name]))
            return _Side(_scaled(layout.name_of(name), term), value, (), False)
        if cells := tuple(fields.get(term.key, ())):
            values = [float(item.value) for item in cells]
            value = term.of(max(values) if end == "MAX" else min(values))
            return _Side(_scaled(_cells(cells, end, layout), term), value, cells, not index)
    return None


def _cells(fields: Sequence[Field], end: str, layout: Layout) -> str:
    """One cell by its name, the end of several of a column."""
    if len(fields) == 1:
        return layout.name_of(fields[0].name)
    first, last = (layout.cells[item.name] for item in (fields[0], fields[-1]))
    return f"{end}({column_range(first.sheet, first.column, first.row, last.row)})"


def _scaled(text: str, term: Term) -> str:
    power = "" if term.power == 1 else f"^{number(term.power)}"
    return text + power if term.times == 1 else f"{number(term.times)}*{text}{power}"
