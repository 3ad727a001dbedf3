"""The parts of a workbook that has passed the intake, each unpacked once."""

from __future__ import annotations

import io
import zipfile

_KEPT = 64 * 2**20  # bytes of unpacked parts that are kept


class Package:
    """Parts of a zip by name."""

    def __init__(self, data: bytes) -> None:
        """Open a package.

        Raises:
            zipfile.BadZipFile: it is none.
        """
        self._archive = zipfile.ZipFile(io.BytesIO(data))
        self._parts: dict[str, bytes] = {}
        self._kept = 0

    def infos(self) -> list[zipfile.ZipInfo]:
        """All parts as the directory tells them."""
        return self._archive.infolist()

    def open(self, info: zipfile.ZipInfo) -> zipfile.ZipExtFile:
        """A part as a stream."""
        return self._archive.open(info)  # type: ignore[return-value]

    def keep(self, name: str, part: bytes) -> None:
        """Remember a part that was unpacked whole."""
        if self._kept + len(part) <= _KEPT:
            self._kept += len(part)
            self._parts[name] = part

    def read(self, name: str) -> bytes:
        """A part.

        Raises:
            KeyError: there is no such part.
        """
        found = self._parts.get(name)
        return self._archive.read(name) if found is None else found
