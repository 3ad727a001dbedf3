"""Rosters: lists of students as Excel, Moodle and people write them."""

from __future__ import annotations

import csv
import io
import re
import unicodedata
import warnings
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from reports.grading.issuing.names import foreign_letters, twin
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.file_types import ARCHIVE, OFFICE, TEXT, UTF16, kind_of, read_bytes
from reports.workbook.intake import check_data
from reports.workbook.layout import CONTENTS_SHEET, INPUT_SHEET, Cell

if TYPE_CHECKING:  # openpyxl is loaded when a book is read
    from openpyxl.cell import ReadOnlyCell
    from openpyxl.worksheet.worksheet import Worksheet

MAX_BYTES, MAX_FIELD = 2_000_000, 200
_MOST_COLUMNS, _MOST_ROWS = 100, 10_000  # one cell at the edge makes a sheet 17,000,000,000 cells
_FIRST_LINES = 20  # by which the delimiter is known


@dataclass(frozen=True, slots=True)
class RosterLine:
    """A line that holds anything; ``faults`` are columns whose cells cannot be read, and why."""

    number: int
    cells: list[str]
    faults: dict[int, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class RosterListing:
    """The lines of a CSV file, or of a sheet with a title."""

    file: str
    title: str
    lines: list[RosterLine]

    def place(self, line: RosterLine, column: int) -> str:
        """Address of a cell, for messages."""
        if not self.title:
            return f"{self.file}, строка {line.number}"
        address = Cell("", line.number, column + 1).coordinate
        return f"{self.file}, лист «{self.title}», {address}"


def listings(path: Path) -> list[RosterListing]:
    """What a CSV file or the sheets of a book hold, in their order; hidden sheets are left out.

    Raises:
        InputError: it is neither.
    """
    data = read_bytes(path, MAX_BYTES, "это не список группы")
    kind = kind_of(data)
    if kind in (ARCHIVE, OFFICE):
        return _sheets(path, data)
    if kind not in (TEXT, UTF16):
        raise refused(path, "это двоичный файл, а нужен CSV или .xlsx", "выберите другой файл")
    return [RosterListing(path.name, "", _csv_lines(path, _text(path, data)))]


def refused(path: Path, what: str, hint: str) -> InputError:
    """The error of a file that is no list."""
    return InputError(Problem(path.name, what, hint))


def _clean(cell: str) -> str:
    text = _AS_FORMULA.fullmatch(cell.strip())  # ="00012": how a site keeps zeros through Excel
    return one_line(unicodedata.normalize("NFC", text[1] if text else cell), MAX_FIELD + 1)


_AS_FORMULA = re.compile(r'="([^"]*)"')


# --- CSV -------------------------------------------------------------------------------------


def _csv_lines(path: Path, text: str) -> list[RosterLine]:
    first = text.splitlines()[:_FIRST_LINES]
    delimiter = max(";\t,", key=lambda char: sum(char in line for line in first))
    try:
        rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True))
    except csv.Error:
        raise refused(path, "это не CSV: не закрыта кавычка", "сохраните список заново") from None
    lines = [RosterLine(i, [_clean(cell) for cell in row]) for i, row in enumerate(rows, 1)]
    lines = [line for line in lines if any(line.cells)]
    if lines and lines[0].cells[0].casefold() == "sep=":  # Excel's word on the delimiter
        del lines[0]
    return lines


# Other encodings of Russian lists: of Windows, of its command line, of old Unix, of a Mac.
_ENCODINGS = ("cp1251", "cp866", "koi8-r", "mac-cyrillic")
_WORD = re.compile(r"[А-ЯЁ][а-яё]+|[А-ЯЁ]+|[а-яё]+")
_LETTERS = re.compile(r"[^\W\d_]+")


def _text(path: Path, data: bytes) -> str:
    """The text of a list in the one encoding that gives Russian words."""
    try:
        return data.decode("utf-16" if kind_of(data) == UTF16 else "utf-8-sig")
    except UnicodeDecodeError:
        pass
    texts = (data.decode(encoding, errors="replace") for encoding in _ENCODINGS)
    scores = sorted(((_russian(text), text) for text in texts), reverse=True)
    (best, text), (second, other) = scores[:2]
    if best < _LEAST_RUSSIAN or (best == second and text != other):
        what = "кодировка не UTF-8 и не Windows-1251, cp866, KOI8-R или Mac"
        raise refused(path, what, "сохраните как «CSV UTF-8»")
    return text


_LEAST_RUSSIAN = 0.6  # of the words that are no plain Latin
_USUAL = frozenset("оеаинтсрвлкмдпу")


def _russian(text: str) -> float:
    """Share of the foreign words that are written as Russian ones are: case, usual letters."""
    words = [w for w in _LETTERS.findall(text) if not w.isascii() and len(w) > 2]
    if not words or "\ufffd" in text:
        return 0.0
    fit = sum(_WORD.fullmatch(word) is not None for word in words) / len(words)
    letters = "".join(words).casefold()
    usual = sum(char in _USUAL for char in letters) / len(letters)
    odd = sum(not char.isascii() and not char.isalnum() and char not in "«»№—–" for char in text)
    return fit * min(1.0, usual / 0.6) - odd / len(letters)


# --- a book of Excel -------------------------------------------------------------------------


def _sheets(path: Path, data: bytes) -> list[RosterListing]:
    from openpyxl import load_workbook

    check_data(data, path.name)
    try:
        with warnings.catch_warnings(action="ignore"):  # of what a list does not need
            shown, written = (
                load_workbook(io.BytesIO(data), read_only=True, data_only=values)
                for values in (True, False)
            )
            merged = _merged(data)
            return [
                RosterListing(
                    path.name,
                    sheet.title,
                    _filled_down(
                        list(_sheet_lines(sheet, written[sheet.title])), merged.get(sheet.title, ())
                    ),
                )
                for sheet in shown.worksheets
                if sheet.sheet_state == "visible"
            ]
    except Exception:  # whatever openpyxl meets in a file of a program that it does not know
        raise refused(path, "книга не читается", "сохраните список как CSV") from None


def _merged(data: bytes) -> dict[str, list[tuple[int, int, int, int]]]:
    """First row, first column, last row and last column of the merged cells of each sheet."""
    from openpyxl import load_workbook

    with zipfile.ZipFile(io.BytesIO(data)) as parts:
        names = [name for name in parts.namelist() if name.startswith("xl/worksheets/")]
        if not any(b"<mergeCell " in parts.read(name) for name in names):
            return {}
    book = load_workbook(io.BytesIO(data))
    return {
        sheet.title: [(r.min_row, r.min_col, r.max_row, r.max_col) for r in sheet.merged_cells]
        for sheet in book.worksheets
    }


def _filled_down(
    lines: list[RosterLine], merged: Sequence[tuple[int, int, int, int]]
) -> list[RosterLine]:
    """Lines with the text of a cell that is merged downwards in each of its rows."""
    by_number = {line.number: line for line in lines}
    for first, column, last, _ in merged:
        above = by_number.get(first)
        text = above.cells[column - 1] if above and column <= len(above.cells) else ""
        for number in range(first + 1, last + 1):
            line = by_number.get(number)
            if text and line is not None and column <= len(line.cells):
                line.cells[column - 1] = line.cells[column - 1] or text
    return lines


def _sheet_lines(shown: Worksheet, written: Worksheet) -> Iterator[RosterLine]:
    """Lines of a sheet with the saved values of its formulas."""
    for sheet in (shown, written):
        sheet.reset_dimensions()  # a claim of the file, and often a wrong one
    edge = {"max_row": _MOST_ROWS, "max_col": _MOST_COLUMNS}
    rows = (sheet.iter_rows(**edge) for sheet in (shown, written))
    for number, (values, sources) in enumerate(zip(*rows, strict=True), 1):
        faults = {
            i: why
            for i, (cell, source) in enumerate(zip(values, sources, strict=True))
            if (why := _fault(cell, source))
        }
        cells = ["" if i in faults else _clean(_shown(cell)) for i, cell in enumerate(values)]
        if any(cells) or faults:
            yield RosterLine(number, cells, faults)


def _fault(cell: ReadOnlyCell, source: ReadOnlyCell) -> str:
    """Why a cell's text is not known, empty where it is."""
    if cell.value is None:
        return "значение формулы не сохранено" if source.data_type == "f" else ""
    if cell.data_type == "e":
        return f"ошибка {cell.value}"
    if cell.is_date:  # what was typed is lost: «3-12» became the third of December
        return "дата вместо текста"
    return "логическое значение вместо текста" if cell.data_type == "b" else ""


def _shown(cell: ReadOnlyCell) -> str:
    """The text of a cell as its sheet shows it."""
    value = cell.value
    if not isinstance(value, (int, float)):
        return str(value or "")
    text = f"{value:.15g}".replace(".", ",")
    zeros = cell.number_format  # «000000»: a number with the zeros in front of it
    return text.zfill(len(zeros)) if zeros and not zeros.strip("0") else text


# --- students ------------------------------------------------------------------------------------

MAX_STUDENTS = 2000
_TITLES = 20  # lines above the head: what the list is, of which year

_HEADS = {
    "surname": ("фамилия", "surname", "last name", "lastname"),
    "name": ("имя", "имя и отчество", "имя отчество", "name", "first name", "firstname"),
    "patronymic": ("отчество", "middle name"),
    "full": ("фио", "ф и о", "студент", "студенты", "обучающийся", "обучающиеся", "фамилия и о",
             "фамилия имя", "фамилия и имя", "фамилия имя отчество", "фамилия имя и отчество",
             "surname name", "last name first name"),
    "turned": ("имя фамилия", "имя и фамилия", "имя отчество фамилия", "имя отчество и фамилия",
               "и о фамилия", "name surname", "first name surname", "first name last name"),
    "either": ("полное имя", "full name", "student", "students"),
    "group": ("группа", "group", "groups", "группы", "номер группы", "№ группы"),
    "id": ("номер", "шифр", "id", "id number", "индивидуальный номер", "логин", "login",
           "username", "имя пользователя", "зачетка", "номер зачетки", "номер зачетной книжки",
           "№ зачетки", "№ зачетной книжки"),
    "email": ("email", "e-mail", "почта", "адрес электронной почты", "email address"),
}  # fmt: skip
_SURNAMES = ("surname", "full", "turned", "either")  # columns with a surname, the plainest first
# What a head says besides, and what stands among the people and is none.
_BESIDES = frozenset(("студента", "студентов", "обучающегося", "полностью", "учебная"))
# Lines of Canvas and Google Classroom between the head and the people.
_SERVICE = frozenset(("points possible", "student, test", "test student", "read only", "date",
                      "points", "дата", "баллы", "максимальный балл", "class average"))  # fmt: skip
_NOBODY = frozenset(("группа", "итого", "всего", "куратор", "староста", "преподаватель"))


@dataclass(frozen=True, slots=True)
class Student:
    """A student; ``id`` tells namesakes apart and is unique in the list."""

    id: str
    surname: str
    name: str
    group: str = ""
    email: str = ""
    number: str = ""  # as the list gives it

    @property
    def full(self) -> str:
        """Surname first."""
        return f"{self.surname} {self.name}".strip()


def read_roster(path: Path) -> list[Student]:
    """Students of a CSV file (any usual encoding; comma, semicolon or tab) or of an Excel book.

    Raises:
        InputError: everything that is wrong with it.
    """
    all_listings = listings(path)
    if {CONTENTS_SHEET, INPUT_SHEET} <= {listing.title for listing in all_listings}:
        raise refused(path, "это рабочая книга, а не список группы", "укажите файл списка")
    if not any(listing.lines for listing in all_listings):
        raise refused(path, "список пуст", "нужны столбцы: Фамилия;Имя;Группа")
    lists = [headed for listing in all_listings if (headed := _headed(listing)) is not None]
    if not lists:
        what = "нет столбца «Фамилия» или «ФИО»"
        raise refused(path, what, "первая строка: Фамилия;Имя;Группа;Номер;Email")
    lists = [headed for headed in lists if headed.people]
    if not lists:
        raise refused(path, "в списке нет ни одного студента", "впишите их под заголовком")
    if len(lists[0].people) > MAX_STUDENTS:
        raise refused(path, f"в списке больше {MAX_STUDENTS} студентов", "разделите его")
    _refuse_another(path, lists)
    return _students(lists[0])


@dataclass(frozen=True, slots=True)
class _List:
    """People under a head that names the columns."""

    listing: RosterListing
    columns: dict[str, int]
    people: list[RosterLine]

    def given(self, line: RosterLine) -> dict[str, str]:
        """Texts under each known head."""
        cells = line.cells
        return {key: cells[i] if i < len(cells) else "" for key, i in self.columns.items()}

    def where(self, line: RosterLine) -> str:
        """The cell of a surname, for messages."""
        return self.listing.place(
            line, next(self.columns[k] for k in _SURNAMES if k in self.columns)
        )


def _headed(listing: RosterListing) -> _List | None:
    """The list of a sheet or file; titles may stand above its head, and a head has two lines."""
    heads = [_columns(line.cells) for line in listing.lines[: _TITLES + 2]]
    named = [not head.keys().isdisjoint(_SURNAMES) for head in heads]
    if True not in named[: _TITLES + 1]:
        return None
    first = named.index(True)
    head = listing.lines[first]
    names = [cell for cell in head.cells if not _columns([cell]).keys().isdisjoint(_SURNAMES)]
    if len(set(names)) < len(names):  # another list stands beside this one
        what = f"столбец «{names[0]}» назван дважды"
        hint = "поставьте списки один под другим"
        raise InputError(Problem(listing.place(head, 0), what, hint))
    last = first + 1 if named[first + 1 : first + 2] == [True] else first
    repeated = [line.cells for line in listing.lines[first : last + 1]]  # on each printed page
    people = [
        line
        for line in listing.lines[last + 1 :]
        if line.cells not in repeated and not _is_number(line)
    ]
    columns = heads[first] | heads[last]
    people = [line for line in people if not _is_service(line, columns)]
    headed = _List(listing, columns, _joined(people, columns, listing.lines[first : last + 1]))
    if headed.columns.keys() & set(_SURNAMES) != {"either"}:
        return headed
    column = headed.columns.pop("either")
    headed.columns[_order(headed, head, column)] = column
    return headed


def _is_service(line: RosterLine, columns: dict[str, int]) -> bool:
    """Whether a site of learning has put a line of its own among the people."""
    at = [columns[key] for key in _SURNAMES if key in columns]
    texts = [line.cells[i].casefold().strip() for i in at if i < len(line.cells)]
    alone = all(not line.cells[i] for i in (columns.get("name"), columns.get("email"))
                if i is not None and i < len(line.cells))  # fmt: skip
    return alone and any(text in _SERVICE for text in texts)


_NAME = re.compile(r"[^\W\d_]+(?:[- .’'][^\W\d_]+)*\.?")


def _joined(
    people: list[RosterLine], columns: dict[str, int], head: Sequence[RosterLine]
) -> list[RosterLine]:
    """People with their names in one cell where the head above two or three of them is one."""
    key = next((key for key in ("full", "turned", "either", "surname") if key in columns), None)
    if key is None or (key == "surname" and "name" in columns):
        return people
    start = columns[key]
    end = start + 1
    while all(end < len(line.cells) and not line.cells[end] for line in head) and _are_names(
        [line.cells[end] for line in people if end < len(line.cells)]
    ):
        end += 1
    if end == start + 1:
        return people
    if key == "surname":
        columns["full"] = columns.pop(key)
    return [
        replace(line, cells=[*line.cells[:start], " ".join(filter(None, line.cells[start:end])),
                             *[""] * (end - start - 1), *line.cells[end:]])
        for line in people
    ]  # fmt: skip


def _are_names(cells: Sequence[str]) -> bool:
    known = [cell for cell in cells if cell]
    return bool(known) and all(_NAME.fullmatch(cell) for cell in known)


def _order(headed: _List, head: RosterLine, column: int) -> str:
    """Which of a surname and a name comes first under a head that does not say it.

    A patronymic stands behind a name; how a site writes one name it writes them all.
    """
    names = [line.cells[column].split() for line in headed.people if column < len(line.cells)]
    if names and all(words and "," in words[0] for words in names):  # «Иванов, Пётр»
        return "full"
    marks = [[_is_patronymic(word) for word in words[1:]] for words in names if len(words) == 3]
    second = {first for first, last in marks if first != last}
    if len(second) == 1 or not names:
        return "turned" if second == {True} else "full"
    what = f"столбец «{head.cells[column]}»: не видно, где фамилия, а где имя"
    hint = "назовите его «Фамилия Имя» или «Имя Фамилия», как в нём написано"
    raise InputError(Problem(headed.listing.place(head, column), what, hint))


def _is_patronymic(word: str) -> bool:
    return re.fullmatch(r"\w+(ич|вна|чна)", word.casefold()) is not None


def _is_number(line: RosterLine) -> bool:
    """Whether a line holds only its number: lists are numbered ahead."""
    return not line.faults and all(not c or c.rstrip(".)").isdigit() for c in line.cells)


def _refuse_another(path: Path, lists: list[_List]) -> None:
    """Two groups on two sheets must not become one; a sheet of marks repeats the people."""
    known, *others = ({_named(headed.given(line))[0].casefold() for line in headed.people}
                      for headed in lists)  # fmt: skip
    for other, headed in zip(others, lists[1:], strict=True):
        if other - known - {""}:
            first, second = lists[0].listing.title, headed.listing.title
            what = f"на листе «{second}» есть студенты, которых нет на листе «{first}»"
            raise refused(path, what, "оставьте в книге один лист со списком")


def _named(given: dict[str, str]) -> tuple[str, str]:
    """Surname and names."""
    surname, name = given.get("surname", ""), given.get("name", "")
    if not surname and "turned" in given:
        name, _, surname = given["turned"].rpartition(" ")
    elif not surname:
        full = given.get("full", "")
        surname, _, name = full.partition("," if "," in full else " ")
    return surname.strip(" ,"), f"{name.strip(' ,')} {given.get('patronymic', '')}".strip()


def _students(headed: _List) -> list[Student]:
    problems: list[Problem] = []
    students: list[Student] = []
    seen: dict[str, int] = {}
    twins: dict[str, str] = {}
    for line in headed.people:
        given, where = headed.given(line), headed.where(line)
        surname, name = _named(given)
        if faults := sorted(line.faults.keys() & headed.columns.values()):
            where = headed.listing.place(line, faults[0])
            problems.append(Problem(where, line.faults[faults[0]], "впишите текст"))
            continue
        words = given.get("turned", "").split()
        nobody = (words or surname.split(" "))[0].rstrip(":").casefold() in _NOBODY
        if nobody or not surname:
            what = f"«{surname}» — не фамилия" if nobody else "нет фамилии"
            problems.append(Problem(where, what, "впишите её или удалите строку"))
            continue
        if len(words) > 2 and not _is_patronymic(words[-2]):
            what, hint = "не видно, где кончается имя", "разделите их столбцами «Имя» и «Фамилия»"
            problems.append(Problem(where, f"«{' '.join(words)}»: {what}", hint))
            continue
        if any(len(value) > MAX_FIELD for value in given.values()):
            problems.append(Problem(where, "слишком длинный текст", "это не список группы"))
            continue
        if letters := foreign_letters(f"{surname} {name}"):
            what = f"«{surname} {name}»: среди букв одного алфавита другие: {letters}"
            problems.append(Problem(where, what, "наберите имя заново в одной раскладке"))
            continue
        group = given.get("group", "")
        key = given.get("id") or given.get("email") or f"{surname} {name}, {group}".strip(" ,")
        if key.casefold() in seen:
            what = f"студент «{key}» уже есть в строке {seen[key.casefold()]}"
            problems.append(Problem(where, what, "однофамильцам добавьте столбец «Номер»"))
            continue
        like = f"{twin(f'{surname} {name}')}, {group}"
        if like in twins and not given.get("id") and not given.get("email"):
            what = f"«{surname} {name}» и «{twins[like]}»: один это человек или два?"
            hint = "удалите лишнюю строку или добавьте столбец «Номер»"
            problems.append(Problem(where, what, hint))
            continue
        twins.setdefault(like, f"{surname} {name}")
        seen[key.casefold()] = line.number
        email, given_id = given.get("email", ""), given.get("id", "")
        students.append(Student(key, surname, name, group, email, given_id))
    if problems:
        raise InputError(problems[:50])
    return students


def _columns(head: list[str]) -> dict[str, int]:
    columns: dict[str, int] = {}
    for index, cell in enumerate(head):
        words = re.split(r"[\s.,*:()/]+", cell.casefold().replace("ё", "е"))
        word = " ".join(word for word in words if word and word not in _BESIDES)
        for key, heads in _HEADS.items():
            if word in heads:
                columns.setdefault(key, index)
    return columns
