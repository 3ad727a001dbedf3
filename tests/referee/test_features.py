"""Single features of formulas against LibreOffice, in one book that it calculates once."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence

import pytest
from openpyxl import Workbook
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.formula import ArrayFormula

from reports.recalculation.evaluate import Evaluator
from reports.recalculation.read import read_grid
from reports.shared.errors import UnknownFormula
from tests.referee.features import DATA, DIFFERENT, FEATURES, NAMES, SHEET
from tools.referees.by_libreoffice import LibreOffice
from tools.referees.cells import CellValue

FIRST, COLUMN = 10, 10
_PERCENT = re.compile(r"(-?[0-9.]+)%")
# LibreOffice's own numbers of errors: a wrong argument, a number that is none, a kind.
_OWN_ERRORS = {"Err:502": ("#NUM!", "#VALUE!"), "Err:503": ("#NUM!",), "Err:522": ("#CIRC!",)}


def book_of_features(formulas: Sequence[str] = FEATURES) -> bytes:
    book = Workbook()
    sheet = book.active
    sheet.title = SHEET
    for letters, values in DATA.items():
        for row, value in enumerate(values, 1):
            if value is not None:
                sheet[f"{letters}{row}"] = value
    for name, cells in NAMES.items():
        book.defined_names[name] = DefinedName(name, attr_text=f"'{SHEET}'!{cells}")
    for row, formula in enumerate(FEATURES, FIRST):
        if formula not in formulas:
            continue
        at = f"J{row}"
        array = formula.startswith("{")
        sheet[at] = ArrayFormula(at, f"={formula[1:]}") if array else f"={formula}"
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def ours(engine: Evaluator, row: int) -> CellValue:
    """Our value; None where it is unknown."""
    try:
        return engine.shown(SHEET, COLUMN, row)
    except UnknownFormula:
        return None


def agrees(own: CellValue, wanted: CellValue) -> bool:
    if own is None or wanted is None:
        return False
    if isinstance(wanted, str) and wanted in ("TRUE", "FALSE"):
        wanted = float(wanted == "TRUE")
    percent = _PERCENT.fullmatch(wanted) if isinstance(wanted, str) else None
    if percent is not None:
        wanted = float(percent[1]) / 100
    if isinstance(wanted, float):
        try:
            return abs(float(own) - wanted) <= 1e-12 * max(1.0, abs(wanted))
        except ValueError:
            return False
    return own in _OWN_ERRORS.get(str(wanted), ()) or str(own).lower() == str(wanted).lower()


def test_the_list_is_whole():
    assert len(FEATURES) == len(set(FEATURES)) >= 290
    assert set(DIFFERENT) <= set(FEATURES)


@pytest.mark.libreoffice
def test_every_feature_agrees_with_libreoffice(libreoffice: LibreOffice) -> None:
    book = book_of_features()
    (theirs,) = libreoffice.recalculate([book])
    # Functions that are lifted over arrays are replaced for a whole book: one without arrays
    # tries those of formualizer itself.
    scalar = [f for f in FEATURES if not f.startswith("{") and "SUMPRODUCT" not in f]
    engines = [Evaluator(read_grid(data)) for data in (book, book_of_features(scalar))]
    wrong, stale = [], []
    kinds = set()
    for engine, row, formula in (
        (engine, row, formula)
        for engine in engines
        for row, formula in enumerate(FEATURES, FIRST)
        if engine is engines[0] or formula in scalar
    ):
        own, wanted = ours(engine, row), theirs[SHEET][f"J{row}"]
        kinds.add(own)
        if formula not in DIFFERENT:
            if not agrees(own, wanted):
                wrong.append((formula, own, wanted))
            continue
        expected, why = DIFFERENT[formula]
        if own != expected and not agrees(own, expected):
            wrong.append((formula, own, expected, why))
        if agrees(own, wanted):
            stale.append(formula)
    assert wrong == []
    assert stale == []
    assert {"#DIV/0!", "#NUM!", "#VALUE!", "#N/A"} <= kinds
