"""Atomic writing: a reader sees the old file or the new one, never half of one."""

from __future__ import annotations

import atexit
import contextlib
import errno
import json
import os
import secrets
import shutil
import signal
import stat
import sys
import tempfile
import time
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from reports.shared.errors import OutputError, Problem
from reports.shared.interrupt import check, held

_REASONS = {
    errno.EACCES: "нет прав",
    errno.EPERM: "нет прав",
    errno.EROFS: "диск доступен только для чтения",
    errno.ENOSPC: "на диске нет места",
    errno.EDQUOT: "превышена дисковая квота",
    errno.ENOTDIR: "часть пути — файл, а не папка",
    errno.EEXIST: "на этом месте уже есть файл",
    errno.EISDIR: "на этом месте уже есть папка",
    errno.EFBIG: "файл больше, чем разрешено",
    errno.ENAMETOOLONG: "слишком длинное имя",
    errno.ENOENT: "нет такого файла или папки",
    errno.ELOOP: "ссылки указывают друг на друга",
    errno.EPIPE: "читать с другой стороны некому",
    errno.ENXIO: "на другой стороне никого нет",
    errno.EBADF: "такого потока нет или он только для чтения",
    errno.EADDRINUSE: "порт занят",
}
_LINKS = 40  # as many as Linux follows
_ADVICE = "укажите другое место"
_HIDDEN, _OLD = ".kshm-", ".old"
_DAY_S = 86400.0
_looked_at: set[Path] = set()  # folders, once for each process
# Removed at the latest when the program ends: an interruption may come between two lines.
_unfinished: set[Path] = set()


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


def write_together(files: Mapping[Path, bytes]) -> None:
    """Write files, all or none of them.

    Raises:
        OutputError: a place cannot be written; the old files are untouched.
    """
    folders = {each for path in files for each in path.absolute().parents if not each.exists()}
    try:
        with contextlib.ExitStack() as all_of_them:
            for path, data in files.items():
                temporary = all_of_them.enter_context(atomic_path(path))
                with _reported(path):
                    temporary.write_bytes(data)
                    _sync(temporary)
            # What is on the disk by now only changes its name.
            with held(signal.SIGINT, signal.SIGTERM):
                all_of_them.close()
    except BaseException:
        for folder in sorted(folders, key=lambda each: -len(each.parts)):
            with contextlib.suppress(OSError):
                folder.rmdir()
        raise


def write_json(path: Path, data: Mapping[str, Any]) -> None:
    """Write plain data atomically; raises as `write_text`."""
    write_text(path, json.dumps(data, ensure_ascii=False))


def read_json(path: Path) -> dict[str, Any]:
    """Return what a file of `write_json` says, nothing if it is not there or damaged."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}


def write_zip(path: Path, files: Mapping[str, Path], more: Path | None = None) -> None:
    """Pack files by their names atomically, after what the archive ``more`` holds."""
    with atomic_path(path) as temporary:
        if more is not None and more.exists():
            shutil.copyfile(more, temporary)
        with zipfile.ZipFile(temporary, "a", zipfile.ZIP_DEFLATED) as archive:
            for name, file in files.items():
                archive.write(file, name)


@contextmanager
def atomic_path(path: Path) -> Iterator[Path]:
    """Yield a temporary file beside `path` that replaces it when the block succeeds.

    A link stays and its target is replaced.  What is no regular file, as a pipe or a device, stays
    too: it is written when the block has succeeded.

    Raises:
        OutputError: The place cannot be written; the old file is untouched.
    """
    target = None if is_stream(path) else _target(path)
    folder = Path(tempfile.gettempdir()) if target is None else target.parent
    if target is not None:
        make_dir(folder)
        if target.is_dir():
            raise _failure(path, IsADirectoryError(errno.EISDIR, ""))
    with _reported(path), _hidden(folder, path.suffix, target) as temporary:
        yield temporary
        check()
        if target is None:
            _copy(temporary, path)
        else:
            _replace(temporary, target)


def is_stream(path: Path) -> bool:
    """Whether a path is a pipe, a device or an open stream."""
    with contextlib.suppress(OSError):
        if _descriptor(path) is not None:
            return True
        mode = path.stat().st_mode
        return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))
    return False


def is_output(path: Path) -> bool:
    """Whether a path is stdout, by whatever name."""
    with contextlib.suppress(OSError, ValueError):
        return os.path.samestat(path.stat(), os.fstat(1))
    return False


@contextmanager
def atomic_dir(path: Path) -> Iterator[Path]:
    """Yield a temporary folder beside `path`, or a link's target, that replaces it in the end.

    Raises:
        OutputError: The place cannot be written; the old folder is untouched.
    """
    path = _target(path)
    make_dir(path.parent)
    if path.exists() and not path.is_dir():
        raise _failure(path, FileExistsError(errno.EEXIST, ""))
    with _reported(path), _hidden(path.parent) as temporary:
        old = temporary.with_name(temporary.name + _OLD)
        try:
            yield temporary
            check()
            _swap_dir(temporary, path, old)
        finally:
            if old.exists():
                _remove(old)


def refuse_own(outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Refuse to write over what is being read, by whatever name or link it is called.

    Raises:
        OutputError: an output is one of the inputs.
    """
    read = {target for path in inputs for target in _places(path)}
    for path in outputs:
        if read & _places(path):
            problem = "результат лёг бы поверх ваших исходных данных"
            raise OutputError(Problem(str(path), problem, _ADVICE))


def _places(path: Path) -> set[object]:
    """Identity of a file: resolved path and inode."""
    paths: set[object] = {os.path.realpath(path)}
    with contextlib.suppress(OSError):
        status = path.stat()
        paths.add((status.st_dev, status.st_ino))
    return paths


def no_file(path: Path) -> str:
    """Russian word for a path that is no readable file; empty for a file.

    Raises:
        OSError: the system does not let it be looked at.
        ValueError: it is no name at all.
    """
    try:
        mode = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return "файл не найден"
    for test, name in (
        (stat.S_ISDIR, "папка"),
        (stat.S_ISCHR, "устройство"),
        (stat.S_ISBLK, "устройство"),
        (stat.S_ISFIFO, "канал"),
        (stat.S_ISSOCK, "сокет"),
    ):
        if test(mode):
            return f"это {name}, а нужен файл"
    return ""


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
        reading_only = hasattr(os, "statvfs") and os.statvfs(path).f_flag & os.ST_RDONLY
        raise _failure(path, OSError(errno.EROFS if reading_only else errno.EACCES, ""))


def private_dir(path: Path, name: str) -> None:
    """Make a folder that nobody else may enter, from its first moment.

    One that stands open is closed if it is empty or holds a file called ``name``.

    Raises:
        OutputError: it cannot be made or written, or is open and holds what is not ours.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with contextlib.suppress(FileExistsError):
            path.mkdir(mode=0o700)
        if os.name != "nt" and path.is_dir() and path.stat().st_mode & 0o077:
            if any(path.iterdir()) and not (path / name).exists():
                problem = "папка открыта другим, и в ней чужие файлы"
                raise OutputError(
                    Problem(str(path), problem, "укажите новую папку или закройте эту")
                )
            path.chmod(0o700)
    except OSError as error:
        raise _failure(path, error) from None
    make_dir(path)


def reason(error: OSError) -> str:
    """Return in Russian why the system refused."""
    return _REASONS.get(error.errno or 0, "ошибка ввода-вывода")


def temporary_failure(error: Exception) -> OutputError:
    """Return the error of a temporary file that a library could not write."""
    number = error.errno if isinstance(error, OSError) else None
    code = number if number is not None else getattr(errno, str(error).removeprefix("IO_"), 0)
    text = "нет папки" if number == errno.ENOENT else _REASONS.get(code, "ошибка ввода-вывода")
    hint = "освободите место или укажите другую папку переменной TMPDIR"
    return OutputError(Problem("временные файлы", f"не удаётся записать: {text}", hint))


@contextmanager
def _hidden(folder: Path, suffix: str | None = None, like: Path | None = None) -> Iterator[Path]:
    """Make a hidden file, without a suffix a folder, locked as long as this process is at it."""
    _remove_abandoned(folder)
    while True:
        # The name's suffix is kept: some writers choose the format by it.
        temporary = _fresh_name(folder, suffix or "")
        _unfinished.add(temporary)
        lock = None
        try:
            if suffix is None:
                temporary.mkdir()
            else:
                _create(temporary, like)
            lock = _lock(temporary)
            if temporary.exists():  # else taken for abandoned before it was locked
                yield temporary
                return
        finally:
            if lock is not None:
                os.close(lock)
            _remove(temporary)


def _lock(path: Path) -> int | None:
    """Lock what is being written, where the system can; the lock ends with this process."""
    try:
        import fcntl

        handle = os.open(path, os.O_RDONLY)
    except (ImportError, OSError):  # Windows
        return None
    with contextlib.suppress(OSError):
        fcntl.flock(handle, fcntl.LOCK_EX)
    return handle


def _remove_unless_written(path: Path) -> None:
    """Remove what is hidden if nobody writes it any more: without locks, what is a day old.

    The lock is kept to the end: whoever takes it next sees that the path is gone.
    """
    try:
        import fcntl
    except ImportError:  # Windows
        if time.time() - path.stat().st_mtime > _DAY_S:
            _remove(path)
        return
    handle = os.open(path, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        _remove(path)
    finally:
        os.close(handle)


def _remove_abandoned(folder: Path) -> None:
    """Remove what commands that were killed have left in a folder."""
    if folder in _looked_at:
        return
    _looked_at.add(folder)
    hidden = {path.name: path for path in folder.glob(f"{_HIDDEN}*")}
    for name, path in hidden.items():
        # Killed while folders changed places: one of the two is all that there is.
        is_half = name + _OLD in hidden or name.removesuffix(_OLD) in hidden.keys() - {name}
        with contextlib.suppress(OSError):
            if not is_half and path not in _unfinished:
                _remove_unless_written(path)


def _fresh_name(folder: Path, suffix: str) -> Path:
    return folder / f"{_HIDDEN}{secrets.token_hex(8)}{suffix}"


def _target(path: Path) -> Path:
    """Where a chain of links ends; a path without links as it is given."""
    with _reported(path):
        if not path.is_symlink():
            return path
        with contextlib.suppress(FileNotFoundError):  # the target is still to be made
            path.stat()
        return Path(os.path.realpath(path))


def _descriptor(path: Path) -> int | None:
    """Return the number of this process's open stream that a path names, as /dev/stdout does.

    Opened by its name a stream that is a regular file would be written from its beginning, over
    what others have written into it.
    """
    names = {Path(name).resolve() for name in ("/dev/fd", "/proc/self/fd")}
    for _ in range(_LINKS):
        folder = path.parent.resolve()
        if folder in names and path.name.isdecimal():
            return int(path.name)
        if not path.is_symlink():
            break
        path = folder / path.readlink()
    return None


def _copy(temporary: Path, path: Path) -> None:
    """Write a finished file into what is no regular file."""
    number = _descriptor(path)
    if number == 1:
        sys.stdout.flush()
    # Neither created nor cut: what was there a moment ago stays what it is.
    handle = os.open(path, os.O_WRONLY) if number is None else os.dup(number)
    with os.fdopen(handle, "wb") as stream, temporary.open("rb") as source:
        shutil.copyfileobj(source, stream)


def _create(temporary: Path, like: Path | None) -> None:
    # As readable as any other file, or as the file that it replaces; what only passes, by none.
    mode = 0o600 if like is None else 0o666
    handle = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode)
    os.close(handle)
    if like is not None and like.exists():
        temporary.chmod(like.stat().st_mode & 0o777)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with contextlib.suppress(OSError):
            path.unlink()
    _unfinished.discard(path)


@atexit.register
def _remove_unfinished() -> None:
    for path in list(_unfinished):
        _remove(path)


def _sync(path: Path) -> None:
    with path.open("rb+") as stream:
        os.fsync(stream.fileno())


def _replace(temporary: Path, path: Path) -> None:
    _sync(temporary)
    temporary.replace(path)


def _swap_dir(temporary: Path, path: Path, old: Path) -> None:
    # os.replace refuses a target folder that is not empty; nothing may come between the two steps.
    with held(signal.SIGINT, signal.SIGTERM):
        if path.exists():
            path.rename(old)
        try:
            temporary.rename(path)
        except OSError:
            if old.exists():
                old.rename(path)
            raise
        _unfinished.add(old)


@contextmanager
def _reported(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        if isinstance(error, BrokenPipeError) and is_output(path):
            raise  # output as long as it was wanted
        raise _failure(path, error) from None


def _failure(path: Path, error: OSError) -> OutputError:
    text = reason(error)
    if isinstance(error, PermissionError) and os.name == "nt":
        text = "файл занят (закройте его в Excel) или нет прав"
    return OutputError(Problem(str(path), f"не удаётся записать: {text}", _ADVICE))
