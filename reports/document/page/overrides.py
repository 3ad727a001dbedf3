"""A folder of an institution's own templates: found, checked, its errors told by line."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from reports.shared import resources
from reports.shared.errors import InputError, Problem

KEY = "report.templates"
SUFFIX = ".j2"


def find(given: str, beside: Path) -> Path | None:
    """The folder named in the input, relative to the input file; ``None`` if none is named.

    Raises:
        InputError: no such folder, or nothing in it replaces a template.
    """
    if not given.strip():
        return None
    folder = (beside / given).resolve()
    try:
        names = sorted(path.name for path in folder.iterdir() if path.is_file())
    except OSError:
        what = f"нет папки {folder}"
        raise InputError(Problem(KEY, what, "укажите папку от файла исходных данных")) from None
    known = {path.name for path in (resources.templates_dir() / "report").glob(f"*{SUFFIX}")}
    given_names = [name for name in names if name.endswith(SUFFIX)]
    unknown = [name for name in given_names if name not in known]
    if unknown or not given_names:
        what = f"{folder}: {unknown[0]} ничего не заменяет" if unknown else f"{folder}: пусто"
        hint = "имена шаблонов: " + ", ".join(sorted(known))
        raise InputError(Problem(KEY, what, hint))
    return folder


@contextmanager
def told(folder: Path | None) -> Iterator[None]:
    """Turn what goes wrong in a replaced template into one line: file, line, error.

    Raises:
        InputError: the error lies in the folder's templates.
    """
    import jinja2

    from reports.document.page.template_words import in_russian

    try:
        yield
    except jinja2.TemplateSyntaxError as error:
        file = error.filename or error.name  # of a comment without end only the latter is known
        if folder is None or not _inside(file, folder):
            raise
        raise _problem(Path(str(file)), error.lineno, in_russian(error)) from error
    except Exception as error:
        place = _place(error, folder) if folder is not None else None
        if place is None:
            raise
        raise _problem(*place, in_russian(error)) from error


def style_error(folder: Path, warnings: str) -> InputError:
    """The style sheet or the markup of the folder's templates is not understood."""
    return InputError(Problem(str(folder), warnings, "исправьте шаблон или уберите его из папки"))


def _inside(name: str | None, folder: Path) -> bool:
    return name is not None and Path(name).resolve().is_relative_to(folder)


def _place(error: Exception, folder: Path) -> tuple[Path, int] | None:
    """The innermost line of the folder's templates on the way to the error."""
    if isinstance(error, UnicodeDecodeError):
        return _unreadable(folder)
    frames = traceback.extract_tb(error.__traceback__)
    hits = [frame for frame in frames if _inside(frame.filename, folder)]
    return (Path(hits[-1].filename), hits[-1].lineno or 0) if hits else None


def _unreadable(folder: Path) -> tuple[Path, int] | None:
    for path in sorted(folder.glob(f"*{SUFFIX}")):
        data = path.read_bytes()
        try:
            data.decode("utf-8")
        except UnicodeDecodeError as error:
            return path, data.count(b"\n", 0, error.start) + 1
    return None


def _problem(path: Path, line: int, message: str) -> InputError:
    where = f"{path}, строка {line}"
    return InputError(Problem(where, message, "исправьте шаблон или уберите его из папки"))
