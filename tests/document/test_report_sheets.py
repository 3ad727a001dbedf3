"""Title, assignment, abstract, the ЕСКД frame, the short report, own templates."""

import json
import re
import zlib
from pathlib import Path

import pytest

from reports.document.chapters.front import title_block
from reports.document.page.render import render
from reports.document.report import Report
from reports.shared.errors import InputError
from tests.document.pdftools import pages_of, poppler
from tests.document.report_samples import ONE, pdf, terms, terms_of

DATA = """[report]
student = "Иванов И. И."
group = "ДВС-121"
supervisor = "Петров П. П."
institution = "Университет"
department = "Тепловые двигатели"
discipline = "Динамика двигателей"
designation = "КП.01.00.000 ПЗ"
controller = "Нормов Н. Н."
approver = "Утверждаев У. У."
issued = "01.09.2026"
due = "20.12.2026"
frame = "eskd"
detail = "course"
"""
# Chapters of the report whose sheets are looked at: the less is set.
FEW = 'chapters = ["kinematics", "dynamics", "torque", "appendices"]\n'


@pytest.fixture(scope="module")
def framed(tmp_path_factory):
    text = ONE.replace("step_deg = 30", "step_deg = 10").replace('detail = "full"\n', "")
    t = terms_of(text.replace("[report]\n", DATA + FEW))
    result = render(Report(t.model, t.values).page("print"))
    assert result.warnings == ()
    folder = tmp_path_factory.mktemp("framed")
    return result, pages_of(result.pdf, folder), folder


def flat(text: str) -> str:
    return " ".join(text.split())


def test_abstract_counts_what_is_there(tmp_path):
    sheets = pages_of(pdf("one"), tmp_path)
    text = "\n".join(sheets)
    said = re.search(
        r"Пояснительная\sзаписка\s(\d+)\sс\.,\s(\d+)\sрис\.,\s(\d+)\sтабл\.,\s(\d+)\sисточн\.", text
    )
    pages, figures, tables, sources = map(int, said.groups())
    assert pages == len(sheets)
    assert figures == len(re.findall(r"Рисунок\s\d+\s—", text))
    assert tables == len(re.findall(r"Таблица\s\S+\s—", text))
    listed = text[
        text.index("СПИСОК ИСПОЛЬЗОВАННЫХ ИСТОЧНИКОВ", text.index("Основные результаты")) :
    ]
    assert sources == len(re.findall(r"(?m)^\s*\d+\.\s+[А-Я]", listed[: listed.index("ПРИЛОЖ")]))


def test_assignment_is_filled_from_the_input(framed):
    sheet = flat(framed[1][1]).replace("\u2010 ", "")  # words broken at an end of line
    for words in ("ЗАДАНИЕ на курсовой проект", "Студент: Иванов И. И.", "Срок сдачи: 20.12.2026",
                  "Дата выдачи задания: 01.09.2026", "диаметр цилиндра — 80 мм",
                  "частота вращения — 3600 мин"):  # fmt: skip
        assert words in sheet, words
    assert "sup" not in sheet


def test_what_is_not_known_is_left_to_the_pen(tmp_path):
    sheet = pages_of(pdf("one"), tmp_path)[1]
    assert re.search(r"Студент:\s*$", sheet, flags=re.MULTILINE)


def test_title_block_on_the_first_text_sheet_only(framed):
    result, pages, _ = framed
    assert all("докум" not in page for page in pages[:2])
    first = flat(pages[2])
    for words in ("Разраб. Иванов", "Пров. Петров", "Н. контр. Нормов", "Утв. Утверждаев",
                  "КП.01.00.000 ПЗ", "Листов", f"3 {result.pages}"):  # fmt: skip
        assert words in first, words
    for number, page in enumerate(pages[3:], start=4):
        text = flat(page)
        assert "докум" in text and "Разраб" not in text and "КП.01.00.000 ПЗ" in text
        assert re.search(rf"\b{number}\b", text)


def test_without_frame_there_is_no_title_block(tmp_path):
    text = "".join(pages_of(pdf("one"), tmp_path))
    assert "докум" not in text


def test_a_course_report_prints_rows_at_thirty_degrees(framed):
    text = "\n".join(framed[1])
    start = re.search(r"Таблица\sБ\.2\s—", text).start()
    end = re.search(r"Таблица\sБ\.3\s—", text).start()
    rows = [int(a) for a in re.findall(r"(?m)^\s*(\d+)\s+−?\d+,\d+", text[start:end])]
    assert rows == [*range(0, 721, 30)]
    assert "в записке они напечатаны через 30°" in flat(text).replace("\u2010 ", "")


def own(folder: Path, name: str, text: str) -> str:
    (folder / "own").mkdir(exist_ok=True)
    (folder / "own" / name).write_text(text, encoding="utf-8")
    return ONE.replace("[report]\n", '[report]\ntemplates = "own"\n')


def html_of(text: str, folder: Path) -> str:
    t = terms_of(text)
    return Report.of(t.model, t.values, folder / "in.toml").page("screen")


@pytest.mark.usefixtures("few_chapters")
def test_own_templates_replace_and_extend(tmp_path):
    own(tmp_path, "report.css.j2", "{% include 'kshm/report/report.css.j2' %} p { color: #123456 }")
    text = own(tmp_path, "cover.html.j2", "<p>Бланк {{ cover_page.year }}</p>")
    page = html_of(text, tmp_path)
    assert "Бланк 2024" in page and "#123456" in page and "Расчётно-пояснительная" not in page
    assert "Расчётно-пояснительная" in html_of(ONE, tmp_path)


@pytest.mark.usefixtures("few_chapters")
@pytest.mark.parametrize(
    ("name", "text", "line", "words"),
    [
        ("cover.html.j2", "<p>\n{% if %}</p>", 2, "ожидается выражение, а стоит «%}»"),
        ("cover.html.j2", "<p>\n\n{{ nothing.here }}</p>", 3, "нет имени nothing"),
        ("cover.html.j2", "\n{{ ''.__class__.__mro__ }}", 2, "обращаться к __class__ нельзя"),
        ("cover.html.j2", "{% if block %}\n<p>", 2, "if не закрыт: нет elif, else или endif"),
        ("cover.html.j2", "\n{% endif %}", 2, "endif без начала блока"),
        ("cover.html.j2", "{% for a in b %}{% endif %}", 1, "ожидается endfor или else"),
        ("cover.html.j2", "\n{{ input", 2, "шаблон обрывается, ожидается «}}»"),
        ("cover.html.j2", "\n{# input", 2, "не закрыт комментарий"),
        ("cover.html.j2", "{{ input | upcase }}", 1, "нет фильтра upcase"),
        ("cover.html.j2", "{{ input 'x }}", 1, "лишний знак «'»"),
        ("cover.html.j2", "{{ input.engine.power }}", 1, "нет свойства power"),
        ("cover.html.j2", "{{ t.val('M_max', 1, 2, 3) }}", 1, "лишние аргументы"),
        ("cover.html.j2", "{{ t.val('P4_1.T_MPa') }}", 1, "величины P4_1.T_MPa нет числа"),
        ("cover.html.j2", "{% include 'no.j2' %}", 1, "нет шаблона no.j2"),
        ("cover.html.j2", "{{ t.num('M_max') + 1 }}", 1, "значениями разных видов"),
    ],
)
def test_a_broken_template_is_told_by_line(tmp_path, name, text, line, words):
    source = own(tmp_path, name, text)
    with pytest.raises(InputError) as caught:
        html_of(source, tmp_path)
    (message,) = caught.value.lines()
    assert f"{name}, строка {line}: " in message and words in message
    said = message.partition(f"строка {line}: ")[2]
    assert "\n" not in message and not re.search("[A-Za-z]{3,} [a-z]{2,}", said)


@pytest.mark.usefixtures("few_chapters")
def test_a_template_in_another_encoding_is_told(tmp_path):
    source = own(tmp_path, "cover.html.j2", "")
    (tmp_path / "own" / "cover.html.j2").write_bytes("<p>\nБланк</p>".encode("cp1251"))
    with pytest.raises(InputError, match=r"cover\.html\.j2, строка 2"):
        html_of(source, tmp_path)


@pytest.mark.usefixtures("few_chapters")
def test_a_missing_folder_and_an_unknown_name_are_refused(tmp_path):
    source = ONE.replace("[report]\n", '[report]\ntemplates = "own"\n')
    with pytest.raises(InputError, match=r"report\.templates: нет папки"):
        html_of(source, tmp_path)
    own(tmp_path, "covers.html.j2", "x")
    with pytest.raises(InputError, match=r"covers\.html\.j2 ничего не заменяет"):
        html_of(source, tmp_path)


@pytest.mark.usefixtures("few_chapters")
def test_wrong_css_names_the_folder(tmp_path):
    source = own(tmp_path, "frame.css.j2", "")
    own(tmp_path, "report.css.j2", "p { colour: red }")
    t = terms_of(source)
    (tmp_path / "in.toml").write_text(source, encoding="utf-8")
    with pytest.raises(InputError, match=r"own: .*colour"):
        Report.of(t.model, t.values, tmp_path / "in.toml").pdf(tmp_path / "in.toml", b"")


def test_page_boxes_are_a4(framed):
    _, _, folder = framed
    boxes = poppler("pdfinfo", "-box", str(folder / "text.pdf"))
    assert re.search(r"MediaBox:\s+0\.00\s+0\.00\s+595\.2\d\s+841\.8\d", boxes)


def test_numbers_of_the_abstract_are_those_of_the_engine():
    t = terms("one")
    page = Report.of(t.model, t.values, Path("in.toml")).page("screen")
    brief = page[page.index("Реферат") : page.index(">Содержание<")]
    assert t.num("M_mean") in brief and t.num("Rpin_max_kN") in brief


def unpacked(pdf: bytes) -> bytes:
    """The PDF with the streams of its objects open to read."""
    out = [pdf]
    for piece in pdf.split(b"endstream")[:-1]:
        _, actual, data = piece.rpartition(b"stream\n")
        if actual and b"/ObjStm" in piece[-len(data) - 400 :]:
            out.append(zlib.decompress(data))
    return b"".join(out)


def test_every_figure_and_formula_is_told_in_words(framed):
    data = unpacked(framed[0].pdf)
    said = [bytes.fromhex(hex_[4:].decode()).decode("utf-16-be")
            for hex_ in re.findall(rb"/Alt\s*<(feff[0-9a-f]+)>", data)]  # fmt: skip
    figures, formulas = data.count(b"/S /Figure"), data.count(b"/S /Formula")
    assert data.count(b"/Alt ") == figures + formulas and formulas > 40 > figures > 10
    (torque,) = [text for text in said if text.startswith("Индикаторный крутящий момент")]
    assert "наибольшее" in torque and "при фи = " in torque and "Н·м" in torque


@pytest.mark.usefixtures("few_chapters")
def test_hostile_report_data_reads_nothing_and_asks_nobody(listener, tmp_path):
    base, hits = listener
    marker = tmp_path / "marker.txt"
    marker.write_text("SECRET-MARKER", encoding="utf-8")
    words = (
        f'"><img src="{base}/i"><link rel=attachment href="{marker.as_uri()}">'
        f"<style>@import '{base}/c'</style>{{{{ 7*7 }}}}$\\frac{{1}}{{2}}$ 🚗" + "Щ" * 60
    )
    fields = ("student", "group", "supervisor", "institution", "department", "discipline",
              "designation", "controller", "approver", "issued", "due", "variant", "head",
              "city")  # fmt: skip
    lines = [f"{name} = {json.dumps(words, ensure_ascii=False)}" for name in fields]
    data = "\n".join(["[report]", 'frame = "eskd"', *lines]) + "\n"
    source = tmp_path / "in.toml"
    source.write_text(ONE.replace("[report]\n", data), encoding="utf-8")
    t = terms_of(source.read_text(encoding="utf-8"))
    pdf = Report.of(t.model, t.values, source).pdf(source, b"PK")
    assert hits == []
    assert b"SECRET-MARKER" not in unpacked(pdf)
    pages = pages_of(pdf, tmp_path)
    assert "{{ 7*7 }}" in pages[0] and "<img" in pages[0]
    html = Report.of(t.model, t.values, source).page("screen")
    assert "<img" not in html and "<link" not in html


def test_outline_language_and_metadata_are_in_the_file(framed):
    data = unpacked(framed[0].pdf)
    assert b"/Lang (ru)" in data
    titles = [bytes.fromhex(hex_[4:].decode()).decode("utf-16-be")
              for hex_ in re.findall(rb"/Title\s*<(feff[0-9a-f]+)>", data)]  # fmt: skip
    for title in ("Введение", "Заключение", "Список использованных источников"):
        assert title in titles
    assert len([t for t in titles if re.match(r"\d+(\.\d+)*\s", t)]) > 8
    info = poppler("pdfinfo", str(framed[2] / "text.pdf"))
    assert re.search(r"Author:\s+Иванов И\. И\.", info) and "Creator:         kshm" in info


def test_a_name_that_would_be_tiny_leaves_the_surname():
    name = "Александра Владимировна Константинопольская-Преображенская"
    data = DATA.replace("Иванов И. И.", name)
    text = ONE.replace('detail = "full"\n', "").replace("[report]\n", data)
    block = title_block(terms_of(text).model.input)
    assert block is not None
    assert block["developed"] == "Константинопольская-Преображенская"
    assert block["checked"] == "Петров П. П."  # whole, as it fits


@pytest.mark.parametrize(("name", "said"), [("Д-240", " «Д-240»"), ("", "")])
def test_an_engine_without_a_name_is_not_called_engine_in_quotes(name, said):
    text = ONE.replace('name = "Одноцилиндровый"', f'name = "{name}"' if name else "")
    t = terms_of(text.replace('detail = "full"', 'detail = "short"'))
    page = Report(t.model, t.values).page("screen").replace("\xa0", " ")
    assert f"кривошипно-шатунный механизм двигателя{said}." in page
    assert f"расчёты двигателя{said} на установившемся режиме" in page
    assert (f"3. Исходные данные: двигатель{said};" in page) == bool(said)
