"""The [crankshaft] section of the input file: phases, journals, webs and arms."""

from __future__ import annotations

from typing import Annotated

from pydantic import Strict

from reports.inputs.meta import Strictly, number, text, title_of
from reports.inputs.units import DEG, KG, MM


class WebSection(Strictly):
    """[[crankshaft.webs]]: a web and its counterweight; masses reduced to the crank radius."""

    mass_kg: float | None = number("Щека {n}: приведённая масса", "m_щ{n}", KG, 0, 5000, None)
    actual_mass_kg: float | None = number(
        "Щека {n}: действительная масса", "m_щ{n}", KG, 0, 5000, None
    )
    centre_mm: float | None = number("Щека {n}: радиус центра масс", "ρ_{n}", MM, -2000, 2000, None)
    angle_deg: float = number(
        "Щека {n}: угол против вращения от кривошипа", "α_щ{n}", DEG, -360, 360, 0.0
    )
    counterweight_kg: float = number(
        "Щека {n}: приведённая масса противовеса", "m_пр{n}", KG, 0, 5000, 0.0
    )
    counterweight_angle_deg: float = number(
        "Щека {n}: угол противовеса по вращению от направления, противоположного кривошипу",
        "α_пр{n}",
        DEG,
        -360,
        360,
        0.0,
    )


class ArmsSection(Strictly):
    """[[crankshaft.arms]]: the chain of lengths of one throw, Gots figure 35."""

    l1_mm: float = number("Колено {n}: плечо l1", "l_1", MM, 0, 5000)
    l2_mm: float = number("Колено {n}: плечо l2", "l_2", MM, 0, 5000)
    l3_mm: float = number("Колено {n}: плечо l3", "l_3", MM, 0, 5000, 0.0)
    l4_mm: float = number("Колено {n}: плечо l4", "l_4", MM, 0, 5000, 0.0)
    l5_mm: float = number("Колено {n}: плечо l5", "l_5", MM, 0, 5000)
    l6_mm: float = number("Колено {n}: плечо l6", "l_6", MM, 0, 5000)
    left_web_mm: float = number("Колено {n}: толщина левой щеки", "h_Л", MM, 0, 2000, 0.0)
    right_web_mm: float = number("Колено {n}: толщина правой щеки", "h_П", MM, 0, 2000, 0.0)


class CrankshaftSection(Strictly):
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
        "Приведённая масса шатунной шейки", "m_ш.ш", KG, 0, 5000, None
    )
    oil_hole_deg: float | None = number(
        "Масляное отверстие шатунной шейки: угол от колена против вращения",
        "α_м",
        DEG,
        -360,
        360,
        None,
    )
    nose_mass_kg: float = number(
        "Внешний противовес на носке: приведённая масса", "m_вп1", KG, 0, 5000, 0.0
    )
    nose_angle_deg: float = number(
        "Противовес на носке: угол по вращению от колена 1", "α_вп1", DEG, -360, 360, 0.0
    )
    nose_arm_mm: float = number("Плечо противовеса на носке PL1", "l_p1", MM, 0, 5000, 0.0)
    rear_mass_kg: float = number(
        "Внешний противовес сзади: приведённая масса", "m_вп2", KG, 0, 5000, 0.0
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
