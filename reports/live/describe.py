"""What a live page shows of a model as plain data: fields, tables, charts, checks, mechanism."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby
from typing import Any

import numpy as np

from kshm import quantity
from kshm.nomenclature.quantity import Quantity
from reports.document.figures.canvas import by_direction
from reports.document.text.symbols import indexed
from reports.inputs.fields import Field, key_text, to_mapping
from reports.inputs.messages import explain
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import Block, Column, Grid, Held, Model, Scalar, ScalarTable, TableSpec
from reports.model.charts import ChartSpec
from reports.model.shape import WORST_PIN, Shape
from reports.tables.verdicts import reasons_of
from reports.workbook.chapters import chapter_of, contents_for, heading, ordered
from reports.workbook.chart_parts import COLOURS

Data = dict[str, Any]
JOINTS, SIZES = "live_joints", "live_sizes"  # the block of what the mechanism is drawn from
FINE_DEG = 1  # step of the curves
FORCES = ("Pg_MPa", "Pj_MPa", "Ps_MPa", "N_MPa", "S_MPa", "K_MPa", "T_MPa")
_PAGES_OF_INPUT = ("report", "workbook", "prototype", "variants", "checks")
# Angles that fix each other: one alone makes no engine.
_PHASES = re.compile(
    r"(firing_offset|throw_angle|force_offset)_\d+_deg|crankshaft_(bank_angle|split_pin)_deg"
)
_MAIN = ("geometry_bore_mm", "geometry_stroke_mm", "geometry_crank_radius_mm",
         "geometry_rod_length_mm", "geometry_lambda", "regime_speed_rpm",
         "gas_max_pressure_mpa", "cycle_pressure_ratio")  # fmt: skip
_MAX_MAIN = 5
_CHART = ("id", "sheet", "title", "kind", "x_title", "y_title", "x_is_angle", "x_reversed",
          "y_reversed")  # fmt: skip
_PINS = r"crankpin(_\d+)?\.Krod_MPa"
_FIRST = (r"P4_2\.Msum_Nm", _PINS, r"P4_1\.Ps_MPa", r"gas\.p_MPa")
_KEY_NUMBERS = (r"N_e_calc", r"M_mean", r"M_max", r"Rpin\d*_max")
_ODD = -1234.5  # a number that no sentence has


def fields(model: Model, used: frozenset[str]) -> Iterator[Data]:
    """Yield groups of fields: those that the page changes, and those that only a build can."""
    listed = [each for each in model.inputs if each.path[0] not in _PAGES_OF_INPUT]
    for section, group in groupby(listed, key=lambda each: each.section):
        entries = [_field(each, used) for each in group if each.name in used or each.structural]
        if entries:
            key = f"{section} {entries[0]['key']}"
            yield {"title": section, "key": key, "path": None, "entries": [entries],
                   "whole": None, "drawing": ""}  # fmt: skip


def is_free(field: Field) -> bool:
    """Whether a page changes a field."""
    if field.structural or _PHASES.fullmatch(field.name):
        return False
    return field.choices is not None or isinstance(field.value, int | float)


def _field(field: Field, used: frozenset[str]) -> Data:
    return {
        "path": field.path, "key": key_text(field.path), "cell": field.name, "title": field.title,
        "symbol": field.symbol, "unit": field.unit, "value": field.value, "min": field.minimum,
        "max": field.maximum, "choices": field.choices, "optional": False,
        "number": field.choices is None, "whole": isinstance(field.value, int),
        "fixed": field.name not in used or not is_free(field),
    }  # fmt: skip


def sentences() -> dict[str, str]:
    """Return what ``check`` says of a value, ``{}`` in place of the value."""
    said: dict[str, str] = {}
    for key, fault, value, printed in (("limit", "less_than_equal", _ODD, "-1234.5"),
                                     ("number", "float_type", "{}", "«{}»"),
                                     ("whole", "int_from_float", _ODD, "-1234.5")):  # fmt: skip
        error: Any = {"type": fault, "input": value}
        said[key] = explain(error, None)[0].replace(printed, "{}")
    return said


def main_fields(model: Model) -> list[str]:
    """Keys of the fields that stand first."""
    names = [name for name in _MAIN if name in model.fields and is_free(model.fields[name])]
    return [key_text(model.fields[name].path) for name in names[:_MAX_MAIN]]


def sheets(model: Model) -> list[Data]:
    """Tables of the short book by sheets, in the book's order."""
    contents = contents_for(model)
    titles = [sheet for sheet in model.sheets if sheet not in model.folded]
    return [
        {"title": sheet, "heading": heading(sheet, contents),
         "chapter": chapter_of(sheet, contents).title,
         "blocks": [_block(each) for each in model.blocks
                    if each.sheet == sheet and not getattr(each, "helper", False)]}
        for sheet in ordered(titles, contents)
    ]  # fmt: skip


def _block(block: Block) -> Data:
    more: Data = {"id": block.id, "title": block.title, "note": block.note}
    if isinstance(block, TableSpec):
        columns = [each for each in block.columns if not each.helper]
        return {**more, "kind": "table", "number": block.number,
                "columns": [_column(block.id, each) for each in columns]}  # fmt: skip
    if isinstance(block, Grid):
        rows = [{**_about(row.quantity), "cells": [cell and cell.key for cell in row.cells]}
                for row in block.rows]  # fmt: skip
        return {**more, "kind": "grid", "labels": block.labels, "rows": rows}
    if block.held is not None:
        return {**more, "kind": "verdicts", "rows": list(_verdicts(block))}
    return {**more, "kind": "list", "rows": [_row(each) for each in block.scalars]}


def _column(table: str, column: Column) -> Data:
    return {"key": f"{table}.{column.key}", **_about(column.quantity)}


def _row(scalar: Scalar) -> Data:
    quantity = _about(scalar.quantity)
    return {"key": scalar.key, **quantity, "title": scalar.note or quantity["title"]}


def _verdicts(block: ScalarTable) -> Iterator[Data]:
    assert block.verdicts is not None
    for value, verdict in block.pairs:
        yield {"key": verdict.key, "value": value.key, "title": value.label,
               "good": block.verdicts[0], "odd": block.held is Held.USUAL}  # fmt: skip


def _about(of: Quantity) -> Data:
    digits = of.digits
    return {"title": of.title, "symbol": symbol(of), "unit": of.unit_label,
            "digits": [digits.kind, digits.decimals, digits.hides]}  # fmt: skip


def symbol(of: Quantity) -> str:
    """Return a symbol as the page writes it, its index behind an underscore."""
    return indexed(of.tex, of.symbol)


def checks(model: Model) -> list[Data]:
    """Return what is judged, with the reasons that the input gives."""
    reasons = reasons_of(model.input)
    return [
        {**each, "reason": reasons.get(each["key"].partition("_")[2], "")}
        for block in model.blocks if isinstance(block, ScalarTable) and block.held is not None
        for each in _verdicts(block)
    ]  # fmt: skip


def key_numbers(model: Model) -> list[Data]:
    """Return the four numbers of an engine; of several pins ``of`` says whose ``alike`` is told."""
    numbers = []
    for pattern in _KEY_NUMBERS:
        rows = [{**_row(scalar), "at": _angle_of(key, model)}
                for key, scalar in model.scalars.items() if re.fullmatch(pattern, key)]  # fmt: skip
        several = {"alike": rows, "of": WORST_PIN} if len(rows) > 1 else {}
        numbers += [{**row, **several} for row in rows[:1]]
    return numbers


def _angle_of(key: str, model: Model) -> str | None:
    """Return the key of the angle of a largest value."""
    at = f"phi_{key}_deg"
    return at if at in model.scalars else None


def charts(model: Model) -> list[Data]:
    """Charts of the book; ``first`` are those of the engine, ``pin`` whose it is."""
    drawn = [each for each in model.charts if each.sheet]
    ranks: dict[str, Data] = {}
    for rank, pattern in enumerate(_FIRST, 1):
        alike = [c.id for c in drawn if any(re.fullmatch(pattern, s.y) for s in c.series)]
        several = pattern == _PINS and len(alike) > 1
        for pin, name in enumerate(alike if several else alike[:1], 1):
            ranks[name] = {"first": rank} | ({"pin": pin, "of": WORST_PIN} if several else {})
    return [{**_chart(each, model), **ranks.get(each.id, {"first": 0})} for each in drawn]


def _chart(chart: ChartSpec, model: Model) -> Data:
    lines = [line for line in chart.drawn_by("workbook") if not line.invisible]
    return {
        **{key: getattr(chart, key) for key in _CHART},
        "contact": [[key.lstrip("-"), -1 if key[0] == "-" else 1] for key in chart.contact],
        "lines": [{"name": line.name or _name(line.y, model), "x": line.x, "y": line.y}
                  for line in lines],
        "loads": chart.kind == "polar" and "pin" in lines[0].x,
    }  # fmt: skip


def _name(key: str, model: Model) -> str:
    node = model.nodes.get(key) or model.grid_rows.get(key)
    return symbol(node.quantity) if node is not None else ""


def keys_of(chart: Data) -> Iterator[str]:
    """Yield what a chart is drawn from."""
    for line in chart["lines"]:
        yield from (line["x"], line["y"])
    yield from (key for key, _ in chart["contact"])


def with_joints(model: Model) -> Model:
    """Return model with the places of pins and the sizes that a moving mechanism is drawn from."""
    turn, shape = model.tables["P3_1"], Shape.of(model.input)
    angle = replace(turn.columns[0], every="360")
    across = "to_mm(k_offset*r_crank)" if shape.offset else "0*phi_deg"
    offset = " - k_offset*r_crank" if shape.offset else ""
    columns = [
        angle,
        Column("pin_x", "to_mm(r_crank*sin(rad(phi_deg)))"),
        Column("pin_y", "to_mm(r_crank*cos(rad(phi_deg)))"),
        Column("piston_x", across),
        Column("piston_y", "to_mm(r_crank*cos(rad(phi_deg))"
               f" + sqrt(L_rod**2 - (r_crank*sin(rad(phi_deg)){offset})**2))"),
    ]  # fmt: skip
    if shape.articulated:
        columns += [Column("hung_x", "articulated.across_mm"),
                    Column("hung_y", "articulated.along_mm"),
                    Column("hung_piston_y", "to_mm(articulated.y)")]  # fmt: skip
    table = TableSpec(JOINTS, "", "", turn.sheet, tuple(columns), turn.rows, helper=True)
    wall = "geometry_crank_offset_mm" if "geometry_crank_offset_mm" in model.fields else "0"
    sizes = (Scalar("live_radius_mm", "to_mm(r_crank)"), Scalar("live_wall_mm", wall),
             Scalar("live_bore_mm", "to_mm(sqrt(4*F_piston/pi))"))  # fmt: skip
    return replace(model, blocks=(*model.blocks, table, ScalarTable(SIZES, "", turn.sheet, sizes)))


def scene(model: Model) -> Data:
    """Return what stands still of a moving mechanism, and the keys of the rest."""
    shape = Shape.of(model.input)
    tables = ["P4_1", *(f"cylinder_{i}" for i in shape.numbers if i > 1)]
    forces = [key for key in FORCES if all(f"{each}.{key}" in model.nodes for each in tables)]
    hung = [shape.is_hung(i) for i in shape.numbers]
    pins = [f"{JOINTS}.{key}" for key in ("pin_x", "pin_y")]
    links = [f"{JOINTS}.{key}" for key in ("hung_x", "hung_y")]
    kinds = {False: [pins, [f"{JOINTS}.piston_x", f"{JOINTS}.piston_y"]],
             True: [pins, links, [f"{JOINTS}.piston_x", f"{JOINTS}.hung_piston_y"]]}  # fmt: skip
    order = sorted({*hung})
    return {
        "tables": tables, "joints": [kinds[each] for each in order],
        "each": [{"axis": float(np.degrees(one.axis)), "rod": order.index(is_hung)}
                 for one, is_hung in zip(shape.arrangement, hung, strict=True)],
        "forces": {key: {"symbol": symbol(quantity(key)), "unit": quantity(key).unit_label}
                   for key in forces},
        "throws": list(by_direction(model.input.crankshaft.throw_angles_deg)),
    }  # fmt: skip


def scene_keys(of: Data) -> Iterator[str]:
    """Yield what the mechanism reads."""
    yield from ("P3_1.phi_deg", "P4_1.phi_deg", "P4_1.Pg_MPa", "live_radius_mm", "live_wall_mm",
                "live_bore_mm")  # fmt: skip
    yield from (key for kind in of["joints"] for joint in kind for key in joint)
    for number, table in enumerate(of["tables"]):
        yield from (f"{table}.{key}" for key in of["forces"])
        if number:
            yield f"{table}.phase_deg"


def about(model: InputFile) -> Data:
    """Name and values of an input."""
    return {"name": model.engine.name, "raw": to_mapping(model), "strokes": model.engine.strokes,
            "palette": COLOURS}  # fmt: skip
