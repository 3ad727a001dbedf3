"""Inputs that the file leaves out and the scalars that take their place in the formulas."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile


def size_stand_ins(model: InputFile) -> dict[str, str]:
    """Sizes of a single journal where the input gives one size for all."""
    shaft, throws = model.crankshaft, len(model.crankshaft.throw_angles_deg)
    sizes = (
        ("pin_diameter", shaft.pin_diameters_mm, throws),
        ("pin_length", shaft.pin_lengths_mm, throws),
        ("main_diameter", shaft.main_diameters_mm, throws + 1),
    )
    return {
        f"{name}_{number}_mm": f"crankshaft_{name}_mm"
        for name, each, count in sizes
        if each is None
        for number in range(1, count + 1)
    }


def mass_stand_ins(model: InputFile) -> dict[str, str]:
    """Masses that the sheet of masses finds."""
    given, names = model.masses, {}
    if given.reciprocating_kg is None:
        if given.rod_centre_mm is None and given.rod_small_end_share is None:
            names["masses_rod_small_end_share"] = "rod_share"
        if given.piston_group_kg is None:
            names["masses_piston_group_kg"] = "m_piston"
        if given.rod_kg is None:
            names["masses_rod_kg"] = "m_rod"
    if model.crankshaft.pin_mass_kg is None:
        names["crankshaft_pin_mass_kg"] = "pin_est"
    for number, web in enumerate(model.crankshaft.webs, 1):
        if web.actual_mass_kg is not None:
            names[f"web_{number}_mass_kg"] = f"web_red{number}"
        elif web.mass_kg is None:
            names[f"web_{number}_mass_kg"] = "web_est"
    return names
