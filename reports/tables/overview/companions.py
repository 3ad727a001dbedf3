"""Sheets of the companion sources: Segal, Neiman, reduced inertia, torque orders, balance."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Block
from reports.spec.charts import ChartSpec
from reports.spec.shape import Shape
from reports.tables.balance.balance import balance_blocks, balance_charts
from reports.tables.balance.inertia import inertia_blocks, inertia_charts
from reports.tables.balance.torque_orders import torque_order_blocks, torque_order_charts
from reports.tables.loads.bearings import bearing_blocks, bearing_charts
from reports.tables.motion.neiman import neiman_blocks, neiman_charts
from reports.tables.motion.reference import reference_blocks, reference_charts
from reports.tables.motion.segal import segal_blocks, segal_charts
from reports.tables.motion.two_term import two_term_blocks, two_term_charts


def companion_blocks(model: InputFile, cycle: tuple[float, ...]) -> tuple[Block, ...]:
    """Blocks of the companion sources: most are about basic engines only."""
    shape = Shape.of(model)
    turn = tuple(angle for angle in cycle if angle <= 360)
    forced = model.crankshaft.force_offsets_deg is not None
    chapters = (
        *reference_blocks(model, turn),
        *bearing_blocks(model, cycle),
        *two_term_blocks(model, turn),
    )
    if not shape.by_orders:
        return chapters
    return (
        *balance_blocks(shape, cycle, forced=forced),
        *inertia_blocks(model, cycle),
        *torque_order_blocks(model, cycle),
        *segal_blocks(),
        *neiman_blocks(),
        *chapters,
    )


def companion_charts(model: InputFile) -> tuple[ChartSpec, ...]:
    """Charts of the companion sources."""
    shape = Shape.of(model)
    chapters = (*reference_charts(model), *bearing_charts(model), *two_term_charts())
    if not shape.by_orders:
        return chapters
    return (
        *balance_charts(shape),
        *inertia_charts(),
        *torque_order_charts(shape.strokes),
        *segal_charts(),
        *neiman_charts(),
        *chapters,
    )
