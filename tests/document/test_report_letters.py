"""Names in the letters of Russia's and its neighbours' languages: never a box on any page."""

from __future__ import annotations

import io
import zipfile
from functools import cache
from pathlib import Path

import pytest

from reports.document.page.render import environment, render_pdf
from reports.document.text import fonts
from reports.document.text.texts import pictured
from reports.drawing.lettering import width_of
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.shared import signs
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.document.pdftools import fonts_of, pages_of

LETTERS = {
    "Kazakh": "ӘәҒғҚқҢңӨөҰұҮүҺһІі", "Kazakh, Latin": "ÄäĞğÑñÖöŪūÜüŞşIıİi", "Tatar": "ӘәӨөҮүҖҗҢңҺһ",
    "Bashkir": "ҒғҘҙҠҡҢңӨөҪҫҮүҺһӘә", "Kyrgyz": "ҢңӨөҮү", "Tajik": "ҒғӢӣҚқӮӯҲҳҶҷ",
    "Uzbek": "ЎўҚқҒғҲҳ", "Uzbek, Latin": "OʻoʻGʻgʻÕõĞğŞşÇçʼ", "Ukrainian": "ҐґЄєІіЇїʼ",
    "Belarusian": "ЎўІі", "Chuvash": "ӐӑӖӗҪҫӲӳ", "Yakut": "ҔҕҤҥӨөҺһҮү", "Armenian": "ԱբգՖֆև",
    "Georgian": "აბგდევზჰ", "Komi": "ІіӦӧ", "Udmurt": "ӜӝӞӟӤӥӦӧӴӵ", "Mari": "ӒӓҤҥӦӧӰӱӸӹ",
    "Ossetian": "Ӕӕ", "Chechen": "Ӏ", "Azerbaijani": "ƏəĞğİıÖöŞşÜüÇç",
    "Moldovan": "ĂăÂâÎîȘșȚț", "Lithuanian": "ĄąČčĘęĖėĮįŠšŲųŪūŽž",
}  # fmt: skip
NAME = " ".join(LETTERS.values())
NOBODY_HAS = "漢"
OURS = {fonts.FAMILY, fonts.UPRIGHT, fonts.SECOND}
BARE = (
    "<!DOCTYPE html><html lang='ru'><head><meta charset='utf-8'><title>t</title><style>{fonts}"
    "html{{font-family:{stack}}}</style></head><body><p>{text}</p>{more}</body></html>"
)


def on_paper(text: str, folder: Path, more: str = "") -> str:
    page = BARE.format(fonts=fonts.fonts_css(), stack=fonts.STACK, text=text, more=more)
    pdf = render_pdf(page)
    assert {name.partition("-")[0] for name in fonts_of(pdf, folder)} <= OURS
    return "".join(pages_of(pdf, folder))


@cache
def pages() -> dict[str, str]:
    """The report of a student with such a name by media."""
    from reports.document.report import Report

    raw = to_mapping(sample("gots-diesel"))
    raw["report"] |= {"student": f"{NAME} {NOBODY_HAS}", "detail": "short"}
    model = build_model(load_mapping(raw, source="t").model)
    values = evaluate_model(model)
    return {media: Report(model, values).page(media) for media in ("print", "screen")}


@pytest.mark.parametrize("language", LETTERS)
@pytest.mark.parametrize("look", ["{}", "<b>{}</b>", "<i>{}</i>", "<b><i>{}</i></b>"])
def test_the_letters_of_a_language_are_on_paper(language: str, look: str, tmp_path: Path) -> None:
    assert signs.unprintable(LETTERS[language]) == ()
    assert signs.printable(LETTERS[language]) == LETTERS[language]
    shown = on_paper(look.format(LETTERS[language]), tmp_path)
    assert "".join(shown.split()) == LETTERS[language]


def test_a_letter_that_no_face_has_is_told_and_boxed_on_paper_alone(tmp_path: Path) -> None:
    assert signs.unprintable(NAME + NOBODY_HAS) == (NOBODY_HAS,)
    assert "".join(on_paper(NOBODY_HAS, tmp_path).split()) == signs.REPLACEMENT
    assert signs.cleaned(NOBODY_HAS) == NOBODY_HAS


@pytest.mark.parametrize("media", ["print", "screen"])
def test_no_page_replaces_a_letter(media: str) -> None:
    page = pages()[media]
    for letters in (*LETTERS.values(), NOBODY_HAS):
        assert letters in page


def test_word_replaces_no_letter() -> None:
    from reports.document.page.style import USUAL
    from reports.word.write import from_page

    with zipfile.ZipFile(io.BytesIO(from_page(pages()["print"], USUAL))) as archive:
        text = archive.read("word/document.xml").decode()
    assert f"{NAME} {NOBODY_HAS}" in text


def test_figures_and_drawings_have_the_letters(tmp_path: Path) -> None:
    from reports.document.figures.labels import text_size
    from reports.word.outline import outlined

    svg = (
        '<svg class="fig" style="width:9em" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 20"'
        f' font-family="{fonts.OF_DRAWINGS}"><text x="1" y="15" font-size="9">{{}}</text></svg>'
    )
    for letters in LETTERS.values():
        shown = on_paper("", tmp_path, pictured(svg.format(letters + NOBODY_HAS), "t"))
        assert "".join(shown.split()) == letters + signs.REPLACEMENT
        assert text_size(letters, 10.0)[0] > 3 * len(letters)
        assert width_of(letters, 3.5) > len(letters)
    # A letter of its own for each, none the box of a missing one.
    made = {outlined(svg.format(char)) for char in "ӘҚҒө"}
    assert len(made) == 4


def test_grading_pages_and_the_register_have_the_letters() -> None:
    template = environment().from_string("{{ name }}")
    assert template.render(name=NAME) == NAME
