"""Solution of an input, and the checks that need one: power, grid of the tables, flywheel.

What the solver refuses is said in the words of the input.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from kshm.arrays import Array, Tables
from kshm.defaults import FINE_STEP
from kshm.errors import FilmError
from kshm.mechanics.wear import ray_sums
from kshm.nomenclature.digits import Digits
from kshm.nomenclature.quantity import Quantity, quantity
from kshm.results.regimes import regime_key
from kshm.results.solution import Solution, solve
from reports.inputs.messages import meta_at
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.report import ReportSection, WorkbookSection
from reports.inputs.to_si.engine import engine_and_cycle, smallness_of
from reports.inputs.units import number_text
from reports.shared.errors import InputError, Problem
from reports.shared.russian import NBSP, fixed, written
from reports.shared.standing import Notice, Severity

_STEP = ("calculation", "step_deg")
# Sections that change no number.
_PRINTED = {"report": ReportSection(), "sheet": None, "workbook": WorkbookSection()}
_MEND_FILM = "проверьте зазоры, вязкость и температуру масла, ширину"
_MEND_KW = "задайте размеры вместе с мощностью (kshm new --power --bore …) или исправьте давления"
POWER = "power"  # the check of it
MAX_POWER_ERROR = 2.0  # difference that is told, here and by the workbook [%]
_PIN = re.compile(r"шейк\w*")  # in a title, before its number
MAX_GRID_ERROR = 2.0  # difference that is told [%]
_FINEST = 9  # decimals beyond which nothing is told apart
# Extremes and integrals of a cycle, which depend on where the rows stand; the first matter most.
_KINDS = tuple(
    re.compile(kind)
    for kind in (
        "M_(mean|max|min)", "delta_speed|W_range", "N_i_calc|p_i_area|W_cycle",
        "Rpin[_0-9]*_max(_kN)?|Rmain[0-9]+_max(_kN)?|B_max", "dM_(main|pin)[0-9]+",
        "hole_pin[0-9]*_deg", "Rpin[_0-9]*_mean|Rmain[0-9]+_mean|B_mean",
        "Rpin[_0-9]*_min|Rmain[0-9]+_min", "Malpha_(max|min|swing|mean)",
    )
)  # fmt: skip
_USED = re.compile(r"M_(mean|max)|N_i_calc|(Rpin[_0-9]*|Rmain\d+)_max")  # told in the console
INERTIAS = "torsion_forms", "tor_J_kgm2"  # of the train's masses: pulley, throws, flywheel
_MAX_INERTIA = 1000.0  # times all throws; of one cylinder some hundreds, from memory


def solved(model: InputFile, source: str = "") -> Solution:
    """Solution of an input; `source` names its file in messages.

    Raises:
        InputError: the oil film of a bearing does not carry its load.
    """
    try:
        return _solution(model.model_copy(update=_PRINTED))
    except FilmError as error:
        where = ": ".join(part for part in (source, "bearings") if part)
        raise InputError(Problem(where, film_lost(error), _MEND_FILM)) from None


@lru_cache(maxsize=16)  # the doors, the sheets and the report ask for the same and for finer steps
def _solution(model: InputFile) -> Solution:
    solution = solve(*engine_and_cycle(model))
    if model.bearings is not None:
        _ = solution.columns  # results wait until they are asked for; orbits may refuse
    return solution


def film_lost(error: FilmError) -> str:
    """Message about the bearing whose oil film collapses."""
    name = f"коренного подшипника {error.bearing}" if error.bearing else "шатунного подшипника"
    return f"масляная плёнка {name} не несёт нагрузки: зазор за цикл исчезает"


def power_problems(model: InputFile) -> tuple[Problem, ...]:
    """Problems of regimes whose stated power contradicts their diagram, on any grid."""
    regimes = (model.regime, *model.regimes)
    if all(regime.indicated_power_kw is None for regime in regimes):
        return ()
    try:
        scalars = solved(model).scalars
    except ValueError:
        return ()
    accepted = {entry.what for entry in model.checks.accepted} if model.checks else set()
    problems = []
    for number, regime in enumerate(regimes, 1):
        stated = regime.indicated_power_kw
        error, check = "T_error", POWER
        if number > 1:
            error, check = (regime_key(key, number) for key in (error, check))
        percent = float(scalars.get(error, 0.0))
        if stated is None or abs(percent) <= MAX_POWER_ERROR or check in accepted:
            continue
        if _is_of_the_step(model, error):  # of that grid_errors tells
            continue
        where = "regime" if number == 1 else f"regimes[{number - 1}]"
        problem = _told(float(stated), percent, float(regime.mechanical_efficiency))
        problems.append(Problem(f"{where}.indicated_power_kw", problem, _MEND_KW))
    return tuple(problems)


def _is_of_the_step(model: InputFile, error: str) -> bool:
    """Whether a difference of the power goes away with the fine step."""
    try:
        exact = solved(refined(model)).scalars
    except ValueError:
        return False
    return abs(float(exact.get(error, 0.0))) <= MAX_POWER_ERROR


def _told(stated: float, percent: float, efficiency: float) -> str:
    power = stated * (1 + percent / 100)
    sign = "+" if percent > 0 else "−"
    return (
        f"задано N_i = {_kw(stated)} (эффективная {_kw(stated * efficiency)}), а диаграмма с этими "
        f"размерами даёт {_kw(power)} ({_kw(power * efficiency)}), "
        f"{sign}{fixed(abs(percent), 1)}{NBSP}%"
    )


def _kw(value: float) -> str:
    return f"{number_text(float(f'{value:.4g}'))}{NBSP}кВт"


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
        """Quantity of the result."""
        return quantity(self.key, self.small)

    @property
    def digits(self) -> Digits:
        """Digits of the quantity; more where both values would be written alike."""
        digits = self.quantity.digits
        while digits.decimals < _FINEST and written(self.coarse, digits) == written(
            self.fine, digits
        ):
            digits = replace(digits, decimals=digits.decimals + 1)
        return digits

    @property
    def title(self) -> str:
        """Title, with the number of the pin."""
        title = self.quantity.title
        return _PIN.sub(r"\g<0> 1", title, count=1) if self.first else title

    @property
    def percent(self) -> float:
        """Difference from the fine step's value [%]; infinite from nothing and between angles."""
        if self.fine == 0 or self.quantity.unit == "deg":
            return float(np.sign(self.coarse)) * np.inf
        return 100 * (self.coarse - self.fine) / abs(self.fine)


def grid_errors(model: InputFile) -> tuple[GridError, ...]:
    """Errors of the table step above 2 %, the most important first.

    Both are found by the solver.  Nothing for a step of a degree or less, nor for an input
    that has no solution.
    """
    if model.calculation.step_deg <= FINE_STEP:
        return ()
    try:
        rough, exact = solved(model), solved(refined(model))
    except ValueError:
        return ()
    coarse, fine = _results(rough.scalars), _results(exact.scalars)
    small = smallness_of(model)
    errors = [
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
    return tuple(sorted(errors, key=lambda e: (_rank(e.key), -round(abs(e.percent), 1))))


def refined(model: InputFile) -> InputFile:
    """Return the engine with tables at the fine step, without parts that have steps of their own.

    Its oil hole stays where the model's own tables put it: in another plane is another moment.
    """
    calculation = model.calculation.model_copy(update={"step_deg": FINE_STEP})
    hole = {"oil_hole_deg": solved(model).scalars.get("alpha_oil_deg")}
    crankshaft = model.crankshaft.model_copy(update=hole)
    other = dict.fromkeys(("torsion", "bearings", "strength", "counterweight", "flywheel"))
    return model.model_copy(update={"calculation": calculation, "crankshaft": crankshaft, **other})


def fine_columns(model: InputFile) -> Tables:
    """Tables of the solver at the fine step, in their units; none where the grid is as fine."""
    if model.calculation.step_deg <= FINE_STEP:
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
    """Whether a difference exceeds 2 % and the rounding noise."""
    gap = abs(coarse - fine)
    return bool(np.isfinite(gap)) and gap > max(MAX_GRID_ERROR / 100 * abs(fine), 1e-6 * scale)


def _is_pressed(hole: str, coarse: Solution, fine: Solution, rays: int) -> bool:
    """Whether the fine step picks another least loaded ray of the pin."""
    pin = hole.removesuffix("_deg")
    forces = fine.columns["crankpin" + pin.replace("hole_pin", "_").rstrip("_")]
    sums = ray_sums(-forces["Krod_MPa"], -forces["T_MPa"], forces["Rpin_MPa"], rays)
    taken = sums[round(coarse.scalars[f"{pin}_ray"]) - 1]
    return bool(taken - sums.min() > 1e-6 * sums.mean())


def grid_remark(model: InputFile) -> str:
    """Errors of the table step in results that people use, in one line; empty without any."""
    errors = grid_errors(model)
    used = [error for error in errors if _USED.fullmatch(error.key)]
    if not used:
        return ""
    first = max(used, key=lambda error: abs(error.percent))
    coarse, fine, unit = written_alike(first)
    others = f"; других таких результатов: {len(errors) - 1}" if len(errors) > 1 else ""
    step, meta = fixed(model.calculation.step_deg, 0), meta_at(InputFile, _STEP)
    title = meta.title if meta is not None else ""
    return (
        f"Шаг таблиц {step}°: {first.title}: {coarse}{unit}, с шагом 1° {fine}{unit}{others}; "
        f"шаг меняют в исходных данных: «{title}»"
    )


def written_alike(error: GridError) -> tuple[str, str, str]:
    """Both values and the unit as a sentence has them."""
    label = error.quantity.unit_label
    coarse, fine = (written(value, error.digits) for value in (error.coarse, error.fine))
    return coarse, fine, label if label in ("", "°") else f"{NBSP}{label}"


def lighter_than(inertias: Array, throws: int) -> int:
    """Return number in the train of the lightest throw if the flywheel is lighter still; else 0."""
    lightest = 1 + int(inertias[1 : throws + 1].argmin())
    return lightest + 1 if inertias[throws + 1] < inertias[lightest] else 0


def flywheel_remark(model: InputFile) -> str:
    """Line about an implausible flywheel of the torsional train, or nothing."""
    if model.torsion is None or model.torsion.masses:
        return ""
    try:
        table, column = INERTIAS
        inertias = solved(model).columns[table][column]
    except ValueError:
        return ""
    throws = len(model.crankshaft.throw_angles_deg)
    heavy = inertias[throws + 1] / inertias[1 : throws + 1].sum()
    if heavy > _MAX_INERTIA:
        inertia = _shown(model, inertias[throws + 1])
        return (
            f"torsion.flywheel_kg_m2: момент инерции маховика {inertia} больше, чем у всех "
            f"колен вместе, в {number_text(round(heavy))}{NBSP}раз; проверьте, что он в кг·м²"
        )
    throw = lighter_than(inertias, throws)
    if not throw:
        return ""
    inertia, other = (_shown(model, inertias[mass]) for mass in (throws + 1, throw - 1))
    whose = "маховика" if model.torsion.flywheel_kg_m2 else "маховика не задан, принятый"
    return (
        f"torsion.flywheel_kg_m2: момент инерции {whose} {inertia} меньше, чем у одного "
        f"колена ({other}); задайте момент инерции маховика, винта или муфты"
    )


def _shown(model: InputFile, value: float) -> str:
    measure = quantity(INERTIAS[1], smallness_of(model))
    return f"{written(value, measure.digits)}{NBSP}{measure.unit_label}"


def webs_remark(model: InputFile) -> str:
    """Line about a size of the webs that stands beside another one which counts, or nothing."""
    drawn = {t for arms in model.crankshaft.arms for t in (arms.left_web_mm, arms.right_web_mm)}
    first = {"web_thickness_mm": ("crankshaft.arms", drawn)} if all(drawn) else {}
    for name, section in model.web_sections.items():
        for key in ("web_thickness_mm", "web_width_mm"):
            size = getattr(section, key, None)
            if size is None:
                continue
            where, sizes = first.setdefault(key, (name, {size}))
            if size not in sizes:
                other = "…".join(map(number_text, sorted({min(sizes), max(sizes)})))
                return (
                    f"{name}.{key}: {number_text(size)}{NBSP}мм, а в {where} щёки "
                    f"{other}{NBSP}мм; в расчёт идут они, удалите ключ"
                )
    return ""


def solution_remarks(model: InputFile) -> tuple[Notice, ...]:
    """Remarks that need a solution."""
    remarks = (
        Notice(Severity.WARNING, flywheel_remark(model)),
        Notice(Severity.WARNING, webs_remark(model)),
        Notice(Severity.NOTE, grid_remark(model)),
    )
    return tuple(remark for remark in remarks if remark.text)
