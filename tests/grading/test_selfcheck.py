"""What a student is told before handing in: blanks, numbers, errors; never right or wrong."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from click.testing import CliRunner
from openpyxl import Workbook, load_workbook

from reports.cli import main
from reports.grading.reading.selfcheck import findings, is_work_book, remarks
from reports.shared.errors import InputError
from reports.workbook.layout import Layout
from reports.workbook.write import workbook_bytes
from tests.grading import classroom
from tests.grading.fill import filled_book
from tests.grading.forms import as_excel

ROOT = Path(__file__).parents[2]


def told(tmp_path: Path, data: bytes) -> dict[str, str]:
    path = tmp_path / "моя книга.xlsx"
    path.write_bytes(data)
    assert is_work_book(path)
    return {item.where: item.what for item in findings(path)}


def test_what_a_page_tells_is_short_and_no_condition(tmp_path: Path) -> None:
    path = tmp_path / "книга.xlsx"
    path.write_bytes(classroom.handout())
    issued = tmp_path / "выдана.xlsx"
    issued.write_bytes(classroom.handout())
    blank = sum(len(item.nodes) for item in classroom.assignment().items)
    (line,) = remarks(str(path), str(issued))["remarks"]  # nothing is filled in: one line
    assert re.fullmatch(r"пуст[аы] (\d+) ячее?[кй]\w*: книга не заполнена", line), line
    assert int(line.split()[1]) > blank

    begun = load_workbook(path)
    cell = Layout.of(classroom.assignment().model).cells["lam"]
    begun[cell.sheet].cell(cell.row, cell.column).value = 0.3
    begun.save(path)
    lines = remarks(str(path), str(issued))["remarks"]
    assert len(lines) == 21 and "пусто" in lines[0] and "и ещё замечаний: " in lines[-1]
    path.write_bytes(classroom.handout())
    issued.write_bytes(classroom.handout(2))
    assert "выдана не вам" in remarks(str(path), str(issued))["remarks"][0]
    issued.write_bytes(classroom.handout())
    path.write_bytes(workbook_bytes(classroom.assignment().model))
    assert remarks(str(path), str(issued))["remarks"] == [
        "в книге нет идентификатора: это не выданная рабочая книга"
    ]

    def without_speed(book: Workbook, layout: Layout) -> None:
        cell = layout.cells["regime_speed_rpm"]
        book[cell.sheet].cell(cell.row, cell.column).value = None

    path.write_bytes(filled_book(classroom.handout(), classroom.assignment(), edit=without_speed))
    assert (
        len(remarks(str(path), str(issued))["remarks"]) == 1
    )  # its input is none: a person decides on it
    path.write_bytes(b"MZ")
    with pytest.raises(InputError, match="а не книга"):
        remarks(str(path), str(issued))


def test_an_archive_is_opened_as_it_is_handed_in(tmp_path: Path) -> None:
    inner, path = io.BytesIO(), tmp_path / "работа.zip"
    with zipfile.ZipFile(inner, "w") as archive:
        archive.writestr("папка/моя книга.xlsx", classroom.handout())
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("читать.txt", "привет")
        archive.writestr("ещё.zip", inner.getvalue())
    result = CliRunner().invoke(main, ["check", str(path)])
    assert (
        result.exit_code == 1 and "моя книга.xlsx, " in result.output and "пусто" in result.output
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("читать.txt", "привет")
    result = CliRunner().invoke(main, ["check", str(path)])
    assert "в архиве нет выданной рабочей книги" in result.output


def spoilt(book: Workbook, layout: Layout) -> None:
    cell = layout.cells["regime_speed_rpm"]
    book[cell.sheet].cell(cell.row, cell.column).value = 4111
    book["Цилиндры"]["L8"] = 5
    book["П4.1"]["H9"] = None


def test_a_book_that_is_filled_in_gives_no_remark(tmp_path):
    right = filled_book(classroom.handout(), classroom.assignment())
    assert told(tmp_path, right) == {}
    assert told(tmp_path, as_excel(right)) == {}
    # Wrong formulas are no matter of this check.
    wrong = filled_book(
        classroom.handout(), classroom.assignment(), {"omega": ["=1+regime_speed_rpm"]}
    )
    assert told(tmp_path, wrong) == {}


def test_everything_odd_is_told_with_its_cells(tmp_path):
    changes = {"P3_1.v1_m_s": [1.5] * 13, "lam": ["=1/0"], "V_c": ['=INDIRECT("V_h")'],
               "P4_1.M_Nm": [None] * 25}  # fmt: skip
    actual = told(
        tmp_path, filled_book(classroom.handout(), classroom.assignment(), changes, spoilt)
    )
    changed = "исходное данное «Частота вращения» изменено"
    assert [where.partition("!")[0] for where, what in actual.items() if what == changed] == [
        "Исходные данные"
    ]
    assert actual["Цилиндры!L8"] == "ячейка заперта, а изменена: теперь 5.0"
    assert actual["П3.1 vп1"] == "число вместо формулы: П3.1!E6:E18"
    assert actual["Массы λ"] == "ошибка #ДЕЛ/0! — деление на ноль: Массы!C7"
    assert "INDIRECT" in actual["Массы Vc"]
    assert actual["П4.1 Mкр"] == "пусто: П4.1!I6:I30"
    assert actual["П4.1 Kуд"] == "пусто: П4.1!H9"
    assert "П3.1 jп2" in actual["Ошибки, пришедшие из названных выше"]
    assert "верн" not in " ".join(actual.values())


def test_a_solved_book_is_no_work_book(tmp_path):
    path = tmp_path / "a.xlsx"
    path.write_bytes(workbook_bytes(classroom.assignment().model))
    assert not is_work_book(path)
    assert not is_work_book(ROOT / "samples" / "gots-diesel.toml")


def test_the_command_needs_no_secret(tmp_path):
    path = tmp_path / "a.xlsx"
    path.write_bytes(classroom.handout())
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "utf-8",
                   "KSHM_SECRET": str(tmp_path / "none")}  # fmt: skip
    done = subprocess.run(
        [sys.executable, "-m", "reports", "check", str(path)],
        capture_output=True, text=True, cwd=tmp_path, env=environment, check=False,
    )  # fmt: skip
    assert done.returncode == 1
    assert "П3.1 sп1: пусто: П3.1!B6:B18" in done.stdout
    assert "верны ли значения, здесь не проверяется" in done.stdout
