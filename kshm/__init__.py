"""Kinematics and dynamics of the crank mechanism of piston engines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kshm.engine import Engine

if TYPE_CHECKING:
    from kshm.solution import Solution
    from kshm.solver import solve

__all__ = ["Engine", "Solution", "solve"]
__version__ = "0.1.0"


def __getattr__(name: str) -> Any:  # noqa: ANN401
    """Import the numeric part only when it is asked for."""
    if name == "solve":
        from kshm.solver import solve

        return solve
    if name == "Solution":
        from kshm.solution import Solution

        return Solution
    raise AttributeError(name)
