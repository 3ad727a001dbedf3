"""Formulas of own books that are written right and mean nothing, each by its line."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Literal, get_args, get_origin

from jinja2 import nodes

from reports.exports.book_faults import Own, short_of
from reports.formula.parse import AGGREGATES, parse
from reports.inputs.department_chapters import sections_of
from reports.inputs.registry import SECTIONS
from reports.model.blocks import Model, TableSpec
from reports.model.chapter_source import BookLine, environment_of
from reports.model.evaluation import node_of
from reports.shared.errors import BookError, one_line

# Which arguments of a function are whole columns or runs; all others are values of one row.
_WHOLE: Mapping[str, Callable[[int, int], bool]] = {
    **dict.fromkeys((*AGGREGATES, "first_largest", "run_sum"), lambda at, of: True),
    **dict.fromkeys(("place", "rank"), lambda at, of: at == 1),
    "element": lambda at, of: at == 0,
    **dict.fromkeys(("fourier_cos", "fourier_sin", "wave_cos", "wave_sin"),
                    lambda at, of: at < of - 1),
}  # fmt: skip
_IN_PLACE_OF = {"max": "col_max", "min": "col_min", "total": "col_sum"}
_OF_COLUMNS = "col_max, col_min, col_mean, col_sum, col_last"


def misread(reading: Own) -> Iterator[BookError]:
    """Columns where one number is meant, and rows that do not lie side by side."""
    for key, expr, line in reading.formulas():
        table = reading.table_of(key)
        for name, function, whole in _read(parse(expr), "", whole=False):
            node = node_of(name, "" if table is None else table.id, reading.model)
            other = reading.model.tables.get(node.partition(".")[0]) if "." in node else None
            run = node in reading.model.grid_runs or node in reading.model.input_runs
            if whole and other is None and not run:
                yield reading.fault(line, f"{function} берёт столбец, а «{name}» — одно число",
                                "назовите столбец ТАБЛИЦА.КЛЮЧ", name)  # fmt: skip
            elif not whole and (run or (other is not None and table is None)):
                mend = _IN_PLACE_OF.get(function)
                usual = f"возьмите от него одно число: {_OF_COLUMNS}"
                yield reading.fault(line, f"«{name}» — столбец, а «{short_of(key)}» — одно число",
                                f"пишите {mend}({name})" if mend else usual, name)  # fmt: skip
            elif not whole and table is not None and other is not None and _apart(table, other):
                yield reading.fault(line, f"строки «{name}» ({_rows(other)}) — не строки таблицы "
                                f"«{table.id}» ({_rows(table)})",
                                "берите столбцы таблицы с теми же строками", name)  # fmt: skip


def _read(node: ast.expr, function: str, *, whole: bool) -> Iterator[tuple[str, str, bool]]:
    """Names of a formula, the innermost function around each and whether it takes columns."""
    match node:
        case ast.Name(id=name):
            if name != "pi":
                yield name, function, whole
        case ast.Attribute(value=ast.Name(id=table), attr=column):
            yield f"{table}.{column}", function, whole
        case ast.Call(func=ast.Name(id=name), args=args):
            takes = _WHOLE.get(name)
            for at, arg in enumerate(args):
                yield from _read(arg, name, whole=takes is not None and takes(at, len(args)))
        case _:
            for child in ast.iter_child_nodes(node):
                if isinstance(child, ast.expr):
                    yield from _read(child, function, whole=whole)


def _apart(table: TableSpec, other: TableSpec) -> bool:
    """Whether rows of two tables are not those of one angle."""
    if len(table.rows) != len(other.rows):
        return True
    alike = table.columns[0].key == other.columns[0].key
    return alike and table.rows != other.rows


def _rows(table: TableSpec) -> str:
    return f"{table.rows[0]:g}…{table.rows[-1]:g}, строк {len(table.rows)}" if table.rows else "0"


def compared(reading: Own) -> Iterator[BookError]:
    """Choices compared with what they never are, in formulas and in statements."""
    for key, expr, line in reading.formulas():
        table = reading.table_of(key)
        for node in ast.walk(parse(expr)):
            if not isinstance(node, ast.Compare):
                continue
            sides = (node.left, node.comparators[0])
            for text, other in (sides, sides[::-1]):
                if not (isinstance(text, ast.Constant) and isinstance(text.value, str)):
                    continue
                name = ast.unparse(other)
                of = node_of(name, "" if table is None else table.id, reading.model)
                problem, mend = _never(reading.model, name, of, text.value)
                if not problem and not isinstance(node.ops[0], ast.Eq | ast.NotEq):
                    problem, mend = "тексты не больше и не меньше", "сравнивайте == и !="
                if problem:
                    yield reading.fault(line, problem, mend, f'"{text.value}"')
    yield from _in_statements(reading)


def _never(model: Model, name: str, node: str, text: str) -> tuple[str, str]:
    """Why something never is a text, and how to mend it; nothing where it may be."""
    field = model.fields.get(node)
    if field is not None and isinstance(field.value, str):
        if field.choices is None or text in field.choices.values():
            return "", ""
        labels = list(field.choices.values())
        if text in field.choices:
            return (
                f"«{text}» — слово выбора, а в формуле — подпись",
                f"пишите «{field.choices[text]}»",
            )
        return (f"среди подписей «{name}» нет «{one_line(text, 40)}»",
                "есть: " + ", ".join(f"«{label}»" for label in labels))  # fmt: skip
    scalar = model.scalars.get(node)
    texts = set() if scalar is None else _texts(parse(scalar.expr))
    if text in texts:
        return "", ""
    if texts:
        return f"«{name}» не бывает «{one_line(text, 40)}»", "есть: " + ", ".join(sorted(texts))
    return f"«{one_line(name, 40)}» — число, а сравнено с текстом", "сравнивайте с числом"


def _texts(node: ast.expr) -> set[str]:
    """Texts that an expression may give."""
    match node:
        case ast.Constant(value=str() as text):
            return {text}
        case ast.IfExp(body=body, orelse=orelse):
            return _texts(body) | _texts(orelse)
    return set()


def _in_statements(reading: Own) -> Iterator[BookError]:
    """Comparisons of ``value.SECTION.KEY`` with a word that the choice has not."""
    environment = environment_of(reading.shelf)
    for stem, (_, text) in zip(reading.shelf.names, reading.shelf.own, strict=True):
        tree: nodes.Template = environment.parse(text)
        for node in tree.find_all(nodes.Compare):
            path, words = _path(node.expr), _words(reading, _path(node.expr))
            for each in node.ops if words else ():
                word = each.expr
                if not (isinstance(word, nodes.Const) and isinstance(word.value, str)):
                    continue
                if word.value not in words:
                    line = BookLine(f"{stem}.book", node.lineno, "")
                    problem = f"{'.'.join(path)} не бывает «{one_line(word.value, 40)}»"
                    mend = "в условии — слово выбора: " + ", ".join(words)
                    yield reading.fault(line, problem, mend, word.value)


def _path(node: nodes.Node) -> tuple[str, ...]:
    """``value.own.fan.drive`` as its parts; nothing for anything else."""
    parts: list[str] = []
    while isinstance(node, nodes.Getattr):
        parts.insert(0, node.attr)
        node = node.node
    return (node.name, *parts) if isinstance(node, nodes.Name) else ()


def _words(reading: Own, path: tuple[str, ...]) -> list[str]:
    """Words of the choice at a path of values."""
    match path:
        case ("value", "own", section, key):
            section_model = sections_of(reading.model.input.books).get(section)
            models: tuple[Any, ...] = () if section_model is None else (section_model.model,)
        case ("value", section, key) if section in SECTIONS:
            models = SECTIONS[section].models
        case _:
            return []
    fields = [model.model_fields[key] for model in models if key in model.model_fields]
    kinds = [each.annotation for each in fields if get_origin(each.annotation) is Literal]
    return [str(word) for kind in kinds for word in get_args(kind)]
