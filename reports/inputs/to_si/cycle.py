"""From the [cycle] section to the solver's cycle, and its errors back to keys of the file."""

from __future__ import annotations

from dataclasses import replace

from kshm.cycle.errors import CycleError, Remark
from kshm.cycle.fuel import FUELS, Fuel
from kshm.cycle.inputs import Boost, CycleInputs, FrictionLaw
from kshm.cycle.run import CycleRun, Wanted, run_cycle
from kshm.cycle.speed_characteristic import LEIDERMAN, Leiderman, from_adaptability
from reports.inputs.cycle_texts import path_of, text_of
from reports.inputs.findings import Finding
from reports.inputs.sections.cycle import CycleSection
from reports.inputs.sections.gas import CycleGasSection
from reports.inputs.sections.input_file import GeometrySection, InputFile
from reports.inputs.to_si.geometry import crank_radius_mm, rod_length_mm
from reports.inputs.units import KELVIN, KJ_KG_K, KW, MJ_KG, MM, MPA, RPM


def cycle_run(model: InputFile) -> CycleRun | None:
    """The calculated cycle of an input whose gas forces come from it, else None.

    Raises:
        CycleError: no cycle follows from the input.
    """
    section = model.cycle
    if section is None or not isinstance(model.gas, CycleGasSection):
        return None
    wanted = None
    if section.power_kw is not None and section.stroke_bore is not None:
        wanted = Wanted(
            power=KW.to_si(section.power_kw),
            stroke_bore=float(section.stroke_bore),
            step=MM.to_si(size_step_mm(section)),
            rounding=section.rounding or "nearest",
        )
    return run_cycle(
        cycle_inputs(model, section, model.gas),
        wanted,
        speed_law(model, section),
        omega_torque=RPM.given(section.torque_speed_rpm),
        omega_idle=RPM.given(section.idle_speed_rpm),
    )


def size_step_mm(section: CycleSection) -> float:
    """Step of the series of bores and strokes [mm], 1 mm unless given."""
    return 1.0 if section.size_step_mm is None else float(section.size_step_mm)


def cycle_inputs(model: InputFile, section: CycleSection, gas: CycleGasSection) -> CycleInputs:
    """The solver's inputs in SI; bore and stroke stay open when a power is wanted."""
    geometry = model.geometry
    bore = stroke = None
    if isinstance(geometry, GeometrySection):
        bore = MM.to_si(geometry.bore_mm)
        stroke = 2 * MM.to_si(crank_radius_mm(geometry))
        lam = crank_radius_mm(geometry) / rod_length_mm(geometry)
    else:
        lam = float(geometry.lambda_)
    a, b = section.friction_a_mpa, section.friction_b_mpa_s_m
    friction = FrictionLaw(MPA.to_si(a or 0.0), MPA.to_si(b or 0.0))
    return CycleInputs(
        kind=section.kind,
        fuel=fuel_of(section),
        omega=RPM.to_si(model.regime.speed_rpm),
        cylinders=model.engine.cylinders,
        compression_ratio=float(geometry.compression_ratio),
        excess_air=float(section.excess_air),
        charge_heating=KELVIN.to_si(section.charge_heating_k),
        t_residual=KELVIN.to_si(section.residual_temperature_k),
        intake_factor=float(section.intake_factor),
        exhaust_factor=float(section.exhaust_factor),
        xi_z=float(section.xi_z),
        xi_b=float(section.xi_b),
        fullness=float(section.fullness),
        mechanical=float(model.regime.mechanical_efficiency) if a is None else friction,
        p_max=MPA.given(section.max_pressure_mpa),
        boost=_boost(section),
        bore=bore,
        stroke=stroke,
        lam=lam,
        p_ambient=MPA.to_si(gas.ambient_pressure_mpa),
        t_ambient=KELVIN.to_si(section.ambient_temperature_k),
        recharge=float(section.recharge),
        scavenging=float(section.scavenging),
        h2_co=0.5 if section.h2_co_ratio is None else float(section.h2_co_ratio),
        subtract_pumping=section.pumping == "yes",
        strokes=model.engine.strokes,
    )


def fuel_of(section: CycleSection) -> Fuel:
    """A fuel of the list or of the file's own composition."""
    if section.fuel != "own":
        return FUELS[section.fuel]
    return Fuel(
        carbon=float(section.fuel_carbon or 0.0),
        hydrogen=float(section.fuel_hydrogen or 0.0),
        oxygen=float(section.fuel_oxygen or 0.0),
        heating_value=MJ_KG.to_si(section.fuel_heating_value_mj_kg or 0.0),
        vapour_molar_mass=float(section.fuel_molar_mass_kg_kmol or 100.0),
        source="input",
    )


def _boost(section: CycleSection) -> Boost | None:
    if section.boost_ratio is None:
        return None
    outlet, heat = section.turbine_outlet_ratio, section.exhaust_heat_kj_kg_k
    return Boost(
        pressure_ratio=float(section.boost_ratio),
        compressor_efficiency=float(section.compressor_efficiency or 0.0),
        turbine_efficiency=float(section.turbine_efficiency or 0.0),
        cooler_pressure_loss=MPA.to_si(section.cooler_loss_mpa or 0.0),
        cooler_temperature_drop=KELVIN.to_si(section.cooler_drop_k or 0.0),
        outlet_pressure_ratio=1.03 if outlet is None else float(outlet),
        exhaust_cp=1150.0 if heat is None else KJ_KG_K.to_si(heat),
    )


def speed_law(model: InputFile, section: CycleSection) -> Leiderman:
    """Coefficients of the external speed characteristic.

    Raises:
        CycleError: K and n_M that no characteristic has.
    """
    base = LEIDERMAN[section.speed_law or section.kind]
    if section.adaptability is None or section.torque_speed_rpm is None:
        return base
    ratio = section.torque_speed_rpm / model.regime.speed_rpm
    return from_adaptability(float(section.adaptability), ratio, base)


def cycle_and_findings(model: InputFile) -> tuple[CycleRun | None, list[Finding]]:
    """The cycle and what it says itself: the error that stops it, or its remarks."""
    try:
        run = cycle_run(model)
    except CycleError as error:
        return None, [_finding(error.remark)]
    if run is None:
        return None, []
    return run, [
        replace(_finding(remark), path=("cycle",), warning=True) for remark in run.cycle.warnings
    ]


def _finding(remark: Remark) -> Finding:
    what, _, hint = text_of(remark).partition("; ")
    return Finding(path_of(remark.field), what, hint)
