"""A model as one file of HTML: data, functions, scripts and fonts lie inside, nothing is asked."""

from __future__ import annotations

import io
import json
import re
import zipfile
from base64 import b64encode
from collections.abc import Iterator
from functools import lru_cache
from html import escape
from pathlib import Path
from string import Template
from typing import Any

from reports.live.pack import packed
from reports.model.blocks import Model
from reports.model.evaluation import Evaluation
from reports.shared.russian import fixed, written
from reports.workbook.caches import sheet_parts
from reports.workbook.cell_patch import without_caches
from reports.workbook.course import short_model
from reports.workbook.layout import INPUT_SHEET, Layout

Data = dict[str, Any]
_HERE = Path(__file__).parent
_STATIC = _HERE.parent / "web" / "static"
# Modules by their names; the page finds each by its map of imports.
_MODULES = {
    **{f"{name}.mjs": _STATIC / "vendor" / f"{name}.mjs" for name in ("preact", "htm")},
    **{f"{name}.js": _STATIC / f"{name}.js" for name in
       ("common", "drawn", "scene", "fields", "calculator", "numbers", "takeaway", "view")},
    "live.js": _HERE / "live.js",
}  # fmt: skip
_CHARTS = ("chart.umd.min.js", "hammer.min.js", "chartjs-plugin-zoom.min.js")
_IMPORT = re.compile(r"""((?:from|import)\s*\(?\s*["'])(?:\./)?(?:vendor/)?([\w.-]+\.m?js["'])""")
_FONT = re.compile(r"url\(vendor/([\w-]+\.woff2)\)")
_END = re.compile(r"</(?=script)", re.IGNORECASE)
_SUMMARY = "summary"  # begins the names of the lists of results


def live_page(model: Model, book: bytes, stem: str) -> bytes:
    """Return the page of a checked engine.

    Args:
        model: all tables of the engine.
        book: the workbook that the page carries.
        stem: what its files are called.
    """
    short = short_model(model)
    pack = packed(model, short)
    data = {**pack.data, "file": stem, "book": _book(short, book)}
    modules = {"program.js": _address(pack.script), "fine.js": _address(pack.fine_script)}
    summary = "\n".join(_summary(model, data, Evaluation(model)))
    text = Template((_HERE / "page.html").read_text("utf-8")).substitute(
        name=escape(data["name"]), about=escape(_about(model, data), quote=True),
        summary=summary, style=_style(), charts=_chart_scripts(),
        data=_inside(json.dumps(data, ensure_ascii=False, separators=(",", ":"))),
        gate=(_STATIC / "gate.js").read_text("utf-8"),
        modules=json.dumps({**_modules(), **modules}, separators=(",", ":")),
    )  # fmt: skip
    return text.encode()


def _book(model: Model, book: bytes) -> Data:
    """Return the workbook and where the cells of its inputs are."""
    layout = Layout.of(model)
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        part = sheet_parts(archive)[INPUT_SHEET]
    cells = {field.name: layout.cells[field.name].coordinate for field in model.inputs}
    return {"part": part, "cells": cells, "data": b64encode(without_caches(book)).decode()}


def _summary(model: Model, data: Data, evaluation: Evaluation) -> Iterator[str]:
    """Key numbers, lists of results and verdicts as plain HTML."""
    numbers = ((each["title"], each["key"]) for each in data["numbers"])
    yield from _table("Главные числа", [_line(*each, model, evaluation) for each in numbers])
    for sheet in data["sheets"]:
        for block in sheet["blocks"]:
            if block["kind"] == "list" and block["id"].startswith(_SUMMARY):
                rows = [_line(row["title"], row["key"], model, evaluation) for row in block["rows"]]
                yield from _table(block["title"], rows)
    rows = [(each["title"], fixed(float(evaluation.value(each["value"])), 4),
             str(evaluation.value(each["key"]))) for each in data["checks"]]  # fmt: skip
    yield from _table("Проверки", rows)


def _about(model: Model, data: Data) -> str:
    """Key numbers in a line: what a link to the page says of it."""
    value = Evaluation(model)
    lines = (_line(each["title"], each["key"], model, value) for each in data["numbers"])
    return "; ".join(f"{title.lower()} {text} {unit}".strip() for title, text, unit in lines)


def _line(
    title: str, key: str, model: Model, evaluation: Evaluation
) -> tuple[str, str, str]:  # fmt: skip
    of, value = model.scalars[key].quantity, evaluation.value(key)
    text = value if isinstance(value, str) else written(float(value), of.digits)
    return title, text, of.unit_label


def _table(caption: str, rows: list[tuple[str, str, str]]) -> Iterator[str]:
    yield f"<table><caption>{escape(caption)}</caption>"
    for row in rows:
        cells = zip(row, ("", "n", "s"), strict=True)
        tds = "".join(f'<td class="{name}">{escape(text)}</td>' for text, name in cells)
        yield f"<tr>{tds}</tr>"
    yield "</table>"


def _inside(text: str) -> str:
    """Return a text that does not end the script that it lies in."""
    return _END.sub(r"<\\/", text)


def _address(script: str) -> str:
    """Return a module as the address of its text; imports name modules by the page's map."""
    plain = _IMPORT.sub(r"\1\2", script)
    return "data:text/javascript;base64," + b64encode(plain.encode()).decode()


@lru_cache(maxsize=1)
def _modules() -> dict[str, str]:
    return {name: _address(path.read_text("utf-8")) for name, path in _MODULES.items()}


@lru_cache(maxsize=1)
def _style() -> str:
    """Return the page's style with its fonts."""

    def font(match: re.Match[str]) -> str:
        data = b64encode((_STATIC / "vendor" / match[1]).read_bytes()).decode()
        return f"url(data:font/woff2;base64,{data})"

    return _FONT.sub(font, (_STATIC / "style.css").read_text("utf-8"))


@lru_cache(maxsize=1)
def _chart_scripts() -> str:
    """Return the libraries of charts; an old browser does not read them."""
    texts = (_inside((_STATIC / "vendor" / name).read_text("utf-8")) for name in _CHARTS)
    return "\n".join(f"<script>{text}</script>" for text in texts)
