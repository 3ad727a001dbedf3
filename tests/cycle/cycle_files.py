"""Input files with a cycle: the samples and their variants on a coarse grid."""

from __future__ import annotations

from typing import Any

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from tests.conftest import sample

SAMPLES = ("cycle-turbo-diesel", "cycle-tractor-diesel", "cycle-petrol", "cycle-turbo-petrol")
GONE = object()


def raw_of(name: str, changes: dict[str, Any] | None = None) -> dict[str, Any]:
    """A sample's mapping with some keys ``section.key`` changed or gone."""
    raw = to_mapping(sample(name))
    raw["calculation"]["step_deg"] = 30
    for path, value in (changes or {}).items():
        section, key = path.split(".")
        if value is GONE:
            raw[section].pop(key, None)
        else:
            raw[section][key] = value
    return raw


def loaded(name: str, changes: dict[str, Any] | None = None) -> InputFile:
    return load_mapping(raw_of(name, changes), source="f.toml").model


# Bore and stroke given: what the design mode leaves out comes back.
GIVEN_SIZES = {
    "cycle.power_kw": GONE,
    "cycle.stroke_bore": GONE,
    "cycle.size_step_mm": GONE,
    "cycle.rounding": GONE,
    "geometry.bore_mm": 88.0,
    "geometry.stroke_mm": 94.0,
}
OWN_FUEL = {
    "cycle.fuel": "own",
    "cycle.fuel_carbon": 0.86,
    "cycle.fuel_hydrogen": 0.13,
    "cycle.fuel_oxygen": 0.01,
    "cycle.fuel_heating_value_mj_kg": 42.0,
}
VARIANTS: dict[str, tuple[str, dict[str, Any]]] = {
    "as it is": ("cycle-turbo-diesel", {}),
    "sizes given": ("cycle-turbo-diesel", GIVEN_SIZES),
    "own fuel": ("cycle-turbo-diesel", OWN_FUEL),
    "defaults of the sizes": (
        "cycle-turbo-diesel",
        {"cycle.size_step_mm": GONE, "cycle.rounding": GONE},
    ),
    "no cooler": (
        "cycle-turbo-diesel",
        {"cycle.cooler_loss_mpa": GONE, "cycle.cooler_drop_k": GONE},
    ),
    "pumping": ("cycle-turbo-diesel", {"cycle.pumping": "yes"}),
    # T_z below 1500 °C: Newton's passes instead of the closed form.
    "very lean": (
        "cycle-tractor-diesel",
        {"cycle.excess_air": 4.5, "cycle.max_pressure_mpa": 5.0, "cycle.power_kw": 20.0},
    ),
    # T_z between 1400 and 1500 °C: in the blend of the two heat capacities.
    "lean": (
        "cycle-tractor-diesel",
        {"cycle.excess_air": 2.45, "cycle.max_pressure_mpa": 6.0, "cycle.power_kw": 40.0},
    ),
    "losses by speed": (
        "cycle-tractor-diesel",
        {
            "regime.mechanical_efficiency": GONE,
            "cycle.friction_a_mpa": 0.089,
            "cycle.friction_b_mpa_s_m": 0.0118,
        },
    ),
    "derived regimes": (
        "cycle-tractor-diesel",
        {
            "cycle.adaptability": GONE,
            "cycle.torque_speed_rpm": GONE,
            "cycle.idle_speed_rpm": GONE,
            "cycle.speed_law": "diesel_swirl",
        },
    ),
    "large losses": ("cycle-petrol", {"cycle.friction_b_mpa_s_m": 0.035}),
    "rich": ("cycle-petrol", {"cycle.excess_air": 0.8}),
    "lean petrol": ("cycle-petrol", {"cycle.excess_air": 1.15}),
    "ethanol": ("cycle-turbo-petrol", {"cycle.fuel": "ethanol"}),
    "start given": ("cycle-turbo-petrol", {"gas.combustion_start_deg": 350.0}),
}
