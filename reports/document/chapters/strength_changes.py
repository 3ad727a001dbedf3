"""Sizes with which every part is within its limits: each found from its formulas backwards."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from kshm.chain.solve import solve_batch
from kshm.engine.engine import Engine
from kshm.engine.strength import PartStrength
from kshm.nomenclature.quantity import quantity
from kshm.results.case import Case
from kshm.results.strength import strength_results
from reports.tables.strength_members import SAFETIES, UsualStress

_STEPS = 40  # of halving the range of a size
_MAX_RATIO = 3.0  # times the size, or its third part
_ROUNDS = 4
_SPARE = 1e-6
_SMALL, _COARSE, _FINE = 1e-3, 1e-4, 1e-6  # m: sizes to tenths of a millimetre, fits to 1 µm
# Sizes that mend a value, those to be tried first; with «-» it is to be smaller.
_SIZES = {
    "st_crown_MPa": ("crown",), "st_press_MPa": ("head_wall",), "st_pull_MPa": ("head_wall",),
    "st_land_MPa": ("land",), "st_q1_MPa": ("skirt",), "st_q2_MPa": ("height",),
    "st_ring_MPa": ("-ring_gap",), "st_ring_work_MPa": ("-ring_gap",),
    "st_pin_eye_MPa": ("pin", "eye_length"), "st_pin_boss_MPa": ("pin", "pin_length"),
    "st_pin_bend_MPa": ("-pin_bore", "pin"), "st_pin_shear_MPa": ("-pin_bore", "pin"),
    "st_oval_mm": ("-pin_bore", "pin"), "st_oval_in0_MPa": ("-pin_bore", "pin"),
    "st_bush_in_MPa": ("-bush_fit", "eye_outer"), "st_cap_MPa": ("cap_length", "bolts_apart"),
    "st_eye_top_n": ("eye_outer",), "st_eye_n": ("eye_outer",),
    "st_shank_nx": ("shank",), "st_shank_ny": ("shank",), "st_bolt_n": ("bolt",),
    "st_web_n": ("web_width",),
}  # fmt: skip
_SHANK = ("shank_height", "shank_width", "shank_web", "shank_flange")


@dataclass(frozen=True, slots=True)
class Change:
    """A size to change [m]: before, after."""

    key: str
    before: float
    after: float


@dataclass(frozen=True, slots=True)
class ChangedSizes:
    """All changes, values by key before and after, in SI; what no change mends."""

    changes: tuple[Change, ...]
    before: dict[str, float]
    after: dict[str, float]
    left: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Limit:
    """A value with its greatest size or least value, and the sizes that mend it in turn."""

    key: str
    limit: float
    safety: bool
    sizes: tuple[str, ...]

    def holds(self, values: dict[str, float]) -> bool:
        """Whether the value is within its limit."""
        value = values.get(self.key)
        if value is None:
            return True
        if self.safety:
            return value >= self.limit * (1 - _SPARE)
        return abs(value) <= self.limit * (1 + _SPARE)


def changed(engine: Engine, stresses: tuple[UsualStress, ...], allowed: float) -> ChangedSizes:
    """Sizes that bring every stress below its usual limit and every safety to the allowed one.

    The loads stay those of the engine: the masses are as they were.
    """
    whole = _explicit(engine)
    case = Case(whole, solve_batch([whole]), 0)
    limits = tuple(_limits(stresses, allowed))
    before = _values(case)
    revised, failed = case, set[str]()
    for _ in range(_ROUNDS):
        for limit in limits:
            if limit.key not in failed and not limit.holds(_values(revised)):
                mended = _mended(revised, limit)
                failed |= {limit.key} if mended is None else set()
                revised = mended or revised
    after = _values(revised)
    left = tuple(limit.key for limit in limits if not limit.holds(after))
    sizes = ((key, _size(whole, key), _size(revised.engine, key)) for key in _names())
    changes = tuple(Change(*each) for each in sizes if abs(each[2] / each[1] - 1) > _SPARE)
    return ChangedSizes(changes, before, after, left)


def _names() -> Iterator[str]:
    names = dict.fromkeys(size.removeprefix("-") for sizes in _SIZES.values() for size in sizes)
    for name in names:
        yield from _SHANK if name == "shank" else (name,)


def _explicit(engine: Engine) -> Engine:
    """Return engine with every size of its parts as a number, without what has no part in it."""
    data = engine.strength or PartStrength()
    sizes = data.sizes(engine.geometry.bore, engine.crankshaft.pin_diameters[0])
    own: dict[str, Any] = {
        key: size for key, size in sizes.items() if key not in ("bore", "crankpin")
    }
    return replace(engine, strength=replace(data, **own), regimes=(), torsion=None, bearings=None,
                   counterweight=None)  # fmt: skip


def _limits(stresses: tuple[UsualStress, ...], allowed: float) -> Iterator[_Limit]:
    for each in stresses:
        si = quantity(each.key).si
        yield _Limit(each.key, each.most * si, False, _SIZES[each.key])
    for key in SAFETIES:
        yield _Limit(key, allowed, True, _SIZES[key])


def _values(case: Case) -> dict[str, float]:
    return strength_results(case)[1]


def _size(engine: Engine, name: str) -> float:
    if name == "web_width":
        return engine.balancing.web_width_share * engine.geometry.bore
    size: float = getattr(engine.strength, name)
    return size


def _with(case: Case, name: str, factor: float) -> Case:
    """Return the case with a size, or all of the shank's section, larger by a factor."""
    engine, data = case.engine, case.engine.strength
    assert data is not None
    if name == "web_width":
        share = _rounded(_size(engine, name) * factor, factor) / engine.geometry.bore
        return replace(case, engine=replace(
            engine, balancing=replace(engine.balancing, web_width_share=share)))  # fmt: skip
    names = _SHANK if name == "shank" else (name,)
    sizes: dict[str, Any] = {key: _rounded(getattr(data, key) * factor, factor) for key in names}
    return replace(case, engine=replace(engine, strength=replace(data, **sizes)))


def _rounded(size: float, factor: float) -> float:
    """Return a size [m] as a drawing has it, rounded to the safe side."""
    step = _COARSE if size >= _SMALL else _FINE
    steps = round(size / step, 6)
    return (math.ceil(steps) if factor > 1 else math.floor(steps)) * step


def _mended(case: Case, limit: _Limit) -> Case | None:
    """Return the case with the least change of the first size that mends a value."""
    for name in limit.sizes:
        smaller, key = name.startswith("-"), name.removeprefix("-")

        def tried(share: float, key: str = key, smaller: bool = smaller) -> Case:
            span = 1 + share * (_MAX_RATIO - 1)
            return _with(case, key, 1 / span if smaller else span)

        share = _least(tried, limit)
        if share is not None:
            return tried(share)
    return None


def _least(tried: Callable[[float], Case], limit: _Limit) -> float | None:
    """Least share of the greatest change that mends the value, by halving."""
    if not limit.holds(_values(tried(1.0))):
        return None
    low, high = 0.0, 1.0
    for _ in range(_STEPS):
        middle = (low + high) / 2
        low, high = (low, middle) if limit.holds(_values(tried(middle))) else (middle, high)
    return high
