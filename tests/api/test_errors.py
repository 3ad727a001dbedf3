"""One tree of errors: what is wrong, where, within which limits, of values of any kind."""

from __future__ import annotations

import copy
import pickle
import tomllib
import warnings
from decimal import Decimal

import numpy as np
import pytest

import kshm
import reports
from kshm.errors import CycleError, FilmError
from reports.shared.errors import OutputError, SystemPartMissing
from tests.api.test_api import small
from tests.conftest import ROOT

ERRORS = [
    kshm.KshmError("плохо"),
    kshm.InputError([kshm.Problem("a", "b", "c", (1.0, 2.0), 3), kshm.Problem("d", "e")]),
    kshm.UnknownNameError("M_men", kshm.Problem("M_men", "no such quantity")),
    CycleError("too_hot", "xi_z", t_z=3000.0),
    FilmError(2),
    OutputError("x"),
    SystemPartMissing("pango", "apt-get install pango", purpose="для PDF"),
]


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
def test_an_error_is_of_the_tree_and_crosses_processes(error: kshm.KshmError) -> None:
    assert isinstance(error, kshm.KshmError)
    for other in (copy.copy(error), copy.deepcopy(error), pickle.loads(pickle.dumps(error))):
        assert type(other) is type(error)
        assert (other.problems, str(other), vars(other)) == (
            error.problems, str(error), vars(error),
        )  # fmt: skip
        assert [p.value for p in other.problems] == [p.value for p in error.problems]


def data(section: object, key: object, value: object) -> dict:
    given = tomllib.loads((ROOT / "samples" / "gots-diesel.toml").read_text(encoding="utf-8"))
    return given | ({section: {**given.get(section, {}), key: value}} if key else {section: value})


@pytest.mark.parametrize(
    ("section", "key", "value", "said"),
    [
        ("geometry", "bore_mm", -5, "geometry.bore_mm: значение −5 вне допустимых пределов; "
         "допустимо от 10 до 1500 мм"),
        ("engine", "cylinders", None, "engine.cylinders: нужно целое число, "
         "а задано: пустое значение (None); допустимо от 1 до 24"),
        ("geometry", "bore_mm", object(), "geometry.bore_mm: нужно число, а задано: объект object; "
         "допустимо от 10 до 1500 мм"),
        ("engine", 1, 2, "engine: ключ 1 — не строка; ключи пишут словами, например bore_mm"),
        (3, "", 4, "ключ 3 — не строка; ключи пишут словами, например bore_mm"),
        ("engine", "cylinders", np.float64(2.5), "engine.cylinders: нужно целое число, "
         "а задано: число 2,5; допустимо от 1 до 24"),
    ],
    ids=["beyond limits", "None", "an object", "a number as a key", "as a section", "half"],
)  # fmt: skip
def test_a_wrong_value_of_any_kind_gets_words(section, key, value, said) -> None:
    with pytest.raises(ValueError, match=r"\w") as caught:
        reports.load(data(section, key, value))
    assert isinstance(caught.value, kshm.InputError)
    assert caught.value.lines() == [said]
    (problem,) = caught.value.problems
    if "допустимо" in said:
        assert problem.limits == ((1, 24) if key == "cylinders" else (10, 1500))
        assert problem.value == value


def test_numbers_of_other_libraries_are_numbers() -> None:
    engine = reports.load(ROOT / "samples" / "gots-diesel.toml")
    for section, key, value in (
        ("engine", "cylinders", np.int64(3)),
        ("geometry", "bore_mm", Decimal(88)),
        ("geometry", "bore_mm", np.float32(88)),
    ):
        assert reports.load(data(section, key, value)) == engine


def test_an_array_without_dimensions_is_the_number_that_it_holds() -> None:
    zero = np.array  # of one number
    engine, base = reports.load("gots-diesel"), small()
    named = {"bore_mm": zero(80), "compression_ratio": zero(9.0), "step_deg": zero(30),
             "firing_offsets_deg": [zero(0.0)], "pin_diameter_mm": zero(45), "wear_rays": zero(12),
             "main_lengths_mm": [zero(28), zero(28.0)]}  # fmt: skip
    assert small(**named) == base and hash(small(**named)) == hash(base)
    made = kshm.throw(arms_mm=[zero(30)] * 6, web_kg=zero(0.3), pin_kg=zero(0.2))
    assert made == kshm.throw(arms_mm=[30] * 6, web_kg=0.3, pin_kg=0.2)
    assert kshm.end_mass(zero(0.1), zero(0), zero(50)) == kshm.end_mass(0.1, 0, 50)
    assert kshm.points([zero(0), zero(360), 720], [zero(0.1), 4, 0.1]) == kshm.points(
        [0, 360, 720], [0.1, 4.0, 0.1]
    )
    assert reports.load(data("geometry", "bore_mm", zero(88.0))) == engine
    assert reports.load(data("engine", "cylinders", zero(3))) == engine
    for start in (engine, base):
        assert start.with_(bore_mm=zero(90)) == start.with_(bore_mm=90)
        assert start.with_({"geometry.bore": zero(0.09)}) == start.with_({"geometry.bore": 0.09})
        one, other = (
            kshm.sweep(start, {"bore_mm": values}, quantities=["V_h"])
            for values in ([zero(84), zero(85.0)], [84, 85.0])
        )
        assert one.equals(other)
    by_number, by_array = (
        kshm.tolerance(engine, {"bore_mm": half}, quantities=["V_h"], samples=20).table
        for half in (0.02, zero(0.02))
    )
    assert by_number.equals(by_array)
    roots = [
        kshm.solve_for(engine, "speed_rpm", "c_m", value, between=(low, 6000)).values
        for value, low in ((10.0, 1000.0), (zero(10), zero(1000)))
    ]
    assert roots[0] == roots[1]
    with_arrays = kshm.Engine.with_(base, {"crankshaft.nose.mass": zero(0.2)})
    assert kshm.solve(with_arrays) == kshm.solve(base.with_({"crankshaft.nose.mass": 0.2}))
    geometry = type(base.geometry)(zero(0.08), zero(0.04), zero(0.14), zero(9.0))
    assert geometry == base.geometry and hash(geometry) == hash(base.geometry)
    for wrong in (zero("88"), zero(None), zero([88.0])):
        with pytest.raises(kshm.InputError, match="bore_mm: must be a number, not array"):
            small(bore_mm=wrong)


def test_what_the_solver_refuses_says_where_and_within_which_limits() -> None:
    with pytest.raises(kshm.InputError) as caught:
        small(bore_mm=np.float32("nan"))
    (problem,) = caught.value.problems
    assert (problem.where, problem.limits) == ("Geometry.bore", (0.0, None))
    with pytest.raises(kshm.UnknownNameError, match="no such quantity; similar: M_mean") as caught:
        kshm.quantity("M_men")
    assert isinstance(caught.value, KeyError) and caught.value.args == ("M_men",)
    with pytest.raises(kshm.UnknownNameError, match="a key must be a text"):
        kshm.quantity(3)


@pytest.mark.parametrize(
    ("offsets", "said"),
    [
        ([0, 40, 80], ("вспышки не заполняют цикл: наибольший промежуток 640°, средний 240°",
                       "the firings do not fill the cycle: the widest gap is 640°, the mean 240°")),
        ([0, 240, 240], ("начало рабочего хода то же, что у цилиндра 2: 240°",
                         "cylinder 3 fires with cylinder 2 at 240°")),
        ([0, 270, 430], ("", "")),
    ],
)  # fmt: skip
def test_odd_firings_are_told_by_the_api_as_by_the_command(offsets, said) -> None:
    given = data("crankshaft", "firing_offsets_deg", offsets)
    given["crankshaft"].pop("throw_angles_deg", None)
    throws = small().crankshaft.throws * 3
    for words, make in (
        (said[0], lambda: reports.load(given)),
        (said[1], lambda: small(firing_offsets_deg=offsets, throws=throws, main_lengths_mm=28)),
    ):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            make()
        assert [words in str(each.message) for each in caught] == [True] * bool(words)


@pytest.mark.parametrize(
    ("offsets", "said"),
    [
        ([10, 240, 480], "firing_offsets_deg: must begin with 0, not 10"),
        ([0, 240, 760], "firing_offsets_deg: 760° is outside of the cycle; from 0° to below 720°"),
        ([0, -240, 480], "firing_offsets_deg: -240° is outside of the cycle"),
    ],
)
def test_offsets_outside_of_the_cycle_are_refused(offsets, said) -> None:
    with pytest.raises(kshm.InputError, match=said):
        small(firing_offsets_deg=offsets)
