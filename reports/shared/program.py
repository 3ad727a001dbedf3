"""What the program is, so that what another one has made is not taken for its own."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

import kshm
from reports.shared.resources import templates_dir


@lru_cache(maxsize=1)
def program() -> str:
    """A digest of all that the program consists of: it changes with every rule and sentence."""
    digest = hashlib.sha256()
    for folder in (Path(kshm.__file__).parent, Path(__file__).parents[1], templates_dir()):
        for path in sorted(folder.rglob("*")):
            if path.suffix in (".py", ".j2"):
                digest.update(path.read_bytes())
    return digest.hexdigest()
