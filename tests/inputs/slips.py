"""Slips of unit, decimal or key in an input mapping, and random engines to make them in."""

import copy
import math
import random

from reports.inputs.load import load_mapping
from reports.shared.errors import InputError

FACTORS = (10, 100, 1000, 0.1, 0.01, 0.001)
# (keys, keys): two that a person may take for each other.
SWAPPED = (
    ("crankshaft.pin_diameter_mm", "crankshaft.main_diameter_mm"),
    ("crankshaft.pin_diameter_mm", "crankshaft.pin_length_mm"),
    ("geometry.bore_mm", "geometry.crank_radius_mm"),
    ("geometry.rod_length_mm", "geometry.crank_radius_mm"),
    ("geometry.bore_mm", "crankshaft.pin_length_mm"),
    ("gas.compression_exponent", "gas.expansion_exponent"),
    ("gas.intake_pressure_mpa", "gas.max_pressure_mpa"),
    ("gas.ambient_pressure_mpa", "gas.max_pressure_mpa"),
    ("gas.exhaust_start_before_bdc_deg", "gas.exhaust_end_after_bdc_deg"),
    ("gas.injection_advance_deg", "gas.ignition_delay_deg"),
    ("regime.speed_rpm", "regime.indicated_power_kw"),
    ("geometry.compression_ratio", "gas.preexpansion_ratio"),
    ("crankshaft.arms.0.l1_mm", "crankshaft.main_diameter_mm"),
)


def numbers(part, path=()):
    """Every number of a mapping that is not zero; of lists the first entry stands for all."""
    if isinstance(part, dict):
        for key, value in part.items():
            yield from numbers(value, (*path, key))
    elif isinstance(part, list):
        for value in part[:1]:
            yield from numbers(value, (*path, 0))
    elif isinstance(part, int | float) and not isinstance(part, bool) and part:
        yield path, part


def at(raw, path):
    """The value at a path, or None."""
    for key in path:
        try:
            raw = raw[key]
        except (KeyError, IndexError, TypeError):
            return None
    return raw


def changed(raw, *pairs):
    """A copy with other values at some paths."""
    result = copy.deepcopy(raw)
    for path, value in pairs:
        at(result, path[:-1])[path[-1]] = value
    return result


def path_of(key):
    """``crankshaft.webs.0.mass_kg`` as a path."""
    return tuple(int(part) if part.isdigit() else part for part in key.split("."))


def plain(path):
    """A path without the numbers of lists."""
    return ".".join(part for part in path if isinstance(part, str))


def remarks_of(raw):
    """The lines of everything that is said of a mapping, errors or warnings."""
    try:
        return [problem.line() for problem in load_mapping(raw, source="f").warnings]
    except InputError as error:
        return error.lines()


def random_engine(seed):
    """An engine in line whose sizes, masses and pressures go together."""
    rng = random.Random(seed)
    diesel, count = rng.random() < 0.5, rng.choice((1, 2, 3, 4, 5, 6, 8))
    bore = rng.uniform(60, 200)
    stroke = bore * rng.uniform(0.8, 1.35)
    area = math.pi * (bore / 1000) ** 2 / 4 * max(1, bore / 150)
    heavy = 1.0 if diesel else 0.4
    pin, main = bore * rng.uniform(0.5, 0.65), bore * rng.uniform(0.66, 0.8)
    offsets = [round(720 * i / count, 6) for i in range(count)]
    arms = {f"l{i}_mm": bore * rng.uniform(0.12, 0.25) for i in (1, 2, 5, 6)}
    room = 2 * min(arms["l1_mm"], arms["l6_mm"])
    # Cylinders stand beside each other.
    thick = max(bore * 0.2, (bore * 1.05 - sum(arms.values())) / 2)
    web = {"mass_kg": area * 80, "counterweight_kg": area * rng.uniform(80, 250)}
    ratio = rng.uniform(14, 20) if diesel else rng.uniform(8, 11)
    rise = rng.uniform(1.3, 1.9) if diesel else rng.uniform(2.5, 4)
    intake, n_1 = rng.uniform(0.08, 0.2), rng.uniform(1.33, 1.38)
    return {
        "engine": {"cylinders": count},
        "geometry": {
            "bore_mm": bore,
            "crank_radius_mm": stroke / 2,
            "rod_length_mm": stroke / 2 / rng.uniform(0.24, 0.31),
            "compression_ratio": ratio,
        },
        "regime": {
            "speed_rpm": 30000 * rng.uniform(8, 16) / stroke,
            "mechanical_efficiency": rng.uniform(0.75, 0.88),
        },
        "gas": {
            "source": "polytropic",
            "intake_pressure_mpa": intake,
            "residual_pressure_mpa": max(intake, 0.1) * rng.uniform(1.02, 1.2),
            "max_pressure_mpa": rise * intake * ratio**n_1,
            "compression_exponent": n_1,
            "expansion_exponent": rng.uniform(1.23, 1.29),
            "preexpansion_ratio": rng.uniform(1.2, 1.6) if diesel else 1.05,
            "injection_advance_deg": rng.uniform(12, 30),
            "ignition_delay_deg": rng.uniform(6, 11),
            "exhaust_start_before_bdc_deg": rng.uniform(45, 65),
            "exhaust_end_after_bdc_deg": rng.uniform(15, 30),
        },
        "masses": {
            "piston_group_kg": area * heavy * rng.uniform(220, 350),
            "rod_kg": area * heavy * rng.uniform(270, 380),
            "rod_small_end_share": rng.uniform(0.25, 0.29),
        },
        "crankshaft": {
            "firing_offsets_deg": offsets,
            "pin_diameter_mm": pin,
            "pin_length_mm": min(pin * rng.uniform(0.45, 0.8), arms["l2_mm"] + arms["l5_mm"]),
            "main_diameter_mm": main,
            "main_lengths_mm": [min(main * rng.uniform(0.35, 0.6), room)] * (count + 1),
            "pin_mass_kg": area * rng.uniform(70, 200),
            "webs": [dict(web) for _ in range(2 * count)],
            "arms": [{**arms, "left_web_mm": thick, "right_web_mm": thick} for _ in range(count)],
        },
    }
