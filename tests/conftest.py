"""Shared fixtures: samples solved once, referees, the rule for missing LibreOffice."""

from __future__ import annotations

import gc
import os
import shutil
import tempfile
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any, NoReturn

import pytest
from hypothesis import settings

from reports.inputs.load import load_toml
from reports.inputs.sections.input_file import InputFile
from reports.shared.resources import samples_dir
from tests.browser import chromium
from tests.kept import FOLDER
from tools.referees.by_libreoffice import LibreOffice, find_soffice

# As many processes as there are processors leave none to the threads of numpy.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
_WAITING = 1  # process more: some wait for LibreOffice, a browser, a command


def pytest_xdist_auto_num_workers() -> int:
    """Processes of ``-n auto``; quick tests wait for nothing."""
    return (os.cpu_count() or 1) + (0 if os.environ.get("KSHM_QUICK") else _WAITING)


# Random engines are slow to solve on a loaded machine: no deadline, the same examples in CI.
settings.register_profile("kshm", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("kshm")


ROOT = Path(__file__).parents[1]
QUICK = os.environ.get("KSHM_QUICK") == "1"
# What ./run test --quick leaves out: tests of more than about a second, of which each kind of
# check keeps one.  Of the checks over all samples this sample's stay.
QUICK_SAMPLES = {"gots-diesel"}
SLOW = (
    "tests/bearings/test_bearing_class.py",
    "tests/bearings/test_bearing_report.py::test_the_sentences",
    "tests/bearings/test_film_refused.py::test_a_study",
    "tests/bearings/test_film_refused.py::test_the_file",
    "tests/bearings/test_film_refused.py::test_the_input",
    "tests/bearings/test_mobility.py::test_an_orbit_against",
    "tests/bearings/test_mobility.py::test_the_orbit_of_an_engine",
    "tests/bearings/test_mobility.py::test_the_map",
    "tests/bearings/test_oil_film.py::test_turning",
    "tests/bearings/test_oil_film.py::test_random_bearings",
    "tests/studies/test_comparison_chapter.py",
    "tests/studies/test_compare.py::test_a_file_of_each_kind[pdf]",
    "tests/studies/test_compare.py::test_an_edited_workbook",
    "tests/studies/test_compare.py::test_six_engines",
    "tests/studies/test_compare.py::test_the_workbook_recalculated",
    "tests/cycle/test_cycle_properties.py",
    "tests/cycle/test_cycle_sheets.py::test_a_changed_cell_recalculates",
    "tests/cycle/test_cycle_sheets.py::test_the_gas_sheet",
    "tests/document/test_document_tables.py::test_layout",
    "tests/document/test_page_blocks.py::test_a_table_in_parts",
    "tests/document/test_page_blocks.py::test_continuation",
    "tests/document/test_page_blocks.py::test_layout",
    "tests/document/test_page_blocks.py::test_many_layouts",
    "tests/document/test_report_",
    "tests/document/test_text_mathsvg.py::test_made",
    "tests/e2e/test_cli.py::test_a_failed_check",
    "tests/e2e/test_cli.py::test_a_name_with_markup",
    "tests/e2e/test_cli.py::test_build_does_not_write",
    "tests/e2e/test_cli.py::test_old_files",
    "tests/e2e/test_cli.py::test_remarks_stand",
    "tests/e2e/test_dask.py",
    "tests/e2e/test_doors.py::test_issue_spares",
    "tests/e2e/test_doors.py::test_sweep_spares",
    "tests/e2e/test_homes.py",
    "tests/e2e/test_streams.py::test_a_closed",
    "tests/e2e/test_work_once.py",
    "tests/fuzz/test_corpus.py::test_an_empty_recipe_changes_nothing[workbook",
    "tests/fuzz/test_corpus.py::test_the_command",
    "tests/fuzz/test_corpus.py::test_the_corpus_is_answered[workbook]",
    "tests/fuzz/test_properties.py",
    "tests/grading/test_causes.py",
    "tests/grading/test_class_of_sixty.py",
    "tests/grading/test_coincidences.py",
    "tests/grading/test_drawn_entries.py::test_what_a_column_holds_costs_no_other[V6",
    "tests/grading/test_drawn_entries.py::test_what_a_column_holds_costs_no_other[two",
    "tests/grading/test_grade.py::test_a_pdf_on_demand",
    "tests/grading/test_grade.py::test_moodles_zip",
    "tests/grading/test_grade.py::test_the_command_explains",
    "tests/grading/test_grade.py::test_the_last_of_several",
    "tests/grading/test_hostile_files.py",
    "tests/grading/test_issue.py::test_a_changed_register",
    "tests/grading/test_issue.py::test_a_handout_gives",
    "tests/grading/test_issue.py::test_an_issue_can_be_repeated",
    "tests/grading/test_moodle.py",
    "tests/grading/test_other_bases.py",
    "tests/grading/test_real_class.py",
    "tests/grading/test_restoring.py::test_every_row",
    "tests/grading/test_roster.py::test_a_cell_at_the_edge",
    "tests/grading/test_selfcheck.py",
    "tests/grading/test_similarity.py::test_a_class_of_a_thousand",
    "tests/grading/test_typed.py::test_a_number_as_a_text_is_worth_a_number[.",
    "tests/house/test_house_bench.py::test_the_other",
    "tests/house/test_house_cover.py::test_nothing_is_left_out",
    "tests/house/test_house_readmes.py::test_the_workbook",
    "tests/house/test_house_run.py::test_the_noise_of_apt",
    "tests/house/test_house_run.py::test_the_test_command",
    "tests/house/test_house_run.py::test_what_the_system",
    "tests/new/test_generate.py::test_twelve",
    "tests/kshm/test_invariants.py",
    "tests/kshm/test_limits.py::test_zero_offset",
    "tests/manual/test_commands.py::test_an_own_engine",
    "tests/manual/test_commands.py::test_commands",
    "tests/manual/test_manual_pages.py::test_every_",
    "tests/manual/test_manual_pages.py::test_html_fits",
    "tests/manual/test_new_module.py",
    "tests/manual/test_new_table.py",
    "tests/referee/test_evaluate.py::test_a_grid",
    "tests/referee/test_evaluate.py::test_cached_values",
    "tests/referee/test_sheets.py::test_whole_books",
    "tests/referee/test_other_programs.py",
    "tests/referee/test_recalculation.py::test_formualizer_does_not",
    "tests/referee/test_recalculation.py::test_libreoffice_agrees",
    "tests/referee/test_sheets.py::test_a_book_as_excel",
    "tests/robustness/",
    "tests/sheet/test_sheet_dxf.py::test_random_engines",
    "tests/sheet/test_sheet_places.py::test_every_layout",
    "tests/studies/test_sweep.py::test_memory",
    "tests/studies/test_sweep.py::test_processes",
    "tests/tables/test_diagram.py",
    "tests/tables/test_left_out.py::test_the_contents",
    "tests/tables/test_reference.py",
    "tests/tables/test_regimes.py",
    "tests/torsion/test_torsion_tables.py::test_the_sheets_follow_random_changes",
    "tests/studies/test_validation_book.py",
    "tests/web/test_browser.py",
    "tests/web/test_class.py",
    "tests/web/test_files.py::test_a_comparison",
    "tests/web/test_files.py::test_workbook",
    "tests/web/test_hostile.py::test_hostile_books",
    "tests/web/test_queue.py::test_a_killed",
    "tests/word/test_docx_file.py",
    "tests/word/test_docx_in_libreoffice.py",
    "tests/word/test_one_number.py",
    "tests/workbook/test_formulas.py::test_a_stiffness",
    "tests/workbook/test_golden.py::test_every_part_is_the_stored_one[offset",
    "tests/workbook/test_golden.py::test_saved_by_libreoffice",
    "tests/workbook/test_motion.py::test_a_model_engine",
    "tests/workbook/test_motion.py::test_libreoffice",
    "tests/workbook/test_places.py::test_headers_of_twelve",
    "tests/workbook/test_print.py::test_the_textbooks",
    "tests/workbook/test_read_back.py::test_a_changed_unit",
    "tests/workbook/test_read_back.py::test_a_formula_in",
    "tests/workbook/test_read_back.py::test_a_renamed",
    "tests/workbook/test_read_back.py::test_edited",
    "tests/workbook/test_read_back.py::test_the_same_input",
    "tests/workbook/test_read_back.py::test_what_check_refuses",
    "tests/workbook/test_schema.py",
    "tests/workbook/test_caches.py::test_our_book",
    "tests/workbook/test_charts_xml.py::test_points",
    "tests/workbook/test_course.py::test_a_short_book",
    "tests/workbook/test_wrong_inputs.py::test_points_out",
    "tests/document/test_axis_units.py",
    "tests/document/test_figures_near.py",
    "tests/document/test_one_meaning.py",
    "tests/grading/test_issue.py::test_books_written",
    "tests/inputs/test_layout.py::test_an_old_workbook",
    "tests/kshm/test_search.py::test_the_counterweight",
    "tests/own/test_book_fuzz.py",
    "tests/own/test_chapter_words.py::test_the_book_is_without",
    "tests/own/test_own_books.py::test_the_page_is_done",
    "tests/referee/test_curves.py",
    "tests/referee/test_first_sheet.py",
    "tests/referee/test_structure_guard.py",
    "tests/studies/test_resume.py",
    "tests/web/test_class_states.py",
    "tests/web/test_private.py",
    "tests/workbook/test_lost_formulas.py::test_another",
    "tests/workbook/test_lost_formulas.py::test_libreoffice",
    "tests/workbook/test_substitution.py::test_a_line_follows",
    "tests/api/test_documented.py::test_the_script",
    "tests/e2e/test_cli.py::test_the_first_command",
    "tests/grading/test_tries.py::test_a_semester",
    "tests/model/test_small_engines.py::test_the_greatest",
    "tests/own/test_book_mistakes.py::test_what_is_not",
    "tests/own/test_own_books.py::test_the_workbook",
    "tests/workbook/test_bars.py",
    "tests/workbook/test_wrong_inputs.py::test_what_is_odd",
    "tests/api/test_documented.py::test_a_notebooks",
    "tests/api/test_layouts.py::test_random_layouts",
    "tests/bearings/test_mobility.py::test_forces_balance_along_the_orbit[0.5",
    "tests/bearings/test_mobility.py::test_forces_balance_along_the_orbit[1.0",
    "tests/document/test_page_placing.py::test_headings",
    "tests/grading/test_dependencies.py::test_a_direction_saved_the_other_way_round_is_not_altered[-360",
    "tests/grading/test_form.py::test_what_a_form_calculates",
    "tests/grading/test_order.py",
    "tests/grading/test_pages.py::test_a_class_is_printed_on_two_landscape_pages[140-24",
    "tests/model/test_books.py::test_every_sheet_of_every_layout",
    "tests/own/test_book_mistakes.py::test_a_book_alone",
    "tests/own/test_limits.py::test_spans",
    "tests/referee/test_ranges.py::test_the_cell",
    "tests/studies/test_compare.py::test_what_one_engine_alone",
    "tests/workbook/test_places.py::test_a_scheme",
    "tests/workbook/test_places.py::test_two_charts",
    "tests/workbook/test_read_back.py::test_a_lost_sheet",
    "tests/workbook/test_read_back.py::test_words_of_lists",
    "tests/workbook/test_substitution.py::test_a_student",
    "tests/new/test_sizing.py::test_a_drawn_task",
    "tests/referee/test_first_edit.py::test_no_cell",
    "tests/workbook/test_print.py::test_tables_repeat",
    "tests/torsion/test_torsion_class.py",
    "tests/grading/test_outcomes.py",
    "tests/grading/test_drawn_entries.py::test_what_a_column_holds_costs_no_other[class",
    "tests/api/test_documented.py::test_doors",
    "tests/grading/test_issue.py::test_the_command_says",
    "tests/web/test_own_engines.py::test_an_engine_is_there",
    "tests/document/test_page_placing.py::test_no_type",
)
# Files of which the first test alone is quick: the others need the same costly things again.
FIRST_ALONE = (
    "tests/document/test_sketch_letters.py",
    "tests/manual/test_style_pictures.py",
    "tests/tables/test_pin_length.py",
    "tests/workbook/test_wrong_inputs.py",
    "tests/new/test_working_cycle.py",
    "tests/studies/test_seek.py",
    "tests/workbook/test_lost_formulas.py",
    "tests/grading/test_awards.py",
    "tests/grading/test_tries.py",
    "tests/live/",
    "tests/tables/test_strength_statements.py",
    "tests/bearings/test_bearing_tables.py",
    "tests/counterweight/",
    "tests/cycle/test_cycle_sheets.py",
    "tests/e2e/test_streams.py",
    "tests/grading/test_decisions.py",
    "tests/grading/test_leaks.py",
    "tests/grading/test_literal_tables.py",
    "tests/grading/test_proven.py",
    "tests/grading/test_regrading.py",
    "tests/grading/test_collusion.py",
    "tests/grading/test_rules.py",
    "tests/grading/test_typed.py",
    "tests/grading/test_verdicts.py",
    "tests/grading/test_workers.py",
    "tests/house/test_house_run.py",
    "tests/inputs/test_plausibility.py",
    "tests/new/test_generate.py",
    "tests/new/test_sizing.py",
    "tests/own/test_own_books.py",
    "tests/sheet/",
    "tests/strength/",
    "tests/tables/test_masses.py",
    "tests/tables/test_two_statements.py",
    "tests/torsion/",
    "tests/web/",
    "tests/word/test_docx_numbers.py",
    "tests/workbook/test_course.py",
    "tests/workbook/test_formula_length.py",
    "tests/workbook/test_motion.py",
)


# Files that look at the same finished reports.
REPORTS = ("browser", "figures", "pdf", "sheets", "tags", "text")
# Tests of grading with classes of their own; the others look at one class of four.
OWN_CLASSES = ("class_of_sixty", "other_bases", "real_class", "workers")


def pytest_configure(config: pytest.Config) -> None:
    """A folder for what processes make for each other and leave; those of xdist inherit its name.

    What a failed test has written stays where pytest keeps it.
    """
    if not hasattr(config, "workerinput"):
        os.environ.setdefault("PYTEST_DEBUG_TEMPROOT", tempfile.gettempdir())
        os.environ[FOLDER] = os.environ["TMPDIR"] = tempfile.mkdtemp(prefix="kshm-tests-")
        tempfile.tempdir = None  # asked for anew


def pytest_unconfigure(config: pytest.Config) -> None:
    if not hasattr(config, "workerinput"):
        shutil.rmtree(os.environ.pop(FOLDER), ignore_errors=True)


def pytest_ignore_collect(collection_path: Path) -> bool | None:
    """Quick tests do not even read the files of which they take nothing."""
    whole = tuple(entry for entry in SLOW if "::" not in entry)
    name = collection_path.relative_to(ROOT).as_posix() if QUICK else ""
    return True if name.endswith(".py") and name.startswith(whole) else None


@pytest.hookimpl(tryfirst=True)  # before xdist reads the groups
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what the quick tests leave out; keep together what needs the same costly things."""
    seen: set[Path] = set()
    for item in items:
        again = item.nodeid.startswith(FIRST_ALONE) and item.path in seen
        if again or item.nodeid.startswith(SLOW) or samples_of(item) - QUICK_SAMPLES:
            item.add_marker(pytest.mark.slow)
        elif item.nodeid.startswith(FIRST_ALONE):
            seen.add(item.path)
        if not item.get_closest_marker("xdist_group"):
            item.add_marker(pytest.mark.xdist_group(group_of(item)))
    # Long work first, so that the processes end together.
    items.sort(key=lambda item: item.get_closest_marker("slow") is None)


def samples_of(item: pytest.Item) -> set[str]:
    """Samples among the parameters of a test."""
    params = getattr(getattr(item, "callspec", None), "params", {}).values()
    return {p for p in params if isinstance(p, str)} & set(sample_names())


def group_of(item: pytest.Item) -> str:
    """What a process makes once: a sample's files, the finished reports, a file's fixtures."""
    if item.path.stem in {f"test_report_{name}" for name in REPORTS}:
        return "reports"
    if {"browser", "served"} & set(getattr(item, "fixturenames", ())):
        return "browser"  # one Chromium, one server
    if (
        item.path.parent.name == "grading"
        and item.path.stem.removeprefix("test_") not in OWN_CLASSES
    ):
        return "class"
    return min(samples_of(item), default=item.nodeid.partition("::")[0])


def pytest_sessionstart() -> None:
    """What is imported stays: no garbage is looked for in it."""
    gc.disable()


def pytest_collection_finish() -> None:
    """In a heap of whole books garbage is looked for seldom."""
    gc.freeze()
    gc.set_threshold(200_000, 20, 20)
    gc.enable()


def pytest_sessionfinish() -> None:
    """pytest looks five times through all that was kept; once finds the same."""
    gc.collect()
    gc.freeze()


@lru_cache(maxsize=32)
def sample(name: str) -> InputFile:
    """A sample's checked input."""
    return load_toml(samples_dir() / f"{name}.toml").model


@lru_cache(maxsize=1)
def sample_names() -> list[str]:
    """All samples that are shipped."""
    return sorted(path.stem for path in samples_dir().glob("*.toml"))


def missing(what: str, packages: str) -> NoReturn:
    """A program that a test needs is not there: a skip, in CI a failure."""
    if os.environ.get("CI") == "true":
        pytest.fail(f"{what} is missing: ./run test installs it")
    pytest.skip(f"{what} не установлен: sudo apt-get install {packages}")


@pytest.fixture(scope="session")
def libreoffice() -> LibreOffice:
    """The slow referee."""
    if find_soffice() is None:
        missing("LibreOffice", "libreoffice-calc-nogui")
    return LibreOffice()


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """One Chromium for all."""
    driver = pytest.importorskip("playwright.sync_api").sync_playwright
    path = chromium()
    with driver() as started:
        actual = started.chromium.launch(
            executable_path=path, args=["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"]
        )
        yield actual
        actual.close()


@pytest.fixture
def samples() -> Path:
    """Folder of the samples."""
    return samples_dir()
