"""A flywheel that is lighter than a throw of its shaft, or of another unit: none is."""

from __future__ import annotations

from kshm.arrays import Array
from kshm.nomenclature.quantity import quantity
from reports.inputs.checks.grid import grid_remark
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solved import solved
from reports.inputs.to_si.engine import smallness_of
from reports.inputs.units import number_text
from reports.shared.errors import InputError
from reports.shared.russian import NBSP, written

INERTIAS = "torsion_forms", "tor_J_kgm2"  # of the train's masses: pulley, throws, flywheel
_MOST = 1000.0  # times all throws together; of one cylinder it is some hundreds, from memory


def lighter_than(inertias: Array, throws: int) -> int:
    """Number in the train of the lightest throw if the flywheel is lighter still; else 0."""
    lightest = 1 + int(inertias[1 : throws + 1].argmin())
    return lightest + 1 if inertias[throws + 1] < inertias[lightest] else 0


def flywheel_remark(model: InputFile) -> str:
    """That the flywheel of the torsional train is too light or heavy, in one line; or nothing."""
    if model.torsion is None or model.torsion.masses:
        return ""
    try:
        table, column = INERTIAS
        inertias = solved(model).columns[table][column]
    except (ValueError, InputError):
        return ""
    throws = len(model.crankshaft.throw_angles_deg)
    heavy = inertias[throws + 1] / inertias[1 : throws + 1].sum()
    if heavy > _MOST:
        own = _shown(model, inertias[throws + 1])
        return (
            f"Внимание: torsion.flywheel_kg_m2: момент инерции маховика {own} больше, чем у всех "
            f"колен вместе, в {number_text(round(heavy))}{NBSP}раз; проверьте, что он в кг·м²"
        )
    throw = lighter_than(inertias, throws)
    if not throw:
        return ""
    own, other = (_shown(model, inertias[place]) for place in (throws + 1, throw - 1))
    whose = "маховика" if model.torsion.flywheel_kg_m2 else "маховика не задан, принятый"
    return (
        f"Внимание: torsion.flywheel_kg_m2: момент инерции {whose} {own} меньше, чем у одного "
        f"колена ({other}); задайте момент инерции маховика, винта или муфты"
    )


def _shown(model: InputFile, value: float) -> str:
    about = quantity(INERTIAS[1], smallness_of(model))
    return f"{written(value, about.digits)}{NBSP}{about.unit_label}"


def solution_remarks(model: InputFile) -> tuple[str, ...]:
    """What a solution shows that the data alone do not, a line each."""
    return tuple(filter(None, (flywheel_remark(model), grid_remark(model))))
