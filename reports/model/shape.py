"""Structure of an engine's tables: how many there are, and what they refer to.

Numbers count from 1 here, as people count cylinders, throws and journals.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import isfinite

from kshm.engine.arrangement import Arrangement, pin_counts, pins, rods_beside, throws
from reports.inputs.firing import arrangement_of
from reports.inputs.sections.input_file import GeometrySection, InputFile
from reports.model.blocks import Block, BookChapter
from reports.model.charts import ChartSpec

WORST_PIN = "worst_pin_load"  # key of the number of the most loaded crankpin

FIRING = "scheme.cyl_theta"  # the beginnings of all power strokes, side by side
TIMING = "timing_deg"  # helper column: the angle in the cycle counted on from the piston's TDC


@dataclass(frozen=True)
class Shape:
    """Structure of an engine; expressions that depend on it ask here."""

    arrangement: Arrangement
    strokes: int
    offset: bool
    own_pins: bool = False  # crankpins of sizes of their own

    @classmethod
    def of(cls, model: InputFile) -> Shape:
        """Shape of a checked input."""
        geometry = model.geometry
        offset = isinstance(geometry, GeometrySection) and geometry.is_offset
        shaft = model.crankshaft
        lists = (shaft.pin_diameters_mm, shaft.pin_lengths_mm)
        own_pins = any(len(set(sizes or ())) > 1 for sizes in lists)
        return cls(arrangement_of(model), model.engine.strokes, offset, own_pins)

    @property
    def cylinders(self) -> int:
        """Number of cylinders."""
        return len(self.arrangement)

    @cached_property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """Cylinders on every throw from the nose."""
        return _numbered(throws(self.arrangement))

    @property
    def throws(self) -> int:
        """Number of throws."""
        return len(self.groups)

    @property
    def numbers(self) -> range:
        """Numbers of the cylinders."""
        return range(1, self.cylinders + 1)

    @property
    def throw_numbers(self) -> range:
        """Numbers of the throws from the nose."""
        return range(1, self.throws + 1)

    @property
    def journal_numbers(self) -> range:
        """Numbers of the main journals from the nose."""
        return range(1, self.throws + 2)

    @property
    def pin_numbers(self) -> range:
        """Numbers of the crankpins that have a table."""
        return range(1, len(self.pins) + 1)

    @property
    def hung(self) -> frozenset[int]:
        """Cylinders with articulated rods."""
        return frozenset(filter(self.is_hung, self.numbers))

    @property
    def rod_places(self) -> tuple[tuple[tuple[int, str], ...], ...]:
        """Cylinders of every throw with the place of the rod on it, ``a`` at the nose or ``b``."""
        return tuple(
            tuple((i, "b" if self.arrangement[i - 1].rod_place else "a") for i in group)
            for group in self.groups
        )

    @property
    def single_rods(self) -> bool:
        """Whether every throw carries one rod."""
        return all(len(group) == 1 for group in self.groups)

    @cached_property
    def pins(self) -> tuple[tuple[int, ...], ...]:
        """Cylinders on every crankpin that has a table: one where all are alike with one rod."""
        groups = _numbered(pins(self.arrangement))
        single = all(len(group) == 1 for group in groups)
        return groups[:1] if single and not self.own_pins else groups

    @property
    def period(self) -> int:
        """Length of the cycle [deg]."""
        return 180 * self.strokes

    @property
    def split(self) -> bool:
        """Whether the pins are split."""
        return any(cylinder.pin for cylinder in self.arrangement)

    @property
    def parts(self) -> int:
        """Crankpins of a throw, one behind another: more than one where they are split."""
        return max(pin_counts(self.arrangement))

    @property
    def rods_beside(self) -> int:
        """Rods side by side on a crankpin; articulated ones take none of its length."""
        return rods_beside(self.arrangement, 0)

    @property
    def articulated(self) -> bool:
        """Whether there are articulated rods."""
        return any(cylinder.master is not None for cylinder in self.arrangement)

    @property
    def banks(self) -> bool:
        """Whether the cylinders stand in two rows."""
        return any(cylinder.axis for cylinder in self.arrangement) or not self.single_rods

    @property
    def by_orders(self) -> bool:
        """Whether Neiman's series describes all pistons: central, without articulated rods."""
        return not self.offset and not self.articulated

    def is_hung(self, cylinder: int) -> bool:
        """Whether the cylinder's rod is an articulated one."""
        return self.arrangement[cylinder - 1].master is not None

    def is_right(self, cylinder: int) -> bool:
        """Whether the cylinder stands in the right bank."""
        return self.banks and 2 * cylinder > self.cylinders

    def is_second(self, cylinder: int) -> bool:
        """Whether the cylinder's rod is the one farther from the nose on its pin."""
        return bool(self.arrangement[cylinder - 1].rod_place)

    def throw_of(self, cylinder: int) -> int:
        """Return the number of the cylinder's throw."""
        return self.arrangement[cylinder - 1].throw + 1

    def throw_torque(self, throw: int) -> tuple[str, str]:
        """Key of a throw's torque in the running-on tables and the column that has it."""
        group = self.groups[throw - 1]
        if len(group) == 1:
            return f"M{group[0]}_Nm", f"P4_2.M{group[0]}_Nm"
        return f"Mthrow{throw}_Nm", f"{rods_table(throw)}.Mthrow_Nm"

    # --- expressions ------------------------------------------------------------------

    @property
    def tdc(self) -> str:
        """Name of the angle of TDC, empty where it is 0."""
        return "phi_tdc_deg" if self.offset else ""

    @property
    def bdc(self) -> str:
        """Name of the angle of BDC, empty where it is 180°."""
        return "phi_bdc_deg" if self.offset else ""

    @property
    def turn(self) -> str:
        """Angle of the cycle in radians, as an expression."""
        return "4*pi" if self.strokes == 4 else "2*pi"

    def beta(self, phi: str) -> str:
        """Rod angle [rad], Gots (7), with an offset (17)."""
        if self.offset:
            return f"asin(lam*(sin(rad({phi})) - k_offset))"
        return f"asin(lam*sin(rad({phi})))"

    def displacement(self, phi: str) -> str:
        """Exact displacement over the crank radius, Gots (1), with an offset (12)."""
        if self.offset:
            return (
                f"(sqrt((1/lam + 1)**2 - k_offset**2) - (cos(rad({phi}))"
                f" + sqrt(1 - lam**2*(sin(rad({phi})) - k_offset)**2)/lam))"
            )
        return _central(phi)

    def volume_ratio(self, phi: str) -> str:
        """V/V_c from the exact displacement."""
        if self.offset:
            scale = "(geometry_compression_ratio - 1)*r_crank/S_stroke"
            return f"1 + {scale}*{self.displacement(phi)}"
        return central_volume_ratio(phi)

    def pin_angle(self, cylinder: int) -> str:
        """Angle of the cylinder's crankpin from crank 1 [deg]."""
        angle = f"throw_angle_{self.throw_of(cylinder)}_deg"
        turned = self.arrangement[cylinder - 1].pin_angle
        return f"{angle} + crankshaft_split_pin_deg" if turned else angle

    def axis(self, cylinder: int) -> str:
        """Angle of the cylinder's axis from that of cylinder 1 [deg]."""
        return "crankshaft_bank_angle_deg" if self.is_right(cylinder) else "0"


def _numbered(groups: tuple[tuple[int, ...], ...]) -> tuple[tuple[int, ...], ...]:
    return tuple(tuple(i + 1 for i in group) for group in groups)


def _central(phi: str) -> str:
    return f"((1 - cos(rad({phi}))) + (1 - sqrt(1 - lam**2*sin(rad({phi}))**2))/lam)"


def central_volume_ratio(phi: str) -> str:
    """V/V_c of a central mechanism from the exact displacement, Gots (1)."""
    return f"1 + (geometry_compression_ratio - 1)/2*{_central(phi)}"


def pin_table(number: int) -> str:
    """Name of the table of the loads on a crankpin, by its number."""
    return "crankpin" if number == 1 else f"crankpin_{number}"


def rays_table(number: int) -> str:
    """Name of the table of a crankpin's forces by rays, by its number."""
    return "table_14" if number == 1 else f"table_14_pin_{number}"


def pin_figure(figure: str, number: int) -> str:
    """Name of a crankpin's chart, by the textbook's figure and the pin's number."""
    return figure if number == 1 else f"{figure}_{number}"


def rods_table(throw: int) -> str:
    """Id of the table with the forces of both rods on a throw."""
    return f"rods_{throw}"


def pin_name(number: int) -> str:
    """Return the number of a crankpin within keys: empty for the first one."""
    return "" if number == 1 else str(number)


def most_loaded_pin(scalars: Mapping[str, float | str]) -> int:
    """Number of the most loaded crankpin; the first where it is alone or not found yet."""
    worst = float(scalars.get(WORST_PIN, 1))
    return round(worst) if isfinite(worst) else 1


def cylinder_table_id(number: int) -> str:
    """Id of the table with the forces of a cylinder."""
    return "P4_1" if number == 1 else f"cylinder_{number}"


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
    chapters: tuple[BookChapter, ...] = ()
    own: frozenset[str] = frozenset()  # nodes of books whose numbers no solver gives
    department: frozenset[str] = frozenset()  # those of them that own books have


def stepped(first: float, last: float, step: float) -> tuple[float, ...]:
    """Rows of a table on a grid of its own."""
    return tuple(round(first + step * i, 6) for i in range(round((last - first) / step) + 1))
