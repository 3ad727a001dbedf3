"""The validation book: page, PDF, CSV, Markdown and the command."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from reports import cli
from reports.document.page.render import render_pdf
from reports.shared.resources import validation_dir
from reports.studies import validation_checks
from reports.studies import validation_page as page_module
from reports.studies.validation_checks import Verdict, check_table
from reports.studies.validation_lookups import solution
from reports.studies.validation_page import HEAD, listing, markdown, validation_page
from reports.studies.validation_registry import TABLES, table
from reports.studies.validation_workbook import WORDS, Book, Checked, validate
from tests import browser
from tests.document.pdftools import pages_of

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def page() -> str:
    return validation_page(validate(), media="screen")


def small() -> Book:
    """A grid, numbers with minutes and running text."""
    names = ("table_5", "neiman_t3", "text_1_4")
    return Book(tuple(Checked(table(name), check_table(table(name))) for name in names))


def test_counts_add_up_and_nothing_is_new() -> None:
    book = validate()
    counts = book.counts
    assert counts.total == sum(counts.by_verdict.values()) > 2900
    others = counts.signs[0] + counts.placed[0] + counts.empty[0]
    assert counts.total + others == len(book.checks)
    assert counts.by_verdict[Verdict.NEW] == 0
    assert not counts.needs_a_person
    assert counts.close <= counts.agrees
    assert sum(book.counts_of(name).total for name in {t.source for t in TABLES}) == counts.total


def test_only_printed_numbers_that_ours_are_made_without_are_counted() -> None:
    """Signs, forces whose place alone is checked and empty places are told apart."""
    counts = validate().counts
    assert (counts.signs, counts.placed, counts.empty) == ((226, 224), (101, 101), (187, 187))
    assert (counts.total, counts.agrees) == (2951, 2776)
    for check in validate().checks:
        if check.is_number:
            assert any(sign.isdigit() for sign in check.cell.text)
            assert not isinstance(check.ours, str) or check.ours == "—"


def test_claims_in_words_have_their_rows() -> None:
    rows = {check.cell.row: check for check in validate().checks if check.table.id == "segal_text"}
    assert rows["j_bdc"].ours == pytest.approx(-1)
    assert rows["j_bdc"].verdict is Verdict.MISPRINT
    angles = [rows[f"{key}_error_angle"].ours for key in ("s", "v", "j")]
    assert angles == pytest.approx([90, 60.5, 90], abs=0.5)
    assert rows["v_error_angle"].verdict is Verdict.NOT_REPRODUCED


def test_docs_are_what_the_command_writes() -> None:
    written = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8")
    assert written == markdown(validate()), "./run docs обновит"


def test_markdown_names_every_deviation_with_its_reason() -> None:
    text = markdown(validate())
    rows = [line for line in text.splitlines() if re.search(r"\| [^|]*: [^|]*\|$", line)]
    deviating = [check for check in validate().checks if check.verdict is not Verdict.AGREES]
    assert len(rows) >= len(deviating)
    for check in deviating:
        assert f"{WORDS[check.verdict]}: {check.reason} |" in text


def test_every_file_of_printed_numbers_is_used() -> None:
    used = {one.id for one in TABLES} | {"errata", "text", "app2_inputs"}
    assert {path.stem for path in validation_dir().glob("*.csv")} <= used


def test_csv_holds_every_number_once() -> None:
    rows = list(csv.DictReader(io.StringIO(listing(validate()))))
    assert tuple(rows[0]) == HEAD
    assert len(rows) == len(validate().checks)
    assert len({(row["таблица"], row["строка"], row["столбец"]) for row in rows}) == len(rows)
    for row in rows:
        assert not row["в книге"].startswith(("=", "+", "@"))
        if row["отклонение"]:
            far = abs(float(row["отклонение"])) > float(row["допуск"]) * (1 + 1e-6)
            assert far == (row["вердикт"] != "совпадает")
        assert bool(row["причина"]) == (row["вердикт"] != "совпадает")


def test_the_same_data_give_the_same_files(page: str) -> None:
    before = listing(validate())
    solution.cache_clear()
    validate.cache_clear()
    assert validation_page(validate(), media="screen") == page
    assert listing(validate()) == before


def test_the_page_needs_nothing_from_outside_and_says_verdicts_in_words(page: str) -> None:
    assert not re.search(r"""(?:src|href)=["']?(?!data:|#)[^"'> ]+""", page)
    assert not re.search(r"url\((?![\"']?data:)", page)
    assert "<script" not in page
    marked = re.findall(r'<span class="pair (\w+)">.*?<b>(.*?)</b></span>', page)
    grids = [one for one in validate().tables if not one.is_text]
    assert len(marked) == sum(len(one.deviating) for one in grids)
    assert all(WORDS[Verdict(kind)] == word for kind, word in marked)
    words = re.findall(r'<span class="word (\w+)">([^<]+)</span>', page)
    assert all(WORDS[Verdict(kind)] == word for kind, word in words)
    assert "□" not in re.sub(r"<style>.*?</style>", "", page, flags=re.S)


@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_fits_a_phone_and_a_screen(page: str, width: int, tmp_path: Path) -> None:
    measured = browser.measure(page, width, tmp_path / "site")
    assert measured["scroll"] <= measured["width"]
    assert measured["wide"] == []
    assert "STIXGeneral" in measured["fonts"]


def test_pdf_of_a_few_tables(tmp_path: Path) -> None:
    page = render_pdf(validation_page(small(), media="print"))
    assert page.startswith(b"%PDF")
    assert render_pdf(validation_page(small(), media="print")) == page
    text = " ".join(pages_of(page, tmp_path))
    for word in ("Книга сверки", "опечатка", "75°10′", "2°52,0′", "0,381"):
        assert word.casefold() in text.casefold(), word


def run(*arguments: str) -> object:
    return CliRunner().invoke(cli.main, ["validate", *arguments])


def test_the_command_writes_what_is_asked(tmp_path: Path) -> None:
    done = run("-o", str(tmp_path), "--only", "csv")
    assert done.exit_code == 0
    assert [path.name for path in tmp_path.iterdir()] == ["validation.csv"]
    assert "совпадает" in done.output


def test_everything_is_written_when_nothing_is_chosen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page_module, "validate", small)
    done = run("-o", str(tmp_path / "new"))
    assert done.exit_code == 0
    collected = {path.name for path in (tmp_path / "new").iterdir()}
    assert collected == {"validation.csv", "validation.html", "validation.pdf"}


def test_an_unrecorded_deviation_needs_a_person(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = {key: known for key, known in validation_checks.errata().items() if key[0] != "table_5"}
    monkeypatch.setattr(validation_checks, "errata", lambda: kept)
    monkeypatch.setattr(page_module, "validate", small)
    done = run("-o", str(tmp_path), "--only", "html")
    assert done.exit_code == 1
    assert "Новых отклонений: 1, первое: табл. 5, 60, lambda_1/3.2" in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    page = (tmp_path / "validation.html").read_text(encoding="utf-8")
    assert '<span class="word new">новое отклонение</span>: отклонение без' in page


def test_without_pango_the_rest_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from reports.shared import doctor

    monkeypatch.setattr(doctor, "pango_loads", lambda: False)
    monkeypatch.setattr(page_module, "validate", small)
    done = run("-o", str(tmp_path))
    assert done.exit_code == 3
    assert {path.name for path in tmp_path.iterdir()} == {"validation.csv", "validation.html"}
    assert "pango" in done.stderr


def test_a_folder_that_is_a_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "f").write_text("")
    done = run("-o", str(tmp_path / "f"), "--only", "csv")
    assert done.exit_code == 2
    assert len(done.stderr.strip().splitlines()) == 1
