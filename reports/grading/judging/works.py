"""What the tables of a class need of each work: small enough to hold thousands of them.

The whole result of a work lies in its file; here are its sums, words and marks.  Items that came
out alike, and most of a class does, are one object for all works.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from reports.grading.judging.judgement import STILL, TYPED, WRONG

_MARK = 16  # signs of a mark of right values
_NONE = " " * _MARK


@dataclass(frozen=True, slots=True)
class Entry:
    """An item as it came out; ``mark`` tells wrong values, ``formula`` who wrote it."""

    id: str
    heading: str
    label: str
    title: str
    verdict: str
    points: float
    of: float
    cause: str
    mark: str
    formula: tuple[str, bool, bool] | None  # its mark, a step that does nothing, the program's


@dataclass(frozen=True, slots=True)
class Work:
    """A result without its cells, curves and explanations."""

    key: str
    file: str
    page: str
    fingerprint: str
    sha256: str
    status: str
    number: int | None
    student: str
    submitter: int | None
    moodle_id: str
    time: str
    points: float | None
    late: float
    manual: tuple[str, ...]
    doubts: tuple[str, ...]
    notes: tuple[str, ...]
    saved_by: str
    decision: dict[str, Any] | None
    decisions: tuple[dict[str, Any], ...]
    items: tuple[Entry, ...]
    _rights: str

    @property
    def rights(self) -> Iterator[tuple[Entry, str]]:
        """Items with the marks of their right values, empty where there is nothing to tell."""
        for index, entry in enumerate(self.items):
            yield entry, self._rights[index * _MARK : (index + 1) * _MARK].strip()


Shared = dict[Entry, Entry]


def work_of(result: dict[str, Any], shared: Shared) -> Work:
    """The small form of a result; ``shared`` holds the items of all works of a class."""
    formulas = result.get("formulas", {})
    made = (_entry(line, formulas.get(line["id"])) for line in result["items"])
    return Work(
        key=result["key"],
        file=result["file"],
        page=result.get("page", ""),
        fingerprint=result.get("fingerprint", ""),
        sha256=result.get("sha256", ""),
        status=result["status"],
        number=result.get("number"),
        student=result.get("student") or "",
        submitter=result.get("submitter"),
        moodle_id=result.get("moodle_id") or "",
        time=result.get("time") or "",
        points=result.get("points"),
        late=result.get("late", 1.0),
        manual=tuple(result["manual"]),
        doubts=tuple(result.get("doubts", ())),
        notes=tuple(result.get("notes", ())),
        saved_by=result.get("properties", {}).get("lastModifiedBy", "").strip(),
        decision=result.get("decision"),
        decisions=tuple(result.get("decisions", ())),
        items=tuple(shared.setdefault(entry, entry) for entry in made),
        _rights="".join((line.get("right_mark") or _NONE) for line in result["items"]),
    )


def _entry(line: dict[str, Any], formula: list[Any] | None) -> Entry:
    verdict = line["verdict"]
    return Entry(
        id=line["id"],
        heading=line["heading"],
        label=line["label"],
        title=line["title"],
        verdict=verdict,
        points=line["points"],
        of=line["of"],
        cause=line["cause"],
        mark=line.get("mark", "") if verdict in (WRONG, TYPED, STILL) else "",
        formula=(formula[0], bool(formula[1]), bool(formula[2])) if formula else None,
    )
