"""The power that a file states against the one that its diagram and sizes give."""

from __future__ import annotations

from kshm.results.regimes import regime_key
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solved import solved
from reports.inputs.units import number_text
from reports.shared.errors import InputError, Problem
from reports.shared.russian import NBSP, fixed

_MEND = "задайте размеры вместе с мощностью (kshm new --power --bore …) или исправьте давления"
MOST = 2.0  # difference that is told, here and by the workbook [%]


def power_problems(model: InputFile) -> tuple[Problem, ...]:
    """What is wrong with the power of each regime that states another than its diagram has."""
    regimes = (model.regime, *model.regimes)
    if all(regime.indicated_power_kw is None for regime in regimes):
        return ()
    try:
        found = solved(model).scalars
    except (ValueError, InputError):
        return ()
    accepted = {entry.what for entry in model.checks.accepted} if model.checks else set()
    problems = []
    for number, regime in enumerate(regimes, 1):
        stated = regime.indicated_power_kw
        error, check = ("T_error", "power")
        if number > 1:
            error, check = (regime_key(key, number) for key in (error, check))
        percent = float(found.get(error, 0.0))
        if stated is None or abs(percent) <= MOST or check in accepted:
            continue
        where = "regime" if number == 1 else f"regimes[{number - 1}]"
        what = _told(float(stated), percent, float(regime.mechanical_efficiency))
        problems.append(Problem(f"{where}.indicated_power_kw", what, _MEND))
    return tuple(problems)


def _told(stated: float, percent: float, efficiency: float) -> str:
    given = stated * (1 + percent / 100)
    sign = "+" if percent > 0 else "−"
    return (
        f"задано N_i = {_kw(stated)} (эффективная {_kw(stated * efficiency)}), а диаграмма с этими "
        f"размерами даёт {_kw(given)} ({_kw(given * efficiency)}), "
        f"{sign}{fixed(abs(percent), 1)}{NBSP}%"
    )


def _kw(value: float) -> str:
    return f"{number_text(float(f'{value:.4g}'))}{NBSP}кВт"
