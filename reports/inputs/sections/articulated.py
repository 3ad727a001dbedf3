"""The [articulated] section of the input file: rods that hang on the rods of the left bank."""

from __future__ import annotations

from reports.inputs.meta import Strictly, number
from reports.inputs.units import DEG, KG, MM


class ArticulatedSection(Strictly):
    """[articulated]: the right bank's rods hang on the master rods, Gots figure 2 в."""

    rod_length_mm: float = number("Прицепной шатун: длина", "L_п", MM, 5, 6000)
    radius_mm: float = number(
        "Прицепной шатун: расстояние его пальца от шатунной шейки", "ρ_п", MM, 0, 2000
    )
    angle_deg: float = number(
        "Прицепной шатун: угол пальца от оси главного шатуна по вращению", "γ_п", DEG, -180, 180
    )
    reciprocating_kg: float = number(
        "Прицепной шатун: возвратно-движущаяся масса цилиндра", "m_jп", KG, 0.001, 5000
    )
    big_end_kg: float = number(
        "Прицепной шатун: масса, отнесённая к его пальцу", "m_2п", KG, 0, 5000
    )
