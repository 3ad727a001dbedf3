from hypothesis import given
from hypothesis import strategies as st
from markupsafe import Markup
from pdftools import pages_of

from reports.document import fonts, texts
from reports.document.fonts import fonts_css
from reports.document.render import render


def test_foreign_signs_become_a_box_and_controls_go():
    assert fonts.printable("Имя 🚗\x00\x07 ok\u202e") == "Имя □ ok"
    assert fonts.printable("тонкий\u2009пробел\u202f!") == "тонкий\u00a0пробел\u00a0!"
    assert fonts.printable("e\u0301") == "é"


@given(st.text())
def test_nothing_outside_the_font_remains(text):
    shown = fonts.printable(text)
    assert all(ord(char) in fonts.coverage() or char in "\n\t\u00ad" for char in shown)


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
    assert css.count("@font-face") == 15 and "kshm-font:STIXGeneralItalic.ttf" in css
    assert "/" not in css.replace("kshm-font", "")
    embedded = fonts.fonts_css(embedded=True)
    assert "kshm-font" not in embedded and "data:font/ttf;base64," in embedded


def test_a_word_and_its_number_stay_on_one_line():
    text = 'дан на рисунке\u00a0<a class="ref" href="#r">12</a>, масс\u00a0<i>m<sub>j</sub></i>.'
    assert texts.keep_together(text) == (
        'дан на <span class="nb">рисунке\u00a0<a class="ref" href="#r">12</a></span>, '
        '<span class="nb">масс\u00a0<i>m<sub>j</sub></i></span>.'
    )


def test_lines_are_filled_before_a_number_that_does_not_fit(tmp_path):
    # The width at which only the number does not fit is searched for.
    body = "<p>Моменты даны в таблице, суммарный момент показан на рисунке\u00a0<a>12</a>.</p>"
    css = "html{font:14pt STIXGeneral;hyphens:auto}p{margin:0;width:%dpx}@page{size:A4;margin:0}"
    for width in range(500, 560, 4):
        style = f"<style>{fonts_css()}{css % width}</style>"
        page = f'<html lang="ru"><head>{style}</head><body>{body}</body></html>'
        (text,) = pages_of(render(texts.keep_together(page)).pdf, tmp_path)
        first = text.strip().splitlines()[0]
        assert len(first) > 45, (width, text)
