"""What a reader sees on the pages of a PDF: where ink lies, which words stand where."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tests.document.pdftools import poppler

DPI = 50
MM = DPI / 25.4  # dots in a millimetre
_PAGE = re.compile(r'<page width="([\d.]+)" height="([\d.]+)">(.*?)</page>', re.DOTALL)
_WORD = re.compile(
    r'<word xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">(.*?)</word>'
)


@dataclass(frozen=True, slots=True)
class Field:
    """The field of the text on a sheet: its margins [mm]."""

    left: float = 30.0
    right: float = 15.0
    top: float = 20.0
    bottom: float = 20.0


@dataclass(frozen=True, slots=True)
class Word:
    """A word and its box [mm] from the upper left corner of the sheet."""

    left: float
    top: float
    right: float
    bottom: float
    text: str


def sheets(pdf: Path) -> list[NDArray[np.bool_]]:
    """Where each page has ink, shape (rows, columns) at ``DPI``."""
    folder = pdf.parent / f"{pdf.stem}-ink"
    folder.mkdir(exist_ok=True)
    poppler("pdftoppm", "-gray", "-r", str(DPI), str(pdf), str(folder / "p"))
    collected = [_pgm(path.read_bytes()) < 200 for path in sorted(folder.glob("*.pgm"))]
    for path in folder.glob("*.pgm"):
        path.unlink()
    return collected


def _pgm(data: bytes) -> NDArray[np.uint8]:
    """Grey values of a binary PGM, shape (rows, columns)."""
    head = re.match(rb"P5\s+(\d+)\s+(\d+)\s+255\s", data)
    assert head is not None
    columns, rows = int(head[1]), int(head[2])
    return np.frombuffer(data, np.uint8, rows * columns, head.end()).reshape(rows, columns)


def outside(sheet: NDArray[np.bool_], field: Field, *, slack: float = 1.0) -> list[str]:
    """Sides of the text's field beyond which there is ink; the page's number is allowed."""
    rows, columns = sheet.shape
    left, right = round((field.left - slack) * MM), columns - round((field.right - slack) * MM)
    top, bottom = round((field.top - slack) * MM), rows - round((field.bottom - slack) * MM)
    foot = sheet[bottom:].copy()
    middle = round((210 + field.left - field.right) / 2 * MM)
    foot[:, middle - round(8 * MM) : middle + round(8 * MM)] = False
    parts = {"left": sheet[:, :left], "right": sheet[:, right:], "top": sheet[:top], "bottom": foot}
    return [name for name, part in parts.items() if part.any()]


def blank(sheet: NDArray[np.bool_], field: Field) -> float:
    """Share of the text's field below the last ink on a page."""
    rows, columns = sheet.shape
    top, bottom = round(field.top * MM), rows - round(field.bottom * MM)
    inked = sheet[top:bottom, round(field.left * MM) : columns - round(field.right * MM)].any(1)
    used = int(np.flatnonzero(inked)[-1]) + 1 if inked.any() else 0
    return 1 - used / (bottom - top)


def words(pdf: Path) -> list[list[Word]]:
    """The words of each page."""
    text = poppler("pdftotext", "-bbox", str(pdf), "-")
    return [list(_words(body)) for _, _, body in _PAGE.findall(text)]


def _words(body: str) -> Iterator[Word]:
    for *box, text in _WORD.findall(body):
        left, top, right, bottom = (float(side) * 25.4 / 72 for side in box)
        yield Word(left, top, right, bottom, html.unescape(text))


def struck_numbers(page: list[Word], field: Field) -> list[str]:
    """Numbers of formulas at the right edge that something else is printed over."""
    edge = 210 - field.right
    numbers = [w for w in page if re.fullmatch(r"\(\d+\)", w.text) and w.right > edge - 1.5]
    return [
        f"{number.text} {word.text}"
        for number in numbers
        for word in page
        if word is not number
        and min(word.right, number.right) - max(word.left, number.left) > 0.3
        and min(word.bottom, number.bottom) - max(word.top, number.top) > 1.5
    ]
