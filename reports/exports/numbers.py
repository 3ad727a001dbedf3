"""Numbers without documents: CSV and JSON of every table."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TextIO

from kshm.nomenclature.quantity import Quantity, quantity, ray_key
from kshm.results.reference import reference_tables
from kshm.results.solution import Solution
from reports.exports.department_chapters import OwnNumbers
from reports.inputs.fields import iter_fields
from reports.inputs.sections.input_file import InputFile

_BLANK = {ray_key(number) for number in range(1, 19)}  # a force that a ray does not count
_FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")


def export_tables(
    solution: Solution, extra: OwnNumbers | None = None
) -> dict[str, dict[str, list[float | str | None]]]:
    """All tables by id, columns by key; cells that the table leaves blank are None.

    ``extra`` are the numbers of own books.
    """
    tables: dict[str, dict[str, list[float | str | None]]] = {}
    by_file: dict[str, Mapping[str, Any]] = {
        **solution.columns, **solution.wear_sums, **reference_tables(),
    }  # fmt: skip
    for name, theirs in extra.tables.items() if extra else ():
        by_file[name] = {key: values for key, (_, values) in theirs.items()}
    for name, columns in by_file.items():
        tables[name] = {
            key: [_plain(value, blank_zero=key in _BLANK) for value in values]
            for key, values in columns.items()
        }
    return tables


def _plain(value: Any, *, blank_zero: bool = False) -> float | str | None:  # noqa: ANN401
    if isinstance(value, str):
        return value
    number = float(value) + 0.0  # no negative zero
    if not math.isfinite(number):
        raise ValueError(f"a result is not a number: {number}")
    return None if blank_zero and number == 0 else number


@dataclass(frozen=True, slots=True)
class CsvForm:
    """How a CSV is written: a second line of units, the signs of a Russian Excel."""

    units: bool = False
    excel: bool = False

    @property
    def encoding(self) -> str:
        """Excel knows UTF-8 by its mark alone."""
        return "utf-8-sig" if self.excel else "utf-8"

    def writer(self, stream: TextIO) -> Any:  # noqa: ANN401 - csv has no type for it
        """Return a writer of rows."""
        return csv.writer(stream, lineterminator="\n", delimiter=";" if self.excel else ",")

    def number(self, value: float) -> str:
        """Return a number in full precision."""
        return repr(value).replace(".", ",") if self.excel else repr(value)

    def heads(self, keys: Sequence[str], units: Callable[[str], str]) -> Iterator[list[str]]:
        """Lines before the numbers."""
        yield list(keys)
        if self.units:
            yield [units(key) for key in keys]

    def cell(self, value: float | str | None) -> str:
        """Return a cell: a whole number without its point."""
        if value is None or isinstance(value, str):
            return value or ""
        whole = value.is_integer() and abs(value) < 1e15
        return str(int(value)) if whole else self.number(value)


PLAIN = CsvForm()


def csv_text(columns: dict[str, list[float | str | None]], form: CsvForm = PLAIN) -> str:
    """One table as CSV: keys in the first line, full precision."""
    stream = io.StringIO()
    writer = form.writer(stream)
    writer.writerows(form.heads([*columns], lambda key: _describe(key)["unit"]))
    for row in zip(*columns.values(), strict=True):
        writer.writerow([form.cell(value) for value in row])
    return stream.getvalue()


def neutralised(text: str) -> str:
    """Text that a spreadsheet will not take for a formula."""
    return "'" + text if text.startswith(_FORMULA_STARTS) else text


def json_text(
    model: InputFile, solution: Solution, notes: Sequence[str] = (), extra: OwnNumbers | None = None
) -> str:
    """Engine, summary, tables as JSON with symbols, units, titles; notes where there are any."""
    engine = {field.name: field.value for field in iter_fields(model)}
    summary: dict[str, dict[str, Any]] = {
        key: {
            "value": value,
            **_described(quantity(key)),
        }
        for key, value in solution.scalars.items()
    }
    quantities: dict[tuple[str, str], Quantity] = {}
    for key, (measure, value) in extra.scalars.items() if extra else ():
        summary[key] = {"value": value, **_described(measure)}
    for name, theirs in extra.tables.items() if extra else ():
        quantities |= {(name, key): measure for key, (measure, _) in theirs.items()}
    tables = {
        name: {
            "columns": [_describe(key, quantities.get((name, key))) for key in columns],
            "rows": [list(row) for row in zip(*columns.values(), strict=True)],
        }
        for name, columns in export_tables(solution, extra).items()
    }
    data: dict[str, Any] = {"engine": engine, "summary": summary, "tables": tables}
    if notes:
        data["notes"] = list(notes)
    return json.dumps(data, ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def _describe(key: str, stated: Quantity | None = None) -> dict[str, str]:
    try:
        measure = stated or quantity(key)
    except KeyError:
        symbol = key.removeprefix("lambda_")
        return {"key": key, "symbol": symbol, "unit": "", "title": key}
    return {"key": key, **_described(measure)}


def _described(described: Quantity) -> dict[str, str]:
    return {"symbol": described.symbol, "unit": described.unit_label, "title": described.title}
