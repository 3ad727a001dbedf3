"""Crankpins and the rods on them: (40)-(42), figures 50 and 51, Gots 2.6."""

from __future__ import annotations

from reports.spec.blocks import Block, Column, Grid, TableSpec
from reports.spec.charts import ChartSpec, Series, columns_of, over_phi, polar
from reports.spec.extremes import extreme_columns
from reports.spec.listing import column_list, corners
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape, cylinder_table_id, pin_figure, pin_name, pin_table, rods_table

SPLIT = "rad(crankshaft_split_pin_deg)"


def crankpins(scope: Scope) -> Part:
    """Forces of two rods on a throw, loads on every crankpin."""
    shape, rows = scope.shape, scope.cycle
    pins = [_crankpin(shape, number, rows) for number in range(1, len(shape.pins) + 1)]
    boxes = (
        polar_box(table.id, f"Rpin{pin_name(n)}", table.sheet) for n, table in enumerate(pins, 1)
    )
    return Part((*_rods_tables(shape, rows), *pins, *boxes), _pin_charts(shape))


def polar_box(table: str, name: str, sheet: str) -> Grid:
    """Corners of the polar diagram of a load."""
    title = "Оси полярной диаграммы"
    return corners(f"{table}_box", title, sheet, f"{name}_box", f"{name}_max")


def throw_pull(throw: int) -> str:
    """Specific centrifugal force of a throw's own mass, that of its counterweights left out."""
    if throw == 1:
        return "K_r_throw"
    webs = f"web_{2 * throw - 1}_mass_kg + web_{2 * throw}_mass_kg"
    return f"to_MPa((crankshaft_pin_mass_kg + {webs})*r_crank*omega**2/F_piston)"


def _centrifugal(shape: Shape, number: int) -> str:
    """Specific centrifugal force of the rods that turn with a crankpin."""
    rods = sum(not shape.is_hung(cylinder) for cylinder in shape.pins[number - 1])
    return "K_r_rod" if rods == 1 else f"{rods}*K_r_rod"


def _crankpin(shape: Shape, number: int, rows: tuple[float, ...]) -> TableSpec:
    """Loads on a crankpin, Gots (40)-(42), of all rods that turn on it."""
    group, name = shape.pins[number - 1], pin_name(number)
    centrifugal = _centrifugal(shape, number)
    sheet = f"Шатунная шейка {name}".strip()
    title = "Удельные нагрузки на шатунную шейку" + (f" {number}" if len(shape.pins) > 1 else "")
    columns = [Column("phi_deg", None)]
    for axis, formula in (("T", "Гоц (37)"), ("K", "Гоц (36)")):
        terms = " + ".join(f"{cylinder_table_id(i)}.{axis}_MPa" for i in group)
        if len(group) == 1:
            columns.append(Column(f"{axis}_MPa", terms, formula))
        else:
            columns.append(Column(f"{axis}_MPa", terms, "Гоц, 2.6", of=f"{axis}throw_MPa"))
    normal = "Krod_MPa" if len(group) == 1 else "Krod_MPa of Kpin_MPa"
    columns += column_list(f"""
        {normal} = K_MPa - {centrifugal} | Гоц (40)
        Rpin_MPa = sqrt(Krod_MPa**2 + T_MPa**2) | Гоц (41)
        psi_deg = {angle("T_MPa", "Krod_MPa")} | Гоц, 2.6: tgψ = T/(K − Kr ш)
    """)
    if shape.single_rods:
        title = "Удельные нагрузки на шатунную шейку и колено"
        columns += column_list(f"""
            Ksum_MPa = Krod_MPa - {throw_pull(number)} | Гоц (42)
            Rthrow_MPa = sqrt(Ksum_MPa**2 + T_MPa**2) | Гоц (42)
        """)
    return TableSpec(
        pin_table(number),
        f"Ш{name}",
        title,
        sheet,
        (*columns, *extreme_columns("Rpin_MPa", f"Rpin{name}")),
        rows,
        note=_pin_note(shape, group),
    )


def _pin_note(shape: Shape, group: tuple[int, ...]) -> str:
    notes = ["K положительна к оси вала; центробежная сила массы m2 направлена от оси вала."]
    if len(group) > 1:
        notes.append(
            f"На шейке шатуны цилиндров {group[0]} и {group[1]}; их силы сложены без учёта "
            "расстояния между ними вдоль шейки."
        )
    if shape.split:
        notes.append("Шейка разделена: на каждой половине один шатун; оси — своей половины.")
    return " ".join(notes)


def _rods_tables(shape: Shape, rows: tuple[float, ...]) -> tuple[Block, ...]:
    """Forces of both rods on every throw in its frame; none where throws carry one rod."""
    if shape.single_rods:
        return ()
    return tuple(_rods(shape, throw, rows) for throw in range(1, shape.throws + 1))


def _rods(shape: Shape, throw: int, rows: tuple[float, ...]) -> TableSpec:
    """Sums for the main journals and the force R_к, Gots 2.6, 2.7 and (42)."""
    left, right = (cylinder_table_id(i) for i in shape.groups[throw - 1])
    turned = {"T": f"{right}.T_MPa", "K": f"{right}.K_MPa"}
    # Half of the pin's mass stands in the direction of each half of a split pin.
    ahead = ""
    pin, rods = "crankshaft_pin_mass_kg", "2*K_r_rod"
    on_throw = pin
    if shape.articulated:
        rods = "K_r_rod"
    if shape.split:
        cos, sin = f"cos({SPLIT})", f"sin({SPLIT})"
        turned = {
            "T": f"{right}.T_MPa*{cos} - {right}.K_MPa*{sin}",
            "K": f"{right}.K_MPa*{cos} + {right}.T_MPa*{sin}",
        }
        on_throw, rods = f"{pin}*(1 + {cos})/2", f"(1 + {cos})*K_r_rod"
        own = f"to_MPa({pin}/2*r_crank*omega**2/F_piston)"
        ahead = f" + {sin}*(K_r_rod + {own})"
    mass = f"({on_throw} + web_{2 * throw - 1}_mass_kg + web_{2 * throw}_mass_kg)"
    throw_force = f"to_MPa({mass}*r_crank*omega**2/F_piston)"
    across = "Tsum_MPa" if ahead else "Tthrow_MPa"
    source = "Гоц, 2.7, рис. 36"
    return TableSpec(
        rods_table(throw),
        f"К{throw}",
        f"Силы двух шатунов на колене {throw}",
        f"Колено {throw}",
        column_list(f"""
            phi_deg
            Tleft_MPa = {left}.T_MPa | {source}
            Kleft_MPa = {left}.K_MPa | {source}
            Tright_MPa = {turned["T"]} | {source}
            Kright_MPa = {turned["K"]} | {source}
            T_MPa of Tthrow_MPa = Tleft_MPa + Tright_MPa | Гоц, 2.6
            K_MPa of Kthrow_MPa = Kleft_MPa + Kright_MPa | Гоц, 2.6
            Rthrow_MPa = sqrt(Ksum_MPa**2 + Tsum_MPa**2) | Гоц (42)
            Mthrow_Nm of Mthrow{throw}_Nm = {left}.M_Nm + {right}.M_Nm | Гоц, 2.8
            helpers:
            Ksum_MPa = K_MPa - {rods} - {throw_force} | Гоц (42)
            Tsum_MPa of {across} = T_MPa{ahead} | Гоц (42)
        """),
        rows,
        note=(
            f"Левый шатун (ближе к носку) — цилиндра {shape.groups[throw - 1][0]}, правый — "
            f"цилиндра {shape.groups[throw - 1][1]}; силы в осях колена."
        ),
    )


def angle(side: str, along: str) -> str:
    """Angle of a vector from its second component [deg], steady where the first vanishes."""
    return (
        # Rounding noise of zero would turn an angle round.
        f"(0 if round({along}, 9) >= 0 else 180) if round({side}, 9) == 0"
        f" else deg(atan2({side}, {along}))"
    )


def _pin_charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """Figures 50 and 51 of every crankpin; in the report the forces of two rods on a throw."""
    made = [] if shape.single_rods else list(_rods_charts(rods_table(1)))
    for number in range(1, len(shape.pins) + 1):
        n = pin_name(number)
        name, table = f" {number}" if len(shape.pins) > 1 else "", pin_table(number)
        sheet = f"Шатунная шейка {n}".strip()
        of = f"на шатунную шейку{name}"
        made += [
            polar(pin_figure("fig50", number), sheet, f"Полярная диаграмма нагрузки {of}",
                  ("T, МПа", "K − Kr ш, МПа (вниз — к оси вала)"), f"{table}_box.box",
                  Series(f"{table}.T_MPa", f"{table}.Krod_MPa", "R′ш.ш", only="workbook"),
                  Series(f"{table}.T_MPa", f"{table}.K_MPa", "R′ш.ш", only="report"),
                  figure="50", y_reversed=True, poles=_poles(shape, number),
                  caption=f"Полярная диаграмма удельной нагрузки {of}"),
            over_phi(pin_figure("fig51", number), sheet, f"Нагрузка {of}", "R, МПа",
                     f"{table}.Rpin_MPa", figure="51", levels=(f"Rpin{n}_mean",), extremes=True,
                     caption=f"Развёрнутая диаграмма нагрузки {of}"),
        ]  # fmt: skip
    return tuple(made)


def _poles(shape: Shape, number: int) -> tuple[tuple[str, str], ...]:
    """From where the loads on the crankpin and on a throw of one rod are measured."""
    rod = _centrifugal(shape, number)
    poles = ((r"O_{\mathrm{ш}}", rod), (r"O_{\mathrm{к}}", f"{rod} + {throw_pull(number)}"))
    return poles if shape.single_rods else poles[:1]


def _rods_charts(table: str) -> tuple[ChartSpec, ...]:
    return (
        over_phi("rods_T", "", "Тангенциальные силы двух шатунов первого колена и их сумма",
                 "T, МПа", *columns_of(table, "Tleft_MPa", "Tright_MPa", "T_MPa")),
        over_phi("rods_R", "", "Удельная сила, действующая на первое колено", "R, МПа",
                 f"{table}.Rthrow_MPa"),
    )  # fmt: skip
