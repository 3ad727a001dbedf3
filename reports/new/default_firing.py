"""Firing orders and crank angles of usual engines of 1 to 12 cylinders, by layout and strokes.

Cylinders are numbered as in Gots 2.7.2: a bank from the nose, then the other one.  Orders
are those of engines of the kind in use; where there are several, one of them.
"""

from __future__ import annotations

from dataclasses import dataclass

from reports.inputs.firing import arrangement, sequence, throw_angles
from reports.shared.errors import InputError, Problem

MOST = 12
_IN_LINE = {
    4: (
        "1", "1-2", "1-2-3", "1-3-4-2", "1-2-4-5-3", "1-5-3-6-2-4", "1-3-5-7-6-4-2",
        "1-6-2-5-8-3-7-4", "1-3-5-7-9-8-6-4-2", "1-6-2-8-4-10-5-9-3-7",
        "1-3-5-7-9-11-10-8-6-4-2", "1-11-3-7-5-9-12-2-10-6-8-4",
    ),
    2: (
        "1", "1-2", "1-3-2", "1-3-4-2", "1-4-3-2-5", "1-5-3-6-2-4", "1-7-2-5-4-3-6",
        "1-8-2-6-4-5-3-7", "1-6-7-3-5-8-2-4-9", "1-8-5-7-2-9-4-6-3-10",
        "1-6-8-4-10-2-9-5-7-3-11", "1-8-12-4-2-9-10-5-3-7-11-6",
    ),
}  # fmt: skip
# Boxers: throws of a pair stand opposite, so it fires half a cycle apart (four strokes).
_OPPOSED = {
    2: "1-2", 4: "1-4-3-2", 6: "1-6-2-4-3-5", 8: "1-7-4-6-5-3-8-2", 10: "1-10-2-8-4-6-5-7-3-9",
    12: "1-11-3-12-2-10-7-5-9-6-8-4",
}  # fmt: skip
_Bank = tuple[float, str | tuple[float, ...]]
# Bank angle, and the order where firing is even, else the offsets that the shaft allows.
_V: dict[int, dict[int, _Bank]] = {
    4: {
        2: (90, (0, 450)),
        4: (90, (0, 180, 450, 630)),
        6: (90, (0, 240, 480, 90, 330, 570)),  # as the sample yamz-236
        8: (90, "1-5-4-2-6-3-7-8"),
        10: (72, "1-6-2-7-4-9-5-10-3-8"),
        12: (60, "1-7-5-11-3-9-6-12-2-8-4-10"),
    },
    2: {
        2: (90, (0, 90)),
        4: (90, "1-3-2-4"),
        6: (60, "1-4-3-6-2-5"),
        8: (45, "1-5-3-7-4-8-2-6"),
        10: (36, "1-6-4-9-3-8-2-7-5-10"),
        12: (30, "1-7-5-11-3-9-6-12-2-8-4-10"),
    },
}


@dataclass(frozen=True, slots=True)
class Phases:
    """Starts of power strokes and angles of throws [deg]; ``order`` where firing is even."""

    offsets: tuple[float, ...]
    angles: tuple[float, ...]
    order: str = ""
    bank_deg: float | None = None

    @property
    def sequence(self) -> str:
        """Cylinders in the order in which they fire."""
        return "-".join(map(str, sequence(self.offsets)))


def phases(cylinders: int, layout: str, strokes: int) -> Phases:
    """Usual phases of an engine.

    Raises:
        InputError: there is no engine of so many cylinders, or none that is known here.
    """
    _refuse(cylinders, layout)
    order, bank = "", None
    offsets: tuple[float, ...] = ()
    if layout == "inline":
        order = _IN_LINE[strokes][cylinders - 1]
    elif layout == "v":
        bank, table = _V[strokes][cylinders]
        order, offsets = (table, ()) if isinstance(table, str) else ("", table)
    elif strokes == 4:
        order = _OPPOSED[cylinders]
    else:  # both of a pair fire together
        half = _starts(_IN_LINE[2][cylinders // 2 - 1], 360)
        offsets = half + half
    placement = arrangement(layout, cylinders, bank)
    if placement is None:
        msg = "the layout was checked before"
        raise AssertionError(msg)
    offsets = offsets or _starts(order, 180 * strokes)
    return Phases(offsets, throw_angles(placement, offsets), order, bank)


def _starts(order: str, period: float) -> tuple[float, ...]:
    """Offsets [deg] of the cylinders that fire evenly in this order."""
    numbers = [int(part) for part in order.split("-")]
    step = period / len(numbers)
    return tuple(round(numbers.index(i) * step, 6) for i in range(1, len(numbers) + 1))


def _refuse(cylinders: int, layout: str) -> None:
    problem = hint = ""
    if not 1 <= cylinders <= MOST:
        problem, hint = f"число цилиндров {cylinders}", f"команда знает от 1 до {MOST}"
    elif layout != "inline" and cylinders % 2:
        words = "V-образного" if layout == "v" else "оппозитного"
        problem = f"число цилиндров {cylinders} нечётное, а рядов у {words} двигателя два"
        hint = "задайте чётное число или --layout inline"
    if problem:
        raise InputError(Problem("--cylinders", problem, hint))
