"""Pieces of Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def escaped(text: str) -> str:
    """Text that means itself inside a table cell."""
    for char in "\\|*_[]<>":
        if char != "\\" and char in text and "`" not in text:
            text = text.replace(char, "\\" + char)
    return text.replace("\n", " ")


def code(text: str) -> str:
    """Code inside a table cell: a bar would end the cell."""
    return "`" + text.replace("|", "\\|") + "`" if text else "—"


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)
