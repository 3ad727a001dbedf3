"""Files that several tests look at: made once in a run, by the process that needs them first."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import lru_cache, wraps
from pathlib import Path
from tempfile import NamedTemporaryFile

FOLDER = "KSHM_KEPT"  # set by tests/conftest.py for all processes of a run


def kept(make: Callable[[str], bytes]) -> Callable[[str], bytes]:
    """A function of a sample's name whose bytes are the same whoever makes them."""

    @lru_cache(maxsize=4)
    @wraps(make)
    def found(name: str = "gots-diesel") -> bytes:
        if FOLDER not in os.environ:  # not under pytest
            return make(name)
        path = Path(os.environ[FOLDER]) / f"{make.__module__}.{make.__name__}.{name}"
        if not path.exists():
            with NamedTemporaryFile(dir=path.parent, delete=False) as written:
                written.write(make(name))
            Path(written.name).replace(path)  # two at once write the same
        return path.read_bytes()

    return found
