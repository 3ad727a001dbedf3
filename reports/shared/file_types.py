"""Files from people: what kind they are by their first bytes, and their bytes."""

from __future__ import annotations

from pathlib import Path

from reports.shared.errors import InputError, Problem
from reports.shared.files import no_file, reason

ARCHIVE, OFFICE, PDF, PACKED, UTF16, BINARY, TEXT = (
    "archive", "office", "pdf", "packed", "utf-16", "binary", "text",
)  # fmt: skip
CALLED = {
    ARCHIVE: "это книга Excel или архив",
    OFFICE: "это старый или зашифрованный документ Office",
    PDF: "это документ PDF",
    PACKED: "это архив RAR или 7z",
    BINARY: "двоичный файл",
}
_BEGINNINGS = (
    (b"PK\x03\x04", ARCHIVE),  # a book, too
    (b"\xd0\xcf\x11\xe0", OFFICE),  # before 2007, or encrypted
    (b"%PDF", PDF),
    (b"Rar!", PACKED),
    (b"7z\xbc\xaf", PACKED),
    (b"\xff\xfe", UTF16),
    (b"\xfe\xff", UTF16),
)


def kind_of(data: bytes) -> str:
    """Return the kind of a file; text is what has no sign of anything else."""
    for beginning, kind in _BEGINNINGS:
        if data.startswith(beginning):
            return kind
    return BINARY if b"\x00" in data else TEXT


def read_bytes(path: Path, most: int, hint: str) -> bytes:
    """Return the bytes of a file; ``hint`` tells of one that is larger than ``most``.

    Raises:
        InputError: it is too large, or cannot be read.
    """
    try:
        missing = no_file(path)
        data = b""
        if not missing:
            with path.open("rb") as stream:
                data = stream.read(most + 1)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        why = reason(error) if isinstance(error, OSError) else "недопустимое имя"
        problem = Problem(str(path), f"файл не читается: {why}", "проверьте имя и права")
        raise InputError(problem) from None
    if missing:
        raise InputError(Problem(str(path), missing, "проверьте имя и путь"))
    if len(data) > most:
        fault = f"файл больше {most // 10**6} МБ"
        raise InputError(Problem(path.name, fault, hint))
    return data
