"""Links of Markdown pages that lead nowhere: files and headings."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path
from urllib.parse import unquote

from markdown_it import MarkdownIt
from markdown_it.token import Token

_NOT_WORD = re.compile(r"[^\w\- ]")


def broken_links(pages: Iterable[Path]) -> list[str]:
    """``page: link`` for each link whose file or heading is missing; web addresses are not asked.

    Args:
        pages: Markdown files.
    """
    return [
        f"{page.name}: {link}" for page in pages for link in _links(page) if _broken(page, link)
    ]


def anchors(page: Path) -> set[str]:
    """Anchors of the page's headings, as code hosts and ``tools.manual.site`` make them."""
    tokens = MarkdownIt().enable("table").parse(page.read_text(encoding="utf-8"))
    return {slug(_plain(text)) for head, text in pairwise(tokens) if head.type == "heading_open"}


def slug(heading: str) -> str:
    """Anchor of a heading: small letters, words joined by hyphens, no other marks."""
    return _NOT_WORD.sub("", heading.strip().lower()).replace(" ", "-")


def _plain(token: Token) -> str:
    children = token.children or ()
    return "".join(child.content for child in children if child.type in ("text", "code_inline"))


def _links(page: Path) -> Iterator[str]:
    tokens = MarkdownIt().enable("table").parse(page.read_text(encoding="utf-8"))
    for token in tokens:
        for child in token.children or ():
            target = child.attrGet("href") or child.attrGet("src")
            if target is not None:
                yield unquote(str(target))


def _broken(page: Path, link: str) -> bool:
    if "://" in link or link.startswith("mailto:"):
        return False
    name, _, anchor = link.partition("#")
    target = page if not name else page.parent / name
    if not target.exists():
        return True
    return bool(anchor) and target.suffix == ".md" and anchor not in anchors(target)
