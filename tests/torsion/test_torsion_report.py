"""The report's chapter: its conclusion follows from the numbers."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path

import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.document.report import Report
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from tests.conftest import sample


@lru_cache(maxsize=8)
def whole(name: str, *pairs: tuple[str, float | str]) -> str:
    raw = to_mapping(sample(name))
    raw["torsion"] = raw.get("torsion", {}) | dict(pairs)
    raw["calculation"]["step_deg"] = 15
    raw["report"]["chapters"] = ["torsion"]
    model = build_model(load_mapping(raw, source=name).model)
    return Report(model, evaluate_model(model)).page("screen").replace("\u00a0", " ")


def page(name: str, *pairs: tuple[str, float | str]) -> str:
    text = whole(name, *pairs)
    text = re.sub(r"<(svg|style|script).*?</\1>", "", text, flags=re.S)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", text))


def test_the_dangerous_order_is_named() -> None:
    text = page("mwm-6")
    assert "самый опасный порядок — 6 (форма 1, 2166 мин" in text
    assert "превышает допускаемую 40 МПа" in text
    assert "Более лёгкий маховик сдвигает первую частоту вверх на 4,9 %" in text
    # What is left with the damper stands elsewhere than the peak without it.
    left = re.search(r"С ним наибольшее напряжение .*? при частоте вращения (\d+) мин", text)[1]
    assert f"нужен больший гаситель или обход частот вращения около {left} мин" in text
    assert re.search(r"Наибольшее напряжение .*? достигается при (\d+) мин", text)[1] != left


def test_the_campbell_diagram_shows_the_orders_of_the_strongest_resonances() -> None:
    """Half orders too: those of the table are looked for in the figure."""
    html = whole("mwm-6")
    table = re.search(r"Резонансы рабочего диапазона.*?</table>", html, re.S)[0]
    rows = [re.findall(r"<td>(.*?)</td>", row) for row in re.findall("<tr.*?</tr>", table, re.S)]
    orders = {row[1].strip().removesuffix(",0") for row in rows if row}
    figure = re.search("<title>Диаграмма Кэмпбелла.*?</svg>", html, re.S)[0]
    words = "|".join(re.findall("<text[^>]*>([^<]*)</text>", figure))
    shown = set(re.findall(r"ν[| ]*= ([\d,]+)", words))
    assert shown <= orders and len(shown) == min(8, len(orders))
    assert any("," in order for order in shown)


def test_the_dangerous_order_is_marked_in_both_figures() -> None:
    html = whole("mwm-6")
    for title in ("Резонансные напряжения", "Диаграмма Кэмпбелла"):
        figure = re.search(f"<title>{title}.*?</svg>", html, re.S)[0]
        words = " ".join(re.findall("<text[^>]*>([^<]*)</text>", figure))
        assert re.search(r"=\s*6 \(форма 1\)", words), words
        dots = re.findall(r'<path d="M([\d.]+) ([\d.]+)C[^"]*z" fill="#000000"/>', figure)
        assert len(dots) == 1, title
        if "напряж" not in title:
            continue
        x, low = map(float, dots[0])
        lines = [re.findall(r"L([\d.]+) ([\d.]+)", d) for d in re.findall(r'd="([^"]*)"', figure)]
        ends = [{(float(y), float(at)) for at, y in line} for line in lines if len(line) > 5]
        top = (round(low - 2.8, 2), x)
        assert any(top == min(tops) for tops in ends if len(tops) > 5 and top in tops)


@pytest.mark.parametrize(
    ("pairs", "said"),
    [
        ((("stress_allowed_mpa", 200.0),), "не превышает допускаемой 200 МПа"),
        ((("stress_allowed_mpa", 150.0),), "то есть ниже допускаемой: он нужен"),
        ((("other_flywheel_kg_m2", 4.0),), "Более тяжёлый маховик сдвигает первую частоту вниз"),
        (
            (("speed_min_rpm", 2700.0), ("speed_max_rpm", 2850.0)),
            "Резонансов первых форм в рабочем",
        ),
        ((("damper", "tuned"),), "Настроенный гаситель имеет жёсткость"),
    ],
)
def test_the_sentences_follow_the_numbers(pairs: tuple, said: str) -> None:
    assert said in page("mwm-6", *pairs)


@pytest.mark.parametrize(
    ("least", "most", "said", "unsaid"),
    [
        # Order 6 has its resonance at 2166: the working speeds end before it, or far from it.
        (1500.0, 2050.0, "с формой 1 лежит за диапазоном, при 2166 мин−1", "до резонансов"),
        (500.0, 600.0, "до резонансов которого далеко", "лежит за диапазоном"),
        (1500.0, 2400.0, "самый опасный порядок — 6", "Больше других в нём"),
    ],
)
def test_the_order_of_the_greatest_stress_is_named_where_its_resonance_is_not_in_the_range(
    least: float, most: float, said: str, unsaid: str
) -> None:
    text = page("mwm-6", ("speed_min_rpm", least), ("speed_max_rpm", most))
    assert said in text and unsaid not in text


def test_estimates_are_called_so() -> None:
    text = page("d-240")
    assert "по памяти" not in text and "принята формула" in text
    assert "разброс" in text
    assert "до замены оценок данными двигателя выводы предварительные" in text
    assert "Крутильные колебания вала" in text


@pytest.mark.parametrize(("name", "cylinders"), [("two-stroke", 1), ("d-240", 4)])
def test_one_vector_is_not_added_to_others(name: str, cylinders: int) -> None:
    """A star of one cylinder is a line of length one."""
    assert ("Сложение векторов" in page(name)) == (cylinders > 1)


@pytest.mark.parametrize(("coupling", "alike"), [(500.0, True), (1e8, False)])
def test_formulas_of_stiffness_say_nothing_of_a_frequency_that_does_not_rest_on_it(
    coupling: float, alike: bool
) -> None:
    """With a soft coupling behind the flywheel the shaft of the first form is all but rigid."""
    text = page("d-240", ("driven_kg_m2", 2.0), ("driven_nm_rad", coupling))
    assert ("от жёсткости колен она почти не зависит" in text) == alike
    assert ("С такой же точностью известны" in text) != alike


@pytest.mark.parametrize(("inertia", "said"), [(1e-4, True), (1.2, False)])
def test_a_flywheel_lighter_than_a_throw_is_called_implausible(inertia: float, said: bool) -> None:
    """However it came to be: frequencies of such a shaft belong to no engine."""
    text = page("d-240", ("flywheel_kg_m2", inertia))
    assert ("неправдоподобно лёгок" in text) == said


_LIGHT, _HEAVY = "меньше, чем у одного колена", "больше, чем у всех колен вместе"


@pytest.mark.parametrize(
    ("inertia", "said"), [(1e-4, _LIGHT), (1.2, ""), (1200.0, _HEAVY), (None, "")]
)
def test_check_says_of_a_flywheel_what_the_report_says(
    tmp_path: Path, inertia: float | None, said: str
) -> None:
    text = (samples_dir() / "d-240.toml").read_text(encoding="utf-8")
    given = "" if inertia is None else f"flywheel_kg_m2 = {inertia}\n"
    text = re.sub(r"(?m)^flywheel_kg_m2.*\n", "", text)
    file = tmp_path / "d.toml"
    torsion = f"[torsion]\n{given}"
    file.write_text(text.replace("[torsion]\n", torsion) if "[torsion]" in text
                    else f"{text}\n{torsion}", encoding="utf-8")  # fmt: skip
    result = CliRunner().invoke(main, ["check", str(file)])
    lines = [line for line in result.output.splitlines() if "torsion.flywheel_kg_m2" in line]
    assert bool(lines) == bool(said)
    assert result.exit_code == (1 if said else 0)
    assert all(said in line and ";" in line for line in lines)
