"""The list of a group as people make it: CSV and books of Excel under the same rules."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable, Sequence
from datetime import date
from pathlib import Path

import pytest
import xlsxwriter
from openpyxl import Workbook
from openpyxl.worksheet.worksheet import Worksheet

from reports.grading.issuing.roster import read_roster, roster_of
from reports.shared.errors import InputError
from reports.workbook.layout import CONTENTS_SHEET, INPUT_SHEET

PEOPLE = 'Фамилия;Имя;Группа\nИванов;Иван;ДВС-1\nПётр "Первый";Анна;ДВС-1\n'


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "cp1251", "cp866", "koi8-r", "mac-cyrillic", "utf-16"]
)
@pytest.mark.parametrize("delimiter", [";", ",", "\t"])
def test_a_roster_in_any_usual_form(tmp_path, encoding, delimiter):
    path = tmp_path / "group.csv"
    text = PEOPLE.replace('"Первый"', "Ёлкин").replace(";", delimiter).replace("\n", "\r\n")
    path.write_bytes(text.encode(encoding))
    actual = read_roster(path)
    assert [student.full for student in actual] == ["Иванов Иван", "Пётр Ёлкин Анна"]
    assert actual[0].group == "ДВС-1"


@pytest.mark.parametrize("delimiter", [";", ",", "\t"])
@pytest.mark.parametrize("first", ["sep=@\r\n", "\r\n\r\n"])
@pytest.mark.parametrize(
    "head",
    ["Ф. И. О.", "Ф.И.О. студента", "Фамилия Имя Отчество", "ФИО (полностью)",
     "Ф.И.О. обучающегося", "Фамилия имя отчество студента", "Студенты"],
)  # fmt: skip
def test_a_roster_may_begin_with_what_excel_puts_before_it(tmp_path, delimiter, first, head):
    path = tmp_path / "group.csv"
    text = f"{first}{head}@Группа\r\nИванов Иван Ильич@Д-1\r\n"
    path.write_text(text.replace("@", delimiter), encoding="utf-8-sig", newline="")
    (actual,) = read_roster(path)
    assert (actual.surname, actual.name, actual.group) == ("Иванов", "Иван Ильич", "Д-1")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "список пуст"),
        ("Фамилия;Имя\n".encode(), "нет ни одного студента"),
        ("Иванов;Иван\nПетров;Пётр\n".encode(), "нет столбца «Фамилия»"),
        ("Фамилия;Имя\nИванов;Иван\nИванов;Иван\n".encode(), "уже есть в строке 2"),
        ("Фамилия;Имя\n;Иван\n".encode(), "строка 2: нет фамилии"),
        ('Фамилия;Имя\n"Иванов;Иван\n'.encode(), "не закрыта кавычка"),
        (b"PK\x03\x04xxxx", "файл .xlsx повреждён"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "это старый или зашифрованный документ Office"),
        ("Фамилия;Имя\nКузнецов;Пётр\nКузнецов;Петр\n".encode(), "один это человек или два"),
        ("Фамилия;Имя\nKoзлов;Пётр\n".encode(), "«Koзлов Пётр»: .* другие: Ko"),
        (b"\x80\x81\xff\xfa surname name\n\xf0\xf1\n", "не UTF-8 и не Windows-1251"),
    ],
)
def test_a_bad_roster_is_one_clear_line(tmp_path, data, words):
    path = tmp_path / "group.csv"
    path.write_bytes(data)
    with pytest.raises(InputError, match=words) as caught:
        read_roster(path)
    assert len(caught.value.lines()) == 1


@pytest.mark.parametrize(
    ("head", "names", "told"),
    [
        ("Имя / Фамилия", "Иван Петров", "Петров Иван"),
        ("Имя и фамилия", "Иван Ильич Петров", "Петров Иван Ильич"),
        ("Имя/Фамилия;Отчество", "Иван Петров;Ильич", "Петров Иван Ильич"),
        ("First name / Last name", "Mary Smith-Jones", "Smith-Jones Mary"),
        ("Имя;Фамилия", "Анна Мария;Петрова", "Петрова Анна Мария"),
        ("Полное имя;Имя;Фамилия", "Иван Петров;Иван;Петров", "Петров Иван"),
        ("Полное имя", "Петров Иван Ильич\nИван Иванов", "Петров Иван Ильич"),
        ("Full name", "Анна Ильинична Ким\nИван Иванов", "Ким Анна Ильинична"),
        ("Фамилия / Имя", "Петров Иван", "Петров Иван"),
        ("Фамилия Имя", '"Иванов, Пётр"', "Иванов Пётр"),
        ("Student", '"Петров, Иван"', "Петров Иван"),
        ("Student,ID", 'Points Possible,\n"Петров, Иван",1\n"Student, Test",9', "Петров Иван"),
        ("Фамилия,Имя", "Дата,\nБаллы,\nПетров,Иван", "Петров Иван"),
        ("№;ФИО;;;Группа", "1;Петров;Иван;Ильич;ДВС-1", "Петров Иван Ильич"),
        ("Фамилия;;Группа", "Петров;Иван;ДВС-1", "Петров Иван"),
        ("Полное имя", "Ким Иван Ильич\nАнна Ильинична Ким", "не видно, где фамилия"),
        ("Full name", "Иван Петров\nПётр Иванов", "не видно, где фамилия"),
        ("Student", "John Smith", "не видно, где фамилия"),
        ("Имя Фамилия", "Группа: Д-2", "«Д-2» — не фамилия"),
        ("Имя Фамилия", "Анна Мария Петрова", "«Анна Мария Петрова»: не видно, где кончается имя"),
    ],
)  # fmt: skip
def test_a_surname_is_found_wherever_it_stands(tmp_path, head, names, told):
    path = tmp_path / "group.csv"
    path.write_text(f"{head}\n{names}\n", encoding="utf-8")
    if "не " in told:
        with pytest.raises(InputError, match=told):
            read_roster(path)
    else:
        assert read_roster(path)[0].full == told


ABC = ["Абрамова Анна", "Белов Борис", "Власов Виктор"]


@pytest.mark.parametrize(
    "text",
    [
        # A word of a head in the first student's line.
        "Имя,Фамилия,Роли\nАнна,Абрамова,Студент\nБорис,Белов,Студент\nВиктор,Власов,Студент",
        "ФИО;Статус\nАбрамова Анна;Обучающийся\nБелов Борис;Обучающийся\nВласов Виктор;Обучающийся",
        "ФИО;\nАбрамова Анна;Student\nБелов Борис;\nВласов Виктор;Student",
        "Фамилия;Имя;Роль;Группы\nАбрамова;Анна;Студенты;Группа\nБелов;Борис;;\nВласов;Виктор;;",
        "Студенты\n№;ФИО;Статус\n1;Абрамова Анна;ФИО\n2;Белов Борис;\n3;Власов Виктор;Имя",
        # A remark in a column without a head.
        "№;ФИО;;Группа\n1;Абрамова Анна;староста;Д\n2;Белов Борис;;Д\n3;Власов Виктор;;Д",
        "ФИО;\nАбрамова Анна;Староста\nБелов Борис;Бюджет\nВласов Виктор;Контракт",
        "ФИО;;\nАбрамова;Анна;Бюджет\nБелов;Борис;Бюджет\nВласов;Виктор;Бюджет",
        "ФИО;\nАбрамова Анна;да\nБелов Борис;нет\nВласов Виктор;да",
        "Фамилия;;\nАбрамова;Анна;\nБелов;Борис;академ\nВласов;Виктор;Академ.",
        # A sign before the name.
        "ФИО\n1. Абрамова Анна\n2. Белов Борис\n3. Власов Виктор",
        "ФИО\n№1 Абрамова Анна\n№ 2 Белов Борис\n№3. Власов Виктор",
        "ФИО\n• Абрамова Анна\n– Белов Борис\n✔ Власов Виктор*",
        "Фамилия;Имя\n1)Абрамова;Анна\n2) Белов;Борис\n3 - Власов;Виктор",
        "ФИО\nа) Абрамова Анна\nII. Белов Борис\n[3] Власов Виктор".replace("[3]", "3:"),
        "№;ФИО\n№1;Абрамова Анна\n№2;Белов Борис\n№3;Власов Виктор\n№4;\n•;",
        # Lines of Canvas.
        'Student,ID,x\n,,Manual Posting\n    Points Possible,,(read only)\n"Абрамова, Анна",1,\n'
        '"Белов, Борис",2,\n"Власов, Виктор",3,',
        'Student,ID\n,(read only)\n"Абрамова, Анна",1\n"Белов, Борис",2\n"Власов, Виктор",3',
        'Student,ID\nManual Posting,\n"Абрамова, Анна",1\n"Белов, Борис",2\n"Власов, Виктор",3',
    ],
)  # fmt: skip
def test_no_student_is_lost_nor_called_by_what_stands_beside_the_name(tmp_path, text):
    path = tmp_path / "group.csv"
    path.write_text(f"{text}\n", encoding="utf-8")
    assert [student.full for student in read_roster(path)] == ABC


def test_patronymics_stand_in_a_column_of_their_own(tmp_path):
    """And a remark among them is none."""
    path = tmp_path / "group.csv"
    lines = [
        "ФИО;",
        "Абрамова Анна;Ильинична",
        "Белов Борис;Ильич",
        "Ли Чен;староста",
        "Али Вагиф;",
    ]
    path.write_text("\n".join(lines), encoding="utf-8")
    names = ["Абрамова Анна Ильинична", "Белов Борис Ильич", "Ли Чен", "Али Вагиф"]
    assert [student.full for student in read_roster(path)] == names


def test_lines_that_are_left_out_are_told_with_their_reason(tmp_path):
    path = tmp_path / "group.csv"
    lines = [
        "Student,ID",
        "Points Possible,",
        '"Абрамова, Анна",1',
        "Student,ID",
        "3,",
        '"Белов, Б",2',
    ]
    path.write_text("\n".join(lines), encoding="utf-8")
    roster = roster_of(path)
    assert len(roster.students) == 2
    assert roster.left == (
        "group.csv, строка 2: «Points Possible» — служебная строка",
        "group.csv, строка 4: «Student» — повтор заголовка",
    )


@pytest.mark.parametrize("word", ["Студент", "Обучающийся", "ФИО"])
def test_a_word_of_a_head_is_nobodys_name(tmp_path, word):
    """The list of a column that the program does not know."""
    path = tmp_path / "group.csv"
    path.write_text(f"Слушатель;{word}\nАбрамова;{word}\nБелов;Студент\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"«Студент» — не фамилия|нет ни одного студента"):
        read_roster(path)


# --- books of Excel --------------------------------------------------------------------------

HEAD = ("Фамилия", "Имя", "Отчество", "Группа")
IVANOV, PETROV = ("Иванов", "Иван", "Ильич", "Д-1"), ("Петров", "Пётр", None, "Д-1")


def book(tmp_path: Path, *sheets: Sequence[Sequence[object]],
         edit: Callable[[Worksheet], None] | None = None) -> Path:  # fmt: skip
    """A file that a person calls as it comes, with these rows on its sheets."""
    built = Workbook()
    built.remove(built.active)
    for number, rows in enumerate(sheets, 1):
        sheet = built.create_sheet(f"Группа {number}")
        for row in rows:
            sheet.append(row)
        if edit is not None:
            edit(sheet)
    path = tmp_path / "Список (1).XLSX"
    built.save(path)
    return path


def as_csv(tmp_path: Path, rows: Sequence[Sequence[object]]) -> Path:
    path = tmp_path / "group.csv"
    lines = (";".join("" if cell is None else str(cell) for cell in row) for row in rows)
    path.write_text("\r\n".join(lines), encoding="cp1251", newline="")
    return path


TITLE = ("Список группы Д-1, осень, 3 курс", None, None, None)


@pytest.mark.parametrize(
    "rows",
    [
        [HEAD, IVANOV, PETROV],
        [TITLE, (), TITLE, HEAD, IVANOV, (), PETROV],
        [("№", *HEAD), (1, *IVANOV), ("2.", *PETROV), ("3)", None, None), (4,)],
        [("ФИО студента", "Группа"), ("Иванов Иван\u00a0Ильич", "Д-1"), ("Петров  Пётр", "Д-1")],
        [("№", "Студент", None, None, "Группа"), (None, "Фамилия", "Имя", "Отчество"),
         (1, *IVANOV), (2, *PETROV)],
        [HEAD, IVANOV, HEAD, PETROV],  # on the next printed page
        [(*HEAD, "Дата рождения"), (*IVANOV, date(2005, 5, 1)), PETROV],
    ],
)  # fmt: skip
def test_a_book_and_a_csv_file_are_read_alike(tmp_path, rows):
    for path in (book(tmp_path, rows), as_csv(tmp_path, rows)):
        collected = [(student.full, student.group) for student in read_roster(path)]
        assert collected == [("Иванов Иван Ильич", "Д-1"), ("Петров Пётр", "Д-1")]


def test_numbers_of_a_book_are_as_its_sheet_shows_them(tmp_path):
    def edit(sheet: Worksheet) -> None:
        sheet["B2"].number_format = "000000"

    rows = [("ФИО", "Номер"), ("Иванов Иван", 1234), ("Петров Пётр", 20230115.0), ("Яшин Я", 7)]
    assert [s.number for s in read_roster(book(tmp_path, rows, edit=edit))] == [
        "001234", "20230115", "7",
    ]  # fmt: skip


def test_a_group_that_is_merged_downwards_is_everybodys(tmp_path):
    rows = [("ФИО", None, "Группа"), ("Иванов", "Иван", "Д-1"), ("Петров", "Пётр", None)]

    def edit(sheet: Worksheet) -> None:
        sheet.merge_cells("A1:B1")
        sheet.merge_cells("C2:C3")

    collected = [(s.full, s.group) for s in read_roster(book(tmp_path, rows, edit=edit))]
    assert collected == [("Иванов Иван", "Д-1"), ("Петров Пётр", "Д-1")]


def test_zeros_that_a_site_keeps_through_excel(tmp_path):
    path = tmp_path / "group.csv"
    path.write_text('Фамилия;Имя;Номер\nПетров;Иван;="00012"\n', encoding="utf-8")
    assert read_roster(path)[0].number == "00012"


def test_hidden_rows_are_people_and_hidden_sheets_are_not(tmp_path):
    def edit(sheet: Worksheet) -> None:
        sheet.row_dimensions[3].hidden = True
        sheet.sheet_state = "hidden" if sheet.title.endswith("1") else "visible"

    actual = read_roster(book(tmp_path, [HEAD, ("Кто", "То")], [HEAD, IVANOV, PETROV], edit=edit))
    assert [student.surname for student in actual] == ["Иванов", "Петров"]


def test_saved_values_of_formulas_are_read(tmp_path):
    """A full name put together by a formula; without its saved value it is not guessed."""
    path = book(tmp_path, [("ФИО", "Группа"), ("=B9", "Д-1")])
    with pytest.raises(InputError, match="«Группа 1», A2: значение формулы не сохранено"):
        read_roster(path)
    path.write_bytes(with_value(path.read_bytes(), "Иванов Иван"))
    (actual,) = read_roster(path)
    assert actual.full == "Иванов Иван"


def with_value(data: bytes, text: str) -> bytes:
    """A book as Excel saves it: the only formula with its value."""
    built = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as source, zipfile.ZipFile(built, "w") as target:
        for info in source.infolist():
            part = source.read(info).decode("utf-8")
            part = part.replace('<c r="A2"><f>', '<c r="A2" t="str"><f>')
            part = re.sub(r"(</f>)<v\s*/?>(</v>)?", rf"\1<v>{text}</v>", part)
            target.writestr(info, part)
    return built.getvalue()


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ([[]], r"\.XLSX: список пуст"),
        ([[HEAD]], "нет ни одного студента"),
        ([[IVANOV, PETROV]], "нет столбца «Фамилия» или «ФИО»"),
        ([[TITLE, HEAD, (None, "Иван")]], "лист «Группа 1», A3: нет фамилии"),
        ([[("№", *HEAD), (1, *IVANOV), ("Староста Иванов",)]], "лист «Группа 1», B3: нет фамилии"),
        ([[HEAD, IVANOV, IVANOV]], "лист «Группа 1», A3: студент .* уже есть в строке 2"),
        ([[HEAD, (*IVANOV[:3], date(2026, 12, 3))]], "«Группа 1», D2: дата вместо текста"),
        ([[HEAD, ("#N/A", "Иван")]], "«Группа 1», A2: ошибка #N/A"),
        ([[HEAD, IVANOV], [HEAD, PETROV]], "на листе «Группа 2» есть студенты, которых нет"),
        ([[HEAD, ("Ы" * 300, "Иван")]], "слишком длинный"),
        ([[HEAD, IVANOV, ("Группа Д-2",), HEAD, PETROV]], "A3: «Группа Д-2» — не фамилия"),
        ([[("№", "ФИО"), (1, "Иванов Иван"), (None, "Всего: 1")]], "B3: «Всего:» — не фамилия"),
        ([[(*HEAD, *HEAD), (*IVANOV, *PETROV)]], "A1: столбец «Фамилия» назван дважды"),
    ],
)
def test_a_bad_book_is_one_clear_line(tmp_path, rows, words):
    with pytest.raises(InputError, match=words) as caught:
        read_roster(book(tmp_path, *rows))
    assert len(caught.value.lines()) == 1


def test_a_sheet_of_marks_of_the_same_people_is_no_other_group(tmp_path):
    marks = [("Студент", "Оценка"), ("Петров П.", 5), ("Иванов И.", 4)]
    actual = read_roster(book(tmp_path, [("Журнал",)], [HEAD, IVANOV, PETROV], marks))
    assert [student.surname for student in actual] == ["Иванов", "Петров"]


def test_a_work_book_is_no_list(tmp_path):
    built = Workbook()
    built.active.title = CONTENTS_SHEET
    built.active.append(["Студент", "Иванов"])
    built.create_sheet(INPUT_SHEET).append(["Студент", "Петров"])
    built.save(tmp_path / "работа.xlsx")
    with pytest.raises(InputError, match="это рабочая книга, а не список группы"):
        read_roster(tmp_path / "работа.xlsx")


def test_a_book_that_no_program_wrote_is_refused(tmp_path):
    path = book(tmp_path, [HEAD, IVANOV])
    built = io.BytesIO()
    with zipfile.ZipFile(path) as source, zipfile.ZipFile(built, "w") as target:
        for info in source.infolist():
            part = source.read(info)
            target.writestr(info, part[:200] if "sheet1" in info.filename else part)
    path.write_bytes(built.getvalue())
    with pytest.raises(InputError, match="книга не читается; сохраните список как CSV"):
        read_roster(path)


def _renamed(data: bytes, names: dict[str, str], texts: dict[str, tuple[str, str]]) -> bytes:
    """A book with other names of its parts, and with texts replaced in some."""
    built = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as source, zipfile.ZipFile(built, "w") as target:
        for info in source.infolist():
            part = source.read(info).decode("utf-8")
            for old, new in (texts[key] for key in texts if key in info.filename):
                part = part.replace(old, new)
            info.filename = names.get(info.filename, info.filename)
            target.writestr(info, part)
    return built.getvalue()


_STRINGS = "xl/sharedStrings.xml"


@pytest.mark.parametrize(
    ("names", "texts"),
    [
        ({_STRINGS: "xl/SharedStrings.xml"}, {}),
        ({_STRINGS: "xl/SharedStrings.xml"}, {"_Types": (_STRINGS, "xl/SharedStrings.xml")}),
        ({_STRINGS: "xl/SHAREDSTRINGS.XML", "xl/styles.xml": "xl/Styles.xml"}, {}),
        ({"xl/workbook.xml": "xl\\workbook.xml", "xl/styles.xml": "xl\\styles.xml",
          "xl/worksheets/sheet1.xml": "xl\\worksheets\\sheet1.xml"}, {}),
        ({}, {"workbook.xml.rels": ("worksheets/", "worksheets\\")}),
        ({}, {".rels": ("/xl/", "\\xl\\")}),
        ({"xl/worksheets/sheet1.xml": "xl/worksheets/Sheet1.xml"}, {}),
        ({}, {"styles": ("<fill><patternFill/></fill>", "<fill/>")}),
        ({}, {"styles": ("<fill><patternFill/></fill>", "<fill></fill>")}),
    ],
)  # fmt: skip
def test_a_book_of_another_program_is_read_whatever_its_parts_are_called(tmp_path, names, texts):
    path = book(tmp_path, [HEAD, IVANOV, PETROV])
    if _STRINGS in names:
        with xlsxwriter.Workbook(path) as written:
            sheet = written.add_worksheet()
            for number, row in enumerate((HEAD, IVANOV, PETROV)):
                sheet.write_row(number, 0, row)
    data = _renamed(path.read_bytes(), names, texts)
    assert data != _renamed(path.read_bytes(), {}, {})
    path.write_bytes(data)
    assert [student.surname for student in read_roster(path)] == ["Иванов", "Петров"]


def test_a_cell_at_the_edge_costs_nothing(tmp_path):
    def edit(sheet: Worksheet) -> None:
        sheet["XFD1048576"] = " "

    assert len(read_roster(book(tmp_path, [HEAD, IVANOV], edit=edit))) == 1
