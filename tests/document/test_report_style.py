"""A department's style file, the profiles and the chapters picked."""

import re

import pytest

from reports.document.chapters.contents import CHAPTERS
from reports.document.chapters.record import chosen
from reports.document.page.render import render
from reports.document.page.style import Style, read
from reports.document.report import Report, find_style
from reports.inputs.load import load_text
from reports.inputs.sections import report as sections
from reports.shared.errors import InputError
from tests.cover import sparse
from tests.document.pdftools import pages_of
from tests.document.report_samples import ONE, terms_of, with_detail

STYLE = """
font_size_pt = 12
line_spacing = 1.2
numbering = "chapter"
page_number = "bottom-right"
frame = "eskd"
frame_from = 2
appendix = "Приложение"
table_step_deg = 90

[margins]
left = 25
right = 10

[title]
ministry = "Министерство образования"
kind = "Курсовая работа"
abstract = false
"""


def page_of(text: str, style: Style | None = None) -> str:
    t = terms_of(text)
    return Report(t.model, t.values, style=style or Style()).page("print")


def titles(page: str) -> list[str]:
    return re.findall(r"<h1[^>]*>(?:<span class=\"\w+\">)?(.*?)</h1>", page)


def test_names_of_chapters_are_stated_once():
    names = [record.name for record in CHAPTERS]
    assert len(set(names)) == len(names)
    assert list(sections.CHAPTERS) == [n for n in names if n in sections.CHAPTERS]
    assert {record.name for record in CHAPTERS if record.profile == "always"} == (
        set(names) - set(sections.CHAPTERS)
    )
    assert sections.ChapterName.__args__ == tuple(sections.CHAPTERS)
    assert sections.Detail.__args__ == tuple(sections.DETAILS)


def test_profiles_hold_one_another():
    held = {
        d: chosen(CHAPTERS, load_text(with_detail(ONE, d), source="f").model)
        for d in sections.DETAILS
    }
    assert held["short"] < held["course"] < held["full"] == {r.name for r in CHAPTERS}


def test_every_course_note_has_balance_and_flywheel():
    """Whoever fills in the section or not; the short report ends before."""
    for detail, more in (("short", set()), ("course", set()), ("full", set())):
        plain, requested = (
            chosen(CHAPTERS, load_text(with_detail(ONE, detail) + keys, source="f").model)
            for keys in ("\n[balance]\n", "\n[balance]\nirregularity = 0.01\n")
        )
        assert requested - plain == more
        assert ("balance" in plain) == (detail != "short")
    picked = ONE.replace('detail = "full"', 'chapters = ["companions"]')
    # They were one chapter under that name.
    assert chosen(CHAPTERS, load_text(picked, source="f").model) >= {"balance", "companions"}


@pytest.mark.usefixtures("nothing_is_drawn")
@pytest.mark.parametrize("name", sparse(sections.CHAPTERS))
def test_every_chapter_stands_alone_and_may_be_left_out(name):
    """References to what is left out turn into words; none stays unresolved."""
    others = [other for other in sections.CHAPTERS if other != name]
    for picked in ([name], others):
        text = ONE.replace('detail = "full"', f"chapters = {picked}".replace("'", '"'))
        page = page_of(text)
        anchors = set(re.findall(r'\bid="([^"]+)"', page))
        assert set(re.findall(r'href="#([^"]+)"', page)) <= anchors
        # Said once for neighbours.
        assert not re.search(r"книги Excel и (<[^>]+>)?П", page)
        if picked == ["kinematics"]:
            assert "П3.1 книги Excel" in page


def test_a_style_file_changes_the_sheets(tmp_path):
    path = tmp_path / "style.toml"
    path.write_text(STYLE, encoding="utf-8")
    text = with_detail(ONE, "course").replace("step_deg = 30", "step_deg = 15")
    few = 'chapters = ["kinematics", "dynamics", "torque", "crankpin", "appendices"]\n'
    page = page_of(text.replace("[report]\n", "[report]\n" + few), read(path))
    result = render(page)
    assert result.warnings == ()
    pages = pages_of(result.pdf, tmp_path)
    assert "Министерство образования" in pages[0] and "Курсовая работа" in pages[0]
    whole = "\n".join(pages)
    # The frame begins with the assignment; the appendix is called as the department has it.
    assert ["Разраб." in sheet for sheet in pages[:3]] == [False, True, False]
    assert ["Взам. инв. №" in sheet.replace("\xa0", " ") for sheet in pages[:3]] == [
        False, True, True]  # fmt: skip
    assert len(Style().side_cells) == 5 and Style(side_columns=False).side_cells == ()
    assert whole.count("Приложение А") == 2 and "ПРИЛОЖЕНИЕ" not in whole
    assert "Реферат" not in page and "РЕФЕРАТ" not in whole
    assert re.search(r"Рисунок\s1\.1\s—", whole) and re.search(r"(?m)\(2\.1\)\s*$", whole)
    start = re.search(r"Таблица\sБ\.2\s—", whole).start()
    end = re.search(r"Таблица\sБ\.3\s—", whole).start()
    rows = re.findall(r"(?m)^\s*(\d+)\s+−?\d+,\d+", whole[start:end])
    assert rows == [str(angle) for angle in range(0, 721, 90)]
    assert "margin: 20.0mm 10.0mm 20.0mm 25.0mm" in page and "font-size: 12.0pt" in page


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("font_size_pt = 99", "font_size_pt"),
        ("fontsize = 12", "fontsize"),
        ('numbering = "roman"', "numbering"),
        ("[margins]\nleft = 'wide'", "margins.left"),
        ("font_size_pt = ", "обрывается"),
    ],
)
def test_a_bad_style_file_is_told_in_one_line(tmp_path, text, words):
    path = tmp_path / "style.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read(path)
    (line,) = caught.value.lines()
    assert words in line and "style.toml" in line and not re.search(r"[a-z]{4,} [a-z]{4,}", line)


def test_a_missing_style_file_is_told(tmp_path):
    for name, said in (("none.toml", r"none\.toml: файл не найден; "), (".", "это папка")):
        report = sections.ReportSection(style=name, year=2024)
        with pytest.raises(InputError, match=said):
            find_style(report, tmp_path)
