"""Own books of a department: their texts, the quantities and inputs that they declare.

A book is a text of tables (docs/books.md).  What it declares stands on lines of its own, outside
of conditions, so it is read before any engine is: ``section``, ``input``, ``choice``,
``quantity``.  The texts travel within the input: a workbook and a variant hold them.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path, PurePosixPath
from typing import Any, Literal

from pydantic import create_model

from kshm.nomenclature.digits import Digits
from kshm.nomenclature.quantity import UNITS, Quantity, quantity
from kshm.nomenclature.symbols import plain_symbol
from reports.inputs.meta import MAX_TEXT, StrictModel, choice, number
from reports.inputs.registry import SECTIONS
from reports.inputs.units import InputUnit
from reports.shared.errors import DeclarationError, InputError, Problem, one_line
from reports.shared.file_types import CALLED, TEXT, UTF16, kind_of, read_bytes

Texts = tuple[tuple[str, str], ...]

SUFFIX = ".book"
# Set by kshm serve: the folder of the books that its owner allows, empty for none.
OWNER = "KSHM_BOOKS"
MAX_BOOKS = 12
MAX_BYTES = 100_000
MAX_LINES = 2_000
MAX_LETTERS = 1_000  # of a line
MAX_DECLARED = 200
MAX_SYMBOL, MAX_UNIT = 80, 16
_MAX_READ = 1_000_000
DECLARATION = re.compile(r"(section|input|choice|quantity) (?!=|of |every )(.*)")
_SECTION = re.compile(r"(?P<name>[a-z][a-z0-9]{1,15}): (?P<title>.+)")
_INPUT = re.compile(
    r"(?P<section>[a-z][a-z0-9]{1,15})\.(?P<key>[a-z][a-z0-9_]{0,39}): (?P<rest>.+)"
)
_QUANTITY = re.compile(r"(?P<key>[A-Za-z]\w{0,39}): (?P<rest>.+)")
_SPAN = re.compile(r"(\S+?)\s*…\s*(\S+)")
FORMS = {
    "section": "section ИМЯ: ЗАГОЛОВОК",
    "input": "input РАЗДЕЛ.КЛЮЧ: НАЗВАНИЕ | ОБОЗНАЧЕНИЕ | ЕДИНИЦА | ОТ…ДО | ЗНАЧЕНИЕ",
    "choice": "choice РАЗДЕЛ.КЛЮЧ: НАЗВАНИЕ | слово — подпись; слово — подпись | слово",
    "quantity": "quantity КЛЮЧ: НАЗВАНИЕ | TEX | ЕДИНИЦА | ЗНАКОВ",
}
_TAG = re.compile("[<>]")


@dataclass(frozen=True)
class Declared:
    """What a book declares: section of inputs with its title and model, quantities by key."""

    section: str = ""
    title: str = ""
    model: type[StrictModel] | None = None
    quantities: Mapping[str, Quantity] = field(default_factory=dict)


@dataclass
class Declarations:
    """Declarations of a book as far as they are read."""

    text: str
    section: str = ""
    title: str = ""
    fields: dict[str, Any] = field(default_factory=dict)
    quantities: dict[str, Quantity] = field(default_factory=dict)

    def take(self, word: str, tail: str) -> None:
        """One declaration; ValueError where it is none."""
        {"section": self._titled, "input": self._input, "choice": self._choice,
         "quantity": self._quantity}[word](tail)  # fmt: skip
        if len(self.fields) + len(self.quantities) > MAX_DECLARED:
            problem = f"объявлено больше {MAX_DECLARED} величин и исходных"
            raise DeclarationError(problem, "разделите книгу")

    def _titled(self, tail: str) -> None:
        heading = _matched(_SECTION, tail, "section")
        self._named(heading["name"])
        self.title = safe_text(heading["title"])

    def _input(self, tail: str) -> None:
        key, (title, symbol, unit, span, default) = self._head(tail, "input", 5)
        limits = _SPAN.fullmatch(span)
        if limits is None:
            raise ValueError(f"пределы «{span}» не разобраны")
        low, high, value = map(_number, (limits[1], limits[2], default))
        if not low <= value <= high:
            raise ValueError(f"значение {default} вне пределов {span}")
        # A condition that asks for the value shapes the tables by it.
        shapes = f"value.own.{self.section}.{key}" in self.text
        unit_of = InputUnit("", _unit(unit))
        self.fields[key] = (float, number(safe_text(title), safe_text(symbol, empty=True), unit_of,
                                          low, high, value, structural=shapes))  # fmt: skip

    def _choice(self, tail: str) -> None:
        key, (title, options, default) = self._head(tail, "choice", 3)
        words = {}
        for option in options.split(";"):
            word, dash, label = option.strip().partition(" — ")
            if not dash or not re.fullmatch(r"[a-z][a-z0-9_]*", word) or '"' in label:
                raise ValueError(f"выбор «{option.strip()}» не разобран")
            words[word] = safe_text(label)
        if default not in words:
            raise ValueError(f"значения «{default}» нет среди выборов")
        kind = Literal.__getitem__(tuple(words))
        self.fields[key] = (kind, choice(safe_text(title), words, default, structural=True))

    def _quantity(self, tail: str) -> None:
        row = _matched(_QUANTITY, tail, "quantity")
        key, (title, tex, unit, digits) = row["key"], _parts(row["rest"], 4)
        if key in self.quantities:
            raise DeclarationError(f"величина «{key}» объявлена дважды", "уберите одну строку")
        if _is_of_program(key):
            problem = f"величину «{key}» объявляет сама программа"
            raise DeclarationError(problem, "назовите свою иначе; программную берут без quantity")
        if not re.fullmatch(r"[0-9]|1[0-2]", digits):
            raise ValueError(f"знаков после запятой «{digits}», а нужно от 0 до 12")
        if len(tex) > MAX_SYMBOL or not _is_symbol(tex):
            raise ValueError(f"обозначение «{one_line(tex, 60)}» не годится")
        label, symbol = _unit(unit), plain_symbol(tex)
        twin = next((each.key for each in self.quantities.values() if each.symbol == symbol), "")
        if twin:
            problem = f"обозначение «{symbol}» уже у «{twin}»"
            raise DeclarationError(problem, "дайте величинам разные обозначения")
        unit_name = next((name for name, unit in UNITS.items() if unit.label == label), label)
        self.quantities[key] = Quantity(key, tex, unit_name, safe_text(title), Digits(int(digits)))

    def _head(self, tail: str, word: str, parts: int) -> tuple[str, list[str]]:
        """Key and parts of the declaration of an input."""
        head = _matched(_INPUT, tail, word)
        self._named(head["section"])
        key = head["key"]
        if key in self.fields:
            raise DeclarationError(f"исходное «{key}» объявлено дважды", "уберите одну строку")
        if re.search(r"_r\d+$", key) or hasattr(StrictModel, key):
            raise DeclarationError(f"имя «{key}» занято программой", "назовите ключ иначе")
        return key, _parts(head["rest"], parts)

    def _named(self, section: str) -> None:
        """Keep the name of the section, the same on all lines."""
        if self.section and section != self.section:
            raise DeclarationError(f"в книге два раздела исходных: {self.section} и {section}",
                              f"пишите {self.section}.КЛЮЧ или заведите вторую книгу")  # fmt: skip
        if section in _taken():
            raise DeclarationError(
                f"имя раздела «{section}» занято программой", "назовите раздел иначе"
            )
        self.section = section


@lru_cache(maxsize=64)
def declared(text: str) -> Declared:
    """Return what the text of a book declares.

    Raises:
        DeclarationError: one of its declarations is none, or the text is beyond the limits.
    """
    lines = text.splitlines()
    if len(text.encode()) > MAX_BYTES:
        raise DeclarationError(f"книга больше {MAX_BYTES // 1000} КБ", "разделите её", 1)
    if len(lines) > MAX_LINES:
        problem = f"строк больше {MAX_LINES}"
        raise DeclarationError(problem, "разделите книгу", MAX_LINES + 1)
    reader = Declarations(text)
    for at, line in enumerate(lines, 1):
        if len(line) > MAX_LETTERS:
            problem = f"в строке больше {MAX_LETTERS} знаков"
            hint = "перенесите конец на строку с пробелом в начале"
            raise DeclarationError(problem, hint, at, MAX_LETTERS + 1)
        control = re.search("[\x00-\x08\x0b-\x1f\x7f\u2028\u2029]", line)
        if control is not None:
            problem, hint = "в строке управляющий символ", "оставьте обычный текст"
            raise DeclarationError(problem, hint, at, control.start() + 1)
        statement = DECLARATION.fullmatch(line)
        if statement is None:
            continue
        try:
            reader.take(statement[1], statement[2].strip())
        except DeclarationError as error:
            raise DeclarationError(error.what, error.hint, at) from None
        except ValueError as error:
            raise DeclarationError(str(error), f"пишите {FORMS[statement[1]]}", at) from None
    if not reader.fields:
        return Declared("", reader.title, None, reader.quantities)
    model = create_model(f"Own_{reader.section}", __base__=StrictModel, **reader.fields)
    title = reader.title or f"Своя книга {reader.section}"
    return Declared(reader.section, title, model, reader.quantities)


def quantities_of(books: Texts) -> Mapping[str, Quantity]:
    """Quantities of all books by key; what two books declare they declare alike."""
    return {key: each for _, text in books for key, each in declared(text).quantities.items()}


def sections_of(books: Texts) -> Mapping[str, Declared]:
    """Sections of inputs that books declare, by name."""
    all_of = (declared(text) for _, text in books)
    return {each.section: each for each in all_of if each.model is not None}


@lru_cache(maxsize=64)
def own_model(books: Texts) -> type[StrictModel]:
    """Model of the sections of all books together."""
    fields: dict[str, Any] = {name: (spec.model, ...) for name, spec in sections_of(books).items()}
    return create_model("OwnSections", __base__=StrictModel, **fields)


def book_name(name: str) -> str:
    """Name of a book without folder and ending: a book of the house of that name is replaced."""
    return PurePosixPath(name.replace("\\", "/")).stem


def path_of_cell(name: str, books: Texts) -> tuple[str, ...] | None:
    """Path of an own input from the name of its cell."""
    section, _, key = name.partition("_")
    spec = sections_of(books).get(section)
    is_key = spec is not None and spec.model is not None and key in spec.model.model_fields
    return ("own", section, key) if is_key else None


def texts_of(raw: Mapping[str, Any]) -> Texts:
    """Names and texts of books in a mapping; without those in which something is wrong."""
    entries = raw.get("books")
    pairs = entries.items() if isinstance(entries, Mapping) else entries or ()
    texts = []
    for pair in pairs if isinstance(pairs, Iterable) else ():
        name, text = pair if isinstance(pair, list | tuple) and len(pair) == 2 else ("", None)
        try:
            if isinstance(name, str) and isinstance(text, str) and declared(text):
                texts.append((name, text))
        except DeclarationError:
            continue
    return tuple(texts)


def named(raw: object) -> list[str]:
    """Names of books that the file's [report] gives; what is no list of texts is told elsewhere."""
    report = raw.get("report") if isinstance(raw, Mapping) else None
    names = report.get("books") if isinstance(report, Mapping) else None
    return [name for name in names if isinstance(name, str)] if isinstance(names, list) else []


def with_books(
    raw: Mapping[str, Any], folder: Path, source: str
) -> tuple[dict[str, Any], list[Path]]:
    """Return the mapping with the texts of the books it names, and the files that were read.

    Raises:
        InputError: a book is missing or is no text.
    """
    entries = raw.get("books")
    texts: dict[str, Any] = dict(entries) if isinstance(entries, Mapping) else {}
    files = []
    for name in () if OWNER in os.environ else named(raw)[: MAX_BOOKS + 1]:
        if name not in texts:
            texts[name] = read_text(folder, name, source)
            files.append(folder / name)
    return ({**raw, "books": texts} if texts else dict(raw)), files


def checked_texts(raw: object, names: Sequence[str]) -> Texts:
    """Names and texts of the books that [report] names, in its order.

    Args:
        raw: texts by name, or pairs of both.
        names: the names.

    Raises:
        InputError: a text is missing, names are repeated, a declaration is wrong.
    """
    pairs = raw.items() if isinstance(raw, Mapping) else raw
    texts: dict[str, str] = {}
    for pair in pairs if isinstance(pairs, Iterable) and not isinstance(pairs, str) else ():
        match pair:
            case [str(name), str(text)]:
                texts[name] = text
    if len(names) > MAX_BOOKS:
        raise InputError(Problem("report.books", f"книг больше {MAX_BOOKS}", "уберите лишние"))
    texts = allowed_texts(texts, names)
    for name in names:
        if name not in texts:
            problem = f"книга {one_line(name, 60)} не прочитана"
            raise InputError(Problem("report.books", problem, "здесь книг с диска не читают"))
    if len(set(map(book_name, names))) < len(names):
        problem = "имена книг повторяются"
        raise InputError(Problem("report.books", problem, "назовите каждую книгу один раз"))
    problems = []
    for name in names:
        try:
            declared(texts[name])
        except DeclarationError as error:
            at = f"{one_line(name, 60)}: строка {error.line}, столбец {error.column}"
            problems.append(Problem(at, one_line(error.what, 200), error.hint))
    if problems:
        raise InputError(problems)
    books = tuple((name, texts[name]) for name in names)
    _refuse_twins(books)
    sections = [each for each in (declared(text).section for _, text in books) if each]
    if len(set(sections)) < len(sections):
        problem = "у двух книг один раздел исходных данных"
        raise InputError(Problem("report.books", problem, "назовите разделы по-разному"))
    return books


def _refuse_twins(books: Texts) -> None:
    """Refuse quantities of two books that have one key or one symbol.

    Raises:
        InputError: two have, the line of the second.
    """
    keys: dict[str, Quantity] = {}
    symbols: dict[str, str] = {}
    for name, text in books:
        for key, each in declared(text).quantities.items():
            problem = ""
            if keys.setdefault(key, each) != each:
                problem = f"величина «{key}» объявлена и в другой книге"
            elif symbols.setdefault(each.symbol, key) != key:
                problem = f"обозначение «{each.symbol}» уже у «{symbols[each.symbol]}»"
            if problem:
                at = f"{one_line(name, 60)}: строка {line_of_quantity(text, key)}, столбец 1"
                raise InputError(Problem(at, problem, "назовите её иначе"))


def line_of_quantity(text: str, key: str) -> int:
    """Line on which a text declares a quantity."""
    lines = enumerate(text.splitlines(), 1)
    return next((at for at, line in lines if line.startswith(f"quantity {key}:")), 1)


def allowed_texts(texts: Mapping[str, str], names: Sequence[str]) -> dict[str, str]:
    """Return the texts to take: what was given, on a server those of its owner alone.

    Raises:
        InputError: the owner allows no such book.
    """
    owner = os.environ.get(OWNER)
    if owner is None:
        return dict(texts)
    if names and not owner:
        problem = "своих книг владелец страницы не разрешил"
        raise InputError(Problem("report.books", problem, "уберите ключ; команде kshm он доступен"))
    return {name: read_text(Path(owner), name, "") for name in names}


def read_text(folder: Path, name: str, source: str) -> str:
    """Text of a book beside the input.

    Raises:
        InputError: it is missing, elsewhere or no text.
    """
    name_of = one_line(name, 80)
    where = f"{source}: report.books: {name_of}" if source else name_of
    path = PurePosixPath(name.replace("\\", "/"))
    if path.is_absolute() or ".." in path.parts or path.suffix != SUFFIX or ":" in name:
        problem = "книга должна лежать рядом с исходными данными"
        raise InputError(Problem(where, problem, f"укажите имя файла с окончанием {SUFFIX}"))
    try:
        data = read_bytes(folder / path, _MAX_READ, "разделите книгу")
    except InputError as error:  # the place of the folder is no one's business
        raise InputError(Problem(where, error.problems[0].what, error.problems[0].hint)) from None
    kind = kind_of(data)
    if kind not in (TEXT, UTF16):
        raise InputError(
            Problem(where, f"{CALLED[kind]}, а нужна книга текстом", "сохраните UTF-8")
        )
    try:
        return data.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        called = "UTF-16" if kind == UTF16 else "не UTF-8 (возможно, Windows-1251)"
        problem = f"строка {line}, столбец 1: кодировка {called}"
        raise InputError(Problem(where, problem, "сохраните книгу в UTF-8")) from None


def _taken() -> frozenset[str]:
    """First words of the cells of the program's own inputs."""
    lists = (each.cells for section in SECTIONS.values() for each in section.lists.values())
    return frozenset({*SECTIONS, *(cells.partition("_")[0] for cells in lists), "regimes", "own",
                      "books", "variants"})  # fmt: skip


def safe_text(text: str, *, empty: bool = False) -> str:
    """Return a text that no spreadsheet takes for a formula and no page for a tag.

    Raises:
        ValueError: it is empty, too long or not of that kind.
    """
    text = text.strip()
    if not text and not empty:
        raise ValueError("пустой текст")
    if len(text) > MAX_TEXT:
        raise ValueError(f"текст длиннее {MAX_TEXT} знаков")
    if text.startswith(("=", "+", "@")) or _TAG.search(text):
        raise ValueError(f"текст «{one_line(text, 40)}» похож на формулу или код")
    return text


def _is_of_program(key: str) -> bool:
    try:
        return bool(quantity(key))
    except KeyError:
        return False


def _is_symbol(tex: str) -> bool:
    try:
        return bool(plain_symbol(tex))
    except (ValueError, IndexError):
        return False


def _unit(label: str) -> str:
    if len(label) > MAX_UNIT:
        raise ValueError(f"единица «{one_line(label, 40)}» длиннее {MAX_UNIT} знаков")
    return safe_text(label, empty=True).removeprefix("-")


def _matched(pattern: re.Pattern[str], text: str, word: str) -> re.Match[str]:
    match = pattern.fullmatch(text)
    if match is None:
        raise ValueError(f"«{word} {one_line(text, 60)}» не разобрано")
    return match


def _parts(text: str, count: int) -> list[str]:
    parts = [part.strip() for part in text.split("|")]
    if len(parts) != count:
        raise ValueError(f"частей через черту {len(parts)}, а нужно {count}")
    return parts


def _number(text: str) -> float:
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        raise ValueError(f"«{one_line(text, 40)}» — не число") from None
    if not math.isfinite(value):
        raise ValueError(f"«{text}» — не конечное число")
    return value
