"""Quantities of a study in the words of the command: Russian errors, symbols, formats."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from kshm.chain.solve import ChainArrays
from kshm.cycle.cycle import CycleRun
from kshm.errors import UnknownNameError
from kshm.nomenclature.quantity import Quantity
from kshm.results.chosen import ChosenQuantities
from kshm.results.chosen import choose as choose_keys
from reports.shared.errors import InputError, Problem, one_line
from reports.workbook.styles import excel_format


def choose(
    base: ChainArrays,
    names: Sequence[str],
    cycle: CycleRun | None = None,
    department: Mapping[str, Quantity] | None = None,
) -> ChosenQuantities:
    """Choose quantities as `kshm.results.chosen.choose`.

    Raises:
        InputError: there is no such quantity.
    """
    try:
        return choose_keys(base, names, cycle, department)
    except UnknownNameError as error:
        close = error.problems[0].value
        hint = f"похожи: {', '.join(close)}" if close else "ключи показывает kshm solve --json"
        where = f"--quantity {one_line(str(error.args[0]), 80)}"
        raise InputError(Problem(where, "нет такой величины", hint)) from None


def symbol_of(name: str, quantities: ChosenQuantities) -> str:
    """Symbol of a name as the report has it; the name itself where there is none."""
    return quantities.quantity(name).symbol or name


def format_of(name: str, quantities: ChosenQuantities) -> str:
    """Return the number format of a name; the grid's angles may be fractions of a degree."""
    if name.endswith("_deg") and "." in name:
        return "0.##"
    return excel_format(quantities.quantity(name))
