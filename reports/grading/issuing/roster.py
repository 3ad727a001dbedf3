"""The list of a group: CSV as Excel, Moodle or a person writes it."""

from __future__ import annotations

import csv
import io
import unicodedata
from dataclasses import dataclass
from pathlib import Path

from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import reason

MAX_BYTES, MAX_STUDENTS, MAX_FIELD = 2_000_000, 2000, 200

_HEADS = {
    "surname": ("фамилия", "surname", "last name", "lastname", "фамилия студента"),
    "name": ("имя", "имя и отчество", "имя отчество", "name", "first name", "firstname"),
    "patronymic": ("отчество", "middle name"),
    "full": ("фио", "ф.и.о.", "ф. и. о.", "фио студента", "студент", "student", "full name",
             "полное имя", "фамилия и имя", "фамилия имя отчество", "фамилия, имя, отчество"),
    "group": ("группа", "group", "groups", "группы"),
    "id": ("номер", "шифр", "id", "id number", "индивидуальный номер", "логин", "login",
           "username", "зачетка", "зачётка", "номер зачетки", "номер зачётки"),
    "email": ("email", "e-mail", "почта", "адрес электронной почты", "email address"),
}  # fmt: skip


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
    """Students of a CSV file: UTF-8 or Windows-1251, comma, semicolon or tab.

    Raises:
        InputError: everything that is wrong with it.
    """
    text = _text(path)
    sample = text.lstrip("\r\n").partition("\n")[0]
    delimiter = max(";,\t", key=sample.count)
    try:
        rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True))
    except csv.Error:
        raise _refused(path, "это не CSV: не закрыта кавычка", "сохраните список заново") from None
    rows = [[_clean(cell) for cell in row] for row in rows]
    numbered = [(i, row) for i, row in enumerate(rows, 1) if any(row)]
    if numbered and numbered[0][1][0].casefold() == "sep=":  # Excel's word on the delimiter
        del numbered[0]
    if not numbered:
        raise _refused(path, "список пуст", "нужны столбцы: Фамилия;Имя;Группа")
    columns = _columns(numbered[0][1])
    if "full" not in columns and "surname" not in columns:
        what = "в первой строке нет столбца «Фамилия» или «ФИО»"
        raise _refused(path, what, "первая строка: Фамилия;Имя;Группа;Номер;Email")
    if len(numbered) == 1:
        raise _refused(path, "в списке нет ни одного студента", "впишите их под заголовком")
    if len(numbered) > MAX_STUDENTS + 1:
        raise _refused(path, f"в списке больше {MAX_STUDENTS} студентов", "разделите его")
    return _students(path, columns, numbered[1:])


def _students(
    path: Path, columns: dict[str, int], rows: list[tuple[int, list[str]]]
) -> list[Student]:
    problems: list[Problem] = []
    students: list[Student] = []
    seen: dict[str, int] = {}
    for number, row in rows:
        given = {key: row[i] if i < len(row) else "" for key, i in columns.items()}
        surname, name = given.get("surname", ""), given.get("name", "")
        if not surname:
            surname, _, name = given.get("full", "").partition(" ")
        name = f"{name} {given.get('patronymic', '')}".strip()
        where = f"{path.name}, строка {number}"
        if not surname:
            problems.append(Problem(where, "нет фамилии", "впишите её или удалите строку"))
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
        seen[key.casefold()] = number
        email, given_id = given.get("email", ""), given.get("id", "")
        students.append(Student(key, surname, name, group, email, given_id))
    if problems:
        raise InputError(problems[:50])
    return students


def _columns(head: list[str]) -> dict[str, int]:
    found: dict[str, int] = {}
    for index, cell in enumerate(head):
        word = cell.casefold().strip(" *:")
        for key, words in _HEADS.items():
            if word in words:
                found.setdefault(key, index)
    return found


def _text(path: Path) -> str:
    try:
        with path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except OSError as error:
        hint = "проверьте имя и путь"
        raise _refused(path, f"файл не читается: {reason(error)}", hint) from None
    if len(data) > MAX_BYTES:
        raise _refused(path, "файл больше 2 МБ", "это не список группы")
    if data.startswith((b"PK\x03\x04", b"\xd0\xcf\x11\xe0")):
        raise _refused(path, "это книга Excel, а нужен CSV", "сохраните список как CSV")
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise _refused(path, "кодировка UTF-16", "сохраните как «CSV UTF-8»")
    if b"\x00" in data:
        raise _refused(path, "это двоичный файл, а нужен CSV", "выберите другой файл")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        pass
    text = data.decode("cp1251", errors="replace")
    letters = [char for char in text if char.isalpha()]
    russian = sum("а" <= char.casefold() <= "я" or char in "ёЁ" for char in letters)
    if "\ufffd" in text or russian < len(letters) / 3:
        raise _refused(path, "кодировка не UTF-8 и не Windows-1251", "сохраните как «CSV UTF-8»")
    return text


def _clean(cell: str) -> str:
    text = unicodedata.normalize("NFC", cell)
    return one_line(text, MAX_FIELD + 1)


def _refused(path: Path, what: str, hint: str) -> InputError:
    return InputError(Problem(path.name, what, hint))
