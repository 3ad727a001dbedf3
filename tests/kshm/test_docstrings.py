"""Every public function on arrays says of what shape, in what unit and by what source."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import kshm

ROOMS = ("mechanics", "chain", "cycle")
# What a result looks like: its axes, or one value for every value given.
SHAPE = re.compile(r"\bshapes?\b|\belementwise\b|\bscalar\b|\(engines, |\(rays,\)", re.IGNORECASE)
UNIT = re.compile(r"\[[^\]]+\]|\bSI\b")
# A book or paper with the formula's place, or the law that gives it.
SOURCE = re.compile(
    r"Gots|Segal|Neiman|Chudakov|Ilchenko|Dinn|Fritsch|Clapeyron|Lanchester|statics|figure|"
    r"Grinevetsky|Mazing|Leiderman|Kolchin|Dizdn|definition|conservation|GOST|"
    r"Holzer|Ker Wilson|Carter|Zimanenko|Den Hartog|"
    r"Booker|Butenschön|ISO 7902|Poiseuille|Reynolds|Vogel|Serensen|IACS|both film equations"
)


def modules(room: str) -> Iterator[Any]:
    package = importlib.import_module(f"kshm.{room}")
    for item in pkgutil.iter_modules(package.__path__):
        yield importlib.import_module(f"kshm.{room}.{item.name}")


def array_functions(room: str) -> Iterator[tuple[str, Callable[..., Any]]]:
    """Public functions and methods with arrays among their arguments or as their result."""
    for module in modules(room):
        classes = [c for name, c in inspect.getmembers(module, inspect.isclass) if name[0] != "_"]
        for holder in (module, *classes):
            for name, item in inspect.getmembers(holder):
                function = inspect.unwrap(getattr(item, "__func__", item))
                if not inspect.isfunction(function) or name.startswith("_"):
                    continue
                if function.__module__ != module.__name__:
                    continue
                if re.search(
                    r"\b(Array|Phasors)\b", " ".join(map(str, function.__annotations__.values()))
                ):
                    yield f"{module.__name__}.{function.__qualname__}", function


def lacking(text: str) -> list[str]:
    wanted = {"shape": SHAPE, "unit": UNIT, "source": SOURCE}
    return [name for name, pattern in wanted.items() if not pattern.search(text)]


@pytest.mark.parametrize("room", ROOMS)
def test_array_functions_state_shape_unit_and_source(room: str) -> None:
    wrong = {
        name: lacking(inspect.getdoc(function) or "") for name, function in array_functions(room)
    }
    assert {name: what for name, what in wrong.items() if what} == {}


def test_a_docstring_without_them_is_told() -> None:
    assert lacking("Piston displacement.") == ["shape", "unit", "source"]
    assert lacking("Piston displacement [m], elementwise, Gots (1).") == []


def test_the_functions_are_found() -> None:
    names = {name for room in ROOMS for name, _ in array_functions(room)}
    assert len(names) > 100
    assert "kshm.mechanics.kinematics.rod_angle" in names
    assert "kshm.mechanics.kinematics.Position.at" in names
    assert "kshm.chain.solve.ChainArrays.pin_rays" in names
    assert kshm.__name__ == "kshm"
