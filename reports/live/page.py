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

from reports.formula.javascript import LIBRARY
from reports.live import describe
from reports.live.program import CALCULATOR, LiveProgram, program_of
from reports.model.blocks import Model, nodes_in
from reports.model.evaluation import Evaluation
from reports.shared.russian import fixed, written
from reports.tables.registry import build_model
from reports.workbook.caches import sheet_parts
from reports.workbook.cell_patch import without_caches
from reports.workbook.course import short_model
from reports.workbook.layout import INPUT_SHEET, Layout

Data = dict[str, Any]
_HERE = Path(__file__).parent
_STATIC = _HERE.parent / "web" / "static"
# Modules by their names; the page finds each by its map of imports.
_MODULES = {
    "preact.mjs": _STATIC / "vendor" / "preact.mjs", "htm.mjs": _STATIC / "vendor" / "htm.mjs",
    "common.js": _STATIC / "common.js", "drawn.js": _STATIC / "drawn.js",
    "scene.js": _STATIC / "scene.js", "fields.js": _STATIC / "fields.js",
    "functions.js": LIBRARY, "calculator.js": CALCULATOR,
    "numbers.js": _HERE / "numbers.js", "takeaway.js": _HERE / "takeaway.js",
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
    data, modules = _data(model, book, stem)
    summary = "\n".join(_summary(model, data, Evaluation(model)))
    text = Template((_HERE / "page.html").read_text("utf-8")).substitute(
        name=escape(data["name"]), summary=summary, style=_style(), charts=_chart_scripts(),
        data=_inside(json.dumps(data, ensure_ascii=False, separators=(",", ":"))),
        gate=(_HERE / "gate.js").read_text("utf-8"),
        modules=json.dumps({**_modules(), **modules}, separators=(",", ":")),
    )  # fmt: skip
    return text.encode()


def _data(model: Model, book: bytes, stem: str) -> tuple[Data, dict[str, str]]:
    """Return the data of the page and the modules of its programs."""
    short, drawn = short_model(model), describe.with_joints(model)
    charts, scene = describe.charts(short), describe.scene(drawn)
    curves = [key for chart in charts for key in describe.keys_of(chart)]
    program = program_of(model, (*short.nodes, *curves))
    fine_model = describe.with_joints(_fine(model))
    nodes = [key for key in curves if key in fine_model.nodes and key not in program.fixed]
    fine = program_of(fine_model, (*nodes, *describe.scene_keys(scene)))
    used = frozenset(program.inputs_read | fine.inputs_read)
    fields = list(describe.fields(model, used))
    data = {
        **describe.about(model.input), "file": stem, "fields": fields,
        "main": describe.main_fields(model), "sentences": describe.sentences(),
        "sheets": describe.sheets(short), "checks": describe.checks(short), "charts": charts,
        "numbers": describe.key_numbers(short), "scene": scene, "remarks": model.remarks,
        "fixedTables": _fixed_tables(short, program), "program": program.data(),
        "fine": fine.data(), "book": _book(short, book),
    }  # fmt: skip
    return data, {"program.js": _address(program.script()), "fine.js": _address(fine.script())}


def _fine(model: Model) -> Model:
    """Return the same engine with the step of the curves."""
    calculation = model.input.calculation.model_copy(update={"step_deg": describe.FINE_DEG})
    return build_model(model.input.model_copy(update={"calculation": calculation}))


def _fixed_tables(model: Model, program: LiveProgram) -> list[str]:
    """Titles of the blocks that hold what only a build finds."""
    blocks = {key: block.title for block in model.blocks for key, _ in nodes_in(block)}
    return sorted({blocks[key] for key in program.fixed & blocks.keys()})


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

    texts = ((_STATIC / "style.css").read_text("utf-8"), (_HERE / "live.css").read_text("utf-8"))
    return _FONT.sub(font, "\n".join(texts))


@lru_cache(maxsize=1)
def _chart_scripts() -> str:
    """Return the libraries of charts; an old browser does not read them."""
    texts = (_inside((_STATIC / "vendor" / name).read_text("utf-8")) for name in _CHARTS)
    return "\n".join(f"<script>{text}</script>" for text in texts)
