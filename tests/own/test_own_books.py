"""Own books: the page of the manual, the samples of a class, a book of the house taken out."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import openpyxl
import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.exports.department_chapters import refuse_faults
from reports.grading.issuing.issue import assignment_for, issue
from reports.grading.judging.marking import Marker
from reports.grading.reading.submissions import Submission
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_toml
from reports.model.blocks import TableSpec
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir, templates_dir
from reports.tables.registry import build_model
from reports.workbook.layout import Layout
from reports.workbook.read import load_workbook_input
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.grading.classroom import roster_text
from tests.grading.fill import filled_book, solved_formulas
from tests.manual.pages import DOCS, blocks
from tests.referee.compare import differences_from_caches, errors_in
from tools.referees.by_formualizer import Formualizer

OWN = samples_dir() / "own"
PAGE = DOCS / "own-chapter.md"


def run(*arguments: str) -> str:
    """What a command prints; it must not fail."""
    done = CliRunner().invoke(main, list(arguments))
    assert done.exit_code in (0, 1), done.output
    return done.output


@pytest.fixture(scope="module")
def engine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An engine with the book of the page beside it."""
    folder = tmp_path_factory.mktemp("page")
    (book,) = blocks(PAGE, "book")
    (folder / "вентилятор.book").write_text(book, encoding="utf-8")
    head, variants, _ = blocks(PAGE, "toml")
    named, own = head.split("\n\n")
    text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
    text = text.replace("step_deg = 10", "step_deg = 30").replace("[report]", named)
    path = folder / "двигатель.toml"
    path.write_text(f"{text}\n{own}\n{variants}", encoding="utf-8")
    return path


def test_the_page_is_done(engine: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(engine.parent)
    for block in blocks(PAGE, "console"):
        for line in block.splitlines():
            more = " --only xlsx --only html" if line.startswith("kshm build") else ""
            run(*f"{line}{more}".split()[1:])
    page = (engine.parent / "двигатель.html").read_text(encoding="utf-8")
    assert "Вентилятор</h1>" in page and r"N_{\mathrm{в}} = " in page
    book = engine.parent / "двигатель.xlsx"
    sheet = openpyxl.load_workbook(book)["Вентилятор"]
    assert any(str(cell.value).startswith("=fan_flow_share*") for row in sheet for cell in row)
    rows = (engine.parent / "вентилятор.csv").read_text(encoding="utf-8").splitlines()
    assert rows[0].endswith("power_fan,tip_fan,error") and len(rows) == 6
    again = load_workbook_input(book).model
    assert (again.books, again.own) == (load_toml(engine).model.books, load_toml(engine).model.own)


def test_the_workbook_is_recalculated(engine: Path):
    model = build_model(load_toml(engine).model)
    book = workbook_bytes(model, evaluate_model(model))
    (recalculated,) = Formualizer().recalculate([book])
    assert errors_in(recalculated) == [] and differences_from_caches(book, recalculated) == []
    inputs = openpyxl.load_workbook(io.BytesIO(book))["Исходные данные"]
    rules = {rule.errorTitle: rule for rule in inputs.data_validations.dataValidation}
    limit = rules["Диаметр вентилятора"].formula2.replace("$", "")
    assert inputs[limit].value == 2000


def test_solve_gives_its_numbers(engine: Path):
    data = json.loads(run("solve", str(engine), "--json", "-").partition("\nШаг таблиц")[0])
    message = data["summary"]["tip_fan"]
    assert message["unit"] == "м/с" and data["engine"]["fan_blade_mm"] == 420
    omega = data["summary"]["omega"]["value"]
    assert message["value"] == pytest.approx(omega * 1.2 * 0.42 / 2)


def test_a_wrong_value_is_told_by_its_key(engine: Path):
    text = engine.read_text(encoding="utf-8").replace("blade_mm = 420", "blade_mm = 42")
    wrong = engine.with_name("wrong.toml")
    wrong.write_text(text, encoding="utf-8")
    done = CliRunner().invoke(main, ["check", str(wrong)])
    assert done.exit_code == 2
    assert "own.fan.blade_mm: значение 42 вне допустимых пределов" in done.output
    wrong.write_text(text.replace("blade_mm", "blad_mm"), encoding="utf-8")
    assert "имелся в виду blade_mm" in CliRunner().invoke(main, ["check", str(wrong)]).output


def test_the_blank_book_is_tried(tmp_path: Path):
    book = tmp_path / "насос.book"
    assert str(book) in run("new", "--book", str(book))
    assert "ошибок нет; исходных 2" in run("check", str(book))


@pytest.mark.parametrize("name", ["oil-pump", "valve"])
def test_a_sample_is_tried(name: str):
    assert "ошибок нет" in run("check", str(OWN / f"{name}.book"))


def test_a_class_with_slips_in_own_items(tmp_path: Path):
    """One slip in a column, one in a value: theirs are wrong, what follows is carried on."""
    (tmp_path / "group.csv").write_text(roster_text(2), encoding="utf-8")
    result = issue(OWN / "base.toml", tmp_path / "group.csv", tmp_path / "issued", seed=7,
                   rubric_file=OWN / "rubric.toml", secret_file=tmp_path / "secret")  # fmt: skip
    register = result.register
    book = register.books[0]
    assignment = assignment_for(book, register.rubric)
    handout = (tmp_path / "issued" / book.folder / book.file).read_bytes()
    sheets = openpyxl.load_workbook(io.BytesIO(handout)).sheetnames
    assert "Клапан" in sheets and "Свои книги" not in sheets
    right = solved_formulas(assignment, Layout.of(assignment.model))
    slips = {
        "valve_lift.lift_own": [f"{text}*1.1" for text in right["valve_lift.lift_own"]],
        "Q_oil_own": [f"{right['Q_oil_own'][0]}*2"],
    }

    def verdicts(changes: dict[str, list[str]]) -> dict[str, str]:
        data = filled_book(handout, assignment, changes)
        marks = Marker(register).mark(Submission("р.xlsx", Path("р.xlsx"), None, None), data)
        return {line["id"]: line["verdict"] for line in marks["items"]}

    assert set(verdicts({}).values()) == {"right"}
    actual = verdicts(slips)
    assert actual["valve_lift.lift_own"] == actual["oil_pump.Q_oil_own"] == "wrong"
    for item in ("valve_lift.area_own", "oil_pump.V_oil_own", "oil_pump.V_pump_own"):
        assert actual[item] == "carried", item
    assert actual["valve_lift.angle_own"] == actual["oil_pump.Q_fuel_own"] == "right"


def replaced(names: tuple[str, ...], base: str) -> Iterator[bytes]:
    """Workbooks of a sample by the house's books, and with some of them as own ones."""
    model = sample(base)
    raw = to_mapping(model)
    texts = {f"{name}.book": (templates_dir() / "tables" / f"{name}.book").read_text("utf-8")
             for name in names}  # fmt: skip
    raw["report"]["books"], raw["books"] = list(texts), texts
    own = load_mapping(raw, source="").model
    refuse_faults(own)
    for each in (model, own):
        built = build_model(each)
        yield workbook_bytes(built, evaluate_model(built))


def test_the_film_as_an_own_book_gives_the_same_cells():
    """The books of film and safety of a department in place of the house's: cell by cell."""
    house, own = (
        openpyxl.load_workbook(io.BytesIO(data))
        for data in replaced(("oil", "safety"), "d-240-bearings")
    )
    assert [name for name in own.sheetnames if name != "Свои книги"] == house.sheetnames
    for sheet in house:
        if sheet.title in ("Содержание", "Исходные данные"):  # the book's name stands there
            continue
        other = own[sheet.title]
        assert sheet.dimensions == other.dimensions
        for row, theirs in zip(sheet.iter_rows(), other.iter_rows(), strict=True):
            for cell, twin in zip(row, theirs, strict=True):
                assert at_inputs(cell.value) == at_inputs(twin.value), cell.coordinate
                assert cell.number_format == twin.number_format
        assert len(sheet._charts) == len(other._charts)


def at_inputs(value: object) -> object:
    """A formula without the rows of the sheet of inputs, where the book's name takes one."""
    return (
        re.sub(r"('Исходные данные'!)[$A-Z0-9:]+", r"\1", value)
        if isinstance(value, str)
        else value
    )


def test_every_book_of_the_house_may_be_replaced():
    """In the sandbox each gives the same blocks and charts."""
    model = sample("cycle-turbo-diesel")
    raw, house = to_mapping(model), build_model(model)
    for path in sorted((templates_dir() / "tables").glob("*.book")):
        if path.stem == "contents":
            continue
        raw["report"]["books"], raw["books"] = [path.name], {path.name: path.read_text("utf-8")}
        built = build_model(load_mapping(raw, source="").model)
        assert built.charts == house.charts, path.stem
        assert list(map(plain, built.blocks)) == list(map(plain, house.blocks)), path.stem


def plain(block: object) -> object:
    """A block without what finds its values, which is made anew for each model."""
    return replace(block, computed=None) if isinstance(block, TableSpec) else block
