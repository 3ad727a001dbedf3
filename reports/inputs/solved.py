"""An input solved, what the solver refuses said in the words of the input."""

from __future__ import annotations

from functools import lru_cache

from kshm.mechanics.oil_orbit import FilmError
from kshm.results.solution import Solution, solve
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.report import ReportSection
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.errors import InputError, Problem


def solved(model: InputFile, source: str = "") -> Solution:
    """Results of an input; `source` names its file in messages.

    Raises:
        InputError: the oil film of a bearing does not carry its load.
    """
    try:
        return _solution(model.model_copy(update=_PRINTED))
    except FilmError as error:
        where = ": ".join(part for part in (source, "bearings") if part)
        raise InputError(Problem(where, film_lost(error), MEND)) from None


_PRINTED = {"report": ReportSection(), "sheet": None}  # sections that change no number


@lru_cache(maxsize=16)  # the doors, the sheets and the report ask for the same and for finer steps
def _solution(model: InputFile) -> Solution:
    solution = solve(*engine_and_cycle(model))
    if model.bearings is not None:
        _ = solution.columns  # results wait until they are asked for; orbits may refuse
    return solution


MEND = "проверьте зазоры, вязкость и температуру масла, ширину"


def film_lost(error: FilmError) -> str:
    """Which bearing's oil film gives way."""
    name = f"коренного подшипника {error.bearing}" if error.bearing else "шатунного подшипника"
    return f"масляная плёнка {name} не несёт нагрузки: зазор за цикл исчезает"
