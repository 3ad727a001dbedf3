"""A file from a person read as bytes: all of it, or one line on why not."""

from __future__ import annotations

from pathlib import Path

from reports.shared.errors import InputError, Problem
from reports.shared.files import no_file, reason


def read_bytes(path: Path, most: int, hint: str) -> bytes:
    """The bytes of a file; ``hint`` tells of one that is larger than ``most``.

    Raises:
        InputError: it is too large, or cannot be read.
    """
    try:
        what = no_file(path)
        if what:
            raise InputError(Problem(str(path), what, "проверьте имя и путь"))
        with path.open("rb") as stream:
            data = stream.read(most + 1)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        why = reason(error) if isinstance(error, OSError) else "недопустимое имя"
        problem = Problem(str(path), f"файл не читается: {why}", "проверьте имя и права")
        raise InputError(problem) from None
    if len(data) > most:
        what = f"файл больше {most // 10**6} МБ"
        raise InputError(Problem(path.name, what, hint))
    return data
