"""Random valid engines."""

from __future__ import annotations

import math

from hypothesis import strategies as st

from kshm.engine.arrangement import (
    Arrangement,
    ArticulatedRod,
    fan,
    hung,
    in_row,
    opposed,
    throw_angle,
)
from kshm.engine.crankshaft import Crankshaft, EndMass, Throw, Web
from kshm.engine.engine import Engine, Geometry
from kshm.engine.gas import PolytropicGas
from kshm.engine.masses import DirectMasses, RodMasses


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_infinity=False)


@st.composite
def webs(draw: st.DrawFn) -> Web:
    turn = numbers(-math.pi, math.pi)
    return Web(draw(numbers(0, 5)), draw(turn), draw(numbers(0, 5)), draw(turn))


@st.composite
def throws(draw: st.DrawFn, angle: float, *, rods: int = 1) -> Throw:
    arm = numbers(0.005, 0.2)
    between = numbers(0.005, 0.1) if rods == 2 else st.just(0.0)
    arms = (draw(arm), draw(arm), draw(between), draw(between), draw(arm), draw(arm))
    thickness = numbers(0, 0.05)
    return Throw(angle, arms, draw(webs()), draw(webs()), draw(numbers(0.05, 5)),
                 draw(thickness), draw(thickness))  # fmt: skip


LAYOUTS = ("inline", "v", "split", "articulated", "opposed")


@st.composite
def phased(draw: st.DrawFn, layout: str, strokes: int) -> tuple[Arrangement, list[float]]:
    """Places of the cylinders and firing offsets [deg] that fit one shaft."""
    period = 180 * strokes
    turns = strokes // 2
    if layout == "inline":
        count = draw(st.integers(1, 6))
        rest = draw(st.permutations([period / count * i for i in range(1, count)]))
        return in_row(count), [0.0, *rest]
    pairs = draw(st.integers(1, 3))
    # Any firing offset of whole degrees fits an own throw; the right bank's follows.
    left = [0.0, *(float(draw(st.integers(0, period - 1))) for _ in range(pairs - 1))]
    if layout == "opposed":
        places = opposed(2 * pairs)
        return places, left + [float(draw(st.integers(0, period - 1))) for _ in range(pairs)]
    bank = math.radians(draw(st.integers(0, 180)))
    split = (0.0, math.radians(draw(st.integers(-40, 40)))) if layout == "split" else None
    places = fan(pairs, (0.0, bank), pin_angles=split, articulated=layout == "articulated")
    right = []
    for offset, position in zip(left, places[pairs:], strict=True):
        behind = math.degrees(position.axis - position.pin_angle) + 360 * draw(
            st.integers(0, turns - 1)
        )
        right.append((offset + behind) % period)
    return places, left + right


@st.composite
def articulated_rods(draw: st.DrawFn, radius: float, lam: float, bank: float) -> ArticulatedRod:
    length = radius / lam
    share = draw(numbers(0, 0.3))
    return ArticulatedRod(
        rod_length=length * (1.2 - share),
        radius=length * share,
        angle=bank + math.radians(draw(numbers(-10, 10))),
        reciprocating=draw(numbers(0.1, 10)),
        big_end=draw(numbers(0, 5)),
    )


@st.composite
def gases(draw: st.DrawFn, eps: float, strokes: int) -> PolytropicGas:
    p_intake = draw(numbers(0.05e6, 0.4e6))
    n_1 = draw(numbers(1.2, 1.45))
    end = p_intake * eps**n_1
    before, after, later = (draw(st.integers(*ends)) for ends in ((10, 70), (5, 60), (3, 9)))
    bdc = 540 if strokes == 4 else 180
    return PolytropicGas(
        p_ambient=0.1e6,
        p_intake=p_intake,
        p_residual=draw(numbers(0.06e6, 0.3e6)),
        p_max=end * draw(numbers(1.05, 3)),
        n_compression=n_1,
        n_expansion=draw(numbers(1.15, 1.4)),
        rho=draw(numbers(1, 2)),
        combustion_start=math.radians(draw(st.integers(335, 359))),
        ignition_advance=math.radians(25),
        exhaust_open=math.radians(bdc - before),
        exhaust_close=math.radians(bdc + after),
        scavenge_open=math.radians(bdc - before + later) if strokes == 2 else 0.0,
    )


@st.composite
def engines(
    draw: st.DrawFn,
    *,
    method: str | None = None,
    step_deg: int = 5,
    layouts: tuple[str, ...] = LAYOUTS,
    strokes: int | None = None,
    offset: bool | None = None,
) -> Engine:
    """An engine of any layout, with or without an offset, phases in any order.

    Args:
        draw: given by hypothesis.
        method: the one to take; any if left out.
        step_deg: grid.
        layouts: those to choose from.
        strokes: 2 or 4; any if left out.
        offset: with or without; any if left out.
    """
    radius = draw(numbers(0.02, 0.2))
    lam = draw(numbers(0.16, 0.36))
    eps = draw(numbers(7, 22))
    strokes = strokes or draw(st.sampled_from([4, 4, 2]))
    layout = draw(st.sampled_from(layouts))
    places, offsets = draw(phased(layout, strokes))
    gas = draw(gases(eps, strokes))
    if draw(st.booleans()):
        masses = DirectMasses(draw(numbers(0.1, 20)), draw(numbers(0.1, 20)))
    else:
        length = radius / lam
        masses = RodMasses(
            draw(numbers(0.1, 10)), draw(numbers(0.2, 12)), length * draw(numbers(0.6, 0.85))
        )
    end_masses = st.builds(EndMass, numbers(0, 3), numbers(-math.pi, math.pi), numbers(0, 0.3))
    count = 1 + max(position.throw for position in places)
    rods = 2 if layout in ("v", "split") else 1
    shaft_throws = []
    for throw in range(count):
        first = next(i for i, index in enumerate(places) if index.throw == throw)
        angle = throw_angle(places[first], math.radians(offsets[first]))
        shaft_throws.append(draw(throws(angle, rods=rods)))
    shaft = Crankshaft(
        throws=tuple(shaft_throws),
        nose=draw(end_masses),
        rear=draw(end_masses),
        pin_diameters=(0.06,) * count,
        pin_lengths=(0.03,) * count,
        main_diameters=(0.07,) * (count + 1),
        main_lengths=(0.03,) * (count + 1),
    )
    shifted = draw(st.booleans()) if offset is None else offset
    crank_offset = radius * draw(numbers(-0.3, 0.3)) if shifted else None
    pin_offset = radius * draw(numbers(-0.05, 0.05)) if shifted else None
    rods = ()
    if layout == "articulated":
        rods = (draw(articulated_rods(radius, lam, places[-1].axis)),) * len(hung(places))
    return Engine(
        geometry=Geometry(
            draw(numbers(0.05, 0.3)), radius, radius / lam, eps, crank_offset, pin_offset
        ),
        omega=draw(numbers(20, 900)),
        gas=gas,
        masses=masses,
        crankshaft=shaft,
        firing_offsets=tuple(math.radians(offset) for offset in offsets),
        strokes=strokes,
        method=method or draw(st.sampled_from(["textbook", "exact"])),
        step_deg=step_deg,
        rays=draw(st.sampled_from([12, 18])),
        arrangement=places,
        articulated=rods,
    )


def basic_engines(**choices: object) -> st.SearchStrategy[Engine]:
    """Four-stroke in-line engines with a central mechanism: what the companions are made for."""
    return engines(layouts=("inline",), strokes=4, offset=False, **choices)
