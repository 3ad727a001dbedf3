"""What an alternative keeps of the sections that describe the old shaft's parts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from reports.inputs.meta import Strictly, hints
from reports.inputs.sections.balance import BalanceSection
from reports.inputs.sections.bearings import BearingsSection
from reports.inputs.sections.torsion import TorsionSection

_DIGITS = 6  # of a millimetre
_ALONG = ("width", "groove")  # what lies along a journal
# Of [torsion]: what belongs to no certain shaft.
_ANY_SHAFT = ("formula", "shear_modulus_mpa", "loss_factor", "stress_allowed_mpa", "peaks")
_SPEEDS = ("speed_min_rpm", "speed_max_rpm")
TRAIN_LEFT = "Крутильная схема прежнего вала не перенесена: новая следует из размеров нового."


@dataclass(frozen=True, slots=True)
class Grown:
    """New sizes over old ones: journals across and along, the cylinder, the speed."""

    pin: float
    pin_length: float
    main: float
    main_length: float
    linear: float
    speed: float


def carried(sections: Mapping[str, Any], grown: Grown) -> dict[str, Any]:
    """The sections of a file as they suit the new shaft."""
    kept = dict(sections)
    if "bearings" in kept:
        kept["bearings"] = {
            key: _scaled(BearingsSection, key, value, _journal(key, grown))
            if key.endswith("_mm") else value
            for key, value in kept["bearings"].items()
        }  # fmt: skip
    if "balance" in kept:
        key = "shaft_radius_mm"
        radius = _scaled(BalanceSection, key, kept["balance"][key], grown.linear)
        kept["balance"] = kept["balance"] | {key: radius}
    if "torsion" in kept:
        kept["torsion"] = _train(kept["torsion"], grown)
    return kept


def _journal(key: str, grown: Grown) -> float:
    along = any(word in key for word in _ALONG)
    if key.startswith("main_"):
        return grown.main_length if along else grown.main
    return grown.pin_length if along else grown.pin


def _train(old: Mapping[str, Any], grown: Grown) -> dict[str, Any]:
    """What is left out is estimated from the new shaft."""
    kept = {key: old[key] for key in _ANY_SHAFT if key in old}
    if grown.speed == 1:
        kept |= {key: old[key] for key in _SPEEDS if key in old}
    bores = {"main_bore_mm": grown.main, "pin_bore_mm": grown.pin}
    return kept | {key: _scaled(TorsionSection, key, old[key], by) for key, by in bores.items()}


def _scaled(section: type[Strictly], key: str, size: float, factor: float) -> float:
    """A size within the limits of its key [mm]."""
    (limits,) = hints(section)[key].metas
    low, high = limits.minimum, limits.maximum
    return min(max(round(size * factor, _DIGITS), low or 0.0), math.inf if high is None else high)
