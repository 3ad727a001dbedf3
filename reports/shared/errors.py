"""Errors of the report engine, on the tree of the solver."""

from __future__ import annotations

from kshm.errors import (
    NO_LIMITS,
    InputError,
    KshmError,
    Problem,
    UnknownNameError,
    one_line,
)

__all__ = [
    "NO_LIMITS",
    "InputError",
    "KshmError",
    "OutputError",
    "Problem",
    "SystemPartMissing",
    "UnknownNameError",
    "one_line",
]


class OutputError(KshmError):
    """A result cannot be written where it was asked for."""


class SystemPartMissing(KshmError):  # noqa: N818 - the contract's name
    """A part of the system (pango, LibreOffice, fonts) is missing.

    Attributes:
        part: What is missing.
        command: The command that installs it; empty if none is known.
        purpose: What it is needed for.
    """

    exit_code = 3

    def __init__(self, part: str, command: str = "", *, purpose: str = "") -> None:
        self.part = part
        self.command = command
        self.purpose = purpose
        problem = f"не найден системный компонент {part}"
        if purpose:
            problem += f" ({purpose})"
        hint = f"установите его: {command}" if command else ""
        super().__init__(Problem("", problem, hint))
