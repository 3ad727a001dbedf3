"""Sizes of piston, pin and rod of a new engine: usual ones that follow the load.

Every size starts in the middle of its usual span and moves within the span while stresses leave
their usual ranges or safeties fall below the allowed one; then steels are taken stronger.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from kshm.chain.solve import ChainArrays, solve_batch
from kshm.engine.engine import Engine
from kshm.nomenclature.quantity import quantity
from kshm.ranges import PART_SHARES
from kshm.results.case import Case
from kshm.results.strength import strength_results
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.strength import StrengthSection
from reports.inputs.to_si.engine import engine_and_cycle, to_parts
from reports.inputs.units import number_text
from reports.tables.strength_members import SAFETIES, usual_stresses

Notes = dict[str, str]
Moves = tuple[tuple[str, int], ...]
_DECIMALS = {10.0: 1, 1.0: 2}  # of a size from so many millimetres
_FINE_DECIMALS = 4
_STEPS = 10  # of a usual span
_MIDDLE = _STEPS // 2
_PIN: Moves = (("pin_bore", -1), ("pin", 1), ("bosses", -1), ("eye_length", 1))
_SHANK: Moves = (("shank_width", 1), ("shank_flange", 1), ("shank_web", 1), ("shank_height", 1),
                 ("rod_material", 1))  # fmt: skip
_EYE: Moves = (("eye_outer", 1), ("eye_length", 1), ("rod_material", 1))
# What lessens a stress, or makes a part safer, by its key.
_MOVES: dict[str, Moves] = {
    "st_crown_MPa": (("crown", 1),), "st_land_MPa": (("land", 1),),
    "st_press_MPa": (("head_wall", 1),), "st_pull_MPa": (("head_wall", 1),),
    "st_q1_MPa": (("skirt", 1),), "st_q2_MPa": (("height", 1),),
    "st_ring_MPa": (("ring_gap", -1),), "st_ring_work_MPa": (("ring_gap", -1),),
    "st_pin_eye_MPa": (("eye_length", 1), ("pin", 1)),
    "st_pin_boss_MPa": (("pin_length", 1), ("bosses", -1), ("pin", 1)),
    "st_pin_bend_MPa": _PIN, "st_pin_shear_MPa": _PIN,
    "st_oval_mm": _PIN[:2], "st_oval_in0_MPa": _PIN[:2],
    "st_bush_in_MPa": (("eye_outer", 1), ("bush_wall", -1)),
    "st_cap_MPa": (("cap_length", 1), ("bolts_apart", 1)),
    "st_eye_top_n": _EYE, "st_eye_n": _EYE, "st_shank_nx": _SHANK, "st_shank_ny": _SHANK,
    "st_bolt_n": (("bolt", 1), ("bolt_material", 1)), "st_web_n": (("web_material", 1),),
}  # fmt: skip
# Steels from the weakest to the strongest that a part moves through.
_STEELS = {"rod_material": ("40h", "40hn"), "bolt_material": ("40hn", "18h2n4va"),
           "web_material": ("45", "40h", "40hn", "18h2n4va")}  # fmt: skip
# Fine threads of GOST 8724: pitch [mm] of bolts up to a diameter [mm].
_THREADS = ((11.0, 1.0), (22.0, 1.5), (33.0, 2.0), (52.0, 3.0), (math.inf, 4.0))
_BELOW = 0.2  # weight of a stress that is too small


def parts_for(model: InputFile, kind: str, crankpin: float) -> tuple[dict[str, Any], Notes]:
    """Section [strength] of an engine, sizes in mm, each with the ratio that it follows from."""
    engine, _ = engine_and_cycle(model)
    sizing = _Sizing(engine, solve_batch([engine]), kind, crankpin)
    choice: dict[str, int] = {}
    excess = sizing.excess(choice)
    while _badness(excess):
        trials = [(sizing.excess(trial), trial) for trial in _trials(choice, excess, sizing)]
        best = min(trials, key=lambda each: _badness(each[0]), default=(excess, choice))
        if _badness(best[0]) >= _badness(excess):
            break
        excess, choice = best
    return sizing.section(choice), sizing.notes(choice)


def decimals(size: float) -> int:
    """How many decimals of a millimetre a drawing gives a size."""
    return next((n for least, n in _DECIMALS.items() if abs(size) >= least), _FINE_DECIMALS)


def _badness(excess: Mapping[str, float]) -> float:
    return sum(amount if amount > 0 else -_BELOW * amount for amount in excess.values())


def _trials(
    choice: Mapping[str, int], excess: Mapping[str, float], sizing: _Sizing
) -> Iterator[dict[str, int]]:
    """Choices a step away that mend what is outside."""
    for name, amount in excess.items():
        for key, way in _MOVES[name] if amount else ():
            step = choice.get(key, sizing.start(key)) + (way if amount > 0 else -way)
            trial = {**choice, key: step}
            if 0 <= step <= sizing.last(key) and sizing.fits(trial):
                yield trial


@dataclass(frozen=True, slots=True)
class _Sizing:
    """An engine whose parts are sized; a choice is the place of each size in its span."""

    engine: Engine
    raw: ChainArrays
    kind: str
    crankpin: float

    @staticmethod
    def start(key: str) -> int:
        """Place of the middle of a span, or of the usual steel."""
        return 0 if key in _STEELS else _MIDDLE

    @staticmethod
    def last(key: str) -> int:
        """Return the last place of a span, or of the strongest steel."""
        return len(_STEELS[key]) - 1 if key in _STEELS else _STEPS

    def share(self, key: str, choice: Mapping[str, int]) -> tuple[float, float, float]:
        """Share of a size in another one and its usual span."""
        _, petrol, diesel = PART_SHARES[key]
        low, high = diesel if self.kind == "diesel" else petrol
        return low + (high - low) * choice.get(key, _MIDDLE) / _STEPS, low, high

    def section(self, choice: Mapping[str, int]) -> dict[str, Any]:
        """Section [strength] of a choice."""
        sizes = {"bore": 1000 * self.engine.geometry.bore, "crankpin": self.crankpin}
        section: dict[str, Any] = {"kind": self.kind}
        for key, (base, *_) in PART_SHARES.items():
            size = self.share(key, choice)[0] * sizes[base]
            sizes[key] = section[f"{key}_mm"] = round(size, decimals(size))
        bolt = section["bolt_mm"]
        section["bolt_pitch_mm"] = next(pitch for most, pitch in _THREADS if bolt <= most)
        steels = {key: steel[choice[key]] for key, steel in _STEELS.items() if choice.get(key)}
        return section | steels

    def fits(self, choice: Mapping[str, int]) -> bool:
        """Whether the rod's eye goes between the bosses of the piston."""
        section = self.section(choice)
        return float(section["eye_length_mm"]) < float(section["bosses_mm"])

    def notes(self, choice: Mapping[str, int]) -> Notes:
        """Ratio of every size, and that it follows the load where it is not the middle."""
        notes = {f"strength.{key}": "по нагрузке" for key in _STEELS if choice.get(key)}
        for key, (base, *_) in PART_SHARES.items():
            share, low, high = self.share(key, choice)
            of = {"bore": "D", "crankpin": "диаметра шейки"}.get(base, f"{base}_mm")
            span = f"{number_text(low)}…{number_text(high)}"
            loaded = "" if choice.get(key, _MIDDLE) == _MIDDLE else "; по нагрузке"
            words = f"{number_text(round(share, 4))} {of} (обычно {span}{loaded})"
            notes[f"strength.{key}_mm"] = words
        notes["strength.bolt_pitch_mm"] = "мелкая резьба, ГОСТ 8724"
        return notes

    def excess(self, choice: Mapping[str, int]) -> dict[str, float]:
        """Logarithm of each result over the limit that it passes, negative below; 0 within."""
        section = StrengthSection(**self.section(choice))
        case = Case(replace(self.engine, strength=to_parts(section)), self.raw, 0)
        results = strength_results(case)[1]
        excess: dict[str, float] = {}
        for each in usual_stresses(section):
            value = results[each.key] / quantity(each.key).si
            side = each.side(value)
            limit = each.most if side > 0 else each.low
            excess[each.key] = math.log(abs(value) / limit) if side and limit else 0.0
        for key in SAFETIES:
            safety = results.get(key, math.inf)
            excess[key] = max(0.0, math.log(section.safety_allowed / safety))
        return excess
