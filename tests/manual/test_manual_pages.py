"""Pages of the documentation: current, linked, readable, complete."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest
from click import Option

from reports.cli import main
from reports.document.page.style import Margins, Style, TitlePage
from reports.inputs.load import load_toml
from reports.inputs.meta import StrictModel, hints
from reports.inputs.registry import SECTIONS
from reports.inputs.sections.report import CHAPTERS, DIAGRAMS
from reports.inputs.template import list_samples
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from tests.browser import measure
from tests.manual.pages import DOCS, PAGES
from tools.manual import pages as pages_module
from tools.manual.pages import pages as made_pages
from tools.manual.site import broken_links, slug, write_site

pages = cache(made_pages)  # looked at by several tests


def test_generated_pages_are_current():
    stale = [
        name for name, text in pages().items() if (DOCS / name).read_text(encoding="utf-8") != text
    ]
    assert stale == [], "./run docs обновит"


def test_what_is_out_of_date_is_written_anew(tmp_path, monkeypatch):
    monkeypatch.setattr(
        pages_module, "GENERATED", {"a.md": lambda: "first", "b.md": lambda: "second"}
    )
    page, _ = tmp_path / "a.md", pages_module.write_pages(tmp_path)
    assert page.read_text() == "first"
    assert pages_module.write_pages(tmp_path) == []
    page.write_text("old")
    assert pages_module.write_pages(tmp_path) == [page]
    assert page.read_text() == "first"


def test_no_link_leads_nowhere():
    assert broken_links(PAGES) == []


def test_a_dead_link_is_seen(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("# Одна\n\n[a](no.md) [b](#другая) [c](#одна) ![d](no.png)\n", encoding="utf-8")
    assert broken_links([page]) == ["page.md: no.md", "page.md: #другая", "page.md: no.png"]


def test_every_page_has_an_english_overview():
    own = list(DOCS.glob("*.md"))
    assert len(own) > 8
    missing = [p.name for p in own if "> In English: " not in p.read_text(encoding="utf-8")[:1200]]
    assert missing == []


def test_every_page_stands_in_the_contents():
    contents = (DOCS / "index.md").read_text(encoding="utf-8")
    missing = [p.name for p in DOCS.glob("*.md") if p.stem != "index" and p.name not in contents]
    assert missing == []


def test_every_key_is_explained():
    text = pages()["input.md"]
    models: list[type[StrictModel]] = [
        model for section in SECTIONS.values() for model in section.models
    ]
    for model in models:
        for key, about in hints(model).items():
            inner = about.inner
            if inner is None:
                assert f"| `{key}`" in text, key
            else:
                assert f".{key}]]" in text, key
    for section in SECTIONS:
        assert f"## [{section}]" in text


def test_every_choice_and_every_key_of_a_style_is_named():
    report, drawing = ((DOCS / f"{name}.md").read_text("utf-8") for name in ("report", "drawing"))
    style = {*Style.model_fields, *Margins.model_fields, *TitlePage.model_fields}
    assert [name for name in CHAPTERS if f"`{name}`" not in report] == []
    assert [name for name in style if not re.search(rf"(?m)^\[?{name}\b", report)] == []
    assert [name for name in DIAGRAMS if f"`{name}`" not in drawing] == []


def test_every_key_of_every_command_is_told_of():
    text = "".join(page.read_text("utf-8") for page in PAGES)
    unsaid = [
        f"{name} {key.opts[-1]}"
        for name, command in main.commands.items()
        for key in command.params
        if isinstance(key, Option) and key.opts[-1] != "--verbose"
        and not any(re.search(rf"(?<![\w-]){word}\b", text) for word in key.opts)
    ]  # fmt: skip
    assert unsaid == []


def test_every_sheet_is_described():
    headings = set(re.findall(r"^## (.+)$", pages()["sheets.md"], re.M))
    headings = {re.sub(r"\d+", "#", h) for h in headings}
    for sample in list_samples():
        for sheet in build_model(load_toml(samples_dir() / f"{sample}.toml").model).sheets:
            if not re.search(r" р\d+$", sheet):
                assert re.sub(r"\d+", "#", sheet) in headings, sheet


def test_headings_make_the_anchors_of_code_hosts():
    assert slug("[gas] — газы") == "gas--газы"
    assert slug("1. Возьмите похожий двигатель") == "1-возьмите-похожий-двигатель"


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    written = write_site(DOCS, folder)
    assert {path.stem for path in written} == {page.stem for page in DOCS.glob("*.md")} | {"readme"}
    for path in written:
        for link in re.findall(r'(?:href|src)="([^"]*)"', path.read_text(encoding="utf-8")):
            assert "://" in link or (path.parent / link.partition("#")[0]).exists(), link
    return folder


@pytest.mark.parametrize("width", [390, 1280])
def test_html_fits_the_window(site, tmp_path, width):
    page = (site / "sheets.html").read_text(encoding="utf-8")
    assert 'href="input.html"' in page
    measured = measure(page, width, tmp_path / "browser", boxes="table, pre")
    assert measured["scroll"] <= measured["width"]
    assert measured["wide"] == []
    assert measured["scripts"] == 0
