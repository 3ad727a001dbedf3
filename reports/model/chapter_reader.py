"""Books: tables as text, read into the blocks that every output takes; docs/books.md."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from typing import Any, TypeVar

from kshm.arrays import Columns
from kshm.nomenclature.quantity import UNITS
from reports.formula.parse import is_condition, names, parse
from reports.inputs.department_chapters import DECLARATION, Texts, quantities_of
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.report import CHAPTERS
from reports.inputs.solve_input import solved
from reports.model.blocks import (
    ALLOWED,
    NO,
    TURN,
    YES,
    Block,
    BookChapter,
    Column,
    Grid,
    GridRow,
    Scalar,
    ScalarTable,
    TextLine,
    corners,
    extreme_columns,
    extreme_scalars,
    judged,
    nodes_in,
)
from reports.model.blocks import TableSpec as Table
from reports.model.chapter_source import (
    BookLine,
    BookPlaces,
    Shelf,
    at_fragment,
    cause_of,
    house_shelf,
    lines_of,
)
from reports.model.charts import ChartLines, ChartSpec
from reports.model.rename import renamed
from reports.model.shape import Part, stepped
from reports.shared.errors import BookError, FormulaError

MAX_ROWS = 3000
Kind = TypeVar("Kind", Scalar, Column)
_SPAN = re.compile(r"(-?[\d.]+)…(-?[\d.]+)(?: (\D\S*))?")  # a condition: within both ends
_VALUE = re.compile(
    r"(?P<helper>helper )?(?P<key>[A-Za-z_]\w*)(?: of (?P<of>\w+))?(?: every (?P<every>\S+))?"
    r"(?: = (?P<expr>.*?))?(?: \| (?P<source>.*?)(?: \| (?P<note>.*))?)?"
)
_TEXT_LINES = ("heading", "formula", "equation", "where", "show", "insert", "pick", "member",
               "mend", "conclude")  # fmt: skip
_HEADS = {
    "text": (r"(?P<title>.+)", "text ЗАГОЛОВОК"),
    "chapter": (r".+ [0-9A-F]{6}(?: smooth)?", "chapter НАЗВАНИЕ ЦВЕТ"),
    "place": (r"(?:before|chain|after|drawn) \d+(?: alone)?", "place after 150"),
    "sheet": (r"(?P<title>.+?)(?: in .+ \d+(?: full)?: .+)?",
              "sheet НАЗВАНИЕ in ГЛАВА НОМЕР: ЗАГОЛОВОК"),
    "list": (r'(?P<id>\w+)(?P<verdicts> verdicts(?: "(?P<good>.*)" "(?P<bad>.*)")?)?'
             r": (?P<title>.+)",
             "list ИМЯ: ЗАГОЛОВОК"),
    "table": (r"(?P<id>\w+) (?P<number>.+) over (?P<rows>turn|cycle|\S+…\S+ by \S+)"
              r"(?P<options>(?: helper| computed)*): (?P<title>.+)",
              "table ИМЯ НОМЕР over turn: ЗАГОЛОВОК"),
    "grid": (r"(?P<id>\w+): (?P<title>.+)", "grid ИМЯ: ЗАГОЛОВОК"),
    "box": (r"(?P<id>\w+) (?P<key>\w+)(?: of (?P<of>\w+))? = (?P<size>.+?)(?: \| (?P<source>.+?))?"
            r": (?P<title>.+)", "box ИМЯ КЛЮЧ = РАЗМЕР: ЗАГОЛОВОК"),
    "allowed": (r"(?P<id>\w+) (?P<limit>[<>]= \w+): (?P<title>.+)",
                "allowed ИМЯ <= ПРЕДЕЛ: ЗАГОЛОВОК"),
}  # fmt: skip


def read_book(
    name: str,
    names: Mapping[str, Any],
    shelf: Shelf | None = None,
    lines: BookPlaces | dict[str, BookLine] | None = None,
) -> Part:
    """Blocks and charts of a book for one engine.

    Args:
        name: file of the book.
        names: what its conditions may ask.
        shelf: where books lie, those of the house if none is given.
        lines: takes the lines of what the book says; a mapping, those of its formulas alone.

    Raises:
        BookError: a mistake, with its line and column in the book.
    """
    shelf = shelf or house_shelf()
    where = lines if isinstance(lines, BookPlaces) else BookPlaces({} if lines is None else lines)
    reader = _BookReader(shelf, names, where)
    for line in lines_of(name, shelf, names):
        reader.take(line)
    return reader.part()


@dataclass
class _Open:
    """A block as far as it is read."""

    word: str
    about: Mapping[str, str]
    sheet: str
    scalars: list[Scalar] = field(default_factory=list)
    columns: list[Column] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    members: list[tuple[str, list[Scalar]]] = field(default_factory=list)
    last: tuple[str, ...] = ()
    draws: list[tuple[str, str]] = field(default_factory=list)
    lines: list[TextLine] = field(default_factory=list)


class _BookReader:
    """Takes line after line and keeps the blocks."""

    def __init__(self, shelf: Shelf, names: Mapping[str, Any], lines: BookPlaces) -> None:
        self._shelf, self._names = shelf, names
        self._places = lines
        self._chapters: list[BookChapter] = []
        self._sheet = ""
        self._blocks: list[Block] = []
        self._charts: list[ChartSpec] = []
        self._open: _Open | ChartLines | None = None
        self._lines: list[BookLine] = []  # of the block that is open
        self._line = BookLine("", 1, "")

    def part(self) -> Part:
        """Return what was read."""
        with self._told():
            self._close()
        return Part(tuple(self._blocks), tuple(self._charts), tuple(self._chapters))

    def take(self, line: BookLine) -> None:
        """One line: a heading, or a line of the block that is open."""
        self._line = line
        with self._told():
            self._take(line)

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Tell of a mistake where it stands."""
        try:
            yield
        except BookError:
            raise
        except FormulaError as error:
            part = error.fragment
            raise self._fault(f"в формуле не разобрано «{part}»", error.mend, part) from error
        except KeyError as error:
            key = str(error.args[0]) if error.args else ""
            raise self._fault(f"величина «{key}» неизвестна",
                              "назовите известную после of", key) from error  # fmt: skip
        except (ValueError, IndexError) as error:
            raise self._fault(cause_of(error, 200)) from error

    def _take(self, line: BookLine) -> None:
        text = line.text
        word, _, tail = text.partition(" ")
        if DECLARATION.fullmatch(text):
            pass  # read before any engine, see reports.inputs.department_chapters
        elif word in _HEADS and not tail.startswith(("=", "of ", "every ")):
            self._close()
            self._head(word, tail)
            self._lines = [line]
        elif word in ChartLines.HEADS and not tail.startswith("="):
            self._close()
            self._open = ChartLines.opened(word, tail, self._sheet)
            self._lines = [line]
        elif isinstance(self._open, ChartLines):
            self._open = self._open.take(word, tail)
            self._lines.append(line)
        elif self._open is None:
            raise self._fault(f"строка «{text}» стоит вне блока", "начните с list, table или grid")
        elif self._open.word == "text":
            self._said(self._open, word, tail, text)
        else:
            self._lines.append(line)
            self._body(self._open, word, tail, text)

    def _said(self, block: _Open, word: str, tail: str, text: str) -> None:
        """Read a line of a chapter's text."""
        kind = word if word in _TEXT_LINES else "paragraph"
        said = tail if kind != "paragraph" else text
        block.lines.append(TextLine(kind, said, self._line.book, self._line.number))

    def _head(self, word: str, tail: str) -> None:
        pattern, form = _HEADS[word]
        head = re.fullmatch(pattern, tail)
        if head is None:
            raise self._fault(f"заголовок «{word} {tail}» не разобран", f"пишите {form}")
        attributes = {key: value or "" for key, value in head.groupdict().items()}
        if word == "sheet":
            self._sheet = attributes["title"].strip()
        elif word in ("place", "chapter"):
            pass  # read before any engine, see reports.model.contents
        elif word == "box":
            parse(attributes["size"])
            key, box, source = attributes["key"], attributes["of"], attributes["source"]
            grid = corners(
                attributes["id"], attributes["title"], self._sheet, key, attributes["size"],
                box or "box", source or "оси диаграммы",
            )  # fmt: skip
            self._placed(*(key for key, _ in nodes_in(grid)))
            self._places.blocks[grid.id] = (self._line,)
            self._blocks.append(grid)
        else:
            self._open = _Open(word, attributes, self._sheet)

    def _body(self, block: _Open, word: str, tail: str, text: str) -> None:
        if word == "note":
            block.notes.append(tail)
        elif block.word == "grid" and word == "member":
            block.members.append((tail, []))
        elif block.word == "grid" and word == "last":
            block.last = tuple(tail.split())
        elif word == "draws" and block.word == "table":
            block.draws += self._draws(block, tail)
        elif word == "extremes" and block.word in ("list", "table"):
            self._extremes(block, tail)
        elif block.word == "allowed":
            block.scalars += self._allowed(block, text)
        elif word == "check" and block.word == "list":
            block.scalars += self._check(block, tail)
        elif block.word == "grid":
            if not block.members:
                raise self._fault("строка стоит раньше member", "начните с member НАЗВАНИЕ")
            block.members[-1][1].append(self._scalar(text, named=True))
        elif block.word == "table":
            block.columns.append(self._sourced(_column(text, self._shelf.own), text))
        else:
            block.scalars.append(self._scalar(text))

    def _extremes(self, block: _Open, tail: str) -> None:
        match = re.fullmatch(r"(?:(\w+)\.)?(\w+) as (\w+)(?: \| (.*))?", tail)
        if match is None:
            raise self._fault(f"«extremes {tail}» не разобрано", "пишите extremes СТОЛБЕЦ as ИМЯ")
        table, column, name, source = match.groups()
        if block.word == "table":
            columns = extreme_columns(column, name)
            self._placed(*(f"{block.about['id']}.{each.key}" for each in columns))
            block.columns += columns
            return
        if table is None:
            raise self._fault(
                "в списке нужен столбец таблицы", "пишите extremes ТАБЛИЦА.СТОЛБЕЦ as ИМЯ"
            )
        scalars = extreme_scalars(table, column, name, source or "")
        self._placed(*(each.key for each in scalars))
        block.scalars += scalars

    def _draws(self, block: _Open, tail: str) -> list[tuple[str, str]]:
        """``draws KEY for TABLE.COLUMN …``: those charts are drawn from this table."""
        match = re.fullmatch(r"(\w+(?:\.\w+)?) for (\w+\.\w+(?: \w+\.\w+)*)", tail)
        if match is None:
            raise self._fault(f"«draws {tail}» не разобрано", "пишите draws КЛЮЧ for ТАБЛИЦА.КЛЮЧ")
        key = match[1] if "." in match[1] else f"{block.about['id']}.{match[1]}"
        return [(each, key) for each in match[2].split()]

    def _check(self, block: _Open, tail: str) -> tuple[Scalar, Scalar]:
        """``check KEY [of VALUE_KEY] = value | test of value | title [| source]``."""
        match = re.fullmatch(r"(\w+)(?: of (\w+))? = (.*?) \| (.*?) \| (.*?)(?: \| (.*))?", tail)
        if match is None:
            raise self._fault(f"«check {tail}» не разобрано",
                              "пишите check ИМЯ = ВЕЛИЧИНА | УСЛОВИЕ | ЧТО ПРОВЕРЕНО")  # fmt: skip
        key, value_key, value, test, title, source = match.groups()
        verdict = key if value_key else f"check_{key}"
        value_name = value_key or f"value_{key}"
        if value_key and key.startswith("check_"):
            raise self._fault(f"имя «{key}» занято", f"пишите check {key[6:]} = … без of", key)
        parse(value)
        words, span = self._words(block) or (YES, NO), _SPAN.fullmatch(test)
        if span is not None:  # the last digit of a computed value may miss an end
            test = f"round(value, 9) >= {span[1]} and round(value, 9) <= {span[2]}"
        ends = (float(span[1]), float(span[2])) if span and words != (YES, NO) else None
        if not (is_condition(test) and "value" in names(test)):
            raise self._fault(f"«{test}» — не условие о проверяемом значении",
                              "назовите его value: value <= 120", test)  # fmt: skip
        test = renamed(test, lambda name: value_name if name == "value" else name)
        self._placed(value_name, verdict)
        source, unit = source or "проверка", (span and span[3]) or ""
        return judged(value_name, verdict, value, _plain(test), title, source, words, ends, unit)

    def _allowed(self, block: _Open, text: str) -> tuple[Scalar, Scalar]:
        """``KEY = value | title``, held to the limit of the heading."""
        match = re.fullmatch(r"(\w+) = (.*?) \| (.*)", text)
        if match is None:
            raise self._fault(f"строка «{text}» не разобрана", "пишите ИМЯ = ВЕЛИЧИНА | ЧТО ЭТО")
        key, value, title = match.groups()
        value_name, limit = f"value_{key}", block.about["limit"]
        parse(value)
        self._placed(value_name, f"{ALLOWED}{key}")
        return judged(value_name, f"{ALLOWED}{key}", value, f"{value_name} {limit}", title,
                      "сравнение с допускаемым")  # fmt: skip

    def _words(self, block: _Open) -> tuple[str, str] | None:
        if not block.about["verdicts"]:
            return None
        return block.about["good"] or YES, block.about["bad"] or NO

    def _scalar(self, text: str, *, named: bool = False) -> Scalar:
        return self._sourced(_scalar(text, self._shelf.own, named=named), text)

    def _sourced(self, node: Kind | None, text: str) -> Kind:
        """Return the column or scalar of a line, which says where its formula is from."""
        if node is None:
            raise self._fault(f"строка «{text}» не разобрана", "пишите КЛЮЧ = ФОРМУЛА | ИСТОЧНИК")
        if node.expr is not None and not node.source:
            raise self._fault(f"у «{node.key}» нет источника",
                              "после черты | назовите источник или -", node.key)  # fmt: skip
        if isinstance(self._open, _Open):
            table = f"{self._open.about['id']}." if isinstance(node, Column) else ""
            self._placed(f"{table}{node.key}")
        return replace(node, source="") if node.source == "-" else node

    def _placed(self, *keys: str) -> None:
        """Keep where formulas are written."""
        self._places.nodes.update(dict.fromkeys(keys, self._line))

    def _close(self) -> None:
        """End the block that is open; what is wrong with it as a whole stands in its heading."""
        block, self._open = self._open, None
        if block is None:
            return
        here, self._line = self._line, self._lines[0]
        with self._told():
            if isinstance(block, ChartLines):
                self._charts.append(block.made())
                self._places.charts[block.id] = tuple(self._lines)
            elif block.word == "text":
                if not block.lines:
                    raise self._fault("в главе нет ни строки", "напишите абзац или show")
                title, lines = block.about["title"], tuple(block.lines)
                name = title if title in CHAPTERS else ""
                self._chapters.append(BookChapter(CHAPTERS.get(title, title), lines, name))
                self._places.blocks[f"text {block.about['title']}"] = tuple(self._lines)
            else:
                self._blocks.append(self._made(block))
                self._places.blocks[block.about["id"]] = tuple(self._lines)
        self._line = here

    def _made(self, block: _Open) -> Block:
        attributes, note = block.about, " ".join(block.notes)
        head = (attributes["id"], attributes["title"])
        if not (block.scalars or block.columns or block.members or self._shelf.trusted):
            raise ValueError(f"в блоке «{attributes['id']}» нет ни одной величины; допишите её")
        if block.word == "grid":
            return Grid(*head, block.sheet, tuple(label for label, _ in block.members),
                        _rows_of(block), note=note)  # fmt: skip
        if block.word == "table":
            return self._table(block, note)
        verdicts = (YES, NO) if block.word == "allowed" else self._words(block)
        return ScalarTable(*head, block.sheet, tuple(block.scalars), note=note, verdicts=verdicts)

    def _table(self, block: _Open, note: str) -> Table:
        attributes, step = block.about, None
        if "…" in attributes["rows"]:
            first, last, step = _rows_between(attributes["rows"])
            rows = stepped(first, last, step)
        else:
            rows = self._names[attributes["rows"]]
        options = attributes["options"].split()
        if block.columns and not self._shelf.trusted:
            _refuse_odd_columns(block.columns, computed="computed" in options)
        return Table(
            attributes["id"], attributes["number"], attributes["title"], block.sheet,
            tuple(block.columns), rows,
            note=note, helper="helper" in options, step=step,
            computed=partial(solved_columns, attributes["id"]) if "computed" in options else None,
            draws=tuple(block.draws),
        )  # fmt: skip

    def _fault(self, problem: str, hint: str = "", fragment: str = "") -> BookError:
        """Return a mistake in the line taken."""
        return at_fragment(self._line, self._shelf, problem, hint, fragment)


def _rows_between(text: str) -> tuple[float, float, float]:
    """First row, last row and step of ``0…180 by 10``.

    Raises:
        ValueError: they are none, or there are too many.
    """
    match = re.fullmatch(r"(-?\d+(?:\.\d+)?)…(-?\d+(?:\.\d+)?) by (\d+(?:\.\d+)?)", text)
    if match is None:
        raise ValueError(f"строки таблицы «{text}» не разобраны; пишите 0…180 by 10")
    first, last, step = map(float, match.groups())
    if not (step > 0 and 0 <= last - first <= MAX_ROWS * step):
        raise ValueError(f"строк «{text}» нет или больше {MAX_ROWS}; возьмите шаг крупнее")
    return first, last, step


def _refuse_odd_columns(columns: list[Column], *, computed: bool) -> None:
    """Refuse a table whose first column is calculated, or another one is not.

    Raises:
        ValueError: it is so.
    """
    if columns[0].expr is not None:
        raise ValueError(f"первый столбец «{columns[0].key}» с формулой; начните с phi_deg")
    bare = next((each.key for each in columns[1:] if each.expr is None), "")
    if bare and not computed:
        raise ValueError(f"у столбца «{bare}» нет формулы; пишите {bare} = ФОРМУЛА | ИСТОЧНИК")


def _plain(test: str) -> str:
    """Return condition whose braces are no places to fill in, and whose choice is one condition."""
    test = f"({test})" if re.search(r"\bif\b", test) else test
    return test.replace("{", "{{").replace("}", "}}")


def solved_columns(table: str, model: InputFile) -> Columns:
    """Return what the solver finds for a table of values, in units of the tables."""
    return solved(model).columns[table]


@lru_cache(maxsize=8192)
def _scalar(text: str, declared: Texts, *, named: bool) -> Scalar | None:
    """Scalar of a line, None where it is none; ``named`` names the quantity in any case."""
    match = _VALUE.fullmatch(text)
    if match is None or match["helper"] or match["expr"] is None:
        return None
    of = match["of"] or (match["key"] if named else "")
    scalar = Scalar(match["key"], match["expr"].strip(), match["source"] or "", of=of,
                    every=match["every"] or TURN, note=match["note"] or "")  # fmt: skip
    return _known(scalar, declared)


@lru_cache(maxsize=8192)
def _column(text: str, declared: Texts) -> Column | None:
    """Column of a line, None where it is none."""
    match = _VALUE.fullmatch(text)
    if match is None:
        return None
    expr = match["expr"] and match["expr"].strip()
    column = Column(match["key"], expr, match["source"] or "", of=match["of"] or "",
                    every=match["every"] or TURN, helper=bool(match["helper"]))  # fmt: skip
    return _known(column, declared)


def _known(node: Kind, books: Texts) -> Kind:
    """Return the node, whose formula is of the language and whose quantity is known.

    ``books`` are own ones, which may declare it.

    Raises:
        FormulaError: the formula is none.
        KeyError: nobody knows the quantity.
    """
    if node.expr is not None:
        parse(node.expr)
    parse(node.every)
    if books:
        node = replace(node, own=quantities_of(books).get(node.of or node.key))
    _ = node.quantity
    said, required = (name.rpartition("_")[2] for name in (node.key, node.of))
    if node.of and required and said != required and {said, required} <= UNITS.keys():
        raise ValueError(
            f"единица «{said}» ключа «{node.key}» — не «{required}» величины «{node.of}»"
        )
    return node


def _rows_of(block: _Open) -> tuple[GridRow, ...]:
    """Rows by quantity in the order of their first cells, but for those asked to be last."""
    cells = [{cell.of: cell for cell in members} for _, members in block.members]
    order = dict.fromkeys(key for column in cells for key in column)
    keys = (*(key for key in order if key not in block.last), *block.last)
    rows = []
    for key in keys:
        row = tuple(column.get(key) for column in cells)
        rows.append(GridRow(key, row, own=next((cell.own for cell in row if cell), None)))
    return tuple(rows)
