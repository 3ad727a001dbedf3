"""Open a Word file in LibreOffice, renew fields and contents, save it as PDF, tell its counts.

Run by the system's Python, which has ``uno``: ``renewed.py PROFILE FILE PDF``.
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


def renew(desktop, source, target):
    address = Path(source).resolve().as_uri()
    document = desktop.loadComponentFromURL(address, "_blank", 0, (prop("Hidden", True),))
    document.getTextFields().refresh()
    for index in document.getDocumentIndexes():
        index.update()
    document.getTextFields().refresh()
    export = (prop("FilterName", "writer_pdf_Export"),)
    document.storeToURL(Path(target).resolve().as_uri(), export)
    counts = {
        "tables": document.getTextTables().getCount(),
        "pictures": document.getGraphicObjects().getCount(),
        "formulas": document.getEmbeddedObjects().getCount(),
    }
    document.close(True)
    return counts


def main(profile, source, target):
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
    print(json.dumps(renew(desktop, source, target)))
    with contextlib.suppress(Exception):  # the bridge breaks when the office goes
        desktop.terminate()
    office.wait(30)


main(*sys.argv[1:])
