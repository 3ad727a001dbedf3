"""Where settings and caches go of a user whose home is missing or cannot be written."""

from __future__ import annotations

import os
from pathlib import Path

NO_HOME = "KSHM_NO_HOME"  # variable of a process whose user has no home


def give_libraries_a_home() -> None:
    """Give libraries a temporary folder for settings where the user's cannot be written.

    They look for a home while they are imported, and complain in English.
    """
    try:
        home = Path.home()
    except RuntimeError:  # a container's user without a name
        os.environ[NO_HOME], os.environ["HOME"] = "1", _own_folder()
        return
    config = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config")
    cache = Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache")
    if not _may_write(cache):
        os.environ["XDG_CACHE_HOME"] = _own_folder()
    if not (_may_write(config) and _may_write(cache)):
        os.environ.setdefault("MPLCONFIGDIR", _own_folder())


def _may_write(folder: Path) -> bool:
    """Whether a folder can be written or made."""
    there = next((part for part in (folder, *folder.parents) if part.exists()), None)
    return there is not None and os.access(there, os.W_OK)


def _own_folder() -> str:
    """Folder of this user among the temporary files; caches in it serve the next run."""
    import tempfile  # not for a command that only prints its help

    if os.name == "nt":  # each user has temporary files of his own
        return tempfile.gettempdir()
    folder = Path(tempfile.gettempdir(), f"kshm-{os.getuid()}")
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        if folder.stat().st_uid == os.getuid() and not folder.is_symlink():
            return str(folder)
    except OSError:
        pass
    return tempfile.mkdtemp(prefix="kshm-")
