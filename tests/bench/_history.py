"""The kept figures of the benchmarks as a picture: each against its first value, by commit."""

from __future__ import annotations

import csv
from collections import defaultdict
from pathlib import Path
from statistics import median

from matplotlib.figure import Figure as Picture


def by_commit(file: Path, machine: str = "") -> tuple[list[str], dict[str, dict[str, float]]]:
    """Commits in the order of their first row, and of each figure the median at each commit.

    Figures of another machine do not compare: only rows of the one named, else of the last row.
    """
    with file.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    machine = machine or (rows[-1]["machine"] if rows else "")
    values: defaultdict[str, defaultdict[str, list[float]]] = defaultdict(lambda: defaultdict(list))
    commits: dict[str, None] = {}
    for row in rows:
        if row["machine"] == machine:
            commits[row["commit"]] = None
            values[row["name"]][row["commit"]].append(float(row["value"]))
    return list(commits), {
        name: {commit: median(each) for commit, each in at.items()} for name, at in values.items()
    }


def draw(file: Path, target: Path, words: list[str]) -> int:
    """Write an SVG of the figures whose names hold all words; how many lines it has."""
    commits, values = by_commit(file)
    shown = {
        name: at for name, at in values.items()
        if len(at) > 1 and all(word in name for word in words) and next(iter(at.values()))
    }  # fmt: skip
    picture = Picture(figsize=(10, 5), layout="constrained")
    axes = picture.add_subplot()
    for name, at in shown.items():
        first = next(iter(at.values()))
        ratios = [value / first for value in at.values()]
        axes.plot([commits.index(commit) for commit in at], ratios, marker="o", label=name)
    axes.set_xticks(range(len(commits)), commits, rotation=90)
    axes.set_ylabel("к первому замеру")
    axes.grid(visible=True, alpha=0.3)
    if shown:
        axes.legend(fontsize="small")
    picture.savefig(target, format="svg")
    return len(shown)
