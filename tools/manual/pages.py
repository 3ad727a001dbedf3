"""Pages that are written from the code: inputs, sheets, validation; drawings beside them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pydantic_core import PydanticUndefined

from kshm.nomenclature.quantity import nomenclature
from kshm.results.named import NAMES
from reports.formula.excel import compile_formula
from reports.inputs.load import load_toml
from reports.inputs.meta import Meta, StrictModel, hints
from reports.inputs.registry import GAS_MODELS, SECTIONS, records
from reports.inputs.template import list_samples
from reports.inputs.units import number_text
from reports.model.blocks import Block, Grid, Model, ScalarTable, TableSpec
from reports.shared.files import write_text
from reports.shared.resources import samples_dir
from reports.shared.russian import capital
from reports.studies.validation_page import markdown
from reports.studies.validation_workbook import validate
from reports.tables.registry import build_model
from reports.workbook.chapters import contents_for, in_course
from reports.workbook.layout import FIRST_ROW, Layout, RowReferences, at_row
from tools.manual.drawings import write_drawings
from tools.manual.words import (
    FILE_KEYS,
    INPUT_HEAD,
    SAME_BLOCK,
    SECTION_NOTES,
    SHEET_BEYOND,
    SHEET_CHARTS,
    SHEET_FROM,
    SHEET_HEADS,
    SHEET_LIKE,
    SHEETS_HEAD,
)


def escaped(text: str) -> str:
    """Text that means itself inside a table cell."""
    for char in "\\|*_[]<>":
        if char != "\\" and char in text and "`" not in text:
            text = text.replace(char, "\\" + char)
    return text.replace("\n", " ")


def code(text: str) -> str:
    """Code inside a table cell: a bar would end the cell."""
    return "`" + text.replace("|", "\\|") + "`" if text else "—"


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


_HEADER = ("Ключ", "Что это", "Обозначение", "Единица", "Допустимо", "Если не задано")


def input_page() -> str:
    """Return the whole page."""
    parts = [INPUT_HEAD]
    for name, section in SECTIONS.items():
        parts.append(f"## [{name}] — {section.title.lower()}")
        parts += SECTION_NOTES.get(name, ())
        if name == "gas":
            parts += _gases()
        else:
            parts += _section(name, section.model)
    for name, title in (("regimes", "дальнейшие режимы"), ("variants", "варианты для группы")):
        parts.append(f"## {'[[regimes]]' if name == 'regimes' else '[variants]'} — {title}")
        parts += SECTION_NOTES[name]
    return "\n\n".join(parts) + "\n"


def _gases() -> Iterator[str]:
    for source, model in GAS_MODELS.items():
        yield f'### gas.source = "{source}"'
        yield from SECTION_NOTES.get(f"gas.{source}", ())
        yield from _section("gas", model)
    yield '### gas.source = "file"'
    yield from SECTION_NOTES["gas.file"]
    yield table(("Ключ", "Что это"), ((f"`{key}`", text) for key, text in FILE_KEYS))


def _section(path: str, model: type[StrictModel]) -> Iterator[str]:
    """Yield the keys of a section as one table, those of its lists of records as further ones."""
    inner = dict(records(model))
    yield table(_HEADER, _rows(model, skipped=inner))
    for key, item in inner.items():
        yield f"### [[{path}.{key}]]"
        yield from SECTION_NOTES.get(f"{path}.{key}", ())
        yield table(_HEADER, _rows(item))


def _rows(model: type[StrictModel], skipped: Iterable[str] = ()) -> Iterator[tuple[str, ...]]:
    for key, about in hints(model).items():
        if key in skipped:
            continue
        default = _default(model.model_fields[about.name])
        for meta in about.metas:
            listed = "{n}" in meta.title or "{n}" in meta.symbol
            mark = f"`{key}`" + (" (список)" if listed and not _of_record(model) else "")
            yield (
                mark,
                escaped(meta.title.replace("{n}", "N")),
                escaped(meta.symbol.replace("_{n}", "_N").replace("{n}", "N")) or "—",
                meta.unit.label or "—",
                escaped(_allowed(meta)),
                default,
            )


def _of_record(model: type[StrictModel]) -> bool:
    return all("{n}" in meta.title for hint in hints(model).values() for meta in hint.metas)


def _allowed(meta: Meta) -> str:
    if meta.choices is not None:
        pairs = meta.choices.items()
        return ", ".join(f"`{key}`" + (f" — {text}" if key != text else "") for key, text in pairs)
    if meta.minimum is None or meta.maximum is None:
        return "текст"
    return f"{number_text(meta.minimum)} … {number_text(meta.maximum)}"


def _default(info: Any) -> str:  # noqa: ANN401
    if info.is_required():
        return "**обязателен**"
    value = info.default
    if value is PydanticUndefined:  # a factory: only the year has one
        return "текущий год"
    if value is None or value in ("", ()):
        return "не задан"
    if isinstance(value, str):
        return f"`{value}`"
    values = value if isinstance(value, tuple) else (value,)
    return "; ".join(number_text(item) for item in values)


# The textbook's engine comes first; each further sample adds the sheets nobody had before.
FIRST_SAMPLE = "gots-diesel"
_LONGEST = 160  # characters of a formula; longer ones are cut, the workbook holds them whole
_NUMBERS = re.compile(r"\d+")
_ONE_OF_MANY = re.compile(r"(?<=\()\d+(?=\))|(?<=Колено )\d+")
_OF_REGIME = re.compile(r" р\d+$")
_FIRST_FORMULA_ROW = FIRST_ROW + 1


@dataclass
class _Seen:
    """Sheets and shapes of blocks that the page already describes."""

    sheets: set[str] = field(default_factory=set)
    shapes: dict[str, str] = field(default_factory=dict)


def sheets_page(samples: Sequence[str] = ()) -> str:
    """Return the whole page; ``samples`` in the order in which they are read."""
    seen = _Seen()
    parts = [SHEETS_HEAD]
    for name in samples or (FIRST_SAMPLE, *(n for n in list_samples() if n != FIRST_SAMPLE)):
        model = build_model(load_toml(samples_dir() / f"{name}.toml").model)
        parts += _sheets(model, name, seen)
    return "\n\n".join(parts) + "\n"


def _sheets(model: Model, sample: str, seen: _Seen) -> Iterator[str]:
    layout = Layout.of(model)
    for sheet in model.sheets:
        shape = _ONE_OF_MANY.sub("#", sheet)
        if shape in seen.sheets or _OF_REGIME.search(sheet):
            continue
        seen.sheets.add(shape)
        yield f"## {sheet}"
        if not in_course(sheet, contents_for(model)):
            yield SHEET_BEYOND
        if shape != sheet:
            yield SHEET_LIKE
        if sample != FIRST_SAMPLE:
            yield SHEET_FROM.format(sample=sample)
        for block in model.blocks:
            if block.sheet == sheet:
                yield from _block(block, layout, seen)
        titles = [chart.title for chart in model.charts if chart.sheet == sheet]
        if titles:
            yield SHEET_CHARTS + "; ".join(escaped(title) for title in titles) + "."


def _block(block: Block, layout: Layout, seen: _Seen) -> Iterator[str]:
    title = block.title
    if isinstance(block, TableSpec) and block.number:
        title = f"{block.number}. {title}"
    rows = list(_block_rows(block, layout))
    if not rows:
        return
    # Cylinders, throws and supports repeat their formulas: once is enough.
    shape = _NUMBERS.sub("#", repr([row[:2] for row in rows]))
    first = seen.shapes.setdefault(shape, title)
    yield f"### {escaped(title)}"
    if block.note:
        yield escaped(block.note)
    if first != title:
        yield SAME_BLOCK.format(title=escaped(first))
        return
    yield table(SHEET_HEADS, rows)


def _block_rows(block: Block, layout: Layout) -> Iterator[tuple[str, ...]]:
    if isinstance(block, TableSpec):
        refs = RowReferences(layout, block)
        for column in block.columns:
            if column.expr is None:
                at = _FIRST_FORMULA_ROW, layout.column_of(f"{block.id}.{column.key}")
                formula = layout.step_formula(block, *at)
            else:
                formula = at_row(compile_formula(column.expr, refs), _FIRST_FORMULA_ROW)
            quantity = column.quantity
            yield _row(quantity.title, quantity.symbol, quantity.unit_label, column.source, formula)
        return
    refs = RowReferences(layout, None)
    if isinstance(block, ScalarTable):
        for scalar in block.scalars:
            quantity = scalar.quantity
            title = scalar.note or quantity.title
            symbol = "" if scalar.of in ("check", "check_value") else quantity.symbol
            formula = compile_formula(scalar.expr, refs)
            yield _row(title, symbol, quantity.unit_label, scalar.source, formula)
    elif isinstance(block, Grid):
        for row in block.rows:
            cell = next(cell for cell in row.cells if cell is not None)
            quantity = row.quantity
            formula = compile_formula(cell.expr, refs)
            yield _row(quantity.title, quantity.symbol, quantity.unit_label, cell.source, formula)


def _row(title: str, symbol: str, unit: str, source: str, formula: str) -> tuple[str, ...]:
    if len(formula) > _LONGEST:
        formula = formula[:_LONGEST] + "…"
    return (
        escaped(capital(title)),
        escaped(symbol) or "—",
        escaped(unit) or "—",
        escaped(source) or "—",
        code(formula),
    )


_NOMENCLATURE = """# Номенклатура

> In English: every quantity of tables and results with its key, symbol, unit and Russian title, and
> the English name under which main results stand in the API; a `#` stands for a number of journals,
> pins or orders. Generated from the program.

Ключ — имя столбца в CSV, JSON, `kshm sweep --quantity` и в API; `#` в нём — номер шейки, формы или
порядка. Английское имя есть у главных результатов: `solution.loads.crankpin_max`
([расчёт из Python](api.md)).

"""


def nomenclature_page() -> str:
    """Quantities by key."""
    english = {key: f"{group}.{name}" for group, names in NAMES.items() for name, key in
               names.items()}  # fmt: skip
    rows = [
        (code(about.key), escaped(about.symbol) or "—", escaped(about.unit_label) or "—",
         escaped(about.title), code(english.get(about.key, "")))
        for about in nomenclature()
    ]  # fmt: skip
    head = ("Ключ", "Обозначение", "Единица", "Величина", "По-английски")
    return _NOMENCLATURE + table(head, rows) + "\n"


GENERATED: Mapping[str, Callable[[], str]] = {
    "input.md": input_page,
    "nomenclature.md": nomenclature_page,
    "sheets.md": sheets_page,
    "validation.md": lambda: markdown(validate()),
}


def write_pages(docs: Path) -> list[Path]:
    """Write every generated page and drawing anew; return those that changed."""
    changed = write_drawings(docs / "images")
    for name, text in pages().items():
        path = docs / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            write_text(path, text)
            changed.append(path)
    return changed


def pages() -> dict[str, str]:
    """Names and texts of the generated pages."""
    return {name: make() for name, make in GENERATED.items()}
