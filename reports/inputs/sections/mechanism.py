"""The sections of the crank mechanism: [masses], [articulated], [crankshaft], [balance].

Ways to give masses, one at a time (``reports.inputs.checks.masses`` judges): m_j and m_2; the
piston group and the rod with its centre of mass, found directly, by weighing or by swinging;
or table 4 of the textbook for what is not given.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Strict, model_validator

from kshm.engine.engine import Balancing
from reports.inputs.meta import USUAL, StrictModel, choice, named, number, text, title_of
from reports.inputs.sections.gas import KINDS
from reports.inputs.units import DEG, KG, KG_M2, KG_PER_M2, MM, NONE, PER_MIN

MIN_KG, MAX_KG = 0.0001, 50_000  # from a model of 10 mm to a crosshead engine of a metre
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
_SHARES = {"counterweight_share", "first_shafts_share", "second_shafts_share"}


class MassesSection(StrictModel):
    """[masses]: m_j and m_2, or the piston group, the rod and its centre of mass."""

    reciprocating_kg: float | None = number(
        "Масса возвратно-поступательно движущихся деталей", "m_j", KG, MIN_KG, MAX_KG, None
    )
    rod_big_end_kg: float | None = number(
        "Масса шатуна, отнесённая к кривошипу", "m_2", KG, MIN_KG, MAX_KG, None
    )
    piston_group_kg: float | None = number(*named("m_piston"), KG, MIN_KG, MAX_KG, None)
    rod_kg: float | None = number(*named("m_rod"), KG, MIN_KG, MAX_KG, None)
    rod_centre_mm: float | None = number(*named("rod_l1"), MM, 1, 6000, None)
    rod_small_end_share: float | None = number(
        "Доля массы шатуна у поршневого пальца", "m_1/m_ш", NONE, 0.02, 0.8, None
    )
    rod_weighed_small_end_kg: float | None = number(
        "Показание весов под поршневой головкой", "m_1", KG, MIN_KG, MAX_KG, None
    )
    swings_small_end_per_min: float | None = number(
        "Качаний в минуту на поршневой головке", "n_A", PER_MIN, 1, 2000, None,
        solver="swings_small",
    )  # fmt: skip
    swings_big_end_per_min: float | None = number(
        "Качаний в минуту на кривошипной головке", "n_C", PER_MIN, 1, 2000, None,
        solver="swings_big",
    )  # fmt: skip
    small_end_radius_mm: float | None = number(
        "Радиус отверстия поршневой головки", "r_1", MM, 0, 500, None, solver="bore_radius"
    )
    swing_edges_mm: float | None = number(
        "Расстояние между осями качаний", "l_ш3", MM, 5, 6000, None, solver="distance"
    )
    rod_inertia_kg_m2: float | None = number(*named("I_sh"), KG_M2, 1e-7, 1e5, None)
    estimate_fuel: Literal["petrol", "diesel"] | None = choice(
        "Оценка масс по таблице 4: двигатель", KINDS, None, structural=True, solver="fuel"
    )
    estimate_piston: Literal["aluminium", "iron"] | None = choice(
        "Оценка: поршень", PISTONS, None, structural=True, solver="piston_material"
    )
    estimate_shaft: Literal["steel", "iron"] | None = choice(
        "Оценка: вал", SHAFTS, None, structural=True, solver="shaft"
    )
    estimate_piston_kg_per_m2: float | None = number(
        "Оценка: удельная масса поршневой группы", "m'_п", KG_PER_M2, 10, 2000, None,
        solver="piston_area_mass",
    )  # fmt: skip
    estimate_rod_kg_per_m2: float | None = number(
        "Оценка: удельная масса шатуна", "m'_ш", KG_PER_M2, 10, 2000, None, solver="rod_area_mass"
    )
    estimate_throw_kg_per_m2: float | None = number(
        "Оценка: удельная масса колена", "m'_к", KG_PER_M2, 10, 2000, None, solver="throw_area_mass"
    )
    estimate_pin_share: float | None = number(
        "Оценка: доля шатунной шейки в массе колена", "m_шш/m_к", NONE, 0.1, 1, None,
        solver="pin_share",
    )  # fmt: skip


class ArticulatedSection(StrictModel):
    """[articulated]: the right bank's rods hang on the master rods, Gots figure 2 в."""

    rod_length_mm: float = number("Прицепной шатун: длина", "L_п", MM, 5, 6000)
    radius_mm: float = number(
        "Прицепной шатун: расстояние его пальца от шатунной шейки", "ρ_п", MM, 0, 2000
    )
    angle_deg: float = number(
        "Прицепной шатун: угол пальца от оси главного шатуна по вращению", "γ_п", DEG, -180, 180
    )
    reciprocating_kg: float = number(
        "Прицепной шатун: возвратно-движущаяся масса цилиндра", "m_jп", KG, MIN_KG, MAX_KG
    )
    big_end_kg: float = number(
        "Прицепной шатун: масса, отнесённая к его пальцу", "m_2п", KG, 0, MAX_KG
    )


class WebSection(StrictModel):
    """[[crankshaft.webs]]: a web and its counterweight; masses reduced to the crank radius."""

    mass_kg: float | None = number("Щека {n}: приведённая масса", "m_щ{n}", KG, 0, MAX_KG, None)
    actual_mass_kg: float | None = number(
        "Щека {n}: действительная масса", "m_щ{n}", KG, 0, MAX_KG, None
    )
    centre_mm: float | None = number("Щека {n}: радиус центра масс", "ρ_{n}", MM, -2000, 2000, None)
    angle_deg: float = number(
        "Щека {n}: угол против вращения от кривошипа", "α_щ{n}", DEG, -360, 360, 0.0
    )
    counterweight_kg: float = number(
        "Щека {n}: приведённая масса противовеса", "m_пр{n}", KG, 0, MAX_KG, 0.0,
        solver="counterweight_mass",
    )  # fmt: skip
    counterweight_angle_deg: float = number(
        "Щека {n}: угол противовеса по вращению от направления, противоположного кривошипу",
        "α_пр{n}", DEG, -360, 360, 0.0,
    )  # fmt: skip


class ArmsSection(StrictModel):
    """[[crankshaft.arms]]: the chain of lengths of one throw, Gots figure 35."""

    l1_mm: float = number("Колено {n}: плечо l1", "l_1", MM, 0, 5000)
    l2_mm: float = number("Колено {n}: плечо l2", "l_2", MM, 0, 5000)
    l3_mm: float = number("Колено {n}: плечо l3", "l_3", MM, 0, 5000, 0.0)
    l4_mm: float = number("Колено {n}: плечо l4", "l_4", MM, 0, 5000, 0.0)
    l5_mm: float = number("Колено {n}: плечо l5", "l_5", MM, 0, 5000)
    l6_mm: float = number("Колено {n}: плечо l6", "l_6", MM, 0, 5000)
    left_web_mm: float = number("Колено {n}: толщина левой щеки", "h_Л", MM, 0, 2000, 0.0)
    right_web_mm: float = number("Колено {n}: толщина правой щеки", "h_П", MM, 0, 2000, 0.0)


class CrankshaftSection(StrictModel):
    """[crankshaft]: phases, journals, end masses, webs and arms, counted from the nose.

    ``firing_order`` is a way to write the offsets: `reports.inputs.firing` puts them, and
    the throw angles that are not given, in its place before the section is checked.
    """

    firing_order: str | None = text("Порядок работы цилиндров, например 1-3-4-2", None)
    bank_angle_deg: float | None = number(
        "Угол развала: от левого ряда к правому по вращению", "γ_р", DEG, 0, 360, None
    )
    split_pin_deg: float | None = number(
        "Сдвиг шеек правого ряда по вращению", "δ_ш", DEG, -180, 180, None
    )
    firing_offsets_deg: tuple[float, ...] = number(
        "Цилиндр {n}: начало рабочего хода", "θ_{n}", DEG, 0, 720
    )
    throw_angles_deg: tuple[float, ...] = number(
        "Колено {n}: угол от колена 1", "γ_{n}", DEG, -360, 360
    )
    pin_diameter_mm: float | None = number(title_of("tor_Dp"), "d_ш.ш", MM, 2, 2000, None)
    pin_diameters_mm: tuple[float, ...] | None = number(
        "Шатунная шейка {n}: диаметр", "d_шш{n}", MM, 2, 2000, None
    )
    pin_length_mm: float | None = number(
        "Рабочая длина всей шатунной шейки (сдвинутой — каждой половины)",
        "l_ш.ш", MM, 1, 2000, None,
    )  # fmt: skip
    pin_lengths_mm: tuple[float, ...] | None = number(
        "Шатунная шейка {n}: рабочая длина всей шейки", "l_шш{n}", MM, 1, 2000, None
    )
    main_diameter_mm: float | None = number("Диаметр коренных шеек", "d_к.ш", MM, 2, 2000, None)
    main_diameters_mm: tuple[float, ...] | None = number(
        "Коренная шейка {n}: диаметр", "d_кш{n}", MM, 2, 2000, None
    )
    main_lengths_mm: tuple[float, ...] = number(
        "Коренная шейка {n}: рабочая длина", "l_к.ш{n}", MM, 1, 2000
    )
    pin_mass_kg: float | None = number(
        "Приведённая масса шатунной шейки", "m_ш.ш", KG, 0, MAX_KG, None
    )
    oil_hole_deg: float | None = number(
        "Масляное отверстие шатунной шейки: угол от колена против вращения", "α_м", DEG, -360, 360,
        None,
    )  # fmt: skip
    nose_mass_kg: float = number(
        "Внешний противовес на носке: приведённая масса", "m_вп1", KG, 0, MAX_KG, 0.0
    )
    nose_angle_deg: float = number(
        "Противовес на носке: угол по вращению от колена 1", "α_вп1", DEG, -360, 360, 0.0
    )
    nose_arm_mm: float = number("Плечо противовеса на носке PL1", "l_p1", MM, 0, 5000, 0.0)
    rear_mass_kg: float = number(
        "Внешний противовес сзади: приведённая масса", "m_вп2", KG, 0, MAX_KG, 0.0
    )
    rear_angle_deg: float = number(
        "Противовес сзади: угол против вращения от последнего колена", "α_вп2", DEG, -360, 360, 0.0
    )
    rear_arm_mm: float = number("Плечо заднего противовеса PL2", "l_p2", MM, 0, 5000, 0.0)
    force_offsets_deg: tuple[float, ...] | None = number(
        "Колено {n}: фаза сил (воспроизведение П4.3)", "θ*_{n}", DEG, 0, 720, None
    )
    webs: Annotated[tuple[WebSection, ...], Strict(False)]
    arms: Annotated[tuple[ArmsSection, ...], Strict(False)]


class BalanceSection(StrictModel, usual=(Balancing,)):
    """[balance]: every key has a default, a change takes effect in the open workbook."""

    counterweight_share: float = number(
        "Доля сил инерции 1-го порядка на противовесах колен", "ε_п", NONE, 0, 1, USUAL
    )
    first_shafts_share: float = number(
        "Доля силы 1-го порядка, снятая балансирными валами", "ψ_1", NONE, 0, 1, USUAL
    )
    second_shafts_share: float = number(
        "Доля силы 2-го порядка, снятая балансирными валами", "ψ_2", NONE, 0, 1, USUAL
    )
    suppression: float = number(
        "Степень гашения опрокидывающего момента 2-го порядка", "ψ_г", NONE, 0, 2, USUAL
    )
    shaft_radius_mm: float = number(
        "Эксцентриситет грузов балансирных валов", "e_б", MM, 1, 1000, USUAL
    )
    irregularity: float = number(
        "Требуемая неравномерность хода", "[δ_х]", NONE, 0.0001, 0.5, USUAL
    )
    rod_small_end_share: float = number(
        "Доля массы шатуна у пальца, если масса шатуна не задана", "m_1/m_ш", NONE, 0.05, 0.8, USUAL
    )
    rod_mass_factor: float = number(
        "Отношение момента инерции шатуна к моменту инерции двух замещающих масс",
        "k_ш",
        NONE,
        0.2,
        2,
        USUAL,
    )
    web_width_share: float = number(
        "Отношение ширины щеки к диаметру цилиндра", "b/D", NONE, 0.3, 3, USUAL
    )
    web_thickness_share: float = number(
        "Отношение толщины щеки к диаметру цилиндра", "h/D", NONE, 0.03, 1, USUAL
    )

    @model_validator(mode="before")
    @classmethod
    def _only_what_is_named(cls, data: object) -> object:
        """Drop the usual shares of the other devices where one is named."""
        if isinstance(data, dict) and _SHARES & data.keys():
            return dict.fromkeys(_SHARES, 0.0) | data
        return data

    @property
    def asked(self) -> set[str]:
        """Keys set by a person: given one by one, or other than the defaults.

        A file that a program wrote out gives them all.
        """
        fields = type(self).model_fields
        if self.model_fields_set < fields.keys():
            return set(self.model_fields_set)
        return {key for key, field in fields.items() if getattr(self, key) != field.default}
