"""What the page of an engine asks for, as plain data: fields, numbers, charts, checks.

These functions run in the workers of `reports.web.pool`; what they raise as `KshmError`
comes back as problems with the keys of their fields.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from kshm import quantity, solve
from kshm.results.solution import Solution, in_units
from reports.inputs.checks.grid import grid_remark
from reports.inputs.fields import Field, iter_fields, key_text, tables_shape, to_mapping
from reports.inputs.load import Loaded, load_mapping
from reports.inputs.meta import Meta, Strictly, find_meta, hints, submodel
from reports.inputs.own_engine import Made
from reports.inputs.own_file import file_text
from reports.inputs.ranges import split_ranges
from reports.inputs.registry import SECTIONS
from reports.inputs.sections.input_file import InputFile
from reports.inputs.source import MAX_BYTES, refuse_bomb, refused
from reports.inputs.to_si.engine import engine_and_cycle
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

Data = dict[str, Any]
HEAD = ("Исходные данные двигателя для kshm.",)
_DIGITS = 8  # of the greatest number of a curve: what no screen shows
_PATHS = ("style", "templates", "compare")  # keys of [report] that name files of the machine
_MODELS: dict[object, Model] = {}
_MOST_MODELS = 24


def answered(function: Callable[..., Data], *arguments: Any) -> Data:  # noqa: ANN401
    """A function's answer, or its problems: a worker hands over no exceptions."""
    try:
        return function(*arguments)
    except KshmError as error:
        return {"errors": [as_dict(problem) for problem in error.problems]}


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
        # The loader knows the words for it.
        from reports.inputs.load import load_text

        load_text(text, source="файл")
        raise
    return {"raw": split_ranges(raw)[0]}


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
    loaded = load_mapping(raw, source="")
    named = [key for key in _PATHS if getattr(loaded.model.report, key)]
    if named:
        what = "страница не читает файлов с диска"
        raise InputError(
            [
                Problem(f"report.{key}", what, "уберите ключ; команде kshm он доступен")
                for key in named
            ]
        )
    return loaded


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
    """
    plain = understood(raw)
    try:
        loaded = loaded_of(plain)
    except InputError as error:
        return {"raw": plain, "groups": [], "errors": [as_dict(each) for each in error.problems]}
    model = _model_for(loaded.model)
    sheets: dict[str, str] = {}
    for chart in model.charts:
        sheets.setdefault(chart.sheet, chart.title)
    return {
        "raw": to_mapping(loaded.model),
        "groups": list(_groups(loaded.model)),
        "sheets": [{"id": name, "title": name or "Прочее", "hint": title}
                   for name, title in sheets.items()],
        "absent": [{"id": name, "title": section.title} for name, section in SECTIONS.items()
                   if section.absent and getattr(loaded.model, name) is None],
    }  # fmt: skip


def _groups(model: InputFile) -> Iterator[Data]:
    """Groups of fields; after those given come the keys that may be."""
    groups: dict[str, list[Data]] = {}
    for field in iter_fields(model):
        groups.setdefault(field.section, []).append(_as_data(field))
    shown = {field.path for field in iter_fields(model)}
    for name, section in SECTIONS.items():
        part: Strictly | None = getattr(model, name)
        if part is None:
            continue
        for key, annotation in hints(type(part)).items():
            metas = find_meta(annotation)
            plain = submodel(annotation) is None and key not in section.lists
            if plain and metas and (name, key) not in shown:
                groups.setdefault(section.title, []).append(_blank((name, key), metas[0]))
    arms = "arms-v" if model.engine.layout == "v" else "arms"
    drawings = {"arms": arms, "throw_angles_deg": "phases", "webs": "signs"}
    for title, fields in groups.items():
        drawing = drawings.get(str(fields[0]["path"][1]), "")
        yield {"title": title, "fields": fields, "drawing": drawing}


def _as_data(field: Field) -> Data:
    return {
        "path": list(field.path), "key": key_text(field.path), "title": field.title,
        "symbol": field.symbol, "unit": field.unit, "value": field.value,
        "number": not isinstance(field.value, str) and field.choices is None,
        "choices": field.choices, "min": field.minimum, "max": field.maximum,
        "optional": field.optional,
    }  # fmt: skip


def _blank(path: tuple[str, str], meta: Meta) -> Data:
    return {
        "path": list(path), "key": key_text(path), "title": meta.title, "symbol": meta.symbol,
        "unit": meta.unit.label, "value": None, "number": meta.minimum is not None,
        "choices": None if meta.choices is None else dict(meta.choices),
        "min": meta.minimum, "max": meta.maximum, "optional": True,
    }  # fmt: skip


def _solved(model: InputFile) -> Solution:
    return solve(*engine_and_cycle(model))


def answer(raw: Mapping[str, Any], sheet: str) -> Data:
    """Numbers of an engine, the charts of a sheet, what moves, what is odd about the input."""
    loaded = loaded_of(raw)
    model, solution = _model_for(loaded.model), _solved(loaded.model)
    formulas = Evaluation(model)
    return {
        "errors": [],
        "warnings": [as_dict(problem) for problem in loaded.warnings],
        "accepted": [each.line() for each in loaded.accepted],
        "results": list(_results(model, solution)),
        "charts": [_chart(chart, solution, formulas)
                   for chart in model.charts if chart.sheet == sheet],
        "moves": moving(solution),
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
    curves = []
    for curve in chart.drawn_by("report"):
        curves.append({
            "name": curve.name or _symbol(curve.y),
            "x": _numbers(curve.x, solution, formulas), "y": _numbers(curve.y, solution, formulas),
        })  # fmt: skip
    return {
        "id": chart.id, "title": chart.title, "kind": chart.kind, "x_title": chart.x_title,
        "y_title": chart.y_title, "angle": chart.x_is_angle, "x_reversed": chart.x_reversed,
        "y_reversed": chart.y_reversed, "curves": curves,
    }  # fmt: skip


def _symbol(key: str) -> str:
    try:
        return quantity(key.rpartition(".")[2]).symbol
    except KeyError:
        return ""


def _numbers(key: str, solution: Solution, formulas: Evaluation) -> list[float | None]:
    table, _, column = key.partition(".")
    found = _column(solution, table, column)
    values = np.asarray(formulas.value(key) if found is None else found, dtype=float)
    return plain_numbers(values)


def plain_numbers(values: Any) -> list[float | None]:  # noqa: ANN401
    """A column as JSON carries it: digits that no screen shows are left out."""
    values = np.asarray(values, dtype=float)
    finite = np.isfinite(values)
    most = float(np.max(np.abs(values[finite]), initial=0.0))
    digits = _DIGITS - int(np.ceil(np.log10(most))) if most > 0 else 0
    return [
        x if ok else None for x, ok in zip(np.round(values, digits).tolist(), finite, strict=True)
    ]


def moving(solution: Solution) -> Data:
    """What the moving mechanism of the first cylinder and the star of cranks are drawn from."""
    forces = [key for key in solution.chain_tables["P4_1"] if key.endswith("_MPa")]
    return {
        "phi": plain_numbers(_column(solution, "P4_1", "phi_deg")),
        "turn": plain_numbers(_column(solution, "P3_1", "phi_deg")),  # of the mechanism: one turn
        "s": plain_numbers(_column(solution, "P3_1", "s_mm")),
        "beta": plain_numbers(_column(solution, "P3_2", "beta_rad")),
        "forces": {
            key: {"symbol": quantity(key).symbol, "unit": quantity(key).unit_label,
                  "values": plain_numbers(_column(solution, "P4_1", key))}
            for key in forces
        },
        "radius": MM.from_si(solution.engine.geometry.crank_radius),
        "rod": MM.from_si(solution.engine.geometry.rod_length),
        "throws": np.degrees([each.angle for each in solution.engine.crankshaft.throws]).tolist(),
    }  # fmt: skip


def checks(raw: Mapping[str, Any]) -> Data:
    """The checks of the calculation, each with its value, and what the step leaves out."""
    loaded = loaded_of(raw)
    model = _model_for(loaded.model)
    formulas = Evaluation(model)
    found, reasons = [], reasons_of(loaded.model)
    for key, scalar in model.scalars.items():
        if key.startswith("check_"):
            name = key.removeprefix("check_")
            value = float(formulas.value(f"value_{name}"))
            ok = formulas.value(key) != NO
            found.append({
                "key": name, "title": scalar.note, "value": value, "ok": ok,
                "reason": reasons.get(name, ""),
            })  # fmt: skip
    grid = grid_remark(loaded.model)
    return {"checks": found, "remarks": [*model.remarks, *((grid,) if grid else ())]}


def as_toml(raw: Mapping[str, Any]) -> Data:
    """The commented file of an input."""
    return {"text": toml_text(loaded_of(raw).model)}


def toml_text(model: InputFile) -> str:
    """A checked input as the file that a person keeps."""
    return file_text(Made(to_mapping(model), {}, HEAD))


def fresh(wanted: Mapping[str, Any]) -> Data:
    """A new engine as ``kshm new`` makes it: a sample, an own one, or an alternative to ``raw``."""
    from reports.commands.own import own_text
    from reports.inputs.template import new_file

    if wanted.get("sample"):
        return read_toml(new_file(str(wanted["sample"])))
    cylinders = wanted.get("cylinders")
    if not isinstance(cylinders, int) or isinstance(cylinders, bool):
        raise InputError(Problem("cylinders", "нужно целое число цилиндров", "от 1 до 12"))
    if wanted.get("raw") is not None:
        from reports.inputs.own_similar import alternative

        base = loaded_of(wanted["raw"]).model
        layout = wanted.get("layout") if wanted.get("layout") in _WORDS["layout"] else None
        return read_toml(file_text(alternative(base, cylinders, layout=layout)))
    options = {f"--{key}": wanted.get(key) for key in ("layout", "strokes", "kind")}
    for key, words in _WORDS.items():
        if options[f"--{key}"] is not None and options[f"--{key}"] not in words:
            raise InputError(Problem(key, "нет такого", "выберите из списка"))
    for key in ("power", "speed"):
        value = wanted.get(key)
        if value is not None and not isinstance(value, (int, float)):
            raise InputError(Problem(key, "нужно число", "впишите его или оставьте пустым"))
        options[f"--{key}"] = value
    return read_toml(own_text(None, None, cylinders, options))


_WORDS = {
    "layout": ("inline", "v", "opposed"), "strokes": ("4", "2"), "kind": ("diesel", "petrol"),
}  # fmt: skip


@lru_cache
def warm() -> None:
    """Import and solve once, so that the first person does not wait."""
    answer(fresh({"sample": "gots-diesel"})["raw"], "П4.1")
