import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from markupsafe import Markup

from reports.document.page.render import environment, render
from reports.document.text import texts
from reports.draw import fonts
from reports.draw.fonts import fonts_css
from reports.shared import font_coverage
from tests.document.pdftools import pages_of


def test_foreign_signs_become_a_box_and_controls_go():
    assert font_coverage.printable("Имя 🚗\x00\x07 ok\u202e") == "Имя □ ok"
    assert font_coverage.printable("тонкий\u2009пробел\u202f!") == "тонкий\u00a0пробел\u00a0!"
    assert font_coverage.printable("e\u0301") == "é"
    assert font_coverage.printable("⚙\ufe0f") == font_coverage.printable("⚙")


@given(st.text())
def test_nothing_outside_the_font_remains(text):
    faces = font_coverage.coverage() | font_coverage.second_coverage()
    shown = font_coverage.printable(text)
    assert all(ord(char) in faces or char in "\n\t\u00ad" for char in shown)


def test_raised_signs_become_superscripts():
    assert texts.rich("мин⁻¹ & с²") == "мин<sup>−1</sup> &amp; с<sup>2</sup>"
    assert texts.rich("<b>м²") == "&lt;b&gt;м<sup>2</sup>"
    assert not isinstance(texts.rich("<b>"), Markup)
    assert texts.raised("мин⁻¹") == "мин$^{-1}$"


def test_attribute_text():
    assert texts.plain('мин⁻¹ "x"') == "мин−¹ &#34;x&#34;"
    assert texts.plain(Markup("<i>R</i><sub>ш</sub>")) == "Rш"


def test_font_files_are_a_closed_list():
    assert fonts.font_bytes("STIXGeneral.ttf")[:4] == b"\x00\x01\x00\x00"
    try:
        fonts.font_bytes("../../../../etc/passwd")
    except ValueError as error:
        assert "Шрифт" in str(error)
    else:
        raise AssertionError


def test_css_names_every_face_and_embeds_on_demand():
    css = fonts.fonts_css()
    assert css.count("@font-face") == 19 and "kshm-font:STIXGeneralItalic.ttf" in css
    assert "/" not in css.replace("kshm-font", "")
    embedded = fonts.fonts_css(embedded=True)
    assert "kshm-font" not in embedded and "data:font/ttf;base64," in embedded


def test_spaces_move_into_the_element_behind_them():
    text = 'дан на рисунке\u00a0<a class="ref" href="#r">12</a>, масс <i>m<sub>j</sub></i> при '
    # What must not be divided takes no space in: the line could not end there any more.
    assert texts.spaces_inside(text + '<span class="nb">φ = 0</span>') == (
        'дан на рисунке<span>\u00a0</span><a class="ref" href="#r">12</a>, масс'
        '<i> m<sub>j</sub></i> при<span> </span><span class="nb">φ = 0</span>'
    )


BEGINNING = "Моменты даны в таблице, суммарный момент показан на рисунке"


@pytest.mark.parametrize(
    "end",
    ["\u00a0<a>12</a>.", " <i>m</i>, остальное ниже.", ' <span class="nb">φ = 0</span>, а далее.'],
)
def test_lines_are_filled_whatever_follows_a_space(end, tmp_path):
    # All widths at which the text fits without its last space, but not with it.
    css = "html{font:14pt STIXGeneral;hyphens:auto}p{margin:0;width:%dpx}@page{size:A4;margin:0}"
    body = "".join(f'<p style="width:{width}px">{BEGINNING}{end}</p>' for width in range(478, 560))
    style = f"<style>{fonts_css()}{css % 500}</style>"
    page = f'<html lang="ru"><head>{style}</head><body>{body}</body></html>'
    text = "".join(pages_of(render(texts.spaces_inside(page)).pdf, tmp_path))
    firsts = [line for line in text.splitlines() if line.strip().startswith("Моменты")]
    assert len(firsts) == 82
    assert min(len(line.strip()) for line in firsts) > 45


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("в НМТ 5 — на рисунке", "в НМТ 5\xa0— на рисунке"),
        ('<span class="num">3</span> — Схема', '<span class="num">3</span> — Схема'),
        (
            '<span class="nb"><i>J</i> = 3 кг</span> — это',
            '<span class="nb"><i>J</i>\xa0=\xa03\xa0кг</span>\xa0— это',
        ),
        ("Размеры: а — вал; б — шатун", "Размеры: а\xa0—\xa0вал; б\xa0—\xa0шатун"),
        ('Гоца [<a class="ref" href="#x">1</a>]', 'Гоца\xa0[<a class="ref" href="#x">1</a>]'),
        ('по [<a class="ref">1</a>, формулы (4)', 'по [<a class="ref">1</a>, формулы (4)'),
        ('по [<a class="ref">1</a>,\xa0п.', 'по\xa0[<a class="ref">1</a>,\xa0п.'),
        ('сложены [<a class="ref">1</a>,\xa0п.', 'сложены [<a class="ref">1</a>,\xa0п.'),
        ('на рисунке <a class="ref">1</a>', 'на рисунке\xa0<a class="ref">1</a>'),
        ('в таблицах <a class="ref">1</a>', 'в таблицах\xa0<a class="ref">1</a>'),
        (">А. Н. Гоц в США. Но", ">А.\xa0Н.\xa0Гоц в США. Но"),
        ("4,886 МПа при φ = 0° и", "4,886\xa0МПа при φ\xa0=\xa00° и"),
        ("<i>L</i><sub>изб</sub> = 988 Дж", "<i>L</i><sub>изб</sub>\xa0=\xa0988\xa0Дж"),
        ("ψ\xa0= 3", "ψ\xa0=\xa03"),
        ("до 107,0 Н·м и 4 %, 3 кг", "до 107,0\xa0Н·м и 4\xa0%, 3\xa0кг"),
        ('<img alt="x = 3 Н">', '<img alt="x = 3 Н">'),
        ("шейки 2 к колену 3 Мотор", "шейки\xa02 к колену\xa03 Мотор"),
        ("на проекцию шейки 42,51 МПа", "на проекцию шейки 42,51\xa0МПа"),  # no number of a journal
        ("образец № 17", "образец №\xa017"),
        ("подшипник 4, подшипника 5, цилиндра 6", "подшипник\xa04, подшипника\xa05, цилиндра\xa06"),
        ("число цилиндров 7", "число цилиндров 7"),
    ],
)
def test_no_line_ends_before_a_dash_a_sign_a_unit_or_a_reference(text, said):
    assert texts.unbroken(text) == said


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Иванова. 2-е изд., испр.", 'Иванова. <span class="nb">2-е изд.</span>, испр.'),
        ("силы 1-го порядка, мин⁻¹", 'силы <span class="nb">1-го</span> порядка, мин<sup>−1</sup>'),
        ("суммы при φ = 0", "суммы при φ\xa0=\xa00"),
        ("8 цил., V-образный", '8 цил., <span class="nb">V-образный</span>'),
        ("Д-260 (6ЧН 11/12,5), Ч 5", 'Д-260 (<span class="nb">6ЧН 11/12,5</span>), Ч 5'),
        ("ЯМЗ-236, 6-110, V6-дизель & <b>", "ЯМЗ-236, 6-110, V6-дизель & <b>"),
    ],
)
def test_no_line_ends_within_an_ordinal_or_a_relation(text, said):
    assert texts.rich(text) == said


def test_short_words_are_divided_too_before_a_line_is_stretched(tmp_path):
    """Russian print leaves two letters behind: «ре-жиме», «ча-стоте», «шату-на»."""
    sheet = environment().get_template("report/report.css.j2").render()
    limit = re.search(r"hyphenate-limit-chars:[^;]+;", sheet)[0]
    css = f"html{{font:14pt STIXGeneral;hyphens:auto;{limit}}}p{{margin:0}}@page{{margin:0}}"
    text = "на установившемся режиме частота равна"
    body = "".join(f'<p style="width:{width}px">{text}</p>' for width in range(190, 240))
    page = (
        f'<html lang="ru"><head><style>{fonts_css()}{css}</style></head><body>{body}</body></html>'
    )
    lines = "".join(pages_of(render(page).pdf, tmp_path)).splitlines()
    assert any(line.strip().endswith(("ре‐", "ре-")) for line in lines)
