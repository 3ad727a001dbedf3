"""The report engine: files, tables and people around the solver `kshm`.

The names below are the public ones: ``load`` gives the engine of an input, ``dump`` writes the
input of an engine, ``build`` the documents, ``plot`` the figures of a solution.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from reports.python.api import build, dump, load, samples
    from reports.python.figures import plot

__all__ = ["build", "dump", "load", "plot", "samples"]

_HOMES = {"plot": "reports.python.figures"}


def __dir__() -> list[str]:
    """Return the public names."""
    return [*__all__]


def __getattr__(name: str) -> Any:  # noqa: ANN401
    """Import the door on first use: the command pays for what it uses."""
    from importlib import import_module

    if name not in __all__:
        raise AttributeError(f"module 'reports' has no attribute '{name}'")
    member = getattr(import_module(_HOMES.get(name, "reports.python.api")), name)
    globals()[name] = member
    return member
