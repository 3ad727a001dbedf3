"""Folders of templates, samples and printed numbers; digest of the sources."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

import kshm
from reports.shared.errors import KshmError

_PACKAGE = Path(__file__).resolve().parents[1]


def resource_dir(kind: str) -> Path:
    """Return the folder ``templates`` or ``samples``.

    Raises:
        KshmError: The installation is damaged.
    """
    for folder in (_PACKAGE / "_bundle" / kind, _PACKAGE.parent / kind):
        if folder.is_dir():
            return folder
    raise KshmError(f"установка повреждена: нет папки {kind}; переустановите kshm")


def templates_dir() -> Path:
    """Return the folder of Jinja2 templates and CSS."""
    return resource_dir("templates")


def samples_dir() -> Path:
    """Return the folder of sample input files."""
    return resource_dir("samples")


def validation_dir() -> Path:
    """Return the folder of printed numbers; it lies inside the package itself."""
    return _PACKAGE / "studies" / "data"


@lru_cache(maxsize=1)
def source_digest() -> str:
    """Digest of the sources and templates; invalidates caches."""
    digest = hashlib.sha256()
    for folder in (Path(kshm.__file__).parent, Path(__file__).parents[1], templates_dir()):
        for path in sorted(folder.rglob("*")):
            if path.suffix in (".py", ".j2", ".book"):
                digest.update(path.read_bytes())
    return digest.hexdigest()
