"""What a finished PDF is told that the page's HTML cannot say."""

from __future__ import annotations

from typing import Any

import pydyf

from reports.document.text.texts import FORMULA

_TYPES = {".toml": "application/toml"}  # that Python's list of media types lacks


def finish(pdf: Any) -> None:  # noqa: ANN401
    """Formulas and headings of columns tagged as such; attachments named once, with their types.

    Then each object is written: pydyf asks for its bytes twice, in the end for a hash.
    """
    for item in pdf.objects:
        if isinstance(item, dict) and item.get("Type") == "/StructElem":
            _tagged(item)
        elif isinstance(item, dict) and item.get("Type") == "/Filespec":
            _typed(pdf, item)
    if "AF" in pdf.catalog:
        pdf.catalog["AF"][:] = dict.fromkeys(pdf.catalog["AF"])
    for number, item in enumerate(pdf.objects[1:], 1):  # one by one: each takes room
        pdf.objects[number] = (_Stream if isinstance(item, pydyf.Stream) else _Object)(item)


class _Written:
    """An object of the file with its bytes."""

    data = b""

    def __init__(self, made: pydyf.Object) -> None:
        super().__init__()
        self.number, self.generation, self.free = made.number, made.generation, made.free
        self.data = made.data


class _Object(_Written, pydyf.Object):  # type: ignore[misc]
    """Anything but a stream."""


class _Stream(_Written, pydyf.Stream):  # type: ignore[misc]
    """A stream, which stands alone in the file."""


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
