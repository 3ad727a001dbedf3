"""Kinematics and dynamics of the crank mechanism of piston engines.

The names below are the public ones and stay: ``solve(engine)`` gives a ``Solution`` with
``tables`` (pandas), ``columns`` (numpy) and ``scalars`` in the units of the textbook.
Engines come from ``in_line`` and ``assemble`` with a person's units or from ``Engine`` in SI.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kshm.engine.engine import Engine
from kshm.errors import InputError, KshmError, Problem, UnknownNameError

if TYPE_CHECKING:
    from kshm.chain.solve import solve_chunks
    from kshm.engine.arrangement import opposed
    from kshm.engine.textbook_units import (
        EngineNumbers,
        articulated_rod,
        assemble,
        banks,
        end_mass,
        in_line,
        place,
        points,
        polytropic,
        throw,
    )
    from kshm.nomenclature.quantity import Quantity, quantity
    from kshm.results.search import Optimum, optimise, solve_for
    from kshm.results.solution import Solution, solve
    from kshm.results.study import StudyInterrupted, sweep
    from kshm.results.tolerance import Bands, tolerance

__all__ = [
    "Bands",
    "Engine",
    "EngineNumbers",
    "InputError",
    "KshmError",
    "Optimum",
    "Problem",
    "Quantity",
    "Solution",
    "StudyInterrupted",
    "UnknownNameError",
    "articulated_rod",
    "assemble",
    "banks",
    "end_mass",
    "in_line",
    "opposed",
    "optimise",
    "place",
    "points",
    "polytropic",
    "quantity",
    "solve",
    "solve_chunks",
    "solve_for",
    "sweep",
    "throw",
    "tolerance",
]
__version__ = "0.1.0"

_HOMES = {
    "kshm.chain.solve": ("solve_chunks",),
    "kshm.engine.arrangement": ("opposed",),
    "kshm.engine.textbook_units": (
        "EngineNumbers", "articulated_rod", "assemble", "banks", "end_mass", "in_line", "place",
        "points", "polytropic", "throw",
    ),
    "kshm.nomenclature.quantity": ("Quantity", "quantity"),
    "kshm.results.search": ("Optimum", "optimise", "solve_for"),
    "kshm.results.solution": ("Solution", "solve"),
    "kshm.results.study": ("StudyInterrupted", "sweep"),
    "kshm.results.tolerance": ("Bands", "tolerance"),
}  # fmt: skip


def __dir__() -> list[str]:
    """Return the public names."""
    return [*__all__]


def __getattr__(name: str) -> Any:  # noqa: ANN401
    """Import the numeric part on first use."""
    from importlib import import_module

    for home, names in _HOMES.items():
        if name in names:
            globals()[name] = getattr(import_module(home), name)
            return globals()[name]
    raise AttributeError(f"module 'kshm' has no attribute '{name}'")
