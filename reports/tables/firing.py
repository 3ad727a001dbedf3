"""Firing orders that the crankshaft allows: evenness and low torque orders."""

from __future__ import annotations

from reports.tables.shape import Shape
from reports.tables.spec import Column, TableSpec

FIRING_SHEET = "Порядки работы"
MAX_CYLINDERS = 7


def firing_table(shape: Shape) -> TableSpec:
    """All firing orders of a four-stroke engine's shaft."""
    cylinders = shape.cylinders
    columns = [Column("variant", None)]
    numbers = range(1, cylinders + 1)
    for i in numbers:
        base = f"mod(720 - {_before_tdc(shape, i)}, 360)"
        turn = f" + 360*mod(floor((variant - 1)/{2 ** (i - 2)}), 2)" if i > 1 else ""
        columns.append(Column(f"theta{i}_deg", base + turn, "колено в ВМТ"))
    digits, gaps = [], []
    for i in numbers:
        before = [
            f"(1 if theta{j}_deg < theta{i}_deg + {'0.0001' if j < i else '-0.0001'} else 0)"
            for j in numbers
            if j != i
        ]
        place = " - ".join([str(cylinders - 1), *before])
        digits.append(f"{i}*10**({place})")
        # Of two cylinders that fire together the later number follows the earlier one.
        others = [
            f"(mod(theta{j}_deg - theta{i}_deg {'-' if j < i else '+'} 0.0001, 720)"
            f" {'+' if j < i else '-'} 0.0001)"
            for j in numbers
            if j != i
        ]
        gaps.append(f"min({', '.join(others)})" if others else "720")

    def vector(order: str) -> str:
        terms = {
            turn: ", ".join(f"{turn}(rad({order}*theta{i}_deg))" for i in numbers)
            for turn in ("cos", "sin")
        }
        return f"sqrt(total({terms['cos']})**2 + total({terms['sin']})**2)"

    columns += [
        Column("order_code", " + ".join(digits), "по возрастанию θ"),
        Column("gap_max_deg", f"max({', '.join(gaps)})", "промежутки"),
        Column("gap_min_deg", f"min({', '.join(gaps)})", "промежутки"),
        Column("unevenness", f"(gap_max_deg - gap_min_deg)/(720/{cylinders})", "промежутки"),
        Column("half_order_sum", vector("0.5"), "сложение векторов"),
        Column("first_order_sum", vector("1"), "сложение векторов"),
    ]
    return TableSpec(
        "firing_orders",
        "У.р",
        "Порядки работы, возможные при этом коленчатом вале",
        FIRING_SHEET,
        tuple(columns),
        tuple(float(n) for n in range(1, 2 ** (cylinders - 1) + 1)),
        note=(
            "Силы инерции повторяются каждый оборот и у всех порядков одинаковы; различаются "
            "чередование рабочих ходов, моменты низких порядков и нагрузки коренных шеек."
        ),
        step=1.0,
    )


def _before_tdc(shape: Shape, cylinder: int) -> str:
    """Angle from the cylinder's axis to its crankpin at φ = 0 [deg]."""
    angle = f"throw_angle_{shape.throw_of(cylinder)}_deg"
    if shape.arrangement[cylinder - 1].pin_angle:
        angle = f"({angle} + crankshaft_split_pin_deg)"
    return angle if shape.axis(cylinder) == "0" else f"({angle} - {shape.axis(cylinder)})"
