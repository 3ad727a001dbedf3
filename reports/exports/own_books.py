"""Whether own books hold together with an engine, and their numbers for other outputs."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from kshm.arrays import Array
from kshm.nomenclature.quantity import Quantity
from reports.formula.excel import compile_formula
from reports.formula.parse import parse
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_toml
from reports.inputs.own_books import declared, read_text
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import Block, Column, Grid, Model, nodes_in
from reports.model.book_text import (
    BookError,
    BookLine,
    Shelf,
    at_fragment,
    book_faults,
    cause_of,
    shelf_of,
)
from reports.model.contents import contents_of
from reports.model.context import MARK
from reports.model.evaluation import Evaluation
from reports.model.shape import Scope
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.resources import samples_dir
from reports.tables.contexts import book_part
from reports.tables.registry import build_model, kept_model
from reports.workbook.layout import Layout, RowReferences

MOST_FORMULA, MOST_NESTED, MOST_CELLS = 8000, 60, 300_000
_MOST_TOLD = 20
_STARTS_FORMULA = ("=", "+", "@")
_CELL_LIKE = re.compile(r"[A-Za-z]{1,3}\d{1,7}|[Rr]\d*[Cc]\d*|[RrCc]")


def refuse_faults(model: InputFile) -> None:
    """Refuse own books in which something is wrong, as far as this engine uses them.

    Raises:
        InputError: a line for each fault: book, line, column, what, how to mend it.
    """
    if not model.books:
        return
    shelf, scope = shelf_of(model.books), Scope(model)
    parts = [name for names in contents_of(shelf).parts.values() for name in names]
    faults: list[Problem] = []
    places: dict[str, BookLine] = {}
    for name in shelf.names:
        if name in parts:
            try:
                book_part(name, scope, places)
            except BookError as error:
                faults += error.problems
        elif not _serves_others(shelf, name):
            what = "нет строки place: книгу никто не читает"
            faults += BookError(shelf.called(name), 1, 1, what, "добавьте place after 700").problems
    if not faults:
        built = build_model(model)
        faults = [fault.problems[0] for fault in _faults(built, places, shelf)]
    if faults:
        raise InputError(list(dict.fromkeys(faults))[:_MOST_TOLD])


def _serves_others(shelf: Shelf, name: str) -> bool:
    return any(f'"{name}.book"' in text for _, text in shelf.texts())


def _faults(model: Model, places: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """Faults that only the whole model shows; each kind where the ones before are none."""
    for kind in (_repeated, _odd_words, _unknown_refs, book_faults, _unfit, _infinite):
        faulty = False
        for fault in kind(model, places, shelf):
            faulty = True
            yield fault
        if faulty:
            return


def _repeated(model: Model, places: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """Names that stand for two things, which no workbook tells apart."""
    seen: dict[str, str] = {field.name.casefold(): field.name for field in model.inputs}
    first = BookLine(f"{shelf.names[0]}.book", 1, "")
    ids: set[str] = set()
    for block in model.blocks:
        if block.id in ids:
            yield at_fragment(_line_of(block, places, first), shelf,
                              f"блок «{block.id}» есть дважды", "назовите его иначе",
                              block.id)  # fmt: skip
        ids.add(block.id)
        for key, _ in nodes_in(block):
            line = places.get(key)
            if key.casefold() in seen and line is not None:
                yield at_fragment(line, shelf, f"имя «{key}» занято («{seen[key.casefold()]}»)",
                                  "назовите величину иначе", key.rpartition(".")[2])  # fmt: skip
            elif line is not None and "." not in key and _CELL_LIKE.fullmatch(key):
                yield at_fragment(line, shelf, f"имя «{key}» похоже на адрес ячейки Excel",
                                  "добавьте знак подчёркивания", key)  # fmt: skip
            seen.setdefault(key.casefold(), key)
    charts = [chart.id for chart in model.charts]
    for name in sorted({name for name in charts if charts.count(name) > 1}):
        yield at_fragment(_mentioned(name, shelf) or first, shelf,
                          f"диаграмма «{name}» есть дважды", "назовите её иначе", name)  # fmt: skip


def _line_of(block: Block, places: Mapping[str, BookLine], usual: BookLine) -> BookLine:
    keys = (key for key, _ in nodes_in(block))
    return next((places[key] for key in keys if key in places), usual)


def _mentioned(name: str, shelf: Shelf) -> BookLine | None:
    """The first line of an own book that has a name."""
    word = re.compile(rf"\b{re.escape(name)}\b")
    for book in shelf.names:
        for number, line in enumerate(shelf.source(f"{book}.book")[0].splitlines(), 1):
            if word.search(line):
                return BookLine(f"{book}.book", number, line)
    return None


def _odd_words(model: Model, places: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """Texts that a spreadsheet takes for a formula or a page for a tag."""
    own = {key.partition(".")[0] for key in places}
    for block in model.blocks:
        nodes = dict(nodes_in(block))
        if not (block.id in own or nodes.keys() & places.keys()):
            continue
        texts = [block.title, block.note, *(node.source for node in nodes.values())]
        texts += [getattr(node, "note", "") for node in nodes.values()]
        texts += block.labels if isinstance(block, Grid) else ()
        yield from _odd(texts, shelf)
    for chart in model.charts:
        if _mentioned(chart.id, shelf):
            names = [series.name for series in chart.series]
            yield from _odd([chart.title, chart.caption, chart.x_title, chart.y_title, *names,
                             chart.group, chart.panel], shelf)  # fmt: skip
    for chapter in model.chapters:
        yield from _odd([chapter.title, *(line.text for line in chapter.lines)], shelf)


def _odd(texts: list[str], shelf: Shelf) -> Iterator[BookError]:
    for text in texts:
        tag = re.search(r"<\s*[A-Za-z/!]|&#|javascript:", text)
        if tag or text.startswith(_STARTS_FORMULA):
            line = _mentioned(text.split()[0], shelf) if re.match(r"\w", text) else None
            line = line or BookLine(f"{shelf.names[0]}.book", 1, "")
            yield at_fragment(line, shelf, f"текст «{one_line(text, 40)}» похож на формулу или код",
                              "оставьте обычные слова", tag[0] if tag else text)  # fmt: skip


def _unknown_refs(model: Model, _: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """What charts and chapters name and the model has not."""
    yield from _unknown_in_charts(model, shelf)
    yield from _unknown_in_chapters(model, shelf)


def _unknown_in_charts(model: Model, shelf: Shelf) -> Iterator[BookError]:
    known = model.nodes.keys() | model.grid_runs.keys()
    for chart in model.charts:
        line = _mentioned(chart.id, shelf)
        if line is None:
            continue
        names = {name for series in chart.series for name in (series.x, series.y)}
        for name in sorted({*names, *chart.levels} - known - model.fields.keys()):
            yield at_fragment(_mentioned(name, shelf) or line, shelf,
                              f"диаграмма «{chart.id}»: нет «{name}»",
                              "назовите столбец ТАБЛИЦА.КЛЮЧ", name)  # fmt: skip


def _unknown_in_chapters(model: Model, shelf: Shelf) -> Iterator[BookError]:
    blocks = {block.id for block in model.blocks}
    for chapter in model.chapters:
        for at in chapter.lines:
            line = BookLine(at.book, at.number, at.text)
            if at.kind == "show" and at.text not in blocks | model.charts_by_id.keys():
                yield at_fragment(line, shelf, f"показывать нечего: нет «{at.text}»",
                                  "назовите список, таблицу, сетку или диаграмму",
                                  at.text)  # fmt: skip
            if at.kind == "formula" and getattr(model.nodes.get(at.text), "expr", None) is None:
                yield at_fragment(line, shelf, f"формулы «{at.text}» нет",
                                  "назовите величину или ТАБЛИЦА.СТОЛБЕЦ", at.text)  # fmt: skip
            for word, key in MARK.findall(at.text):
                places_ok = key in blocks or key in model.charts_by_id
                values_ok = key in model.scalars or key in model.fields
                if not (places_ok if word in ("tab", "fig") else values_ok):
                    yield at_fragment(line, shelf, f"в тексте нет «{key}»",
                                      "назовите величину или исходное", key)  # fmt: skip


def _unfit(model: Model, places: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """Formulas that no cell takes, and books of too many cells."""
    cells = sum(len(table.rows) for table in model.tables.values() for column in table.columns
                if f"{table.id}.{column.key}" in places)  # fmt: skip
    if cells + len(places) > MOST_CELLS:
        first = next(iter(places.values()))
        yield at_fragment(first, shelf, f"ячеек больше {MOST_CELLS}", "уменьшите таблицы")
        return
    layout = Layout.of(model)
    for key, line in places.items():
        node, short = model.nodes.get(key), key.rpartition(".")[2]
        if node is None or node.expr is None:
            continue
        try:
            table = model.tables.get(key.partition(".")[0])
            formula = compile_formula(node.expr, RowReferences(layout, table))
        except Exception as error:
            yield at_fragment(line, shelf, f"формула «{short}» не для ячейки: {cause_of(error)}",
                              "проверьте, где имя столбца, а где число", short)  # fmt: skip
            continue
        if len(formula) > MOST_FORMULA or _nested(parse(node.expr)) > MOST_NESTED:
            yield at_fragment(line, shelf, f"формула «{short}» для ячейки Excel велика",
                              "разделите её на несколько величин", short)  # fmt: skip


def _nested(node: ast.AST) -> int:
    """Functions within functions."""
    inner = max((_nested(child) for child in ast.iter_child_nodes(node)), default=0)
    return inner + isinstance(node, ast.Call | ast.IfExp | ast.BoolOp)


def _infinite(model: Model, places: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """Values that are no numbers."""
    run = Evaluation(model)
    for key, line in places.items():
        node, short = model.nodes.get(key), key.rpartition(".")[2]
        if node is None:
            continue
        try:
            value = run.value(key)
            if isinstance(node, Column):
                fine = bool(np.isfinite(np.asarray(value, dtype=float)).all())
            else:
                fine = isinstance(value, str) or bool(np.isfinite(float(value)))
        except Exception as error:
            yield at_fragment(line, shelf, f"«{short}» не вычисляется: {cause_of(error)}",
                              "проверьте формулу и то, от чего она зависит", short)  # fmt: skip
            return
        if not fine:
            yield at_fragment(line, shelf, f"«{short}» — не число",
                              "проверьте деление на нуль, корни и логарифмы", short)  # fmt: skip
            return


# Engines of every kind that a book alone is tried on.
_TRIED = ("gots-diesel", "yamz-236", "two-stroke", "vw-1600")


def check_alone(path: Path) -> Iterator[str]:
    """Lines on a book alone: what it declares, and on which samples it was tried.

    Raises:
        InputError: what is wrong with it.
    """
    text = read_text(path.parent, path.name, "")
    raw = {"report": {"books": [path.name]}, "books": {path.name: text}}
    for sample in _TRIED:
        base = to_mapping(load_toml(samples_dir() / f"{sample}.toml").model)
        base["report"] |= raw["report"]
        refuse_faults(load_mapping({**base, "books": raw["books"]}, source=path.name).model)
    about = declared(text)
    inputs = len(about.model.model_fields) if about.model is not None else 0
    yield f"{path}: ошибок нет; исходных {inputs}, своих величин {len(about.quantities)}"
    yield f"Проверено на образцах: {', '.join(_TRIED)}"


@dataclass(frozen=True, slots=True)
class OwnNumbers:
    """Values of own books in units of the tables, with their quantities."""

    scalars: dict[str, tuple[Quantity, float | str]]
    tables: dict[str, dict[str, tuple[Quantity, Array]]]


def own_numbers(model: InputFile) -> OwnNumbers:
    """What the books of a department give for an engine; nothing without them."""
    if not model.books:
        return OwnNumbers({}, {})
    built = kept_model(model)
    run = Evaluation(built)
    scalars = {
        key: (node.quantity, run.value(key))
        for key, node in built.scalars.items()
        if key in built.own_nodes and not node.of.startswith("check")
    }
    tables = {
        table.id: {
            column.key: (column.quantity, np.asarray(run.value(f"{table.id}.{column.key}")))
            for column in table.columns
        }
        for table in built.tables.values()
        if any(f"{table.id}.{column.key}" in built.own_nodes for column in table.columns)
    }
    return OwnNumbers(scalars, tables)
