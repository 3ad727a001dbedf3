"""The [counterweight] section of the input file: a sector on every web, what it is chosen by."""

from __future__ import annotations

from typing import Literal

from kshm.engine.counterweight import Counterweight
from reports.inputs.meta import USUAL, Strictly, choice, number, title_of
from reports.inputs.units import KG_M3, MM, NONE

GOALS = {"loads": "нагрузка коренных шеек", "residue": "остаток первого порядка"}


class CounterweightSection(Strictly, usual=(Counterweight,)):
    """[counterweight]: a size that is not given follows from the mechanism."""

    goal: Literal["loads", "residue"] = choice("Цель противовесов", GOALS, USUAL, structural=True)
    share: float | None = number(title_of("cw_taken"), "k_пв", NONE, 0, 2, None)
    inner_mm: float | None = number(title_of("cw_inner_mm"), "R_пв1", MM, 1, 3000, None)
    outer_mm: float | None = number(title_of("cw_outer_mm"), "R_пв2", MM, 2, 5000, None)
    width_mm: float | None = number(title_of("cw_width_mm"), "b_пв", MM, 1, 2000, None)
    density_kg_m3: float = number("Плотность противовеса", "ρ_пв", KG_M3, 1000, 25000, USUAL)
    skirt_mm: float | None = number(title_of("cw_skirt_mm"), "h_пор", MM, 0.5, 3000, None)
    play_mm: float = number("Зазор между поршнем и противовесом", "Δ_пв", MM, 0, 100, USUAL)
