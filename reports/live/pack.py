"""What a browser needs of an engine to calculate and show it: data and the scripts of functions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from reports.live import describe
from reports.live.program import LiveProgram, program_of
from reports.model.blocks import Model, nodes_in
from reports.tables.registry import build_model

Data = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Packed:
    """An engine for a browser: plain data, and modules of JavaScript with its functions.

    Attributes:
        data: fields, tables, charts, checks, mechanism, both programs.
        script: functions of the book's own step.
        fine_script: functions of the curves' step.
    """

    data: Data
    script: str
    fine_script: str


def packed(model: Model, shown: Model) -> Packed:
    """Pack an engine.

    Args:
        model: all tables of the engine.
        shown: those of them that a page shows.

    Raises:
        FormulaError: a formula that has no meaning in JavaScript.
    """
    charts, scene = describe.charts(shown), describe.scene(model)
    curves = [key for chart in charts for key in describe.keys_of(chart)]
    program = program_of(model, (*shown.nodes, *curves))
    fine_model = describe.with_joints(_fine(model))
    nodes = [key for key in curves if key in fine_model.nodes and key not in program.fixed]
    fine = program_of(fine_model, (*nodes, *describe.scene_keys(scene)))
    used = frozenset(program.inputs_read | fine.inputs_read)
    data = {
        **describe.about(model.input), "fields": list(describe.fields(model, used)),
        "main": describe.main_fields(model), "sentences": describe.sentences(),
        "sheets": describe.sheets(shown), "checks": describe.checks(shown), "charts": charts,
        "numbers": describe.key_numbers(shown), "scene": scene, "remarks": model.remarks,
        "fixedTables": _fixed_tables(shown, program), "program": program.data(),
        "fine": fine.data(),
    }  # fmt: skip
    return Packed(data, program.script(), fine.script())


def _fine(model: Model) -> Model:
    """Return the same engine with the step of the curves."""
    calculation = model.input.calculation.model_copy(update={"step_deg": describe.FINE_DEG})
    return build_model(model.input.model_copy(update={"calculation": calculation}))


def _fixed_tables(model: Model, program: LiveProgram) -> list[str]:
    """Titles of the blocks that hold what only a build finds."""
    blocks = {key: block.title for block in model.blocks for key, _ in nodes_in(block)}
    return sorted({blocks[key] for key in program.fixed & blocks.keys()})
