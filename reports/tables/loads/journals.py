"""Main journals: (50)-(60), П4.3 with the columns of table 10, figures 53 and 55."""

from __future__ import annotations

from reports.spec.blocks import Column, TableSpec
from reports.spec.charts import ChartSpec, Series, over_phi, polar
from reports.spec.extremes import extreme_columns
from reports.spec.listing import column_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape, cylinder_table_id, rods_table
from reports.tables.loads.crankpins import angle, polar_box
from reports.tables.loads.torques import rod_shares


def journals(scope: Scope) -> Part:
    """Reactions on every main journal."""
    shape, numbers = scope.shape, range(1, scope.shape.throws + 2)
    tables = (_journal(shape, k, scope.cycle, forced=scope.forced) for k in numbers)
    boxes = (polar_box(f"P4_3_{k}", f"Rmain{k}", f"П4.3 ({k})") for k in numbers)
    return Part((*tables, *boxes), _journal_charts(shape))


def _journal(shape: Shape, number: int, rows: tuple[float, ...], *, forced: bool) -> TableSpec:
    """Reactions on main journal ``number`` with the columns of table 10, Gots (56)-(60)."""
    throws = shape.throws
    columns = [Column("phi_deg", None)]
    x_terms, y_terms = [], []
    for side, throw, support in (("a", number - 1, "P"), ("b", number, "L")):
        if not 1 <= throw <= throws:
            continue
        gamma = f"rad(throw_angle_{throw}_deg)"
        for axis, formula in (("T", "Гоц (51), (53), (55)"), ("K", "Гоц (50), (52), (55)")):
            constant = f"to_MPa(throw{throw}_R{axis}C{support}/F_piston)"
            name, rods = f"{side}{axis}", _on_support(shape, throw, axis, support, forced=forced)
            columns += column_list(f"""
                {name}_MPa = {rods} + {constant} | {formula}
                {name}cos_MPa = {name}_MPa*cos({gamma}) | Гоц, табл. 10
                {name}sin_MPa = {name}_MPa*sin({gamma}) | Гоц, табл. 10
            """)
        x_terms += [f"{side}Tcos_MPa", f"-{side}Ksin_MPa"]
        y_terms += [f"{side}Tsin_MPa", f"{side}Kcos_MPa"]
    turn = "rad(phi_deg)"
    columns += [
        *column_list(f"""
            Rx_MPa = {" + ".join(x_terms).replace("+ -", "- ")} | Гоц (56), (58)
            Ry_MPa = {" + ".join(y_terms)} | Гоц (57), (58)
            R_MPa = sqrt(Rx_MPa**2 + Ry_MPa**2) | Гоц (59)
            psiR_deg = {angle("Rx_MPa", "Ry_MPa")} | Гоц (60)
            block_x_MPa = -(Rx_MPa*cos({turn}) - Ry_MPa*sin({turn})) | нагрузка на подшипник
            block_y_MPa = -(Rx_MPa*sin({turn}) + Ry_MPa*cos({turn})) | нагрузка на подшипник
        """),
        *extreme_columns("R_MPa", f"Rmain{number}"),
    ]
    return TableSpec(
        f"P4_3_{number}",
        f"П4.3.{number}",
        f"Удельные силы, действующие на коренную шейку {number}",
        f"П4.3 ({number})",
        tuple(columns),
        rows,
        note=(
            "Реакции опоры на шейку в осях, вращающихся с валом: x — влево, если смотреть с "
            "носка, y — вверх в плоскости первого колена."
        ),
    )


def _on_support(shape: Shape, throw: int, axis: str, support: str, *, forced: bool) -> str:
    """What the rods of a throw put on one of its supports, Gots (50)-(53)."""

    def share(row: str) -> str:
        return f"throw{throw}_{row}" if support == "P" else f"(1 - throw{throw}_{row})"

    group = shape.groups[throw - 1]
    if len(group) == 1:
        source = f"forced_{throw}" if forced else cylinder_table_id(group[0])
        return f"{share('share')}*{source}.{axis}_MPa"
    table = rods_table(throw)
    return " + ".join(
        f"{share(row)}*{table}.{axis}{side}_MPa"
        for side, row in zip(("left", "right"), rod_shares(shape), strict=True)
    )


def _journal_charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """Figures 53 and 55 of every main journal."""
    made = []
    for k in range(1, shape.throws + 2):
        table, sheet, of = f"P4_3_{k}", f"П4.3 ({k})", f"нагрузки на коренную шейку {k}"
        made += [
            polar(f"fig53_{k}", sheet, f"Полярная диаграмма {of}",
                  ("R′x, МПа (влево)", "R′y, МПа"), f"{table}_box.box",
                  Series(f"{table}.Rx_MPa", f"{table}.Ry_MPa", f"R′к.ш{k}"),
                  figure="53", x_reversed=True,
                  caption=f"Полярная диаграмма удельной {of}"),
            over_phi(f"fig55_{k}", sheet, f"Нагрузка на коренную шейку {k}", "R, МПа",
                     f"{table}.R_MPa", figure="55", levels=(f"Rmain{k}_mean",),
                     caption=f"Развёрнутая диаграмма {of}"),
        ]  # fmt: skip
    return tuple(made)
