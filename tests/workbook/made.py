"""One finished workbook for the tests of this folder."""

from __future__ import annotations

import io
import zipfile
from functools import lru_cache

from reports.tables.registry import build_model
from reports.tables.spec import Model
from reports.workbook.write import workbook_bytes
from tests.conftest import sample


@lru_cache(maxsize=4)
def model(name: str = "gots-diesel") -> Model:
    return build_model(sample(name))


@lru_cache(maxsize=4)
def book(name: str = "gots-diesel") -> bytes:
    return workbook_bytes(model(name))


def parts(prefix: str, name: str = "gots-diesel") -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(book(name))) as archive:
        return {part: archive.read(part) for part in archive.namelist() if part.startswith(prefix)}
