"""Defaults of the input that the calculation does not take."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile
from reports.tables.cycle_names import friction_by_speed, section_of

_DEVICES = frozenset({"counterweight_share", "first_shafts_share", "second_shafts_share",
                      "suppression", "shaft_radius_mm"})  # fmt: skip


def unused(model: InputFile) -> set[str]:
    """Names of their fields: a table of data with them would deny the results."""
    devices = set(_DEVICES)
    if model.masses.rod_kg is not None:
        devices.add("rod_small_end_share")
    unused_keys = given_by_cycle(model) | {
        f"balance_{key}" for key in devices - model.balance.asked
    }
    if model.regime.indicated_power_kw is None:
        unused_keys.add("regime_fullness")
    for end in ("nose", "rear"):  # no such counterweight: neither its angle nor its arm counts
        if not getattr(model.crankshaft, f"{end}_mass_kg"):
            unused_keys |= {f"crankshaft_{end}_{key}" for key in ("mass_kg", "angle_deg", "arm_mm")}
    return unused_keys


def given_by_cycle(model: InputFile) -> set[str]:
    """Those that a calculation of the cycle finds itself."""
    cycle = section_of(model)
    if cycle is None:
        return set()
    efficiency = {"regime_mechanical_efficiency"} if friction_by_speed(cycle) else set()
    return {"regime_fullness", "regime_indicated_power_kw"} | efficiency
