"""Check an uploaded workbook before any parser sees it."""

from __future__ import annotations

import io
import posixpath
import re
import struct
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import NoReturn

from reports.shared.errors import InputError, Problem
from reports.shared.file_types import ARCHIVE, CALLED, OFFICE, kind_of, read_bytes

_KEPT = 64 * 2**20  # bytes of unpacked parts that are kept
_TARGET = re.compile(rb"""(\b(?:Target|PartName)\s*=\s*["'])([^"']*)(["'])""")
# Parts that readers look for by these very names, whatever their case in a file.
_USUAL_NAMES = ("[Content_Types].xml", "_rels/.rels", "xl/workbook.xml", "xl/sharedStrings.xml",
                "xl/styles.xml", "xl/_rels/workbook.xml.rels")  # fmt: skip
_ENTRY, _LOCAL = 46, 30  # bytes before the name in the directory of a zip, and before a part
_BOOK, _TYPES = "xl/workbook.xml", "[Content_Types].xml"
_SHEET_TYPE = b"spreadsheetml.sheet.main+xml"
_STRICT = b"http://purl.oclc.org/ooxml/spreadsheetml/main"
_SAVE_AS = "откройте её в Excel или LibreOffice и сохраните как .xlsx: Файл → Сохранить как"
STRICT = (
    "книга сохранена в строгом формате Open XML",
    "сохраните её как обычную книгу Excel .xlsx: Файл → Сохранить как",
)
MAX_FILE = 30 * 10**6
MAX_UNPACKED = 300 * 2**20
MAX_PARTS = 2000
MAX_RATIO = 400
_HEAD = 4096
LOCK, _MAX_LOCK = "~$", 1024  # how Excel calls its lock files, and their bytes: 165
_WORD = b"word/document.xml"
_ENCRYPTED = "EncryptedPackage".encode("utf-16-le")
_OLD_BOOKS = tuple(f"{name}\0".encode("utf-16-le") for name in ("Workbook", "Book"))
# What may stand before the root element of a part: no DOCTYPE, whatever hides it from a look at
# the beginning (a long remark, another coding).
_ROOT = re.compile(
    rb"(?:\xef\xbb\xbf)?(?>\s|<\?(?>(?:(?!\?>).)*)\?>|<!--(?>(?:(?!-->).)*)-->)*+<[^!?\0]",
    re.DOTALL,
)
_CHUNK = 2**20
_DAMAGED = (
    zipfile.BadZipFile,
    zlib.error,
    EOFError,
    NotImplementedError,
    RuntimeError,
    ValueError,
    OSError,
    struct.error,
)


class Package:
    """Parts of a zip by name."""

    def __init__(self, data: bytes) -> None:
        """Open a package.

        Raises:
            zipfile.BadZipFile: it is none.
        """
        self._source = _as_named(data)
        self._archive = zipfile.ZipFile(io.BytesIO(self._source))
        self._parts: dict[str, bytes] = {}
        self._kept = 0
        self._mended: dict[str, bytes] = {}
        self._spelt = {name.casefold(): name for name in self._archive.namelist()}

    def infos(self) -> list[zipfile.ZipInfo]:
        """All parts as the directory tells them."""
        return self._archive.infolist()

    def names(self) -> list[str]:
        """Names of all parts."""
        return self._archive.namelist()

    def info(self, name: str) -> zipfile.ZipInfo:
        """Return what the directory tells of a part.

        Raises:
            KeyError: there is no such part.
        """
        return self._archive.getinfo(name)

    def open(self, info: zipfile.ZipInfo) -> zipfile.ZipExtFile:
        """Return a part as a stream."""
        return self._archive.open(info)  # type: ignore[return-value]

    @property
    def data(self) -> bytes:
        """The zip with the names and targets that other readers understand."""
        return repacked(self._source, self._mended) if self._mended else self._source

    def keep(self, name: str, part: bytes) -> None:
        """Remember a part that was unpacked whole."""
        if name == _TYPES or name.endswith(".rels"):
            mended = _TARGET.sub(lambda match: self._existing(name, match), part)
            if mended != part:
                part = self._mended[name] = mended
        if self._kept + len(part) <= _KEPT:
            self._kept += len(part)
            self._parts[name] = part

    def _existing(self, source: str, match: re.Match[bytes]) -> bytes:
        """Return a reference between parts with slashes, in the case of the part that it names."""
        target = match[2].decode("utf-8", "replace").replace("\\", "/")
        folder = "" if source == _TYPES else posixpath.dirname(posixpath.dirname(source))
        whole = posixpath.normpath(posixpath.join("/", folder, target))[1:]
        part = self._spelt.get(whole.casefold(), "")
        same = [
            one.casefold() == other.casefold()
            for one, other in zip(target[::-1], part[::-1], strict=False)
        ]
        tail = [*same, False].index(False)
        target = target[: len(target) - tail] + part[len(part) - tail :]
        return match[1] + target.encode() + match[3]

    def read(self, name: str) -> bytes:
        """Return a part.

        Raises:
            KeyError: there is no such part.
        """
        part = self._parts.get(name, self._mended.get(name))
        return self._archive.read(name) if part is None else part


def _as_named(data: bytes) -> bytes:
    """Return zip with slashes and the usual case in the names of its parts; nothing is unpacked."""
    usual = {name.casefold(): name for name in _USUAL_NAMES}
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        names = [info.orig_filename for info in archive.infolist()]
        at = archive.start_dir
    renamed = {}
    for name in names:
        slashed = name.replace("\\", "/")
        usually = usual.get(slashed.casefold(), slashed)
        if usually != name and usually not in names and name.isascii():
            renamed[name.encode()] = usually.encode()
    if not renamed:
        return data
    patched = bytearray(data)
    for _ in names:
        length, extra, comment = struct.unpack_from("<HHH", data, at + 28)
        entry = data[at + _ENTRY : at + _ENTRY + length]
        if entry in renamed:
            begin = struct.unpack_from("<I", data, at + 42)[0] + _LOCAL
            if data[begin : begin + length] == entry:
                patched[at + _ENTRY : at + _ENTRY + length] = renamed[entry]
                patched[begin : begin + length] = renamed[entry]
        at += _ENTRY + length + extra + comment
    return bytes(patched)


def repacked(data: bytes, changed: Mapping[str, bytes]) -> bytes:
    """Return a zip with some parts changed, the others as they were."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(data)) as source,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        for info in source.infolist():
            part = changed.get(info.filename)
            target.writestr(info, source.read(info) if part is None else part)
    return stream.getvalue()


def check_package(path: Path) -> bytes:
    """Bytes of a workbook that is safe to hand to a parser.

    Raises:
        InputError: not a workbook, encrypted, too large, with macros, external
            links, a DOCTYPE, or a package that unpacks out of proportion.
    """
    data = read_bytes(path, MAX_FILE, "это не книга kshm")
    check_data(data, path.name)
    return data


def check_data(data: bytes, name: str) -> Package:
    """Return the parts of a workbook that is safe to hand to a parser; ``name`` stands in messages.

    Raises:
        InputError: what ``check_package`` refuses.
    """
    if len(data) > MAX_FILE:
        _refuse(name, f"файл больше {MAX_FILE // 10**6} МБ", "это не книга kshm")
    if not data:
        _refuse(name, "файл пуст", "сохраните книгу заново")
    kind = kind_of(data)
    if len(data) <= _MAX_LOCK and LOCK in Path(name).name:
        problem = "это временный файл, который Excel держит рядом с открытой книгой"
        _refuse(name, problem, f"закройте книгу и возьмите файл без «{LOCK}» в имени")
    if kind == OFFICE:
        _refuse(name, *_old_or_locked(data))
    if kind != ARCHIVE:
        _refuse(name, f"{CALLED.get(kind, 'это текст')}, а не книга .xlsx", "нужна сама книга")
    try:
        package = Package(data)
        _check_parts(name, package)
    except InputError:
        raise
    except _DAMAGED:
        if _WORD in data:
            _refuse(name, "это повреждённый документ Word, а не книга .xlsx", "нужна сама книга")
        _refuse(name, "файл .xlsx повреждён", "сохраните его заново")
    return package


def _old_or_locked(data: bytes) -> tuple[str, str]:
    """Return what a file of the old Office container is, and what to do."""
    if _ENCRYPTED in data:
        return "книга закрыта паролем", "сохраните её без пароля: Файл → Сведения → Защита книги"
    if any(stream in data for stream in _OLD_BOOKS):
        return "книга в старом формате .xls", _SAVE_AS
    return "это старый или зашифрованный документ Office, а не книга .xlsx", "нужна сама книга"


def _check_parts(name: str, package: Package) -> None:
    infos = package.infos()
    names = package.names()
    if len(infos) > MAX_PARTS or len(set(names)) != len(names):
        _refuse(name, "в книге слишком много частей", "это не книга kshm")
    if _BOOK not in names:
        _refuse(name, *_other_kind(package, names))
    with package.open(package.info(_BOOK)) as stream:
        if _STRICT in stream.read(_HEAD):
            _refuse(name, *STRICT)
    if any(name.lower().endswith(("vbaproject.bin", ".exe", ".dll")) for name in names):
        _refuse(name, "в книге есть макросы", "сохраните её как .xlsx без макросов")
    if any("externallinks/" in name.lower() for name in names):
        _refuse(name, "книга ссылается на другие файлы", "разорвите связи и сохраните")
    total = 0
    for info in infos:
        part, size = _unpacked(name, package, info, total)
        total += size
        if size > _CHUNK and size > MAX_RATIO * max(1, info.compress_size):
            _refuse(name, "книга распаковывается сверх меры", "это не книга kshm")
        if info.filename.endswith((".xml", ".rels")):
            if not _ROOT.match(part[:_HEAD]):
                if b"<!DOCTYPE" in part[:_HEAD]:
                    _refuse(name, "в книге есть объявление DOCTYPE", "это не книга Excel")
                problem = f"часть {info.filename} начинается не так, как пишут программы таблиц"
                _refuse(name, problem, "сохраните книгу заново в Excel или LibreOffice")
            if size == len(part):
                package.keep(info.filename, part)


def _other_kind(package: Package, names: list[str]) -> tuple[str, str]:
    """Return what a package without the usual workbook part is, and what to do."""
    if "content.xml" in names:
        return "это книга .ods", _SAVE_AS
    if "xl/workbook.bin" in names:
        return "это двоичная книга .xlsb", _SAVE_AS
    if any(part.startswith("Index/") or part == "Index.zip" for part in names):
        return "это документ Numbers", "выгрузите его: Файл → Экспортировать в → Excel"
    if _TYPES in names:
        with package.open(package.info(_TYPES)) as stream:
            if _SHEET_TYPE in stream.read(_CHUNK):
                return "части книги названы не так, как пишет Excel", _SAVE_AS
    return "это архив или документ, а не книга .xlsx", "нужна сама книга"


def _unpacked(name: str, package: Package, info: zipfile.ZipInfo, total: int) -> tuple[bytes, int]:
    """Beginning of a part and its whole size."""
    with package.open(info) as stream:
        # The directory may lie about sizes: count what really comes out.
        part = chunk = stream.read(_CHUNK)
        size = len(part)
        while chunk:
            if total + size > MAX_UNPACKED:
                _refuse(name, "книга распаковывается сверх меры", "это не книга kshm")
            chunk = stream.read(_CHUNK)
            size += len(chunk)
    return part, size


def _refuse(name: str, problem: str, hint: str) -> NoReturn:
    raise InputError(Problem(name, problem, hint))
