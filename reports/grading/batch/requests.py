"""A student's request for another look at one column, and its place in the result."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from reports.grading.judging.work_digest import Work
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.files import write_text

FILE = "requests.json"
MAX_REQUESTS = 5  # of one student on one file
_LONGEST = 300  # signs of a request


@dataclass(frozen=True, slots=True)
class LookRequest:
    """Words of a student on a column of the file that was graded."""

    number: int
    item: str
    text: str
    date: str
    file: str
    seen: str = ""  # the decision on the column that he did not agree with


def load_requests(folder: Path) -> list[LookRequest]:
    """Return the requests of a folder of results.

    Raises:
        InputError: the file is damaged: a student's word is never dropped silently.
    """
    path = folder / FILE
    if not path.exists():
        return []
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return [LookRequest(**entry) for entry in data["requests"]]
    except (OSError, ValueError, TypeError, KeyError):
        problem = "файл просьб студентов повреждён"
        raise InputError(Problem(str(path), problem, "верните его копию или удалите его")) from None


def add_request(folder: Path, work: Work, column: str, text: str) -> list[LookRequest]:
    """Keep a request; ``column`` is an id or what the student's page calls it.

    Raises:
        InputError: no such column, no words, or too many requests.
    """
    lines = [line for line in work.items if column.strip() in (line.id, line.label)]
    words = one_line(text, _LONGEST)
    if len(lines) != 1 or not words:
        problem = "просьба без слов" if lines else "в работе нет такого столбца"
        hint = "столбец — как на странице студента: «П3.1 v»; и в чём вы не согласны"
        raise InputError(Problem(one_line(column, 40), problem, hint))
    about = work.number, lines[0].id, work.sha256
    entries = [
        each for each in load_requests(folder) if (each.number, each.item, each.file) != about
    ]
    own = [each for each in entries if (each.number, each.file) == (work.number, work.sha256)]
    if len(own) >= MAX_REQUESTS:
        problem = f"просьб уже {MAX_REQUESTS}"
        raise InputError(Problem(work.student, problem, "дождитесь ответа преподавателя"))
    date = datetime.now().isoformat(timespec="minutes")
    seen = next((mark_of(each) for each in work.decisions if each["item"] == lines[0].id), "")
    entries.append(LookRequest(work.number or 0, lines[0].id, words, date, work.sha256, seen))
    data = {"format": "kshm-requests", "requests": [asdict(each) for each in entries]}
    write_text(folder / FILE, json.dumps(data, ensure_ascii=False, indent=1) + "\n")
    return entries


def with_requests(result: dict[str, Any], requests: Sequence[LookRequest]) -> dict[str, Any]:
    """Put the requests on a result's file into its lines; each asks a person for an answer."""
    lines = {line["id"]: line for line in result["items"]}
    for each in requests:
        line = lines.get(each.item)
        if line is None or (each.number, each.file) != (result["number"], result["sha256"]):
            continue
        line["request"] = {"text": each.text, "date": each.date, "seen": each.seen,
                           "answered": False}  # fmt: skip
        if (remark := request_remark(line)) not in result["manual"]:
            result["manual"].append(remark)
    return result


def mark_of(decision: Mapping[str, Any]) -> str:
    """Return what tells a decision from the one before it."""
    return " ".join(str(decision.get(key)) for key in ("date", "points", "word", "remark"))


def request_remark(line: dict[str, Any]) -> str:
    """Return the remark on a line that a student asks to look at again."""
    return f"просит посмотреть ещё раз {line['label']}: {line['request']['text']}"
