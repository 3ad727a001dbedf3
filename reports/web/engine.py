"""What the page of an engine asks for, as plain data: numbers, charts, checks, what moves.

These functions run in the workers of `reports.web.pool`; what they raise as `KshmError`
comes back as problems with the keys of their fields.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from kshm import quantity
from kshm.results.solution import Solution, in_units
from reports.inputs.checks.grid import grid_remark
from reports.inputs.fields import iter_fields, tables_shape, to_mapping
from reports.inputs.load import Loaded, load_mapping, load_text
from reports.inputs.own_engine import Made
from reports.inputs.own_file import file_text
from reports.inputs.ranges import split_ranges
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solved import solved
from reports.inputs.source import MAX_BYTES, refuse_bomb, refused
from reports.inputs.understood import understood
from reports.inputs.units import MM
from reports.shared.errors import InputError, KshmError, Problem
from reports.shared.russian import written
from reports.spec.blocks import Model, ScalarTable
from reports.spec.charts import ChartSpec
from reports.spec.evaluation import Evaluation
from reports.tables.overview.summary import NO
from reports.tables.overview.verdicts import reasons_of
from reports.tables.registry import build_model
from reports.web.fields import Data, absent, groups, without_foreign

HEAD = ("Исходные данные двигателя для kshm.",)
_DIGITS = 8  # of the greatest number of a curve: what no screen shows
_PATHS = ("style", "templates", "compare")  # keys of [report] that name files of the machine
_MODELS: dict[object, Model] = {}
_MOST_MODELS = 24
_MOST_ENTRIES = 10_000  # of a list: longer ones only hold a process up


def answered(function: Callable[..., Data], *arguments: Any) -> Data:  # noqa: ANN401
    """A function's answer, or its problems: a worker hands over no exceptions."""
    try:
        return function(*arguments)
    except KshmError as error:
        return {"errors": [as_dict(problem) for problem in error.problems]}
    except MemoryError:  # the heap may be in pieces: a new process takes over
        os._exit(1)
    except Exception as error:  # a bug costs one answer
        what = f"внутренняя ошибка {type(error).__name__}"
        return {"errors": [as_dict(Problem("", what, "сообщите о ней"))]}


def as_dict(problem: Problem) -> Data:
    """A problem as the page takes it."""
    return {"where": problem.where, "what": problem.what, "hint": problem.hint}


def read_toml(text: str) -> Data:
    """The mapping of a file's text, as the page keeps it.

    Raises:
        InputError: it is none, or names files that a page has not.
    """
    if not isinstance(text, str) or len(text.encode("utf-8", "replace")) > MAX_BYTES:
        raise refused("файл", "слишком большой", "это не файл исходных данных")
    refuse_bomb("файл", text)
    try:
        raw = tomllib.loads(text)
    except (ValueError, RecursionError):
        load_text(text, source="файл")  # knows the words for it
        raise
    return {"raw": split_ranges(raw)[0]}


def read_book(path: str) -> Data:
    """The mapping of the input that an edited workbook holds.

    Raises:
        InputError: it is no workbook of ours, or its cells are wrong.
    """
    from reports.workbook.read import load_workbook_input

    return {"raw": to_mapping(load_workbook_input(Path(path)).model)}


def checked_text(text: str) -> Data:
    """A base of variants, checked as an input of its own; its ranges are checked when issued.

    Raises:
        InputError: everything that is wrong.
    """
    loaded_of(understood(read_toml(text)["raw"]))
    return {}


def loaded_of(raw: Mapping[str, Any]) -> Loaded:
    """A checked input whose problems are named by keys alone.

    Raises:
        InputError: everything that is wrong, files of this machine that it names among it.
    """
    loaded = load_mapping(_bounded(raw), source="")
    named = [key for key in _PATHS if getattr(loaded.model.report, key)]
    if named:
        what, hint = "страница не читает файлов с диска", "уберите ключ; команде kshm он доступен"
        raise InputError([Problem(f"report.{key}", what, hint) for key in named])
    return loaded


def _bounded(raw: Mapping[str, Any]) -> Mapping[str, Any]:
    """The same mapping, refused before anything counts the entries of an endless list."""
    for name, part in raw.items():
        for key, value in part.items() if isinstance(part, dict) else [("", part)]:
            if isinstance(value, list | tuple) and len(value) > _MOST_ENTRIES:
                what = f"в списке {len(value)} строк"
                place = f"{name}.{key}".rstrip(".")
                raise InputError(Problem(place, what, f"допустимо не больше {_MOST_ENTRIES}"))
    return raw


def _model_for(model: InputFile) -> Model:
    """The tables of an input; those of one shape are made once."""
    fields = tuple(iter_fields(model))
    shape = tables_shape(fields)
    known = _MODELS.get(shape)
    if known is not None:
        return known.with_inputs(model, fields)
    if len(_MODELS) >= _MOST_MODELS:
        _MODELS.pop(next(iter(_MODELS)))
    made = _MODELS[shape] = build_model(model)
    return made


def start(raw: Mapping[str, Any]) -> Data:
    """Fields of an input in groups, its charts by sheets, and the input as it was understood.

    What is wrong with its values stands among the errors; the fields are shown all the same.

    Raises:
        InputError: a list is too long to be shown.
    """
    plain = without_foreign(understood(_bounded(raw)))
    found: Data = {"sheets": [], "errors": []}
    try:
        model = loaded_of(plain).model
    except InputError as error:
        found["errors"] = [as_dict(problem) for problem in error.problems]
    else:
        plain, sheets = to_mapping(model), dict[str, str]()
        for chart in _model_for(model).charts:
            sheets.setdefault(chart.sheet, chart.title)
        found["sheets"] = [{"id": name, "title": name or "Прочее", "hint": title}
                           for name, title in sheets.items()]  # fmt: skip
    return {"raw": plain, "groups": list(groups(plain)), "absent": absent(plain), **found}


def answer(raw: Mapping[str, Any], sheet: str, cylinder: int = 0) -> Data:
    """Numbers of an engine, the charts of a sheet, what moves, what is odd about the input."""
    loaded = loaded_of(raw)
    model, solution = _model_for(loaded.model), solved(loaded.model)
    formulas = Evaluation(model)
    return {
        "errors": [],
        "warnings": [as_dict(problem) for problem in loaded.warnings],
        "accepted": [each.line() for each in loaded.accepted],
        "results": list(_results(model, solution)),
        "charts": [_chart(chart, solution, formulas)
                   for chart in model.charts if chart.sheet == sheet],
        "moves": moving(solution, cylinder),
    }  # fmt: skip


def _results(model: Model, solution: Solution) -> Iterator[Data]:
    """The summaries of workbook and report with the solver's numbers."""
    for block in model.blocks:
        if isinstance(block, ScalarTable) and block.id.startswith(("summary", "geometry")):
            rows = []
            for scalar in block.scalars:
                value, about = _scalar(solution, scalar.key), scalar.quantity
                if value is not None:
                    rows.append({
                        "key": scalar.key, "title": scalar.note or about.title,
                        "symbol": about.symbol, "unit": about.unit_label,
                        "value": value, "text": written(value, about.digits),
                    })  # fmt: skip
            if rows:
                yield {"id": block.id, "title": block.title, "rows": rows}


def _scalar(solution: Solution, key: str) -> float | None:
    """A scalar of the solver in the unit of its quantity; most are those of the chain alone."""
    found = solution.chain_scalars.get(key)
    if found is not None:
        return found / quantity(key).si
    return solution.scalars.get(key) if solution.engine.regimes else None


def _column(solution: Solution, table: str, key: str) -> Any:  # noqa: ANN401
    """A column of the solver; one of the chain needs no more than the chain."""
    found = solution.chain_tables.get(table, {}).get(key)
    if found is not None:
        return in_units({key: found})[key]
    return solution.columns.get(table, {}).get(key)


def _chart(chart: ChartSpec, solution: Solution, formulas: Evaluation) -> Data:
    def numbers(key: str) -> list[float | None]:
        found = _column(solution, *key.split(".", 1))
        return plain_numbers(formulas.value(key) if found is None else found)

    curves = [{"name": curve.name or _symbol(curve.y), "x": numbers(curve.x), "y": numbers(curve.y)}
              for curve in chart.drawn_by("report")]  # fmt: skip
    return {
        "id": chart.id, "title": chart.title, "kind": chart.kind, "x_title": chart.x_title,
        "y_title": chart.y_title, "angle": chart.x_is_angle, "x_reversed": chart.x_reversed,
        "y_reversed": chart.y_reversed, "curves": curves, "path": _path(chart, solution, curves),
    }  # fmt: skip


def _path(chart: ChartSpec, solution: Solution, curves: list[Data]) -> Data | None:
    """Where the cursor stands on a chart of no angle at every φ: a vector's end, the worn side."""
    angles = {len(phi): phi for phi in (
        _column(solution, table, "phi_deg") for table in ("P3_1", "P4_1"))}  # fmt: skip
    if chart.kind == "wear":
        place, _, regime = chart.series[0].x.partition("_sums")[0].partition("_R")
        number, suffix = place.rpartition("_")[2], f"_R{regime}" if regime else ""
        if "_main_" in place:
            table, keys, sign = f"P4_3_{number}{suffix}", ("Ry_MPa", "Rx_MPa"), 1
        else:
            pin = f"crankpin_{number}" if "_pin_" in place else "crankpin"
            table, keys, sign = f"{pin}{suffix}", ("Krod_MPa", "T_MPa"), -1
        up, against = (sign * _column(solution, table, key) for key in keys)
        size = np.maximum(np.hypot(up, against), 1e-12)
        phi = angles[len(size)]
        return {"phi": plain_numbers(phi), "x": plain_numbers(-against / size),
                "y": plain_numbers(-up / size)}  # fmt: skip
    if chart.kind == "polar" and len(curves[0]["x"]) in angles:
        phi = angles[len(curves[0]["x"])]
        return {"phi": plain_numbers(phi), "x": curves[0]["x"], "y": curves[0]["y"]}
    return None


def _symbol(key: str) -> str:
    try:
        return quantity(key.rpartition(".")[2]).symbol
    except KeyError:
        return ""


def plain_numbers(values: Any) -> list[float | None]:  # noqa: ANN401
    """A column as JSON carries it: digits that no screen shows are left out."""
    values = np.asarray(values, dtype=float)
    finite = np.isfinite(values)
    most = float(np.max(np.abs(values[finite]), initial=0.0))
    digits = _DIGITS - int(np.ceil(np.log10(most))) if most > 0 else 0
    rounded: list[float | None] = np.round(values, digits).tolist()
    if not finite.all():
        rounded = [x if ok else None for x, ok in zip(rounded, finite, strict=True)]
    return rounded


def moving(solution: Solution, cylinder: int = 0) -> Data:
    """What the moving mechanism of a cylinder and the star of cranks are drawn from.

    ``joints`` are the places of crankpin, articulated pin and piston pin [mm] in the frame of
    the cylinder, its axis upwards, over its own angle ``turn``; forces stand over the engine's.
    """
    engine, chain = solution.engine, solution.chain_tables
    number = cylinder if cylinder in range(engine.cylinders) else 0
    place, geometry = engine.arrangement[number], engine.geometry
    table = f"cylinder_{number + 1}" if number else "P4_1"
    phi = _column(solution, table, "phi_deg")
    phase = _column(solution, table, "phase_deg") if number else phi
    r, rod, e = (MM.from_si(size) for size in (
        geometry.crank_radius, geometry.rod_length, geometry.offset))  # fmt: skip
    turn = _column(solution, "P3_1", "phi_deg")
    joints = [(r * np.sin(np.radians(turn)), r * np.cos(np.radians(turn)))]
    if place.master is None:
        exact = ("offset", "x_exact_mm") if "offset" in chain else ("P3_1", "s_mm")
        height = np.sqrt((r + rod) ** 2 - e**2) - _column(solution, *exact)
    else:
        own = MM.from_si(engine.articulated[0].rod_length)
        across, along, beta = (_column(solution, "articulated", key)
                               for key in ("across_mm", "along_mm", "beta_rad"))  # fmt: skip
        joints.append((across, along))
        height = along + own * np.cos(beta)
    joints.append((np.full(len(height), e), height))
    forces = [key for key in chain["P4_1"] if key.endswith("_MPa")]
    return {
        "phi": plain_numbers(phi), "turn": plain_numbers(turn), "shift": float(phi[0] - phase[0]),
        "joints": [[plain_numbers(x), plain_numbers(y)] for x, y in joints],
        "forces": {
            key: {"symbol": quantity(key).symbol, "unit": quantity(key).unit_label,
                  "values": plain_numbers(_column(solution, table, key))}
            for key in forces
        },
        "radius": r, "bore": MM.from_si(geometry.bore), "axis": float(np.degrees(place.axis)),
        "wall": MM.from_si(geometry.crank_offset or 0.0), "throw": place.throw,
        "cylinder": number, "cylinders": engine.cylinders,
        "throws": np.degrees([each.angle for each in engine.crankshaft.throws]).tolist(),
    }  # fmt: skip


def checks(raw: Mapping[str, Any]) -> Data:
    """The checks of the calculation, each with its value, and what the step leaves out."""
    loaded = loaded_of(raw)
    model = _model_for(loaded.model)
    formulas, reasons = Evaluation(model), reasons_of(loaded.model)
    names = {key.removeprefix("check_"): scalar for key, scalar in model.scalars.items()
             if key.startswith("check_")}  # fmt: skip
    found = [
        {"key": name, "title": scalar.note, "value": float(formulas.value(f"value_{name}")),
         "ok": formulas.value(f"check_{name}") != NO, "reason": reasons.get(name, "")}
        for name, scalar in names.items()
    ]  # fmt: skip
    grid = grid_remark(loaded.model)
    return {"checks": found, "remarks": [*model.remarks, *((grid,) if grid else ())]}


def as_toml(raw: Mapping[str, Any]) -> Data:
    """The commented file of an input."""
    return {"text": file_text(Made(to_mapping(loaded_of(raw).model), {}, HEAD))}


def fresh(wanted: Mapping[str, Any]) -> Data:
    """A new engine as ``kshm new`` makes it: a sample, an own one, or an alternative to ``raw``.

    Raises:
        KshmError: there is no such engine.
    """
    from reports.commands.own import own_text
    from reports.inputs.own_similar import alternative
    from reports.inputs.template import new_file

    if wanted.get("sample"):
        return read_toml(new_file(str(wanted["sample"])))
    cylinders = wanted.get("cylinders")
    if not isinstance(cylinders, int) or isinstance(cylinders, bool):
        raise InputError(Problem("cylinders", "нужно целое число цилиндров", "от 1 до 12"))
    options = {f"--{key}": wanted.get(key) for key in (*_WORDS, "power", "speed")}
    for key, words in _WORDS.items():
        if options[f"--{key}"] not in (None, *words):
            raise InputError(Problem(key, "нет такого", "выберите из списка"))
    if wanted.get("raw") is not None:
        base = loaded_of(wanted["raw"]).model
        return read_toml(file_text(alternative(base, cylinders, layout=options["--layout"])))
    for key in ("power", "speed"):
        if not isinstance(options[f"--{key}"], int | float | None):
            raise InputError(Problem(key, "нужно число", "впишите его или оставьте пустым"))
    return read_toml(own_text(None, None, cylinders, options))


_WORDS = {
    "layout": ("inline", "v", "opposed"), "strokes": ("4", "2"), "kind": ("diesel", "petrol"),
}  # fmt: skip


def warm() -> Data:
    """Import and solve once, so that the first person does not wait."""
    return answer(fresh({"sample": "gots-diesel"})["raw"], "П4.1")
