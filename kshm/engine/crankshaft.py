"""The crankshaft: throws with webs and counterweights, end masses, sizes of the journals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

from kshm.engine.checks import NOT_NEGATIVE, POSITIVE, check_numbers, refuse

if TYPE_CHECKING:
    from kshm.arrays import Array

Size = TypeVar("Size", "float", "Array")


@dataclass(frozen=True, slots=True)
class Places(Generic[Size]):
    """Places along a throw from its left support [m], Gots figures 35 and 36.

    Numbers for one throw or arrays of one shape for many.
    """

    left_web: Size
    rod: Size  # the rod nearest to the nose
    pin: Size
    last_rod: Size  # the rod farthest from the nose
    right_web: Size
    length: Size  # the right support

    def rod_at(self, share: float) -> Size:
        """Place of a rod between the first on the pin (0) and the last (1)."""
        return self.rod + share * (self.last_rod - self.rod)


def places(arms: Sequence[Size], left_web: Size, right_web: Size) -> Places[Size]:
    """Places of webs, rods, pin and right support along a throw [m], Gots figures 35 and 36.

    Args:
        arms: l_1 … l_6 [m].
        left_web: thickness of the left web [m], zero where the arms reach its middle.
        right_web: thickness of the right web [m].
    """
    l1, l2, l3, l4, l5, l6 = arms
    rod = l1 + left_web + l2
    right = rod + l3 + l4 + l5
    return Places(
        left_web=l1 + left_web / 2,
        rod=rod,
        pin=rod + l3,
        last_rod=rod + l3 + l4,
        right_web=right + right_web / 2,
        length=right + right_web + l6,
    )


@dataclass(frozen=True, slots=True)
class Web:
    """One crank web with its counterweight; masses reduced to the crank radius [kg].

    ``angle`` [rad] is measured from the crank direction against rotation,
    ``counterweight_angle`` from the direction opposite the crank in the
    direction of rotation (the reading of Gots (45), (47) that statics gives).
    """

    mass: float
    angle: float = 0.0
    counterweight_mass: float = 0.0
    counterweight_angle: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what no web can be."""
        check_numbers(self, NOT_NEGATIVE, "mass", "counterweight_mass")


@dataclass(frozen=True, slots=True)
class Throw:
    """One throw of the crankshaft with the chain of arms of Gots figure 35 [m].

    ``angle`` is γ_i [rad], clockwise from crank 1 seen from the nose.
    """

    angle: float
    arms: tuple[float, float, float, float, float, float]
    left_web: Web
    right_web: Web
    pin_mass: float
    left_web_thickness: float = 0.0
    right_web_thickness: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what no throw can be."""
        thick = ("left_web_thickness", "right_web_thickness")
        check_numbers(self, NOT_NEGATIVE, "arms", "pin_mass", *thick)
        refuse((self.length <= 0, "a throw needs arms that are not all zero"))

    @property
    def places(self) -> Places[float]:
        """Places of webs, rods and pin along the throw [m]."""
        return places(self.arms, self.left_web_thickness, self.right_web_thickness)

    @property
    def length(self) -> float:
        """Distance between the middles of the two main journals l [m]."""
        return self.places.length


@dataclass(frozen=True, slots=True)
class EndMass:
    """External counterweight beyond an end journal: mass reduced to r [kg], arm [m].

    ``angle`` [rad] is measured from the neighbouring crank: at the nose in the
    direction of rotation, at the rear against it.
    """

    mass: float = 0.0
    angle: float = 0.0
    arm: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what no mass can be."""
        check_numbers(self, NOT_NEGATIVE, "mass")


@dataclass(frozen=True, slots=True)
class Crankshaft:
    """Crankshaft: throws from the nose, end masses, sizes of every journal [m].

    Every throw has a pin, and there is a main journal more than throws.  ``pin_lengths`` are
    working lengths under all the rods that a pin carries side by side; of a split pin that of
    each part.
    """

    throws: tuple[Throw, ...]
    nose: EndMass
    rear: EndMass
    pin_diameters: tuple[float, ...]
    pin_lengths: tuple[float, ...]
    main_diameters: tuple[float, ...]
    main_lengths: tuple[float, ...]

    def __post_init__(self) -> None:
        """Refuse sizes that are none or of the wrong number."""
        sizes = ("pin_diameters", "pin_lengths", "main_diameters", "main_lengths")
        check_numbers(self, POSITIVE, *sizes)
        throws = len(self.throws)
        for name in sizes:
            count, required = len(getattr(self, name)), throws + name.startswith("main")
            kind = "main journal more" if name.startswith("main") else "crankpin each"
            text = f"{throws} throws need a {kind}, not {count}: {name}"
            refuse((count != required, text))
