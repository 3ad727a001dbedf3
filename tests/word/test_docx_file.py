"""The Word file as a file: fields, pictures, styles, bytes; its schema is in test_schema."""

from __future__ import annotations

import base64
import io
import re
import zipfile
from unittest import mock

import lxml.html
import pytest
from click.testing import CliRunner
from docx import Document
from docx.shared import Emu
from lxml import etree

from reports.cli import main
from reports.document.page.style import Style
from reports.shared.resources import samples_dir, templates_dir
from reports.word import pictures
from reports.word.blocks import table_of
from reports.word.inline import Lines
from reports.word.markup import Bookmarks, bookmark_name
from reports.word.pictures import _glyph, outlined, picture
from reports.word.styles import looks
from tests.word.docx_samples import NAME, W, department, docx_of, page_of, part, text_of

pytestmark = pytest.mark.xdist_group(NAME)  # the process that makes the file


def instructions(data: bytes) -> list[str]:
    return [(e.text or "").strip() for e in part(data).iter(f"{W}instrText")]


def test_numbers_references_and_contents_are_fields():
    data = docx_of(NAME)
    fields, document = instructions(data), part(data)
    marks = [e.get(f"{W}name") for e in document.iter(f"{W}bookmarkStart")]
    assert len(marks) == len(set(marks)) and max(map(len, marks)) <= 40
    numbers = [e.get(f"{W}id") for e in document.iter(f"{W}bookmarkStart")]
    assert len(numbers) == len(set(numbers))
    referred = {f.split()[1] for f in fields if f.startswith(("REF", "PAGEREF"))}
    assert referred <= set(marks) and len(referred) > 60
    assert sum(f.startswith("TOC") for f in fields) == 1
    sequences = {f.split()[1] for f in fields if f.startswith("SEQ")}
    assert sequences == {"Рисунок", "Таблица", "Формула", "Источник", "Таблица_А", "Таблица_Б"}
    kinds = [e.get(f"{W}fldCharType") for e in document.iter(f"{W}fldChar")]
    assert kinds.count("begin") == kinds.count("separate") == kinds.count("end") == len(fields)


def test_counts_of_the_abstract_are_fields_and_pages_stand_in_the_contents():
    data = docx_of(NAME)
    fields, document = instructions(data), part(data)
    marks = {e.get(f"{W}name"): e.getparent() for e in document.iter(f"{W}bookmarkStart")}
    (counted,) = [f for f in fields if f.startswith("= ")]
    counting = ["last_ris0", "last_src0", *counted.removeprefix("= ").split(" + ")]
    assert set(counting) <= set(marks) and len(counting) == 5
    assert {"REF last_ris0 \\h", "REF last_src0 \\h", "NUMPAGES"} <= set(fields)
    pages = []
    for paragraph in document.iter(f"{W}p"):
        words = "".join(e.text or "" for e in paragraph.iter(f"{W}instrText"))
        if "PAGEREF" in words:
            pages.append(int([e.text for e in paragraph.iter(f"{W}t")][-1]))
    assert len(pages) > 20 and pages == sorted(pages) and pages[0] > 4


def test_what_fields_show_is_what_they_will_count():
    counted: dict[str, int] = {}
    shown: list[tuple[str, str]] = []
    for paragraph in part(docx_of(NAME)).iter(f"{W}p"):
        kind = None
        for element in paragraph.iter(f"{W}instrText", f"{W}t"):
            if element.tag == f"{W}instrText":
                words = element.text.split()
                kind = words[1] if words[0] == "SEQ" else None
            elif kind:
                counted[kind] = counted.get(kind, 0) + 1
                shown.append((element.text, str(counted[kind])))
                kind = None
    assert len(shown) > 100 and all(text == number for text, number in shown)


def test_figures_are_svg_with_a_png_and_words():
    data = docx_of(NAME)
    document = part(data)
    with zipfile.ZipFile(io.BytesIO(data)) as parts:
        names = parts.namelist()
        svg = [parts.read(n).decode() for n in names if n.endswith(".svg")]
        png = [n for n in names if n.endswith(".png")]
    figures = document.xpath("//*[local-name()='docPr']")
    assert len(figures) == len(svg) == len(png) > 15
    assert all(len(f.get("descr")) > 10 for f in figures)
    assert len({f.get("id") for f in figures}) == len(figures)
    assert not any("<text" in picture or "font" in picture.split(">", 1)[1] for picture in svg)


def test_a_style_file_changes_named_styles_and_not_the_text():
    usual, other = docx_of(NAME), department(NAME)
    sheet = part(other, "word/styles.xml")
    size = sheet.find(f"{W}docDefaults/{W}rPrDefault/{W}rPr/{W}sz")
    assert size.get(f"{W}val") == "24"
    body = next(s for s in sheet.iter(f"{W}style") if s.get(f"{W}styleId") == "BodyText")
    assert body.find(f"{W}pPr/{W}ind").get(f"{W}firstLine") == "567"
    head = next(s for s in sheet.iter(f"{W}style") if s.get(f"{W}styleId") == "Heading2")
    assert head.find(f"{W}pPr/{W}spacing").get(f"{W}before") == "420"
    names = {e.get(f"{W}val") for e in part(usual).iter(f"{W}pStyle")}
    defined = {s.get(f"{W}styleId") for s in sheet.iter(f"{W}style")}
    assert names <= defined
    # No letters and no intervals set by hand in the text: the styles decide.
    by_hand = {e.tag.removeprefix(W) for r in part(usual).iter(f"{W}rPr") for e in r}
    assert by_hand <= {"b", "i", "u", "caps", "vertAlign"}


def test_frames_and_title_blocks_stand_in_headers_and_footers():
    data = department(NAME)
    with zipfile.ZipFile(io.BytesIO(data)) as parts:
        feet = [part(data, n) for n in parts.namelist() if re.match(r"word/footer\d", n)]
    stamps = [foot for foot in feet if foot.find(f"{W}tbl") is not None]
    assert sorted(len(s.find(f"{W}tbl").findall(f"{W}tr")) for s in stamps) == [3, 8]
    assert all("Подп." in text_of(stamp) for stamp in stamps)
    fields = [[e.text.strip() for e in s.iter(f"{W}instrText")] for s in stamps]
    assert ["PAGE"] in fields and ["PAGE", "NUMPAGES"] in fields
    for stamp in stamps:  # the frame and two columns of boxes 19-23
        drawn = [e.get("prst") for e in stamp.iter() if e.tag.endswith("}prstGeom")]
        assert drawn == 11 * ["rect"] and text_of(stamp).count("Подп. и дата") == 2
    # It begins with the assignment, the second sheet.
    first = next(part(data).iter(f"{W}sectPr")).getparent().getparent()
    above = "".join(text_of(e) for e in first.itersiblings(preceding=True))
    assert "Допущен к защите" in above and "ЗАДАНИЕ" not in above


def test_a_long_table_is_told_to_go_on_where_a_department_wants_it():
    document = part(department(NAME))
    tables = [t for t in document.iter(f"{W}tbl") if "Продолжение таблицы" in text_of(t)]
    assert len(tables) > 10 and "Продолжение таблицы" not in text_of(part(docx_of(NAME)))
    for table in tables:
        first, *_ = table.findall(f"{W}tr")
        assert first.find(f"{W}trPr/{W}tblHeader") is not None
        caption = table.getprevious()
        number = re.match(r"Таблица\s([А-Б0-9.]+)", text_of(caption))[1]
        assert text_of(first) == f"Продолжение таблицы {number}"
        assert "FFFFFF" in etree.tostring(caption).decode()  # what covers the row here


def test_a_bad_style_file_is_refused_before_anything_is_written(tmp_path):
    style, out = tmp_path / "style.toml", tmp_path / "out"
    style.write_text("colour = 1", encoding="utf-8")
    sample = samples_dir() / f"{NAME}.toml"
    words = ["build", str(sample), "--only", "docx", "--style", str(style), "-o", str(out)]
    done = CliRunner().invoke(main, words)
    (line,) = done.output.strip().splitlines()[-1:]
    assert done.exit_code == 2 and "colour" in line and "style.toml" in line
    assert not out.exists()


def test_the_formats_of_the_input_are_made_and_are_the_same_bytes(tmp_path):
    text = (samples_dir() / f"{NAME}.toml").read_text(encoding="utf-8")
    source = tmp_path / f"{NAME}.toml"
    (tmp_path / "plain.toml").write_text("table_continuation = false", encoding="utf-8")
    formats = '[report]\nformats = ["xlsx", "docx"]\nstyle = "plain.toml"\n'
    source.write_text(text.replace("[report]\n", formats), encoding="utf-8")
    done = CliRunner().invoke(main, ["build", str(source), "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == [
        f"{NAME}.{kind}" for kind in ("docx", "xlsx")
    ]
    assert (tmp_path / "out" / f"{NAME}.docx").read_bytes() == docx_of(NAME)


def test_numbers_within_chapters():
    fields = instructions(department(NAME))
    assert "STYLEREF 1 \\s" in fields and "SEQ Рисунок \\* ARABIC \\s 1" in fields


def test_names_of_bookmarks_differ():
    anchors = ["eq-a.b", "eq-a_b", "ris-" + "x" * 50, "ris-" + "x" * 51, "tab-P3_1"]
    names = [bookmark_name(anchor) for anchor in anchors]
    assert len(set(names)) == len(names) and all(re.fullmatch(r"\w{1,40}", n) for n in names)
    assert bookmark_name("tab-P3_1") == "tab_P3_1"


def test_a_drawing_that_stands_twice_is_kept_once():
    image = lxml.html.fromstring(page_of(NAME)).xpath("//img[starts-with(@src, 'data:image/svg')]")
    document, file = Document(), io.BytesIO()
    figures = pictures.Pictures(document)
    dot = picture('<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1"/>', 1)
    with mock.patch.object(pictures, "picture", return_value=dot):
        drawn = [figures.figure(image[0], 160) for _ in range(2)]
    document.save(file)
    with zipfile.ZipFile(file) as parts:
        names = [name for name in parts.namelist() if name.startswith("word/media")]
    assert len(drawn) == len(names) == len(set(names)) == 2  # a PNG and an SVG


@pytest.mark.parametrize(("widest_mm", "size_mm"), [(160, (90, 30)), (60, (60, 20))])
def test_a_figure_is_as_wide_as_on_the_page_and_no_wider_than_the_text(widest_mm, size_mm):
    svg = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 300 100" width="300" height="100"/>'
    source = base64.b64encode(svg.encode()).decode()
    image = lxml.html.fromstring(
        f'<img style="width:90mm" src="data:image/svg+xml;base64,{source}"/>'
    )
    drawn = pictures.Pictures(Document()).figure(image, widest_mm)
    sizes = drawn.xpath("//*[local-name()='extent' or local-name()='ext'][@cx]")
    assert len(sizes) == 2
    for size in sizes:
        assert tuple(Emu(int(size.get(key))).mm for key in ("cx", "cy")) == size_mm


def test_columns_are_as_wide_as_on_the_page():
    source = lxml.html.fromstring(
        '<table><colgroup><col style="width:25%"/><col style="width:75%"/></colgroup>'
        "<tbody><tr><td>a</td><td>b</td></tr></tbody></table>"
    )
    built = table_of(Lines(Bookmarks()), source, 4000)
    widths = [e.get(f"{W}w") for name in ("gridCol", "tcW") for e in built.iter(f"{W}{name}")]
    assert widths == ["1000", "3000"] * 2


def test_headings_stand_in_the_outline_at_their_levels():
    with zipfile.ZipFile(io.BytesIO(docx_of(NAME))) as parts:
        styles = etree.fromstring(parts.read("word/styles.xml"))
    levels = {
        style.find(f"{W}name").get(f"{W}val"): level.get(f"{W}val")
        for style in styles.iter(f"{W}style") for level in style.iter(f"{W}outlineLvl")
    }  # fmt: skip
    headings = {name: level for name, level in levels.items() if name.startswith("heading ")}
    assert len(headings) > 1
    assert all(int(name[-1]) == int(level) + 1 for name, level in headings.items())


@pytest.mark.parametrize(("pages", "shown"), [(77, "77"), (0, "")])
def test_the_last_page_is_told_as_it_was_set(pages, shown):
    source = lxml.html.fromstring('<p><a href="#report-end">5</a></p>')
    page = Lines(Bookmarks(), pages=pages).runs(source)
    assert "".join(e.text or "" for run in page for e in run.iter(f"{W}t")) == shown


def test_letters_of_a_figure_stand_one_after_another():
    """As far apart as the face has them: each letter begins where the last one ends."""
    built = outlined('<svg xmlns="http://www.w3.org/2000/svg"><text font-size="8">ll</text></svg>')
    places = [float(x) for x in re.findall(r"M([\d.]+) ", built)]
    advance = _glyph("normal", "normal", "normal", "l")[1]
    assert places[1] - places[0] == pytest.approx(8 * advance, abs=0.02)


def test_lines_of_the_assignment_are_as_far_apart_as_in_the_pdf():
    """Else it takes two sheets where the PDF's takes one."""
    css = (templates_dir() / "report" / "report.css.j2").read_text(encoding="utf-8")
    points, factor = re.search(
        r"\.task \{ font-size: (\d+)pt; line-height: ([\d.]+);", css
    ).groups()
    task = looks(Style())["Task"]
    assert task.size == float(points)
    assert task.line * 1.149 * task.size == pytest.approx(float(factor) * float(points), rel=0.01)
