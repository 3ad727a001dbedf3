"""Random valid engines."""

from __future__ import annotations

import math

from hypothesis import strategies as st

from kshm.engine import (
    Crankshaft,
    DirectMasses,
    EndMass,
    Engine,
    Geometry,
    PolytropicGas,
    RodMasses,
    Throw,
    Web,
)


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_infinity=False)


@st.composite
def webs(draw: st.DrawFn) -> Web:
    turn = numbers(-math.pi, math.pi)
    return Web(draw(numbers(0, 5)), draw(turn), draw(numbers(0, 5)), draw(turn))


@st.composite
def throws(draw: st.DrawFn, angle: float) -> Throw:
    arm = numbers(0.005, 0.2)
    arms = (draw(arm), draw(arm), 0.0, 0.0, draw(arm), draw(arm))
    thickness = numbers(0, 0.05)
    return Throw(angle, arms, draw(webs()), draw(webs()), draw(numbers(0.05, 5)),
                 draw(thickness), draw(thickness))  # fmt: skip


@st.composite
def engines(draw: st.DrawFn, *, method: str | None = None, step_deg: int = 5) -> Engine:
    """A four-stroke in-line engine with one to six cylinders, phases in any order."""
    radius = draw(numbers(0.02, 0.2))
    lam = draw(numbers(0.16, 0.44))
    eps = draw(numbers(7, 22))
    p_intake = draw(numbers(0.05e6, 0.4e6))
    n_1 = draw(numbers(1.2, 1.45))
    end = p_intake * eps**n_1
    count = draw(st.integers(1, 6))
    offsets = [0.0, *draw(st.permutations([720 / count * i for i in range(1, count)]))]
    gas = PolytropicGas(
        p_ambient=0.1e6,
        p_intake=p_intake,
        p_residual=draw(numbers(0.06e6, 0.3e6)),
        p_max=end * draw(numbers(1.05, 3)),
        n_compression=n_1,
        n_expansion=draw(numbers(1.15, 1.4)),
        rho=draw(numbers(1, 2)),
        combustion_start=math.radians(draw(st.integers(335, 359))),
        ignition_advance=math.radians(25),
        exhaust_open=math.radians(draw(st.integers(470, 530))),
        exhaust_close=math.radians(draw(st.integers(545, 600))),
    )
    if draw(st.booleans()):
        masses = DirectMasses(draw(numbers(0.1, 20)), draw(numbers(0.1, 20)))
    else:
        length = radius / lam
        masses = RodMasses(
            draw(numbers(0.1, 10)), draw(numbers(0.2, 12)), length * draw(numbers(0.6, 0.85))
        )
    end_masses = st.builds(EndMass, numbers(0, 3), numbers(-math.pi, math.pi), numbers(0, 0.3))
    shaft = Crankshaft(
        throws=tuple(draw(throws(math.radians(-offset % 360))) for offset in offsets),
        nose=draw(end_masses),
        rear=draw(end_masses),
        pin_diameter=0.06,
        pin_length=0.03,
        main_diameter=0.07,
        main_lengths=(0.03,) * (count + 1),
    )
    return Engine(
        geometry=Geometry(draw(numbers(0.05, 0.3)), radius, radius / lam, eps),
        omega=draw(numbers(20, 900)),
        gas=gas,
        masses=masses,
        crankshaft=shaft,
        firing_offsets=tuple(math.radians(offset) for offset in offsets),
        method=method or draw(st.sampled_from(["textbook", "exact"])),
        step_deg=step_deg,
        rays=draw(st.sampled_from([12, 18])),
    )
