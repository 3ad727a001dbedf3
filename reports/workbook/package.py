"""The parts of a workbook that has passed the intake, each unpacked once."""

from __future__ import annotations

import io
import struct
import zipfile
import zlib

_KEPT = 64 * 2**20  # bytes of unpacked parts that are kept
_SMALL = 2**20
_LOCAL = struct.Struct("<4s5H3I2H")  # header of a member; the two last are lengths behind it


class Package:
    """Parts of a zip by name."""

    def __init__(self, data: bytes) -> None:
        """Open a package.

        Raises:
            zipfile.BadZipFile: it is none.
        """
        self._data = data
        self._archive = zipfile.ZipFile(io.BytesIO(data))
        self._parts: dict[str, bytes] = {}
        self._kept = 0

    def infos(self) -> list[zipfile.ZipInfo]:
        """All parts as the directory tells them."""
        return self._archive.infolist()

    def open(self, info: zipfile.ZipInfo) -> zipfile.ZipExtFile:
        """A part as a stream."""
        return self._archive.open(info)  # type: ignore[return-value]

    def small(self, info: zipfile.ZipInfo) -> bytes | None:
        """A small part in which everything is as the directory tells; None where it is not.

        A workbook has more than a hundred parts: for those in order this takes a third of
        the time of a stream.
        """
        if info.compress_type != zipfile.ZIP_DEFLATED or info.flag_bits & 1:
            return None
        if max(info.file_size, info.compress_size) > _SMALL:
            return None
        try:
            header = _LOCAL.unpack_from(self._data, info.header_offset)
        except struct.error:
            return None
        start = info.header_offset + _LOCAL.size
        end = start + header[-2]
        name = info.orig_filename.encode("utf-8" if info.flag_bits & 0x800 else "cp437", "replace")
        if header[0] != b"PK\3\4" or self._data[start:end] != name:
            return None
        start = end + header[-1]
        reader = zlib.decompressobj(-zlib.MAX_WBITS)
        try:
            part = reader.decompress(
                self._data[start : start + info.compress_size], info.file_size + 1
            )
        except zlib.error:
            return None
        whole = reader.eof and not reader.unused_data and len(part) == info.file_size
        return part if whole and zlib.crc32(part) == info.CRC else None

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
