"""What was handed in: files of a folder or of a zip as Moodle makes it, and of students' zips."""

from __future__ import annotations

import io
import re
import zipfile
import zlib
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import BinaryIO

from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import reason
from reports.workbook.intake import MAX_FILE

MAX_SUBMISSIONS = 5000
_MANY = 200  # files of a student's zip: it must not use up the batch
_UTF8 = 0x800  # the flag of a zip's member whose name is no code page's
_DAMAGED = (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError, ValueError)

# «Фамилия Имя_12345_assignsubmission_file_/книга.xlsx», in some versions without the folder.
_MOODLE = re.compile(r"(?P<name>[^/]+?)_(?P<id>\d+)_assignsubmission_file(?:_|/|$)")


@dataclass(frozen=True, slots=True)
class Submission:
    """One file handed in; ``members`` lead to it where it lies in a zip, or a zip in a zip."""

    key: str
    path: Path
    members: tuple[int, ...] | None
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
            with self.path.open("rb") as stream:
                if not self.members:
                    return stream.read(MAX_FILE + 1)
                data = _member(stream, self.members[0])
                for index in self.members[1:]:
                    data = _member(io.BytesIO(data), index)
                return data
        except OSError as error:
            what = f"файл не читается: {reason(error)}"
            raise InputError(Problem(self.label, what, "сдайте его ещё раз")) from None
        except _DAMAGED:
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
        found = _opened(_single(path, path.name), prefix="")
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
        made = _single(file, key)
        found += _opened(made, prefix=f"{key}/") if _is_zip(key) else [made]
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
        part.startswith((".", "~$")) or part.casefold() in ("__macosx", "thumbs.db", "desktop.ini")
        for part in key.split("/")
    )


def _opened(file: Submission, prefix: str) -> list[Submission]:
    """The files of a zip, and of the zips in it; anything else as it is."""
    try:
        with file.path.open("rb") as stream:
            found = _zip(file, stream, prefix)
    except (OSError, *_DAMAGED):
        found = []
    return found or [file]


def _zip(file: Submission, stream: BinaryIO, prefix: str, *, nested: bool = False
         ) -> list[Submission]:  # fmt: skip
    """Files of a zip that is no workbook.  The time in a student's own zip is his to choose."""
    found: list[Submission] = []
    keys: set[str] = set()
    with zipfile.ZipFile(stream) as archive:
        infos = archive.infolist()
        names = [_name(info) for info in infos]
        theirs = bool(prefix) and (bool(file.moodle_id) or not any(map(_moodle, names)))
        if any(name.startswith(("xl/", "_rels/")) for name in names) or (
            theirs and len(names) > _MANY
        ):
            return []
        for index, info in enumerate(infos):
            key = prefix + names[index]
            if info.is_dir() or _is_hidden(key):
                continue
            while key in keys:  # two members of one name are two submissions
                key += "′"
            keys.add(key)
            members = (*(file.members or ()), index)
            time = file.time if theirs else _time(info)
            made = Submission(key, file.path, members, time, **_moodle(key))
            inner: list[Submission] = []
            if not nested and _is_zip(key):
                try:
                    data = io.BytesIO(_member(stream, index))
                    inner = _zip(made, data, f"{key}/", nested=True)
                except _DAMAGED:
                    inner = []
            found += inner or [made]
    return found


def _is_zip(key: str) -> bool:
    return key.casefold().endswith(".zip")


def _member(stream: BinaryIO, index: int) -> bytes:
    with zipfile.ZipFile(stream) as archive, archive.open(archive.infolist()[index]) as member:
        return member.read(MAX_FILE + 1)


def _name(info: zipfile.ZipInfo) -> str:
    """The name of a member; without a flag it is of a Russian Windows, or of a Mac."""
    if info.flag_bits & _UTF8:
        return info.filename
    for encoding in ("utf-8", "cp866"):
        try:
            return info.filename.encode("cp437").decode(encoding)
        except ValueError:
            continue
    return info.filename


def _time(info: zipfile.ZipInfo) -> datetime | None:
    try:
        return datetime(*info.date_time)
    except ValueError:
        return None


def _moodle(key: str) -> dict[str, str]:
    match = _MOODLE.search(key)
    if match is None:
        return {}
    return {"moodle_id": match["id"], "moodle_name": match["name"]}
