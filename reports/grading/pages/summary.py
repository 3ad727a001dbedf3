"""The class as a whole: who got what, how points are spread, what was hardest."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from statistics import mean, median
from typing import Any

from reports.grading.issuing.register import Register
from reports.grading.issuing.rubric import Attempts
from reports.grading.judging.collusion import Ring
from reports.grading.judging.judgement import CARRIED, EMPTY, RIGHT, TYPED, UNKNOWN, WRONG
from reports.grading.judging.similarity import signals, suspicions
from reports.grading.judging.tries import in_order, words_of_all
from reports.grading.judging.work_digest import Work
from reports.grading.pages.groups import WaitingGroup, groups_of
from reports.grading.pages.pages import moment
from reports.grading.pages.states import State, state_of
from reports.shared.russian import short

# What is handed in beside the book: no work by itself.
_BESIDE = (".doc", ".docx", ".odt", ".rtf", ".txt", ".md", ".pdf", ".jpg", ".jpeg", ".png", ".heic",
           ".dwg", ".dxf", ".cdw", ".frw", ".pptx", ".xmcd", ".html")  # fmt: skip
_NOBODYS = {"number": None, "group": "", "id": "", "email": "", "moodle_id": "", "points": None,
            "provisional": None, "manual": True, "doubts": (), "decision": None}  # fmt: skip
LAST = Attempts()
_BAR = 160  # px of the longest bar
_STEPS = 10


def choose(results: Sequence[Work], attempts: Attempts = LAST) -> dict[int, Work]:
    """Return the result that counts for each student: of several graded files the last or the best.

    Of files beyond the tries that a student has none counts.

    Of files of the same time, as in one zip, none is the last: the best counts.  One's own file
    comes before one that came under another's name.
    """
    chosen: dict[int, Work] = {}

    def order(result: Work) -> tuple[Any, ...]:
        points = result.points or 0.0
        return (
            result.submitter is None,
            result.status == "graded",
            points if attempts.count == "best" else 0.0,
            result.time,
            points,
            result.key,
        )

    late = {work.key for tries in tries_of(results).values() for work in tries[attempts.tries :]}
    for result in sorted(results, key=order):
        beyond = bool(attempts.tries) and result.key in late
        if result.number is not None and not beyond:
            chosen[result.number] = result
    return chosen


def tries_of(results: Sequence[Work]) -> dict[int, list[Work]]:
    """Tell what each student has handed in under the own name, in order."""
    tries: dict[int, list[Work]] = {}
    for work in results:
        if work.number is not None and work.submitter is None:
            tries.setdefault(work.number, []).append(work)
    return {number: in_order(works) for number, works in tries.items()}


def _is_beside(result: Work, chosen: dict[int, Work]) -> bool:
    """Whether a file that cannot be read is no later version of the work that counts."""
    counted = chosen.get(result.number or 0)
    if counted is None or counted is result or result.status != "refused":
        return False
    superseded = result.time <= counted.time or _is_seen(result, counted)
    return superseded or result.file.casefold().endswith(_BESIDE)


def _is_seen(result: Work, counted: Work) -> bool:
    """Whether a person has decided on the work that counts since this file was handed in."""
    looked = counted.decision["date"] if counted.decision else ""  # to the minute
    return bool(looked and result.time[: len(looked)] <= looked)


def _asked(result: Work, doubts: Sequence[str], chosen: dict[int, Work]) -> list[str]:
    """Why a person has to look at a file.  Of what does not count only a doubt is left to him."""
    whole = [*result.manual, *doubts]
    if result.decision or _is_beside(result, chosen):
        return []
    if chosen.get(result.number or 0) is result or result.status != "graded":
        return whole
    counted = chosen.get(result.submitter or result.number or 0)
    if counted is None:
        return whole
    return [] if _is_seen(result, counted) else list(doubts)


def _unread(result: Work, results: Sequence[Work], chosen: dict[int, Work]) -> list[str]:
    """Unreadable files handed in after the work that counts."""
    return [
        f"оценён не последний файл: {other.file} — {text}"
        for other in results
        if other.number == result.number and other.status == "refused" and other is not result
        and other.submitter is None and not _is_beside(other, chosen)
        for text in other.manual[:1]
    ]  # fmt: skip


def table_rows(
    register: Register, results: Sequence[Work], rings: Sequence[Ring] = ()
) -> list[dict[str, Any]]:
    """Return a row for each student of the register, then one for each file without an owner."""
    attempts = register.rubric.attempts
    count, tries = attempts.count, tries_of(results) if attempts.tries else {}
    chosen, held = choose(results, attempts), suspicions(results, rings)
    times: dict[int | None, list[str]] = {}
    for r in results:
        if r.submitter is None and not _is_beside(r, chosen):
            times.setdefault(r.number, []).append(r.time)
    strange = {r.submitter: r for r in results if r.submitter is not None}
    rows = []
    for book in register.books:
        result = chosen.get(book.number)
        other = strange.get(book.number) if result is None else None
        seen = result or other  # the file that is told of
        doubts = held.get(seen.key, []) if seen else []
        word = result.decision if result else None
        if word:  # a person has looked
            doubts = []
        foreign = result is not None and result.submitter is not None
        if result is not None and foreign and not doubts and not word:
            doubts = list(result.manual)
        points = result.points if result else None
        unread = _unread(result, results, chosen) if result is not None else []
        remarks = [*unread, *_remarks(result, times.get(book.number, []), count)]
        if other is not None:
            remarks = list(doubts)
        state = State.ABSENT
        if result is not None or doubts:
            open_items = [*unread, *result.manual] if result else []
            state = state_of(result.status if result else "", open_items, doubts)
        remarks = list(dict.fromkeys([*doubts, *remarks]))
        if doubts and points is not None:
            remarks.append(f"баллы до решения преподавателя: {short(points)}")
        rows.append(
            {
                "number": book.number,
                "student": book.student.full,
                "group": book.student.group,
                "id": book.student.number,
                "email": book.student.email,
                "moodle_id": seen.moodle_id if seen and not foreign else "",
                "file": seen.file if seen else "",
                "status": state,
                "points": None if doubts else points,
                "provisional": points,
                "result": result,
                "page": result.page if result else "",
                "manual": bool(doubts or unread or (result and result.manual)),
                "doubts": tuple(doubts),
                "remark": "; ".join(remarks),
                "similar": "; ".join(
                    filter(
                        None,
                        (
                            _told(rings, result),
                            words_of_all(tries.get(book.number, ()), attempts.tries),
                        ),
                    )
                ),
                "decision": word,
            }
        )
    for result in results:
        if result.number is None and result.submitter is None:
            rows.append(
                _NOBODYS | {"student": f"? ({result.file})", "file": result.file,
                            "status": state_of(result.status, result.manual, ()),
                            "result": result, "page": result.page, "similar": "",
                            "remark": "; ".join(result.manual)}
            )  # fmt: skip
    return rows


def _told(rings: Sequence[Ring], result: Work | None) -> str:
    """What a work shares with others where that is no reason to hold it: for the teacher alone."""
    return "; ".join(
        f"сходство: {ring.text(result)}"
        for ring in rings
        if result is not None and not ring.held and result in ring.works
    )


def _remarks(result: Work | None, times: Sequence[str], count: str) -> list[str]:
    """Remarks on the work that counts; ``times`` are those of all files of its student."""
    if result is None:
        return ["работа не сдана"]
    remarks = [*result.manual, *result.notes]
    labels = {line.id: line.label for line in result.items}
    for entry in result.decisions:
        problem = f" ({labels.get(entry['item'], entry['item'])})" if entry["item"] else ""
        word = f" {entry['word']}" if entry.get("word") else ""
        said = entry["remark"] or "без примечания"
        remarks.append(f"решение преподавателя{problem}{word}: {said}")
    if len(times) > 1:
        which = "последний" if count == "last" else "лучший"
        if count == "last" and times.count(result.time) > 1:
            which = "лучший из сданных в то же время"
        remarks.append(f"сдано файлов: {len(times)}, оценён {which} ({result.file})")
    return remarks


def waiting_groups(
    register: Register, results: Sequence[Work], rings: Sequence[Ring] = ()
) -> list[WaitingGroup]:
    """Works that count and wait, by what is the same about them."""
    chosen = choose(results, register.rubric.attempts)
    return groups_of(chosen, suspicions(results, rings), rings, register.rubric.maximum)


def summarise(
    register: Register, results: Sequence[Work], rings: Sequence[Ring] = ()
) -> dict[str, Any]:
    """Everything that the page of the class shows."""
    rows = table_rows(register, results, rings)
    chosen = choose(results, register.rubric.attempts)
    graded = [r for _, r in sorted(chosen.items()) if r.status == "graded"]
    marks = [float(row["points"]) for row in rows if row["points"] is not None]
    held = suspicions(results, rings)
    questions = [(r, _asked(r, held.get(r.key, ()), chosen)) for r in results]
    times = sorted(r.time for r in chosen.values() if r.time)
    return {
        "files": len(results),
        "students": len(register.books),
        "graded": len(graded),
        "absent": [row["student"] for row in rows if row["status"] == State.ABSENT],
        "maximum": register.rubric.maximum,
        "mean": mean(marks) if marks else 0.0,
        "median": median(marks) if marks else 0.0,
        "first_time": moment(times[0]) if times else "",
        "last_time": moment(times[-1]) if times else "",
        "late": sum(result.late < 1 for result in graded),
        "distribution": _distribution(marks, register.rubric.maximum),
        "hardest": _hardest(graded),
        "signals": signals(results, rings),
        "groups": [asdict(group) for group in waiting_groups(register, results, rings)],
        "manual": [
            {"who": _name(r), "why": list(dict.fromkeys(why)), "page": r.page}
            for r, why in questions
            if why
        ],
        "rows": rows,
    }


def _name(result: Work) -> str:
    return result.student or result.file


def _distribution(marks: list[float], maximum: float) -> list[dict[str, Any]]:
    counts = [0] * _STEPS
    for mark in marks:
        counts[min(_STEPS - 1, int(mark / maximum * _STEPS))] += 1
    most = max(counts) or 1
    return [
        {
            "label": f"{i * 10}–{i * 10 + 10}\u00a0%",
            "count": count,
            "width": round(_BAR * count / most),
        }
        for i, count in enumerate(counts)
    ]


def _hardest(graded: list[Work], limit: int = 15) -> list[dict[str, Any]]:
    lines: dict[str, dict[str, Any]] = {}
    causes: dict[str, Counter[str]] = {}
    for result in graded:
        for line in result.items:
            if not line.of:
                continue
            entry = lines.setdefault(
                line.id,
                {"title": f"{line.label} — {line.title}",
                 **dict.fromkeys((RIGHT, CARRIED, TYPED, WRONG, EMPTY, UNKNOWN), 0)},
            )  # fmt: skip
            verdict = line.verdict
            entry[verdict if verdict in entry else WRONG] += 1
            if line.cause:
                causes.setdefault(line.id, Counter())[line.cause] += 1
    for key, entry in lines.items():
        counts = causes.get(key)
        entry["cause"] = min(counts, key=lambda c: (-counts[c], c)) if counts else ""
    hard = [entry for entry in lines.values() if entry["wrong"] + entry["empty"] + entry["typed"]]
    hard.sort(key=lambda e: (-(e["wrong"] + e["empty"]), -e["typed"], e["title"]))
    return hard[:limit]
