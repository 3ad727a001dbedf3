"""The [masses] section of the input file: given, weighed, swung or estimated masses.

Ways to give them, one at a time (``reports.inputs.checks.masses`` judges):
m_j and m_2; the piston group and the rod with its centre of mass, found directly, by
weighing or by swinging; or table 4 of the textbook for what is not given.
"""

from __future__ import annotations

from typing import Literal

from reports.inputs.meta import Strictly, choice, number, title_of
from reports.inputs.sections.cycle import KINDS
from reports.inputs.units import KG, KG_M2, KG_PER_M2, MM, NONE, PER_MIN

PISTONS = {"aluminium": "алюминиевый сплав", "iron": "чугун"}
SHAFTS = {"steel": "стальной кованый", "iron": "чугунный литой"}
WEIGHED = ("rod_weighed_small_end_kg",)
SWUNG = (
    "swings_small_end_per_min",
    "swings_big_end_per_min",
    "small_end_radius_mm",
    "swing_edges_mm",
)
ESTIMATE_EXTRA = (
    "estimate_piston",
    "estimate_shaft",
    "estimate_piston_kg_per_m2",
    "estimate_rod_kg_per_m2",
    "estimate_throw_kg_per_m2",
    "estimate_pin_share",
)


class MassesSection(Strictly):
    """[masses]: m_j and m_2, or the piston group, the rod and its centre of mass."""

    reciprocating_kg: float | None = number(
        "Масса возвратно-движущихся деталей", "m_j", KG, 0.001, 5000, None
    )
    rod_big_end_kg: float | None = number(
        "Масса шатуна, отнесённая к кривошипу", "m_2", KG, 0.001, 5000, None
    )
    piston_group_kg: float | None = number(title_of("m_piston"), "m_п", KG, 0.001, 5000, None)
    rod_kg: float | None = number(title_of("m_rod"), "m_ш", KG, 0.001, 5000, None)
    rod_centre_mm: float | None = number(title_of("rod_l1"), "l_1", MM, 1, 6000, None)
    rod_small_end_share: float | None = number(
        "Доля массы шатуна у поршневого пальца", "m_1/m_ш", NONE, 0.02, 0.8, None
    )
    rod_weighed_small_end_kg: float | None = number(
        "Показание весов под поршневой головкой", "m_1", KG, 0.001, 5000, None
    )
    swings_small_end_per_min: float | None = number(
        "Качаний в минуту на поршневой головке", "n_A", PER_MIN, 1, 2000, None
    )
    swings_big_end_per_min: float | None = number(
        "Качаний в минуту на кривошипной головке", "n_C", PER_MIN, 1, 2000, None
    )
    small_end_radius_mm: float | None = number(
        "Радиус отверстия поршневой головки", "r_1", MM, 0, 500, None
    )
    swing_edges_mm: float | None = number(
        "Расстояние между осями качаний", "l_3", MM, 5, 6000, None
    )
    rod_inertia_kg_m2: float | None = number(title_of("I_sh"), "I_ш", KG_M2, 1e-7, 1e5, None)
    estimate_fuel: Literal["petrol", "diesel"] | None = choice(
        "Оценка масс по таблице 4: двигатель", KINDS, None, structural=True
    )
    estimate_piston: Literal["aluminium", "iron"] | None = choice(
        "Оценка: поршень", PISTONS, None, structural=True
    )
    estimate_shaft: Literal["steel", "iron"] | None = choice(
        "Оценка: вал", SHAFTS, None, structural=True
    )
    estimate_piston_kg_per_m2: float | None = number(
        "Оценка: удельная масса поршневой группы", "m'_п", KG_PER_M2, 10, 2000, None
    )
    estimate_rod_kg_per_m2: float | None = number(
        "Оценка: удельная масса шатуна", "m'_ш", KG_PER_M2, 10, 2000, None
    )
    estimate_throw_kg_per_m2: float | None = number(
        "Оценка: удельная масса колена", "m'_к", KG_PER_M2, 10, 2000, None
    )
    estimate_pin_share: float | None = number(
        "Оценка: доля шатунной шейки в массе колена", "m_шш/m_к", NONE, 0.1, 1, None
    )
