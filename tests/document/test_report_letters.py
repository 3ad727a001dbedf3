"""Names in the letters of Russia's and its neighbours' languages: never a box on any page."""

from __future__ import annotations

import importlib
import io
import pkgutil
import re
import zipfile
from collections import defaultdict
from functools import cache
from pathlib import Path

import pytest

from reports.document import chapters
from reports.document.page.render import environment, render_pdf
from reports.document.report import Report
from reports.document.text.terms import Terms
from reports.document.text.texts import pictured
from reports.draw import fonts
from reports.draw.fonts import width_of
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.model.shape import TIMING
from reports.shared import font_coverage
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.cover import quantities, samples_with
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
    assert font_coverage.unprintable(LETTERS[language]) == ()
    assert font_coverage.printable(LETTERS[language]) == LETTERS[language]
    shown = on_paper(look.format(LETTERS[language]), tmp_path)
    assert "".join(shown.split()) == LETTERS[language]


def test_a_letter_that_no_face_has_is_told_and_boxed_on_paper_alone(tmp_path: Path) -> None:
    assert font_coverage.unprintable(NAME + NOBODY_HAS) == (NOBODY_HAS,)
    assert "".join(on_paper(NOBODY_HAS, tmp_path).split()) == font_coverage.REPLACEMENT
    assert font_coverage.cleaned(NOBODY_HAS) == NOBODY_HAS


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
    from reports.word.pictures import outlined

    svg = (
        '<svg class="fig" style="width:9em" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 20"'
        f' font-family="{fonts.OF_DRAWINGS}"><text x="1" y="15" font-size="9">{{}}</text></svg>'
    )
    for letters in LETTERS.values():
        shown = on_paper("", tmp_path, pictured(svg.format(letters + NOBODY_HAS), "t"))
        assert "".join(shown.split()) == letters + font_coverage.REPLACEMENT
        assert text_size(letters, 10.0)[0] > 3 * len(letters)
        assert width_of(letters, 3.5) > len(letters)
    # A letter of its own for each, none the box of a missing one.
    values = {outlined(svg.format(char)) for char in "ӘҚҒө"}
    assert len(values) == 4


def test_grading_pages_and_the_register_have_the_letters() -> None:
    template = environment().from_string("{{ name }}")
    assert template.render(name=NAME) == NAME


Meanings = dict[str, set[str]]

SYMBOL = r"(?:<i>[^<]+</i>|[α-ω])(?:<sub>(?:[^<]|<i>[^<]*</i>)*</sub>)*"
# Indices, axes and points of the indicator diagram: each list says which it means.
SYMBOL_LETTERS = {"i", "k", "x", "y", "r"}


@pytest.fixture
def meanings(monkeypatch: pytest.MonkeyPatch, nothing_is_drawn: None) -> Meanings:
    """Titles of the quantities whose symbols are written while a report is made.

    Those of formulas are asked for too, though no formula is set.
    """
    seen: Meanings = defaultdict(set)
    plain = Terms.tex

    def tex(terms: Terms, name: str) -> str:
        written = plain(terms, name)
        if written and name.rpartition(".")[2] != TIMING:  # φ of one cylinder, told so
            seen[written].add(terms.title(name))
        return written

    monkeypatch.setattr(Terms, "tex", tex)
    for item in pkgutil.iter_modules(chapters.__path__):
        module = importlib.import_module(f"{chapters.__name__}.{item.name}")
        if hasattr(module, "angle_table"):
            monkeypatch.setattr(module, "angle_table", _noted_columns(seen, module.angle_table))
        if hasattr(module, "grid_table"):
            monkeypatch.setattr(module, "grid_table", _noted_rows(seen, module.grid_table))
    return seen


def _noted_columns(seen, make):
    def noted(terms, table, keys=None, *, own_symbols=False, **manner):
        for column in terms.model.tables[table].columns:
            if not own_symbols and (column.key in keys if keys else not column.helper):
                seen[column.quantity.tex].add(column.quantity.title)
        return make(terms, table, keys, own_symbols=own_symbols, **manner)

    return noted


def _noted_rows(seen, make):
    def noted(terms, grid, rows=(), labels=()):
        rows, labels = list(rows), list(labels)
        for row in grid.rows:
            if row.of in rows or not rows:
                seen[row.quantity.tex].add(row.quantity.title)
        return make(terms, grid, rows, labels)

    return noted


def page_of(name: str) -> str:
    raw = to_mapping(sample(name))
    raw["report"]["detail"] = "full"
    raw["calculation"]["step_deg"] = 30  # the same words in shorter tables
    model = build_model(load_mapping(raw, source=name).model)
    return Report(model, evaluate_model(model)).page("screen")


def bare(symbol: str) -> str:
    return re.sub("</?i>", "", symbol).strip()


def told(page: str) -> Meanings:
    """What the sentences say that symbols mean: «α — угол …»."""
    collected: Meanings = defaultdict(set)
    for text in re.findall(r"<p[^>]*>(.*?)</p>", page, re.DOTALL):
        for symbol, meaning in re.findall(rf"({SYMBOL})\s—\s([^,;.(<]+)", text):
            collected[bare(symbol)].add(meaning.strip())
    return collected


@pytest.mark.parametrize("name", samples_with(quantities))
def test_a_symbol_means_one_thing(name: str, meanings: Meanings) -> None:
    page = page_of(name)
    assert {tex: titles for tex, titles in meanings.items() if len(titles) > 1} == {}
    said = {s: words for s, words in told(page).items() if s not in SYMBOL_LETTERS}
    assert {symbol: words for symbol, words in said.items() if len(words) > 1} == {}
