"""Quantities of the flywheel as a part."""

from __future__ import annotations

from kshm.nomenclature.digits import Row

ROWS: tuple[Row, ...] = (
    ("fw_outer_mm", r"D_{\mathrm{м}}", "mm", "наружный диаметр маховика", 1),
    ("fw_bore_mm", r"d_{\mathrm{об}}", "mm", "внутренний диаметр обода", 1),
    ("fw_disc_mm", r"h_{\mathrm{м}}", "mm", "толщина диска маховика", 1),
    ("fw_rim_mm", r"b_{\mathrm{м}}", "mm", "ширина обода", 1),
    ("fw_density", r"\rho_{\mathrm{мх}}", "kg_m3", "плотность материала маховика", 0),
    ("fw_I_disc", r"I_{\mathrm{д}}", "kgm2", "момент инерции диска маховика", 4),
    ("fw_I", r"I'_{\mathrm{м}}", "kgm2", "момент инерции маховика этих размеров", 4),
    ("fw_mass_disc", r"m_{\mathrm{д}}", "kg", "масса диска маховика", 2),
    ("fw_mass_rim", r"m_{\mathrm{об}}", "kg", "масса обода", 2),
    ("fw_mass", r"m_{\mathrm{м}}", "kg", "масса маховика", 2),
    ("fw_speed", r"v_{\mathrm{об}}", "m_s", "окружная скорость обода", 2),
    ("fw_limit", r"\left[v_{\mathrm{об}}\right]", "m_s", "допускаемая окружная скорость обода", 0),
    ("fw_stress_MPa", r"\sigma_{\mathrm{об}}", "MPa", "растягивающее напряжение обода", 2),
    ("fw_outer_most_mm", r"D_{\mathrm{м}\,\max}", "mm", "наибольший допустимый диаметр маховика", 1),
)  # fmt: skip

UNITS = (("kg_m3", "кг/м³", 1.0),)
