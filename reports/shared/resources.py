"""Where templates, samples and printed numbers lie: in the bundle, else in the checkout."""

from __future__ import annotations

from pathlib import Path

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
    return _PACKAGE / "validation" / "data"
