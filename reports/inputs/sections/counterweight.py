"""The [counterweight] section of the input file: a sector on every web, what it is chosen by."""

from __future__ import annotations

from typing import Literal

from kshm.engine.counterweight import Counterweight
from reports.inputs.meta import USUAL, StrictModel, choice, named, number
from reports.inputs.units import KG_M3, MM, NONE

GOALS = {"loads": "нагрузка коренных шеек", "residue": "остаток первого порядка"}


class CounterweightSection(StrictModel, usual=(Counterweight,)):
    """[counterweight]: a size that is not given follows from the mechanism."""

    goal: Literal["loads", "residue"] = choice("Цель противовесов", GOALS, USUAL, structural=True)
    share: float | None = number(*named("cw_taken"), NONE, 0, 2, None)
    inner_mm: float | None = number(*named("cw_inner_mm"), MM, 1, 3000, None)
    outer_mm: float | None = number(*named("cw_outer_mm"), MM, 2, 5000, None)
    width_mm: float | None = number(*named("cw_width_mm"), MM, 1, 2000, None)
    density_kg_m3: float = number("Плотность противовеса", "ρ_пв", KG_M3, 1000, 25000, USUAL)
    skirt_mm: float | None = number(*named("cw_skirt_mm"), MM, 0.5, 3000, None)
    play_mm: float = number("Зазор между поршнем и противовесом", "Δ_пв", MM, 0, 100, USUAL)
