"""Conditional wear diagrams: table 14 for the crankpin and every main journal, Gots 2.6."""

from __future__ import annotations

from kshm.nomenclature.quantity import ray_key, roman
from reports.spec.blocks import Block, Column, Grid, GridRow, Scalar, TableSpec
from reports.spec.charts import ChartSpec, wear_chart
from reports.spec.extremes import TIE
from reports.spec.listing import grid_row, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape, pin_figure, pin_name, pin_table, rays_table


def wear(scope: Scope) -> Part:
    """Tables of forces by rays and the sums that draw the diagrams."""
    shape, rows, rays = scope.shape, scope.cycle, scope.input.calculation.wear_rays
    journals, pins = shape.throws + 1, len(shape.pins)
    blocks: list[Block] = []
    for n in range(1, pins + 1):
        table, name = pin_table(n), f"pin{pin_name(n)}"
        blocks += _surface(
            rays_table(n), name,
            "14" if n == 1 else f"14.Ш{n}", "шатунную шейку" + (f" {n}" if pins > 1 else ""),
            "Износ ш.ш" if n == 1 else f"Износ ш.ш ({n})", rows, rays,
            size=f"{table}.Rpin_MPa", up=f"-{table}.Krod_MPa", against=f"-{table}.T_MPa",
        )  # fmt: skip
    for k in range(1, journals + 1):
        table = f"P4_3_{k}"
        blocks += _surface(
            f"table_14_main_{k}", f"main{k}", f"14.{k}", f"коренную шейку {k}",
            f"Износ к.ш ({k})", rows, rays,
            size=f"{table}.R_MPa", up=f"{table}.Ry_MPa", against=f"{table}.Rx_MPa",
        )  # fmt: skip
    return Part(tuple(blocks), _charts(shape))


def _surface(
    table_id: str, name: str, number: str, journal: str, sheet: str,
    rows: tuple[float, ...], rays: int, *, size: str, up: str, against: str,
) -> tuple[TableSpec, Grid]:  # fmt: skip
    columns = [Column("phi_deg", None)]
    for i in range(rays):
        turn = f"rad({name}_deg{i + 1})"
        # cos 60° is a half; the window includes its edges.
        inside = f"round(({up})*cos({turn}) + ({against})*sin({turn}) - {size}/2, 9) >= 0"
        columns.append(Column(ray_key(i + 1), f"{size} if {inside} else 0", "Гоц, табл. 14"))
    table = TableSpec(
        table_id,
        number,
        f"Силы, действующие на {journal}, по лучам",
        sheet,
        tuple(columns),
        rows,
        note=(
            "Луч I направлен вдоль первого колена от оси вала, лучи пронумерованы против "
            "вращения; сила учтена в лучах, отстоящих от её вектора не более чем на 60°. "
            "Шейка изнашивается со стороны, с которой действует сила."
        ),
    )
    return table, _sums(table_id, name, sheet, rays)


def _sums(table_id: str, name: str, sheet: str, rays: int) -> Grid:
    """Sums by rays, the least loaded ray and the points of the drawn diagram."""
    numbers = range(1, rays + 1)
    grid = f"{table_id}_sums"

    def row(of: str, key: str, text: str, before: str = "") -> GridRow:
        cells: list[Scalar] = []
        for place, i in enumerate((*numbers, 1), 1):  # the last instance closes the curve
            known = {"sum": f"{name}_sum{i}", "deg": f"{name}_deg{i}", "before": before}
            before = f"{name}_{key}{place}"
            expr = text.format(i=i, ray=ray_key(i), **known)
            cells.append(Scalar(before, expr, "Гоц, рис. 33", of=of))
        return GridRow(of, tuple(cells))

    # Drawn on the side of contact, half a turn from the ray; the deepest wear is half the radius.
    arc = f"{{before}} + 1 if {{sum}} < col_min({grid}.ray_sum) + {TIE} else 0"
    radius = f"(1 - {{sum}}/(2*col_max({grid}.ray_sum)))"
    return Grid(
        grid,
        f"Суммы сил по лучам и условная диаграмма износа: {sheet.removeprefix('Износ ')}",
        sheet,
        (*(roman(i) for i in numbers), "I"),
        (
            row("ray_deg", "deg", "({i} - 1)*360/calculation_wear_rays"),
            row("ray_sum", "sum", f"col_sum({table_id}.{{ray}})"),
            row("ray_lap", "lap", arc, before="0"),
            row("ray_arc", "arc", arc, before=f"{name}_lap{rays}"),
            # x grows to the left, as the axes of the journals do; the chart turns it round.
            # A ray's points of wear and circle stand one below the other: a line joins them.
            row("wear_x", "x", f"-({radius}*sin(rad({{deg}})))"),
            row("circle_x", "cx", "-sin(rad({deg}))"),
            row("wear_y", "y", f"-({radius}*cos(rad({{deg}})))"),
            row("circle_y", "cy", "-cos(rad({deg}))"),
            # The oil hole on the journal, seen as the report draws it.
            *(
                grid_row(
                    of,
                    (f"{turn}(rad(hole_{name}_deg))", *[None] * rays),
                    "Гоц, рис. 33",
                    f"{name}_{of}",
                )
                for of, turn in (("hole_x", "sin"), ("hole_y", "cos"))
            ),
        ),
    )


def hole_scalars(name: str) -> tuple[Scalar, ...]:
    """Least loaded ray, of equal ones the middle of the widest arc, and the oil hole opposite."""
    key, number = f"hole_{name}", name.removeprefix("pin")
    table = rays_table(int(number)) if number.isdigit() else "table_14"
    if name.startswith("main"):
        table = f"table_14_main_{name.removeprefix('main')}"
    arcs = f"{table}_sums.ray_arc"
    middle = f"first_largest({arcs}) - floor(col_max({arcs})/2)"
    return scalar_list(f"""
        {key}_ray = mod({middle} - 1, calculation_wear_rays) + 1 | Гоц, рис. 33
        {key}_deg = mod(({key}_ray - 1)*360/calculation_wear_rays + 180, 360) | Гоц, 2.6
    """)


def _charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """Figures 52 and 54: the conditional diagrams of all crankpins and main journals."""
    several = len(shape.pins) > 1
    made = []
    for number in range(1, len(shape.pins) + 1):
        n = pin_name(number)
        pin, journal = pin_table(number), f"шатунной шейки{f' {number}' if several else ''}"
        made.append(
            wear_chart(pin_figure("fig52", number), f"Износ ш.ш ({n})" if n else "Износ ш.ш",
                 f"Условная диаграмма износа {journal}", f"{rays_table(number)}_sums",
                 f"hole_pin{n}_deg", (f"{pin}.T_MPa", f"{pin}.Krod_MPa"), figure="52")
        )  # fmt: skip
    for k in range(1, shape.throws + 2):
        made.append(
            wear_chart(f"fig54_{k}", f"Износ к.ш ({k})",
                 f"Условная диаграмма износа коренной шейки {k}", f"table_14_main_{k}_sums",
                 f"hole_main{k}_deg", (f"-P4_3_{k}.Rx_MPa", f"-P4_3_{k}.Ry_MPa"), figure="54")
        )  # fmt: skip
    return tuple(made)
