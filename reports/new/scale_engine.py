"""An alternative of an engine with another number of cylinders, by the similarity rules.

The same total displacement: D, S, L × (n₁/n)^⅓ and journals × (n₁/n)^½, n₁ the cylinders of
the given engine and n those of the new one.  A wanted power changes the displacement: then
all sizes take its cube root besides.  All are rounded as on a drawing.  As journals shrink
faster than the bore, many cylinders from few would get a shaft that no engine has: d/D stays
within its usual bounds, and says so.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from kshm.engine.arrangement import rods_beside
from reports.inputs.checks.bands import BANDS, stated_kind
from reports.inputs.fields import to_mapping
from reports.inputs.firing import arrangement_of
from reports.inputs.meta import StrictModel, hints
from reports.inputs.sections.bearings import BearingsSection
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.mechanism import BalanceSection
from reports.inputs.sections.torsion import TorsionSection
from reports.inputs.to_si.engine import engine_and_cycle
from reports.inputs.to_si.masses import ROD_SHARE
from reports.inputs.units import MM, number_text
from reports.new.default_firing import phases
from reports.new.generate import (
    NewEngine,
    ShaftSizes,
    rods_of,
    shaft,
    table_masses,
    throws_of,
    timing_notes,
    usual_shaft,
)
from reports.new.part_sizes import decimals

_ALONG = ("width", "groove")  # what lies along a journal
# Of [torsion]: what belongs to no certain shaft.
_ANY_SHAFT = ("formula", "shear_modulus_mpa", "loss_factor", "stress_allowed_mpa", "peaks")
_SPEEDS = ("speed_min_rpm", "speed_max_rpm")
TRAIN_LEFT = "Крутильная схема прежнего вала не перенесена: новая следует из размеров нового."
_POWER_DIGITS = 3  # of a kilowatt
_SURE_DIGITS = 6  # beyond which a size is not exact
_DIESEL_RATIO = 14.0
_OFFSETS = ("crank_offset_mm", "pin_offset_mm")
_SIZING = ("power_kw", "stroke_bore", "size_step_mm", "rounding")
_MIN_BETWEEN = 1.08  # axes of neighbours over the bore: the nearest of the samples have 1.085
_APART = ("crankshaft.main_lengths_mm", "crankshaft.arms.left_web_mm")  # what sets them apart
_PIN_LENGTH = "pin_length_mm"
_SINGLE = ("pin_diameter_mm", _PIN_LENGTH, "main_diameter_mm")


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
    """Sections of a file adapted to the new shaft."""
    resized = dict(sections)
    if "bearings" in resized:
        resized["bearings"] = {
            key: _scaled(BearingsSection, key, value, _journal(key, grown))
            if key.endswith("_mm") else value
            for key, value in resized["bearings"].items()
        }  # fmt: skip
    if "balance" in resized:
        key = "shaft_radius_mm"
        radius = _scaled(BalanceSection, key, resized["balance"][key], grown.linear)
        resized["balance"] = resized["balance"] | {key: radius}
    if "torsion" in resized:
        resized["torsion"] = _train(resized["torsion"], grown)
    return resized


def _journal(key: str, grown: Grown) -> float:
    along = any(word in key for word in _ALONG)
    if key.startswith("main_"):
        return grown.main_length if along else grown.main
    return grown.pin_length if along else grown.pin


def _train(old: Mapping[str, Any], grown: Grown) -> dict[str, Any]:
    """Section [torsion] without the old train; the new one is estimated."""
    retained = {key: old[key] for key in _ANY_SHAFT if key in old}
    if grown.speed == 1:
        retained |= {key: old[key] for key in _SPEEDS if key in old}
    bores = {"main_bore_mm": grown.main, "pin_bore_mm": grown.pin}
    return retained | {key: _scaled(TorsionSection, key, old[key], by) for key, by in bores.items()}


def _scaled(section: type[StrictModel], key: str, size: float, factor: float) -> float:
    """Return a size within the limits of its key [mm]."""
    (limits,) = hints(section)[key].metas
    low, high = limits.minimum, limits.maximum
    return min(max(_drawn(size * factor), low or 0.0), math.inf if high is None else high)


def alternative(
    model: InputFile,
    cylinders: int,
    *,
    layout: str | None = None,
    speed_rpm: float | None = None,
    displacement: float = 1.0,
    cause: str = "",
) -> NewEngine:
    """Return the engine of ``model`` with another number of cylinders.

    Args:
        model: The engine to start from.
        cylinders: How many the new one has.
        layout: Its layout, by default the old one.
        speed_rpm: Its speed, by default the old one.
        displacement: New total displacement over the old one.
        cause: Why it changes, for the head of the file.

    Raises:
        InputError: there is no such engine.
    """
    old = model.engine
    layout = layout or old.layout
    timing = phases(cylinders, layout, old.strokes)
    share, larger = old.cylinders / cylinders, displacement ** (1 / 3)
    linear, journal = share ** (1 / 3) * larger, share ** (1 / 2) * larger
    found_sizes = engine_and_cycle(model)[0].geometry
    bore, stroke, rod = (
        _drawn(MM.from_si(size) * linear)
        for size in (found_sizes.bore, 2 * found_sizes.crank_radius, found_sizes.rod_length)
    )
    kind = kind_of(model)
    data = to_mapping(model)
    data["engine"] |= {
        "name": f"{old.name}: вариант, число цилиндров {cylinders}",
        "cylinders": cylinders,
        "layout": layout,
    }
    offsets = {key: _drawn(data["geometry"][key] * linear)
               for key in _OFFSETS if key in data["geometry"]}  # fmt: skip
    # The piston of an engine with an offset goes further than 2r.
    way = {"crank_radius_mm": stroke / 2} if any(offsets.values()) else {"stroke_mm": stroke}
    data["geometry"] = {
        "bore_mm": bore, **way, "rod_length_mm": rod,
        "compression_ratio": data["geometry"]["compression_ratio"], **offsets,
    }  # fmt: skip
    faster = 1.0 if speed_rpm is None else speed_rpm / model.regime.speed_rpm
    if speed_rpm is not None:
        data["regime"]["speed_rpm"] = speed_rpm
    for regime in (data["regime"], *data.get("regimes", ())):
        if "indicated_power_kw" in regime:
            power = regime["indicated_power_kw"] * displacement * faster
            regime["indicated_power_kw"] = round(power, _POWER_DIGITS)
    for key in _SIZING:
        data.get("cycle", {}).pop(key, None)
    sizes = _shaft(model, layout, kind, bore, journal, throws_of(cylinders, layout))
    part = model.masses.rod_small_end_share or ROD_SHARE
    data["masses"], throw = table_masses(layout, kind, bore, stroke, part)
    data["crankshaft"] = shaft(layout, timing, sizes, throw)
    for name in ("articulated", "variants", "checks"):
        data.pop(name, None)
    data = carried(data, _grown(model, layout, sizes, linear, faster))
    linear_words = f"× ({old.cylinders}/{cylinders})^⅓"
    more = f" × {number_text(round(displacement, 6))}^⅓" if displacement != 1 else ""
    notes = {
        **{f"geometry.{key}": f"{linear_words}{more}"
           for key in ("bore_mm", *way, "rod_length_mm")},
        **throw.notes, **sizes.notes, **timing_notes(timing),
    }  # fmt: skip
    head = [
        f"Вариант двигателя «{old.name}»: цилиндров {cylinders} вместо {old.cylinders}.",
        f"По подобию: D, S, L {linear_words}{more}; шейки × ({old.cylinders}/{cylinders})^½{more};",
        "округлено до 0,1 мм; массы по таблице 4; фазы, щёки и плечи составлены заново.",
        *([f"{cause}: рабочий объём × {number_text(round(displacement, 6))}."] if cause else
          ["Рабочий объём, частота вращения и давления прежние." if speed_rpm is None else
           "Рабочий объём и давления прежние, частота вращения новая."]),
    ]  # fmt: skip
    if model.articulated is not None:
        head.append("Прицепные шатуны не перенесены: шатуны стоят рядом на шейке.")
    if model.torsion is not None:
        head.append(TRAIN_LEFT)
    return NewEngine(data, notes, tuple(head))


def kind_of(model: InputFile) -> str:
    """Kind of engine as stated, else by the compression ratio."""
    burnt = "diesel" if model.geometry.compression_ratio >= _DIESEL_RATIO else "petrol"
    return stated_kind(model) or burnt


def _shaft(
    model: InputFile, layout: str, kind: str, bore: float, factor: float, throws: int
) -> ShaftSizes:
    """Journals of the old shaft by the rule; lists of other length by their mean."""
    old = model.crankshaft
    usual = usual_shaft(layout, kind, bore, throws)
    rods = _rods(model, layout)
    sized = {key: _one(old, key) * (rods if key == _PIN_LENGTH else 1) for key in _SINGLE}
    by_rule = {key: _drawn(size * factor) for key, size in sized.items()}
    retained = {key: _bounded(key, by_rule[key], bore) for key in _SINGLE}
    before = old.main_lengths_mm
    if len(before) != throws + 1:
        before = (sum(before) / len(before),) * (throws + 1)
    thick = [web for arms in old.arms for web in (arms.left_web_mm, arms.right_web_mm) if web]
    web = _drawn(sum(thick) / len(thick) * factor) if thick else usual.web
    rule = "по правилу (n₁/n)^½"
    notes = {f"crankshaft.{key}": rule for key in _SINGLE}
    if rods != 1:
        notes[f"crankshaft.{_PIN_LENGTH}"] += f", шатунов рядом {rods_of(layout)}"
    for key in _SINGLE:
        if retained[key] != by_rule[key]:
            share = number_text(round(retained[key] / bore, 2))
            would = f"{rule} вышло бы {number_text(by_rule[key])}"
            notes[f"crankshaft.{key}"] = f"{would}; принято {share} D, край обычного"
    notes["crankshaft.main_lengths_mm"] = rule + (
        "" if len(old.main_lengths_mm) == throws + 1 else ", средняя длина прежних"
    )
    notes["crankshaft.arms.left_web_mm"] = rule if thick else "обычная"
    lengths = tuple(_drawn(value * factor) for value in before)
    pin, length, main = (retained[key] for key in _SINGLE)
    every = 2 if layout == "opposed" else 1
    between = every * (min(map(sum, pairwise(lengths))) / 2 + 2 * web + length)
    if throws > every and between < _MIN_BETWEEN * bore:
        longer = (_MIN_BETWEEN * bore - every * length) / (between - every * length)
        lengths, web = tuple(_up(value * longer) for value in lengths), _up(web * longer)
        notes |= dict.fromkeys(_APART, _apart_words(rule, between / bore))
    return ShaftSizes(pin, length, main, lengths, web, notes)


def _apart_words(rule: str, between: float) -> str:
    return (
        f"{rule} между осями цилиндров вышло бы {number_text(round(between, 3))} D; "
        f"шейки и щёки удлинены до {number_text(_MIN_BETWEEN)} D"
    )


def _rods(model: InputFile, layout: str) -> float:
    """Rods side by side on a new pin over those on an old one."""
    return rods_of(layout) / rods_beside(arrangement_of(model), 0)


def _grown(model: InputFile, layout: str, sizes: ShaftSizes, linear: float, faster: float) -> Grown:
    """Return the new shaft over the old one, along a pin that of one rod."""
    old = model.crankshaft
    before = sum(old.main_lengths_mm) / len(old.main_lengths_mm)
    return Grown(
        pin=sizes.pin / _one(old, "pin_diameter_mm"),
        pin_length=sizes.pin_length / _rods(model, layout) / _one(old, _PIN_LENGTH),
        main=sizes.main / _one(old, "main_diameter_mm"),
        main_length=sum(sizes.main_lengths) / len(sizes.main_lengths) / before,
        linear=linear,
        speed=faster,
    )


def _bounded(key: str, size: float, bore: float) -> float:
    """Journal size within the usual bounds over the bore [mm]."""
    for band in BANDS:
        if band.key == f"crankshaft.{key}" and not band.low <= size / bore <= band.high:
            bound = band.low if size < band.low * bore else band.high
            edge = float(bound * bore)
            return _up(edge) if bound == band.low else -_up(-edge)
    return size


def _up(size: float) -> float:
    """Return a size with its last digit rounded up [mm]."""
    digits = decimals(size)
    return float(math.ceil(round(size * 10**digits, _SURE_DIGITS)) / 10**digits)


def _drawn(size: float) -> float:
    """Return a size as a drawing gives it [mm]."""
    return round(size, decimals(size))


def _one(shaft_data: Any, key: str) -> float:  # noqa: ANN401
    """Size of all journals, or their mean."""
    size = getattr(shaft_data, key)
    values = getattr(shaft_data, key.replace("_mm", "s_mm")) if size is None else size
    if isinstance(values, tuple | list):
        return float(sum(values) / len(values))
    return float(values)
