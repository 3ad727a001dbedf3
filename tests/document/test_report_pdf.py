"""The finished report: everything is there, numbered, in STIX, with decimal commas."""

import itertools
import re
import zlib
from pathlib import Path

import pytest

from reports.document.report import Report
from tests.browser import measure, photograph, print_out
from tests.document.pdftools import fonts_of, pages_of, poppler
from tests.document.report_samples import html_page, pdf, pdf_with_files, terms, terms_of, text_of

NAMES = ["one", "gots-diesel"]
ALLOWED_POINTS = [
    r"(П\d|[АБ])\.\w+(\.\d+)?",  # tables of the appendix
    r"п\.\s*\d\.\d",  # sections of the textbook
    r"(?m)^\s*\d+(\.\d+){1,2}\s+[А-ЯЁ]",  # headings, contents
    r"\.{3,}\s*\d+",
    r"\(\d\.\d+\)",  # numbers of formulas in other books
]


@pytest.fixture(scope="session")
def texts(tmp_path_factory):
    collected = {}

    def text(name):
        if name not in collected:
            folder = tmp_path_factory.mktemp(name)
            collected[name] = pages_of(pdf(name), folder)
        return collected[name]

    return text


@pytest.mark.parametrize("name", NAMES)
def test_sets_without_a_warning_and_in_stix(name, tmp_path):
    fonts = fonts_of(pdf(name), tmp_path)  # warnings are errors where it is made
    assert fonts and all(font.startswith("STIX") for font in fonts)


def expected_tables(name: str) -> set[str]:
    throws = len(terms(name).model.input.crankshaft.throw_angles_deg)
    journals = {f"П4.3.{k}" for k in range(1, throws + 2)}
    return {
        "П3.1",
        "П3.2",
        "П4.1",
        "П4.2",
        "П4.4",
        "П4.5",
    } | journals


@pytest.mark.parametrize("name", NAMES)
def test_every_table_and_figure_stands_in_order(texts, name):
    text = "\n".join(texts(name))
    figures = [int(n) for n in re.findall(r"Рисунок\s(\d+)\s—", text)]
    assert figures == list(range(1, len(figures) + 1))
    throws = len(terms(name).model.input.crankshaft.throw_angles_deg)
    # 15 before the journals, the scheme, three for each journal, running-on torques
    panels = 2 * -(-throws // 2)
    assert len(figures) >= 15 + 1 + 3 * (throws + 1) + panels
    captions = " ".join(text.split())
    for k in range(1, throws + 2):
        for words in ("Полярная диаграмма удельной нагрузки на коренную шейку",
                      "Развёрнутая диаграмма нагрузки на коренную шейку",
                      "Условная диаграмма износа коренной шейки"):  # fmt: skip
            assert f"— {words} {k}" in captions
    tables = re.findall(r"Таблица\s(\S+)\s—", text)
    own = [int(number) for number in tables if number.isdigit()]
    assert own == list(range(1, len(own) + 1))
    for letter in "АБ":
        there = [number for number in tables if number.startswith(letter)]
        assert there == [f"{letter}.{index}" for index in range(1, len(there) + 1)]
    books = re.findall(r"Таблица\s[АБ]\.\d+\s—[^()]*\((П[^)]*)\)", text)
    numbers = {number for caption in books for number in re.split(r",\s*", caption)}
    assert expected_tables(name) == {number.replace("\n", "") for number in numbers}


@pytest.mark.parametrize("name", NAMES)
def test_all_rows_are_printed(texts, name):
    text = "\n".join(texts(name))
    start = re.search(r"Таблица\sБ\.2\s—", text).start()
    end = re.search(r"Таблица\sБ\.3\s—", text).start()
    angles = re.findall(r"(?m)^\s*(\d+)\s+−?\d+,\d+", text[start:end])
    assert [int(angle) for angle in angles] == list(
        range(0, 721, terms(name).model.input.calculation.step_deg)
    )


@pytest.mark.parametrize("name", NAMES)
def test_no_leftovers_and_no_decimal_points(texts, name):
    text = "\n".join(texts(name))
    for word in ("nan", "None", "Undefined", "inf ", "{{", "{%", "Error", "True", "False"):
        assert word not in text, word
    for pattern in ALLOWED_POINTS:
        text = re.sub(pattern, " ", text)
    assert re.findall(r".{20}\d\.\d.{10}", text) == []


@pytest.mark.parametrize("name", NAMES)
def test_contents_give_the_pages_of_the_headings(texts, name):
    pages = texts(name)
    (contents,) = (page for page in pages if "СОДЕРЖАНИЕ" in page)
    lines = re.findall(r"(?m)^\s*(.+?)\s?\.{4,}\s*(\d+)\s*$", contents)
    assert len(lines) >= 18
    for title, page in lines:
        words = title.split()[-1]
        assert words.lower() in pages[int(page) - 1].lower().replace("\n", " "), (title, page)


def test_links_lead_somewhere():
    html = html_page("one")
    anchors = set(re.findall(r'\bid="([^"]+)"', html))
    targets = set(re.findall(r'href="#([^"]+)"', html))
    assert len(targets) > 60
    assert targets <= anchors


def test_conclusions_come_from_the_numbers(texts):
    for name in NAMES:
        source = terms(name)
        text = " ".join("\n".join(texts(name)).split())
        for key in ("M_mean", "M_max", "N_i_calc", "Rpin_max_kN", "q_pin_max", "v_max"):
            beside = "c_m" if key == "v_max" else ""
            shown = source.num(key, beside=beside).replace("\u00a0", " ")
            conclusion = text[text.index("Основные результаты") :]
            assert shown in conclusion, (name, key)
        worst = round(source.value("worst_main_load"))
        assert f"более всего нагружена шейка {worst}" in text


def test_a_failed_check_is_said_plainly(texts):
    failed = " ".join("\n".join(texts("gots-diesel")).split())
    assert terms("gots-diesel").values.scalars["check_power"] == "НЕТ"
    assert "Расхождение выходит за допустимые" in failed
    assert "не сходится с мощностью" in failed and "Не выполнена проверка" in failed
    for name in NAMES:
        verdicts = [v for k, v in terms(name).values.scalars.items() if k.startswith("check_")]
        said = "Все проверки расчёта выполнены" in " ".join("\n".join(texts(name)).split())
        assert said == ("НЕТ" not in verdicts), name


def test_what_the_input_asks_for_is_said(texts):
    one = " ".join("\n".join(texts("one")).split())
    assert "по точной формуле" in one and "XVIII" in one
    assert "заданным точкам" in one and "одноцилиндровый" in one.lower()
    assert "средний момент с ней не сопоставлен" in one
    assert html_page("gots-p43").count("противоречат углам колен") >= 2
    assert "противоречат углам колен" not in one


@pytest.mark.usefixtures("few_chapters")
def test_input_and_workbook_are_attached(tmp_path):
    path = tmp_path / "r.pdf"
    path.write_bytes(pdf_with_files("one", tmp_path))
    listed = poppler("pdfdetach", "-list", str(path))
    assert "2 embedded files" in listed
    poppler("pdfdetach", "-saveall", "-o", str(tmp_path), str(path))
    assert (tmp_path / "one.xlsx").read_bytes() == b"PK-book"
    assert len(list(tmp_path.glob("исходные*.toml"))) == 1


def test_without_pango_it_says_so(monkeypatch, tmp_path):
    from reports.shared import doctor
    from reports.shared.errors import SystemPartMissing

    monkeypatch.setattr(doctor, "pango_loads", lambda: False)
    with pytest.raises(SystemPartMissing, match="pango"):
        pdf_with_files("one", tmp_path)


STREAM = re.compile(rb"stream\r?\n(.*?)\r?\nendstream", re.DOTALL)
MAY_HOLD = {
    "Table": {"TR", "THead", "TBody", "TFoot", "Caption"},
    "THead": {"TR"},
    "TBody": {"TR"},
    "TR": {"TH", "TD"},
    "L": {"LI", "Caption"},
    "LI": {"Lbl", "LBody"},
}


def tree(text: str) -> list[tuple[int, str]]:
    """Depth and name of each tag, in order."""
    matches = re.findall(r"(?m)^( *)([A-Z][A-Za-z0-9]*)(?:\s\((?:block|inline)\)|:)?$", text)
    return [(len(blanks) // 2, name) for blanks, name in matches]


def misplaced(tags: list[tuple[int, str]]) -> list[tuple[str, str]]:
    """Tags within a table or a list that may not stand there."""
    wrong, above = [], []
    for depth, name in tags:
        above[depth:] = [name]
        parent = above[depth - 1] if depth else ""
        if parent in MAY_HOLD and name not in MAY_HOLD[parent]:
            wrong.append((parent, name))
    return wrong


def skipped(tags: list[tuple[int, str]]) -> list[int]:
    """Levels of headings that follow one more than a level above."""
    levels = [0, *(int(name[1]) for _, name in tags if re.fullmatch(r"H[1-6]", name))]
    return [new for old, new in itertools.pairwise(levels) if new > old + 1]


def objects(pdf: bytes) -> bytes:
    """The file with its object streams laid open."""
    packed = [STREAM.search(part) for part in re.split(rb"endobj", pdf) if b"/ObjStm" in part]
    return pdf + b"\n".join(zlib.decompress(item[1]) for item in packed if item)


def test_tags_follow_the_rules_of_pdf_ua(tmp_path):
    path = tmp_path / "r.pdf"
    path.write_bytes(pdf("one"))
    tags = tree(poppler("pdfinfo", "-struct", str(path)))
    names = [name for _, name in tags]
    assert misplaced(tags) == [] and skipped(tags) == []
    tables, figures, formulas = (names.count(name) for name in ("Table", "Figure", "Formula"))
    assert names[0] == "Document" and tables > 10 and figures > 10 and formulas > 50
    said = objects(path.read_bytes())
    assert said.count(b"/Alt ") == figures + formulas
    assert b"/Lang (ru" in said and b"/DisplayDocTitle true" in said
    about = poppler("pdfinfo", str(path))
    assert re.search(r"Title: +\S", about) and re.search(r"Tagged: +yes", about)


def test_a_wrong_tag_is_noticed():
    assert misplaced([(0, "Table"), (1, "P"), (1, "TR"), (2, "TD"), (3, "P")]) == [("Table", "P")]
    assert skipped([(0, "H1"), (0, "H3"), (0, "H1"), (0, "H2")]) == [3]


@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_does_not_scroll_sideways(width, tmp_path):
    measured = measure(html_page("one"), width, tmp_path / "w", boxes=".tbox, .eq")
    assert measured["width"] == width
    assert measured["scroll"] <= width and measured["wide"] == []
    assert measured["scripts"] == 0
    assert "STIXGeneral" in measured["fonts"]
    assert len(measured["images"]) > 100 and min(measured["images"]) > 0
    scrolled = [box for box in measured["boxes"] if box[1] > box[0]]
    assert bool(scrolled) == (width == 390)  # wide tables scroll in their own box


def test_a_page_that_is_too_wide_is_noticed(tmp_path):
    measured = measure('<main><div style="width:900px">x</div></main>', 390, tmp_path / "w")
    assert measured["scroll"] > 390 and measured["wide"]


def test_the_page_can_be_photographed(tmp_path):
    picture = photograph(html_page("one"), 390, 2000, tmp_path / "p.png", tmp_path / "w")
    assert picture.stat().st_size > 20_000


def test_what_the_browser_prints_reads_as_the_report_does(tmp_path):
    """The year is at the foot of the title page, and no number is missing in the abstract."""
    pdf = print_out(html_page("one"), tmp_path / "p.pdf", tmp_path / "w").read_bytes()
    title, *others = (" ".join(page.split()) for page in pages_of(pdf, tmp_path))
    assert re.search(r"Допущен к защите .*20\d\d( 1)?$", title), title
    (abstract,) = (page for page in others if "РЕФЕРАТ" in page and "записка" in page)
    assert re.search(r"записка \d+ рис\.", abstract), abstract


def test_the_frame_takes_no_page_numbers_from_the_browser():
    """The sheets of a browser have no frame, hence no number in it: the usual one stays."""
    source = terms_of(text_of("one").replace("[report]\n", '[report]\nframe = "eskd"\n', 1))
    page = Report.of(source.model, source.values, Path("t.toml")).page("screen")
    assert "counter(page)" in page
    assert "form2" not in page
