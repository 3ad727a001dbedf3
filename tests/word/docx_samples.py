"""Word files of samples with the pages that they are made from, made once for all tests."""

from __future__ import annotations

import io
import re
import zipfile
from contextlib import ExitStack
from functools import lru_cache
from unittest import mock

import lxml.html
from lxml import etree

from reports.document.page import numbering
from reports.document.page.style import Style
from reports.document.report import Report
from reports.inputs.load import load_text
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from reports.word import pictures
from reports.word.pictures import picture
from reports.word.write import from_page
from tests.cover import ALL
from tests.document.report_samples import BOX
from tests.kept import kept

W = "{http://schemas.openxmlformats.org/wordprocessingml/2006/main}"
M = "{http://schemas.openxmlformats.org/officeDocument/2006/math}"
NAME = "gots-p3"  # whose file is looked at closely; its PDF is set for other tests too
# All that a department may ask for at once.
DEPARTMENT = {
    "font_size_pt": 12, "line_spacing": 1.2, "indent_cm": 1.0,
    "frame": "eskd", "numbering": "chapter", "table_continuation": True, "frame_from": 2,
    "appendix": "Приложение", "heading_before_pt": 21, "formula_space_pt": 9,
}  # fmt: skip
NUMBER = re.compile(r"\d+(?:,\d+)?")


@lru_cache(maxsize=4)
def model_of(name: str):
    text = (samples_dir() / f"{name}.toml").read_text(encoding="utf-8")
    model = build_model(load_text(text, source=f"{name}.toml").model)
    return model, evaluate_model(model)


@lru_cache(maxsize=4)
def page_of(name: str, **style: object) -> str:
    """The page as the PDF has it, with tables cell by cell.

    Figures are boxes, but of the sample that is looked at: the file holds no text of them, and
    to draw them takes most of the time.
    """
    return _page(name, **style) if style else _usual_page(name).decode()


@kept
def _usual_page(name: str) -> bytes:
    return _page(name).encode()


def _page(name: str, **style: object) -> str:
    look = Style(tagged_tables=True, **style)
    with ExitStack() as stack:
        if not (ALL or name == NAME):
            stack.enter_context(mock.patch.object(numbering, "drawn", lambda plan: BOX))
        return Report(*model_of(name), style=look).page("print")


@kept
def docx_of(name: str) -> bytes:
    """The file that ``report_docx`` makes, of the page that is there already."""
    return styled(name)


@kept
def department(name: str) -> bytes:
    """The file in a style of its own."""
    return styled(name, **DEPARTMENT)


def styled(name: str, **style: object) -> bytes:
    """The file in another style; its pictures as dots, but for the sample that is looked at.

    They are drawn for programs that show no SVG, hold no text and take half of the time.
    """
    # Without the words over further sheets, which the page has not.
    look = Style(tagged_tables=True, **{"table_continuation": False} | style)
    with ExitStack() as stack:
        if not (ALL or (name == NAME and not style)):
            dot = picture('<svg xmlns="http://www.w3.org/2000/svg" width="1" height="1"/>', 1)
            stack.enter_context(mock.patch.object(pictures, "picture", lambda svg, width: dot))
        return from_page(page_of(name, **style), look)


def part(data: bytes, name: str = "word/document.xml") -> etree._Element:
    with zipfile.ZipFile(io.BytesIO(data)) as parts:
        return etree.fromstring(parts.read(name))


def root_of(page: str):
    return lxml.html.document_fromstring(page)


def text_of(element: etree._Element) -> str:
    """Text with equations in order, without the instructions of fields."""
    return "".join(e.text or "" for e in element.iter(f"{W}t", f"{M}t"))
