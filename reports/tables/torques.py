"""Total torque and running-on torques: П4.2, П4.4, П4.5, Gots 2.8."""

from __future__ import annotations

from reports.tables.cylinder import cylinder_table_id
from reports.tables.extremes import extreme_columns
from reports.tables.spec import Block, Column, TableSpec

INDEX = Column("phi_deg", None)


def torque_tables(cylinders: int, rows: tuple[float, ...]) -> tuple[Block, ...]:
    """Tables П4.2, П4.4 and П4.5 with the torques of the pin sections by statics."""
    numbers = range(1, cylinders + 1)
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
    return torque, _main(cylinders, rows), _pin(cylinders, rows), _statics(cylinders, rows)


def _main(cylinders: int, rows: tuple[float, ...]) -> TableSpec:
    columns = [INDEX, Column("Mmain2_Nm", "P4_2.M1_Nm", "Гоц, 2.8")]
    for i in range(2, cylinders + 1):
        columns.append(Column(f"M{i}_Nm", f"P4_2.M{i}_Nm", "П4.2"))
        columns.append(Column(f"Mmain{i + 1}_Nm", f"Mmain{i}_Nm + M{i}_Nm", "Гоц, 2.8"))
    title = "Набегающие моменты на коренные шейки"
    return TableSpec("P4_4", "П4.4", title, "П4.4", tuple(columns), rows)


def _pin(cylinders: int, rows: tuple[float, ...]) -> TableSpec:
    columns = [INDEX, Column("Mpin1_Nm", "0.5*P4_2.M1_Nm", "Гоц, 2.8")]
    for i in range(2, cylinders + 1):
        columns.append(Column(f"M{i}_Nm", f"P4_2.M{i}_Nm", "П4.2"))
        columns.append(Column(f"Mpin{i}_Nm", f"P4_4.Mmain{i}_Nm + 0.5*M{i}_Nm", "Гоц, 2.8"))
    title = "Набегающие моменты на шатунные шейки"
    return TableSpec("P4_5", "П4.5", title, "П4.5", tuple(columns), rows)


def _statics(cylinders: int, rows: tuple[float, ...]) -> TableSpec:
    columns = [INDEX]
    for i in range(1, cylinders + 1):
        before = f"P4_4.Mmain{i}_Nm + " if i > 1 else ""
        source = f"{cylinder_table_id(i)}.T_MPa"
        columns.append(
            Column(
                f"Mpins{i}_Nm",
                f"{before}r_crank*((1 - throw{i}_share)*of_MPa({source})*F_piston"
                f" + throw{i}_RTCL + throw{i}_side)",
                "статика левой половины колена",
            )
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
