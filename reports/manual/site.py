"""The pages of ``docs/`` as HTML files that are read without a network."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token

from reports.files import write_text
from reports.manual.links import slug

_PAGE_LINK = re.compile(r"^(?!\w+://)([\w./-]+)\.md(#.*)?$")


def write_site(docs: Path, target: Path) -> list[Path]:
    """Write an HTML file for each page and copy the pictures; return the files.

    Args:
        docs: Folder of the Markdown pages.
        target: Folder of the HTML, made when it is not there.
    """
    target.mkdir(parents=True, exist_ok=True)
    pages = sorted(docs.glob("*.md"))
    contents = [(page.stem, _title(page)) for page in pages if page.stem != "index"]
    written = []
    for page in pages:
        path = target / f"{page.stem}.html"
        write_text(path, _html(page, contents))
        written.append(path)
    for picture in sorted((docs / "images").glob("*.png")):
        (target / "images").mkdir(exist_ok=True)
        shutil.copyfile(picture, target / "images" / picture.name)
    return written


def _title(page: Path) -> str:
    first = page.read_text(encoding="utf-8").split("\n", 1)[0]
    return first.removeprefix("# ")


def _html(page: Path, contents: list[tuple[str, str]]) -> str:
    from jinja2 import Environment, FileSystemLoader
    from markupsafe import Markup

    from reports.resources import templates_dir

    markdown = MarkdownIt("commonmark", {"html": False}).enable(["table"])
    tokens = markdown.parse(page.read_text(encoding="utf-8"))
    _mend(tokens)
    body = markdown.renderer.render(tokens, markdown.options, {})
    env = Environment(loader=FileSystemLoader(templates_dir() / "manual"), autoescape=True)
    return env.get_template("page.html.j2").render(
        title=_title(page), body=Markup(body), contents=contents, current=page.stem
    )


def _mend(tokens: list[Token]) -> None:
    """Give headings their anchors, lead links to the HTML pages, let wide tables scroll."""
    for index, token in enumerate(tokens):
        if token.type == "heading_open":
            inner = tokens[index + 1].children or ()
            text = "".join(c.content for c in inner if c.type in ("text", "code_inline"))
            token.attrSet("id", slug(text))
        elif token.type == "table_open":
            token.attrSet("tabindex", "0")
        for child in token.children or ():
            target = child.attrGet("href")
            if target is not None:
                child.attrSet("href", _PAGE_LINK.sub(r"\1.html\2", str(target)))
