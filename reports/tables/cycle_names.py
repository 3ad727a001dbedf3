"""How the formulas name the inputs of the cycle that may be given or computed."""

from __future__ import annotations

from reports.inputs.sections.gas import CycleSection
from reports.inputs.sections.input_file import DesignGeometrySection, InputFile

# What the formulas of the indicator diagram call their parameters when the cycle gives them.
GAS_NAMES = {
    "gas_intake_pressure_mpa": "cyc_p_a",
    "gas_residual_pressure_mpa": "cyc_p_r",
    "gas_max_pressure_mpa": "cyc_p_z",
    "gas_compression_exponent": "cyc_n1",
    "gas_expansion_exponent": "cyc_n2",
    "gas_preexpansion_ratio": "cyc_rho",
}


def section_of(model: InputFile) -> CycleSection | None:
    """The [cycle] section when the gas comes from it."""
    return model.cycle if model.gas.source == "cycle" else None


def cycle_stand_ins(model: InputFile) -> dict[str, str]:
    """Inputs of [gas] and the results of the cycle that take their place."""
    return {} if section_of(model) is None else GAS_NAMES


def sizes_are_found(model: InputFile) -> bool:
    """Whether bore and stroke follow from the wanted power."""
    return isinstance(model.geometry, DesignGeometrySection)


def is_boosted(section: CycleSection) -> bool:
    """Whether there is a turbocharger."""
    return section.boost_ratio is not None


def friction_by_speed(section: CycleSection) -> bool:
    """Whether mechanical losses follow the piston speed, A + B c_m."""
    return section.friction_a_mpa is not None
