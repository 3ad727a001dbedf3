"""Members of the torsional train that the book of the torsional vibration goes through."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from kshm.defaults import (
    DAMPING_SHARE,
    FLYWHEEL_SHARE,
    LAST_ORDER,
    OTHER_FLYWHEEL,
    PULLEY_SHARE,
    RAYS,
    RING_SHARE,
    SPEED_RANGE,
    SPEEDS,
    STARS,
)
from reports.inputs.sections.torsion import FORMULAS, TorsionSection
from reports.model.shape import Scope

Kind = Literal["given", "pulley", "throw", "flywheel", "driven"]
_MODES = 3


@dataclass(frozen=True, slots=True)
class TorsionMass:
    """A mass of the train: what it is, its throw from 1 or 0, journals of the shaft behind.

    ``main`` is the diameter [mm] of its main journal or of the shaft given, ``throws`` those whose
    crankpins it has.
    """

    label: str
    kind: Kind
    throw: int
    main: str
    throws: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class TrainMasses:
    """Masses of a train from the nose; ``own`` says that they are given one by one."""

    masses: tuple[TorsionMass, ...]
    is_free: bool
    own: bool

    @property
    def count(self) -> int:
        """Number of masses."""
        return len(self.masses)

    @property
    def modes(self) -> range:
        """Numbers of the frequencies that the sheets find, from 1."""
        return range(1, min(_MODES, self.count - self.is_free) + 1)

    def mass_of(self, throw: int) -> int:
        """Return the number of the mass with a throw, from 1; 0 where there is none."""
        throws = [mass.throw for mass in self.masses]
        return throws.index(throw) + 1 if throw in throws else 0

    @property
    def bisections(self) -> tuple[tuple[str, str, str, str, int], ...]:
        """Tables that halve: id, number, title, variant of the train, number of the mode."""
        rows = [
            (f"torsion_f{m}", f"К.{m}", f"Частота {m}: деление отрезка пополам", "", m)
            for m in self.modes
        ]
        other = "Первая частота с другим маховиком"
        rows.append(("torsion_f1_other", "К.м", other, "other", 1))
        if not self.own:
            rows += [
                (f"torsion_f1_{key}", "К.ж", f"Первая частота при жёсткости: {name}", key, 1)
                for key, name in FORMULAS.items()
            ]
        return tuple(rows)


def torsion_names(scope: Scope) -> dict[str, object]:
    """Return the train, orders to draw, estimates where the file gives nothing."""
    section = scope.input.torsion
    if section is None:
        return {}
    least, most = SPEED_RANGE
    return {
        "train": _given(section, scope) if section.masses else _equivalent(section, scope),
        "main_orders": main_orders(scope.shape.cylinders, scope.shape.strokes),
        "ray_of": ray_of,
        "damping": DAMPING_SHARE,
        "flywheel_throws": FLYWHEEL_SHARE,
        "pulley_share": PULLEY_SHARE,
        "ring_share": RING_SHARE,
        "other_flywheel": OTHER_FLYWHEEL,
        "least_speed": least,
        "most_speed": most,
        "last_order": LAST_ORDER,
        "rays": RAYS,
        "speeds": SPEEDS,
        "stars": STARS,
    }


def _given(section: TorsionSection, scope: Scope) -> TrainMasses:
    """The train of the input; without a diameter the mean main journal and the pins at its ends."""
    alike = scope.input.crankshaft.main_diameters_mm is None
    journals = [f"main_diameter_{k}_mm" for k in ([1] if alike else scope.shape.journal_numbers)]
    mean = f"total({', '.join(journals)})/{len(journals)}"
    count = len(section.masses)
    shafts = [
        (mean, _pins(int(mass.throw), int(behind.throw)))
        if mass.diameter_mm is None
        else (f"torsion_mass_{k}_diameter_mm", ())
        for k, (mass, behind) in enumerate(pairwise(section.masses), 1)
    ]
    masses = (
        TorsionMass(
            mass.name or f"масса {k}", "given", int(mass.throw), *shafts[min(k, count - 1) - 1]
        )
        for k, mass in enumerate(section.masses, 1)
    )
    free = section.ground_nm_rad == 0 and section.masses[-1].stiffness_nm_rad == 0
    return TrainMasses(tuple(masses), free, own=True)


def _pins(*throws: int) -> tuple[int, ...]:
    """Throws whose crankpins stand at the ends of a shaft; 0 is none."""
    return tuple(throw for throw in throws if throw)


def _equivalent(section: TorsionSection, scope: Scope) -> TrainMasses:
    """Pulley, throws, flywheel and what is driven behind it."""
    last = scope.shape.throws
    rear = f"main_diameter_{last + 1}_mm"
    masses = [
        TorsionMass("шкив", "pulley", 0, "main_diameter_1_mm", (1,)),
        *(
            TorsionMass(
                f"колено {k}", "throw", k,
                f"main_diameter_{k + 1}_mm", _pins(k, k + 1 if k < last else 0),
            )
            for k in scope.shape.throw_numbers
        ),
        TorsionMass("маховик", "flywheel", 0, rear),
    ]  # fmt: skip
    if section.driven_kg_m2 is not None:
        masses.append(TorsionMass("за маховиком", "driven", 0, rear))
    return TrainMasses(tuple(masses), section.ground_nm_rad == 0, own=False)


def ray_of(order: float) -> str:
    """Column of the Campbell diagram with the frequency of an order."""
    return f"tor_{'half' if order % 1 else 'ray'}{int(order)}_hz"


def main_orders(cylinders: int, strokes: int) -> list[float]:
    """Orders to draw: those at which the cylinders of a common engine add up."""
    fired = 2 * cylinders / strokes  # in a turn
    step = fired if fired > 1 else 2.0
    if step >= 6 and step % 2 == 0:
        step /= 2
    return [k * step for k in range(1, int(RAYS / step) + 1)] or [float(RAYS)]
