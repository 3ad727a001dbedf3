"""Open a Word file in LibreOffice, renew fields and contents, save it as PDF, tell its counts.

Run by the system's Python, which has ``uno``: ``renewed.py PROFILE FILE PDF``.
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from office import desktop, prop


def renew(office, source, target):
    address = Path(source).resolve().as_uri()
    document = office.loadComponentFromURL(address, "_blank", 0, (prop("Hidden", True),))
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
    with desktop(profile) as office:
        print(json.dumps(renew(office, source, target)))


main(*sys.argv[1:])
