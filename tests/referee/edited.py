"""Open workbooks in LibreOffice as a person does, type into one cell of each, read all cells.

Run by the system's Python, which has ``uno``: ``edited.py PROFILE < JOBS``.
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from office import desktop, prop


def edit(office, source, sheet, cell, value, target):
    """Rows of values by sheet after the first edit; the document is saved as ``target``."""
    address = Path(source).resolve().as_uri()
    document = office.loadComponentFromURL(address, "_blank", 0, (prop("Hidden", True),))
    sheets = document.getSheets()
    sheets.getByName(sheet).getCellRangeByName(cell).setValue(value)
    values = {}
    for name in sheets.getElementNames():
        page = sheets.getByName(name)
        cursor = page.createCursor()
        cursor.gotoEndOfUsedArea(False)
        last = cursor.getRangeAddress()
        used = page.getCellRangeByPosition(0, 0, last.EndColumn, last.EndRow)
        values[name] = used.getDataArray()
    form = prop("FilterName", "Calc MS Excel 2007 XML")
    document.storeToURL(Path(target).resolve().as_uri(), (form,))
    document.close(True)
    return values


def main(profile):
    with desktop(profile) as office:
        json.dump([edit(office, *job) for job in json.load(sys.stdin)], sys.stdout)


main(sys.argv[1])
