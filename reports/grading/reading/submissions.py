"""Files handed in, as Moodle or a folder holds them, and their owners with the evidence."""

from __future__ import annotations

import io
import re
import zipfile
import zlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import BinaryIO

from reports.grading.issuing.handout import TICKET_NAME, TICKET_TITLE
from reports.grading.issuing.names import skeletons
from reports.grading.issuing.names import words as words_of
from reports.grading.issuing.register import PATTERN, Issued, Register
from reports.recalculation.grid import CellGrid
from reports.recalculation.sheets import parse_xml
from reports.shared.errors import BadBook, InputError, Problem, one_line
from reports.shared.files import reason
from reports.workbook.intake import LOCK, MAX_FILE, Package

MAX_SUBMISSIONS = 5000
_MANY = 200  # files of a student's zip: it must not use up the batch
_UTF8 = 0x800  # the flag of a zip's member whose name is no code page's
_DAMAGED = (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, NotImplementedError, ValueError)

# «Фамилия Имя_12345_assignsubmission_file_/книга.xlsx», in some versions without the folder.
_MOODLE = re.compile(r"(?P<name>[^/]+?)_(?P<id>\d+)_assignsubmission_file(?:_|/|$)")


MOODLE, ZIP, FILE_TIME = "moodle", "zip", "file"
CLOCKS = {MOODLE: "часы Moodle", ZIP: "время в архиве", FILE_TIME: "время файла"}
_NOBODYS = "нет идентификатора, имя файла не указывает на студента"
# What Moodle calls those whose names it hides from the grader.
_NAMELESS = re.compile(r"(участник|participant)[ _]?\d*", re.IGNORECASE)
Spelling = Callable[[str], set[str]]
_SURE = 4  # letters of a surname's skeleton that is no word by chance


@dataclass(frozen=True, slots=True)
class Submission:
    """One file handed in; ``members`` lead to it where it lies in a zip, or a zip in a zip.

    ``clock`` is what its time was taken from: Moodle's own zip, another one, the file.
    """

    key: str
    path: Path
    members: tuple[int, ...] | None
    time: datetime | None
    moodle_id: str = ""
    moodle_name: str = ""
    clock: str = FILE_TIME

    @property
    def label(self) -> str:
        """Name for messages."""
        return one_line(self.key, 160)

    def read(self) -> bytes:
        """Return the bytes, never more than one over the limit.

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
            problem = f"файл не читается: {reason(error)}"
            raise InputError(Problem(self.label, problem, "сдайте его ещё раз")) from None
        except _DAMAGED:
            problem = "файл в архиве повреждён или зашифрован"
            raise InputError(Problem(self.label, problem, "сдайте его ещё раз")) from None


def collect(path: Path) -> list[Submission]:
    """All files handed in, in a fixed order.

    Raises:
        InputError: there is nothing there.
    """
    if path.is_dir():
        files = _folder(path)
    elif path.is_file():
        files = _opened(_single(path, path.name), prefix="")
    else:
        raise InputError(Problem(str(path), "нет такого файла или папки", "проверьте путь"))
    files = _without_locks(files)
    if not files:
        hint = "положите в папку файлы студентов"
        raise InputError(Problem(str(path), "нет ни одной сданной работы", hint))
    if len(files) > MAX_SUBMISSIONS:
        problem = f"больше {MAX_SUBMISSIONS} файлов"
        raise InputError(Problem(str(path), problem, "проверьте, та ли это папка"))
    return sorted(files, key=lambda item: item.key)


def _folder(path: Path) -> list[Submission]:
    files = []
    for file in sorted(path.rglob("*")):
        key = file.relative_to(path).as_posix()
        if file.is_symlink() or not file.is_file() or _is_hidden(key):
            continue
        submission = _single(file, key)
        files += _opened(submission, prefix=f"{key}/") if _is_zip(key) else [submission]
    return files


def _single(file: Path, key: str) -> Submission:
    try:
        time = datetime.fromtimestamp(int(file.stat().st_mtime))
    except OSError:
        time = None
    return Submission(key, file, None, time, **_moodle(key))


def _is_hidden(key: str) -> bool:
    """Names of the system's own files, and texts typed into Moodle."""
    return "_assignsubmission_onlinetext_" in key or any(
        part.startswith(".") or part.casefold() in ("__macosx", "thumbs.db", "desktop.ini")
        for part in key.split("/")
    )


def _without_locks(files: Sequence[Submission]) -> list[Submission]:
    """Leave out Excel's lock files beside books; one alone was handed in for its book."""
    folder = {file.key: file.key.rpartition("/")[0] for file in files}
    locks = {key for key in folder if key.rpartition("/")[2].startswith(LOCK)}
    books = {at for key, at in folder.items() if key not in locks}
    return [file for file in files if file.key not in locks or folder[file.key] not in books]


def _opened(file: Submission, prefix: str) -> list[Submission]:
    """Return the files of a zip, and of the zips in it; anything else as it is."""
    try:
        with file.path.open("rb") as stream:
            files = _zip(file, stream, prefix)
    except (OSError, *_DAMAGED):
        files = []
    return files or [file]


def _zip(file: Submission, stream: BinaryIO, prefix: str, *, nested: bool = False
         ) -> list[Submission]:  # fmt: skip
    """Files of a zip that is no workbook.  The time in a student's own zip is his to choose."""
    files: list[Submission] = []
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
            named = _moodle(key)
            clock = file.clock if theirs else MOODLE if named else ZIP
            submission = Submission(key, file.path, members, time, **named, clock=clock)
            inner: list[Submission] = []
            if not nested and _is_zip(key):
                try:
                    data = io.BytesIO(_member(stream, index))
                    inner = _zip(submission, data, f"{key}/", nested=True)
                except _DAMAGED:
                    inner = []
            files += inner or [submission]
    return files


def _is_zip(key: str) -> bool:
    return key.casefold().endswith(".zip")


def _member(stream: BinaryIO, index: int) -> bytes:
    with zipfile.ZipFile(stream) as archive, archive.open(archive.infolist()[index]) as member:
        return member.read(MAX_FILE + 1)


def _name(info: zipfile.ZipInfo) -> str:
    """Return the name of a member; without a flag it is of a Russian Windows, or of a Mac."""
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


# --- owners --------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Match:
    """The issued work-book a file belongs to, why, and what speaks against it.

    ``submitter`` is the number of the other student under whose name the file came, 0 where
    several have that name.  While there are doubts, a person decides before any points are given.
    """

    book: Issued | None
    evidence: tuple[str, ...]
    doubts: tuple[str, ...]
    submitter: int | None = None


def find_owner(
    register: Register, submission: Submission, grid: CellGrid, package: Package
) -> Match:
    """Match a readable workbook with the register."""
    tickets = _tickets(grid, package)
    by_ticket = {book.ticket: book for book in register.books}
    matches = {text: where for text, where in tickets.items() if text in by_ticket}
    named, where = _by_name(register, submission)
    one = named[0] if len(named) == 1 else None
    submitter = one.number if one else None
    evidence = [f"идентификатор {text} ({where})" for text, where in matches.items()]
    left = {book.ticket: book.student.full for book in register.former}
    doubts = [
        f"идентификатор {text} ({where}) выдан тому, кого больше нет в списке: {left[text]}"
        if text in left
        else f"идентификатор {text} ({where}) не выдавался в этой группе"
        for text, where in tickets.items()
        if text not in by_ticket
    ]
    if len(matches) > 1:
        names = ", ".join(by_ticket[text].student.full for text in matches)
        text = f"в файле идентификаторы разных работ: {names}"
        return Match(None, tuple(evidence), (*doubts, text), submitter)
    if len(matches) == 1:
        book = by_ticket[next(iter(matches))]
        if named and book not in named:
            who = " или ".join(dict.fromkeys(other.student.full for other in named))
            issued = book.student.full
            doubts.append(f"файл сдал(а) {who} ({where}), а идентификатор выдан: {issued}")
            return Match(book, tuple(evidence), tuple(doubts), submitter or 0)
        if _is_stranger(register, submission):
            doubts.append(f"{where} — его нет в списке, а идентификатор выдан: {book.student.full}")
            return Match(book, tuple(evidence), tuple(doubts), 0)
        if one is not None:
            evidence.append(where)
        return Match(book, tuple(evidence), tuple(doubts))
    if one is None:
        text = (
            f"нет идентификатора; {where} — его нет в списке" if where and not named else _NOBODYS
        )
        return Match(None, (), (*doubts, text))
    if tickets:
        return Match(None, (where,), tuple(doubts), submitter)
    doubts.append("в файле нет идентификатора: это не выданная книга или он удалён")
    return Match(one, (f"идентификатора нет; {where}",), tuple(doubts))


def find_by_name(register: Register, submission: Submission) -> Match:
    """Match a file that cannot be read."""
    named, where = _by_name(register, submission)
    return Match(named[0], (where,), ()) if len(named) == 1 else Match(None, (), ())


def _tickets(grid: CellGrid, package: Package) -> dict[str, str]:
    """Return identifiers in a workbook → where they stand."""
    tickets: dict[str, str] = {}
    at = grid.names.get(TICKET_NAME.casefold())
    if at is not None:
        _take(tickets, grid.constant(*at), f"ячейка с именем {TICKET_NAME}")
    _take(tickets, own_properties(package).get(TICKET_NAME), "свойство файла")
    if not tickets:
        for columns in grid.sheets.values():
            for number, column in columns.items():
                for row, value in column.constants.items():
                    if isinstance(value, str) and value.strip() == TICKET_TITLE:
                        beside = columns.get(number + 1)
                        text = beside.constants.get(row) if beside is not None else None
                        _take(tickets, text, f"ячейка «{TICKET_TITLE}»")
    return tickets


def _take(tickets: dict[str, str], text: object, where: str) -> None:
    if isinstance(text, str) and PATTERN.fullmatch(text.strip()):
        tickets.setdefault(text.strip(), where)


def own_properties(package: Package) -> dict[str, str]:
    """Return custom properties of a workbook, written at issue, by name."""
    try:
        root = parse_xml(package.read("docProps/custom.xml"))
    except (KeyError, BadBook):
        return {}
    properties: dict[str, str] = {}
    for item in root.iter("{*}property"):
        properties.setdefault(str(item.get("name")), "".join(item.itertext()))
    return properties


def file_properties(package: Package) -> dict[str, str]:
    """Return authors and times of a workbook, as the file claims."""
    names = {"creator", "lastModifiedBy", "created", "modified"}
    try:
        root = parse_xml(package.read("docProps/core.xml"))
    except (KeyError, BadBook):
        return {}
    properties = {}
    for item in root:
        name = str(item.tag).rpartition("}")[2]
        if name in names and item.text:
            properties[name] = item.text.strip()[:100]
    return properties


def _by_name(register: Register, submission: Submission) -> tuple[list[Issued], str]:
    """Whose name stands in Moodle's folder, or else in the name of the file, and where.

    More than one are those that the name does not tell apart.
    """
    of_file = [book for book in register.books if book.folder in submission.key.split("/")]
    of_file = of_file or [
        book for book in register.books if book.file.removesuffix(".xlsx") in submission.key
    ]
    hits = _named(register, submission.moodle_name)
    if hits:  # a participant may hand in a file of another's; of namesakes its name tells which
        of_name = [book for book in hits if book in of_file]
        return of_name or hits, f"имя участника Moodle: «{submission.moodle_name[:120]}»"
    if _is_stranger(register, submission):  # whatever the name of his file says
        return [], f"имя участника Moodle: «{submission.moodle_name[:120]}»"
    hits = of_file or _named(register, submission.key)
    return hits, f"имя файла: «{submission.key[:120]}»" if hits else ""


def _is_stranger(register: Register, submission: Submission) -> bool:
    """Whether Moodle names a participant who is not on the roster."""
    name = submission.moodle_name
    return bool(name) and not _NAMELESS.fullmatch(name) and not _named(register, name)


def _named(register: Register, text: str) -> list[Issued]:
    """Those whose names stand in a text, or else their surnames, in whatever spelling."""
    for spelt, of in ((words_of(text), words_of), (skeletons(text), skeletons)):
        for name in (_names, _surname):
            hits = _standing_in(spelt, [(book, name(book, of)) for book in register.books])
            if hits:
                return hits
    return []


def _names(book: Issued, of: Spelling) -> set[str]:
    first, surname = of(book.student.name.split(" ")[0]), of(book.student.surname)
    return first | surname if first - surname else set()


def _surname(book: Issued, of: Spelling) -> set[str]:
    """Return words of a surname that is no word by chance: «И», «По», «Но» are surnames, too."""
    words, least = of(book.student.surname), 3 if of is words_of else _SURE
    return words if any(len(word) >= least for word in words) else set()


def _standing_in(words: set[str], names: Iterable[tuple[Issued, set[str]]]) -> list[Issued]:
    """Whose name stands among some words, and is no part of another that does."""
    hits = [(book, name) for book, name in names if name and name <= words]
    return [book for book, name in hits if not any(name < other for _, other in hits)]
