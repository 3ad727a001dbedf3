"""Formulas and figures kept between runs, by their content.

A key is made from everything that decides the picture: what is drawn, the code that draws it
and the versions of the libraries behind it.  A changed input, program or library gives another
key, so a stale picture cannot be served.  The store is a convenience: whatever goes wrong with
it, everything is drawn anew.  ``KSHM_CACHE`` names another folder; empty, it turns the store off.
It halves the time of a report, see ``tests/bench/report.py``.
"""

from __future__ import annotations

import functools
import hashlib
import os
import sqlite3
import sys
import zlib
from collections.abc import Callable
from importlib import metadata
from pathlib import Path

_LIMIT = 64 * 1024 * 1024  # bytes from which the store begins anew
_WAIT = 0.5  # seconds to wait for another process at most
_LIBRARIES = ("matplotlib", "numpy", "pyparsing", "fonttools")


class Store:
    """Texts by key in one file; several processes may use it at once."""

    def __init__(self, folder: Path | None) -> None:
        self._new: dict[str, str] = {}
        self._base: sqlite3.Connection | None = None
        if folder is None:
            return
        try:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            path = folder / "document.sqlite"
            if path.exists() and path.stat().st_size > _LIMIT:
                path.unlink()
            self._base = sqlite3.connect(path, timeout=_WAIT, check_same_thread=False)
            self._base.execute("CREATE TABLE IF NOT EXISTS texts (key TEXT PRIMARY KEY, text BLOB)")
        except (OSError, sqlite3.Error):
            self._base = None

    def get(self, key: str) -> str | None:
        """The text of a key, ``None`` if it is not there or not whole."""
        if key in self._new:
            return self._new[key]
        if self._base is None:
            return None
        try:
            row = self._base.execute("SELECT text FROM texts WHERE key = ?", (key,)).fetchone()
            return None if row is None else zlib.decompress(row[0]).decode()
        except (sqlite3.Error, zlib.error, UnicodeDecodeError, TypeError):
            return None

    def put(self, key: str, text: str) -> None:
        """Remember a text; ``save`` writes it."""
        self._new[key] = text

    def alone(self) -> None:
        """Let go of the file: another process has it."""
        self._base, self._new = None, {}

    @property
    def new(self) -> dict[str, str]:
        """What was put since the last saving."""
        return self._new

    def save(self) -> None:
        """Write what is new in one go; if that does not work, it is not kept."""
        if self._base is None or not self._new:
            return
        rows = [(key, zlib.compress(text.encode(), 1)) for key, text in self._new.items()]
        try:
            with self._base:
                self._base.executemany("INSERT OR REPLACE INTO texts VALUES (?, ?)", rows)
        except sqlite3.Error:
            return
        self._new = {}


def kept(kind: str, content: bytes, make: Callable[[], str]) -> str:
    """The text that ``make`` makes from the content; made only where it is not kept."""
    name, texts = key(kind, content), store()
    text = texts.get(name)
    if text is None:
        text = make()
        texts.put(name, text)
    return text


@functools.cache
def store() -> Store:
    """The store of this machine's user."""
    return Store(_folder())


def key(kind: str, content: bytes) -> str:
    """Key of what a text of this kind is made from."""
    return hashlib.sha256(b"\0".join((_code(), kind.encode(), content))).hexdigest()


@functools.cache
def _code() -> bytes:
    """Fingerprint of the code and the libraries that make the texts."""
    versions = [f"{name} {metadata.version(name)}" for name in _LIBRARIES]
    digest = hashlib.sha256("\n".join([sys.version, *versions]).encode())
    for source in sorted(Path(__file__).parent.rglob("*.py")):
        digest.update(source.read_bytes())
    return digest.digest()


def _folder() -> Path | None:
    given = os.environ.get("KSHM_CACHE")
    if given is not None:
        return Path(given) if given else None
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA")
        return Path(base) / "kshm" / "cache" if base else None
    base = os.environ.get("XDG_CACHE_HOME")
    try:
        return (Path(base) if base else Path.home() / ".cache") / "kshm"
    except RuntimeError:  # nobody's home
        return None
