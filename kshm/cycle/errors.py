"""The error of the cycle calculation and the number format of its messages."""

from __future__ import annotations


class CycleError(ValueError):
    """An input from which no cycle can be calculated.

    The text is one Russian line: which input and which way to change it.
    ``field`` is the name of that input in the dataclasses of the cycle, so that
    the caller can point to the place in the file.
    """

    def __init__(self, message: str, field: str) -> None:
        """Keep the one-line message and the input it is about."""
        super().__init__(message)
        self.field = field


def ru(value: float, digits: int = 4) -> str:
    """Number with a decimal comma and ``digits`` significant digits, never as 2e+04."""
    text = f"{value:.{digits}g}"
    if "e" in text:
        text = f"{float(text):.12f}".rstrip("0").rstrip(".")
    return text.replace(".", ",")
