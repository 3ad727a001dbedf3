"""Errors a person can mend: one tree, each error with its problems in one line each.

KshmError
├── InputError (a ValueError)        a number, a file, an argument is wrong
│   ├── CycleError                   no cycle follows from the inputs
│   ├── FilmError                    an oil film does not carry
│   └── UnknownNameError             a KeyError and an AttributeError too
└── those of the report engine       ``reports.shared.errors``
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

Limits = tuple[float | None, float | None]
NO_LIMITS: Limits = (None, None)
_LONGEST_LINE = 600


def one_line(text: str, limit: int = 300) -> str:
    """Return `text` on one line, control characters replaced, cut to `limit` characters."""
    flat = "".join(char if char.isprintable() else " " for char in text)
    flat = " ".join(flat.split())
    return flat if len(flat) <= limit else flat[: limit - 1] + "…"


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing wrong.

    Attributes:
        where: the file and key, or the argument.
        what: what is wrong there.
        hint: how to mend it.
        limits: the least and the greatest allowed value in the unit of the key, None for no limit.
        value: the value that is refused, if it is one.

    >>> Problem("bore_mm", "must be positive", value=-1).line()
    'bore_mm: must be positive'
    """

    where: str
    what: str
    hint: str = ""
    limits: Limits = field(default=NO_LIMITS, compare=False)
    value: Any = field(default=None, compare=False)

    def words(self) -> dict[str, str]:
        """Return what a page shows.

        >>> Problem("bore_mm", "must be positive").words()
        {'where': 'bore_mm', 'what': 'must be positive', 'hint': ''}
        """
        return {"where": self.where, "what": self.what, "hint": self.hint}

    def line(self) -> str:
        """Return the one-line message.

        >>> Problem("bore_mm", "must be positive", "e.g. 88").line()
        'bore_mm: must be positive; e.g. 88'
        """
        text = ": ".join(part for part in (self.where, self.what) if part)
        return one_line(f"{text}; {self.hint}" if self.hint else text, limit=_LONGEST_LINE)


class KshmError(Exception):
    """Base of all expected errors; the message is one line per problem.

    Attributes:
        problems: all that is wrong, see ``Problem``.
        exit_code: what the command line ends with.

    >>> error = KshmError([Problem("a", "wrong", "mend it"), Problem("b", "missing")])
    >>> print(error)
    a: wrong; mend it
    b: missing
    """

    exit_code: int = 2

    def __init__(self, problems: Sequence[Problem] | Problem | str) -> None:
        if isinstance(problems, str):
            problems = Problem("", problems)
        if isinstance(problems, Problem):
            problems = (problems,)
        self.problems: tuple[Problem, ...] = tuple(problems)
        super().__init__("\n".join(self.lines()))

    def __str__(self) -> str:
        return "\n".join(self.lines())

    def __reduce__(self) -> tuple[Any, ...]:
        """Copy and pickle an error whatever its constructor takes."""
        return _revived, (type(self), self.args), self.__dict__

    def lines(self) -> list[str]:
        """Return one line per problem.

        >>> KshmError([Problem("a", "wrong"), Problem("b", "missing")]).lines()
        ['a: wrong', 'b: missing']
        """
        return [problem.line() for problem in self.problems]


class InputError(KshmError, ValueError):
    """Bad input or usage; `problems` holds everything found at once.

    >>> import kshm
    >>> try:
    ...     kshm.end_mass(-1, angle_deg=180, arm_mm=50)
    ... except kshm.InputError as error:
    ...     print(error.problems[0].where, error.problems[0].value)
    EndMass.mass -1
    """


@dataclass(frozen=True, slots=True)
class Remark:
    """``key`` of what is wrong or odd, the input ``field`` it is about, its numbers in SI.

    ``field`` is the name of the input in the dataclasses of the cycle, such as
    ``boost.pressure_ratio``.
    """

    key: str
    field: str
    numbers: Mapping[str, float]


class CycleError(InputError):
    """Input without a cycle; ``remark`` names it and the reason."""

    def __init__(self, key: str, field: str, **numbers: float) -> None:
        """Keep the remark; the text of the error is for developers."""
        listed = ", ".join(f"{name} = {value:.6g}" for name, value in numbers.items())
        super().__init__(Problem(field, key + (f" ({listed})" if listed else "")))
        self.remark = Remark(key, field, numbers)


class FilmError(InputError):
    """Load that no film carries; ``bearing`` is its row."""

    def __init__(self, bearing: int) -> None:
        super().__init__(Problem(f"bearing {bearing}", "the oil film does not carry the load"))
        self.bearing = bearing


class UnknownNameError(InputError, KeyError, AttributeError):
    """A key, a name or an attribute that there is not; ``args`` holds it.

    >>> import kshm
    >>> try:
    ...     kshm.quantity("M_men")
    ... except kshm.UnknownNameError as error:
    ...     print(error.problems[0].hint)
    similar: M_mean, M_min, M_e
    """

    def __init__(self, name: str, problem: Problem) -> None:
        super().__init__(problem)
        self.args = (name,)


def _revived(kind: type[KshmError], args: tuple[Any, ...]) -> KshmError:
    error = kind.__new__(kind)
    error.args = args
    return error
