"""Open workbooks in LibreOffice as a person does, type into one cell of each, read all cells.

Run by the system's Python, which has ``uno``: ``edited.py PROFILE < JOBS``.
"""

import contextlib
import json
import subprocess
import sys
import time
from pathlib import Path

import uno
from com.sun.star.beans import PropertyValue
from com.sun.star.connection import NoConnectException


def prop(name, value):
    made = PropertyValue()
    made.Name, made.Value = name, value
    return made


def edit(desktop, source, sheet, cell, value):
    """Rows of values by sheet after the first edit."""
    address = Path(source).resolve().as_uri()
    document = desktop.loadComponentFromURL(address, "_blank", 0, (prop("Hidden", True),))
    sheets = document.getSheets()
    sheets.getByName(sheet).getCellRangeByName(cell).setValue(value)
    found = {}
    for name in sheets.getElementNames():
        page = sheets.getByName(name)
        cursor = page.createCursor()
        cursor.gotoEndOfUsedArea(False)
        last = cursor.getRangeAddress()
        used = page.getCellRangeByPosition(0, 0, last.EndColumn, last.EndRow)
        found[name] = used.getDataArray()
    document.close(True)
    return found


def main(profile):
    pipe = f"kshm{abs(hash(profile))}"
    office = subprocess.Popen(
        ["soffice", "--headless", "--norestore", f"-env:UserInstallation=file://{profile}",
         f"--accept=pipe,name={pipe};urp;"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    local = uno.getComponentContext()
    resolver = local.ServiceManager.createInstanceWithContext(
        "com.sun.star.bridge.UnoUrlResolver", local
    )
    for _ in range(200):
        try:
            context = resolver.resolve(f"uno:pipe,name={pipe};urp;StarOffice.ComponentContext")
            break
        except NoConnectException:
            time.sleep(0.3)
    desktop = context.ServiceManager.createInstanceWithContext(
        "com.sun.star.frame.Desktop", context
    )
    json.dump([edit(desktop, *job) for job in json.load(sys.stdin)], sys.stdout)
    with contextlib.suppress(Exception):  # the bridge breaks when the office goes
        desktop.terminate()
    office.wait(30)


main(sys.argv[1])
