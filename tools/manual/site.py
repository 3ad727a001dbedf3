"""The pages of ``docs/`` as HTML files that are read without a network."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from urllib.parse import unquote

from markdown_it import MarkdownIt
from markdown_it.token import Token

from reports.shared.files import write_text

_PICTURES = (".png", ".svg", ".webp")
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


README = "README.ru.md"


def write_site(docs: Path, target: Path) -> list[Path]:
    """Write an HTML file for each page and copy the pictures; return the files.

    Args:
        docs: Folder of the Markdown pages; the Russian README beside it is a page too.
        target: Folder of the HTML, made when it is not there.
    """
    target.mkdir(parents=True, exist_ok=True)
    pages = {page.resolve(): f"{page.stem}.html" for page in sorted(docs.glob("*.md"))}
    pages[(docs.parent / README).resolve()] = "readme.html"
    contents = [(name, _title(page)) for page, name in pages.items() if page.stem != "index"]
    for page, name in pages.items():
        write_text(target / name, _html(page, pages, contents))
    pictures = [each for each in (docs / "images").iterdir() if each.suffix in _PICTURES]
    for picture in sorted(pictures):
        (target / "images").mkdir(exist_ok=True)
        shutil.copyfile(picture, target / "images" / picture.name)
    return [target / name for name in pages.values()]


def _title(page: Path) -> str:
    first = page.read_text(encoding="utf-8").split("\n", 1)[0]
    return first.removeprefix("# ")


def _html(page: Path, pages: Mapping[Path, str], contents: list[tuple[str, str]]) -> str:
    from jinja2 import Environment, FileSystemLoader
    from markupsafe import Markup

    from reports.shared.resources import templates_dir

    markdown = MarkdownIt("commonmark", {"html": False}).enable(["table"])
    tokens = markdown.parse(page.read_text(encoding="utf-8"))
    _mend(tokens, page, pages)
    body = markdown.renderer.render(tokens, markdown.options, {})
    env = Environment(loader=FileSystemLoader(templates_dir() / "manual"), autoescape=True)
    return env.get_template("page.html.j2").render(
        title=_title(page), body=Markup(body), contents=contents, current=pages[page]
    )


def _mend(tokens: list[Token], page: Path, pages: Mapping[Path, str]) -> None:
    """Give headings their anchors and lead links to the HTML pages."""
    for index, token in enumerate(tokens):
        if token.type == "heading_open":
            inner = tokens[index + 1].children or ()
            text = "".join(c.content for c in inner if c.type in ("text", "code_inline"))
            token.attrSet("id", slug(text))
        for child in token.children or ():
            target = child.attrGet("href")
            if target is not None:
                child.attrs = (
                    {"href": collected} if (collected := _href(str(target), page, pages)) else {}
                )
            source = str(child.attrGet("src") or "")
            if "/images/" in source:  # of the README, which stands above the pages
                child.attrSet("src", "images/" + Path(source).name)


def _href(link: str, page: Path, pages: Mapping[Path, str]) -> str:
    """Where a link leads on the site, empty if to a file that is not on it."""
    if "://" in link or link.startswith("#"):
        return link
    name, mark, anchor = link.partition("#")
    actual = pages.get((page.parent / unquote(name)).resolve())
    return "" if actual is None else actual + mark + anchor
