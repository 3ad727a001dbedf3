"""Write the generated pages of ``docs/`` and find those that are out of date."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from reports.shared.files import write_text
from reports.validation.book import validate
from reports.validation.markdown import markdown
from tools.manual.drawings import write_drawings
from tools.manual.input_page import input_page
from tools.manual.sheets_page import sheets_page

GENERATED: Mapping[str, Callable[[], str]] = {
    "input.md": input_page,
    "sheets.md": sheets_page,
    "validation.md": lambda: markdown(validate()),
}


def write_pages(docs: Path) -> list[Path]:
    """Write every generated page and drawing anew; return those that changed."""
    changed = write_drawings(docs / "images")
    for name, text in pages().items():
        path = docs / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            write_text(path, text)
            changed.append(path)
    return changed


def pages() -> dict[str, str]:
    """Names and texts of the generated pages."""
    return {name: make() for name, make in GENERATED.items()}
