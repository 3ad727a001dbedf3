"""The pages people read, and the blocks of code that stand in them."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
READMES = (ROOT / "README.md", ROOT / "README.ru.md")
PAGES = (*READMES, *sorted(DOCS.glob("*.md")))
_BLOCK = re.compile(r"^ *```(?P<kind>\w+)\n(?P<text>.*?)^ *```", re.M | re.S)


def blocks(page: Path, kind: str) -> list[str]:
    """Texts of the fenced blocks of a kind, in order."""
    matches = _BLOCK.finditer(page.read_text(encoding="utf-8"))
    return [match["text"] for match in matches if match["kind"] == kind]


def commands(page: Path) -> list[str]:
    """Command lines of the page's shell blocks, continued lines joined."""
    lines = "".join(blocks(page, "sh")).replace("\\\n", " ").splitlines()
    return [" ".join(line.split()) for line in lines if line.strip()]
