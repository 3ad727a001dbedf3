"""Grading on a Dask cluster: parts of a batch, each looked at as on this machine.

A part runs in a process of its own beside the cluster's worker: Dask's workers may not
start processes themselves, and people's files are only opened in limited ones.
"""

from __future__ import annotations

import pickle
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from reports.grading.batch.pool import Outcome, grade_all
from reports.grading.reading.submissions import Submission
from reports.shared.errors import InputError, KshmError
from reports.shared.ordered import in_order

PART = 20  # files; starting the process costs as much as a few of them


@dataclass(frozen=True, slots=True)
class Part:
    """Some submissions with their bytes, the register in force, seconds for a file."""

    register: str
    submissions: list[tuple[Submission, bytes]]
    timeout_s: float


Answers = list[tuple[str, dict[str, Any] | None, str, str]]  # key, result, page, problem


def grade_far(
    submissions: Sequence[Submission], register_file: Path, *, timeout_s: float, dask: str
) -> Iterator[Outcome]:
    """Outcomes as they come, as ``grade_all`` gives them.

    Raises:
        KshmError: the cluster cannot be reached or lost too many workers.
    """
    whole = {item.key: item for item in submissions}
    unread: list[Submission] = []
    parts = _parts(submissions, register_file.read_text(encoding="utf-8"), timeout_s, unread)
    for answers in in_order(graded, parts, dask=dask):
        for key, result, page, problem in answers:
            yield Outcome(whole[key], result, page, problem)
    yield from grade_all(unread, register_file, workers=1, timeout_s=timeout_s)


def _parts(
    submissions: Sequence[Submission], register: str, timeout_s: float, unread: list[Submission]
) -> Iterator[Part]:
    """The parts, read as they are sent; what cannot be read stays here."""
    for begin in range(0, len(submissions), PART):
        read = []
        for item in submissions[begin : begin + PART]:
            try:
                read.append((item, item.read()))
            except InputError:
                unread.append(item)
        if read:
            yield Part(register, read, timeout_s)


def graded(part: Part) -> Answers:
    """Answers for a part, in the order of its files."""
    done = subprocess.run(
        [sys.executable, "-m", "reports.grading.batch.cluster"],
        input=pickle.dumps(part), stdout=subprocess.PIPE, check=False,
    )  # fmt: skip
    if done.returncode != 0:
        msg = "процесс проверки на кластере не запустился; проверьте установку kshm на его узлах"
        raise KshmError(msg)
    answers: Answers = pickle.loads(done.stdout)
    return answers


def _grade_here(part: Part) -> Answers:
    with tempfile.TemporaryDirectory(prefix="kshm-part-") as name:
        register = Path(name) / "register.json"
        register.write_text(part.register, encoding="utf-8")
        moved = []
        for number, (item, data) in enumerate(part.submissions):
            path = Path(name) / f"{number}.bin"
            path.write_bytes(data)
            moved.append(replace(item, path=path, members=None))
        outcomes = grade_all(moved, register, workers=1, timeout_s=part.timeout_s)
        found = {o.submission.key: (o.result, o.page, o.problem) for o in outcomes}
        return [(item.key, *found[item.key]) for item in moved]


if __name__ == "__main__":
    sys.stdout.buffer.write(pickle.dumps(_grade_here(pickle.load(sys.stdin.buffer))))
