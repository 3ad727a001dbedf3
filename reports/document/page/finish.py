"""What a finished PDF is told that the page's HTML cannot say."""

from __future__ import annotations

from typing import Any

from reports.document.text.texts import FORMULA

_TYPES = {".toml": "application/toml"}  # that Python's list of media types lacks


def finish(pdf: Any) -> None:  # noqa: ANN401
    """Formulas and headings of columns tagged as such; attachments named once, with their types."""
    for item in pdf.objects:
        if isinstance(item, dict) and item.get("Type") == "/StructElem":
            _tagged(item)
        elif isinstance(item, dict) and item.get("Type") == "/Filespec":
            _typed(pdf, item)
    if "AF" in pdf.catalog:
        pdf.catalog["AF"][:] = dict.fromkeys(pdf.catalog["AF"])


def _tagged(element: dict[str, Any]) -> None:
    words = element.get("Alt")
    if words is not None and words.string.startswith(FORMULA):
        words.string = words.string.removeprefix(FORMULA)
        element["S"] = "/Formula"
    elif element.get("S") == "/TH":
        element["A"]["Scope"] = "/Column"


def _typed(pdf: Any, file: dict[str, Any]) -> None:  # noqa: ANN401
    for ending, media in _TYPES.items():
        if file["UF"].string.endswith(ending):
            stream = pdf.objects[int(file["EF"]["F"].split()[0])]
            stream.extra["Subtype"] = f"/{media.replace('/', '#2f')}"
