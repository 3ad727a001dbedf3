"""Numbers of an engine as plain data for whoever draws them himself: a page, another program.

Key results, the curves of charts with the place of a cursor, what moves, the checks.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from kshm import quantity
from kshm.nomenclature.quantity import Quantity
from kshm.results.solution import Solution
from reports.document.figures.canvas import by_direction
from reports.document.text.symbols import indexed
from reports.inputs.solve_input import solution_remarks
from reports.inputs.units import MM
from reports.model.blocks import Held, Model, Scalar, ScalarTable
from reports.model.charts import ChartSpec
from reports.model.evaluation import Evaluation
from reports.shared.russian import written
from reports.shared.standing import Standing
from reports.tables.verdicts import check_value, outcomes, reasons_of

Data = dict[str, Any]
_DIGITS = 8  # of the greatest number of a curve: what no screen shows
_LEAST = 12  # places: what is less is noise of a sum that is zero
_BY_FORMULA = ("N_e_calc",)  # a step beyond the chain
_CHART = ("id", "title", "kind", "x_title", "y_title", "x_is_angle", "x_reversed", "y_reversed")


def results(model: Model, solution: Solution) -> Iterator[Data]:
    """The summaries of workbook and report with the numbers of chain and regimes: what is quick."""
    quick = solution.scalars if solution.engine.regimes else solution.chain_scalars
    evaluation = Evaluation(model)
    for block in model.blocks:
        if isinstance(block, ScalarTable) and block.id.startswith(("summary", "geometry")):
            values = ((each, evaluation.value(each.key) if each.key in _BY_FORMULA
                       else solution.scalar(each.key)) for each in block.scalars
                      if each.key in quick or each.key in _BY_FORMULA)  # fmt: skip
            rows = [_row(each, value) for each, value in values]
            if rows:
                yield {"id": block.id, "title": block.title, "rows": rows}
    for block in model.blocks:  # of own books, but for their checks
        if isinstance(block, ScalarTable) and block.verdicts is None:
            rows = [_row(each, evaluation.value(each.key)) for each in block.scalars
                    if each.key in model.department]  # fmt: skip
            if rows:
                yield {"id": block.id, "title": block.title, "rows": rows}


def _row(each: Scalar, value: float | str) -> Data:
    """Return a result with its words."""
    text = value if isinstance(value, str) else written(value, each.quantity.digits)
    return {"key": each.key, "title": each.note or each.quantity.title,
            "symbol": _symbol(each.quantity), "unit": each.quantity.unit_label,
            "value": value, "text": text}  # fmt: skip


def charts(model: Model, solution: Solution, sheet: str) -> list[Data]:
    """Return the charts of a sheet; what the solver does not say follows from the formulas."""
    formulas = Evaluation(model)
    return [_chart(each, solution, formulas) for each in model.charts if each.sheet == sheet]


def _chart(chart: ChartSpec, solution: Solution, formulas: Evaluation) -> Data:
    """Return a chart's curves, and where its cursor stands at every φ if it has no angle."""

    def numbers(key: str) -> Any:  # noqa: ANN401
        try:
            return solution.column(*key.split(".", 1))
        except KeyError:
            return np.asarray(formulas.value(key), dtype=float)

    # A screen has room for both paths of a vector, before and after balancing.
    vectors = [each for each in chart.series
               if chart.kind == "polar" and each.only == "workbook"
               and not each.invisible]  # fmt: skip
    curves = [(each.name or _name(each.y, formulas.model), numbers(each.x), numbers(each.y))
              for each in (*chart.drawn_by("report"), *vectors)]  # fmt: skip
    x = y = np.empty(0)
    if chart.kind == "polar":
        _, x, y = curves[0]
    elif chart.contact:
        x, y = (numbers(key.lstrip("-")) * (-1 if key[0] == "-" else 1) for key in chart.contact)
        x, y = np.array([x, y]) / np.maximum(np.hypot(x, y), 1e-12)
    angles = (solution.column(table, "phi_deg") for table in ("P3_1", "P4_1"))
    phi = next((phi for phi in angles if len(phi) == len(x)), None)
    return {
        **{key: getattr(chart, key) for key in _CHART},
        "curves": [{"name": name, **_lists(x=x, y=y)} for name, x, y in curves],
        "path": None if phi is None else _lists(phi=phi, x=x, y=y),
    }


def _symbol(each: Quantity) -> str:
    return indexed(each.tex, each.symbol)


def _name(key: str, model: Model) -> str:
    if key in model.nodes:
        return _symbol(model.nodes[key].quantity)
    try:
        return _symbol(quantity(key.rpartition(".")[2]))
    except KeyError:
        return ""


def _lists(**columns: Any) -> dict[str, list[float | None]]:  # noqa: ANN401
    return {key: plain_numbers(values) for key, values in columns.items()}


def plain_numbers(values: Any) -> list[float | None]:  # noqa: ANN401
    """Return a column as JSON carries it: digits that no screen shows are left out."""
    values = np.asarray(values, dtype=float)
    finite = np.isfinite(values)
    most = float(np.max(np.abs(values[finite]), initial=0.0))
    digits = min(_LEAST, _DIGITS - int(np.ceil(np.log10(most)))) if most > 0 else 0
    rounded: list[float | None] = np.round(values, digits).tolist()
    if not finite.all():
        rounded = [x if ok else None for x, ok in zip(rounded, finite, strict=True)]
    return rounded


def moving(solution: Solution, cylinder: int = 0) -> Data:
    """Return what the moving mechanisms of all cylinders and the star of cranks are drawn from.

    ``joints`` are the places of crankpin, articulated pin and piston pin [mm] in the frame of
    a cylinder, its axis upwards, over its own angle ``turn``; one set for each kind of rod.
    ``each`` has the axis of a cylinder [deg], its shift [deg] from the engine's angle, its kind
    of rod; ``gas`` is the share of the greatest pressure over the own angle of a cycle.
    Forces of the chosen cylinder stand over the engine's angle.  ``throws`` are the directions
    of cranks [deg], each with the numbers of those that share it.
    """
    engine = solution.engine
    number = cylinder if cylinder in range(engine.cylinders) else 0
    geometry, phi = engine.geometry, solution.column("P4_1", "phi_deg")
    tables = ["P4_1", *(f"cylinder_{each + 1}" for each in range(1, engine.cylinders))]
    shifts = [0.0, *(float(phi[0] - solution.column(each, "phase_deg")[0]) for each in tables[1:])]
    hung = [each.master is not None for each in engine.arrangement]
    forces = [key for key in solution.chain_tables["P4_1"] if key.endswith("_MPa")]
    gas = solution.column("P4_1", "Pg_MPa")
    return {
        **_lists(phi=phi, turn=solution.column("P3_1", "phi_deg")),
        "joints": [[[plain_numbers(x * 1000) for x in joint]
                    for joint in solution.joints(hung.index(kind))]
                   for kind in (False, True) if kind in hung],
        "each": [{"axis": float(np.degrees(arranged.axis)), "shift": shift,
                  "rod": sorted({*hung}).index(kind)}
                 for arranged, shift, kind in zip(engine.arrangement, shifts, hung, strict=True)],
        "gas": plain_numbers(np.round(np.clip(gas / max(gas.max(), 1e-9), 0, 1), 3)),
        "forces": {
            key: {"symbol": _symbol(quantity(key)), "unit": quantity(key).unit_label,
                  **_lists(values=solution.column(tables[number], key))}
            for key in forces
        },
        "radius": MM.from_si(geometry.crank_radius), "bore": MM.from_si(geometry.bore),
        "wall": MM.from_si(geometry.crank_offset or 0.0), "cylinder": number,
        "speed": engine.speed_rpm,
        "throws": list(by_direction(
            np.degrees([each.angle for each in engine.crankshaft.throws]).tolist()
        )),
    }  # fmt: skip


def checks(model: Model) -> Data:
    """Return the checks of a calculation, each with its value, and what the step leaves out."""
    value, reasons = Evaluation(model).value, reasons_of(model.input)
    keys = [scalar.key for block in model.blocks if isinstance(block, ScalarTable)
            for pair in block.pairs for scalar in pair]  # fmt: skip
    return {
        "checks": [
            {"key": each.name, "title": each.title, "value": check_value(each.value),
             "ok": each.standing is Standing.INSIDE, "odd": each.held is Held.USUAL,
             "reason": reasons.get(each.name, "")}
            for each in outcomes(model, {key: value(key) for key in keys})
            if each.held is not Held.USUAL or each.standing is not Standing.INSIDE
        ],
        "remarks": [*model.remarks, *(remark.line for remark in solution_remarks(model.input))],
    }  # fmt: skip
