"""How far results on the grid of the tables stand from those of a step of one degree."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from kshm.arrays import Tables
from kshm.mechanics.wear import ray_sums
from kshm.nomenclature.digits import Digits
from kshm.nomenclature.quantity import Quantity, quantity
from kshm.results.solution import Solution
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solved import solved
from reports.inputs.to_si.engine import smallness_of
from reports.shared.errors import InputError
from reports.shared.russian import NBSP, fixed, written

_PIN = re.compile(r"шейк\w*")  # in a title, before its number
FINE = 1  # step that the others are held against [deg]
MOST = 2.0  # difference that is told [%]
_FINEST = 9  # decimals beyond which nothing is told apart
_TOLD = 4  # differences in the one line; the report has them all
# Extremes and integrals of a cycle, which depend on where the rows stand; the first matter most.
_KINDS = tuple(
    re.compile(kind)
    for kind in (
        "M_(mean|max|min)", "I_flywheel|delta_speed|W_range", "N_i_calc|p_i_area|W_cycle",
        "Rpin[_0-9]*_max(_kN)?|Rmain[0-9]+_max(_kN)?|B_max", "dM_(main|pin)[0-9]+",
        "hole_pin[0-9]*_deg", "Rpin[_0-9]*_mean|Rmain[0-9]+_mean|B_mean",
        "Rpin[_0-9]*_min|Rmain[0-9]+_min", "Malpha_(max|min|swing|mean)",
    )
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class GridError:
    """A result on the grid and with the fine step, in the quantity's unit.

    ``moved_deg`` is the angle of the fine step's extreme where it is another one [deg];
    ``first`` tells that it is of the first of several pins, whose names have no number.
    """

    key: str
    coarse: float
    fine: float
    small: int = 0
    moved_deg: float | None = None
    first: bool = False

    @property
    def quantity(self) -> Quantity:
        """What it is."""
        return quantity(self.key, self.small)

    @property
    def digits(self) -> Digits:
        """Those of the quantity; more where the two would be written alike."""
        digits = self.quantity.digits
        while digits.decimals < _FINEST and written(self.coarse, digits) == written(
            self.fine, digits
        ):
            zeros = digits.zeros
            digits = replace(
                digits, zeros=max(0, zeros - 1), decimals=digits.decimals + (not zeros)
            )
        return digits

    @property
    def title(self) -> str:
        """Its name, with the number of its pin behind the pin."""
        title = self.quantity.title
        return _PIN.sub(r"\g<0> 1", title, count=1) if self.first else title

    @property
    def percent(self) -> float:
        """Difference from the fine step's value [%]; infinite from nothing and between angles."""
        if self.fine == 0 or self.quantity.unit == "deg":
            return float(np.sign(self.coarse)) * np.inf
        return 100 * (self.coarse - self.fine) / abs(self.fine)


def grid_errors(model: InputFile) -> tuple[GridError, ...]:
    """What the step of the tables puts more than 2 % off, what matters most first.

    Both are found by the solver.  Nothing for a step of a degree or less, nor for an input
    that has no solution.
    """
    if model.calculation.step_deg <= FINE:
        return ()
    try:
        rough, exact = solved(model), solved(refined(model))
    except (ValueError, InputError):
        return ()
    coarse, fine = _results(rough.scalars), _results(exact.scalars)
    small = smallness_of(model)
    found = [
        GridError(
            key,
            value,
            fine[key],
            small,
            _moved(key, rough.scalars, exact.scalars),
            key.replace("pin_", "pin2_", 1) in coarse.keys() - {key},
        )
        for key, value in coarse.items()
        if (
            _is_pressed(key, rough, exact, model.calculation.wear_rays)
            if key.startswith("hole")
            else _is_off(value, fine[key], max(map(abs, _family(coarse, key))))
        )
    ]
    # Of alike pins and journals the first goes first.
    return tuple(sorted(found, key=lambda error: (_rank(error.key), -round(abs(error.percent), 1))))


def refined(model: InputFile) -> InputFile:
    """The same engine with tables at the fine step, less what has no angles or steps of its own.

    Its oil hole stays where the model's own tables put it: in another plane is another moment.
    """
    calculation = model.calculation.model_copy(update={"step_deg": FINE})
    hole = {"oil_hole_deg": solved(model).scalars.get("alpha_oil_deg")}
    crankshaft = model.crankshaft.model_copy(update=hole)
    other = {"torsion": None, "bearings": None}
    return model.model_copy(update={"calculation": calculation, "crankshaft": crankshaft, **other})


def fine_columns(model: InputFile) -> Tables:
    """Tables of the solver at the fine step, in their units; none where the grid is as fine."""
    if model.calculation.step_deg <= FINE:
        return {}
    # Orbits are the same on any grid; their curves are drawn through more points.
    return solved(refined(model).model_copy(update={"bearings": model.bearings})).columns


def _moved(key: str, coarse: Mapping[str, float], fine: Mapping[str, float]) -> float | None:
    angle = f"phi_{key.removesuffix('_kN')}_deg"
    return fine[angle] if angle in fine and fine[angle] != coarse[angle] else None


def _results(scalars: Mapping[str, float]) -> dict[str, float]:
    return {key: float(value) for key, value in scalars.items() if _rank(key) < len(_KINDS)}


def _rank(key: str) -> int:
    return next((n for n, kind in enumerate(_KINDS) if kind.fullmatch(key)), len(_KINDS))


def _family(results: Mapping[str, float], key: str) -> list[float]:
    """Values of the same kind: «Rmain3_min» beside «Rmain3_max»."""
    stem = re.sub(r"_(max|min|mean)$", "", key)
    return [value for other, value in results.items() if other.startswith(stem)]


def _is_off(coarse: float, fine: float, scale: float) -> bool:
    """Whether a difference is worth a word: over 2 %, and no rounding noise of zero."""
    apart = abs(coarse - fine)
    return bool(np.isfinite(apart)) and apart > max(MOST / 100 * abs(fine), 1e-6 * scale)


def _is_pressed(hole: str, coarse: Solution, fine: Solution, rays: int) -> bool:
    """Whether by the fine step another ray of the pin is less loaded than the grid's."""
    pin = hole.removesuffix("_deg")
    forces = fine.columns["crankpin" + pin.replace("hole_pin", "_").rstrip("_")]
    sums = ray_sums(-forces["Krod_MPa"], -forces["T_MPa"], forces["Rpin_MPa"], rays)
    taken = sums[round(coarse.scalars[f"{pin}_ray"]) - 1]
    return bool(taken - sums.min() > 1e-6 * sums.mean())


def grid_remark(model: InputFile) -> str:
    """The differences in one line; empty where there are none."""
    return remark_on(grid_errors(model), model)


def remark_on(errors: Sequence[GridError], model: InputFile) -> str:
    """The line for differences that are known already."""
    if not errors:
        return ""
    told = "; ".join(_said(error) for error in errors[:_TOLD])
    rest = len(errors) - _TOLD
    more = f"; ещё {rest} в отчёте" if rest > 0 else ""
    step = fixed(model.calculation.step_deg, 0)
    return (
        f"Шаг таблиц {step}° груб для части результатов, по решению с шагом 1° они другие: "
        f"{told}{more}; уменьшите calculation.step_deg, если нужна точность"
    )


def _said(error: GridError) -> str:
    q = error.quantity
    coarse, fine = (written(value, error.digits) for value in (error.coarse, error.fine))
    unit = q.unit_label if q.unit_label in ("", "°") else f"{NBSP}{q.unit_label}"
    return f"{error.title}: {coarse} вместо {fine}{unit}"
