"""Results as they stand at the end of a run: as people have decided, and with their state.

The file of a result says what the gradebook says; what the program alone has made of the work is
kept beside it, so that the next run and a decision taken back begin with that.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from reports.grading.issuing.names import latin
from reports.grading.judging.judgement import UNKNOWN
from reports.grading.pages.states import State

Result = dict[str, Any]
_ITSELF = "program"
_KEYS = ("points", "raw", "manual", "doubts")


def settled(program: Result, decided: Result, state: State, doubts: Sequence[str]) -> Result:
    """Return the result for readers: what is held has no points until a person has decided.

    Args:
        program: the result as the program has made it.
        decided: the same as people have decided.
        state: what the gradebook says of the work.
        doubts: why it may be another's, by itself and beside the other works.
    """
    lines = {line["id"]: line["points"] for line in program["items"]}
    changed = {line["id"]: lines[line["id"]] for line in decided["items"] if "decision" in line}
    itself = {key: program[key] for key in _KEYS if key in program} | {"items": changed}
    points = decided.get("points")
    return {
        **decided,
        "state": state,
        "doubts": list(doubts),
        "points": None if state == State.HELD else points,
        "provisional": points,
        _ITSELF: itself,
    }


def as_graded(result: Result) -> Result:
    """Return the result as the program has made it, whatever has been decided since."""
    itself = result.pop(_ITSELF, None)
    if itself is None:
        return result
    for key in ("decision", "decisions", "provisional", "state", *_KEYS):
        result.pop(key, None)
    for line in result["items"]:
        if line.pop("decision", None) is not None:
            line["points"] = itself["items"][line["id"]]
    return result | {key: itself[key] for key in _KEYS if key in itself}


def is_settled(result: Result) -> bool:
    """Whether a result has been changed by a decision or by other works."""
    return _ITSELF in result


def result_text(result: dict[str, Any]) -> str:
    """Return a result as a file."""
    return json.dumps(result, ensure_ascii=False, allow_nan=False, sort_keys=True) + "\n"


def plain_row(row: dict[str, Any]) -> dict[str, Any]:
    """Return a row of the gradebook as plain data, with the items that only a person can judge."""
    items = row["result"].items if row["result"] else ()
    unknown = [item.id for item in items if item.verdict == UNKNOWN]
    return {key: value for key, value in row.items() if key != "result"} | {"unknown": unknown}


def file_stem(result: dict[str, Any], *, number_only: bool) -> str:
    """Return a file name that depends on the submission alone; it may tell no name."""
    mark = hashlib.sha256(result["key"].encode()).hexdigest()[:6]
    if number_only:
        return f"{result['number'] or 0:03d}-{mark}"
    name = result["folder"] or re.sub(r"[^a-z0-9]+", "-", latin(Path(result["key"]).stem))[:40]
    return f"{name.strip('-') or 'file'}-{mark}"
