"""From the input file in user units to the solver's engine in SI."""

from __future__ import annotations

from kshm.cycle.diagram import polytropic_gas
from kshm.cycle.run import CycleRun
from kshm.engine.arrangement import ArticulatedRod, hung
from kshm.engine.crankshaft import Crankshaft, EndMass, Throw, Web
from kshm.engine.engine import Balancing, Engine, Geometry, OperatingPoint
from kshm.engine.gas import Gas, PolytropicGas, TabulatedGas
from kshm.nomenclature.quantity import smallness
from reports.inputs.firing import arrangement_of
from reports.inputs.sections.articulated import ArticulatedSection
from reports.inputs.sections.balance import BalanceSection
from reports.inputs.sections.crankshaft import ArmsSection, CrankshaftSection, WebSection
from reports.inputs.sections.gas import (
    CycleGasSection,
    GasSection,
    PolytropicGasSection,
    RoundedGasSection,
    TableGasSection,
)
from reports.inputs.sections.input_file import GeometrySection, InputFile, RegimeSection
from reports.inputs.to_si.bearings import to_bearings
from reports.inputs.to_si.cycle import cycle_run
from reports.inputs.to_si.gas import BDC_DEG, FIRING_TDC_DEG, rounded_gas
from reports.inputs.to_si.geometry import crank_radius_mm, rod_length_mm
from reports.inputs.to_si.masses import to_masses, with_masses
from reports.inputs.to_si.torsion import to_torsion
from reports.inputs.units import DEG, KG, KW, MM, MPA, RPM

TWO_STROKE_BDC_DEG = 180.0


def to_engine(model: InputFile) -> Engine:
    """Return the engine in SI units; the input must have passed `reports.inputs.load`."""
    return engine_and_cycle(model)[0]


def engine_and_cycle(model: InputFile) -> tuple[Engine, CycleRun | None]:
    """Return the engine in SI units and the cycle calculation that its gas comes from."""
    run = cycle_run(model)
    return _engine(model, run), run


def smallness_of(model: InputFile) -> int:
    """How much smaller the engine is than those of the books: its values have more decimals."""
    bore_mm = getattr(model.geometry, "bore_mm", None)
    return smallness(bore_mm / 1000 if bore_mm else to_engine(model).geometry.bore)


def _engine(model: InputFile, run: CycleRun | None) -> Engine:
    regime, reference = model.regime, model.reference
    geometry = _geometry(model, run)
    shaft = with_masses(model, geometry)
    forces = shaft.force_offsets_deg
    power, efficiency, fullness = _power(model, run)
    places = arrangement_of(model)
    return Engine(
        geometry=geometry,
        omega=RPM.to_si(regime.speed_rpm),
        gas=_gas(model.gas, run, strokes=model.engine.strokes),
        masses=to_masses(model, geometry),
        crankshaft=_crankshaft(shaft),
        arrangement=places,
        articulated=_articulated(model.articulated, len(hung(places))),
        torsion=to_torsion(model.torsion),
        bearings=to_bearings(model.bearings),
        firing_offsets=tuple(DEG.to_si(value) for value in shaft.firing_offsets_deg),
        strokes=model.engine.strokes,
        method=model.calculation.method,
        step_deg=model.calculation.step_deg,
        rays=model.calculation.wear_rays,
        mechanical_efficiency=efficiency,
        indicated_power=power,
        fullness=fullness,
        force_offsets=None if forces is None else tuple(DEG.to_si(value) for value in forces),
        balancing=_balancing(model.balance),
        name=model.engine.name,
        oil_hole=DEG.given(shaft.oil_hole_deg),
        regimes=tuple(_regime(regime, model.engine.strokes) for regime in model.regimes),
        reference_lambdas=() if reference is None else reference.lambdas,
        reference_angle=0.0 if reference is None else DEG.to_si(reference.angle_deg),
    )


def _regime(section: RegimeSection, strokes: int) -> OperatingPoint:
    return OperatingPoint(
        name=section.name,
        omega=RPM.to_si(section.speed_rpm),
        gas=_gas(section.gas, None, strokes=strokes),
        mechanical_efficiency=float(section.mechanical_efficiency),
        indicated_power=KW.given(section.indicated_power_kw),
        fullness=float(section.fullness),
    )


def _articulated(section: ArticulatedSection | None, count: int) -> tuple[ArticulatedRod, ...]:
    if section is None:
        return ()
    rod = ArticulatedRod(
        rod_length=MM.to_si(section.rod_length_mm),
        radius=MM.to_si(section.radius_mm),
        angle=DEG.to_si(section.angle_deg),
        reciprocating=KG.to_si(section.reciprocating_kg),
        big_end=KG.to_si(section.big_end_kg),
    )
    return (rod,) * count


def _geometry(model: InputFile, run: CycleRun | None) -> Geometry:
    given = model.geometry
    crank_offset = pin_offset = None
    if isinstance(given, GeometrySection):
        crank_offset, pin_offset = (
            None if value is None or not given.is_offset else MM.to_si(value)
            for value in (given.crank_offset_mm, given.pin_offset_mm)
        )
        bore = MM.to_si(given.bore_mm)
        radius, rod = MM.to_si(crank_radius_mm(given)), MM.to_si(rod_length_mm(given))
    else:
        if run is None or run.design is None:
            raise ValueError("geometry without bore needs a wanted power")
        bore, radius = run.design.bore, run.design.stroke / 2
        rod = radius / given.lambda_
    ratio = float(given.compression_ratio)
    return Geometry(bore, radius, rod, ratio, crank_offset, pin_offset)


def _power(model: InputFile, run: CycleRun | None) -> tuple[float | None, float, float]:
    """Indicated power [W], mechanical efficiency and fullness, from the cycle if there is one."""
    if run is not None:
        return run.gas_power, run.cycle.effective.eta_m, 1.0
    regime = model.regime
    efficiency, fullness = float(regime.mechanical_efficiency), float(regime.fullness)
    return KW.given(regime.indicated_power_kw), efficiency, fullness


def _gas(gas: GasSection, run: CycleRun | None, *, strokes: int) -> Gas:
    p_ambient = MPA.to_si(gas.ambient_pressure_mpa)
    if isinstance(gas, TableGasSection):
        return TabulatedGas(
            p_ambient=p_ambient,
            angles=tuple(DEG.to_si(angle) for angle, _ in gas.points),
            pressures=tuple(MPA.to_si(pressure) for _, pressure in gas.points),
            smooth=gas.interpolation == "monotone",
        )
    if isinstance(gas, RoundedGasSection):
        return rounded_gas(gas)
    if run is not None:
        advance, start, opens, closes = _angles(gas)
        return polytropic_gas(
            run.cycle,
            ignition_advance=advance,
            combustion_start=start,
            exhaust_open=opens,
            exhaust_close=closes,
        )
    if isinstance(gas, CycleGasSection):
        raise TypeError("gas from a cycle needs its section")
    advance, start, opens, closes = _angles(gas, strokes)
    scavenge = gas.scavenge_start_before_bdc_deg
    return PolytropicGas(
        p_ambient=p_ambient,
        p_intake=MPA.to_si(gas.intake_pressure_mpa),
        p_residual=MPA.to_si(gas.residual_pressure_mpa),
        p_max=MPA.to_si(gas.max_pressure_mpa),
        n_compression=float(gas.compression_exponent),
        n_expansion=float(gas.expansion_exponent),
        rho=float(gas.preexpansion_ratio),
        combustion_start=start,
        ignition_advance=advance,
        exhaust_open=opens,
        exhaust_close=closes,
        scavenge_open=0.0 if scavenge is None else DEG.to_si(TWO_STROKE_BDC_DEG - scavenge),
    )


def _angles(
    gas: PolytropicGasSection | CycleGasSection, strokes: int = 4
) -> tuple[float, float, float, float]:
    """Advance, start of combustion, start and end of the exhaust [rad]."""
    bdc = BDC_DEG if strokes == 4 else TWO_STROKE_BDC_DEG
    start = gas.combustion_start_deg
    if start is None:
        start = FIRING_TDC_DEG - gas.injection_advance_deg + gas.ignition_delay_deg
    return (
        DEG.to_si(gas.injection_advance_deg),
        DEG.to_si(start),
        DEG.to_si(bdc - gas.exhaust_start_before_bdc_deg),
        DEG.to_si(bdc + gas.exhaust_end_after_bdc_deg),
    )


def _balancing(section: BalanceSection) -> Balancing:
    values = {key: float(value) for key, value in section.model_dump().items()}
    radius = MM.to_si(values.pop("shaft_radius_mm"))
    return Balancing(**values, shaft_radius=radius)


def _crankshaft(shaft: CrankshaftSection) -> Crankshaft:
    throws, journals = len(shaft.throw_angles_deg), len(shaft.main_lengths_mm)
    return Crankshaft(
        throws=tuple(
            _throw(shaft, angle, arms, shaft.webs[2 * index], shaft.webs[2 * index + 1])
            for index, (angle, arms) in enumerate(
                zip(shaft.throw_angles_deg, shaft.arms, strict=True)
            )
        ),
        nose=_end_mass(shaft.nose_mass_kg, shaft.nose_angle_deg, shaft.nose_arm_mm),
        rear=_end_mass(shaft.rear_mass_kg, shaft.rear_angle_deg, shaft.rear_arm_mm),
        pin_diameters=_sizes(shaft.pin_diameter_mm, shaft.pin_diameters_mm, throws),
        pin_lengths=_sizes(shaft.pin_length_mm, shaft.pin_lengths_mm, throws),
        main_diameters=_sizes(shaft.main_diameter_mm, shaft.main_diameters_mm, journals),
        main_lengths=tuple(MM.to_si(length) for length in shaft.main_lengths_mm),
    )


def _end_mass(mass_kg: float, angle_deg: float, arm_mm: float) -> EndMass:
    return EndMass(KG.to_si(mass_kg), DEG.to_si(angle_deg), MM.to_si(arm_mm))


def _sizes(one: float | None, each: tuple[float, ...] | None, count: int) -> tuple[float, ...]:
    """Sizes of all journals [m] from one for all or one each."""
    return tuple(MM.to_si(size) for size in each or (one or 0.0,) * count)


def _throw(
    shaft: CrankshaftSection, angle: float, arms: ArmsSection, left: WebSection, right: WebSection
) -> Throw:
    lengths = (arms.l1_mm, arms.l2_mm, arms.l3_mm, arms.l4_mm, arms.l5_mm, arms.l6_mm)
    l1, l2, l3, l4, l5, l6 = (MM.to_si(length) for length in lengths)
    return Throw(
        angle=DEG.to_si(angle),
        arms=(l1, l2, l3, l4, l5, l6),
        left_web=_web(left),
        right_web=_web(right),
        pin_mass=KG.to_si(shaft.pin_mass_kg or 0.0),
        left_web_thickness=MM.to_si(arms.left_web_mm),
        right_web_thickness=MM.to_si(arms.right_web_mm),
    )


def _web(web: WebSection) -> Web:
    return Web(
        mass=KG.to_si(web.mass_kg or 0.0),
        angle=DEG.to_si(web.angle_deg),
        counterweight_mass=KG.to_si(web.counterweight_kg),
        counterweight_angle=DEG.to_si(web.counterweight_angle_deg),
    )
