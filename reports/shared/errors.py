"""Errors a person can mend: each carries the exit code and one-line Russian messages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


def one_line(text: str, limit: int = 300) -> str:
    """Return `text` on one line, control characters replaced, cut to `limit` characters."""
    flat = "".join(char if char.isprintable() else " " for char in text)
    flat = " ".join(flat.split())
    return flat if len(flat) <= limit else flat[: limit - 1] + "…"


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing wrong: where it is, what it is, how to mend it (all Russian)."""

    where: str
    what: str
    hint: str = ""

    def line(self) -> str:
        """Return the one-line message."""
        text = ": ".join(part for part in (self.where, self.what) if part)
        return one_line(f"{text}; {self.hint}" if self.hint else text, limit=600)


class KshmError(Exception):
    """Base of all expected errors; the message is one Russian line per problem."""

    exit_code: int = 2

    def __init__(self, problems: Sequence[Problem] | Problem | str) -> None:
        if isinstance(problems, str):
            problems = Problem("", problems)
        if isinstance(problems, Problem):
            problems = (problems,)
        self.problems: tuple[Problem, ...] = tuple(problems)
        super().__init__("\n".join(self.lines()))

    def lines(self) -> list[str]:
        """Return one line per problem."""
        return [problem.line() for problem in self.problems]


class InputError(KshmError):
    """Bad input or usage; `problems` holds everything found at once."""

    exit_code = 2


class OutputError(KshmError):
    """A result cannot be written where it was asked for."""

    exit_code = 2


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
