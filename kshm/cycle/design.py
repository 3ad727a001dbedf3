"""Design mode: bore and stroke from the wanted power."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from kshm.cycle.cycle import Listing, cycle, thermodynamics
from kshm.cycle.dizdn_listing import POWER_FACTOR
from kshm.cycle.errors import CycleError
from kshm.cycle.figures import friction_pressure
from kshm.cycle.inputs import CycleInputs, check_range
from kshm.cycle.result import Cycle

Rounding = Literal["nearest", "up"]

# S enters p_e only through c_m^1·S^(−1/3): the passes contract by b c_m/(3 p_e)
STROKE_PASSES = 400


@dataclass(frozen=True, slots=True)
class Design:
    """Bore and stroke [m] as calculated and as rounded, and the cycle with the latter.

    ``power_error`` is (N_e − wanted)/wanted after rounding [-].
    """

    bore_exact: float
    stroke_exact: float
    bore: float
    stroke: float
    power: float
    cycle: Cycle
    power_error: float


def bore_for(displacement: float, stroke_bore: float) -> float:
    """Bore D = (4 V_h/(π S/D))^(1/3) [m]."""
    return math.cbrt(4 * displacement / (math.pi * stroke_bore))


def round_to_series(size: float, step: float, rounding: Rounding) -> float:
    """Size rounded to a multiple of ``step`` [m]."""
    # 1e-9: an exact multiple must not be lifted to the next one by the last bit
    count = math.ceil(size / step - 1e-9) if rounding == "up" else round(size / step)
    # Multiplying by 1/step gives the decimal number itself: 88/1000, not 88·0.001
    inverse = round(1 / step)
    return count / inverse if abs(inverse * step - 1) < 1e-9 else count * step


def exact_stroke(
    inputs: CycleInputs, p_i: float, power: float, stroke_bore: float, factor: float
) -> float:
    """Stroke [m] that gives the wanted power [W] before rounding.

    V_h = N_e/(factor·p_e n i) with factor = 1/(30 τ); when friction depends on the
    piston speed, S and p_e are found together by repeated substitution.

    Raises:
        CycleError: friction eats the indicated work at any size, or no convergence.
    """
    stroke, previous = 0.1, 0.0
    for _ in range(STROKE_PASSES):
        speed = stroke * inputs.omega / math.pi
        p_e = p_i - friction_pressure(inputs.mechanical, p_i, speed)
        if not p_e > 0:
            raise CycleError("friction_eats_all_sizes", "mechanical", speed=speed)
        swept = power / (factor * p_e * inputs.speed_rpm * inputs.cylinders)
        previous, stroke = stroke, stroke_bore * bore_for(swept, stroke_bore)
        if abs(stroke - previous) <= 1e-13 * stroke:
            return stroke
    raise CycleError("stroke_not_found", "power")


def design(
    inputs: CycleInputs,
    power: float,
    stroke_bore: float,
    *,
    step: float = 0.001,
    rounding: Rounding = "nearest",
    bore_range: tuple[float, float] = (0.04, 0.40),
    listing: Listing | None = None,
) -> Design:
    """Find bore and stroke for the wanted effective power and recalculate.

    Args:
        inputs: the engine; its bore and stroke are ignored.
        power: wanted N_e [W].
        stroke_bore: S/D.
        step: step of the series of bores and strokes [m].
        rounding: to the nearest size or upwards.
        bore_range: allowed bores [m].
        listing: listing mode, as in `kshm.cycle.cycle`.

    Returns:
        Sizes before and after rounding and the cycle of the rounded engine.

    Raises:
        CycleError: no bore in the range gives this power, or no cycle follows.
    """
    for field, value in (("power", power), ("stroke_bore", stroke_bore), ("step", step)):
        check_range(field, value)
    if listing is None:
        p_i, factor = thermodynamics(inputs).indicated.p_i, 1 / (30 * inputs.strokes)
    else:
        # The indicated pressure does not depend on the size: any size will do
        trial = replace(inputs, bore=0.1, stroke=0.1 * stroke_bore)
        p_i, factor = cycle(trial, listing).indicated.p_i, POWER_FACTOR
    stroke = exact_stroke(inputs, p_i, power, stroke_bore, factor)
    bore = stroke / stroke_bore
    if not bore_range[0] <= bore <= bore_range[1]:
        key = "bore_too_small" if bore < bore_range[0] else "bore_too_large"
        low, high = bore_range
        raise CycleError(key, "power", power=power, bore=bore, low=low, high=high)
    sizes = [round_to_series(size, step, rounding) for size in (bore, stroke)]
    result = cycle(replace(inputs, bore=sizes[0], stroke=sizes[1]), listing)
    error = result.effective.power_e / power - 1
    return Design(bore, stroke, sizes[0], sizes[1], power, result, error)
