"""Start of the command: ``kshm --help`` beside a Python that does nothing."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from tests.bench._figure import Figure
from tests.bench._process import kshm, median


def figures() -> Iterator[Figure]:
    """Figures."""
    bare = median([sys.executable, "-c", ""], times=9)
    help_text = median(kshm("--help"), times=9)
    yield Figure("kshm --help", help_text.wall, "с", "цель 0,2 на свободной машине")
    yield Figure("kshm --help: процессор", help_text.cpu, "с")
    yield Figure("пустой Python", bare.wall, "с")
    yield Figure("kshm --help: память", help_text.memory, "МБ")
