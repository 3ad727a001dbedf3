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
