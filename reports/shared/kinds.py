"""What a file from a person is, by its first bytes."""

from __future__ import annotations

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
    """The kind of a file; text is what has no sign of anything else."""
    for beginning, kind in _BEGINNINGS:
        if data.startswith(beginning):
            return kind
    return BINARY if b"\x00" in data else TEXT
