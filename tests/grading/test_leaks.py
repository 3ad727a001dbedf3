"""No work-book holds its answers, and a book into which they were planted is refused."""

from __future__ import annotations

import io
import random
import zipfile
from collections.abc import Callable
from functools import lru_cache
from math import cos, radians

import pytest
from openpyxl import Workbook, load_workbook
from openpyxl.comments import Comment
from openpyxl.packaging.custom import StringProperty
from openpyxl.workbook.defined_name import DefinedName

from reports.grading.issuing.assignment import Assignment, assignment_of
from reports.grading.issuing.handout import check_for_leaks, fill_cells, handout_bytes, leaks_of
from reports.grading.issuing.rubric import rubric_of
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from reports.workbook.layout import Layout
from tests.conftest import sample
from tests.cover import examples
from tests.grading import classroom
from tests.grading.forms import rewritten
from tests.referee.changes import without_charts

TICKET = "K" + "A" * 24


@lru_cache(maxsize=1)
def asked() -> list[float]:
    """A column that is asked."""
    values = evaluate_model(classroom.assignment().model)
    return [float(v) for v in values.columns["P4_1"]["T_MPa"]]


def test_what_is_asked_is_empty() -> None:
    """Formulas too: a column that is shared with the cell above would stand there unseen."""
    assignment = classroom.assignment()
    book, layout = load_workbook(io.BytesIO(classroom.handout())), Layout.of(assignment.model)
    asked_cells = [cell for block in assignment.fill
                   for node, cells in fill_cells(block, layout).items()
                   if node in assignment.fill_nodes for cell in cells]  # fmt: skip
    filled = [cell for cell in asked_cells
              if book[cell.sheet].cell(cell.row, cell.column).value is not None]  # fmt: skip
    assert len(asked_cells) > 500 and filled == []


def test_a_work_book_has_no_curves_by_degrees() -> None:
    """Its charts are drawn from the student's own cells: blank before these are filled in."""
    book = classroom.handout()
    titles = load_workbook(io.BytesIO(book)).sheetnames
    assert "П4.1" in titles and "Кривые" not in titles
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        charts = [archive.read(n).decode() for n in archive.namelist() if "charts/chart" in n]
    drawn = [chart for chart in charts if "'П4.1'!" in chart]
    assert drawn and not any("Кривые" in chart for chart in charts)
    for chart in drawn:  # angles are given, what is asked is not
        assert "<v>" not in chart.split("<yVal>")[1].split("</yVal>")[0]


def planted(plant: Callable[[Workbook], None]) -> bytes:
    book = load_workbook(io.BytesIO(without_charts(classroom.handout())))
    plant(book)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def column(change: Callable[[list[float]], list[float]], sheet: str = "Газы") -> Callable:
    def plant(book: Workbook) -> None:
        target = book[sheet] if sheet in book.sheetnames else book.create_sheet(sheet)
        target.sheet_state = "visible" if sheet in ("Газы",) else "veryHidden"
        for row, value in enumerate(change(list(asked())), 40):
            target.cell(row, 20).value = value

    return plant


def in_a_row(book: Workbook) -> None:
    for number, value in enumerate(asked(), 5):
        book["Газы"].cell(50, number).value = value


def in_a_comment(book: Workbook) -> None:
    text = "; ".join(f"{v:.3f}".replace(".", ",") for v in asked())
    book["П4.1"]["A4"].comment = Comment(text, "x")


def in_a_name(book: Workbook) -> None:
    text = "{" + ";".join(repr(v) for v in asked()) + "}"
    book.defined_names["ответы"] = DefinedName("ответы", attr_text=text)


def in_a_property(book: Workbook) -> None:
    text = " ".join(repr(v) for v in asked())
    book.custom_doc_props.append(StringProperty(name="x", value=text))


def in_a_formula(book: Workbook) -> None:
    for row, value in enumerate(asked(), 40):
        book["Газы"].cell(row, 20).value = f"={value!r}+A6"


def scalars(book: Workbook) -> None:
    values = evaluate_model(classroom.assignment().model).scalars
    for row, key in enumerate(("omega", "lam", "F_piston"), 40):
        book["Газы"].cell(row, 20).value = -1000 * float(values[key])


PLANTS = {
    "as it is": column(lambda v: v),
    "moved by rows": column(lambda v: v[8:-1] + v[:9]),
    "in another unit": column(lambda v: [x * 1000 for x in v]),
    "with the other sign": column(lambda v: [-x for x in v]),
    "sorted": column(sorted),
    "rounded": column(lambda v: [round(x, 3) for x in v]),
    "on a hidden sheet": column(lambda v: [-10 * x for x in sorted(v)], "тайно"),
    "as a row": in_a_row,
    "in a comment": in_a_comment,
    "in a name": in_a_name,
    "in a property": in_a_property,
    "in a formula": in_a_formula,
    "scalars": scalars,
}


@pytest.mark.parametrize("name", PLANTS)
def test_planted_answers_are_found(name):
    book = planted(PLANTS[name])
    actual = leaks_of(book, classroom.assignment())
    assert actual, name
    wanted = "geometry." if name == "scalars" else "P4_1.T_MPa"
    assert any(wanted in leak.item for leak in actual)
    with pytest.raises(InputError, match="книга содержала бы ответы"):
        check_for_leaks(book, classroom.assignment(), "рубрика")


def test_answers_in_the_cache_of_a_chart_are_found():
    cache = "".join(f'<c:pt idx="{i}"><c:v>{v!r}</c:v></c:pt>' for i, v in enumerate(asked()))

    def change(name: str, data: bytes) -> bytes:
        if name != "xl/charts/chart1.xml":
            return data
        at = data.index(b"</c:ser>") if b"</c:ser>" in data else data.index(b"</ser>")
        plain = cache if b"</c:ser>" in data else cache.replace("c:", "")
        return data[:at] + plain.encode() + data[at:]

    actual = leaks_of(rewritten(classroom.handout(), change), classroom.assignment())
    assert any("chart1" in leak.part for leak in actual)


def test_saved_values_of_given_formulas_are_found():
    """The live formulas of a book must not carry what they give in the solved one."""
    values = iter(evaluate_model(classroom.assignment().model).columns["P4_1"]["T_MPa"])
    import re

    def change(name: str, data: bytes) -> bytes:
        if b"INDEX(" not in data:
            return data
        return re.sub(rb"<v ?/>|<v></v>", lambda m: b"<v>%r</v>" % float(next(values, 0.0)), data)

    assert leaks_of(rewritten(classroom.handout(), change), classroom.assignment())


@pytest.mark.parametrize("rpm", [3000, 4500, 5400])
def test_angles_in_radians_are_not_the_speed_that_has_their_digits(rpm):
    raw = to_mapping(classroom.assignment().model.input)
    raw["regime"]["speed_rpm"] = rpm
    model = build_model(load_mapping(raw, source="r").model)
    assignment = assignment_of(model, rubric_of({"work": {"fill": ["geometry"]}}, "r"))
    plant = column(lambda _: [radians(angle) for angle in range(0, 720, 6)])
    assert leaks_of(planted(plant), assignment) == []


def test_sines_of_a_circle_are_no_answers():
    """A circle round a bearing has those of the rays of wear, and what is left of cos 90°."""
    model = build_model(classroom.assignment().model.input)
    assignment = assignment_of(model, rubric_of({"work": {"fill": ["table_14_sums"]}}, "r"))
    book, stream = Workbook(), io.BytesIO()
    for angle in range(0, 361, 5):
        book.worksheets[0].append([cos(radians(angle))])
    book.save(stream)
    assert leaks_of(stream.getvalue(), assignment) == []


def test_an_issued_book_has_no_answer_and_no_saved_value():
    assert leaks_of(classroom.handout(), classroom.assignment()) == []
    assignment = classroom.assignment()
    live = assignment.live_nodes
    assert {"cylinder_2.M_Nm", "gas.p_MPa", "M_max", "throw1_C2"} <= live
    expr = assignment.graph.expression("cylinder_2.T_MPa")
    assert expr.startswith("element(P4_1.T_MPa")  # the student's own column, moved
    for node in assignment.given_nodes:
        assert not assignment.graph.ancestors(node) & assignment.fill_nodes


def test_a_rubric_that_gives_its_answers_is_refused():
    model = classroom.assignment().model
    rubric = rubric_of({"work": {"fill": ["P3_1"], "given": ["P4_1"]}}, "r")
    assignment = assignment_of(build_model(model.input), rubric)
    with pytest.raises(InputError, match=r"P3_1.j_m_s2 — П4.1!K"):
        check_for_leaks(handout_bytes(assignment, TICKET), assignment, "r")


FILLS = (
    ["geometry", "masses", "P3_*", "P4_*"], ["P3_*", "P4_1", "P4_2"], ["geometry", "P4_1"],
    ["P4_*", "table_14*"], ["balance*", "geometry"], ["P4_2", "P4_4"], ["gas", "P3_1"],
)  # fmt: skip
SAMPLES = ("gots-diesel", "d-240", "vw-1600", "two-stroke", "yamz-236", "ecoboost-10")


def random_assignment(seed: int) -> Assignment:
    """A random engine near a sample, and a random rubric."""
    rng = random.Random(seed)
    raw = to_mapping(sample(rng.choice(SAMPLES)))
    raw["calculation"]["step_deg"] = rng.choice((10, 15, 30))
    geometry, regime = raw["geometry"], raw["regime"]
    geometry["bore_mm"] = round(geometry["bore_mm"] * rng.uniform(0.97, 1.03), 1)
    regime["speed_rpm"] = round(regime["speed_rpm"] * rng.uniform(0.9, 1.05))
    model = build_model(load_mapping(raw, source="r").model)
    known = {block.id for block in model.blocks}
    fill = [f for f in rng.choice(FILLS) if "*" in f or f in known]
    return assignment_of(model, rubric_of({"work": {"fill": fill}}, "r"))


@pytest.mark.parametrize("seed", range(examples(3, 6)))
def test_no_random_class_is_given_its_answers(seed):
    assignment = random_assignment(seed)
    assert leaks_of(handout_bytes(assignment, TICKET), assignment) == []


def test_a_work_that_asks_for_everything_is_issued_for_many_pins():
    """The first sheet tells of the most loaded pin, which here the student is to find."""
    raw = to_mapping(sample("yamz-238"))
    raw["calculation"]["step_deg"] = 30
    model = build_model(load_mapping(raw, source="r").model)
    assignment = assignment_of(model, rubric_of({"work": {"fill": ["*"]}}, "r"))
    assert "worst_pin_load" in assignment.fill_nodes
    assert leaks_of(handout_bytes(assignment, TICKET), assignment) == []
