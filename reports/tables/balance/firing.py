"""Firing orders that the crankshaft allows: evenness and low torque orders."""

from __future__ import annotations

from collections.abc import Iterator

from reports.spec.blocks import Column, TableSpec
from reports.spec.listing import column_list
from reports.spec.shape import Shape

FIRING_SHEET = "Порядки работы"
MAX_CYLINDERS = 7


def firing_loads(shape: Shape, cycle: tuple[float, ...]) -> TableSpec:
    """Loads of the inner journals when the throw behind fires a turn later or sooner.

    A journal feels only its two neighbours, and they fire either as they do or a turn apart
    from that: two curves for each journal give the loads of all orders.
    """
    columns = [
        Column("phi_deg", None),
        Column("row_later", "round(mod(phi_deg + 360, 720)/calculation_step_deg) + 1",
               "на оборот позже", helper=True),
    ]  # fmt: skip
    for k in range(2, shape.throws + 1):
        t = f"P4_3_{k}"
        later = {axis: f"element(firing_loads.after_{axis}{k}_MPa, row_later)" for axis in "xy"}
        columns += column_list(f"""
            helpers:
            after_x{k}_MPa = {t}.bTcos_MPa - {t}.bKsin_MPa | Гоц (56)
            after_y{k}_MPa = {t}.bTsin_MPa + {t}.bKcos_MPa | Гоц (57)
            Rturned{k}_MPa = sqrt(({t}.Rx_MPa - after_x{k}_MPa + {later["x"]})**2 + ({t}.Ry_MPa
                - after_y{k}_MPa + {later["y"]})**2) | Гоц (59)
        """)
    return TableSpec(
        "firing_loads",
        "У.н",
        "Нагрузки коренных шеек при другом порядке работы",
        FIRING_SHEET,
        tuple(columns),
        cycle,
        note="Колено за шейкой работает на оборот позже или раньше, чем при заданном порядке.",
        helper=True,
    )


def has_loads(shape: Shape, *, forced: bool) -> bool:
    """Whether the loads of other orders can be told from those of neighbouring throws."""
    return shape.single_rods and not forced


def _loads(shape: Shape) -> Iterator[Column]:
    """Greatest load of each inner main journal with the order of a row, then of all [kN]."""
    found = ["Rmain1_max", f"Rmain{shape.throws + 1}_max"]
    for k in range(2, shape.throws + 1):
        (i,), (j,) = shape.groups[k - 2], shape.groups[k - 1]
        apart = f"theta{j}_deg - theta{i}_deg - firing_offset_{j}_deg + firing_offset_{i}_deg"
        same = f"abs(mod({apart} + 180, 720) - 180) < 1"
        load = f"Rmain{k}_max if {same} else col_max(firing_loads.Rturned{k}_MPa)"
        yield Column(f"Rnext{k}_MPa", load, "Гоц (59)", helper=True)
        found.append(f"Rnext{k}_MPa")
    text = f"to_kN(of_MPa(max({', '.join(found)}))*F_piston)"
    yield Column("Rorder_max_kN", text, "Гоц (59)")


def firing_table(shape: Shape, *, loads: bool) -> TableSpec:
    """All firing orders of a four-stroke engine's shaft."""
    cylinders = shape.cylinders
    columns = [Column("variant", None)]
    numbers = range(1, cylinders + 1)
    for i in numbers:
        base = f"mod(720 - {_before_tdc(shape, i)}, 360)"
        turn = f" + 360*mod(floor((variant - 1)/{2 ** (i - 2)}), 2)" if i > 1 else ""
        columns.append(Column(f"theta{i}_deg", base + turn, "колено в ВМТ", every="720"))
    places = ", ".join(f"place{i}" for i in numbers)
    gaps = ", ".join(f"gap{i}_deg" for i in numbers)
    columns += column_list(f"""
        order_code = total({places}) | по возрастанию θ
        gap_max_deg every 0 = max({gaps}) | промежутки
        gap_min_deg every 0 = min({gaps}) | промежутки
        unevenness = (gap_max_deg - gap_min_deg)/(720/{cylinders}) | промежутки
        half_order_sum = sqrt(half_cos**2 + half_sin**2) | сложение векторов
        first_order_sum = sqrt(first_cos**2 + first_sin**2) | сложение векторов
    """)
    if loads:
        columns += reversed([*_loads(shape)])  # the result before what it takes
    columns += _steps(numbers)
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


def _steps(numbers: range) -> Iterator[Column]:
    """Helper columns: digits of the order, gap behind each cylinder, sums of waves."""
    for i in numbers:
        before = [
            f"(1 if theta{j}_deg < theta{i}_deg {'+' if j < i else '-'} 0.0001 else 0)"
            for j in numbers
            if j != i
        ]
        place = " - ".join([str(len(numbers) - 1), *before])
        yield Column(f"place{i}", f"{i}*10**({place})", "по возрастанию θ", helper=True)
    for i in numbers:
        # Of two cylinders that fire together the later number follows the earlier one.
        ways = [(j, "-", "+") if j < i else (j, "+", "-") for j in numbers if j != i]
        ahead = [f"(mod(theta{j}_deg - theta{i}_deg {one} 0.0001, 720) {two} 0.0001)"
                 for j, one, two in ways]  # fmt: skip
        gap = f"min({', '.join(ahead)})" if ahead else "720"
        yield Column(f"gap{i}_deg", gap, "промежутки", helper=True, every="0")
    for name, order in (("half", "0.5*"), ("first", "")):
        for turn in ("cos", "sin"):
            terms = ", ".join(f"{turn}(rad({order}theta{i}_deg))" for i in numbers)
            yield Column(f"{name}_{turn}", f"total({terms})", "сложение векторов", helper=True)


def _before_tdc(shape: Shape, cylinder: int) -> str:
    """Angle from the cylinder's axis to its crankpin at φ = 0 [deg]."""
    angle = f"throw_angle_{shape.throw_of(cylinder)}_deg"
    if shape.arrangement[cylinder - 1].pin_angle:
        angle = f"({angle} + crankshaft_split_pin_deg)"
    return angle if shape.axis(cylinder) == "0" else f"({angle} - {shape.axis(cylinder)})"
