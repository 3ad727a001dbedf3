"""Fuzz one door: ``python -m tests.fuzz DOOR [SECONDS]``, guided by coverage with atheris.

Without atheris inputs of the corpus are changed blindly.  What raises is kept in the corpus's
folder as ``crash-…``; the inputs that reach new code stay in the folder given by ``--keep``.
"""

from __future__ import annotations

import argparse
import hashlib
import random
import sys
import time
import traceback
from collections.abc import Callable
from pathlib import Path

CORPUS = Path(__file__).with_name("corpus")
NAMES = ("grading", "toml", "workbook")


def main(arguments: list[str]) -> int:
    """Run; exit code 1 where an input raised."""
    parser = argparse.ArgumentParser(prog="./run fuzz", description="Случайные файлы на входе.")
    parser.add_argument("door", choices=NAMES, metavar="ВХОД", help=f"из: {', '.join(NAMES)}")
    parser.add_argument("seconds", nargs="?", type=int, default=60, metavar="СЕКУНДЫ")
    parser.add_argument("--keep", type=Path, metavar="ПАПКА", help="куда складывать новые входы")
    parser.add_argument("--blind", action="store_true", help="не пользоваться atheris")
    options = parser.parse_args(arguments)
    try:
        import atheris
    except ImportError:
        options.blind = True
    if options.blind:
        from tests.fuzz.doors import DOORS

        return _blind(DOORS[options.door], CORPUS / options.door, options.seconds)
    with atheris.instrument_imports(include=["reports", "kshm", "tomllib"]):
        from tests.fuzz.doors import DOORS
    door = DOORS[options.door]
    folders = [str(options.keep)] if options.keep else []
    folders.append(str(CORPUS / options.door))
    atheris.Setup(
        [sys.argv[0], f"-max_total_time={options.seconds}", "-timeout=30", "-rss_limit_mb=4096",
         "-max_len=4096", f"-artifact_prefix={CORPUS / options.door}/", *folders],
        lambda data: door(data) and None,
    )  # fmt: skip
    atheris.Fuzz()
    return 0


def _blind(door: Callable[[bytes], str], corpus: Path, seconds: float) -> int:
    seeds = [path.read_bytes() for path in sorted(corpus.iterdir())] or [b""]
    rng = random.Random(time.time_ns())
    end = time.monotonic() + seconds
    tried = failed = 0
    while time.monotonic() < end:
        data = _changed(rng, rng.choice(seeds), rng.choice(seeds))
        tried += 1
        try:
            door(data)
        except Exception:
            failed += 1
            traceback.print_exc()
            name = hashlib.sha256(data).hexdigest()[:12]
            (corpus / f"crash-{name}").write_bytes(data)
    print(f"входов: {tried}, отказов программы: {failed}")
    return 1 if failed else 0


def _changed(rng: random.Random, data: bytes, other: bytes) -> bytes:
    for _ in range(rng.choice((1, 2, 4, 8))):
        at, length = rng.randrange(len(data) + 1), rng.choice((1, 2, 8, 40))
        piece = other[rng.randrange(len(other) + 1) :][:length]
        piece = rng.choice((piece, rng.randbytes(rng.randrange(1, 8)), b""))
        data = data[:at] + piece + data[at + rng.choice((0, len(piece), length)) :]
    return data


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
