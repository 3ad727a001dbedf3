"""Crankpin, throws and main journals: (40)-(60), П4.3 with the columns of table 10."""

from __future__ import annotations

from reports.spec.blocks import Block, Column, Grid, GridRow, Scalar, TableSpec
from reports.spec.charts import ChartSpec, Series, columns_of, over_phi, polar
from reports.spec.extremes import extreme_columns
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape, pin_name, rods_table
from reports.tables.loads.cylinder import cylinder_table_id
from reports.tables.loads.torques import rod_shares

_SPLIT = "rad(crankshaft_split_pin_deg)"
NOISE = "0.000000001"  # MPa: rounding noise of zero would turn an angle round


def crankpin_table(shape: Shape, number: int, rows: tuple[float, ...]) -> TableSpec:
    """Loads on a crankpin, Gots (40)-(42), of all rods that turn on it."""
    group, name = shape.pins[number - 1], pin_name(number)
    rods = sum(not shape.is_hung(cylinder) for cylinder in group)
    centrifugal = "K_r_rod" if rods == 1 else f"{rods}*K_r_rod"
    sheet = f"Шатунная шейка {name}".strip()
    title = "Удельные нагрузки на шатунную шейку" + (f" {number}" if len(shape.pins) > 1 else "")
    columns = [Column("phi_deg", None)]
    for axis, formula in (("T", "Гоц (37)"), ("K", "Гоц (36)")):
        terms = " + ".join(f"{cylinder_table_id(i)}.{axis}_MPa" for i in group)
        columns.append(Column(f"{axis}_MPa", terms, formula if len(group) == 1 else "Гоц, 2.6"))
    columns += [
        *column_list(f"""
            Krod_MPa = K_MPa - {centrifugal} | Гоц (40)
            Rpin_MPa = sqrt(Krod_MPa**2 + T_MPa**2) | Гоц (41)
            psi_deg = {angle("T_MPa", "Krod_MPa")} | Гоц, 2.6: tgψ = T/(K − Kr ш)
        """),
    ]
    if shape.single_rods:
        title = "Удельные нагрузки на шатунную шейку и колено"
        columns += [
            *column_list("""
                Ksum_MPa = Krod_MPa - K_r_throw | Гоц (42)
                Rthrow_MPa = sqrt(Ksum_MPa**2 + T_MPa**2) | Гоц (42)
            """),
        ]
    return TableSpec(
        "crankpin" if number == 1 else f"crankpin_{number}",
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
            f"На шейке шатуны цилиндров {group[0]} и {group[1]}; их силы сложены без учета "
            "расстояния между ними вдоль шейки."
        )
    if shape.split:
        notes.append("Шейка разделена: на каждой половине один шатун; оси — своей половины.")
    return " ".join(notes)


def rods_tables(shape: Shape, rows: tuple[float, ...]) -> tuple[Block, ...]:
    """Forces of both rods on every throw in its frame; none where throws carry one rod."""
    if shape.single_rods:
        return ()
    return tuple(_rods(shape, throw, rows) for throw in range(1, shape.throws + 1))


def _rods(shape: Shape, throw: int, rows: tuple[float, ...]) -> TableSpec:
    """Sums for the main journals and the force R_к, Gots 2.6, 2.7 and (42)."""
    left, right = (cylinder_table_id(i) for i in shape.groups[throw - 1])
    turned = {"T": f"{right}.T_MPa", "K": f"{right}.K_MPa"}
    # Half of the pin's mass stands in the direction of each half of a split pin.
    up, ahead = "1", ""
    pin, rods = "crankshaft_pin_mass_kg", "2*K_r_rod"
    if shape.articulated:
        rods = "K_r_rod"
    if shape.split:
        cos, sin = f"cos({_SPLIT})", f"sin({_SPLIT})"
        turned = {
            "T": f"{right}.T_MPa*{cos} - {right}.K_MPa*{sin}",
            "K": f"{right}.K_MPa*{cos} + {right}.T_MPa*{sin}",
        }
        up, rods = f"(1 + {cos})/2", f"(1 + {cos})*K_r_rod"
        own = f"to_MPa({pin}/2*r_crank*omega**2/F_piston)"
        ahead = f" + {sin}*(K_r_rod + {own})"
    mass = f"({pin}*{up} + web_{2 * throw - 1}_mass_kg + web_{2 * throw}_mass_kg)"
    throw_force = f"to_MPa({mass}*r_crank*omega**2/F_piston)"
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
            T_MPa = Tleft_MPa + Tright_MPa | Гоц, 2.6
            K_MPa = Kleft_MPa + Kright_MPa | Гоц, 2.6
            Rthrow_MPa = sqrt(Ksum_MPa**2 + Tsum_MPa**2) | Гоц (42)
            Mthrow_Nm of Mthrow{throw}_Nm = {left}.M_Nm + {right}.M_Nm | Гоц, 2.8
            helpers:
            Ksum_MPa = K_MPa - {rods} - {throw_force} | Гоц (42)
            Tsum_MPa of T_MPa = T_MPa{ahead} | Гоц (42)
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
        f"0 if abs({side}) < {NOISE} and {along} >= 0"
        f" else 180 if abs({side}) < {NOISE} else deg(atan2({side}, {along}))"
    )


def throws_grid(shape: Shape) -> Grid:
    """Centrifugal forces C1…C15 and constant reactions of each throw, Gots (44)-(49)."""
    throws = shape.throws
    columns = [_throw(i, shape) for i in range(1, throws + 1)]
    keys = list(dict.fromkeys(key for column in columns for key in column))
    return Grid(
        "throws",
        "Центробежные силы колен и реакции опор от них",
        "Колена",
        tuple(f"колено {i}" for i in range(1, throws + 1)),
        tuple(GridRow(key, tuple(column.get(key) for column in columns)) for key in keys),
        note=(
            "Ось y — вдоль колена от оси вала, ось x — поперёк него против вращения. Угол щеки "
            "отсчитан от колена против вращения, угол противовеса — от направления, обратного "
            "колену, по вращению; внешний противовес на носке — от первого колена по вращению, "
            "у маховика — от последнего колена против вращения. В (48) и (49) учебника знаки при "
            "C11 и C13 противоположны статике; здесь они исправлены."
        ),
    )


def _throw(i: int, shape: Shape) -> dict[str, Scalar]:
    throws, second = shape.throws, _has_second_rod(shape)
    left, right, t = f"web_{2 * i - 1}", f"web_{2 * i}", f"throw_{i}"
    unit = "r_crank*omega**2"

    def force(mass: str, turn: str) -> str:
        return f"{mass}*{unit}*{turn}"

    def webs(key: str, web: str, part: str, turn: str) -> tuple[str, str]:
        mass, degrees = (
            (f"{web}_counterweight_kg", f"{web}_counterweight_angle_deg")
            if part == "counterweight"
            else (f"{web}_mass_kg", f"{web}_angle_deg")
        )
        return key, force(mass, f"{turn}(rad({degrees}))")

    forces = dict(
        [
            webs("C1", left, "counterweight", "cos"),
            webs("C2", left, "web", "cos"),
            ("C3", f"m_2*{unit}"),
            ("C4", f"crankshaft_pin_mass_kg*{unit}{_split_share(shape)}"),
            webs("C6", right, "web", "cos"),
            webs("C7", right, "counterweight", "cos"),
            webs("C8", left, "counterweight", "sin"),
            webs("C9", right, "counterweight", "sin"),
            webs("C14", left, "web", "sin"),
            webs("C15", right, "web", "sin"),
        ]
    )
    if second:
        forces["C5"] = f"m_2*{unit}" + (f"*cos({_SPLIT})" if shape.split else "")
    if shape.split:
        forces["C5x"] = f"-(m_2*{unit}*sin({_SPLIT}))"
        forces["C4x"] = f"-(crankshaft_pin_mass_kg*{unit}*sin({_SPLIT})/2)"
    if i == 1:
        nose = "rad(crankshaft_nose_angle_deg)"
        forces["C10"] = force("crankshaft_nose_mass_kg", f"sin({nose})")
        forces["C11"] = force("crankshaft_nose_mass_kg", f"cos({nose})")
    if i == throws:
        rear = "rad(crankshaft_rear_angle_deg)"
        forces["C12"] = force("crankshaft_rear_mass_kg", f"sin({rear})")
        forces["C13"] = force("crankshaft_rear_mass_kg", f"cos({rear})")
    h_left, h_right = f"{t}_left_web_mm", f"{t}_right_web_mm"
    rod = f"{t}_l1_mm + {h_left} + {t}_l2_mm"
    rest = f"{t}_l3_mm + {t}_l4_mm + {t}_l5_mm + {h_right} + {t}_l6_mm"
    cells = {
        "length": Scalar(f"throw{i}_length", f"{rod} + {rest}", "Гоц, рис. 35"),
        "share": Scalar(f"throw{i}_share", f"({rod})/throw{i}_length", "Гоц (50)"),
        **_second_share(i, rod, second=second),
        **{key: Scalar(f"throw{i}_{key}", text, "Гоц, рис. 35") for key, text in forces.items()},
        **_reactions(i, shape, rod, rest),
    }
    side = f"throw{i}_C14 + throw{i}_C8" + (f" - throw{i}_C10" if i == 1 else "")
    cells["side"] = Scalar(f"throw{i}_side", side, "Гоц, рис. 35")
    return cells


def _has_second_rod(shape: Shape) -> bool:
    """Whether a second rod turns on the pin; an articulated one does not."""
    return not shape.single_rods and not shape.articulated


def _second_share(i: int, rod: str, *, second: bool) -> dict[str, Scalar]:
    if not second:
        return {}
    place = f"{rod} + throw_{i}_l3_mm + throw_{i}_l4_mm"
    return {"share2": Scalar(f"throw{i}_share2", f"({place})/throw{i}_length", "Гоц (50)")}


def _split_share(shape: Shape) -> str:
    """Share of a split pin's force along the throw: half of it stands ahead."""
    return f"*(1 + cos({_SPLIT}))/2" if shape.split else ""


def _reactions(i: int, shape: Shape, rod: str, rest: str) -> dict[str, Scalar]:
    throws = shape.throws
    p, t = f"throw{i}_", f"throw_{i}"
    length = f"{p}length"
    left = f"({t}_l1_mm + {t}_left_web_mm/2)"
    right = f"({t}_l6_mm + {t}_right_web_mm/2)"
    pin_left, pin_right = f"({rod} + {t}_l3_mm)", f"({rest} - {t}_l3_mm)"
    far_left, far_right = f"({length} - {right})", f"({length} - {left})"
    rkp = (
        f"(({p}C1 - {p}C2)*{left} - {p}C3*({rod}) - {p}C4*{pin_left}"
        f" - ({p}C6 - {p}C7)*{far_left})/{length}"
    )
    rtp = f"-((({p}C8 + {p}C14)*{left} + ({p}C9 + {p}C15)*{far_left})/{length})"
    rkl = (
        f"(({p}C7 - {p}C6)*{right} - {p}C4*{pin_right} - {p}C3*({rest})"
        f" - ({p}C2 - {p}C1)*{far_right})/{length}"
    )
    rtl = f"-((({p}C9 + {p}C15)*{right} + ({p}C8 + {p}C14)*{far_right})/{length})"
    if _has_second_rod(shape):
        between = f"({t}_l3_mm + {t}_l4_mm)"
        far, near = f"({rod} + {between})", f"({rest} - {between})"
        rkp += f" - {p}C5*{far}/{length}"
        rkl += f" - {p}C5*{near}/{length}"
    if shape.split:
        rtp += f" - ({p}C5x*{far} + {p}C4x*{pin_left})/{length}"
        rtl += f" - ({p}C5x*{near} + {p}C4x*{pin_right})/{length}"
    sources = {"RKCP": "Гоц (44)", "RTCP": "Гоц (45)", "RKCL": "Гоц (46)", "RTCL": "Гоц (47)"}
    texts = {"RKCP": rkp, "RTCP": rtp, "RKCL": rkl, "RTCL": rtl}
    if i == 1:
        arm = "crankshaft_nose_arm_mm"
        texts["RKCP"] += f" + {p}C11*{arm}/{length}"
        texts["RTCP"] += f" - {p}C10*{arm}/{length}"
        texts["RKCL"] += f" - {p}C11*({arm} + {length})/{length}"
        texts["RTCL"] += f" + {p}C10*({arm} + {length})/{length}"
        sources = {key: f"{source}, (48)" for key, source in sources.items()}
    if i == throws:
        arm = "crankshaft_rear_arm_mm"
        texts["RKCP"] += f" - {p}C13*({arm} + {length})/{length}"
        texts["RTCP"] += f" - {p}C12*({arm} + {length})/{length}"
        texts["RKCL"] += f" + {p}C13*{arm}/{length}"
        texts["RTCL"] += f" + {p}C12*{arm}/{length}"
        sources = {key: f"{source}, (49)" for key, source in sources.items()}
    return {key: Scalar(f"{p}{key}", text, sources[key]) for key, text in texts.items()}


def journal_table(shape: Shape, number: int, rows: tuple[float, ...], *, forced: bool) -> TableSpec:
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
            columns += [
                *column_list(f"""
                    {name}_MPa = {rods} + {constant} | {formula}
                    {name}cos_MPa = {name}_MPa*cos({gamma}) | Гоц, табл. 10
                    {name}sin_MPa = {name}_MPa*sin({gamma}) | Гоц, табл. 10
                """),
            ]
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


def box(table: str, name: str, sheet: str) -> Grid:
    """Corners that keep both axes of a polar diagram equal whatever the loads become."""
    cells = scalar_list(f"""
        {name}_box1 of box = -{name}_max | оси диаграммы
        {name}_box2 of box = {name}_max | оси диаграммы
    """)
    return Grid(
        f"{table}_box", "Оси полярной диаграммы", sheet, ("−", "+"), (GridRow("box", cells),)
    )


def journals(scope: Scope) -> Part:
    """Crankpins, throws and every main journal."""
    shape, rows = scope.shape, scope.cycle
    numbers, pins = range(1, shape.throws + 2), range(1, len(shape.pins) + 1)
    crankpins = [crankpin_table(shape, number, rows) for number in pins]
    tables = [journal_table(shape, k, rows, forced=scope.forced) for k in numbers]
    boxes = [
        box(table.id, f"Rpin{pin_name(number)}", table.sheet)
        for number, table in enumerate(crankpins, 1)
    ]
    boxes += [box(f"P4_3_{k}", f"Rmain{k}", f"П4.3 ({k})") for k in numbers]
    return Part(
        (*rods_tables(shape, rows), *crankpins, throws_grid(shape), *tables, *boxes),
        (*_pin_charts(shape), *_journal_charts(shape)),
    )


def _pin_charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """Figures 50 and 51 of every crankpin; in the report the forces of two rods on a throw."""
    made = [] if shape.single_rods else list(_rods_charts(rods_table(1)))
    for number in range(1, len(shape.pins) + 1):
        n = pin_name(number)
        end = f"_{n}" if n else ""
        name, table = f" {number}" if len(shape.pins) > 1 else "", f"crankpin{end}"
        sheet = f"Шатунная шейка {n}".strip()
        of = f"на шатунную шейку{name}"
        # The report's captions number only the further pins.
        caption = f"на шатунную шейку {n}".strip()
        made += [
            polar(f"fig50{end}", sheet, f"Полярная диаграмма нагрузки {of}",
                  ("T, МПа", "K − Kr ш, МПа (вниз — к оси вала)"), f"{table}_box.box",
                  Series(f"{table}.T_MPa", f"{table}.Krod_MPa", "R′ш.ш", only="workbook"),
                  Series(f"{table}.T_MPa", f"{table}.K_MPa", "R′ш.ш", only="report"),
                  figure="50", y_reversed=True,
                  caption=f"Полярная диаграмма удельной нагрузки {caption}"),
            over_phi(f"fig51{end}", sheet, f"Нагрузка {of}", "R, МПа", f"{table}.Rpin_MPa",
                     figure="51", levels=(f"Rpin{n}_mean",), extremes=True,
                     caption=f"Развёрнутая диаграмма нагрузки {caption}"),
        ]  # fmt: skip
    return tuple(made)


def _rods_charts(table: str) -> tuple[ChartSpec, ...]:
    return (
        over_phi("rods_T", "", "Тангенциальные силы двух шатунов первого колена и их сумма",
                 "T, МПа", *columns_of(table, "Tleft_MPa", "Tright_MPa", "T_MPa")),
        over_phi("rods_R", "", "Удельная сила, действующая на первое колено", "R, МПа",
                 f"{table}.Rthrow_MPa"),
    )  # fmt: skip


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
