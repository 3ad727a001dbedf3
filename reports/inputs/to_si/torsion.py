"""The section [torsion] in SI."""

from __future__ import annotations

from kshm.engine.torsion import Torsion, TrainMass
from reports.inputs.sections.torsion import MassSection, TorsionSection
from reports.inputs.units import MM, MPA, RPM


def to_torsion(section: TorsionSection | None) -> Torsion | None:
    """What the file says of the torsional vibration, None where it says nothing."""
    if section is None:
        return None
    return Torsion(
        masses=tuple(_mass(mass) for mass in section.masses),
        ground=section.ground_nm_rad,
        pulley=section.pulley_kg_m2,
        throws=section.throws_kg_m2,
        flywheel=section.flywheel_kg_m2,
        driven=section.driven_kg_m2,
        nose_stiffness=section.nose_nm_rad,
        throw_stiffness=section.throws_nm_rad,
        rear_stiffness=section.rear_nm_rad,
        driven_stiffness=section.driven_nm_rad,
        formula=section.formula,
        shear_modulus=MPA.to_si(section.shear_modulus_mpa),
        main_bore=MM.to_si(section.main_bore_mm),
        pin_bore=MM.to_si(section.pin_bore_mm),
        web_width=MM.given(section.web_width_mm),
        web_thickness=MM.given(section.web_thickness_mm),
        damping=section.damping_nms_rad,
        loss_factor=section.loss_factor,
        speed_min=RPM.given(section.speed_min_rpm),
        speed_max=RPM.given(section.speed_max_rpm),
        other_flywheel=section.other_flywheel_kg_m2,
        damper=section.damper,
        damper_inertia=section.damper_kg_m2,
        damper_stiffness=section.damper_nm_rad,
        damper_damping=section.damper_nms_rad,
        peaks=tuple(
            (RPM.to_si(peak.speed_rpm), MPA.to_si(peak.pressure_mpa)) for peak in section.peaks
        ),
    )


def _mass(mass: MassSection) -> TrainMass:
    return TrainMass(
        mass.name,
        mass.inertia_kg_m2,
        mass.stiffness_nm_rad,
        MM.given(mass.diameter_mm),
        int(mass.throw) - 1 if mass.throw else None,
    )
