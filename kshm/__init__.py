"""Kinematics and dynamics of the crank mechanism of piston engines.

The names below are the public ones and stay: ``solve(engine)`` gives a ``Solution`` with
``tables`` (pandas), ``columns`` (numpy) and ``scalars`` in the units of the textbook.
Engines come from ``in_line`` with a person's units or from ``Engine`` in SI.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kshm.engine.engine import Engine

if TYPE_CHECKING:
    from kshm.chain.solve import solve, solve_chunks
    from kshm.engine.textbook_units import end_mass, in_line, points, polytropic, throw
    from kshm.nomenclature.quantity import Quantity, quantity
    from kshm.results.solution import Solution

__all__ = [
    "Engine",
    "Quantity",
    "Solution",
    "end_mass",
    "in_line",
    "points",
    "polytropic",
    "quantity",
    "solve",
    "solve_chunks",
    "throw",
]
__version__ = "0.1.0"

_HOMES = {
    **dict.fromkeys(
        ("end_mass", "in_line", "points", "polytropic", "throw"), "kshm.engine.textbook_units"
    ),
    **dict.fromkeys(("Quantity", "quantity"), "kshm.nomenclature.quantity"),
    **dict.fromkeys(("solve", "solve_chunks"), "kshm.chain.solve"),
    "Solution": "kshm.results.solution",
}


def __getattr__(name: str) -> Any:  # noqa: ANN401
    """Import the numeric part only when it is asked for."""
    from importlib import import_module

    if name not in _HOMES:
        msg = f"module 'kshm' has no attribute '{name}'"
        raise AttributeError(msg)
    return getattr(import_module(_HOMES[name]), name)
