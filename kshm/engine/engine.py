"""The engine as a frozen dataclass, SI units throughout, angles in radians."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html import escape
from typing import Any, Literal

from kshm.defaults import (
    COUNTERWEIGHT_SHARE,
    IRREGULARITY,
    SMALL_END_SHARE,
    SUPPRESSION,
    WEB_THICKNESS_SHARE,
    WEB_WIDTH_SHARE,
)
from kshm.engine.arrangement import (
    MAX_GAP,
    Arrangement,
    ArticulatedRod,
    firing_gap,
    hung,
    in_row,
    side_reach,
)
from kshm.engine.bearings import Bearings
from kshm.engine.checks import POSITIVE, as_scalar, check_numbers, refuse
from kshm.engine.counterweight import Counterweight
from kshm.engine.crankshaft import Crankshaft
from kshm.engine.flywheel import Flywheel
from kshm.engine.gas import Gas, PolytropicGas, TabulatedGas
from kshm.engine.masses import DirectMasses, Masses
from kshm.engine.revised import engine_maker
from kshm.engine.source import Source
from kshm.engine.strength import PartStrength
from kshm.engine.torsion import Torsion
from kshm.nomenclature.quantity import UNITS
from kshm.ranges import RANGES

Method = Literal["textbook", "exact"]
_MAX_STEP = 60  # degrees: the fewest angles that tell the torque's lowest orders
# Sizes beyond these are another unit's, of whatever engine.
_STROKE_BORE = RANGES["stroke_bore"].doubtful["crosshead"]
_PISTON_SPEED = RANGES["piston_speed"].doubtful[""]
_PEAK_PRESSURE = RANGES["combustion.p_z"].doubtful[""]
_RECIPROCATING = RANGES["reciprocating_mass"].doubtful["any"]


@dataclass(frozen=True, slots=True)
class Geometry:
    """Main dimensions of the crank mechanism [m].

    ``crank_offset`` is how far the cylinder's axis passes the shaft on the side to which
    the crank turns at TDC, ``pin_offset`` how far the piston pin stands from the
    cylinder's axis on the same side, Gots 1.4.  None of both: a central mechanism.
    """

    bore: float
    crank_radius: float
    rod_length: float
    compression_ratio: float
    crank_offset: float | None = None
    pin_offset: float | None = None

    def __post_init__(self) -> None:
        """Refuse a mechanism that does not turn."""
        check_numbers(self, POSITIVE, "bore", "crank_radius", "rod_length")
        refuse(
            (self.compression_ratio <= 1, "the compression ratio must be above 1"),
            (
                self.rod_length <= self.crank_radius + abs(self.offset),
                "the rod must be longer than the crank and the offset together",
            ),
        )

    @property
    def lam(self) -> float:
        """Crank radius over rod length λ = r/L [-]."""
        return self.crank_radius / self.rod_length

    @property
    def offset(self) -> float:
        """Distance e of the pin's path from the shaft axis [m]."""
        return (self.crank_offset or 0.0) + (self.pin_offset or 0.0)

    @property
    def is_central(self) -> bool:
        """Whether the mechanism is meant to have no offset, not even one of zero."""
        return self.crank_offset is None and self.pin_offset is None

    @property
    def relative_offset(self) -> float:
        """Relative offset k = e/r [-], Gots 1.4."""
        return self.offset / self.crank_radius

    @property
    def stroke(self) -> float:
        """Piston stroke [m]: 2r, with an offset S_д of Gots (11)."""
        if self.offset == 0:
            return 2 * self.crank_radius
        r, rod, e = self.crank_radius, self.rod_length, self.offset
        return math.sqrt((rod + r) ** 2 - e**2) - math.sqrt((rod - r) ** 2 - e**2)

    @property
    def piston_area(self) -> float:
        """Piston area F [m²]."""
        return math.pi * self.bore**2 / 4


@dataclass(frozen=True, slots=True)
class Balancing:
    """Choices of balancing and flywheel; SI units."""

    counterweight_share: float = COUNTERWEIGHT_SHARE
    first_shafts_share: float = 0.0
    second_shafts_share: float = 1.0
    suppression: float = SUPPRESSION
    shaft_radius: float = 0.02
    irregularity: float = IRREGULARITY
    rod_small_end_share: float = SMALL_END_SHARE
    rod_mass_factor: float = 1.0
    web_width_share: float = WEB_WIDTH_SHARE
    web_thickness_share: float = WEB_THICKNESS_SHARE


@dataclass(frozen=True, slots=True)
class OperatingPoint:
    """A further regime of the engine: what differs from the main one; SI units."""

    name: str
    omega: float
    gas: Gas
    mechanical_efficiency: float = 1.0
    indicated_power: float | None = None
    fullness: float = 1.0


@dataclass(frozen=True, slots=True, repr=False)
class Engine:
    """A piston engine, SI units.

    ``firing_offsets`` are θ_i [rad], one per cylinder, cylinder 1 first.
    ``arrangement`` says where the cylinders stand; empty means in line.
    ``articulated`` describes the rods that hang on others, in the order of their cylinders.
    ``force_offsets`` replaces θ_i for the loads on the main journals only; it
    exists to reproduce the printed table П4.3, whose phases contradict the
    shaft, and is None otherwise.

    Raises:
        InputError: a number or a count that no engine has.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> from dataclasses import replace
    >>> faster = replace(engine, omega=1.1 * engine.omega, method="exact")
    >>> round(faster.speed_rpm)
    3300
    """

    geometry: Geometry
    omega: float
    gas: Gas
    masses: Masses
    crankshaft: Crankshaft
    firing_offsets: tuple[float, ...]
    strokes: int = 4
    method: Method = "textbook"
    step_deg: int = 10
    rays: int = 12
    mechanical_efficiency: float = 1.0
    indicated_power: float | None = None  # W, from a cycle calculation
    fullness: float = 1.0  # φ_п: how much the power was rounded down by
    force_offsets: tuple[float, ...] | None = None
    balancing: Balancing = field(default_factory=Balancing)
    name: str = field(default="engine")
    oil_hole: float | None = None  # angle of the crankpin's oil hole [rad], by the wear if None
    regimes: tuple[OperatingPoint, ...] = ()  # further speeds and loads
    reference_lambdas: tuple[float, ...] = ()  # λ of the reference tables, none if not asked for
    reference_angle: float = 0.0  # crank angle of the drawn mechanism [rad]
    arrangement: Arrangement = ()
    articulated: tuple[ArticulatedRod, ...] = ()
    torsion: Torsion | None = None  # torsional vibration, if it is asked for
    bearings: Bearings | None = None  # oil film and strength, if they are asked for
    strength: PartStrength | None = None  # strength of the parts, if it is asked for
    flywheel: Flywheel | None = None  # as a part, if asked for
    counterweight: Counterweight | None = None  # those proposed for the webs, if asked for
    source: Source | None = field(default=None, compare=False)  # the file that it was read from

    def __post_init__(self) -> None:
        """Give an engine without arrangement its cylinders in line; refuse what cannot be."""
        if not self.arrangement:
            object.__setattr__(self, "arrangement", in_row(self.cylinders))
        check_numbers(self, POSITIVE, "omega", "fullness", "indicated_power")
        self._check_calculation()
        self._check_timing()
        self._check_layout()
        self._check_articulated()

    def __repr__(self) -> str:
        """Return the name, the layout and the sizes that tell an engine from others."""
        size = self.geometry
        layout = "in line" if self.is_in_line else f"on {len(self.crankshaft.throws)} throws"
        return (
            f"<Engine {self.name!r}: {self.cylinders} {layout}, {self.strokes}-stroke, "
            f"D×S {size.bore * 1e3:.4g}×{size.stroke * 1e3:.4g} mm, "
            f"ε {size.compression_ratio:.4g}, {self.speed_rpm:.5g} min⁻¹>"
        )

    def _repr_html_(self) -> str:
        """Return the sizes as a notebook shows them."""
        size, shaft = self.geometry, self.crankshaft
        rows = {
            "cylinders": f"{self.cylinders}, {self.strokes}-stroke",
            "bore × stroke": f"{size.bore * 1e3:.4g} × {size.stroke * 1e3:.4g} mm",
            "rod length": f"{size.rod_length * 1e3:.4g} mm, λ = {size.lam:.4g}",
            "compression ratio": f"{size.compression_ratio:.4g}",
            "speed": f"{self.speed_rpm:.5g} min⁻¹",
            "fire at": ", ".join(f"{math.degrees(each):.5g}°" for each in self.firing_offsets),
            "gas": type(self.gas).__name__,
            "throws, main journals": f"{len(shaft.throws)}, {len(shaft.main_lengths)}",
        }
        lines = (f"<tr><td>{key}</td><td>{escape(text)}</td></tr>" for key, text in rows.items())
        return f"<b>{escape(self.name)}</b><table><tbody>{''.join(lines)}</tbody></table>"

    def _check_calculation(self) -> None:
        gas, efficiency = self.gas, self.mechanical_efficiency
        refuse(
            (self.strokes not in (2, 4), "strokes are 2 or 4"),
            (
                not 1 <= self.step_deg <= _MAX_STEP or 180 % self.step_deg != 0,
                f"the step must divide 180° and be at most {_MAX_STEP}°, not {self.step_deg}",
            ),
            (self.rays not in (12, 18), "wear diagrams have 12 or 18 rays"),
            (
                self.method not in ("textbook", "exact"),
                f"the method is 'textbook' or 'exact', not {self.method!r}",
            ),
            (
                not 0 <= efficiency <= 1,  # 0 at idle
                f"the mechanical efficiency must be from 0 to 1, not {efficiency:g}",
            ),
            (
                isinstance(gas, TabulatedGas) and abs(gas.angles[-1] - self.period) > 1e-9,
                f"the points of the gas must end with the cycle at {180 * self.strokes}°",
            ),
        )

    def _check_timing(self) -> None:
        gas = self.gas
        if isinstance(gas, TabulatedGas):
            return
        tdc, start, end = self.period - 2 * math.pi, gas.combustion_start, gas.exhaust_close
        scavenged = self.strokes == 2 and isinstance(gas, PolytropicGas)
        refuse(
            (
                not math.pi < start <= 2 * math.pi,
                f"combustion starts at 180° … 360° of the cycle, not at {_degrees(start)}",
            ),
            (
                not tdc <= gas.exhaust_open < end <= self.period,
                f"the exhaust opens and closes from {_degrees(tdc)} to {_degrees(self.period)}, "
                f"not at {_degrees(gas.exhaust_open)} and {_degrees(end)}",
            ),
            (
                scavenged and not gas.exhaust_open <= getattr(gas, "scavenge_open", 0.0) <= end,
                "scavenging of a two-stroke engine begins while the exhaust is open",
            ),
        )

    def _check_layout(self) -> None:
        arrangement, throws = self.arrangement, len(self.crankshaft.throws)
        refuse(
            (self.cylinders < 1, "an engine has a cylinder"),
            (
                len(arrangement) != self.cylinders,
                f"{len(arrangement)} places need as many firing offsets, not {self.cylinders}",
            ),
            (
                {cylinder.throw for cylinder in arrangement} != set(range(throws)),
                f"the rods of {self.cylinders} cylinders stand on other throws than the {throws}",
            ),
        )

    def _check_articulated(self) -> None:
        arrangement, hanging = self.arrangement, hung(self.arrangement)
        refuse(
            (
                len(self.articulated) != len(hanging),
                f"{len(hanging)} articulated rods must be described, not {len(self.articulated)}",
            )
        )
        for i, rod in zip(hanging, self.articulated, strict=True):
            number, hanging_one = arrangement[i].master or 0, arrangement[i]
            master = arrangement[number] if 0 <= number < self.cylinders else hanging_one
            refuse(
                (
                    master is hanging_one
                    or master.master is not None
                    or master.throw != hanging_one.throw,
                    "a master rod must be one of a cylinder on the same throw whose rod hangs "
                    f"on no other: cylinder {i + 1}",
                )
            )
            size = self.geometry
            reach = side_reach(
                size.crank_radius, size.rod_length, size.offset, rod.radius, rod.angle,
                hanging_one.axis - master.axis,
            )  # fmt: skip
            refuse(
                (
                    reach >= rod.rod_length,
                    f"the articulated rod of cylinder {i + 1} is {rod.rod_length * 1e3:g} mm long: "
                    f"its pin stands up to {reach * 1e3:.4g} mm off the cylinder's axis",
                )
            )

    def with_(self, changes: Mapping[str, Any] | None = None, **more: Any) -> Engine:  # noqa: ANN401
        """Return an engine with other values.

        Args:
            changes: values by name: a key of the file that the engine was read from
                (``geometry.bore_mm``, ``crankshaft.webs.*.counterweight_kg``, in the file's
                units), a name of ``kshm.assemble`` (``bore_mm``, in its units), or a path within
                the engine (``geometry.bore``, in SI).
            **more: the same, for names without a dot; a file's key goes by its last word.

        Raises:
            UnknownNameError: a name that there is not.
            InputError: a value that no engine has.

        With ``engine`` as in the example of ``kshm.in_line``:

        >>> engine.with_(bore_mm=90, speed_rpm=2000).geometry.bore
        0.09
        """
        named = {**(changes or {}), **more}
        refuse((not named, "name something to change"))
        engine: Engine = engine_maker(self, list(named))(
            [as_scalar(each) for each in named.values()]
        )
        return engine

    @property
    def is_in_line(self) -> bool:
        """Whether all cylinders stand in one row, each on its own throw."""
        return self.arrangement == in_row(self.cylinders)

    @property
    def cylinders(self) -> int:
        """Number of cylinders i."""
        return len(self.firing_offsets)

    @property
    def period(self) -> float:
        """Length of the working cycle [rad]: 4π or 2π."""
        return self.strokes * math.pi

    @property
    def speed_rpm(self) -> float:
        """Rotational speed n [min⁻¹]."""
        return self.omega * 30 / math.pi


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.10g}°"


def implausible(engine: Engine) -> Iterator[str]:
    """Implausible sizes, a line each with the unit that may be mistaken."""
    size, gas = engine.geometry, engine.gas
    peak = max(gas.pressures) if isinstance(gas, TabulatedGas) else gas.p_max
    speed = size.stroke * engine.speed_rpm / 30
    tests = [
        ("stroke over bore", "", size.stroke / size.bore, _STROKE_BORE, "millimetres"),
        ("mean piston speed", " m/s", speed, _PISTON_SPEED, "millimetres and min⁻¹"),
        ("highest pressure", " MPa", peak / UNITS["MPa"].si, _PEAK_PRESSURE, "MPa, absolute"),
    ]
    if isinstance(engine.masses, DirectMasses):
        mass = engine.masses.reciprocating / size.piston_area
        label = "reciprocating mass over the piston's area"
        tests.append((label, " kg/m²", mass, _RECIPROCATING, "kilograms and millimetres"))
    for quantity, unit, value, (low, high), units in tests:
        if not low <= value <= high:
            yield f"{quantity} is {value:.3g}{unit}, usually {low:g} … {high:g}: are they {units}?"
    last = max(engine.firing_offsets)
    # A cycle is 4π: taken for degrees it is still less than any real offset.
    if 0 < math.degrees(last) <= 4 * math.pi:
        yield f"all cylinders fire within {math.degrees(last):.3g}°: are the offsets degrees?"
        return
    offsets = [round(math.degrees(offset), 6) for offset in engine.firing_offsets]
    for number, offset in enumerate(offsets, 1):
        first = offsets.index(offset) + 1
        if first < number and engine.strokes == 4:
            yield (
                f"cylinder {number} fires with cylinder {first} at {offset:g}°, usually they fire "
                "in turn: check the firing order"
            )
    gap, mean = firing_gap(offsets, math.degrees(engine.period))
    if gap > MAX_GAP * mean:
        yield (
            f"the firings do not fill the cycle: the widest gap is {gap:g}°, the mean {mean:g}°: "
            "check the firing offsets"
        )
