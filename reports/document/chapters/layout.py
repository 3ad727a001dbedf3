"""What the layout adds to the report: scheme of the engine, two rods on a throw."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.figures.shaft import engine_scheme
from reports.document.page.writer import Figure
from reports.inputs.sections.input_file import LAYOUTS
from reports.model.shape import rods_table


def scheme_text(chapter: Chapter) -> Markup:
    """Scheme of the engine drawn from the input, with the order of the power strokes."""
    shape, shaft = chapter.shape, chapter.input.crankshaft
    numbers = range(1, shape.cylinders + 1)
    bank = shaft.bank_angle_deg or 0.0
    draw = partial(
        engine_scheme,
        tuple(bank if shape.is_right(i) else 0.0 for i in numbers),
        tuple(shape.throw_of(i) for i in numbers),
        tuple(shaft.throw_angles_deg),
        tuple(shaft.firing_offsets_deg),
        float(shape.period),
    )
    scheme = Figure(draw, "Схема двигателя с носка вала и рабочие ходы цилиндров")
    return chapter.page("layout", scheme=scheme, layout=LAYOUTS[chapter.input.engine.layout])


def rods_text(chapter: Chapter) -> Markup:
    """Sums of the forces of two rods on a throw; nothing where throws carry one."""
    shape = chapter.shape
    if shape.single_rods:
        return Markup("")
    tables = [rods_table(k) for k in range(1, shape.throws + 1)]
    hung = f"cylinder_{shape.cylinders}" if shape.articulated else ""
    return chapter.page("rods", rods=rods_table(1), group=shape.groups[0], hung=hung, tables=tables)
