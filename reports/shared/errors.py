"""Errors of the report engine: those that people see, and those of its inner parts.

KshmError                          ``kshm.errors``
├── InputError
│   └── BookError                  a mistake in a book of tables
├── OutputError                    a result cannot be written
└── SystemPartMissing              pango, a package
InnerError                         caught within the program; a person never sees one
├── Unfit (a ValueError)           a text or a number that is not what it should be
│   ├── FormulaError, NotPrintable, DeclarationError             of books
│   ├── TexError, SymbolError, FormulaImageError                 of TeX
│   ├── NumberingError, CacheError, SharedFormulaError           of documents
│   └── UnknownFormula, BadBook                                  of workbooks that are read
├── RenderError                    a page that cannot be set
├── UnfitTable                     a separator that does not read a recorded table
├── Unread                         nobody reads the output any more
└── WorkerLost                     a process: Died, NeverStarted
"""

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
    "BadBook",
    "BookError",
    "CacheError",
    "DeclarationError",
    "Died",
    "FormulaError",
    "FormulaImageError",
    "InnerError",
    "InputError",
    "KshmError",
    "NeverStarted",
    "NotPrintable",
    "NumberingError",
    "OutputError",
    "Problem",
    "RenderError",
    "SharedFormulaError",
    "SymbolError",
    "SystemPartMissing",
    "TexError",
    "Unfit",
    "UnfitTable",
    "UnknownFormula",
    "UnknownNameError",
    "Unread",
    "WorkerLost",
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


class BookError(InputError):
    """A mistake in a book: where it stands there, what it is, how to mend it."""

    def __init__(self, book: str, line: int, column: int, problem: str, hint: str = "") -> None:
        at = f"{one_line(book, 60)}: строка {line}, столбец {column}"
        super().__init__(Problem(at, one_line(problem, 200), hint))
        self.line, self.column = line, column


class InnerError(Exception):
    """What is caught within the program."""


class Unfit(InnerError, ValueError):  # noqa: N818
    """A text, a formula or a number that is not what it should be."""


class FormulaError(Unfit):
    """An expression is not of the language: the part that is not, and in Russian how to mend it."""

    def __init__(self, problem: str, fragment: str = "", mend: str = "") -> None:
        super().__init__(problem)
        self.fragment, self.mend = fragment, mend


class NotPrintable(Unfit):
    """The expression has no plain printed form (a choice, an interpolation)."""


class DeclarationError(Unfit):
    """A declaration of a book that is none: its line, what is wrong, how to mend it."""

    def __init__(self, problem: str, hint: str, line: int = 0, column: int = 1) -> None:
        super().__init__(problem)
        self.line, self.column, self.what, self.hint = line, column, problem, hint


class TexError(Unfit):
    """The TeX is not well formed."""


class SymbolError(Unfit):
    """The TeX is no simple symbol."""


class FormulaImageError(Unfit):
    """The TeX of a formula cannot be set."""


class NumberingError(Unfit):
    """A reference, a placing or a declaration does not fit the others."""


class CacheError(Unfit):
    """A formula cell has no finite value to be cached."""


class SharedFormulaError(Unfit):
    """A cell holds a formula that stands for others, too; the message is its address."""


class UnknownFormula(Unfit):
    """A formula that the referee cannot calculate for certain: a person must look."""


class BadBook(Unfit):
    """A workbook that cannot be read; the message is Russian."""


class RenderError(InnerError):
    """WeasyPrint warned or refused: the PDF would not be what the template says."""


class UnfitTable(InnerError):  # noqa: N818
    """Separator that does not read a table; ``rows`` counts the rows it did read."""

    def __init__(self, rows: int, error: InputError, *, final: bool = False) -> None:
        super().__init__()
        self.rows, self.error, self.final = rows, error, final


class Unread(InnerError):  # noqa: N818
    """A broken pipe, as no OSError: click ends the program over those."""


class WorkerLost(InnerError):  # noqa: N818
    """A process is gone."""


class Died(WorkerLost):
    """The process has died of its question."""


class NeverStarted(WorkerLost):
    """Processes die or hang before they are ready."""
