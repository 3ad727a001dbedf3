"""Whose file this is: by the identifier first, then by the names, with the evidence."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from reports.grading.issuing.handout import TICKET_NAME, TICKET_TITLE
from reports.grading.issuing.issue import latin
from reports.grading.issuing.register import Issued, Register
from reports.grading.issuing.ticket import PATTERN
from reports.grading.reading.submissions import Submission
from reports.recalculation.grid import BadBook, Grid
from reports.recalculation.sheets import parse_xml
from reports.workbook.package import Package

_NOBODYS = "нет идентификатора, имя файла не указывает на студента"
# What Moodle calls those whose names it hides from the grader.
_NAMELESS = re.compile(r"(участник|participant)[ _]?\d*", re.IGNORECASE)


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


def find_owner(register: Register, submission: Submission, grid: Grid, package: Package) -> Match:
    """Match a readable workbook with the register."""
    tickets = _tickets(grid, package)
    by_ticket = {book.ticket: book for book in register.books}
    known = {text: where for text, where in tickets.items() if text in by_ticket}
    named, where = _by_name(register, submission)
    one = named[0] if len(named) == 1 else None
    submitter = one.number if one else None
    evidence = [f"идентификатор {text} ({where})" for text, where in known.items()]
    doubts = [
        f"идентификатор {text} ({where}) не выдавался в этой группе"
        for text, where in tickets.items()
        if text not in by_ticket
    ]
    if len(known) > 1:
        names = ", ".join(by_ticket[text].student.full for text in known)
        text = f"в файле идентификаторы разных работ: {names}"
        return Match(None, tuple(evidence), (*doubts, text), submitter)
    if len(known) == 1:
        book = by_ticket[next(iter(known))]
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


def _tickets(grid: Grid, package: Package) -> dict[str, str]:
    """Identifiers in a workbook → where they stand."""
    found: dict[str, str] = {}
    at = grid.names.get(TICKET_NAME.casefold())
    if at is not None:
        _take(found, grid.constant(*at), f"ячейка с именем {TICKET_NAME}")
    _take(found, own_properties(package).get(TICKET_NAME), "свойство файла")
    if not found:
        for columns in grid.sheets.values():
            for number, column in columns.items():
                for row, value in column.constants.items():
                    if isinstance(value, str) and value.strip() == TICKET_TITLE:
                        beside = columns.get(number + 1)
                        text = beside.constants.get(row) if beside is not None else None
                        _take(found, text, f"ячейка «{TICKET_TITLE}»")
    return found


def _take(found: dict[str, str], text: object, where: str) -> None:
    if isinstance(text, str) and PATTERN.fullmatch(text.strip()):
        found.setdefault(text.strip(), where)


def own_properties(package: Package) -> dict[str, str]:
    """What ``kshm issue`` has written into the properties of a workbook, by name."""
    try:
        root = parse_xml(package.read("docProps/custom.xml"))
    except (KeyError, BadBook):
        return {}
    found: dict[str, str] = {}
    for item in root.iter("{*}property"):
        found.setdefault(str(item.get("name")), "".join(item.itertext()))
    return found


def file_properties(package: Package) -> dict[str, str]:
    """Who made and last saved a workbook, and when, as the file claims."""
    wanted = {"creator", "lastModifiedBy", "created", "modified"}
    try:
        root = parse_xml(package.read("docProps/core.xml"))
    except (KeyError, BadBook):
        return {}
    found = {}
    for item in root:
        name = str(item.tag).rpartition("}")[2]
        if name in wanted and item.text:
            found[name] = item.text.strip()[:100]
    return found


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
    """Those whose names stand in a text, or else their surnames."""
    words = _words(text)
    hits = _standing_in(words, [(book, _names(book)) for book in register.books])
    return hits or _standing_in(words, [(book, _surname(book)) for book in register.books])


def _names(book: Issued) -> set[str]:
    first, surname = _words(book.student.name.split(" ")[0]), _words(book.student.surname)
    return first | surname if first - surname else set()


def _surname(book: Issued) -> set[str]:
    """The words of a surname that is no word by chance: «И», «По», «Но» are surnames, too."""
    words = _words(book.student.surname)
    return words if any(len(word) > 2 for word in words) else set()


def _standing_in(words: set[str], names: Iterable[tuple[Issued, set[str]]]) -> list[Issued]:
    """Whose name stands among some words, and is no part of another that does."""
    found = [(book, name) for book, name in names if name and name <= words]
    return [book for book, name in found if not any(name < other for _, other in found)]


def _words(text: str) -> set[str]:
    """Words in Latin letters, so that Иванов is found in ivanov_kr.xlsx."""
    return set(filter(None, re.split(r"[\W\d_]+", latin(text))))
