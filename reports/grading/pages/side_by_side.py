"""Works with a common origin beside each other: what they share, as each has written it."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from reports.grading.judging.collusion import KINDS, Ring, who
from reports.grading.judging.work_digest import Work
from reports.grading.pages.pages import compared_page

COMPARED = "рядом"  # folder of the pages: for the teacher, never for students
_MAX_WORKS = 6  # columns of a page
_HERE = "есть"  # in the place of what is no formula of a column


@dataclass(frozen=True, slots=True)
class Comparison:
    """A page of works beside each other, and in which words the class names them."""

    page: str
    text: str
    html: str


def comparisons(
    rings: Sequence[Ring], result_of: Callable[[Work], Mapping[str, Any]]
) -> list[Comparison]:
    """Return the pages of rings of two works and more; ``result_of`` gives a work's result."""
    return [_comparison(ring, result_of) for ring in rings if len(ring.works) > 1]


def _comparison(ring: Ring, result_of: Callable[[Work], Mapping[str, Any]]) -> Comparison:
    works = ring.works[:_MAX_WORKS]
    results = [result_of(work) for work in works]
    labels = {line.id: f"{line.label} — {line.title}" for work in works for line in work.items}
    lines = []
    for (kind, item, *_), bits in sorted(
        zip(ring.shared, ring.weights, strict=True), key=lambda pair: -pair[1]
    ):
        texts = [result.get("texts", {}).get(item, _HERE) for result in results]
        lines.append({"what": labels.get(item, KINDS[kind]), "kind": KINDS[kind], "bits": bits,
                      "texts": texts, "alike": item and len(set(texts)) == 1})  # fmt: skip
    key = " ".join(sorted(work.key for work in ring.works))
    name = hashlib.sha256(key.encode()).hexdigest()[:8]
    html = compared_page([who(work) for work in works], lines, ring.text(), ring.bits,
                         len(ring.works) - len(works))  # fmt: skip
    return Comparison(f"{COMPARED}/{name}.html", ring.text(), html)
