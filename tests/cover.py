"""The smallest sets of engines that hold every kind of formula, chart, chapter and choice.

The same comparison over engines that hold the same formulas says nothing new.  What an engine
holds is read from the registries, so that a new sample or a new table joins by itself.  With
``KSHM_ALL=1`` (``./run test --all``) every comparison takes all engines, with ``KSHM_QUICK=1``
(``./run test --quick``) the textbook's diesel alone.
"""

from __future__ import annotations

import ast
import os
import re
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from typing import TypeVar

from reports.document.chapters.contents import CHAPTERS
from reports.document.chapters.record import chosen
from reports.formula.parse import parse
from reports.inputs.fields import to_mapping
from reports.model.blocks import Model
from reports.tables.registry import build_model
from tests.conftest import sample, sample_names
from tests.layouts import MAKERS, layout_input

ALL = os.environ.get("KSHM_ALL") == "1"
QUICK = os.environ.get("KSHM_QUICK") == "1" and not ALL
Case = TypeVar("Case")
Kind = Callable[[Model], set[tuple]]
_NUMBER = re.compile(r"\d+")
_FUNCTION = re.compile(r"\b([a-z_]+)\(")


def alike(text: str) -> str:
    """Names of cylinders, throws and rays differ by their numbers."""
    return _NUMBER.sub("#", text)


def formulas(model: Model) -> set[tuple]:
    """Every formula with the column or the value that it gives."""
    return {("formula", alike(k), alike(n.expr or "")) for k, n in model.nodes.items()}


def quantities(model: Model) -> set[tuple]:
    """Every column and value of each block, every function, every input cell."""
    collected = {("quantity", alike(key)) for key in model.nodes}
    collected |= {("block", alike(block.id)) for block in model.blocks}
    collected |= {("input", alike(field.name)) for field in model.inputs}
    texts = (node.expr for node in model.nodes.values() if node.expr)
    return collected | {("function", word) for text in texts for word in _FUNCTION.findall(text)}


def operations(model: Model) -> set[tuple]:
    """Every function and operator with the kinds of what it works on, as a compiler meets them."""
    texts = (node.expr for node in model.nodes.values() if node.expr)
    parts = (part for text in set(texts) for part in ast.walk(parse(text)))
    return {
        (type(part), getattr(getattr(part, "func", None), "id", ""),
         tuple(map(type, ast.iter_child_nodes(part))))
        for part in parts
        if not isinstance(part, (ast.Name, ast.Attribute, ast.Constant, ast.expr_context))
    }  # fmt: skip


def charts(model: Model) -> set[tuple]:
    """Every chart with its kind and its curves, in the workbook and in the report."""
    return {
        (where, chart.kind, alike(chart.id), frozenset(alike(s.y) for s in chart.drawn_by(where)))
        for chart in model.charts
        for where in ("workbook", "report")
    }


def chapters(model: Model) -> set[tuple]:
    """Every section of the input, every chapter of the report, every arrangement."""
    given = to_mapping(model.input)
    collected = {("section", name) for name, section in given.items() if section}
    collected |= {("chapter", name) for name in chosen(CHAPTERS, model.input)}
    return collected | {("engine", given["engine"].get("layout"), given["engine"].get("strokes"))}


def choices(model: Model) -> set[tuple]:
    """The same with every key that is given, every choice, one of a thing or several."""
    return chapters(model) | {
        (name, key, value if isinstance(value, str) else isinstance(value, list) and len(value) > 1)
        for name, section in to_mapping(model.input).items()
        if isinstance(section, dict) and name not in ("report", "engine", "checks")
        for key, value in section.items()
        if value not in (None, [], 0) and key not in ("name", "firing_order")
    }


@cache
def model_of(name: str) -> Model:
    """A sample, or a layout of ``tests.layouts`` by its name."""
    return build_model(sample(name) if name in sample_names() else layout_input(name, step_deg=30))


@cache
def held(name: str, kind: Kind) -> set[tuple]:
    """What an engine holds of a kind."""
    return kind(model_of(name))


def smallest(actual: Mapping[str, set[tuple]], cost: Mapping[str, int]) -> list[str]:
    """Names that together hold what all hold: the cheapest way to most, again and again."""
    left, taken = set().union(*actual.values()), []
    while left:
        taken.append(max(actual, key=lambda name: len(actual[name] & left) / cost[name]))
        left -= actual[taken[-1]]
    for name in list(taken):
        others = [actual[other] for other in taken if other != name]
        if actual[name] <= set().union(*others):
            taken.remove(name)
    return [name for name in actual if name in taken]


@cache
def covering(names: tuple[str, ...], kinds: tuple[Kind, ...]) -> list[str]:
    """Those of some engines that hold what all of them hold."""
    collected = {name: set().union(*(held(name, kind) for kind in kinds)) for name in names}
    return smallest(collected, {name: len(model_of(name).nodes) for name in names})


def samples_with(*kinds: Kind) -> list[str]:
    """Samples that hold all that the samples hold of some kinds."""
    if ALL or QUICK:
        return sample_names() if ALL else ["gots-diesel"]
    return covering(tuple(sample_names()), kinds)


def examples(usual: int, every: int) -> int:
    """How many random examples: as many as find what a break in the room breaks, or more."""
    return every if ALL else usual


def sparse(cases: Iterable[Case], every: int = 2) -> list[Case]:
    """Every so many of cases that are of one kind; all of them with ``KSHM_ALL``."""
    return list(cases)[:: 1 if ALL else every]


def engines_with(*kinds: Kind) -> list[str]:
    """Samples and layouts that hold all that samples and layouts hold."""
    names = (*sample_names(), *MAKERS)
    if ALL or QUICK:
        return list(names) if ALL else ["gots-diesel"]
    return covering(names, kinds)
