"""The fourth referee: HyperFormula, the engine of spreadsheets on web pages, by way of node."""

from __future__ import annotations

import io
import json
import subprocess
from collections.abc import Sequence
from pathlib import Path

from tools.referees.cells import Book, formula_cells, row_and_column, without_pictures

PACKAGE = "hyperformula@3.5.0"
_SCRIPT = """
const {HyperFormula} = require(process.argv[1]);
const given = JSON.parse(require("fs").readFileSync(0));
const book = HyperFormula.buildFromSheets(given.sheets, {
    licenseKey: "gpl-v3", maxRows: 30000, smartRounding: false}, given.names);
const found = {};
for (const [title, cells] of Object.entries(given.cells)) {
    const sheet = book.getSheetId(title);
    found[title] = cells.map(([row, col]) => {
        const value = book.getCellValue({sheet, row: row - 1, col: col - 1});
        return value !== null && typeof value === "object" ? value.value : value;
    });
}
process.stdout.write(JSON.stringify(found));
"""


class HyperFormula:
    """Recalculates in a process of node; ``module`` is the folder of the installed package."""

    name = "HyperFormula"

    def __init__(self, module: Path) -> None:
        self._module = module

    def recalculate(self, books: Sequence[bytes]) -> list[Book]:
        """Values of all formula cells of each workbook."""
        return [self._one(book) for book in books]

    def _one(self, book: bytes) -> Book:
        from openpyxl import load_workbook
        from openpyxl.worksheet.formula import ArrayFormula

        def text(value: object) -> object:
            array = isinstance(value, ArrayFormula)
            return f"=ARRAYFORMULA({value.text.lstrip('=')})" if array else value  # type: ignore[attr-defined]

        opened = load_workbook(io.BytesIO(without_pictures(book)))
        cells = formula_cells(book)
        given = {
            "sheets": {
                sheet.title: [[text(cell.value) for cell in row] for row in sheet.iter_rows()]
                for sheet in opened.worksheets
            },
            "names": [
                {"name": name, "expression": f"={defined.attr_text}"}
                for name, defined in opened.defined_names.items()
            ],
            "cells": {title: [row_and_column(at) for at in item] for title, item in cells.items()},
        }
        done = subprocess.run(
            ["node", "-e", _SCRIPT, str(self._module)],
            input=json.dumps(given), capture_output=True, text=True, timeout=300, check=True,
        )  # fmt: skip
        values = json.loads(done.stdout)
        return {
            title: {
                at: float(value) if isinstance(value, int) else value
                for at, value in zip(item, values[title], strict=True)
            }
            for title, item in cells.items()
        }
