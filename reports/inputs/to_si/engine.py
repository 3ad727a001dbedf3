"""Conversion of the input file to the solver's engine in SI."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pydantic import BaseModel

from kshm.cycle.cycle import CycleRun
from kshm.cycle.diagram import polytropic_gas
from kshm.engine.arrangement import ArticulatedRod, hung
from kshm.engine.bearings import Bearings, Oil, Strength
from kshm.engine.counterweight import Counterweight
from kshm.engine.crankshaft import Crankshaft, EndMass, Throw, Web
from kshm.engine.engine import Balancing, Engine, Geometry, OperatingPoint
from kshm.engine.flywheel import Flywheel
from kshm.engine.gas import Gas, PolytropicGas, RoundedGas, TabulatedGas
from kshm.engine.strength import PartStrength, Steel
from kshm.engine.torsion import Torsion, TrainMass
from kshm.nomenclature.quantity import smallness
from reports.inputs.firing import places_of
from reports.inputs.meta import solver_values
from reports.inputs.sections.bearings import MATERIALS, OILS, BearingsSection
from reports.inputs.sections.counterweight import CounterweightSection
from reports.inputs.sections.flywheel import FlywheelSection
from reports.inputs.sections.gas import (
    BDC_DEG,
    FIRING_TDC_DEG,
    JOIN_DEG,
    PEAK_DEG,
    PEAK_SHARE,
    TWO_STROKE_BDC_DEG,
    CycleGasSection,
    GasSection,
    PolytropicGasSection,
    RoundedGasSection,
    TableGasSection,
)
from reports.inputs.sections.input_file import (
    DesignGeometrySection,
    GeometrySection,
    InputFile,
    RegimeSection,
)
from reports.inputs.sections.mechanism import (
    ArmsSection,
    ArticulatedSection,
    BalanceSection,
    CrankshaftSection,
    WebSection,
)
from reports.inputs.sections.strength import PART_MATERIALS, StrengthSection
from reports.inputs.sections.torsion import MassSection, TorsionSection
from reports.inputs.to_si.cycle import cycle_run
from reports.inputs.to_si.masses import crank_radius_mm, rod_length_mm, to_masses, with_masses
from reports.inputs.units import DEG, KG, MM, MPA, MPA_S, RPM, UM


def rounded_gas(gas: RoundedGasSection) -> RoundedGas:
    """Return rounded diagram with the usual places where the input gives none."""
    share, peak, join = places(gas)
    angles = {
        "combustion_start": DEG.to_si(
            FIRING_TDC_DEG - gas.injection_advance_deg + gas.ignition_delay_deg
        ),
        "peak": DEG.to_si(FIRING_TDC_DEG + peak),
        "peak_share": share,
        "join": DEG.to_si(FIRING_TDC_DEG + join),
        "exhaust_open": DEG.to_si(BDC_DEG - gas.exhaust_start_before_bdc_deg),
        "exhaust_close": DEG.to_si(BDC_DEG + gas.exhaust_end_after_bdc_deg),
    }
    return RoundedGas(**solver_values(gas, RoundedGas) | angles)


def places(gas: RoundedGasSection) -> tuple[float, float, float]:
    """Share p_zд/p_z, angles of z_д and of the join after TDC [deg]."""
    share, peak, join = gas.peak_share, gas.peak_after_tdc_deg, gas.expansion_after_tdc_deg
    return (
        PEAK_SHARE[gas.kind] if share is None else float(share),
        PEAK_DEG[gas.kind] if peak is None else float(peak),
        JOIN_DEG[gas.kind] if join is None else float(join),
    )


def to_torsion(section: TorsionSection | None) -> Torsion | None:
    """Torsion input of the solver, None without the section."""
    if section is None:
        return None
    return Torsion(
        **solver_values(section, Torsion),
        masses=tuple(_mass(mass) for mass in section.masses),
        peaks=tuple(
            (RPM.to_si(peak.speed_rpm), MPA.to_si(peak.pressure_mpa)) for peak in section.peaks
        ),
    )


def _mass(mass: MassSection) -> TrainMass:
    throw = int(mass.throw) - 1 if mass.throw else None
    return TrainMass(**solver_values(mass, TrainMass) | {"throw": throw})


def to_bearings(section: BearingsSection | None) -> Bearings | None:
    """Bearings input of the solver, None without the section."""
    if section is None:
        return None
    s = section
    composed = {
        "pin_clearances": (MM.given(s.pin_clearance_min_mm), MM.given(s.pin_clearance_max_mm)),
        "main_clearances": (MM.given(s.main_clearance_min_mm), MM.given(s.main_clearance_max_mm)),
        "least_gap": UM.to_si(s.journal_roughness_um + s.shell_roughness_um + s.form_um),
        "oil": _oil(s),
        "strength": _strength(s),
    }
    return Bearings(**solver_values(s, Bearings) | composed)


def _oil(section: BearingsSection) -> Oil:
    grade = OILS[section.oil]
    usual = {"at_40": MPA_S.to_si(grade.at_40), "at_100": MPA_S.to_si(grade.at_100)}
    return Oil(**usual | solver_values(section, Oil))


def _strength(section: BearingsSection) -> Strength:
    material = MATERIALS[section.material]
    usual = {key: MPA.to_si(getattr(material, key)) for key in ("tensile", "bending", "torsion")}
    return Strength(**usual | solver_values(section, Strength), making=material.making)


def to_parts(section: StrengthSection | None) -> PartStrength | None:
    """Strength input of the solver, None without the section."""
    if section is None:
        return None
    steels = {f"{part}_material": _steel(getattr(section, f"{part}_material"))
              for part in ("rod", "bolt", "web")}  # fmt: skip
    return PartStrength(**solver_values(section, PartStrength) | steels)


def _steel(name: str) -> Steel:
    material = PART_MATERIALS[name]
    limits = ("tensile", "yielding", "bending", "pull", "modulus")
    in_si = {key: MPA.to_si(getattr(material, key)) for key in limits}
    return Steel(**in_si, expansion=material.expansion)


def to_counterweight(section: CounterweightSection | None) -> Counterweight | None:
    """Counterweights of the solver, None without the section."""
    return None if section is None else Counterweight(**solver_values(section, Counterweight))


def to_flywheel(section: FlywheelSection | None) -> Flywheel | None:
    """Flywheel of the solver, None without the section."""
    return None if section is None else Flywheel(**solver_values(section, Flywheel))


def to_engine(model: InputFile) -> Engine:
    """Return the engine in SI units; the input must have passed `reports.inputs.load`."""
    return engine_and_cycle(model)[0]


def engine_and_cycle(
    model: InputFile, cache: KeptParts | None = None
) -> tuple[Engine, CycleRun | None]:
    """Return the engine in SI units and the cycle calculation that its gas comes from.

    ``cache`` parts are those of engines before, of inputs that share sections.
    """
    run = cycle_run(model)
    return _engine(model, run, cache or _called), run


def smallness_of(model: InputFile) -> int:
    """Smallness of the engine beside those of the books; sets further decimals."""
    bore_mm = getattr(model.geometry, "bore_mm", None)
    return smallness(bore_mm / 1000 if bore_mm else to_engine(model).geometry.bore)


class KeptParts:
    """Results of functions for their last arguments, as many engines differ in few parts."""

    def __init__(self) -> None:
        self._last: dict[object, tuple[tuple[object, ...], Any]] = {}

    def __call__(self, function: Callable[..., Any], *arguments: object) -> Any:  # noqa: ANN401
        """Call a function unless it was last called with the same objects or equal numbers."""
        key = function, type(arguments[0])
        last = self._last.get(key)
        if last is None or not all(map(_same, last[0], arguments)):
            last = self._last[key] = arguments, function(*arguments)
        return last[1]


def _same(one: object, other: object) -> bool:
    return one is other or (isinstance(one, float | int) and one == other)


def _called(function: Callable[..., Any], *arguments: object) -> Any:  # noqa: ANN401
    return function(*arguments)


def _engine(model: InputFile, run: CycleRun | None, cache: Callable[..., Any] = _called) -> Engine:
    geometry = cache(_geometry, model.geometry, run)
    shaft = cache(with_masses, model.crankshaft, model.masses, geometry.bore, geometry.crank_radius)
    placement = cache(places_of, model.engine, model.crankshaft, model.articulated)
    values: dict[str, Any] = {}
    for section in (model.engine, model.calculation, model.regime, model.reference):
        values |= {} if section is None else cache(_numbers, section)
    composed = {
        "geometry": geometry,
        "gas": cache(_gas, model.gas, run, model.engine.strokes),
        "masses": cache(to_masses, model.masses, geometry),
        "crankshaft": cache(_crankshaft, shaft),
        "arrangement": placement,
        "articulated": cache(_articulated, model.articulated, len(hung(placement))),
        "torsion": cache(to_torsion, model.torsion),
        "bearings": cache(to_bearings, model.bearings),
        "strength": cache(to_parts, model.strength),
        "counterweight": cache(to_counterweight, model.counterweight),
        "flywheel": cache(to_flywheel, model.flywheel),
        "balancing": cache(_balancing, model.balance, model.strength, geometry.bore),
        "regimes": tuple(_regime(regime, model.engine.strokes) for regime in model.regimes),
        "name": model.engine.name,
    }
    return Engine(**values | cache(_numbers, shaft) | composed | _power(run))


def _numbers(section: BaseModel) -> dict[str, Any]:
    return solver_values(section, Engine)


def _balancing(section: BalanceSection, parts: StrengthSection | None, bore: float) -> Balancing:
    """Choices of balancing, with the webs of the strength where their sizes are given [m]."""
    sizes = {} if parts is None else {
        "web_width_share": parts.web_width_mm, "web_thickness_share": parts.web_thickness_mm,
    }  # fmt: skip
    shares = {key: MM.to_si(size) / bore for key, size in sizes.items() if size is not None}
    return Balancing(**solver_values(section, Balancing) | shares)


def _regime(section: RegimeSection, strokes: int) -> OperatingPoint:
    gas = _gas(section.gas, None, strokes)
    return OperatingPoint(**solver_values(section, OperatingPoint), gas=gas)


def _articulated(section: ArticulatedSection | None, count: int) -> tuple[ArticulatedRod, ...]:
    if section is None:
        return ()
    return (ArticulatedRod(**solver_values(section, ArticulatedRod)),) * count


def _geometry(section: GeometrySection | DesignGeometrySection, run: CycleRun | None) -> Geometry:
    crank_offset = pin_offset = None
    if isinstance(section, GeometrySection):
        crank_offset, pin_offset = (
            None if value is None or not section.is_offset else MM.to_si(value)
            for value in (section.crank_offset_mm, section.pin_offset_mm)
        )
        bore = MM.to_si(section.bore_mm)
        radius, rod = MM.to_si(crank_radius_mm(section)), MM.to_si(rod_length_mm(section))
    else:
        if run is None or run.design is None:
            raise ValueError("geometry without bore needs a wanted power")
        bore, radius = run.design.bore, run.design.stroke / 2
        rod = radius / section.lambda_
    ratio = float(section.compression_ratio)
    return Geometry(bore, radius, rod, ratio, crank_offset, pin_offset)


def _power(run: CycleRun | None) -> dict[str, float]:
    """Return indicated power [W], mechanical efficiency and fullness of a calculated cycle."""
    if run is None:
        return {}
    efficiency = run.cycle.effective.eta_m
    return {
        "indicated_power": run.gas_power, "mechanical_efficiency": efficiency, "fullness": 1.0,
    }  # fmt: skip


def _gas(gas: GasSection, run: CycleRun | None, strokes: int) -> Gas:
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
    timing = {
        "combustion_start": start, "ignition_advance": advance,
        "exhaust_open": opens, "exhaust_close": closes,
    }  # fmt: skip
    scavenge = gas.scavenge_start_before_bdc_deg
    if scavenge is not None:
        timing["scavenge_open"] = DEG.to_si(TWO_STROKE_BDC_DEG - scavenge)
    return PolytropicGas(**solver_values(gas, PolytropicGas) | timing)


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
    return Web(**{"mass": 0.0} | solver_values(web, Web))
