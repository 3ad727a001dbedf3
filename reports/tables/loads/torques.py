"""Total torque and running-on torques: П4.2, П4.4, П4.5, Gots 2.8."""

from __future__ import annotations

from reports.spec.blocks import Column, TableSpec
from reports.spec.charts import ChartSpec, over_phi
from reports.spec.extremes import extreme_columns
from reports.spec.listing import column_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape, cylinder_table_id, rods_table

INDEX = Column("phi_deg", None)


def torques(scope: Scope) -> Part:
    """Tables П4.2, П4.4 and П4.5 with the torques of the pin sections by statics."""
    shape, rows = scope.shape, scope.cycle
    numbers = range(1, shape.cylinders + 1)
    each = [Column(f"M{i}_Nm", f"{cylinder_table_id(i)}.M_Nm", "Гоц, 2.5") for i in numbers]
    total = " + ".join(f"M{i}_Nm" for i in numbers)
    torque = TableSpec(
        "P4_2",
        "П4.2",
        "Крутящий момент каждого цилиндра и суммарный момент двигателя",
        "П4.2",
        (INDEX, *each, Column("Msum_Nm", total, "Гоц, 2.8"), *extreme_columns("Msum_Nm", "M")),
        rows,
    )
    blocks = (torque, *_running(shape, rows), _statics(shape, rows))
    return Part(blocks, _charts(shape))


def _running(shape: Shape, rows: tuple[float, ...]) -> tuple[TableSpec, TableSpec]:
    """Torques before and at every crankpin, which carries half of its throw's own."""
    source = "Гоц, 2.8"
    own = shape.throw_torque(1)[1]
    main = [f"Mmain2_Nm = {own} | {source}"]
    pin = [f"Mpin1_Nm = 0.5*{own} | {source}"]
    for i in range(2, shape.throws + 1):
        key, own = shape.throw_torque(i)
        main += [f"{key} = {own} | П4.2", f"Mmain{i + 1}_Nm = Mmain{i}_Nm + {key} | {source}"]
        pin += [f"{key} = {own} | П4.2", f"Mpin{i}_Nm = P4_4.Mmain{i}_Nm + 0.5*{key} | {source}"]
    title = "Набегающие моменты на {} шейки"
    return (
        TableSpec("P4_4", "П4.4", title.format("коренные"), "П4.4",
                  column_list("phi_deg", *main), rows),
        TableSpec("P4_5", "П4.5", title.format("шатунные"), "П4.5",
                  column_list("phi_deg", *pin), rows),
    )  # fmt: skip


def _statics(shape: Shape, rows: tuple[float, ...]) -> TableSpec:
    columns = [INDEX]
    for i in range(1, shape.throws + 1):
        before = f"P4_4.Mmain{i}_Nm + " if i > 1 else ""
        columns.append(
            *column_list(f"""
                Mpins{i}_Nm = {before}r_crank*({_on_left_support(shape, i)} + throw{i}_RTCL
                    + throw{i}_side) | статика левой половины колена
            """)
        )
    return TableSpec(
        "P4_5s",
        "П4.5с",
        "Моменты в сечениях шатунных шеек по статике",
        "П4.5",
        tuple(columns),
        rows,
        note=(
            "Правило «предыдущий момент плюс половина своего» точно для симметричного колена; "
            "здесь момент найден из равновесия левой половины колена и верен при любых плечах."
        ),
    )


def _on_left_support(shape: Shape, throw: int) -> str:
    """Share of the rods' tangential forces on the left support of a throw [N]."""
    group = shape.groups[throw - 1]
    if len(group) == 1:
        source = f"{cylinder_table_id(group[0])}.T_MPa"
        return f"(1 - throw{throw}_share)*of_MPa({source})*F_piston"
    table = rods_table(throw)
    return " + ".join(
        f"(1 - throw{throw}_{share})*of_MPa({table}.T{side}_MPa)*F_piston"
        for side, share in zip(("left", "right"), rod_shares(shape), strict=True)
    )


def rod_shares(shape: Shape) -> tuple[str, str]:
    """Rows of the grid of throws with the shares of the left and the right rod.

    An articulated rod pushes where its master rod does.
    """
    return ("share", "share") if shape.articulated else ("share", "share2")


def _charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """Figures 49, 56 and 57."""
    y, y_tex = "M, Н·м", "$M$, Н·м"
    return (
        over_phi("fig49", "П4.2", "Индикаторный крутящий момент двигателя", y, "P4_2.Msum_Nm",
                 figure="49", y_tex=r"$M_{\mathrm{кр}}$, Н·м", levels=("M_mean",), extremes=True),
        *(
            over_phi(f"fig56_{k}", "П4.4", f"Набегающий момент на коренную шейку {k}", y,
                     f"P4_4.Mmain{k}_Nm", figure="56", y_tex=y_tex, panel=f"шейка {k}",
                     group="Набегающие моменты на коренные шейки")
            for k in range(2, shape.throws + 2)
        ),
        *(
            over_phi(f"fig57_{i}", "П4.5", f"Набегающий момент на шатунную шейку {i}", y,
                     f"P4_5.Mpin{i}_Nm", figure="57", y_tex=y_tex, panel=f"шейка {i}",
                     group="Набегающие моменты на шатунные шейки")
            for i in range(1, shape.throws + 1)
        ),
    )  # fmt: skip
