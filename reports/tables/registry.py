"""The registry: all specifications for one input file."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache

from reports.inputs.department_chapters import Texts
from reports.inputs.fields import Value, iter_fields, tables_shape
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import smallness_of
from reports.model.blocks import Model
from reports.model.chapter_source import shelf_of
from reports.model.contents import contents_of
from reports.model.rename import sized, substituted
from reports.model.shape import Part, Scope
from reports.tables.contexts import books
from reports.tables.cycle_members import cycle_stand_ins
from reports.tables.left_out import left_out_note
from reports.tables.regimes import comparison, regime_models
from reports.tables.verdicts import accepted_checks


def build_model(model: InputFile, remarks: tuple[str, ...] = ()) -> Model:
    """Specifications of every table, scalar and chart for the input's structure.

    ``remarks`` are lines about the input, told beside the checks.
    """
    scope, regimes = Scope(model), regime_models(model, chain)
    house = contents_of(shelf_of(model.books))
    parts = (
        books(scope, house.parts["before"]),
        chain(model),
        comparison(model, regimes),
        *(regime.part() for regime in regimes),
        books(scope, house.parts["after"]),
    )
    blocks = tuple(block for part in parts for block in part.blocks)
    charts = tuple(chart for part in parts for chart in part.charts)
    blocks = sized(substituted(blocks, stand_ins(model)), smallness_of(model))
    note = left_out_note(model)
    remarks = (*remarks, *accepted_checks(model, blocks), *((note,) if note else ()))
    chapters = tuple(chapter for part in parts for chapter in part.chapters)
    nodes = frozenset().union(*(part.own for part in parts))
    department = frozenset().union(*(part.department for part in parts))
    return Model(model, tuple(iter_fields(model)), blocks, charts, remarks, chapters, nodes,
                 department)  # fmt: skip


@dataclass(frozen=True)
class _ShapeKey:
    """An input, the same as any other whose tables are the same."""

    shape: tuple[tuple[str, Value | None], ...]
    books: Texts
    model: InputFile = field(compare=False)


@lru_cache(maxsize=24)
def _built_once(like: _ShapeKey) -> Model:
    return build_model(like.model)


def kept_model(model: InputFile) -> Model:
    """As `build_model`; of inputs of one shape the tables are made once and kept."""
    fields = tuple(iter_fields(model))
    return _built_once(_ShapeKey(tables_shape(fields), model.books, model)).with_inputs(
        model, fields
    )


def _size_stand_ins(model: InputFile) -> dict[str, str]:
    """Sizes of a single journal where the input gives one size for all."""
    shaft, throws = model.crankshaft, len(model.crankshaft.throw_angles_deg)
    sizes = (
        ("pin_diameter", shaft.pin_diameters_mm, throws),
        ("pin_length", shaft.pin_lengths_mm, throws),
        ("main_diameter", shaft.main_diameters_mm, throws + 1),
    )
    return {
        f"{name}_{number}_mm": f"crankshaft_{name}_mm"
        for name, each, count in sizes
        if each is None
        for number in range(1, count + 1)
    }


def _mass_stand_ins(model: InputFile) -> dict[str, str]:
    """Masses that the sheet of masses finds."""
    masses, names = model.masses, {}
    if masses.reciprocating_kg is None:
        if masses.rod_centre_mm is None and masses.rod_small_end_share is None:
            names["masses_rod_small_end_share"] = "rod_share"
        if masses.piston_group_kg is None:
            names["masses_piston_group_kg"] = "m_piston"
        if masses.rod_kg is None:
            names["masses_rod_kg"] = "m_rod"
    if model.crankshaft.pin_mass_kg is None:
        names["crankshaft_pin_mass_kg"] = "pin_est"
    for number, web in enumerate(model.crankshaft.webs, 1):
        if web.actual_mass_kg is not None:
            names[f"web_{number}_mass_kg"] = f"web_red{number}"
        elif web.mass_kg is None:
            names[f"web_{number}_mass_kg"] = "web_est"
    return names


def stand_ins(model: InputFile) -> dict[str, str]:
    """Return inputs that the file leaves out and the scalars that take their place."""
    return {**_size_stand_ins(model), **_mass_stand_ins(model), **cycle_stand_ins(model)}


def chain(model: InputFile) -> Part:
    """Blocks and charts that a regime has too."""
    part = books(Scope(model), contents_of(shelf_of(model.books)).parts["chain"])
    return replace(part, blocks=substituted(part.blocks, stand_ins(model)))
