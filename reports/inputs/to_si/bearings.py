"""The section [bearings] in SI."""

from __future__ import annotations

from kshm.engine.bearings import Bearings, Oil, Strength
from reports.inputs.sections.bearings import MATERIALS, OILS, BearingsSection
from reports.inputs.units import MM, MPA, MPA_S, UM


def to_bearings(section: BearingsSection | None) -> Bearings | None:
    """What the file says of the bearings, None where it says nothing."""
    if section is None:
        return None
    s = section
    return Bearings(
        pin_clearances=(MM.given(s.pin_clearance_min_mm), MM.given(s.pin_clearance_max_mm)),
        main_clearances=(MM.given(s.main_clearance_min_mm), MM.given(s.main_clearance_max_mm)),
        pin_width=MM.given(s.pin_width_mm),
        main_width=MM.given(s.main_width_mm),
        pin_groove=MM.to_si(s.pin_groove_mm),
        main_groove=MM.to_si(s.main_groove_mm),
        hole=MM.to_si(s.hole_mm),
        pin_bore=MM.to_si(s.pin_bore_mm),
        main_bore=MM.to_si(s.main_bore_mm),
        least_gap=UM.to_si(s.journal_roughness_um + s.shell_roughness_um + s.form_um),
        oil=_oil(s),
        strength=_strength(s),
    )


def _oil(section: BearingsSection) -> Oil:
    grade = OILS[section.oil]
    return Oil(
        MPA_S.to_si(section.viscosity_40_mpa_s or grade.at_40),
        MPA_S.to_si(section.viscosity_100_mpa_s or grade.at_100),
        section.density_kg_m3,
        section.heat_j_kg_k,
        section.supply_c,
        MPA.to_si(section.supply_mpa),
        section.oil_temperature_c,
    )


def _strength(section: BearingsSection) -> Strength:
    material = MATERIALS[section.material]
    return Strength(
        MPA.to_si(section.tensile_mpa or material.tensile),
        MPA.to_si(section.bending_limit_mpa or material.bending),
        MPA.to_si(section.torsion_limit_mpa or material.torsion),
        section.mean_bending,
        section.mean_torsion,
        section.fillet_bending,
        section.fillet_torsion,
        section.hole_bending,
        section.hole_torsion,
        section.sensitivity,
        section.size_factor,
        section.surface_factor,
        MM.given(section.fillet_mm),
        material.making,
    )
