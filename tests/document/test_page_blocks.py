"""«Продолжение таблицы» and «Окончание таблицы» on thirty layouts, in one document."""

import dataclasses
import re
from dataclasses import dataclass

import pytest

from reports.document.page.blocks import DocumentInfo, TableBlock, TableColumn, table_block
from reports.document.page.numbering import Label
from reports.document.page.render import environment, render
from reports.document.page.style import USUAL
from tests.document.pdftools import pages_of, poppler

LONG = "Очень длинное название таблицы, которое занимает несколько строк над её головкой, " * 3
SIMPLE = [TableColumn("i"), TableColumn("K"), TableColumn("T"), TableColumn("R")]
SOURCE = """{% extends "report/base.html.j2" %}
{% import "report/macros.html.j2" as m with context %}
{% block body %}
{% for case in cases %}
<h1>Случай {{ case.number }}</h1>
<div style="height:{{ case.above }}mm"></div>
{{ m.table(case.block, case.label, case.caption, size=case.size, column_numbers=case.numbers) }}
{% if case.after %}<p>После таблицы {{ case.number }}.</p>{% endif %}
{% endfor %}
{% endblock %}"""


@dataclass
class Case:
    number: int
    rows: int
    above: int
    caption: str = "Силы"
    size: str = ""
    numbers: bool = True
    after: bool = True
    slow: bool = False
    wide: bool = False

    @property
    def label(self) -> Label:
        return Label("table", str(self.number), f"П{self.number}", f"tab-{self.number}")

    def mark(self, row: int) -> str:
        return f"{10 + self.number}{row:03d}"

    @property
    def block(self) -> TableBlock:
        if self.wide:  # two parts one below the other
            heads = [TableColumn(f"M{index}") for index in range(20)]
            return table_block(heads, [[self.mark(i), *["−1234,5"] * 19] for i in range(self.rows)])
        rows = [[self.mark(i), "1,5", "−2,5", "0,25"] for i in range(self.rows)]
        columns = SIMPLE
        if self.slow:  # unequal columns: cells, not lines
            columns = [dataclasses.replace(columns[0], width=2.0), *columns[1:]]
        return table_block(columns, rows)


SHAPES = [
    {"rows": rows, "above": above}
    for rows in (1, 2, 4, 7, 38, 39, 40, 41, 75, 110)
    for above in (0, 120)
]
SHAPES += [{"rows": 12, "above": above} for above in range(150, 215, 6)]
SHAPES += [
    {"rows": 60, "above": 40, "caption": LONG},
    {"rows": 60, "above": 190, "caption": LONG},
    {"rows": 60, "above": 40, "caption": ""},
    {"rows": 90, "above": 10, "size": "dense"},
    {"rows": 130, "above": 10, "size": "tiny"},
    {"rows": 90, "above": 10, "numbers": False},
    {"rows": 90, "above": 100, "after": False},
    {"rows": 42, "above": 0, "after": False},
]
SHAPES += [{**shape, "slow": True} for shape in SHAPES if shape["rows"] >= 12]
CASES = [Case(number, **shape) for number, shape in enumerate(SHAPES, 1)]
WIDE = [
    Case(len(CASES) + number, rows, above, wide=True)
    for number, (rows, above) in enumerate(
        [(4, 0), (4, 195), (25, 0), (25, 90), (37, 60), (41, 100), (73, 20), (110, 0)], 1
    )
]


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    html = environment().from_string(SOURCE).render(doc=DocumentInfo("x"), cases=[*CASES, *WIDE])
    result = render(html)
    assert result.warnings == ()
    folder = tmp_path_factory.mktemp("tables")
    texts = pages_of(result.pdf, folder)
    return texts, folder / "text.pdf"


def places(texts: list[str], case: Case) -> dict[int, list[int]]:
    """Rows of the table on each page."""
    collected: dict[int, list[int]] = {}
    for number, text in enumerate(texts):
        rows = [int(row) for row in re.findall(rf"\b{10 + case.number}(\d\d\d)\b", text)]
        if rows:
            collected[number] = rows
    return collected


def lines_of(block: TableBlock, size: str):
    return block.tabbed(USUAL.table_em_px(size), USUAL.width_px)


def test_enough_layouts_break():
    assert len(CASES) >= 30
    fast = [
        case
        for case in CASES
        if case.block.tabbed(USUAL.table_em_px(case.size), USUAL.width_px) is not None
    ]
    assert len(fast) >= 20 and len(CASES) - len(fast) >= 20


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.number}-{case.rows}r")
def test_layout(pages, case):
    texts, _ = pages
    actual = places(texts, case)
    assert [row for rows in actual.values() for row in rows] == list(range(case.rows))
    *_, last = actual
    for order, (page, rows) in enumerate(actual.items()):
        text = texts[page]
        first_line = text.strip().splitlines()[0].strip()
        started = re.search(rf"Таблица\s+П{case.number}\b", text)
        middle = f"Продолжение таблицы П{case.number}\n" in text
        end = f"Окончание таблицы П{case.number}\n" in text
        assert bool(started) == (order == 0)
        assert middle == (order > 0 and page != last)
        assert end == (order > 0 and page == last)
        if order > 0:
            assert first_line.endswith(f"таблицы П{case.number}")
        assert re.search(r"i\s+.*R|K\s+T", text), "the heading repeats"
        if case.numbers:
            assert re.search(r"^\s*1\s+2\s+3\s+4\s*$", text, re.MULTILINE)
        if case.rows >= 6:
            assert len(rows) >= 3, "no lonely rows"
    for page, text in enumerate(texts):
        if page not in actual:
            assert f"таблицы П{case.number}\n" not in text


@pytest.mark.parametrize("case", WIDE, ids=lambda case: f"{case.rows}r-{case.above}")
def test_a_table_in_parts_ends_once(pages, case):
    """A last part that went over a page was called the end twice, where it began and on top."""
    said = re.findall(rf"(\w+)\s+(?:таблицы )?П{case.number}\n", "\n".join(pages[0]))
    assert set(said[:-1]) <= {"Продолжение"}
    assert said[-1] == "Окончание"


def test_many_layouts_really_continue(pages):
    texts, _ = pages
    assert sum("Окончание таблицы" in text for text in texts) >= 20
    assert sum("Продолжение таблицы" in text for text in texts) >= 5


def test_continuation_line_stands_between_margin_and_heading(pages):
    texts, path = pages
    page = next(n for n, text in enumerate(texts, 1) if "Продолжение таблицы" in text)
    box = poppler("pdftotext", "-bbox", "-f", str(page), "-l", str(page), str(path), "-")
    words = re.findall(
        r'<word xMin="([\d.]+)" yMin="([\d.]+)" xMax="[\d.]+" yMax="([\d.]+)">([^<]*)<', box
    )
    line = next(word for word in words if word[3] == "Продолжение")
    heading = min(float(word[1]) for word in words if word[3] in ("i", "K", "T", "R"))
    assert float(line[0]) == pytest.approx(30 / 25.4 * 72, abs=1)  # left margin
    assert float(line[1]) >= 20 / 25.4 * 72 - 3
    assert float(line[2]) <= heading + 1


def test_wrong_count_of_cells_is_refused():
    with pytest.raises(ValueError, match="ячеек 2, граф 3"):
        table_block([TableColumn("a"), TableColumn("b"), TableColumn("c")], [["1", "2"]])


def test_cells_are_escaped_and_lined_up():
    block = table_block(
        [TableColumn("a"), TableColumn("t", text=True)], [["1,5", "<b>"], ["−12,5", "x"]]
    )
    assert block.rows[0][0] == "\u00a0" * 5 + "1,5"
    label = Label("table", "x", "1", "tab-x")
    source = '{% import "report/macros.html.j2" as m with context %}{{ m.table(b, l, "a<b") }}'
    html = environment().from_string(source).render(b=block, l=label)
    assert "&lt;b&gt;" in html and "a&lt;b" in html and "<b>" not in html


@pytest.mark.parametrize("size", ["", "dense", "tiny"])
def test_lines_stand_under_their_headings(size, tmp_path):
    count = 9
    columns = [TableColumn(f"H{k}") for k in range(count)]
    rows = [[f"{k + 1}{row:02d},{k}" for k in range(count)] for row in range(20)]
    block = table_block(columns, rows)
    assert lines_of(block, size) is not None
    source = (
        '{% extends "report/base.html.j2" %}{% import "report/macros.html.j2" as m with context %}'
        "{% block body %}{{ m.table(b, l, 'x', size=size) }}{% endblock %}"
    )
    html = (
        environment()
        .from_string(source)
        .render(b=block, l=Label("table", "x", "1", "tab-x"), size=size, doc=DocumentInfo("x"))
    )
    path = tmp_path / "a.pdf"
    path.write_bytes(render(html).pdf)
    words = re.findall(
        r'<word xMin="([\d.]+)" yMin="[\d.]+" xMax="([\d.]+)" yMax="[\d.]+">([^<]*)<',
        poppler("pdftotext", "-bbox", str(path), "-"),
    )
    middle = {text.strip("\u00a0"): (float(a) + float(b)) / 2 for a, b, text in words}
    ends = {text.strip("\u00a0"): float(b) for _, b, text in words}
    for k in range(count):
        cells = [f"{k + 1}{row:02d},{k}" for row in range(20)]
        assert all(abs(middle[cell] - middle[f"H{k}"]) < 6 for cell in cells)
        assert max(ends[cell] for cell in cells) - min(ends[cell] for cell in cells) < 0.5
