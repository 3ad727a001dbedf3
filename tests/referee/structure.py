"""Type into structural cells in LibreOffice as a person does, and set each back.

Run by the system's Python, which has ``uno``: ``structure.py PROFILE < JOBS``.
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from office import desktop, prop


def type_in(page, cell, value):
    target = page.getCellRangeByName(cell)
    target.setString(value) if isinstance(value, str) else target.setValue(value)


def watched(sheets, cells):
    """Texts of some cells, given as sheet and address."""
    return [sheets.getByName(sheet).getCellRangeByName(at).getString() for sheet, at in cells]


def answers(office, source, edits, cells, page):
    """Texts before, and after each edit and its return; after the first one a page of all."""
    document = office.loadComponentFromURL(
        Path(source).as_uri(), "_blank", 0, (prop("Hidden", True),)
    )
    sheets = document.getSheets()
    collected = [watched(sheets, cells)]
    for number, (sheet, at, value, origin) in enumerate(edits):
        type_in(sheets.getByName(sheet), at, value)
        collected.append(watched(sheets, cells))
        if not number:
            document.storeToURL(Path(page).as_uri(), (prop("FilterName", "HTML (StarCalc)"),))
        type_in(sheets.getByName(sheet), at, origin)
        collected.append(watched(sheets, cells))
    document.close(True)
    return collected


with desktop(sys.argv[1]) as root:
    json.dump([answers(root, *job) for job in json.load(sys.stdin)], sys.stdout)
