"""What the page of an engine asks for, as plain data: numbers, charts, checks, what moves.

These functions run in the workers of `reports.web.pool`; what they raise as `KshmError`
comes back as problems with the keys of their fields.
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import asdict
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import click
import numpy as np

from kshm import quantity
from kshm.results.solution import Solution
from reports.commands.engine import new
from reports.commands.words import error_text
from reports.inputs.checks.grid import grid_remark
from reports.inputs.fields import iter_fields, tables_shape, to_mapping
from reports.inputs.load import Loaded, load_mapping, parsed
from reports.inputs.own_engine import Made
from reports.inputs.own_file import file_text
from reports.inputs.ranges import split_ranges
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solved import solved
from reports.inputs.source import MAX_BYTES, refused
from reports.inputs.understood import understood
from reports.inputs.units import MM
from reports.shared.errors import InputError, KshmError, Problem
from reports.shared.files import write_text
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
_OPTIONS = ("layout", "strokes", "kind", "power", "speed")  # of kshm new


def answered(function: Callable[..., Data], *arguments: Any) -> Data:  # noqa: ANN401
    """A function's answer, or its problems: a worker hands over no exceptions."""
    try:
        return function(*arguments)
    except KshmError as error:
        return {"errors": told(error)}
    except MemoryError:  # the heap may be in pieces: a new process takes over
        os._exit(1)
    except Exception as error:  # a bug costs one answer
        return {"errors": told(KshmError(f"внутренняя ошибка {type(error).__name__}"))}


def told(error: KshmError) -> list[Data]:
    """Problems as the page takes them."""
    return [asdict(problem) for problem in error.problems]


def read_toml(text: str) -> Data:
    """The mapping of a file's text, as the page keeps it.

    Raises:
        InputError: it is none.
    """
    if not isinstance(text, str) or len(text.encode("utf-8", "replace")) > MAX_BYTES:
        raise refused("файл", "слишком большой", "это не файл исходных данных")
    return {"raw": split_ranges(parsed(text, source="файл"))[0]}


def read_book(path: str) -> Data:
    """The mapping of the input that an edited workbook holds.

    Raises:
        InputError: it is no workbook of ours, or its cells are wrong.
    """
    from reports.workbook.read import load_workbook_input

    return {"raw": to_mapping(load_workbook_input(Path(path)).model)}


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
    if not isinstance(raw, dict):
        raise InputError(Problem("", "нет исходных данных", "обновите страницу"))
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
    if shape in _MODELS:
        return _MODELS[shape].with_inputs(model, fields)
    if len(_MODELS) >= _MOST_MODELS:
        _MODELS.pop(next(iter(_MODELS)))
    return _MODELS.setdefault(shape, build_model(model))


def start(raw: Mapping[str, Any]) -> Data:
    """Fields of an input in groups, its charts by sheets, and the input as it was understood.

    What is wrong with its values stands among the errors; the fields are shown all the same.

    Raises:
        InputError: a list is too long to be shown.
    """
    plain = without_foreign(understood(_bounded(raw)))
    sheets: dict[str, str] = {}
    errors: list[Data] = []
    try:
        model = loaded_of(plain).model
        plain = to_mapping(model)
        for chart in _model_for(model).charts:
            sheets.setdefault(chart.sheet, chart.title)
    except InputError as error:
        errors = told(error)
    return {"raw": plain, "groups": list(groups(plain)), "absent": absent(plain),
            "sheets": list(sheets.items()), "errors": errors}  # fmt: skip


def answer(raw: Mapping[str, Any], sheet: str, cylinder: int = 0) -> Data:
    """Numbers of an engine, the charts of a sheet, what moves, what is odd about the input."""
    loaded = loaded_of(raw)
    model, solution = _model_for(loaded.model), solved(loaded.model)
    formulas = Evaluation(model)
    return {
        "errors": [],
        "warnings": [asdict(problem) for problem in loaded.warnings],
        "results": list(_results(model, solution)),
        "charts": [_chart(chart, solution, formulas)
                   for chart in model.charts if chart.sheet == sheet],
        "moves": moving(solution, cylinder),
    }  # fmt: skip


def _results(model: Model, solution: Solution) -> Iterator[Data]:
    """The summaries of workbook and report with the solver's numbers."""
    for block in model.blocks:
        if isinstance(block, ScalarTable) and block.id.startswith(("summary", "geometry")):
            found = ((each, solution.scalar(each.key)) for each in block.scalars)
            rows = [
                {"key": each.key, "title": each.note or each.quantity.title,
                 "symbol": each.quantity.symbol, "unit": each.quantity.unit_label,
                 "value": value, "text": written(value, each.quantity.digits)}
                for each, value in found if value is not None
            ]  # fmt: skip
            if rows:
                yield {"id": block.id, "title": block.title, "rows": rows}


def _chart(chart: ChartSpec, solution: Solution, formulas: Evaluation) -> Data:
    """A chart's curves, and where its cursor stands at every φ if it has no angle."""

    def numbers(key: str) -> Any:  # noqa: ANN401
        try:
            return solution.column(*key.split(".", 1))
        except KeyError:
            return np.asarray(formulas.value(key), dtype=float)

    curves = [(each.name or _symbol(each.y), numbers(each.x), numbers(each.y))
              for each in chart.drawn_by("report")]  # fmt: skip
    x = y = np.empty(0)
    if chart.kind == "polar":
        _, x, y = curves[0]
    elif chart.contact:
        x, y = (numbers(key.lstrip("-")) * (-1 if key[0] == "-" else 1) for key in chart.contact)
        x, y = np.array([x, y]) / np.maximum(np.hypot(x, y), 1e-12)
    angles = (solution.column(table, "phi_deg") for table in ("P3_1", "P4_1"))
    phi = next((phi for phi in angles if len(phi) == len(x)), None)
    return {
        **{key: getattr(chart, key) for key in _CHART},
        "curves": [{"name": name, **_lists(x=x, y=y)} for name, x, y in curves],
        "path": None if phi is None else _lists(phi=phi, x=x, y=y),
    }


_CHART = ("id", "title", "kind", "x_title", "y_title", "x_is_angle", "x_reversed", "y_reversed")


def _symbol(key: str) -> str:
    try:
        return quantity(key.rpartition(".")[2]).symbol
    except KeyError:
        return ""


def _lists(**columns: Any) -> dict[str, list[float | None]]:  # noqa: ANN401
    return {key: plain_numbers(values) for key, values in columns.items()}


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
    engine = solution.engine
    number = cylinder if cylinder in range(engine.cylinders) else 0
    place, geometry = engine.arrangement[number], engine.geometry
    table = f"cylinder_{number + 1}" if number else "P4_1"
    phi = solution.column(table, "phi_deg")
    phase = solution.column(table, "phase_deg") if number else phi
    forces = [key for key in solution.chain_tables["P4_1"] if key.endswith("_MPa")]
    return {
        **_lists(phi=phi, turn=solution.column("P3_1", "phi_deg")),
        "shift": float(phi[0] - phase[0]),
        "joints": [[plain_numbers(x * 1000) for x in joint]
                   for joint in solution.joints(number)],
        "forces": {
            key: {"symbol": quantity(key).symbol, "unit": quantity(key).unit_label,
                  **_lists(values=solution.column(table, key))}
            for key in forces
        },
        "radius": MM.from_si(geometry.crank_radius), "bore": MM.from_si(geometry.bore),
        "wall": MM.from_si(geometry.crank_offset or 0.0), "axis": float(np.degrees(place.axis)),
        "cylinder": number, "cylinders": engine.cylinders,
        "throws": np.degrees([each.angle for each in engine.crankshaft.throws]).tolist(),
    }  # fmt: skip


def checks(raw: Mapping[str, Any]) -> Data:
    """The checks of the calculation, each with its value, and what the step leaves out."""
    loaded = loaded_of(raw)
    model = _model_for(loaded.model)
    value, reasons = Evaluation(model).value, reasons_of(loaded.model)
    names = {key.removeprefix("check_"): scalar for key, scalar in model.scalars.items()
             if key.startswith("check_")}  # fmt: skip
    grid = grid_remark(loaded.model)
    return {
        "checks": [
            {"key": name, "title": scalar.note, "value": float(value(f"value_{name}")),
             "ok": value(f"check_{name}") != NO, "reason": reasons.get(name, "")}
            for name, scalar in names.items()
        ],
        "remarks": [*model.remarks, *((grid,) if grid else ())],
    }  # fmt: skip


def as_toml(raw: Mapping[str, Any]) -> Data:
    """The commented file of an input."""
    return {"text": file_text(Made(to_mapping(loaded_of(raw).model), {}, HEAD))}


def fresh(wanted: Mapping[str, Any]) -> Data:
    """A new engine as ``kshm new`` makes it: a sample, an own one, or an alternative to ``raw``.

    Raises:
        KshmError: there is no such engine.
    """
    keys = [key for key in _OPTIONS if wanted.get(key) is not None]
    options = [f"--{key}={wanted[key]}" for key in keys]
    if "sample" in wanted:
        options = [f"--sample={wanted['sample']}"]
    else:
        options.append(f"--cylinders={wanted.get('cylinders')!r}")
    text = io.StringIO()
    with TemporaryDirectory() as folder, redirect_stdout(text), redirect_stderr(io.StringIO()):
        if "raw" in wanted:
            base = Path(folder, "base.toml")
            write_text(base, as_toml(wanted["raw"])["text"])
            options.append(f"--from={base}")
        try:
            new.main(options, standalone_mode=False)
        except click.ClickException as error:
            raise KshmError(error_text(error)) from None
    return read_toml(text.getvalue())


def warm() -> Data:
    """Import and solve once, so that the first person does not wait."""
    return answer(fresh({"sample": "gots-diesel"})["raw"], "П4.1")
