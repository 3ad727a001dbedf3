"""Numbers of the shaft and the gases in the note: the tables, the conclusion, the sheet are one."""

from __future__ import annotations

import re
from functools import lru_cache

import numpy as np
import pytest

from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solve_input import refined, solved
from reports.new.generate import generate_engine
from tests.conftest import sample
from tests.document.bare_pages import bare_page, plain

_VALUE = r"([\d,\u00a0 ]+?)"


@lru_cache(maxsize=8)
def drawn(kind: str) -> InputFile:
    """An engine of usual values whose note has torsion."""
    raw = {
        "V6": lambda: generate_engine(6, layout="v"),
        "two-stroke": lambda: generate_engine(3, strokes=2, kind="diesel"),
        "five": lambda: generate_engine(5, kind="diesel"),
    }[kind]().data
    raw["torsion"] = {}
    return load_mapping(raw, source="f").model


@lru_cache(maxsize=8)
def words(kind: str) -> str:
    """The note of such an engine as one line."""
    return re.sub(r"\s+", " ", plain(bare_page(drawn(kind))))


def number(text: str) -> float:
    """A printed number."""
    return float(re.sub(r"\s", "", text).replace(",", ".").replace("−", "-"))


@pytest.mark.parametrize("kind", ["V6", "two-stroke", "five"])
def test_one_flywheel_in_the_whole_note(kind: str) -> None:
    text, wanted = words(kind), solved(refined(drawn(kind))).scalars["I_flywheel"]
    assert "при шаге 1° — " not in text[text.index("Момент инерции маховика не задан") :][:200]
    if wanted > 0:
        balance = re.search(rf"требуемый момент инерции маховика \S+ = {_VALUE} кг", text)
        train = re.search(rf"принят по требуемой неравномерности хода: \S+ = {_VALUE} кг", text)
        for wording in (balance, train):
            assert number(wording[1]) == pytest.approx(wanted, rel=0.01)
    else:
        assert "дополнительный маховик не требуется" in text and "даёт и без него" in text


@pytest.mark.parametrize("kind", ["V6", "two-stroke"])
def test_what_the_train_takes_for_granted_is_told(kind: str) -> None:
    text = words(kind)
    assert "момент инерции шкива — 0,4 среднего момента инерции колен" in text
    assert "сопротивление в каждом цилиндре — 49,2 кН·с/м3" in text
    assert "(принят: 0,4…1,1 расчётной частоты вращения)" in text
    whole = re.search(rf"вместе колена дают \S+ \S* ?= {_VALUE} кг", text)
    assert number(whole[1]) == pytest.approx(solved(drawn(kind)).scalars["I_engine_mean"], rel=0.01)


@pytest.mark.parametrize("kind", ["V6", "two-stroke", "five"])
def test_the_end_of_the_range_is_no_resonance(kind: str) -> None:
    table = solved(drawn(kind)).columns["torsion_response"]
    row = int(np.argmax(table["tor_tau_MPa"]))
    at_end = row in (0, len(table["tor_tau_MPa"]) - 1)
    text = words(kind)
    assert ("рабочего диапазона (рисунок" in text) == at_end
    for speed in re.findall(r"обход частот вращения около (\d+) мин", text):
        damped = table["tor_tau_damped_MPa"]
        assert float(speed) == pytest.approx(table["tor_speed_rpm"][damped.argmax()], abs=1)
        assert damped.argmax() not in (0, len(damped) - 1)


@pytest.mark.parametrize("kind", ["V6", "two-stroke", "five"])
def test_the_peak_of_the_pressure_stands_where_it_is(kind: str) -> None:
    match = re.search(rf"наибольшее давление газов {_VALUE} МПа ([^,;]*)", words(kind))
    assert number(match[1]) == pytest.approx(drawn(kind).gas.max_pressure_mpa, abs=0.006)
    assert match[2] == "в ВМТ после скачка"
    table = solved(drawn(kind)).columns["gas"]
    assert table["p_MPa"][list(table["phi_deg"]).index(360)] < 0.95 * number(match[1])


def test_the_exhaust_of_two_strokes_closes() -> None:
    assert "Закрытие выпуска" in words("two-stroke")
    assert "онец падения давления" not in words("two-stroke")
    assert "Конец падения давления при выпуске" in words("five")


@pytest.mark.parametrize("kind", ["V6", "two-stroke", "five"])
def test_the_range_of_the_torque_is_told_as_its_ends(kind: str) -> None:
    coarse, fine = (solved(each).scalars for each in (drawn(kind), refined(drawn(kind))))
    spans = [each["M_max"] - each["M_min"] for each in (coarse, fine)]
    match = re.search(
        rf"размах составляет {_VALUE} Н·м(?: \(при шаге 1° — {_VALUE} Н·м\))?", words(kind)
    )
    assert number(match[1]) == pytest.approx(spans[0], abs=1)
    ends = re.search(r"Наибольший момент (.*?) размах", words(kind))[1]
    assert (match[2] is not None) == ("при шаге 1°" in ends)
    if match[2]:
        assert number(match[2]) == pytest.approx(spans[1], abs=0.02 * spans[1])


def test_the_root_alone_does_not_give_the_angular_acceleration() -> None:
    text = words("five")
    assert "а в угловом ускорении пренебречь и λ2 рядом с единицей" in text


@pytest.mark.parametrize("name", ["yamz-236"])
def test_the_pressures_of_the_note_are_those_of_the_own_rod(name: str) -> None:
    text = re.sub(r"\s+", " ", plain(bare_page(sample(name))))
    pressure = solved(sample(name)).scalars["q_pin_max"]
    row = re.search(r"Наибольшее давление на шатунный подшипник, МПа\s*qmax\s*([\d]+,\d\d)", text)
    end = re.search(rf"давление на подшипник каждого шатуна {_VALUE} МПа", text)
    for wording in (row, end):
        assert number(wording[1]) == pytest.approx(pressure, abs=0.006)
