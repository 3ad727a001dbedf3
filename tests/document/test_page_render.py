"""Rendering is shut off from the world, deterministic, and sets in STIX alone."""

import gc
import re
import tempfile

import pytest

from reports.document.figures.curves import Panel, PlotCurve, curves_figure
from reports.document.page.render import AttachedFile, environment, render, render_pdf
from reports.document.text.mathsvg import formula
from reports.draw.fonts import fonts_css
from reports.shared.errors import RenderError
from tests.document.pdftools import fonts_of, pages_of, poppler

PAGE = """<!DOCTYPE html><html lang="ru"><head><title>Отчёт</title><style>
{css} html{{font-family:STIXGeneral, STIXGeneralUpright}}</style>
</head><body>{body}</body></html>"""


def page(body: str) -> str:
    return PAGE.format(css=fonts_css(), body=body)


EVERYTHING = (
    "<p>Текст Σ √ ≈ ≤ → ° · − «ёлочки» — <i>курсив ≈ ≤ ≥ √ ∑ ∫</i> <b>жирный ≈ √ ∫ ∑</b> "
    "<i><b>оба ≈ √</b></i></p>"
    + formula(
        r"\sqrt{\dfrac{R_{\mathrm{ш.ш}}}{\left(\dfrac{a}{b}\right)^{2}}}\approx\int_0^1 x"
    ).svg
    + curves_figure(
        range(5), [Panel([PlotCurve("$p'_j$", range(5))], "мин⁻¹")], r"$\varphi$, °", angle=False
    )
)


def test_only_stix_and_no_warning(tmp_path):
    result = render(page(EVERYTHING))
    assert result.warnings == ()
    actual = fonts_of(result.pdf, tmp_path)
    faces = {"", "-Italic", "-Bold", "-Bold-Italic"}
    assert {f"STIXGeneral{face}" for face in faces} <= actual
    assert all(name.startswith("STIX") for name in actual), actual


def test_no_fonts_stay_in_the_temporary_folder(tmp_path, monkeypatch):
    """Each report left three megabytes there: what is made while it is set is never collected."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    gc.disable()
    try:
        render_pdf(page("x"))
    finally:
        gc.enable()
    assert not [*tmp_path.iterdir()]


def test_same_bytes_with_attachments():
    files = [AttachedFile("вход.toml", b"x = 1", "Входной файл"), AttachedFile("b.xlsx", b"PK")]
    html = page(EVERYTHING)
    first = render_pdf(html, attachments=files)
    assert render_pdf(html, attachments=files) == first
    assert set(re.findall(rb"D:(\d{4})", first)) == {b"2000"}, "no clock"
    assert render_pdf(page(EVERYTHING + "!"), attachments=files) != first


def test_attachments_are_inside(tmp_path):
    path = tmp_path / "a.pdf"
    path.write_bytes(render_pdf(page("x"), attachments=[AttachedFile("in.toml", b"x = 1")]))
    assert "in.toml" in poppler("pdfdetach", "-list", str(path))
    poppler("pdfdetach", "-saveall", "-o", str(tmp_path), str(path))
    assert (tmp_path / "in.toml").read_bytes() == b"x = 1"
    assert 'pdfaid:part="3"' in poppler("pdfinfo", "-meta", str(path))


def test_a_warning_is_an_error():
    with pytest.raises(RenderError, match="с замечаниями"):
        render_pdf(page('<p style="colour:red">x</p>'))


def test_hostile_markup_reads_nothing_and_asks_nobody(listener, tmp_path):
    base, hits = listener
    marker = tmp_path / "marker.txt"
    marker.write_text("SECRET-MARKER", encoding="utf-8")
    pieces = [
        f'<img src="{base}/img">',
        f'<link rel="stylesheet" href="{base}/css">',
        f'<link rel="attachment" href="{marker.as_uri()}">',
        f'<a rel="attachment" href="{marker.as_uri()}">a</a>',
        f'<object data="{marker.as_uri()}" type="text/plain"></object>',
        f'<p style="background:url({base}/bg)">x</p>',
        f'<style>@import url("{base}/import");</style>',
        f"<style>@font-face{{font-family:x;src:url({base}/f)}}</style>",
        f'<svg><image href="{base}/svg"/><use href="{base}/use#a"/></svg>',
        '<img src="kshm-font:../../../../../../etc/passwd">',
        f'<iframe src="{base}/frame"></iframe>',
    ]
    result = render(page("".join(pieces)))
    assert hits == []
    assert b"SECRET-MARKER" not in result.pdf
    path = tmp_path / "a.pdf"
    path.write_bytes(result.pdf)
    assert "0 embedded files" in poppler("pdfdetach", "-list", str(path))
    assert any("не открывается" in line or "Failed" in line for line in result.warnings)


def test_the_listener_hears_when_asked(listener):
    import urllib.request

    base, hits = listener
    urllib.request.urlopen(f"{base}/x").close()
    assert hits == ["/x"]


HOSTILE = (
    '<script>alert(1)</script><img src="http://127.0.0.1:9/x">{{ 7*7 }} $x^2$ \\frac & '
    "\x00\x08 🚗 \u202e" + "ы" * 400
)


def test_foreign_text_is_set_as_text(tmp_path):
    source = '{% extends "report/base.html.j2" %}{% block body %}<p>{{ text }}</p>{% endblock %}'
    from reports.document.page.blocks import DocumentInfo

    html = (
        environment()
        .from_string(source)
        .render(doc=DocumentInfo(HOSTILE, author='"><b>x'), text=HOSTILE)
    )
    assert "<script" not in html and "&lt;script&gt;" in html
    result = render(html)
    assert result.warnings == ()
    text = "".join(pages_of(result.pdf, tmp_path))
    assert "<script>alert(1)</script>" in text and "{{ 7*7 }}" in text
    assert all(name.startswith("STIX") for name in fonts_of(result.pdf, tmp_path))


def test_unknown_names_are_refused():
    import jinja2

    with pytest.raises(jinja2.UndefinedError):
        environment().from_string("{{ missing }}").render()


def test_templates_can_be_replaced(tmp_path):
    (tmp_path / "report.css.j2").write_text("p{color:#123456}", encoding="utf-8")
    from reports.document.page.blocks import DocumentInfo

    template = environment(tmp_path).get_template("report/base.html.j2")
    html = template.render(doc=DocumentInfo("x"))
    assert "#123456" in html and "string-set" not in html


def test_print_ready_page_carries_its_fonts():
    from reports.document.page.blocks import DocumentInfo

    template = environment(media="screen").get_template("report/base.html.j2")
    html = template.render(doc=DocumentInfo("x"))
    assert "kshm-font" not in html and "http" not in html.split("</style>")[0].split("data:")[0]
