"""Rosters: lists of students as Excel, Moodle and people write them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path

from reports.grading.issuing.listings import (
    A_DATE,
    MAX_FIELD,
    RosterLine,
    RosterListing,
    listings,
    refused,
)
from reports.grading.issuing.names import foreign_letters, twin
from reports.shared.errors import InputError, Problem
from reports.workbook.layout import CONTENTS_SHEET, INPUT_SHEET

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
    "extension": ("срок", "продление", "продлено до", "отсрочка", "срок сдачи", "extension",
                  "deadline", "due"),
    "email": ("email", "e-mail", "почта", "адрес электронной почты", "email address"),
}  # fmt: skip
_SURNAMES = ("surname", "full", "turned", "either")  # columns with a surname, the plainest first
# What a head says besides, and what stands among the people and is none.
_BESIDES = frozenset(("студента", "студентов", "обучающегося", "полностью", "учебная"))
# Lines of Canvas and Google Classroom between the head and the people.
_SERVICE = frozenset(("points possible", "student, test", "test student", "read only", "date",
                      "points", "дата", "баллы", "максимальный балл", "class average",
                      "manual posting", "(read only)", "публикация вручную",
                      "(только для чтения)"))  # fmt: skip
_NOBODY = frozenset(("группа", "итого", "всего", "куратор", "староста", "преподаватель"))
# Remarks beside a name, in a column without a head.
_REMARKS = _NOBODY | frozenset(("профорг", "зам", "заместитель", "академ", "отпуск", "отчислен",
                                "отчислена", "переведен", "переведена", "бюджет", "контракт",
                                "платно", "целевое", "декрет", "должник"))  # fmt: skip
_LETTERED = re.compile(r"(?:[^\W\d_]|[IVXLC]+)\)\s*|[IVXLC]+\.\s+")
_FEW = 3  # people of whom two may well have one name
_NAME = re.compile(r"[^\W\d_]+(?:[- .’'][^\W\d_]+)*\.?")
_MORE = re.compile(r"\+?\s*(\d{1,3})\s*(д|дн|дня|дней|день|сут\w*|ч|час|часа|часов|d|h)\.?")


@dataclass(frozen=True, slots=True)
class Student:
    """A student; ``id`` tells namesakes apart and is unique in the list."""

    id: str
    surname: str
    name: str
    group: str = ""
    email: str = ""
    number: str = ""  # as the list gives it
    extension: str = ""  # an own deadline (ISO), or hours more: "+48"

    @property
    def full(self) -> str:
        """Surname first."""
        return f"{self.surname} {self.name}".strip()


@dataclass(frozen=True, slots=True)
class Roster:
    """The students of a list, and its lines with a name that are no student: where and why."""

    students: list[Student]
    left: tuple[str, ...]


def read_roster(path: Path) -> list[Student]:
    """Students of a list.

    Raises:
        InputError: everything that is wrong with it.
    """
    return roster_of(path).students


def roster_of(path: Path) -> Roster:
    """Return list of a CSV file (any usual encoding; comma, semicolon or tab) or of an Excel book.

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
        problem = "нет столбца «Фамилия» или «ФИО»"
        raise refused(path, problem, "первая строка: Фамилия;Имя;Группа;Номер;Email")
    lists = [headed for headed in lists if headed.people]
    if not lists:
        raise refused(path, "в списке нет ни одного студента", "впишите их под заголовком")
    if len(lists[0].people) > MAX_STUDENTS:
        raise refused(path, f"в списке больше {MAX_STUDENTS} студентов", "разделите его")
    _refuse_another(path, lists)
    return Roster(_students(lists[0]), lists[0].left)


@dataclass(frozen=True, slots=True)
class _List:
    """People under a head that names the columns."""

    listing: RosterListing
    columns: dict[str, int]
    people: list[RosterLine]
    left: tuple[str, ...] = ()

    def given(self, line: RosterLine) -> dict[str, str]:
        """Texts under each known head."""
        cells = line.cells
        return {key: cells[i] if i < len(cells) else "" for key, i in self.columns.items()}

    def text(self, line: RosterLine) -> str:
        """Text under the heads of names."""
        names = self.given(line)
        return " ".join(names[key] for key in (*_SURNAMES, "name") if names.get(key))

    def where(self, line: RosterLine) -> str:
        """Return the cell of a surname, for messages."""
        return self.listing.place(
            line, next(self.columns[k] for k in _SURNAMES if k in self.columns)
        )


def _headed(listing: RosterListing) -> _List | None:
    """Return the list under a head of one or two lines; titles may stand above it."""
    heads = [_columns(line.cells) for line in listing.lines[: _TITLES + 2]]
    named = [not head.keys().isdisjoint(_SURNAMES) for head in heads]
    if True not in named[: _TITLES + 1]:
        return None
    first = named.index(True)
    head = listing.lines[first]
    names = [cell for cell in head.cells if not _columns([cell]).keys().isdisjoint(_SURNAMES)]
    if len(set(names)) < len(names):  # another list stands beside this one
        problem = f"столбец «{names[0]}» назван дважды"
        hint = "поставьте списки один под другим"
        raise InputError(Problem(listing.place(head, 0), problem, hint))
    second = listing.lines[first + 1 : first + 2]
    last = first + 1 if second and _continues(head, second[0]) else first
    columns = heads[first] | heads[last]
    lines = [_unmarked(line, columns) for line in listing.lines[last + 1 :] if not _is_bare(line)]
    repeated = [line.cells for line in listing.lines[first : last + 1]]  # on each printed page
    why = {
        line.number: "повтор заголовка" if line.cells in repeated else "служебная строка"
        for line in lines
        if line.cells in repeated or _is_service(line, columns)
    }
    people = [line for line in lines if line.number not in why]
    headed = _List(listing, columns, _joined(people, columns, listing.lines[first : last + 1]))
    left = [
        f"{headed.where(line)}: «{name}» — {why[line.number]}"
        for line in lines
        if line.number in why and (name := headed.text(line))
    ]
    headed = replace(headed, left=tuple(left))
    if headed.columns.keys() & set(_SURNAMES) != {"either"}:
        return headed
    column = headed.columns.pop("either")
    headed.columns[_order(headed, head, column)] = column
    return headed


def _continues(head: RosterLine, line: RosterLine) -> bool:
    """Whether a line is the lower half of a head: it names what the upper half leaves open.

    A person's line has a name under the head of the names, whatever stands in other columns.
    """
    above = head.cells + [""] * (len(line.cells) - len(head.cells))
    kinds = [_columns([cell]).keys() & set(_SURNAMES) for cell in above]
    named = [bool(_columns([cell]).keys() & set(_SURNAMES)) for cell in line.cells]
    pairs = list(zip(above, kinds, named, line.cells, strict=False))
    if any(kind and not name and any(map(str.isalpha, cell)) for _, kind, name, cell in pairs):
        return False
    return any(name and (kind or not cell) for cell, kind, name, _ in pairs)


def _unmarked(line: RosterLine, columns: dict[str, int]) -> RosterLine:
    """Strip numbers, bullets and other signs around the names of a line."""
    cells = list(line.cells)
    for index in {columns[key] for key in _SURNAMES if key in columns}:
        if index < len(cells):
            cells[index] = _without_mark(cells[index])
    return replace(line, cells=cells)


def _without_mark(text: str) -> str:
    begin = next((i for i, char in enumerate(text) if char.isalpha() or char in "«\"'’(["), None)
    if begin is None:
        return ""
    return re.sub(r"[\s*•·,;]+$", "", _LETTERED.sub("", text[begin:], count=1))


def _is_service(line: RosterLine, columns: dict[str, int]) -> bool:
    """Whether a line is the learning system's own, no student."""
    filled = {cell.casefold().strip() for cell in line.cells if cell}
    at = [columns[key] for key in _SURNAMES if key in columns]
    texts = {line.cells[i].casefold().strip() for i in at if i < len(line.cells)} - {""}
    alone = all(not line.cells[i] for i in (columns.get("name"), columns.get("email"))
                if i is not None and i < len(line.cells))  # fmt: skip
    return alone and bool(texts & _SERVICE or (not texts and filled & _SERVICE))


def _joined(
    people: list[RosterLine], columns: dict[str, int], head: Sequence[RosterLine]
) -> list[RosterLine]:
    """Join names whose two or three cells share one head."""
    key = next((key for key in ("full", "turned", "either", "surname") if key in columns), None)
    if key is None or (key == "surname" and "name" in columns):
        return people
    start = columns[key]
    end = start + 1
    while all(end < len(line.cells) and not line.cells[end] for line in head) and _are_names(
        people, start, end
    ):
        end += 1
    if end == start + 1:
        return people
    if key == "surname":
        columns["full"] = columns.pop(key)
    return [
        replace(line, cells=[*line.cells[:start], _together(line.cells[start:end]),
                             *[""] * (end - start - 1), *line.cells[end:]])
        for line in people
    ]  # fmt: skip


def _together(cells: Sequence[str]) -> str:
    """Join the parts of a name from several cells; a remark is no part."""
    return " ".join([*filter(None, cells[:1]), *filter(_is_name, cells[1:])])


def _is_name(text: str) -> bool:
    plain = _NAME.fullmatch(text) is not None and text[0].isupper()
    return (
        plain and text.split(maxsplit=1)[0].casefold().replace("ё", "е").rstrip(".") not in _REMARKS
    )


def _are_names(people: Sequence[RosterLine], start: int, end: int) -> bool:
    """Whether a column without a head continues the names; a remark does not.

    Behind a surname nearly everybody has a name of his own, behind a name a patronymic.
    """
    pairs = [
        (_together(line.cells[start:end]).split(), line.cells[end])
        for line in people
        if end < len(line.cells) and any(line.cells[start:end])
    ]
    names = [text for _, text in pairs if _is_name(text)]
    if not names or 2 * len(names) <= sum(bool(text) for _, text in pairs):
        return False
    if 2 * sum(len(words) > 1 for words, _ in pairs) > len(pairs):
        return 2 * sum(_is_patronymic(name.split()[-1]) for name in names) > len(names)
    return 2 * len(names) > len(pairs) and (len(pairs) < _FEW or len(set(names)) > 1)


def _order(headed: _List, head: RosterLine, column: int) -> str:
    """Order of surname and given name under a head that leaves it open.

    A patronymic stands behind a name; how a site writes one name it writes them all.
    """
    names = [line.cells[column].split() for line in headed.people if column < len(line.cells)]
    if names and all(words and "," in words[0] for words in names):  # «Иванов, Пётр»
        return "full"
    marks = [[_is_patronymic(word) for word in words[1:]] for words in names if len(words) == 3]
    second = {first for first, last in marks if first != last}
    if len(second) == 1 or not names:
        return "turned" if second == {True} else "full"
    problem = f"столбец «{head.cells[column]}»: не видно, где фамилия, а где имя"
    hint = "назовите его «Фамилия Имя» или «Имя Фамилия», как в нём написано"
    raise InputError(Problem(headed.listing.place(head, column), problem, hint))


def _is_patronymic(word: str) -> bool:
    return re.fullmatch(r"\w+(ич|вна|чна)|оглы|кызы|улы", word.casefold()) is not None


def _is_bare(line: RosterLine) -> bool:
    """Whether a line holds only its number: lists are numbered ahead."""
    return not line.faults and not any(char.isalpha() for cell in line.cells for char in cell)


def _refuse_another(path: Path, lists: list[_List]) -> None:
    """Refuse a second sheet with other students; a sheet of marks repeats the same."""
    people, *others = ({_named(headed.given(line))[0].casefold() for line in headed.people}
                      for headed in lists)  # fmt: skip
    for other, headed in zip(others, lists[1:], strict=True):
        if other - people - {""}:
            first, second = lists[0].listing.title, headed.listing.title
            problem = f"на листе «{second}» есть студенты, которых нет на листе «{first}»"
            raise refused(path, problem, "оставьте в книге один лист со списком")


def _named(fields: dict[str, str]) -> tuple[str, str]:
    """Surname and names."""
    surname, name = fields.get("surname", ""), fields.get("name", "")
    if not surname and "turned" in fields:
        name, _, surname = fields["turned"].rpartition(" ")
    elif not surname:
        full = fields.get("full", "")
        surname, _, name = full.partition("," if "," in full else " ")
    return surname.strip(" ,"), f"{name.strip(' ,')} {fields.get('patronymic', '')}".strip()


def _students(headed: _List) -> list[Student]:
    problems: list[Problem] = []
    students: list[Student] = []
    seen: dict[str, int] = {}
    twins: dict[str, str] = {}
    for line in headed.people:
        student = _student(headed, line)
        if isinstance(student, Problem):
            problems.append(student)
            continue
        where, key = headed.where(line), student.id.casefold()
        like = f"{twin(student.full)}, {student.group}"
        if key in seen:
            problem = f"студент «{student.id}» уже есть в строке {seen[key]}"
            problems.append(Problem(where, problem, "однофамильцам добавьте столбец «Номер»"))
        elif like in twins and not student.number and not student.email:
            problem = f"«{student.full}» и «{twins[like]}»: один это человек или два?"
            hint = "удалите лишнюю строку или добавьте столбец «Номер»"
            problems.append(Problem(where, problem, hint))
        else:
            seen[key] = line.number
            twins.setdefault(like, student.full)
            students.append(student)
    if problems:
        raise InputError(problems[:50])
    return students


def _student(headed: _List, line: RosterLine) -> Student | Problem:
    """Return the student of a line, or what is wrong with it."""
    fields, where = headed.given(line), headed.where(line)
    surname, name = _named(fields)
    column = headed.columns.get("extension")
    remaining = {i for i, why in line.faults.items() if i != column or why != A_DATE}
    if faults := sorted(remaining & set(headed.columns.values())):
        where = headed.listing.place(line, faults[0])
        return Problem(where, line.faults[faults[0]], "впишите текст")
    words = fields.get("turned", "").split()
    nobody = (words or surname.split(" "))[0].rstrip(":").casefold() in _NOBODY
    nobody = nobody or bool(surname and not name and _columns([surname]))
    if nobody or not surname:
        problem = f"«{surname}» — не фамилия" if nobody else "нет фамилии"
        return Problem(where, problem, "впишите её или удалите строку")
    if len(words) > 2 and not _is_patronymic(words[-2]):
        problem, hint = "не видно, где кончается имя", "разделите их столбцами «Имя» и «Фамилия»"
        return Problem(where, f"«{' '.join(words)}»: {problem}", hint)
    if any(len(value) > MAX_FIELD for value in fields.values()):
        return Problem(where, "слишком длинный текст", "это не список группы")
    if letters := foreign_letters(f"{surname} {name}"):
        problem = f"«{surname} {name}»: среди букв одного алфавита другие: {letters}"
        return Problem(where, problem, "наберите имя заново в одной раскладке")
    extension = _extension(fields.get("extension", ""))
    if extension is None:
        problem = f"срок «{fields['extension']}» непонятен"
        hint = "нужна дата 25.12.2026, дата и время 25.12.2026 18:00 или «+2 дня», «+48 ч»"
        return Problem(where, problem, hint)
    group = fields.get("group", "")
    key = fields.get("id") or fields.get("email") or f"{surname} {name}, {group}".strip(" ,")
    return Student(key, surname, name, group, fields.get("email", ""), fields.get("id", ""),
                   extension)  # fmt: skip


def _extension(text: str) -> str | None:
    """Return own deadline as ISO or hours more, empty where none is given; None: not understood."""
    text = text.strip().casefold()
    if not text:
        return ""
    if more := _MORE.fullmatch(text):
        return f"+{int(more[1]) * (1 if more[2][0] in 'чh' else 24)}"
    for form in ("%d.%m.%Y %H:%M", "%Y-%m-%d %H:%M:%S", "%Y-%m-%d %H:%M", "%Y-%m-%dt%H:%M",
                 "%d.%m.%Y", "%Y-%m-%d"):  # fmt: skip
        try:
            moment = datetime.strptime(text, form)
        except ValueError:
            continue
        ends = "%h" not in form.casefold() or (moment.hour, moment.minute) == (0, 0)
        return (moment.replace(hour=23, minute=59) if ends else moment).isoformat()
    return None


def _columns(head: list[str]) -> dict[str, int]:
    columns: dict[str, int] = {}
    for index, cell in enumerate(head):
        words = re.split(r"[\s.,*:()/]+", cell.casefold().replace("ё", "е"))
        word = " ".join(word for word in words if word and word not in _BESIDES)
        for key, heads in _HEADS.items():
            if word in heads:
                columns.setdefault(key, index)
    return columns
