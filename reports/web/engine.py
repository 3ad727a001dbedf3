"""Answers for the engine page as plain data, computed in workers."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any

import click

from reports.commands.common import error_text
from reports.commands.engine import new
from reports.commands.new_engine import new_text
from reports.exports.department_chapters import refuse_faults
from reports.inputs.department_chapters import OWNER
from reports.inputs.fields import to_mapping
from reports.inputs.form_fields import Data, absent, groups, without_foreign
from reports.inputs.load import Loaded, load_remote, parsed
from reports.inputs.normalise import normalise, read_text
from reports.inputs.ranges import split_ranges
from reports.inputs.registry import SECTIONS
from reports.inputs.sections.input_file import LAYOUTS
from reports.inputs.solve_input import solution_remarks, solved
from reports.inputs.template import list_samples, new_file
from reports.live.pack import packed
from reports.live.program import built_values
from reports.model.blocks import Model
from reports.new.generate import NewEngine, file_text
from reports.shared.errors import InputError, KshmError, Problem
from reports.tables.registry import kept_model
from reports.workbook.lost_formulas import lost_formulas
from reports.workbook.read import load_workbook_input

HEAD = ("Исходные данные двигателя для kshm.",)
FORM = {
    "sample": "Образец", "layout": "Расположение", "strokes": "Тактность", "kind": "Вид",
    "power": "Мощность, кВт", "speed": "Частота, мин⁻¹", "cylinders": "Цилиндров",
    "bore": "Диаметр, мм", "stroke": "Ход, мм", "rod": "Шатун, мм", "lambda": "Отношение r/L",
    "compression": "Степень сжатия", "efficiency": "Механический КПД",
}  # fmt: skip  # keys of kshm new as the page asks for them
_WORDS = {
    "--layout inline": "расположение «рядный»", "команда знает": "возможно",
    **{f"--{key}": f"«{title.partition(',')[0]}»" for key, title in FORM.items()},
}  # fmt: skip  # what the command calls it: what the page does


SHAPES = (
    *((f"Р{count}", "inline", count) for count in (1, 2, 3, 4, 5, 6, 8)),
    *((f"V{count}", "v", count) for count in (2, 4, 6, 8, 10, 12)),
    *((f"О{count}", "opposed", count) for count in (2, 4, 6)),
)  # what one tap makes of an engine: name, layout, cylinders


@lru_cache(maxsize=1)
def samples() -> list[Data]:
    """Samples as a person chooses them: name, layout, what is in them besides the mechanism."""
    return [_sample(name) for name in list_samples()]


def _sample(name: str) -> Data:
    raw = parsed(new_file(name), source=name)
    engine = raw["engine"]
    layout = engine.get("layout", "inline")
    words = [LAYOUTS[layout], "двухтактный" if engine.get("strokes") == 2 else "четырёхтактный"]
    words += [section.title.lower() for key, section in SECTIONS.items()
              if section.absent and key in raw and key != "checks"]  # fmt: skip
    if "regimes" in raw:
        words.append(f"режимов {len(raw['regimes']) + 1}")
    return {"name": name, "title": engine["name"], "layout": layout, "more": ", ".join(words),
            "cylinders": engine["cylinders"]}  # fmt: skip


def read_toml(path: str) -> Data:
    """Return the mapping of a file, as the page keeps it; InputError in the words of ``check``."""
    file = Path(path)
    return {"raw": split_ranges(parsed(read_text(file), source=file.name))[0]}


def read_book(path: str) -> Data:
    """Return the input that an edited workbook holds, and its lost formulas in words.

    Raises:
        InputError: it is none of ours, or wrong.
    """
    model = load_workbook_input(Path(path)).model
    lost: tuple[Problem, ...] = ()
    with suppress(InputError):  # what is wrong with the engine its start says
        refuse_faults(model)
        lost = lost_formulas(Path(path), kept_model(model))
    return {"raw": to_mapping(model), "lost": [problem.line() for problem in lost]}


def start(raw: Mapping[str, Any]) -> Data:
    """Fields of an input in groups, the input as it was understood, the engine for the browser.

    What is wrong with its values stands among the errors; the fields are shown all the same.
    """
    plain = without_foreign(normalise(raw))
    state: Data = {"errors": []}
    try:
        loaded = load_remote(plain)
        plain = to_mapping(loaded.model)
        model, more = _built(loaded)
        pack = packed(model, model)
        state |= {"engine": pack.data, "scripts": [pack.script, pack.fine_script], **more}
    except InputError as error:
        state["errors"] = [problem.words() for problem in error.problems]
    return {**state, "raw": plain, "groups": list(groups(plain)), "absent": absent(plain)}


def settle(raw: Mapping[str, Any]) -> Data:
    """Return what a browser cannot find of an engine: remarks of ``check``, values of the build.

    Raises:
        InputError: what is wrong with its values together.
    """
    model, more = _built(load_remote(raw))
    return {**more, "built": built_values(model)}


def _built(loaded: Loaded) -> tuple[Model, Data]:
    refuse_faults(loaded.model)
    model = kept_model(loaded.model)
    solved(loaded.model)
    return model, {
        "warnings": [problem.words() for problem in loaded.warnings],
        "remarks": [*model.remarks, *(each.line for each in solution_remarks(loaded.model))],
    }


def as_toml(raw: Mapping[str, Any]) -> Data:
    """Return the commented file of an input."""
    return {"text": file_text(NewEngine(to_mapping(load_remote(raw).model), {}, HEAD))}


def fresh(form: Mapping[str, Any]) -> Data:
    """Return a new input: a sample, an own engine or an alternative to ``raw``."""
    fields = {key: str(form[key]).replace(",", ".") for key in FORM if form.get(key)}
    if "sample" not in form:
        fields["cylinders"] = repr(form.get("cylinders"))
    options = [f"--{key}={value}" for key, value in fields.items()]
    base = ("исходном двигателе", lambda: load_remote(form["raw"]).model)
    try:
        params = new.make_context("new", options).params
        del params["output"]
        text = new_text(**{**params, "base": base if "raw" in form else None})
    except click.ClickException as error:
        raise KshmError(_of_page(error_text(error))) from None
    except KshmError as error:
        raise KshmError(
            [Problem(_of_page(p.where), _of_page(p.what), _of_page(p.hint)) for p in error.problems]
        ) from None
    return {"raw": split_ranges(parsed(text, source="файл"))[0]}


def _of_page(words: str) -> str:
    """Return a message of the command in the words of the form."""
    for option, field in _WORDS.items():
        words = words.replace(option, field)
    return words


def ready_for_books(books: str = "") -> Callable[..., Data]:
    """Prepare a worker that reads books: who waits for a number comes before."""
    getattr(os, "nice", abs)(10)
    return ready(books)


def ready(books: str = "") -> Callable[..., Data]:
    """Prepare a worker: import everything, solve once; return the caller.

    ``books`` is the folder of own books that the owner allows.
    """
    os.environ[OWNER] = books
    start(fresh({"sample": "gots-diesel"})["raw"])
    return operator.call
