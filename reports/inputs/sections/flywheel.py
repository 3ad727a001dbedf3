"""The [flywheel] section of the input file: sizes and material of the flywheel as a part."""

from __future__ import annotations

from typing import Literal

from kshm.engine.flywheel import Flywheel
from reports.inputs.meta import USUAL, StrictModel, choice, named, number
from reports.inputs.units import MM, NONE

FLYWHEELS = {"iron": "чугун", "steel": "сталь"}


class FlywheelSection(StrictModel, usual=(Flywheel,)):
    """[flywheel]: a size that is not given follows from the stroke."""

    material: Literal["iron", "steel"] = choice(
        "Материал маховика", FLYWHEELS, USUAL, structural=True
    )
    outer_mm: float | None = number(*named("fw_outer_mm"), MM, 20, 10000, None)
    rim_share: float = number(
        "Отношение толщины обода к диаметру маховика", "t_об/D_м", NONE, 0.01, 0.45, USUAL
    )
    disc_mm: float | None = number(*named("fw_disc_mm"), MM, 0.5, 1000, None)
    overspeed: float = number(
        "Отношение наибольшей частоты вращения маховика к номинальной", "k_раз", NONE, 1, 2, USUAL
    )
