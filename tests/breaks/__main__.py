"""Breaks the product on purpose, one break after the other, and asks the tests named for it.

    ./run breaks            all of the list
    ./run breaks forces.py  those whose file or words hold a text

Each break is made in a copy of the checkout, so the tree stays as it is.  Ends with 1 where a
break was seen by no test.
"""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

from tests.breaks.listed import ROOT, Break, breaks

AT_ONCE = os.cpu_count() or 1


def main(words: list[str]) -> int:
    """Tell of each break whether it was seen; the number of those that were not."""
    requested = [b for b in breaks() if all(word in f"{b.file} {b.about}" for word in words)]
    with tempfile.TemporaryDirectory(prefix="kshm-breaks-") as folder:
        copies: SimpleQueue[Path] = SimpleQueue()
        for number in range(AT_ONCE):
            copies.put(_copied(Path(folder) / str(number)))

        def tried(one: Break) -> bool:
            copy = copies.get()
            try:
                seen = _is_seen(one, copy)
            finally:
                copies.put(copy)
            print(f"{'seen' if seen else 'NOT SEEN'}: {one.about} ({one.file})", flush=True)
            return seen

        with ThreadPoolExecutor(AT_ONCE) as pool:
            collected = list(pool.map(tried, requested))
    print(f"{sum(collected)} of {len(collected)} breaks seen")
    return int(not all(collected))


def _copied(folder: Path) -> Path:
    tracked = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT, capture_output=True, check=True, text=True,
    ).stdout  # fmt: skip
    for name in filter(None, tracked.split("\0")):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, folder / name)
    return folder


def _is_seen(one: Break, copy: Path) -> bool:
    """Whether a test fails.

    Raises:
        RuntimeError: the tests did not run.
    """
    path = copy / one.file
    whole = path.read_text(encoding="utf-8")
    path.write_text(whole.replace(one.stands, one.put), encoding="utf-8")
    try:
        ended = subprocess.run(
            [sys.executable, "-m", "pytest", "-x", "-p", "no:cacheprovider",
             *shlex.split(one.tests)],
            cwd=copy, capture_output=True, check=False,
            env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
        )  # fmt: skip
    finally:
        path.write_text(whole, encoding="utf-8")
    if ended.returncode > 1:
        raise RuntimeError(f"{one.about}: {one.tests} did not run:\n{ended.stdout.decode()}")
    return ended.returncode == 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
