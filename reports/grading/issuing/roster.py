"""The list of a group, as Excel, Moodle or a person writes it: the same rules for any file."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from reports.grading.issuing.listing import MAX_FIELD, Line, Listing, listings, refused
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
    "email": ("email", "e-mail", "почта", "адрес электронной почты", "email address"),
}  # fmt: skip
_SURNAMES = ("surname", "full", "turned", "either")  # columns with a surname, the plainest first
# What a head says besides, and what stands among the people and is none.
_BESIDES = frozenset(("студента", "студентов", "обучающегося", "полностью", "учебная"))
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
    """Students of a CSV file (UTF-8 or Windows-1251; comma, semicolon or tab) or of an Excel book.

    Raises:
        InputError: everything that is wrong with it.
    """
    found = listings(path)
    if {CONTENTS_SHEET, INPUT_SHEET} <= {listing.title for listing in found}:
        raise refused(path, "это рабочая книга, а не список группы", "укажите файл списка")
    if not any(listing.lines for listing in found):
        raise refused(path, "список пуст", "нужны столбцы: Фамилия;Имя;Группа")
    lists = [made for listing in found if (made := _headed(listing)) is not None]
    if not lists:
        what = "нет столбца «Фамилия» или «ФИО»"
        raise refused(path, what, "первая строка: Фамилия;Имя;Группа;Номер;Email")
    lists = [made for made in lists if made.people]
    if not lists:
        raise refused(path, "в списке нет ни одного студента", "впишите их под заголовком")
    if len(lists[0].people) > MAX_STUDENTS:
        raise refused(path, f"в списке больше {MAX_STUDENTS} студентов", "разделите его")
    _refuse_another(path, lists)
    return _students(lists[0])


@dataclass(frozen=True, slots=True)
class _List:
    """People under a head that names the columns."""

    listing: Listing
    columns: dict[str, int]
    people: list[Line]

    def given(self, line: Line) -> dict[str, str]:
        """What stands under each known head."""
        cells = line.cells
        return {key: cells[i] if i < len(cells) else "" for key, i in self.columns.items()}

    def where(self, line: Line) -> str:
        """The cell of a surname, for messages."""
        return self.listing.place(
            line, next(self.columns[k] for k in _SURNAMES if k in self.columns)
        )


def _headed(listing: Listing) -> _List | None:
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
    made = _List(listing, heads[first] | heads[last], people)
    if made.columns.keys() & set(_SURNAMES) != {"either"}:
        return made
    column = made.columns.pop("either")
    made.columns[_order(made, head, column)] = column
    return made


def _order(made: _List, head: Line, column: int) -> str:
    """Which of a surname and a name comes first under a head that does not say it.

    A patronymic stands behind a name; how a site writes one name it writes them all.
    """
    names = [line.cells[column].split() for line in made.people if column < len(line.cells)]
    marks = [[_is_patronymic(word) for word in words[1:]] for words in names if len(words) == 3]
    second = {first for first, last in marks if first != last}
    if len(second) == 1 or not names:
        return "turned" if second == {True} else "full"
    what = f"столбец «{head.cells[column]}»: не видно, где фамилия, а где имя"
    hint = "назовите его «Фамилия Имя» или «Имя Фамилия», как в нём написано"
    raise InputError(Problem(made.listing.place(head, column), what, hint))


def _is_patronymic(word: str) -> bool:
    return re.fullmatch(r"\w+(ич|вна|чна)", word.casefold()) is not None


def _is_number(line: Line) -> bool:
    """Whether a line holds only its number: lists are numbered ahead."""
    return not line.faults and all(not c or c.rstrip(".)").isdigit() for c in line.cells)


def _refuse_another(path: Path, lists: list[_List]) -> None:
    """Two groups on two sheets must not become one; a sheet of marks repeats the people."""
    known, *others = ({_named(made.given(line))[0].casefold() for line in made.people}
                      for made in lists)  # fmt: skip
    for other, made in zip(others, lists[1:], strict=True):
        if other - known - {""}:
            first, second = lists[0].listing.title, made.listing.title
            what = f"на листе «{second}» есть студенты, которых нет на листе «{first}»"
            raise refused(path, what, "оставьте в книге один лист со списком")


def _named(given: dict[str, str]) -> tuple[str, str]:
    """Surname and names."""
    surname, name = given.get("surname", ""), given.get("name", "")
    if not surname and "turned" in given:
        name, _, surname = given["turned"].rpartition(" ")
    elif not surname:
        surname, _, name = given.get("full", "").partition(" ")
    return surname, f"{name} {given.get('patronymic', '')}".strip()


def _students(made: _List) -> list[Student]:
    problems: list[Problem] = []
    students: list[Student] = []
    seen: dict[str, int] = {}
    for line in made.people:
        given, where = made.given(line), made.where(line)
        surname, name = _named(given)
        if faults := sorted(line.faults.keys() & made.columns.values()):
            where = made.listing.place(line, faults[0])
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
        group = given.get("group", "")
        key = given.get("id") or given.get("email") or f"{surname} {name}, {group}".strip(" ,")
        if key.casefold() in seen:
            what = f"студент «{key}» уже есть в строке {seen[key.casefold()]}"
            problems.append(Problem(where, what, "однофамильцам добавьте столбец «Номер»"))
            continue
        seen[key.casefold()] = line.number
        email, given_id = given.get("email", ""), given.get("id", "")
        students.append(Student(key, surname, name, group, email, given_id))
    if problems:
        raise InputError(problems[:50])
    return students


def _columns(head: list[str]) -> dict[str, int]:
    found: dict[str, int] = {}
    for index, cell in enumerate(head):
        words = re.split(r"[\s.,*:()/]+", cell.casefold().replace("ё", "е"))
        word = " ".join(word for word in words if word and word not in _BESIDES)
        for key, heads in _HEADS.items():
            if word in heads:
                found.setdefault(key, index)
    return found
