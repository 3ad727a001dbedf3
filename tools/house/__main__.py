"""Prints the measures of the structure as a table, a column a tree.

python -m tools.house                 the checkout as it stands
python -m tools.house HEAD~20 .       a commit beside the checkout, by the same ruler
python -m tools.house --static …      without the rows that run a build
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tools.house.code import Code
from tools.house.measures import MEASURES

ROOT = Path(__file__).parents[2]


@contextmanager
def tree_of(revision: str) -> Iterator[Path]:
    """Folder of a revision's files; the checkout itself for a dot."""
    if revision == ".":
        yield ROOT
        return
    with tempfile.TemporaryDirectory(prefix="kshm-house-") as folder:
        packed = subprocess.run(
            ["git", "archive", revision], cwd=ROOT, capture_output=True, check=True
        )
        subprocess.run(["tar", "-x", "-C", folder], input=packed.stdout, check=True)
        yield Path(folder)


def column(root: Path, *, static: bool) -> dict[str, str]:
    """Value of each row for the files below a root."""
    code = Code(root)
    values = {title: measure(code) for title, measure in MEASURES.items()}
    return values if static else values | dynamic(root)


def dynamic(root: Path) -> dict[str, str]:
    """Rows that a build of the tree itself gives: its own modules, this ruler."""
    printed = subprocess.run(
        [sys.executable, "-P", str(Path(__file__).with_name("trace.py")), str(root)],
        capture_output=True, text=True, check=True, cwd=root,
    ).stdout  # fmt: skip
    return dict(line.split("\t", 1) for line in printed.splitlines() if "\t" in line)


def main(arguments: list[str]) -> None:
    """Print the table of the trees that the arguments name."""
    static = "--static" in arguments
    revisions = [word for word in arguments if word != "--static"] or ["."]
    columns = []
    for revision in revisions:
        with tree_of(revision) as root:
            columns.append(column(root, static=static))
    print(f"| measured | {' | '.join(revisions)} |")
    print("|---" * (1 + len(revisions)) + "|")
    for title in columns[0] | columns[-1]:
        print(f"| {title} | {' | '.join(each.get(title, '–') for each in columns)} |")


if __name__ == "__main__":
    main(sys.argv[1:])
