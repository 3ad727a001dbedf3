"""The registry: all specifications for one input file."""

from __future__ import annotations

from reports.inputs.fields import iter_fields
from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Block, Model
from reports.spec.charts import ChartSpec
from reports.spec.rename import substituted
from reports.spec.shape import Shape
from reports.tables.gas.cycle import process_blocks
from reports.tables.gas.cycle_results import result_blocks
from reports.tables.gas.cycle_speed import cycle_charts, speed_blocks
from reports.tables.loads.comparison import comparison_blocks, comparison_charts
from reports.tables.loads.cylinder import cylinder_blocks
from reports.tables.loads.journals import journal_blocks
from reports.tables.loads.regimes import regime_models
from reports.tables.loads.torques import torque_tables
from reports.tables.loads.wear import wear_blocks
from reports.tables.motion import mechanism
from reports.tables.motion.offset import offset_tables
from reports.tables.motion.rod_masses import mass_blocks, stand_ins
from reports.tables.overview.charts import charts
from reports.tables.overview.companions import companion_blocks, companion_charts
from reports.tables.overview.scheme import scheme_blocks, scheme_charts
from reports.tables.overview.summary import summary_blocks


def angle_rows(step_deg: int, last: int) -> tuple[float, ...]:
    """Angles of the grid from 0 to ``last`` [deg]."""
    return tuple(float(angle) for angle in range(0, last + step_deg, step_deg))


def build_model(model: InputFile) -> Model:
    """Specifications of every table, scalar and chart for the input's structure."""
    cycle = angle_rows(model.calculation.step_deg, Shape.of(model).period)
    blocks, shown = chain(model)
    further = regime_models(model, chain)
    blocks = (
        *scheme_blocks(Shape.of(model)),
        *process_blocks(model),
        *result_blocks(model),
        *speed_blocks(model),
        *blocks,
        *comparison_blocks(model, further),
        *(block for regime in further for block in regime.renamed_blocks()),
        *substituted(companion_blocks(model, cycle), stand_ins(model)),
    )
    return Model(
        model,
        tuple(iter_fields(model)),
        blocks,
        (
            *scheme_charts(),
            *cycle_charts(model),
            *shown,
            *comparison_charts(model),
            *(chart for regime in further for chart in regime.renamed_charts()),
            *companion_charts(model),
        ),
    )


def chain(model: InputFile) -> tuple[tuple[Block, ...], tuple[ChartSpec, ...]]:
    """Blocks and charts of chapters 1 and 2: all that speed and gas decide, and more."""
    shape = Shape.of(model)
    rays = model.calculation.wear_rays
    cycle = angle_rows(model.calculation.step_deg, shape.period)
    turn = angle_rows(model.calculation.step_deg, 360)
    forced = model.crankshaft.force_offsets_deg is not None
    blocks = (
        mechanism.geometry(model),
        mechanism.masses(model),
        *mass_blocks(model),
        *(offset_tables(turn) if shape.offset else mechanism.kinematic_tables(turn)),
        *cylinder_blocks(model, cycle),
        *torque_tables(shape, cycle),
        *journal_blocks(shape, cycle, forced=forced),
        *wear_blocks(shape.throws + 1, rays, cycle, len(shape.pins)),
        *summary_blocks(model, shape),
    )
    return substituted(blocks, stand_ins(model)), charts(shape)
