"""Engines that differ from one in a few numbers, by the names of ``assemble`` or of a file."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

from kshm.engine.checks import check_kind
from kshm.engine.source import MakeEngine, Source
from kshm.errors import Problem, UnknownNameError, one_line
from kshm.nomenclature.quantity import UNITS

# Names of ``kshm.assemble``, where their numbers stand in the engine and their units; a star
# stands for every member of a list.
VARIED: dict[str, tuple[str, str]] = {
    "bore_mm": ("geometry.bore", "mm"),
    "crank_radius_mm": ("geometry.crank_radius", "mm"),
    "rod_length_mm": ("geometry.rod_length", "mm"),
    "compression_ratio": ("geometry.compression_ratio", ""),
    "speed_rpm": ("omega", "rpm"),
    "mechanical_efficiency": ("mechanical_efficiency", ""),
    "reciprocating_kg": ("masses.reciprocating", ""),
    "rod_big_end_kg": ("masses.rod_big_end", ""),
    "counterweight_kg": ("crankshaft.throws.*.*_web.counterweight_mass", ""),
    "pin_diameter_mm": ("crankshaft.pin_diameters.*", "mm"),
    "pin_length_mm": ("crankshaft.pin_lengths.*", "mm"),
    "main_diameter_mm": ("crankshaft.main_diameters.*", "mm"),
    "main_lengths_mm": ("crankshaft.main_lengths.*", "mm"),
    "max_mpa": ("gas.p_max", "MPa"),
    "intake_mpa": ("gas.p_intake", "MPa"),
    "residual_mpa": ("gas.p_residual", "MPa"),
    "compression_exponent": ("gas.n_compression", ""),
    "expansion_exponent": ("gas.n_expansion", ""),
    "preexpansion_ratio": ("gas.rho", ""),
    "injection_advance_deg": ("gas.ignition_advance", "deg"),
    "wear_rays": ("rays", ""),
}


@dataclass(frozen=True, slots=True)
class Varied:
    """A name, the members of the engine that it stands for and the factor to SI."""

    name: str
    path: tuple[str, ...]
    factor: float

    def value_in(self, engine: Any) -> Any:  # noqa: ANN401
        """Return the value of the first member in the unit of the name."""
        part = engine
        for step in self.path:
            part = _members(part, step)[0][1]
        return part / self.factor if self.factor != 1 else part

    def put(self, engine: Any, value: Any) -> Any:  # noqa: ANN401
        """Return an engine with another value."""
        return _with(engine, self.path, value * self.factor if self.factor != 1 else value)


def find(engine: Any, name: str) -> Varied:  # noqa: ANN401
    """Return what a name stands for in an engine.

    Args:
        engine: an engine.
        name: of ``kshm.assemble`` (``bore_mm``), or a path in SI (``geometry.bore``,
            ``crankshaft.throws.2.left_web.mass``, numbers from 1, ``*`` for all).

    Raises:
        UnknownNameError: there is none; the hint tells similar ones.
    """
    path, unit = VARIED.get(name, (name, ""))
    parts = [engine]
    for step in path.split("."):
        parts = [member for part in parts for _, member in _members(part, step)]
        if not parts:
            raise unknown(name, [*VARIED, *_paths(engine)])
    return Varied(name, tuple(path.split(".")), UNITS[unit].si)


def unknown(name: str, names: Sequence[str]) -> UnknownNameError:
    """Return the error of a name that there is not, with similar ones."""
    close = difflib.get_close_matches(name, names, n=3, cutoff=0.5)
    hint = f"similar: {', '.join(close)}" if close else f"names: {', '.join(names[:20])}"
    return UnknownNameError(name, Problem(one_line(name, 80), "no such name", hint, value=name))


def engine_maker(engine: Any, names: Sequence[str]) -> MakeEngine:  # noqa: ANN401
    """Return what makes an engine of the values of a row, by the keys of its file if it has them.

    Raises:
        UnknownNameError: a name that there is not.
        InputError: a key of the file cannot vary.
    """
    for name in names:
        check_kind("name", name, str)
    source: Source | None = engine.source
    keys: dict[int, str] = {}
    if source is not None and source.has_made(engine):
        keys = {at: key for at, name in enumerate(names) if (key := source.find(name))}
        for at, name in enumerate(names):
            if at not in keys and name not in VARIED and "." not in name:
                raise unknown(name, [*source.names(), *VARIED])
    others = {at: find(engine, name) for at, name in enumerate(names) if at not in keys}
    make = source.rows(list(keys.values())) if source is not None and keys else None

    def engine_of(row: Sequence[Any]) -> Any:  # noqa: ANN401
        revised = engine if make is None else make([row[at] for at in keys])
        for at, each in others.items():
            revised = each.put(revised, row[at])
        return revised

    return engine_of


def _members(part: Any, step: str) -> list[tuple[Any, Any]]:  # noqa: ANN401
    """Members of a dataclass by name, or of a list by number from 1, that a step means."""
    if is_dataclass(part):
        named = [(field.name, getattr(part, field.name)) for field in fields(part)]
        return [each for each in named if _is_meant(each[0], step)]
    if isinstance(part, tuple):
        return [(at, each) for at, each in enumerate(part) if _is_meant(str(at + 1), step)]
    return []


def _is_meant(name: str, step: str) -> bool:
    return name == step or (step[:1] == "*" and name.endswith(step[1:]))


def _with(part: Any, path: Sequence[str], value: Any) -> Any:  # noqa: ANN401
    """Return a copy of a part with another value at a path."""
    if not path:
        return value
    changed = {at: _with(each, path[1:], value) for at, each in _members(part, path[0])}
    if isinstance(part, tuple):
        return tuple(changed.get(at, each) for at, each in enumerate(part))
    return replace(part, **changed)


def _paths(part: Any, home: str = "", depth: int = 3) -> list[str]:  # noqa: ANN401
    """Return the paths of the numbers of an engine, few levels deep."""
    paths = []
    for field in fields(part):
        each, name = getattr(part, field.name), f"{home}{field.name}"
        if is_dataclass(each) and depth:
            paths += _paths(each, f"{name}.", depth - 1)
        elif isinstance(each, float | int):
            paths.append(name)
    return paths
