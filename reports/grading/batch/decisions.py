"""A person's word on a work: kept beside the results, stronger than the program's."""

from __future__ import annotations

import copy
import json
import math
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Any

from reports.grading.batch.awards import ACCEPT, WITHDRAW, Award, award_of
from reports.grading.batch.requests import mark_of, request_remark
from reports.grading.issuing.register import Issued, Register
from reports.grading.issuing.rubric import Rubric
from reports.grading.judging.judgement import PART, UNKNOWN, part_remark, unread_remark
from reports.grading.judging.scoring import rescored
from reports.grading.judging.work_digest import Work
from reports.grading.pages.gradebook import DECIDED, DECISION, GROUPS, OF_FILE
from reports.grading.pages.groups import NAME, WaitingGroup
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import write_text

FILE = "decisions.json"
WHOLE = ""  # in the place of an item: the whole work
_LONGEST = 500  # signs of a remark
_WHOLE_WORDS = ("", "-", "всё", "все", "работа", "*")
_ANOTHER = "после решения преподавателя сдан другой файл: решите о нём заново"
_ANOTHER_COLUMN = "после решения преподавателя сдан другой файл, решите заново о столбцах: "
_SHEET = "Оценки"
_PLAIN_TEXT = re.compile(r'"[^"]*"|\\.')  # of a format: signs that mean themselves
_ANY = Rubric(maximum=1e9)  # words are held to the rubric when they are taken in


@dataclass(frozen=True, slots=True)
class Decision:
    """Points for an item or a whole work; None accepts the points of the program.

    ``file`` is the SHA-256 of the work: what is handed in later has not been looked at.  ``word``
    is a change of the program's points (×0,75), ``group`` whom it was said of together.
    """

    number: int
    item: str
    points: float | None
    remark: str
    author: str
    date: str
    file: str = ""
    word: str = ""
    group: str = ""

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
        problem = "файл решений преподавателя повреждён"
        raise InputError(Problem(str(path), problem, "верните его копию или удалите его")) from None


def save_decisions(folder: Path, decisions: Sequence[Decision]) -> None:
    """Write the decisions of a folder."""
    ordered = sorted(decisions, key=lambda entry: entry.key)
    data = {"format": "kshm-decisions", "decisions": [asdict(entry) for entry in ordered]}
    write_text(folder / FILE, json.dumps(data, ensure_ascii=False, indent=1) + "\n")


def refuse_too_many(decisions: Sequence[Decision], register: Register) -> None:
    """Raise InputError where points exceed the maximum.

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
    """Validate decisions before grading starts.

    Raises:
        InputError: no such student, file or item, or points that are none.
    """
    for who, decision, points, _ in words:
        if NAME.fullmatch(who):
            continue
        if who not in files:
            student_of(register, (), who)
        _item(decision, items)
        if points.strip() != WITHDRAW:
            award_of(points, register.rubric, 1.0)


@dataclass(frozen=True, slots=True)
class Spoken:
    """Words of a person on one work; ``group`` where they are about several together."""

    who: str
    what: str
    points: str
    remark: str
    group: str = ""


def of_groups(
    words: Sequence[tuple[str, str, str, str]], groups: Sequence[WaitingGroup],
    earlier: Sequence[Decision] = (), *, anew: bool = False,
) -> list[Spoken]:  # fmt: skip
    """Expand a decision on a group into one per work.

    What was decided on together can be taken back; ``anew``: or decided otherwise.

    Raises:
        InputError: there is no such group.
    """
    waiting_ones = {group.name: [(str(n), group.item) for n in group.numbers] for group in groups}
    decided_ones: dict[str, list[tuple[str, str]]] = {}
    for entry in earlier:
        if entry.group:
            decided_ones.setdefault(entry.group, []).append((str(entry.number), entry.item))
    spoken = []
    for who, decision, points, remark in words:
        if not NAME.fullmatch(who):
            spoken.append(Spoken(who, decision, points, remark))
            continue
        is_taken_back = points.strip() == WITHDRAW
        members = [*waiting_ones.get(who, ())]
        if is_taken_back or (anew and not members):
            members += decided_ones.get(who, [])
        if not members:
            hint = "имена групп — на странице группы и на листе «Решения» ведомости"
            if who in decided_ones:
                hint = f'о ней уже решено; отменить: --decide {who} всё - ""'
            raise InputError(Problem(who, "такая группа работ не ждёт решения", hint))
        spoken += [
            Spoken(n, item or "всё", points, remark, who) for n, item in dict.fromkeys(members)
        ]
    return spoken


def _item(text: str, names: Collection[str]) -> str:
    item = WHOLE if text.strip().casefold() in _WHOLE_WORDS else text.strip()
    if item and item not in names:
        hint = "имена столбцов — на странице студента в results/*.json: P3_1.s_mm"
        raise InputError(Problem(item, "в работе нет такого столбца", hint))
    return item


def decided(
    earlier: Sequence[Decision], register: Register, works: Sequence[Work],
    counted: Mapping[int, Work], words: Sequence[Spoken], author: str,
) -> list[Decision]:  # fmt: skip
    """Decisions with those of a command added.

    They are about the files that are ``counted``.

    Raises:
        InputError: no such student or item, or points that are none.
    """
    entries = {entry.key: entry for entry in earlier}
    for said in words:
        book = student_of(register, works, said.who)
        ids = {line.id for work in works if work.number == book.number for line in work.items}
        item = _item(said.what, ids)
        if said.points.strip() == WITHDRAW:
            entries = {
                key: entry for key, entry in entries.items() if key[:2] != (book.number, item)
            }
            continue
        work = counted.get(book.number)
        is_unclear = said.group and item == WHOLE  # a share could mean two things
        worth = None if is_unclear else _worth(work, item, register.rubric)
        award = award_of(said.points, register.rubric, worth)
        file = work.sha256 if work else ""
        _refuse_idle(said.who, award, item, file, work)
        entry = Decision(
            book.number, item, award.points, one_line(said.remark, _LONGEST), one_line(author, 100),
            datetime.now().isoformat(timespec="minutes"), file, award.word, said.group,
        )  # fmt: skip
        entries[entry.key] = entry
    return list(entries.values())


def _worth(work: Work | None, item: str, rubric: Rubric) -> float:
    """Points that a column or a whole work is worth."""
    lines = work.items if work is not None and item != WHOLE else ()
    return next((line.of for line in lines if line.id == item), rubric.maximum)


def _refuse_idle(who: str, award: Award, item: str, file: str, work: Work | None) -> None:
    """Refuse a word that would change nothing: of no file, or on points that there are not."""
    if not file:
        hint = "поставьте эти баллы сами там, куда переносите ведомость"
        raise InputError(Problem(who, "работа не сдана: решать не о чем", hint))
    is_same = work is not None and work.sha256 == file
    if award.is_change and item == WHOLE and is_same and work and work.points is None:
        problem = "у файла нет баллов программы: принять или изменить нечего"
        raise InputError(Problem(who, problem, "впишите баллы числом"))


def student_of(register: Register, works: Iterable[Work], who: str) -> Issued:
    """Return the work-book of whom a person means: a number, a name, a folder or a file.

    Raises:
        InputError: of nobody, or of several.
    """
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
        problem = "таких студентов несколько" if hits else "нет такого студента"
        raise InputError(Problem(who, problem, "назовите номер варианта или фамилию с именем"))
    return hits[0]


def from_gradebook(
    path: Path, kept: Sequence[Decision], counted: Mapping[int, Work], rubric: Rubric
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
        text = one_line(str(line[remark_at] or ""), _LONGEST)
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
        if points.strip() in ("", WITHDRAW):
            if points.strip() or not text:  # taken out by hand
                entries.pop(key, None)
            continue
        try:
            award = award_of(points, rubric, rubric.maximum)
            _refuse_idle("", award, *key[1:], work)
        except InputError as error:
            where = f"{path.name}, строка {row}: «{one_line(points, 40)}»"
            problems += [replace(problem, where=where) for problem in error.problems]
            continue
        said = award.points, award.word, text
        if earlier is None or (earlier.points, earlier.word, earlier.remark) != said:
            entries[key] = Decision(
                *key[:2], award.points, text, one_line(author, 100), date, key[2], award.word
            )
    if problems:
        raise InputError(problems)
    return list(entries.values())


def words_of_groups(
    path: Path, earlier: Sequence[Decision]
) -> tuple[list[tuple[str, str, str, str]], str]:
    """Decisions on groups that a person has written into the gradebook, and who saved it.

    What stands there as it was decided is no new word; a decision that was wiped out is withdrawn.
    """
    lines, author, _ = _lines(path, GROUPS)
    if not lines or any(head not in lines[0] for head in ("Группа", *DECISION)):
        return [], author
    at = [lines[0].index(head) for head in ("Группа", *DECISION)]
    stand = {entry.group: (written(entry), entry.remark) for entry in earlier if entry.group}
    words = []
    for line in lines[1:]:
        name, points, remark = (str("" if line[i] is None else line[i]).strip() for i in at)
        if not points and not remark and name in stand and DECIDED in line:
            words.append((name, "", WITHDRAW, ""))
        elif points and (points, remark) != stand.get(name):
            words.append((name, "", points, remark))
    return words, author


def written(entry: Decision) -> str:
    """Return the points of a decision as the gradebook has them."""
    return entry.word or (ACCEPT if entry.points is None else f"{entry.points:g}")


def decided_groups(
    decisions: Sequence[Decision], works: Mapping[int, Work]
) -> list[dict[str, Any]]:
    """Return groups that were decided on together: what was said, of whom."""
    groups: dict[str, dict[str, Any]] = {}
    for entry in decisions:
        work = works.get(entry.number)
        if not entry.group or work is None or work.sha256 != entry.file:
            continue
        label = next((line.label for line in work.items if line.id == entry.item), "вся работа")
        blank = {"name": entry.group, "what": label, "points": written(entry),
                 "remark": entry.remark, "numbers": [], "students": []}  # fmt: skip
        group = groups.setdefault(entry.group, blank)
        group["numbers"].append(entry.number)
        group["students"].append(work.student)
    return [groups[name] for name in sorted(groups)]


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
        lines = [tuple(map(_meant, row)) for row in sheet.iter_rows()]
        author = book.properties.lastModifiedBy or "ведомость"
        date = datetime.fromtimestamp(int(path.stat().st_mtime)).isoformat(timespec="minutes")
        book.close()
    except Exception:  # a gradebook that someone has broken is written anew
        return [], "", ""
    return lines, author, date


def _meant(cell: Any) -> Any:  # noqa: ANN401 - a cell of openpyxl and what it holds
    """Return the value of a cell as its sheet shows it: 0.5 in the format of per cents is 50%."""
    value = cell.value
    if type(value) in (int, float) and "%" in _PLAIN_TEXT.sub("", cell.number_format or ""):
        return f"{value * 100:.10g}%"
    if type(value) in (int, float) and value < 0:  # no points; what is to be taken away is a text
        return f"число {value:g}"
    return value


def applied(result: dict[str, Any], decisions: Sequence[Decision]) -> dict[str, Any]:
    """Return a result as the person has decided on its file; without such decisions the same."""
    entries = _of(result, decisions)
    if not entries:
        return result
    decided_result = copy.deepcopy(result)
    decided_result["decisions"] = [asdict(entry) for entry in entries]
    lines = {line["id"]: line for line in decided_result["items"]}
    settled = set()
    for entry in entries:
        line = lines.get(entry.item)
        if line is not None:
            base = line["of"] if line["verdict"] == UNKNOWN and entry.word else line["points"]
            whole = decided_result.get("maximum", math.inf)
            line["points"] = _award(entry).of(base, line["of"] if line["block"] == PART else whole)
            line["decision"] = asdict(entry)
            settled.add(entry.item)
            request = line.get("request")
            if request and request["seen"] != mark_of(line["decision"]):
                request["answered"] = True
    if decided_result["status"] == "graded":
        rescored(decided_result)
    whole = next((entry for entry in entries if entry.item == WHOLE), None)
    unknown = [line for line in lines.values() if line["verdict"] == UNKNOWN]
    if whole is not None:
        decided_result["decision"] = asdict(whole)
        award, points = _award(whole), decided_result.get("points")
        if points is not None or not award.is_change:
            most = decided_result.get("maximum", math.inf)
            decided_result["points"] = award.of(points or 0.0, most)
        decided_result["manual"], decided_result["doubts"] = [], []
    else:
        answered = {request_remark(line) for line in lines.values()
                    if "request" in line and line["request"]["answered"]}  # fmt: skip
        decided_result["manual"] = [t for t in decided_result["manual"] if t not in answered]
        for remark, of_part in ((unread_remark, False), (part_remark, True)):
            group = [line for line in unknown if (line["block"] == PART) == of_part]
            left = [line for line in group if line["id"] not in settled]
            key = "id" if of_part else "label"
            said, still = (remark([line[key] for line in some]) for some in (group, left))
            # Of columns all are named until the last is decided, of parts those that are left.
            word = [still if of_part else said] if left else []
            manual = decided_result["manual"]
            decided_result["manual"] = [
                new for text in manual for new in (word if text == said else [text])
            ]
    return decided_result


def _award(entry: Decision) -> Award:
    """Return the award of a decision, its change read from its word."""
    return award_of(entry.word, _ANY, None) if entry.word else Award(entry.points)


def waiting(result: dict[str, Any], decisions: Sequence[Decision]) -> dict[str, Any]:
    """Return the result that counts: it waits for a person where another file was decided on."""
    items = {entry.item for entry in _of(result, decisions)}
    former = {entry.item for entry in decisions if entry.number == result["number"]} - items
    if WHOLE in items or not former:
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
    identity = result.get("number"), result["sha256"]
    return [entry for entry in decisions if (entry.number, entry.file) == identity]
