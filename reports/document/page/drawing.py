"""Formulas and figures drawn by two processes where many are not kept yet."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from reports.document import store
from reports.shared.aside import aside, can_split

_FEW = 8  # drawn here: a second process costs as much


@dataclass(frozen=True, slots=True)
class Job:
    """Something to draw: its kind and content make the key under which ``draw`` keeps it."""

    kind: str
    content: bytes
    draw: Callable[[], object]


def draw_all(jobs: Sequence[Job]) -> None:
    """Draw what is not kept yet, so that drawing it again costs nothing."""
    kept = store.store()
    missing: dict[str, Job] = {}
    for job in jobs:
        name = store.key(job.kind, job.content)
        if name not in missing and kept.get(name) is None:
            missing[name] = job
    wanted = list(missing.values())
    if len(wanted) <= _FEW or not can_split():
        return
    import matplotlib.mathtext  # before the process is split: one import serves both

    assert matplotlib.mathtext
    other = aside(partial(_drawn, wanted[1::2]))
    for job in wanted[::2]:
        job.draw()
    for name, text in other().items():
        kept.put(name, text)


def _drawn(jobs: Sequence[Job]) -> dict[str, str]:
    """What the second process has drawn, by key."""
    own = store.store()
    own.alone()
    for job in jobs:
        job.draw()
    return own.new
