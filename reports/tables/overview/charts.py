"""Charts of chapters 1 and 2: figures 41-57 of the textbook, p-V and p-φ."""

from __future__ import annotations

from reports.spec.charts import ChartSpec
from reports.spec.shape import Shape
from reports.tables.loads.cylinder import cylinder_charts
from reports.tables.loads.journals import journal_charts, pin_charts
from reports.tables.loads.torques import torque_charts
from reports.tables.loads.wear import wear_charts
from reports.tables.motion.articulated import hung_charts
from reports.tables.motion.mechanism import kinematic_charts
from reports.tables.motion.offset import offset_charts


def charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """All charts of the book's figures for an engine of this shape."""
    return (
        *kinematic_charts(shape),
        *(offset_charts() if shape.offset else ()),
        *(hung_charts() if shape.articulated else ()),
        *cylinder_charts(),
        *torque_charts(shape),
        *pin_charts(shape),
        *journal_charts(shape),
        *wear_charts(shape),
    )
