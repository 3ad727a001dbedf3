"""The text of a book: rendered by Jinja2, each line with its own place in the book as written."""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Callable, Iterator, Mapping, Set
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

import jinja2

from reports.formula.parse import names
from reports.inputs.department_chapters import Texts, book_name
from reports.inputs.registry import SECTIONS
from reports.model.blocks import Model
from reports.model.evaluation import graph_of, node_of
from reports.model.sandbox import StrictEnvironment, rendered
from reports.model.statements import said_of, unpaired
from reports.shared.errors import BookError, FormulaError, one_line
from reports.shared.resources import templates_dir

_MARK = "\x1f"
_MARKS = re.compile(f"{_MARK}([^{_MARK}]*):(\\d+){_MARK}")
_NAME = re.compile(r"[\w-]+\.book")  # never a path
_STATEMENT = re.compile(r"\s*(%|#|\{%.*%\}$|$)")
_CAUSES: dict[type[Exception], str] = {
    ZeroDivisionError: "деление на ноль",
    OverflowError: "число слишком большое",
    KeyError: "нет такого имени",
}
_MIXED = re.compile("[а-яё]", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class BookLine:
    """A line as Jinja made it, with what continues it; ``number`` is that of its own book."""

    book: str
    number: int
    text: str


@dataclass(frozen=True, slots=True)
class BookPlaces:
    """Where own books say what: lines of formulas by node, of blocks and charts by their names."""

    nodes: dict[str, BookLine] = field(default_factory=dict)
    blocks: dict[str, tuple[BookLine, ...]] = field(default_factory=dict)
    charts: dict[str, tuple[BookLine, ...]] = field(default_factory=dict)

    def line_of(self, name: str, word: str = "") -> BookLine | None:
        """Line of a node, block or chart; of several the first that has a word."""
        if name in self.nodes:
            return self.nodes[name]
        lines = self.blocks.get(name) or self.charts.get(name) or ()
        having = (line for line in lines if word and word in line.text)
        return next(having, lines[0] if lines else None)


@dataclass(frozen=True)
class Shelf:
    """Folders of books, the first one with a name is taken; books may import each other."""

    folders: tuple[Path, ...]
    trusted: bool = False
    own: Texts = ()  # names and texts of own books, which come first

    def source(self, name: str) -> tuple[str, Path]:
        """Text of a book.

        Raises:
            jinja2.TemplateNotFound: no folder has it.
        """
        for name_of, text in self.own:
            if book_name(name_of) == Path(name).stem:
                return text, Path(name)
        for folder in self.folders if _NAME.fullmatch(name) else ():
            path = folder / name
            if path.is_file():
                return path.read_text(encoding="utf-8"), path
        raise jinja2.TemplateNotFound(name)

    def texts(self) -> Iterator[tuple[str, str]]:
        """Names of all books and their texts."""
        names = {path.stem for folder in self.folders for path in folder.glob("*.book")}
        names |= set(self.names)
        yield from ((name, self.source(f"{name}.book")[0]) for name in sorted(names))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the own books."""
        return tuple(book_name(name) for name, _ in self.own)

    def called(self, name: str) -> str:
        """Return a book as messages call it: an own one by the name that its file has."""
        return next(
            (full_name for full_name, _ in self.own if book_name(full_name) == Path(name).stem),
            name,
        )

    def of_book(self, name: str) -> Shelf:
        """Return shelf to read a book from: the house's own where no own book is asked of it."""
        houses = house_shelf()
        borrowed = any(f"{other}.book" in _libraries(houses) for other in self.names)
        return self if name in self.names or borrowed else houses

    def environment(self) -> jinja2.Environment:
        """Where books are rendered: those that are not trusted in a sandbox."""

        def load(name: str) -> tuple[str, str, Callable[[], bool]]:
            text, path = self.source(name)
            return _marked(text, name), str(path), lambda: True

        options: dict[str, Any] = {
            "undefined": jinja2.StrictUndefined, "loader": jinja2.FunctionLoader(load),
            "line_statement_prefix": "%", "trim_blocks": True, "lstrip_blocks": True,
            "keep_trailing_newline": True, "finalize": _printed,
        }  # fmt: skip
        if self.trusted:
            return jinja2.Environment(**options, bytecode_cache=_compiled(self.folders[0]))
        return StrictEnvironment(**options)


def _compiled(folder: Path) -> jinja2.BytecodeCache | None:
    """Where compiled books are kept, as Python keeps its modules; nowhere in a read-only place."""
    cache = folder / "__pycache__"
    try:
        cache.mkdir(exist_ok=True)
    except OSError:
        return None
    return jinja2.FileSystemBytecodeCache(str(cache)) if os.access(cache, os.W_OK) else None


@lru_cache(maxsize=8)
def _libraries(shelf: Shelf) -> frozenset[str]:
    """Books that others take lines or macros from."""
    whole = "\n".join(text for _, text in shelf.texts())
    return frozenset(re.findall(r'^% (?:from|include) "([^"]+)"', whole, re.MULTILINE))


def shelf_of(books: Texts) -> Shelf:
    """Return the books of the house behind the own books of an input."""
    return Shelf(house_shelf().folders, own=books) if books else house_shelf()


@lru_cache(maxsize=8)
def environment_of(shelf: Shelf) -> jinja2.Environment:
    """Return the environment of a shelf, made once."""
    return shelf.environment()


def house_shelf() -> Shelf:
    """Return the books of the house."""
    return Shelf((templates_dir() / "tables",), trusted=True)


def lines_of(name: str, shelf: Shelf, names: Mapping[str, object]) -> Iterator[BookLine]:
    """Lines of a book for one engine.

    Raises:
        BookError: Jinja2 does not understand it.
    """
    return _lines(_rendered(name, shelf, names))


def _marked(text: str, name: str) -> str:
    """Lines with book and number behind them, but for those of Jinja alone and of comments."""
    marked, waiting = [], ""  # a statement or a value that goes on below
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("#"):
            marked.append("")
            continue
        whole = waiting + line
        is_statement = _STATEMENT.match(whole) is not None
        goes_on = _depth(whole) > 0 if is_statement else whole.count("{{") > whole.count("}}")
        waiting = whole if goes_on else ""
        bare = is_statement or goes_on
        marked.append(line if bare else f"{line}{_MARK}{name}:{number}{_MARK}")
    return "\n".join(marked) + "\n"


def _depth(text: str) -> int:
    """Brackets that are open at the end of a statement."""
    return sum(text.count(c) for c in "([{") - sum(text.count(c) for c in ")]}")


def _printed(value: object) -> object:
    """Numbers as short as they are; what a macro wrote on several lines is one."""
    if isinstance(value, float):
        return repr(int(value)) if value.is_integer() else repr(value)
    if isinstance(value, str) and _MARK in value:
        return " ".join(_MARKS.sub("", value).split())
    return value


def _rendered(name: str, shelf: Shelf, names: Mapping[str, object]) -> str:
    try:
        environment = environment_of(shelf)
        return rendered(name, names, environment)
    except BookError:
        raise
    except RecursionError:
        raise BookError(shelf.called(name), 1, 1, "слишком глубокая вложенность",
                        "уберите вызов себя через себя") from None  # fmt: skip
    except jinja2.TemplateSyntaxError as error:
        book = error.name or name
        for line, problem, hint in unpaired(shelf.source(book)[0]):
            raise BookError(shelf.called(book), line, 1, problem, hint) from error
        raise BookError(shelf.called(book), error.lineno, 1,
                        f"условие Jinja2 не разобрано{_cause(error)}",
                        "проверьте % if, % for и скобки") from error  # fmt: skip
    except jinja2.TemplateNotFound as error:
        book, number = _raised_at(error, name)
        raise BookError(shelf.called(book), number, 1, f"нет книги «{error.message}»",
                        "include и from берут книги по имени") from error  # fmt: skip
    except (jinja2.TemplateError, TypeError, ValueError, ArithmeticError) as error:
        book, number = _raised_at(error, name)
        book = shelf.called(book)
        raise BookError(
            book, number, 1, f"условие Jinja2 не вычислено{_cause(error)}",
            "имена, которые знает книга, перечислены в docs/books.md",
        ) from error  # fmt: skip


def cause_of(error: Exception, letters: int = 80) -> str:
    """Return what went wrong in a book: in Russian as it was said, or by the kind of the error."""
    text = str(error)
    if isinstance(error, FormulaError):
        return one_line(f"«{error.fragment}» не разобрано: {error.mend}", letters)
    if isinstance(error, jinja2.TemplateError) and (words := said_of(error)):
        return words
    if re.search("[а-яё]", text):
        return one_line(text, letters)
    if isinstance(error, jinja2.TemplateError):
        return ""
    usual = (cause for kind, cause in _CAUSES.items() if isinstance(error, kind))
    return next(usual, "действие не для этих значений")


def _cause(error: Exception) -> str:
    """Return the same after a colon, where there is any."""
    cause = cause_of(error)
    return f": {cause}" if cause else ""


def _raised_at(error: Exception, name: str) -> tuple[str, int]:
    """Book and line from which a template raised."""
    at, trace = (name, 1), error.__traceback__
    while trace is not None:
        path = Path(trace.tb_frame.f_code.co_filename)
        if path.suffix == ".book":
            at = path.name, trace.tb_lineno
        trace = trace.tb_next
    return at


def _lines(rendered: str) -> Iterator[BookLine]:
    """Lines with their own numbers; one that begins with a blank continues the last."""
    whole: list[str] = []
    at = ("", "1")
    for raw in rendered.splitlines():
        text, *marks = raw.split(_MARK)
        if not text or text.isspace():
            continue
        if text[0] != " " and whole:
            yield BookLine(at[0], int(at[1]), " ".join(whole))
            whole.clear()
        if not whole:
            at = _place(marks[0]) if marks else at
        whole.append(text.strip())
    if whole:
        yield BookLine(at[0], int(at[1]), " ".join(whole))


def _place(mark: str) -> tuple[str, str]:
    """Book and number of a line."""
    book, _, number = mark.rpartition(":")
    return book, number


def at_fragment(
    line: BookLine, shelf: Shelf, problem: str, hint: str = "", fragment: str = ""
) -> BookError:
    """Return a mistake in a line; its column is that of the fragment where it is written."""
    source, book = shelf.source(line.book)[0].splitlines(), shelf.called(line.book)
    for number, written in enumerate(source[line.number - 1 :], line.number):
        if fragment and fragment in written:
            return BookError(book, number, written.index(fragment) + 1, problem, hint)
        if number > line.number and not written[:1].isspace():
            break
    return BookError(book, line.number, 1, problem, hint)


def book_faults(model: Model, lines: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """Names that formulas of books do not know, circles; ``lines`` are the lines of nodes."""
    nodes = model.nodes.keys() | model.fields.keys() | model.grid_runs.keys()
    nodes |= model.input_runs.keys()
    for key, line in lines.items():
        node = model.nodes.get(key)
        if node is None or node.expr is None:
            continue
        table = key.partition(".")[0] if "." in key else ""
        for name in sorted(names(node.expr)):
            if node_of(name, table, model) not in nodes:
                yield at_fragment(line, shelf, f"имя «{name}» неизвестно",
                                  _likely(name, nodes), name)  # fmt: skip
    yield from _circles(model, lines, shelf)


def _likely(name: str, names: Set[str]) -> str:
    """How to mend a name that nobody knows."""
    if name == "value":
        return "value стоит только в условии проверки; назовите величину"
    if _MIXED.search(name):
        return "в имени русские буквы; наберите его латиницей"
    section, _, key = name.partition("_")
    if section in SECTIONS and any(key in model.model_fields for model in SECTIONS[section].models):
        at = f"{section}.{key}"
        return f"{at} у этого двигателя не задано; спросите % if given.{at} или возьмите другое"
    column = next((each for each in sorted(names) if each.endswith(f".{name}")), None)
    similar = column or next(iter(difflib.get_close_matches(name, names, n=1, cutoff=0.8)), "")
    usual = "назовите величину книги, исходное или столбец таблицы"
    return f"возможно, {similar}; {usual}" if similar else usual


def _circles(model: Model, lines: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """Nodes whose formulas lead back to them, but for rows that follow from rows before."""
    graph, whole = graph_of(model), model.whole_tables
    for key, line in lines.items():
        if key in model.nodes and key not in whole and key in graph.ancestors(key):
            short = key.rpartition(".")[2]
            yield at_fragment(line, shelf, f"«{short}» считается через себя",
                              "разорвите круг формул", short)  # fmt: skip
