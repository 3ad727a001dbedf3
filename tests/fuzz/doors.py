"""The three doors; each takes any bytes and must answer with a result or a Russian message."""

from __future__ import annotations

import json
import re
import tempfile
import warnings
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from kshm import solve
from reports.grading.issuing.issue import assignment_for, issue
from reports.grading.judging.marking import Marker
from reports.grading.pages.pages import student_page
from reports.grading.reading.submissions import Submission
from reports.inputs.load import Loaded, load_toml
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.errors import KshmError
from reports.shared.resources import samples_dir
from reports.workbook.read import load_workbook_input
from tests.fuzz.recipes import changed_book, parts_of
from tests.grading.fill import filled_book
from tests.workbook.made import coarse_book

_RUSSIAN = re.compile("[а-яё]", re.IGNORECASE)
_RANGES = '\n[variants]\n"geometry.bore_mm" = { min = 84, max = 92, step = 0.5 }\n'
_RUBRIC = '[work]\nfill = ["geometry", "P3_1"]\ngiven = []\n'


@lru_cache(maxsize=1)
def _kept() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory(prefix="kshm-fuzz-")


def folder() -> Path:
    """A place for the files of this process, gone with it."""
    return Path(_kept().name)


def one_toml(data: bytes) -> str:
    """``kshm check`` and ``kshm solve`` of a TOML file."""
    path = folder() / "engine.toml"
    path.write_bytes(data)
    return _answer(lambda: load_toml(path))


def one_workbook(data: bytes) -> str:
    """``kshm check`` and ``kshm solve`` of a workbook of ours that was edited."""
    path = folder() / "engine.xlsx"
    path.write_bytes(data if data.startswith(b"PK") else changed_book(_own_parts(), data))
    return _answer(lambda: load_workbook_input(path))


def one_submission(data: bytes) -> str:
    """``kshm grade`` of one file, without the process around it."""
    book = data if data.startswith(b"PK") else changed_book(_student_parts(), data)
    marker = _marker()
    result = marker.mark(Submission("работа.xlsx", Path("работа.xlsx"), None, None), book)
    json.dumps(result, ensure_ascii=False, allow_nan=False)
    page = student_page(result, marker.register.rubric)
    assert "<script" not in page.lower()
    assert result["status"] != "graded" or 0 <= result["points"] <= result["maximum"] + 0.01
    for text in result["manual"]:
        assert "\n" not in text, text
        assert _RUSSIAN.search(text), text
    return str(result["status"])


DOORS: dict[str, Callable[[bytes], str]] = {
    "toml": one_toml,
    "workbook": one_workbook,
    "grading": one_submission,
}


def _answer(load: Callable[[], Loaded]) -> str:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # a warning would stand between the messages
            solve(*engine_and_cycle(load().model))
    except KshmError as error:
        assert error.problems
        for line in error.lines():
            assert "\n" not in line, line
            assert _RUSSIAN.search(line), line
        return "refused"
    return "accepted"


@lru_cache(maxsize=1)
def _own_parts() -> dict[str, bytes]:
    """A workbook of ours without the parts that are never read: a tenth of the time."""
    parts = parts_of(coarse_book("gots-diesel"))
    workbook = parts["xl/workbook.xml"]
    sheets = re.findall(rb"<sheet [^>]*/>", workbook)
    kept = [sheet for sheet in sheets if "Исходные данные".encode() in sheet]
    relations = parts["xl/_rels/workbook.xml.rels"]
    for sheet in sheets:
        if sheet in kept:
            continue
        workbook = workbook.replace(sheet, b"")
        identifier = re.search(rb'r:id="([^"]+)"', sheet)
        assert identifier is not None
        for relation in re.findall(rb"<Relationship [^>]*/>", relations):
            if b'Id="' + identifier[1] + b'"' in relation:
                relations = relations.replace(relation, b"")
                target = re.search(rb'Target="/?(?:xl/)?([^"]+)"', relation)
                assert target is not None
                parts.pop("xl/" + target[1].decode())
    parts["xl/workbook.xml"] = re.sub(
        rb"<definedName [^>]*localSheetId=.*?</definedName>", b"", workbook
    )
    parts["xl/_rels/workbook.xml.rels"] = relations
    return _light(parts)


def _light(parts: dict[str, bytes]) -> dict[str, bytes]:
    """Without pictures, and without relations of sheets that are not there."""
    return {
        name: data
        for name, data in parts.items()
        if not re.search("chart|drawing|comment|theme", name)
        and ("_rels/sheet" not in name or name.replace("_rels/", "")[: -len(".rels")] in parts)
    }


@lru_cache(maxsize=1)
def _marker() -> Marker:
    """A class of one, with the same identifier in every process."""
    path = folder() / "class"
    path.mkdir()
    text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
    (path / "base.toml").write_text(
        text.replace("step_deg = 10", "step_deg = 30") + _RANGES, encoding="utf-8"
    )
    (path / "group.csv").write_text("Фамилия;Имя\nИванов;Имя\n", encoding="utf-8")
    (path / "rubric.toml").write_text(_RUBRIC, encoding="utf-8")
    (path / "key").write_text("5a" * 32 + "\n", encoding="ascii")
    done = issue(
        path / "base.toml", path / "group.csv", path / "issued", seed=1,
        rubric_file=path / "rubric.toml", secret_file=path / "key",
    )  # fmt: skip
    return Marker(done.register)


@lru_cache(maxsize=1)
def _student_parts() -> dict[str, bytes]:
    marker = _marker()
    book = marker.register.books[0]
    handout = (folder() / "class" / "issued" / book.folder / book.file).read_bytes()
    filled = filled_book(handout, assignment_for(book, marker.register.rubric))
    parts = parts_of(filled)
    return _light(parts)
