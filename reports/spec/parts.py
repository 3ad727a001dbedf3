"""What a file of tables is given and what it gives: its blocks and their charts."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Block
from reports.spec.charts import ChartSpec
from reports.spec.shape import Shape


@dataclass(frozen=True)
class Scope:
    """The input that a model is for, and what follows from it for all tables."""

    input: InputFile

    @cached_property
    def shape(self) -> Shape:
        """Layout of the engine."""
        return Shape.of(self.input)

    @cached_property
    def cycle(self) -> tuple[float, ...]:
        """Crank angles of a cycle [deg]."""
        return self._angles(self.shape.period)

    @cached_property
    def turn(self) -> tuple[float, ...]:
        """Crank angles of a turn [deg]."""
        return self._angles(360)

    @property
    def forced(self) -> bool:
        """Whether phases of the forces are given, as the printed П4.3 needs them."""
        return self.input.crankshaft.force_offsets_deg is not None

    def _angles(self, last: int) -> tuple[float, ...]:
        step = self.input.calculation.step_deg
        return tuple(float(angle) for angle in range(0, last + step, step))


@dataclass(frozen=True, slots=True)
class Part:
    """Blocks of a subject and the charts that stand beside them."""

    blocks: tuple[Block, ...] = ()
    charts: tuple[ChartSpec, ...] = ()


def stepped(first: float, last: float, step: float) -> tuple[float, ...]:
    """Rows of a table on a grid of its own."""
    return tuple(round(first + step * i, 6) for i in range(round((last - first) / step) + 1))
