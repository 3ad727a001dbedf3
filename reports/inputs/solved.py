"""An input solved, what the solver refuses said in the words of the input."""

from __future__ import annotations

from kshm.mechanics.oil_orbit import FilmError
from kshm.results.solution import Solution, solve
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.errors import InputError, Problem


def solved(model: InputFile) -> Solution:
    """Results of an input.

    Raises:
        InputError: the oil film of a bearing does not carry its load.
    """
    try:
        solution = solve(*engine_and_cycle(model))
        if model.bearings is not None:
            _ = solution.columns  # results wait until they are asked for; orbits may refuse
    except FilmError as error:
        name = f"коренного подшипника {error.bearing}" if error.bearing else "шатунного подшипника"
        what = f"масляная плёнка {name} не несёт нагрузки: зазор за цикл исчезает"
        hint = "проверьте зазоры, вязкость и температуру масла, ширину"
        raise InputError(Problem("bearings", what, hint)) from None
    return solution
