"""What was handed in: a file, a folder of files, or the zip that Moodle makes of an assignment."""

from __future__ import annotations

import re
import zipfile
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import reason
from reports.workbook.intake import MAX_FILE

MAX_SUBMISSIONS = 5000

# «Фамилия Имя_12345_assignsubmission_file_/книга.xlsx», in some versions without the folder.
_MOODLE = re.compile(r"(?P<name>[^/]+?)_(?P<id>\d+)_assignsubmission_file(?:_|/|$)")


@dataclass(frozen=True, slots=True)
class Submission:
    """One file handed in; ``member`` where it lies in a zip."""

    key: str
    path: Path
    member: int | None
    time: datetime | None
    moodle_id: str = ""
    moodle_name: str = ""

    @property
    def label(self) -> str:
        """Name for messages."""
        return one_line(self.key, 160)

    def read(self) -> bytes:
        """The bytes, never more than one over the limit.

        Raises:
            InputError: the file cannot be read.
        """
        try:
            if self.member is None:
                with self.path.open("rb") as stream:
                    return stream.read(MAX_FILE + 1)
            with zipfile.ZipFile(self.path) as archive:
                info = archive.infolist()[self.member]
                with archive.open(info) as member:
                    return member.read(MAX_FILE + 1)
        except OSError as error:
            what = f"файл не читается: {reason(error)}"
            raise InputError(Problem(self.label, what, "сдайте его ещё раз")) from None
        except (zipfile.BadZipFile, EOFError, RuntimeError, NotImplementedError, ValueError):
            what = "файл в архиве повреждён или зашифрован"
            raise InputError(Problem(self.label, what, "сдайте его ещё раз")) from None


def collect(path: Path) -> list[Submission]:
    """All files handed in, in a fixed order.

    Raises:
        InputError: there is nothing there.
    """
    if path.is_dir():
        found = _folder(path)
    elif path.is_file():
        found = _zip(path) if _is_archive(path) else [_single(path, path.name)]
    else:
        raise InputError(Problem(str(path), "нет такого файла или папки", "проверьте путь"))
    if not found:
        hint = "положите в папку файлы студентов"
        raise InputError(Problem(str(path), "нет ни одной сданной работы", hint))
    if len(found) > MAX_SUBMISSIONS:
        what = f"больше {MAX_SUBMISSIONS} файлов"
        raise InputError(Problem(str(path), what, "проверьте, та ли это папка"))
    return sorted(found, key=lambda item: item.key)


def _folder(path: Path) -> list[Submission]:
    found = []
    for file in sorted(path.rglob("*")):
        key = file.relative_to(path).as_posix()
        if file.is_symlink() or not file.is_file() or _is_hidden(key):
            continue
        found.append(_single(file, key))
    return found


def _single(file: Path, key: str) -> Submission:
    try:
        time = datetime.fromtimestamp(int(file.stat().st_mtime))
    except OSError:
        time = None
    return Submission(key, file, None, time, **_moodle(key))


def _is_hidden(key: str) -> bool:
    """Names of the system's own files, of Excel's locks, and texts typed into Moodle."""
    return "_assignsubmission_onlinetext_" in key or any(
        part.startswith((".", "~$")) or part == "__MACOSX" for part in key.split("/")
    )


def _is_archive(path: Path) -> bool:
    """Whether this is a zip of files rather than a workbook."""
    try:
        with zipfile.ZipFile(path) as archive:
            return not any(name.startswith(("xl/", "_rels/")) for name in archive.namelist())
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError):
        return False


def _zip(path: Path) -> list[Submission]:
    found: list[Submission] = []
    keys: set[str] = set()
    with zipfile.ZipFile(path) as archive:
        for index, info in enumerate(archive.infolist()):
            key = info.filename
            if info.is_dir() or _is_hidden(key):
                continue
            while key in keys:  # two members of one name are two submissions
                key += "′"
            keys.add(key)
            try:
                time = datetime(*info.date_time)
            except ValueError:
                time = None
            found.append(Submission(key, path, index, time, **_moodle(key)))
    return found


def _moodle(key: str) -> dict[str, str]:
    match = _MOODLE.search(key)
    if match is None:
        return {}
    return {"moodle_id": match["id"], "moodle_name": match["name"]}
