"""The registry: all specifications for one input file."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

from reports.inputs.fields import Value, iter_fields, tables_shape
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import smallness_of
from reports.spec.blocks import Model
from reports.spec.parts import Part, PartOf, Scope, joined
from reports.spec.rename import sized, substituted
from reports.tables.contexts import book
from reports.tables.gas.cycle_names import cycle_stand_ins
from reports.tables.loads.comparison import comparison
from reports.tables.loads.regimes import regime_models
from reports.tables.oil.film import film
from reports.tables.oil.orbit import orbit
from reports.tables.oil.safety import safety
from reports.tables.overview.left_out import left_out_note
from reports.tables.overview.verdicts import accepted_checks
from reports.tables.stand_ins import mass_stand_ins, size_stand_ins

# Files of tables in the order of their sheets.
BEFORE: tuple[PartOf, ...] = (
    book("scheme"), book("cycle"), book("cycle_results"), book("cycle_speed"),
)  # fmt: skip
# Chapters 1 and 2: all that speed and gas decide, and more; every regime has them.
CHAIN: tuple[PartOf, ...] = (
    book("mechanism"), book("rod_masses"), book("kinematics"),
    book("articulated"), book("gas"), book("cylinders"),
    book("torques"), book("crankpins"), book("throws"), book("journals"),
    book("wear"), book("summary"),
)  # fmt: skip
AFTER: tuple[PartOf, ...] = (
    book("balance"), book("balance_orders"), book("firing"), book("inertia"),
    book("torque_orders"), book("piston_motion"), book("reference"),
    book("bearings"), book("continuous"), book("two_term"),
    book("torsion"),
    film, orbit, safety,
)  # fmt: skip


def build_model(model: InputFile, remarks: tuple[str, ...] = ()) -> Model:
    """Specifications of every table, scalar and chart for the input's structure.

    ``remarks`` are lines about the input, told beside the checks.
    """
    scope, regimes = Scope(model), regime_models(model, chain)
    parts = (
        joined(scope, BEFORE),
        chain(model),
        comparison(model, regimes),
        *(regime.part() for regime in regimes),
        joined(scope, AFTER),
    )
    blocks = tuple(block for part in parts for block in part.blocks)
    charts = tuple(chart for part in parts for chart in part.charts)
    blocks = sized(substituted(blocks, stand_ins(model)), smallness_of(model))
    note = left_out_note(model)
    remarks = (*remarks, *accepted_checks(model, blocks), *((note,) if note else ()))
    return Model(model, tuple(iter_fields(model)), blocks, charts, remarks)


@dataclass(frozen=True)
class _Like:
    """An input, the same as any other whose tables are the same."""

    shape: tuple[tuple[str, Value | None], ...]
    model: InputFile = field(compare=False)


@lru_cache(maxsize=24)
def _built_once(like: _Like) -> Model:
    return build_model(like.model)


def kept_model(model: InputFile) -> Model:
    """As `build_model`; of inputs of one shape the tables are made once and kept."""
    fields = tuple(iter_fields(model))
    return _built_once(_Like(tables_shape(fields), model)).with_inputs(model, fields)


def stand_ins(model: InputFile) -> dict[str, str]:
    """Inputs that the file leaves out and the scalars that take their place."""
    return {**size_stand_ins(model), **mass_stand_ins(model), **cycle_stand_ins(model)}


def chain(model: InputFile) -> Part:
    """Blocks and charts that a regime has too."""
    part = joined(Scope(model), CHAIN)
    return Part(substituted(part.blocks, stand_ins(model)), part.charts)
