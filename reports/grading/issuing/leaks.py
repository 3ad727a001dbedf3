"""The work-book must not hold its answers: every number in every part of it is looked at.

An answer may lie in a book in disguise: moved by some rows, in another unit, with the
other sign, sorted, in the cache of a chart, in a remark.  Digits alone are compared, so
none of this hides it.  How many are alike by chance is reckoned, not guessed.
"""

from __future__ import annotations

import ast
import io
import re
import zipfile
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import sqrt

import numpy as np
from lxml import etree

from reports.formula.parse import SCALE_FUNCTIONS, parse
from reports.grading.issuing.assignment import Assignment, Item
from reports.model.evaluation import Evaluation, node_of
from reports.shared.errors import InputError, Problem
from reports.workbook.caches import sheet_parts

_DIGITS = 4  # that are compared within one place: as few as a table prints
_EXACT = 11  # that are compared of single values
_NOUGHT = 1e-12
_FEWEST = 4  # answers of a column in one place that are no chance
_PICKS = {"abs", "element", "following", "previous", "col_max", "col_min", "col_last"}
_REPEATS = SCALE_FUNCTIONS | _PICKS
_TURNS = np.radians(np.arange(1, 721))  # angles in radians: ω at 3000 rpm has the digits of π
_NUMBER = re.compile(r"(?<![\w.])[-+\u2212]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?(?![\w])")


@dataclass(frozen=True, slots=True)
class Leak:
    """An asked item and where its values stand."""

    item: str
    place: str
    count: int


def check_for_leaks(book: bytes, assignment: Assignment, source: str) -> None:
    """Refuse a work-book that holds answers.

    Raises:
        InputError: the items and the places where their values stand.
    """
    leaks = leaks_of(book, assignment)
    if leaks:
        what = "; ".join(f"{leak.item} — {leak.place}" for leak in leaks[:6])
        more = f" и ещё {len(leaks) - 6}" if len(leaks) > 6 else ""
        items = (leak.item.partition(" ")[0] for leak in leaks)
        names = ", ".join(f'"{item}"' for item in dict.fromkeys(items))
        hint = (
            "уберите эти таблицы из work.given или из work.fill рубрики либо выдайте ответы "
            f"числами: work.without = [{names}]"
        )
        raise InputError(Problem(source, f"выданная книга содержала бы ответы: {what}{more}", hint))


def leaks_of(book: bytes, assignment: Assignment) -> list[Leak]:
    """Everything in a work-book that gives an asked value away.

    Columns that only serve others may repeat a given one: they are copied by right.
    """
    places = dict(_places(book))
    run = Evaluation(assignment.model)
    columns: dict[str, set[str]] = {}
    scalars: dict[str, float] = {}
    for item in assignment.items:
        values = _asked(item, run, assignment)
        if item.is_column and not item.helper:
            columns[item.id] = _digits(values.tolist(), _DIGITS)
        elif not item.is_column and values.size:
            scalars |= {f"{item.id} {label}".strip(): float(v)
                        for label, v in zip(item.labels, values, strict=False)}  # fmt: skip
    return [*_of_columns(columns, places, _known(assignment)),
            *_of_scalars(scalars, places, _known(assignment))]  # fmt: skip


def _asked(item: Item, run: Evaluation, assignment: Assignment) -> np.ndarray:
    """Values of an item that are an answer: no copies of what is given anyway."""
    nodes = [node for node in item.nodes if not _is_given_anyway(node, assignment)]
    parts = [run.value(node) for node in nodes]
    parts = [np.ravel(np.asarray(v, dtype=float)) for v in parts if not isinstance(v, str)]
    return np.concatenate(parts) if parts else np.array([])


def _is_given_anyway(node: str, assignment: Assignment) -> bool:
    """Whether a value by its formula repeats or picks out an input or a given number."""
    graph, seen = assignment.graph, set()
    while node not in seen:
        seen.add(node)
        tree = parse(graph.expression(node) or "0")
        while isinstance(tree, (ast.UnaryOp, ast.Call)):
            if isinstance(tree, ast.Call) and ast.unparse(tree.func) not in _REPEATS:
                return False
            tree = tree.operand if isinstance(tree, ast.UnaryOp) else tree.args[0]
        if not isinstance(tree, (ast.Name, ast.Attribute)):
            return False
        node = node_of(ast.unparse(tree), node.partition(".")[0], assignment.model)
        if graph.expression(node) is None or node in assignment.given_nodes:
            return True
    return False


def _digits(values: Iterable[float], count: int) -> set[str]:
    """The first digits of numbers without sign and point; short and round ones tell nothing.

    Nor does what is left of the cosine of 90°.
    """
    least = min(count, 4) - 1
    texts = {f"{abs(v):.{count - 1}e}"[: count + 1] for v in values if abs(v) > _NOUGHT}
    found = {text.replace(".", "") for text in texts}
    return {text for text in found if text.isdigit() and len(text.rstrip("0")) >= least}


def _of_columns(
    asked: Mapping[str, set[str]], places: Mapping[str, list[float]], known: set[str]
) -> list[Leak]:
    owners: dict[str, list[str]] = {}
    for item, digits in asked.items():
        for text in digits - known:
            owners.setdefault(text, []).append(item)
    found = []
    for place, numbers in places.items():
        given = _digits(numbers, _DIGITS)
        hits = Counter(item for text in given for item in owners.get(text, ()))
        for item, count in hits.items():
            # So many of the asked would be among so many numbers by chance; a column is
            # alike where most of it is, or far more than chance allows.
            size = len(asked[item])
            chance = size * len(given) / 9000
            if count >= max(_FEWEST, chance + 5 * sqrt(chance) + 2, 0.5 * size):
                found.append(Leak(item, place, count))
    return sorted(found, key=lambda leak: (leak.item, leak.place))


def _of_scalars(
    asked: Mapping[str, float], places: Mapping[str, list[float]], known: set[str]
) -> list[Leak]:
    exact = {name: _digits([value], _EXACT) for name, value in asked.items()}
    shown = {name: _digits([value], 5) for name, value in asked.items()}
    found = []
    angles = _digits(_TURNS.tolist(), _EXACT)
    for place, numbers in places.items():
        given, short = _digits(numbers, _EXACT) - angles - known, _digits(numbers, 5)
        hits = [n for n, d in exact.items() if d & given and not _short(asked[n])]
        few = [n for n, d in shown.items() if d & short - known and not _is_round(d)]
        chance = len(asked) * len(short) / 90_000
        alike = set().union(*(shown[n] for n in few)) if few else set()
        if not hits and len(alike) >= max(3, chance + 5 * sqrt(chance) + 2):
            hits = few
        found += [Leak(name, place, 1) for name in hits]
    return found


def _is_round(digits: set[str]) -> bool:
    """Whether digits are those that the number of a row may have: 1.06, and row 106."""
    return all(len(text.rstrip("0")) < _DIGITS for text in digits)


def _short(value: float) -> bool:
    """Whether a number has so few digits that anyone may have it."""
    return len(f"{value:.10e}".split("e")[0].replace(".", "").strip("-").rstrip("0")) < 6


def _known(assignment: Assignment) -> set[str]:
    """Digits of the input data, the angles and their sines: they stand in the book by right.

    Of all whole degrees: a circle round a bearing has its sines closer than the rays of wear.
    """
    numbers = [float(f.value) for f in assignment.model.inputs if isinstance(f.value, (int, float))]
    for table in assignment.model.tables.values():
        numbers += table.rows
    numbers += np.sin(_TURNS).tolist()
    return _digits(numbers, _DIGITS) | _digits(numbers, 5) | _digits(numbers, _EXACT)


# --- every number of a package -----------------------------------------------------------


def _places(book: bytes) -> Iterator[tuple[str, list[float]]]:
    """Where numbers stand → the numbers: columns and rows of sheets, series, other texts."""
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        titles = {part: title for title, part in sheet_parts(archive).items()}
        for name in archive.namelist():
            data = archive.read(name)
            if name in titles:
                yield from _of_sheet(titles[name], data)
            elif name.startswith("xl/charts/"):
                yield from _of_chart(name, data)
            elif name.endswith((".xml", ".rels", ".vml")) and name != "xl/styles.xml":
                yield name, _of_text(data)
            elif not name.endswith((".xml", ".rels", ".vml")):
                yield name, _numbers(data.decode("utf-8", errors="ignore"))


def _of_sheet(title: str, data: bytes) -> Iterator[tuple[str, list[float]]]:
    root = etree.fromstring(data)
    columns: dict[str, list[float]] = {}
    rows: dict[str, list[float]] = {}
    for cell in root.iter("{*}c"):
        where = cell.get("r", "")
        letters = where.rstrip("0123456789")
        numbers = []
        for part in cell:
            tag = str(part.tag).rpartition("}")[2]
            text = "".join(part.itertext())
            if tag == "f":  # numbers typed into a formula
                numbers += [v for v in _numbers(text) if not float(v).is_integer()]
            elif cell.get("t") != "s":
                numbers += _numbers(text)
        if numbers:
            columns.setdefault(f"{title}!{letters}", []).extend(numbers)
            rows.setdefault(f"{title}!{where[len(letters) :]}", []).extend(numbers)
    yield from columns.items()
    yield from rows.items()


def _of_chart(name: str, data: bytes) -> Iterator[tuple[str, list[float]]]:
    root = etree.fromstring(data)
    for number, series in enumerate(root.iter("{*}ser"), 1):
        values = [v for item in series.iter("{*}v") for v in _numbers(item.text or "")]
        yield f"{name}, ряд {number}", values


def _of_text(data: bytes) -> list[float]:
    try:
        root = etree.fromstring(data)
    except etree.XMLSyntaxError:
        return _numbers(data.decode("utf-8", errors="ignore"))
    texts = [text for text in root.itertext() if text.strip()]
    texts += [value for element in root.iter() for value in element.attrib.values()]
    return [number for text in texts for number in _numbers(text)]


def _numbers(text: str) -> list[float]:
    found = []
    for match in _NUMBER.findall(text):
        value = float(match.replace(",", ".").replace("\u2212", "-"))
        if np.isfinite(value):
            found.append(value)
    return found
