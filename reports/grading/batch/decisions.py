"""A person's word on a work: kept beside the results, stronger than the program's."""

from __future__ import annotations

import copy
import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Any

from reports.grading.issuing.register import Issued, Register
from reports.grading.judging.judgement import UNKNOWN, unread_remark
from reports.grading.judging.scoring import rescored
from reports.grading.judging.works import Work
from reports.grading.pages.gradebook import DECISION, GROUPS, OF_FILE
from reports.grading.pages.groups import NAME, WaitingGroup
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import write_text

FILE = "decisions.json"
WHOLE = ""  # in the place of an item: the whole work
ACCEPT, WITHDRAW = "+", "-"  # in the place of points
_MOST = 500  # signs of a remark
_WHOLE_WORDS = ("", "-", "всё", "все", "работа", "*")
_ANOTHER = "после решения преподавателя сдан другой файл: решите о нём заново"
_ANOTHER_COLUMN = "после решения преподавателя сдан другой файл, решите заново о столбцах: "
_SHEET = "Оценки"


@dataclass(frozen=True, slots=True)
class Decision:
    """Points for an item or a whole work; None accepts the points of the program.

    ``file`` is the SHA-256 of the work: what is handed in later has not been looked at.
    """

    number: int
    item: str
    points: float | None
    remark: str
    author: str
    date: str
    file: str = ""

    @property
    def key(self) -> tuple[int, str, str]:
        """Subject of the decision."""
        return self.number, self.item, self.file


def load_decisions(folder: Path) -> list[Decision]:
    """Decisions of a folder of results.

    Raises:
        InputError: the file is damaged: a person's word is never dropped silently.
    """
    path = folder / FILE
    if not path.exists():
        return []
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return [Decision(**entry) for entry in data["decisions"]]
    except (OSError, ValueError, TypeError, KeyError):
        what = "файл решений преподавателя повреждён"
        raise InputError(Problem(str(path), what, "верните его копию или удалите его")) from None


def save_decisions(folder: Path, decisions: Sequence[Decision]) -> None:
    """Write the decisions of a folder."""
    ordered = sorted(decisions, key=lambda entry: entry.key)
    data = {"format": "kshm-decisions", "decisions": [asdict(entry) for entry in ordered]}
    write_text(folder / FILE, json.dumps(data, ensure_ascii=False, indent=1) + "\n")


def refuse_too_many(decisions: Sequence[Decision], register: Register) -> None:
    """Refuse to go on with points that are more than a work can get now.

    Raises:
        InputError: there are such decisions.
    """
    maximum = register.rubric.maximum
    names = {book.number: book.student.full for book in register.books}
    problems = [
        Problem(
            names.get(entry.number, str(entry.number)),
            f"решение преподавателя — {entry.points:g} при наибольшем балле {maximum:g}",
            f"решите заново с прежней рубрикой: --decide {entry.number} {entry.item or 'всё'} …",
        )
        for entry in decisions
        if entry.points is not None and entry.points > maximum
    ]
    if problems:
        raise InputError(problems)


def refuse_wrong_words(
    words: Sequence[tuple[str, str, str, str]], register: Register, files: Collection[str],
    items: Collection[str],
) -> None:  # fmt: skip
    """Refuse what no work makes a decision: before hours of grading, and before a file is written.

    Raises:
        InputError: no such student, file or item, or points that are none.
    """
    for who, what, points, _ in words:
        if NAME.fullmatch(who):
            continue
        if who not in files:
            _student(register, (), who)
        item = _item(what, items)
        if item and points.strip().endswith("%"):
            _points(_of_share(points, register.rubric.maximum), register.rubric.maximum)
        elif points.strip() not in (ACCEPT, WITHDRAW):
            _points(points, register.rubric.maximum)


def of_groups(
    words: Sequence[tuple[str, str, str, str]], groups: Sequence[WaitingGroup]
) -> list[tuple[str, str, str, str]]:
    """The words of a command with those about a group said of each of its works.

    Points may be a share: «50%» of what the group is about.

    Raises:
        InputError: no such group waits.
    """
    by_name = {group.name: group for group in groups}
    said = []
    for who, what, points, remark in words:
        if not NAME.fullmatch(who):
            said.append((who, what, points, remark))
            continue
        group = by_name.get(who)
        if group is None:
            hint = "имена групп — на странице группы и на листе «Решения» ведомости"
            raise InputError(Problem(who, "такая группа работ не ждёт решения", hint))
        value = _of_share(points, group.of)
        said += [(str(n), group.item or "всё", value, remark) for n in group.numbers]
    return said


def _of_share(points: str, of: float) -> str:
    text = points.strip().replace(",", ".")
    try:
        return f"{float(text[:-1]) / 100 * of:.6g}" if text.endswith("%") else points
    except ValueError:
        return points


def _item(what: str, known: Collection[str]) -> str:
    item = WHOLE if what.strip().casefold() in _WHOLE_WORDS else what.strip()
    if item and item not in known:
        hint = "имена столбцов — на странице студента в results/*.json: P3_1.s_mm"
        raise InputError(Problem(item, "в работе нет такого столбца", hint))
    return item


def decided(
    kept: Sequence[Decision], register: Register, works: Sequence[Work],
    counted: Mapping[int, Work], words: Sequence[tuple[str, str, str, str]], author: str,
) -> list[Decision]:  # fmt: skip
    """Decisions with those of a command added: who, what, points, remark.

    They are about the files that are ``counted``.

    Raises:
        InputError: no such student or item, or points that are none.
    """
    entries = {entry.key: entry for entry in kept}
    for who, what, points, remark in words:
        book = _student(register, works, who)
        known = {line.id for work in works if work.number == book.number for line in work.items}
        item = _item(what, known)
        if points.strip() == WITHDRAW:
            entries = {
                key: entry for key, entry in entries.items() if key[:2] != (book.number, item)
            }
            continue
        work = counted.get(book.number)
        of = next((line.of for line in work.items if line.id == item), None) if work else None
        given = points if of is None else _of_share(points, of)
        value = None if points.strip() == ACCEPT else _points(given, register.rubric.maximum)
        file = work.sha256 if work else ""
        _refuse_idle(who, value, item, file, work)
        entry = Decision(
            book.number, item, value, one_line(remark, _MOST), one_line(author, 100),
            datetime.now().isoformat(timespec="minutes"), file,
        )  # fmt: skip
        entries[entry.key] = entry
    return list(entries.values())


def _points(text: str, maximum: float) -> float:
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        value = -1.0
    if not 0 <= value <= maximum:
        hint = f"нужно число от 0 до {maximum:g}, «+» — принять баллы программы, «-» — отменить"
        raise InputError(Problem(text or "баллы", "это не баллы", hint))
    return value


def _refuse_idle(who: str, value: float | None, item: str, file: str, work: Work | None) -> None:
    """Refuse a word that would change nothing: of no file, or accepting no points."""
    if not file:
        hint = "поставьте эти баллы сами там, куда переносите ведомость"
        raise InputError(Problem(who, "работа не сдана: решать не о чем", hint))
    if value is None and item == WHOLE and work and work.sha256 == file and work.points is None:
        what = "у файла нет баллов программы: принять нечего"
        raise InputError(Problem(who, what, "впишите баллы числом"))


def _student(register: Register, works: Sequence[Work], who: str) -> Issued:
    wanted = who.strip().casefold()
    hits = [
        book
        for book in register.books
        if wanted in (str(book.number), book.student.full.casefold(), book.folder.casefold())
    ]
    hits = hits or [b for b in register.books if b.student.surname.casefold() == wanted]
    if not hits:
        numbers = {work.number for work in works if who in (work.file, work.key)}
        hits = [book for book in register.books if book.number in numbers]
    if len(hits) != 1:
        what = "таких студентов несколько" if hits else "нет такого студента"
        raise InputError(Problem(who, what, "назовите номер варианта или фамилию с именем"))
    return hits[0]


def from_gradebook(
    path: Path, kept: Sequence[Decision], counted: Mapping[int, Work], maximum: float
) -> list[Decision]:
    """Decisions with those that a person has written into the gradebook.

    They are about the files that it tells of, whatever is ``counted`` since.

    Raises:
        InputError: what is written there is no decision.
    """
    lines, author, date = _lines(path)
    if not lines or any(head not in lines[0] for head in ("Вариант", *DECISION)):
        return list(kept)
    number_at, points_at, remark_at = (lines[0].index(head) for head in ("Вариант", *DECISION))
    file_at = lines[0].index(OF_FILE) if OF_FILE in lines[0] else None
    entries = {entry.key: entry for entry in kept}
    problems: list[Problem] = []
    for row, line in enumerate(lines[1:], 2):
        number, points = line[number_at], str("" if line[points_at] is None else line[points_at])
        text = one_line(str(line[remark_at] or ""), _MOST)
        if not isinstance(number, (int, float)):
            if points.strip():
                hint = "назовите файл фамилией студента и проверьте ещё раз"
                where = f"{path.name}, строка {row}"
                problems.append(Problem(where, "решение о файле без владельца", hint))
            continue
        work = counted.get(int(number))
        file = work.sha256 if work is not None else ""
        key = int(number), WHOLE, file if file_at is None else str(line[file_at] or "")
        earlier = entries.get(key)
        if not points.strip():
            if earlier is not None and not text:  # taken out by hand
                del entries[key]
            continue
        try:
            value = None if points.strip() == ACCEPT else _points(points, maximum)
            _refuse_idle("", value, *key[1:], work)
        except InputError as error:
            where = f"{path.name}, строка {row}: «{one_line(points, 40)}»"
            problems += [replace(problem, where=where) for problem in error.problems]
            continue
        if earlier is None or (earlier.points, earlier.remark) != (value, text):
            entries[key] = Decision(*key[:2], value, text, one_line(author, 100), date, key[2])
    if problems:
        raise InputError(problems)
    return list(entries.values())


def words_of_groups(path: Path) -> tuple[list[tuple[str, str, str, str]], str]:
    """Decisions on groups that a person has written into the gradebook, and who saved it."""
    lines, author, _ = _lines(path, GROUPS)
    if not lines or any(head not in lines[0] for head in ("Группа", *DECISION)):
        return [], author
    at = [lines[0].index(head) for head in ("Группа", *DECISION)]
    rows = [[str("" if line[i] is None else line[i]).strip() for i in at] for line in lines[1:]]
    return [(name, "", points, remark) for name, points, remark in rows if points], author


def _lines(path: Path, title: str = _SHEET) -> tuple[list[tuple[Any, ...]], str, str]:
    """Rows of a gradebook, who saved it and when; none where there is no such book."""
    from openpyxl import load_workbook

    if not path.exists():
        return [], "", ""
    try:
        book = load_workbook(path, read_only=True, data_only=True)
        if title == _SHEET and title not in book.sheetnames:
            title = book.sheetnames[0]
        if title not in book.sheetnames:
            return [], "", ""
        sheet = book[title]
        lines = list(sheet.iter_rows(values_only=True))
        author = book.properties.lastModifiedBy or "ведомость"
        date = datetime.fromtimestamp(int(path.stat().st_mtime)).isoformat(timespec="minutes")
        book.close()
    except Exception:  # a gradebook that someone has broken is written anew
        return [], "", ""
    return lines, author, date


def applied(result: dict[str, Any], decisions: Sequence[Decision]) -> dict[str, Any]:
    """A result as the person has decided on its file; without such decisions the same."""
    own = _of(result, decisions)
    if not own:
        return result
    decided_result = copy.deepcopy(result)
    decided_result["decisions"] = [asdict(entry) for entry in own]
    lines = {line["id"]: line for line in decided_result["items"]}
    settled = set()
    for entry in own:
        line = lines.get(entry.item)
        if line is not None:
            if entry.points is not None:
                line["points"] = entry.points
            line["decision"] = asdict(entry)
            settled.add(entry.item)
    if decided_result["status"] == "graded":
        rescored(decided_result)
    whole = next((entry for entry in own if entry.item == WHOLE), None)
    open_ = [i for i, line in lines.items() if line["verdict"] == UNKNOWN and i not in settled]
    if whole is not None:
        decided_result["decision"] = asdict(whole)
        if whole.points is not None:
            decided_result["points"] = whole.points
        decided_result["manual"], decided_result["doubts"] = [], []
    elif not open_:
        unread = unread_remark([e["label"] for e in lines.values() if e["verdict"] == UNKNOWN])
        decided_result["manual"] = [text for text in decided_result["manual"] if text != unread]
    return decided_result


def waiting(result: dict[str, Any], decisions: Sequence[Decision]) -> dict[str, Any]:
    """The result that counts: it waits for a person where another file was decided on."""
    own = {entry.item for entry in _of(result, decisions)}
    former = {entry.item for entry in decisions if entry.number == result["number"]} - own
    if WHOLE in own or not former:
        return result
    held = copy.deepcopy(result)
    if WHOLE in former:
        held["manual"].append(_ANOTHER)
        held["doubts"].append(_ANOTHER)
    labels = [line["label"] for line in held["items"] if line["id"] in former]
    if labels:
        held["manual"].append(_ANOTHER_COLUMN + ", ".join(labels[:8]))
    return held


def _of(result: dict[str, Any], decisions: Sequence[Decision]) -> list[Decision]:
    about = result.get("number"), result["sha256"]
    return [entry for entry in decisions if (entry.number, entry.file) == about]
