"""The chapter on the cycle in the report: steps with numbers, no chapter without a cycle."""

from __future__ import annotations

import re
from pathlib import Path
from unittest import mock

import pytest

from reports.document import report as report_module
from reports.document.chapters.contents import CHAPTERS
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.cycle.cycle_files import loaded


def text_of(name: str) -> str:
    """The report's HTML without its formulas and figures, tags taken out."""
    model = build_model(loaded(name))
    few = [each for each in CHAPTERS if each.name in ("cycle", "sources")]
    with mock.patch.object(report_module, "CHAPTERS", few):
        page = report_module.Report.of(model, evaluate_model(model), Path("t.toml")).page("screen")
    page = re.sub(r"<svg.*?</svg>", " ", page, flags=re.DOTALL)
    page = re.sub(r"<style.*?</style>", " ", page, flags=re.DOTALL)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", page))


@pytest.fixture(scope="module", params=["cycle-turbo-diesel", "cycle-petrol"])
def report(request: pytest.FixtureRequest) -> tuple[str, str]:
    return request.param, text_of(request.param)


def test_every_step_has_its_heading(report: tuple[str, str]) -> None:
    name, text = report
    headings = [
        "Расчёт рабочего цикла", "Топливо, свежий заряд и продукты сгорания", "Наполнение",
        "Сжатие", "Сгорание", "Расширение", "Индикаторные показатели",
        "Диаметр цилиндра и ход поршня", "Эффективные показатели", "Тепловой баланс",
        "Индикаторная диаграмма цикла", "Внешняя скоростная характеристика",
        "Сопоставление с обычными пределами",
    ]  # fmt: skip
    if name == "cycle-turbo-diesel":
        headings.append("Турбокомпрессор")
    for heading in headings:
        assert heading in text
    # One field for all curves: no «: а — …» of several.
    assert re.search(r"Рисунок\W+\d+ — Внешняя скоростная характеристика(?!:)", text)


def test_numbers_are_the_results(report: tuple[str, str]) -> None:
    name, text = report
    model = build_model(loaded(name))
    values = evaluate_model(model).scalars
    for key, digits in (("cyc_N_e", 2), ("bal_total", 2), ("cyc_g_e", 1)):
        assert f"{float(values[key]):.{digits}f}".replace(".", ",") in text
    assert "nan" not in text.lower().split()
    assert "None" not in text


def test_ranges_are_called_accepted_and_no_page_of_the_web_is_cited(
    report: tuple[str, str],
) -> None:
    _, text = report
    assert "принятыми по выполненным двигателям" in text
    assert "ukrbukva" not in text and "по памяти" not in text


def test_derived_regimes_are_marked(report: tuple[str, str]) -> None:
    _, text = report
    assert "получен из характеристики" in text
    assert "принят долей номинальной частоты" in text


def test_the_chapter_stands_in_the_report() -> None:
    assert [each.name for each in CHAPTERS].count("cycle") == 1


def test_a_given_diagram_has_no_chapter_on_the_cycle() -> None:
    assert "Расчёт рабочего цикла" not in text_of("gots-diesel")
