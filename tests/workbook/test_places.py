"""Where charts stand: in sight or under one that is, none over another, none empty."""

from __future__ import annotations

import io
import itertools
import math

import matplotlib
import pytest
from lxml import etree
from openpyxl import Workbook, load_workbook
from openpyxl.worksheet.worksheet import Worksheet
from PIL import ImageFont

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_text
from reports.model.blocks import Model, ScalarTable, TableSpec
from reports.model.contents import contents_of
from reports.model.evaluation import Values
from reports.new.generate import file_text, generate_engine
from reports.tables.registry import build_model
from reports.workbook import styles
from reports.workbook.chapters import diagrams_of, heading, ordered, place_of
from reports.workbook.cockpit import VERDICT_ROW
from reports.workbook.inputs import write_inputs
from reports.workbook.layout import (
    CONTENTS_SHEET,
    HEADER_ROW,
    INPUT_SHEET,
    MAX_COLUMN,
    Layout,
    arranged,
)
from reports.workbook.motion import SHEET
from reports.workbook.places import DIGIT, FOLD, SCREEN, Box, column_px, extent, lines_of, row_px
from reports.workbook.print_setup import set_widths
from reports.workbook.sheets import BlockWriter
from reports.workbook.tiles import SPANS
from reports.workbook.write import workbook_bytes
from tests.conftest import sample, sample_names
from tests.cover import charts, quantities, samples_with
from tests.workbook.lint import A, C
from tests.workbook.made import coarse_model, coarse_opened, parts

_EMU = 9525


def boxes_of(sheet: Worksheet) -> list[Box]:
    collected = []
    for chart in sheet._charts:  # openpyxl has no other list of what it read
        at, size = chart.anchor._from, chart.anchor.ext
        x = sum(column_px(sheet, i) for i in range(1, at.col + 1)) + at.colOff // _EMU
        y = sum(row_px(sheet, i) for i in range(1, at.row + 1)) + at.rowOff // _EMU
        collected.append(Box(x, y, size.width // _EMU, size.height // _EMU))
    return collected


def problems(boxes: list[Box], sheet: Worksheet | None = None) -> list[str]:
    """What is wrong with the places of a sheet's charts."""
    collected = []
    for index, box in enumerate(boxes):
        below = any(b.bottom <= box.y and b.x <= box.x < b.right for b in boxes[:index])
        if box.right > SCREEN or (box.bottom > FOLD + box.height // 2 and not below):
            collected.append(f"{box} is out of sight")
    for one, other in itertools.combinations(boxes, 2):
        separate = (one.right <= other.x or other.right <= one.x
                 or one.bottom <= other.y or other.bottom <= one.y)  # fmt: skip
        if not separate:
            collected.append(f"{one} and {other} overlap")
    if len({box.width for box in boxes}) > 1:
        collected.append("widths differ")
    if (
        sheet is not None and sheet.title != SHEET and boxes and min(b.x for b in boxes) < 100
    ):  # below the cells, then
        written = extent(sheet)[1]
        collected += [f"{box} lies on cells" for box in boxes if box.y < written]
    return collected


@pytest.mark.parametrize("name", samples_with(charts, quantities))
def test_every_chart_is_where_one_looks(name: str) -> None:
    book = coarse_opened(name)
    collected = {sheet.title: problems(boxes_of(sheet), sheet) for sheet in book.worksheets}
    assert {title: said for title, said in collected.items() if said} == {}
    assert len(boxes_of(book.worksheets[0])) == 4


@pytest.mark.parametrize(
    ("boxes", "said"),
    [
        ([Box(1400, 100, 300, 200)], "out of sight"),
        ([Box(0, 600, 300, 200)], "out of sight"),
        ([Box(0, 100, 300, 200), Box(200, 200, 300, 200)], "overlap"),
        ([Box(0, 100, 300, 200), Box(400, 100, 310, 200)], "widths differ"),
    ],
)
def test_the_lint_sees_a_misplaced_chart(boxes: list[Box], said: str) -> None:
    assert any(said in text for text in problems(boxes))


@pytest.mark.parametrize("name", sample_names())
def test_every_sheet_has_its_chapter(name: str) -> None:
    sheets = coarse_model(name).sheets
    assert [sheet for sheet in sheets if place_of(sheet)[0] == len(contents_of().chapters)] == []
    headings = [heading(sheet) for sheet in sheets]
    assert len(set(headings)) == len(headings)


def test_chapters_order_and_name_sheets() -> None:
    given = ["Износ к.ш (2) р2", "П4.3 (10)", "П4.3 (2)", "Массы", "Износ к.ш (1)"]
    assert ordered(given) == [
        "Массы", "П4.3 (2)", "П4.3 (10)", "Износ к.ш (1)", "Износ к.ш (2) р2",
    ]  # fmt: skip
    assert heading("Износ к.ш (2) р2") == "Износ коренной шейки 2, режим 2"
    titles = [diagrams_of(chapter) for chapter in contents_of().chapters]
    assert all(len(title) <= 31 for title in titles)
    assert len(set(titles)) == len(titles)
    assert all(math.isclose(place_of(title)[1], -1) for title in titles)


@pytest.mark.parametrize("name", sample_names())
def test_sheets_open_with_their_subject_and_axes_have_its_unit(name: str) -> None:
    """No sheet begins with what only draws a chart; limits are in the unit of their axis."""
    model = coarse_model(name)
    first = {}
    for block in model.blocks:
        first.setdefault(block.sheet, block.id)
    assert [one for one in first.values() if one.endswith(("_sizes", "_box"))] == []
    for spec in (spec for spec in model.charts if spec.kind == "polar"):
        box = spec.drawn_by("workbook")[-1].y
        unit = model.scalars[model.grid_runs[box][0]].quantity.unit_label
        assert unit in spec.y_title, (spec.id, unit)


@pytest.mark.parametrize("name", samples_with(charts, quantities))
def test_every_number_has_room_in_its_column(name: str) -> None:
    """Else a program shows crosses: a digit of 11 points is 7.34 px wide."""
    book = coarse_opened(name)
    tight = [
        f"{sheet.title}!{cell.coordinate}: {cell.value}"
        for sheet in book.worksheets
        if sheet.sheet_state == "visible"
        for row in sheet.iter_rows()
        for cell in row
        if isinstance(cell.value, float)
        and cell.number_format.rstrip("0") in ("0.", "")
        and column_px(sheet, cell.column)
        and len(f"{cell.value:.{len(cell.number_format.partition('.')[2])}f}") * 7.34 + 5
        > column_px(sheet, cell.column) + 5  # the margins
    ]
    assert tight == []


@pytest.mark.parametrize("name", samples_with(charts, quantities))
def test_no_title_of_a_table_is_cut_by_the_next(name: str) -> None:
    for sheet in coarse_opened(name).worksheets:
        titles = [cell for cell in sheet[HEADER_ROW - 1] if cell.value]
        for title, following in itertools.pairwise(titles):
            room = sum(column_px(sheet, i) for i in range(title.column, following.column)) / DIGIT
            lines = 1 if title.alignment.wrap_text is None else row_px(sheet, title.row) // 20
            assert 1.1 * len(title.value) < lines * room, (sheet.title, title.value)


@pytest.mark.parametrize("name", samples_with(charts, quantities))
def test_no_text_runs_under_a_chart(name: str) -> None:
    covered = []
    for sheet in coarse_opened(name).worksheets:
        boxes = boxes_of(sheet)
        for cell in itertools.chain(*sheet.iter_rows()):
            if cell.data_type != "s" or cell.alignment.wrap_text or cell.alignment.textRotation:
                continue
            x = sum(column_px(sheet, i) for i in range(1, cell.column))
            y = sum(row_px(sheet, i) for i in range(1, cell.row))
            end = x + len(cell.value) * DIGIT * 0.93
            if any(x < box.x < end and box.y <= y < box.bottom for box in boxes):
                covered.append(f"{sheet.title}!{cell.coordinate}: {cell.value}")
    assert covered == []


# Letters as wide as Times New Roman's, and as installed as matplotlib.
_BOLD = ImageFont.truetype(matplotlib.get_data_path() + "/fonts/ttf/STIXGeneralBol.ttf", 440)
_REGULAR = ImageFont.truetype(matplotlib.get_data_path() + "/fonts/ttf/STIXGeneral.ttf", 440)
_PX, _EDGES, _LINE = 11 / 440 * 4 / 3, 5, 19  # of a header of 11 pt


def header_problems(text: str, width: int, height: int) -> list[str]:
    """Words that are broken, lines that are cut off."""
    room = width - _EDGES

    def long(words: str) -> bool:
        return _BOLD.getlength(words) * _PX > room

    lines = [""]
    for word in text.split(" "):
        if long(f"{lines[-1]} {word}".strip()):
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    collected = [f"«{word}» is broken" for word in text.split(" ") if long(word)]
    return [*collected, f"{len(lines)} lines"] if len(lines) * _LINE > height else collected


@pytest.mark.parametrize("name", samples_with(charts, quantities))
def test_headers_of_tables_are_whole(name: str) -> None:
    whole_headers(coarse_opened(name), coarse_model(name))


def test_headers_of_twelve_throws_are_whole() -> None:
    """«Mш.ш10 по» has no room in one line where «Mш.ш9 по» has."""
    model = build_model(load_text(file_text(generate_engine(12)), source="twelve").model)
    whole_headers(load_workbook(io.BytesIO(workbook_bytes(model))), model)


def whole_headers(book: Workbook, built: Model) -> None:
    for title in {INPUT_SHEET, *(block.sheet for block in built.blocks)}:
        sheet = book[title]
        for cell in itertools.chain.from_iterable(sheet.iter_rows()):
            width = column_px(sheet, cell.column)
            if width and isinstance(cell.value, str) and cell.style == styles.HEADER:
                said = header_problems(cell.value, width, row_px(sheet, cell.row))
                assert said == [], (title, cell.value)


def test_a_header_too_long_for_its_column_is_seen() -> None:
    assert header_problems("εш (точно), с⁻²", 66, 64) == []
    assert header_problems("εш (приближённо), с⁻²", 66, 64) == ["«(приближённо),» is broken"]
    assert header_problems("M по статике шейки 1, Н·м", 70, 64) == ["4 lines"]


@pytest.mark.parametrize("name", samples_with(charts, quantities))
def test_every_group_of_input_data_has_its_title(name: str) -> None:
    built, sheet = coarse_model(name), coarse_opened(name)[INPUT_SHEET]
    layout = Layout.of(built)
    for section, run in itertools.groupby(arranged(built.inputs), lambda item: item.section):
        first = next(run)
        row = layout.cells[first.name].row - (2 if first.listed else 1)
        assert sheet.cell(row, 1).value == section


def test_no_text_of_input_data_is_cut_by_the_next_cell() -> None:
    """A long title by the key of its row, the name of a mass by its inertia."""
    long, name = "Расчёт " + "очень " * 9 + "большого двигателя", "маховик со сцеплением"
    raw = to_mapping(sample("gots-p3"))
    raw["report"]["title"] = long
    mass = {"inertia_kg_m2": 0.1, "stiffness_nm_rad": 1e6}
    raw["torsion"] = {"masses": [{"name": name, **mass}, {"name": "вал", **mass}]}
    model = build_model(load_mapping(raw, source="long").model)
    layout, book = Layout.of(model), Workbook()
    styles.add_styles(book)
    sheet = book.create_sheet(INPUT_SHEET)
    write_inputs(sheet, model, BlockWriter(layout, Values({}, {})))
    set_widths(sheet, model, layout, Values({}, {}))
    title = layout.cells["report_title"]
    (across,) = (each for each in sheet.merged_cells.ranges if each.min_row == title.row)
    room = sum(column_px(sheet, i) for i in range(across.min_col, across.max_col + 1))
    assert (across.min_row, across.max_col) == (title.row, MAX_COLUMN)
    assert _REGULAR.getlength(long) * _PX < room * (row_px(sheet, title.row) // _LINE)
    masses = [item for item in model.inputs if item.value == name]
    first = layout.cells[masses[0].name]
    assert _REGULAR.getlength(name) * _PX < column_px(sheet, first.column)


@pytest.mark.parametrize("name", ["d-240-bearings", "gots-diesel"])
def test_lists_beside_a_table_stand_one_below_the_other(name: str) -> None:
    """Side by side they made the print of «Орбиты подшипников» too small to be read."""
    model = coarse_model(name)
    layout, met = Layout.of(model), 0
    tables = {block.sheet for block in model.blocks if isinstance(block, TableSpec)}
    for title in tables:
        lists = [b for b in model.blocks if b.sheet == title and isinstance(b, ScalarTable)]
        assert len({layout.places[block.id].column for block in lists}) <= 1
        each = [
            {layout.places[block.id].row, *(layout.cells[s.key].row for s in block.scalars)}
            for block in lists
        ]
        rows = [row for own in each for row in own]
        assert len(set(rows)) == len(rows)
        met += len(lists) > 1
    assert met


@pytest.mark.parametrize("name", ["gots-diesel", "yamz-238", "d-240"])
def test_charts_stand_a_narrow_column_beside_their_tables(name: str) -> None:
    """However far a note above runs on."""
    layout, model, seen = Layout.of(coarse_model(name)), coarse_model(name), 0
    book = coarse_opened(name)
    for title in {table.sheet for table in model.tables.values()}:
        boxes = boxes_of(book[title])
        if not boxes or boxes[0].y > FOLD // 2:
            continue
        blocks = [block for block in model.blocks if block.sheet == title]
        edge = sum(column_px(book[title], i) for i in range(1, layout.last_column(blocks) + 1))
        assert 0 < min(box.x for box in boxes) - edge <= 30, title
        seen += 1
    assert seen > 5


def test_every_throw_of_two_rods_has_its_charts() -> None:
    charted = {chart.sheet for chart in coarse_model("yamz-238").charts}
    assert {f"Колено {i}" for i in range(1, 5)} | {"Цилиндры"} <= charted


def test_a_scheme_names_its_rows_and_throws() -> None:
    """Cranks apart from axes by dash and colour, all named, the lines told below."""
    drawn = parts("xl/charts/chart", "yamz-238", coarse=True).values()
    drawings = [etree.fromstring(data) for data in drawn]
    (scheme,) = [c for c in drawings if "Схема двигателя" in "".join(c.itertext())]
    names = [v.text for v in scheme.iterfind(f".//{C}ser/{C}tx/{C}v")]
    assert names[:2] == ["оси рядов", "колена"]
    assert {"цилиндры 1–4", "цилиндры 5–8", "колено 1", "колено 4"} <= set(names)
    dashes = [d.get("val") for d in scheme.iterfind(f".//{C}ser/{C}spPr/{A}ln/{A}prstDash")]
    assert dashes[:2] == ["lgDashDot", "solid"]
    assert scheme.find(f".//{C}legend") is not None


def test_two_charts_of_the_first_sheet_fit_a_small_screen() -> None:
    """1366 px less the numbers of rows and the bars at the right of LibreOffice."""
    for name in ("gots-diesel", "yamz-238"):
        boxes = boxes_of(coarse_opened(name)[CONTENTS_SHEET])
        top = [box for box in boxes if box.y == boxes[0].y]
        assert len(top) == 2
        assert max(box.right for box in top) <= 1366 - 114


@pytest.mark.parametrize("name", ["gots-diesel", "yamz-238"])
def test_words_of_the_first_sheet_have_room(name: str) -> None:
    """No letters made smaller, no tile's title cut: a V says whose pin is loaded most."""
    sheet = coarse_opened(name)[CONTENTS_SHEET]
    assert not [c.coordinate for row in sheet for c in row if c.alignment.shrink_to_fit]
    for first, last in SPANS:
        width = sum(column_px(sheet, index) for index in range(first, last + 1))
        letters = width / DIGIT * styles.SIZE / (styles.SIZE - 2)
        lines = lines_of(str(sheet.cell(VERDICT_ROW + 1, first).value), letters)
        assert row_px(sheet, VERDICT_ROW + 1) >= lines * 15
    links = {c.value for row in sheet for c in row if c.hyperlink}
    long = "Масса возвратно-поступательно движущихся деталей"
    assert long not in links
    assert "n" not in links


@pytest.mark.parametrize("name", ["gots-diesel", "vaz-2106"])
def test_no_note_lies_over_the_link_to_the_contents(name: str) -> None:
    for sheet in coarse_opened(name):
        notes = [c for c in sheet[2] if isinstance(c.value, str) and c.column > 1]
        if sheet.sheet_state == "visible" and notes and sheet["A2"].hyperlink:
            left = sum(column_px(sheet, i) for i in range(1, notes[0].column))
            assert left >= 80, sheet.title


def test_a_flywheel_that_is_not_needed_says_so() -> None:
    sheet = coarse_opened("gots-diesel")[CONTENTS_SHEET]
    looks = [c.number_format for row in sheet for c in row if "нужен" in c.number_format]
    assert len(looks) == 2  # a tile and the list of results
    assert all(look.endswith('не нужен"') and look.count(";") == 2 for look in looks)


def test_a_reason_of_an_accepted_check_has_room() -> None:
    sheet = coarse_opened("gots-diesel")["Проверки"]
    reasons = [c for c in sheet["F"] if isinstance(c.value, str) and "в учебнике" in c.value]
    assert reasons
    for cell in reasons:
        assert cell.alignment.wrap_text
        lines = lines_of(cell.value, sheet.column_dimensions["F"].width)
        assert row_px(sheet, cell.row) >= 20 * lines
