"""Works whose changes do not meet, handed in as one: a class of half the size.

A column that is wrong costs what it costs whatever else is wrong, so long as neither follows from
the other.  With ``--all`` each work is a book of its own.
"""

from __future__ import annotations

from collections.abc import Iterable

from openpyxl import Workbook

from tests.cover import ALL
from tests.grading.real.books import Work
from tests.grading.real.desk import Desk, desk

NAMES = " + "
# Two honest manners in one book: most of these are saved by LibreOffice, which takes its time.
_PAIRS = {
    "saved by LibreOffice": "own notes and checks",
    "a helper sheet": "look-ups saved by LibreOffice",
    "array formulas saved by LibreOffice": "hidden, merged, in another order",
    "rounded as printed, saved by LibreOffice": "columns by name",
    "few digits of pi in a cell": "the variant copied to an own sheet",
}


def paired(works: Iterable[Work]) -> tuple[Work, ...]:
    """The honest works, some of them in pairs."""
    if ALL:
        return tuple(works)
    named = {work.name: work for work in works}
    pairs = [_joined([named.pop(one), named.pop(other)]) for one, other in _PAIRS.items()]
    return (*named.values(), *pairs)


def together(works: Iterable[Work]) -> tuple[Work, ...]:
    """The works, joined where they do not meet."""
    groups: list[list[Work]] = []
    for work in works:
        free = (group for group in groups if not any(_meet(work, other) for other in group))
        group = next(free, None)
        if group is None:
            groups.append([work])
        else:
            group.append(work)
    return tuple(map(_joined, groups))


def _meet(one: Work, other: Work) -> bool:
    """Whether a change of one work is seen where the other looks."""
    mine, theirs = _changed(one), _changed(other)
    if ALL or not mine or not theirs:
        return True
    return bool(mine & theirs or mine & _before(theirs) or theirs & _before(mine))


def _changed(work: Work) -> set[str]:
    """The nodes that a work fills in otherwise; none where it is more than that."""
    if work.edit is not None and len(work.unpaid) == 1:
        return set(work.unpaid)
    if work.edit or work.after or work.held or work.form != "own":
        return set()
    return set(work.change(desk(1)))


def _before(nodes: set[str]) -> set[str]:
    graph = desk(1).assignment.graph
    return set().union(*map(graph.ancestors, nodes))


def _joined(group: list[Work]) -> Work:
    def change(here: Desk) -> dict[str, object]:
        return {node: cells for work in group for node, cells in work.change(here).items()}

    def edit(book: Workbook, here: Desk) -> None:
        for work in group:
            if work.edit is not None:
                work.edit(book, here)

    if len(group) == 1:
        return group[0]
    return Work(
        NAMES.join(work.name for work in group),
        change,  # type: ignore[arg-type]
        edit if any(work.edit for work in group) else None,
        group[0].form,
        verdicts={item: word for work in group for item, word in work.verdicts.items()},
        causes={item: words for work in group for item, words in work.causes.items()},
        unpaid=tuple(item for work in group for item in work.unpaid),
    )
