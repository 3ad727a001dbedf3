"""Docstrings of the public functions by machine: arguments, units, shapes, errors, sources."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import kshm
import reports
from reports.python.figures import SolutionPlots, SvgPicture
from tests.api.conftest import run_text

SOURCES = ("Gots", "scipy", "kshm.")  # the textbook, a method, what it says elsewhere
CLASSES = (
    *(each for each in (getattr(kshm, name) for name in kshm.__all__) if inspect.isclass(each)),
    SolutionPlots,
    SvgPicture,
)
# Annotations of numbers, which have a unit, and of what has a shape.
NUMBER = re.compile(r"\b(?:float|Sizes)\b")
SHAPED = re.compile(r"\b(?:Array|ChainArrays|DataFrame|Iterator|Columns|Tables)\b")


def functions() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Public functions of both packages, and public methods of their classes."""
    for package in (kshm, reports):
        for name in package.__all__:
            if inspect.isfunction(each := getattr(package, name)):
                yield f"{package.__name__}.{name}", each
    for owner in CLASSES:
        if owner.__module__.startswith(("kshm", "reports")):
            for name, each in vars(owner).items():
                if inspect.isfunction(each) and not name.startswith("_"):
                    yield f"{owner.__name__}.{name}", each


def arguments(text: str) -> dict[str, str]:
    """What the section Args says of each argument."""
    section = re.search(r"^Args:\n((?:    .*\n|\n)+)", text + "\n", re.MULTILINE)
    entries = re.split(r"^    (?=\S)", section[1] if section else "", flags=re.MULTILINE)[1:]
    pairs = (entry.partition(": ") for entry in entries)
    return {name.lstrip("*"): " ".join(said.split()) for name, _, said in pairs}


def faults(function: Callable[..., Any]) -> list[str]:
    text = inspect.getdoc(function) or ""
    parameters = {
        name: str(each.annotation)
        for name, each in inspect.signature(function).parameters.items()
        if name not in ("self", "cls")
    }
    said, result = arguments(text), str(inspect.signature(function).return_annotation)
    collected = [f"{name}: not explained" for name in parameters if name not in said]
    # A name ends in its unit; the words have it too, as a value that has none has [-].
    collected += [
        f"{name}: no unit"
        for name, kind in parameters.items()
        if NUMBER.search(kind) and not re.search(r"\[[^]]+\]|in (?:its|their) unit|unit of",
                                                 said.get(name, ""))
    ]  # fmt: skip
    collected += [f"{name}: there is none" for name in said if name not in parameters]
    if NUMBER.search(result) and not re.search(r"\[[^]]+\]|unit", text):
        collected.append("no unit of the result")
    if SHAPED.search(result) and not re.search(r"shape \(|row (?:a|for each)|one row", text):
        collected.append("no shape of the result")
    if parameters and "Raises:" not in text:
        collected.append("no errors")
    has_method = not function.__module__.startswith(("reports.python.api", "kshm.errors"))
    if has_method and function.__name__ != "save" and not any(word in text for word in SOURCES):
        collected.append("no source")
    if not re.search(r"^>>> ", text, re.MULTILINE):
        collected.append("no example")
    return collected


@pytest.mark.parametrize(
    ("name", "function"), [pytest.param(*each, id=each[0]) for each in functions()]
)
def test_a_public_function_says_units_shapes_errors_source_and_an_example(
    name: str, function: Callable[..., Any]
) -> None:
    assert faults(function) == [], name


def test_the_examples_of_methods_run(example_names: dict[str, Any]) -> None:
    """Those of the names themselves run in ``test_api``."""
    for name, method in functions():
        if "kshm." not in name and "reports." not in name:
            names = {**example_names, "SvgPicture": SvgPicture}
            run_text(name, method.__doc__ or "", names)


@pytest.mark.parametrize(
    ("name", "function"),
    [
        pytest.param(*each, id=each[0])
        for each in functions()
        if each[0].startswith(("kshm.", "reports.")) and inspect.signature(each[1]).parameters
    ],
)
def test_a_value_of_no_kind_is_an_error_that_says_so(
    name: str, function: Callable[..., Any], example_names: dict[str, Any]
) -> None:
    values = {
        "engine": reports.load("gots-diesel"), "engines": [example_names["engine"]],
        "quantity": "M_mean", "value": 1.0, "name": "bore_mm",
        "between": (80.0, 90.0), "tolerances": {"bore_mm": 0.1}, "vary": {"bore_mm": (80, 90)},
        "path": None, "folder": ".", "source": "gots-diesel",
    }  # fmt: skip
    parameters = inspect.signature(function).parameters
    sizes = {**example_names["sizes"], "firing_offsets_deg": [0, 540, 180, 360]}
    needed = (
        sizes
        if name == "kshm.assemble"
        else {
            each: values[each]
            for each, kind in parameters.items()
            if kind.default is kind.empty and each in values
        }
    )
    for each, kind in parameters.items():
        if kind.kind is kind.VAR_KEYWORD or kind.annotation in ("bool", "bool | Progress"):
            continue
        with pytest.raises(kshm.InputError):
            made = function(**{**needed, each: object()})
            list(made)  # of an iterator
