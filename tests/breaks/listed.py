"""The list of breaks as data."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True, slots=True)
class Break:
    """What stands in a file, what is put in its place, the tests that must fail."""

    about: str
    file: str
    stands: str
    put: str
    tests: str


def breaks() -> list[Break]:
    """All of them."""
    text = (Path(__file__).parent / "breaks.toml").read_text(encoding="utf-8")
    return [Break(**entry) for entry in tomllib.loads(text)["break"]]
