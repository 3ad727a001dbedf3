"""Atomic writing: a reader sees the old file or the new one, never half of one."""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from reports.errors import OutputError, Problem

_REASONS = {
    errno.EACCES: "нет прав",
    errno.EPERM: "нет прав",
    errno.EROFS: "диск доступен только для чтения",
    errno.ENOSPC: "на диске нет места",
    errno.EDQUOT: "превышена дисковая квота",
    errno.ENOTDIR: "часть пути — файл, а не папка",
    errno.EEXIST: "на этом месте уже есть файл",
    errno.EISDIR: "на этом месте уже есть папка",
    errno.ENAMETOOLONG: "слишком длинное имя",
    errno.ENOENT: "нет такого файла или папки",
}
_ADVICE = "укажите другое место ключом -o"


def write_text(path: Path, text: str) -> None:
    """Write text as UTF-8, line ends as they are, atomically.

    Raises:
        OutputError: The place cannot be written; the old file is untouched.
    """
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, data: bytes) -> None:
    """Write bytes atomically.

    Raises:
        OutputError: The place cannot be written; the old file is untouched.
    """
    with atomic_path(path) as temporary, _reported(path):
        temporary.write_bytes(data)


@contextmanager
def atomic_path(path: Path) -> Iterator[Path]:
    """Yield a temporary file beside `path` that replaces it when the block succeeds.

    Raises:
        OutputError: The place cannot be written; the old file is untouched.
    """
    make_dir(path.parent)
    if path.is_dir():
        raise _failure(path, IsADirectoryError(errno.EISDIR, ""))
    temporary = _temporary_file(path)
    try:
        yield temporary
        with _reported(path):
            _replace(temporary, path)
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink()


@contextmanager
def atomic_dir(path: Path) -> Iterator[Path]:
    """Yield a temporary folder beside `path` that replaces it when the block succeeds.

    Raises:
        OutputError: The place cannot be written; the old folder is untouched.
    """
    make_dir(path.parent)
    if path.exists() and not path.is_dir():
        raise _failure(path, FileExistsError(errno.EEXIST, ""))
    try:
        temporary = Path(tempfile.mkdtemp(prefix=".kshm-", dir=path.parent))
    except OSError as error:
        raise _failure(path, error) from None
    old = temporary.with_name(temporary.name + ".old")
    try:
        temporary.chmod(0o777 & ~_umask())
        yield temporary
        with _reported(path):
            _swap_dir(temporary, path, old)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)


def make_dir(path: Path) -> None:
    """Make a folder and its parents if they are missing.

    Raises:
        OutputError: It cannot be made or cannot be written.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _failure(path, error) from None
    if not os.access(path, os.W_OK | os.X_OK):
        raise _failure(path, PermissionError(errno.EACCES, ""))


def reason(error: OSError) -> str:
    """Return in Russian why the system refused."""
    return _REASONS.get(error.errno or 0, "ошибка ввода-вывода")


def _temporary_file(path: Path) -> Path:
    try:
        # The name's suffix is kept: some writers choose the format by it.
        handle, name = tempfile.mkstemp(prefix=".kshm-", suffix=path.suffix, dir=path.parent)
    except OSError as error:
        raise _failure(path, error) from None
    os.close(handle)
    temporary = Path(name)
    # mkstemp makes private files; a result is as readable as any other file.
    mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
    temporary.chmod(mode)
    return temporary


def _replace(temporary: Path, path: Path) -> None:
    with temporary.open("rb+") as stream:
        os.fsync(stream.fileno())
    temporary.replace(path)


def _swap_dir(temporary: Path, path: Path, old: Path) -> None:
    # os.replace refuses a target folder that is not empty.
    if path.exists():
        path.rename(old)
    try:
        temporary.rename(path)
    except OSError:
        if old.exists():
            old.rename(path)
        raise


@contextmanager
def _reported(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise _failure(path, error) from None


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _failure(path: Path, error: OSError) -> OutputError:
    text = reason(error)
    if isinstance(error, PermissionError) and os.name == "nt":
        text = "файл занят (закройте его в Excel) или нет прав"
    return OutputError(Problem(str(path), f"не удается записать: {text}", _ADVICE))
