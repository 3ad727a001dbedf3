"""The working cycle as the tables see it: names of its results, what it gives, usual ranges."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from kshm.nomenclature.dizdn_listing import EXTRA, INPUTS, OUTPUTS
from kshm.ranges import cycle_ranges
from reports.inputs.sections.gas import CycleSection
from reports.inputs.sections.input_file import DesignGeometrySection, InputFile

UNCHECKED = "обычные значения, с книгой не сверены"

# Where the results and inputs with a usual range stand among the scalars and inputs.
_RANGE_NAMES = {
    "inputs.excess_air": "cycle_excess_air",
    "inputs.charge_heating": "cycle_charge_heating_k",
    "inputs.t_residual": "cycle_residual_temperature_k",
    "inputs.recharge": "cycle_recharge",
    "inputs.scavenging": "cycle_scavenging",
    "inputs.xi_z": "cycle_xi_z",
    "inputs.xi_b": "cycle_xi_b",
    "inputs.fullness": "cycle_fullness",
    "charge.gamma": "cyc_gamma",
    "charge.t_a": "cyc_T_a",
    "charge.eta_v": "cyc_eta_v",
    "compression.n_1": "cyc_n1",
    "compression.p_c": "cyc_p_c",
    "compression.t_c": "cyc_T_c",
    "combustion.lambda_p": "cyc_lambda_p",
    "combustion.t_z": "cyc_T_z",
    "combustion.p_z": "cyc_p_z",
    "expansion.n_2": "cyc_n2",
    "expansion.p_b": "cyc_p_b",
    "expansion.t_b": "cyc_T_b",
    "effective.eta_m": "cyc_eta_m",
    "indicated.p_i": "cyc_p_i",
}
# What the formulas of the indicator diagram call their parameters when the cycle gives them.
GAS_NAMES = {
    "gas_intake_pressure_mpa": "cyc_p_a",
    "gas_residual_pressure_mpa": "cyc_p_r",
    "gas_max_pressure_mpa": "cyc_p_z",
    "gas_compression_exponent": "cyc_n1",
    "gas_expansion_exponent": "cyc_n2",
    "gas_preexpansion_ratio": "cyc_rho",
}


@dataclass(frozen=True, slots=True)
class CycleRange:
    """Limits of a scalar or an input with their unit, what they are of and from where."""

    name: str
    low: float
    high: float
    unit: str
    note: str
    source: str


def section_of(model: InputFile) -> CycleSection | None:
    """Return the [cycle] section when the gas comes from it."""
    return model.cycle if model.gas.source == "cycle" else None


def cycle_stand_ins(model: InputFile) -> dict[str, str]:
    """Return inputs of [gas] and the results of the cycle that take their place."""
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


def given_by_cycle(model: InputFile) -> set[str]:
    """Those that a calculation of the cycle finds itself."""
    cycle = section_of(model)
    if cycle is None:
        return set()
    efficiency = {"regime_mechanical_efficiency"} if friction_by_speed(cycle) else set()
    return {"regime_fullness", "regime_indicated_power_kw"} | efficiency


def ranges_of(section: CycleSection) -> Iterator[CycleRange]:
    """Usual ranges of a cycle of this kind."""
    titles = {q.key: q for q in (*OUTPUTS, *EXTRA)}
    titles |= {f"inputs.{q.key}": q for q in INPUTS}
    for key, (low, high), source in cycle_ranges(section.kind, boosted=is_boosted(section)):
        quantity = titles[key]
        note = f"{quantity.title} {quantity.symbol.replace('_', '')}"
        yield CycleRange(_RANGE_NAMES[key], low, high, quantity.unit, note, source or UNCHECKED)
