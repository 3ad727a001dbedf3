"""What the page of an engine asks for, as plain data.

These functions run in the workers of `reports.web.pool`; what they raise as `KshmError`
comes back as problems with the keys of their fields.
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Mapping
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import asdict
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import click

from reports.commands.engine import new
from reports.commands.words import error_text
from reports.exports import live
from reports.inputs.described import Data, absent, groups, without_foreign
from reports.inputs.fields import iter_fields, tables_shape, to_mapping
from reports.inputs.load import Loaded, load_mapping, parsed
from reports.inputs.own_engine import Made
from reports.inputs.own_file import file_text
from reports.inputs.ranges import split_ranges
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solved import solved
from reports.inputs.source import MAX_BYTES, refused
from reports.inputs.understood import understood
from reports.shared.errors import InputError, KshmError, Problem
from reports.shared.files import write_text
from reports.spec.blocks import Model
from reports.tables.registry import build_model

HEAD = ("Исходные данные двигателя для kshm.",)
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
    return {
        "errors": [],
        "warnings": [asdict(problem) for problem in loaded.warnings],
        "results": list(live.results(model, solution)),
        "charts": live.charts(model, solution, sheet),
        "moves": live.moving(solution, cylinder),
    }


def checks(raw: Mapping[str, Any]) -> Data:
    """The checks of the calculation, each with its value, and what the step leaves out."""
    return live.checks(_model_for(loaded_of(raw).model))


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
