"""Crankpin, throws and main journals: (40)-(60), П4.3 with the columns of table 10."""

from __future__ import annotations

from reports.tables.cylinder import cylinder_table_id
from reports.tables.extremes import extreme_columns
from reports.tables.spec import Block, Column, Grid, GridRow, Scalar, TableSpec

NOISE = "0.000000001"  # MPa: rounding noise of zero would turn an angle round


def crankpin_table(rows: tuple[float, ...]) -> TableSpec:
    """Loads on the crankpin of throw 1, Gots (40)-(42)."""
    return TableSpec(
        "crankpin",
        "Ш",
        "Удельные нагрузки на шатунную шейку и колено",
        "Шатунная шейка",
        (
            Column("phi_deg", None),
            Column("T_MPa", "P4_1.T_MPa", "Гоц (37)"),
            Column("K_MPa", "P4_1.K_MPa", "Гоц (36)"),
            Column("Krod_MPa", "K_MPa - K_r_rod", "Гоц (40)"),
            Column("Rpin_MPa", "sqrt(Krod_MPa**2 + T_MPa**2)", "Гоц (41)"),
            Column("psi_deg", angle("T_MPa", "Krod_MPa"), "Гоц, 2.6: tgψ = T/(K − Kr ш)"),
            Column("Ksum_MPa", "Krod_MPa - K_r_throw", "Гоц (42)"),
            Column("Rthrow_MPa", "sqrt(Ksum_MPa**2 + T_MPa**2)", "Гоц (42)"),
            *extreme_columns("Rpin_MPa", "Rpin"),
        ),
        rows,
        note="K положительна к оси вала; центробежная сила массы m2 направлена от оси вала.",
    )


def angle(side: str, along: str) -> str:
    """Angle of a vector from its second component [deg], steady where the first vanishes."""
    return (
        f"0 if abs({side}) < {NOISE} and {along} >= 0"
        f" else 180 if abs({side}) < {NOISE} else deg(atan2({side}, {along}))"
    )


def throws_grid(throws: int) -> Grid:
    """Centrifugal forces C1…C15 and constant reactions of each throw, Gots (44)-(49)."""
    columns = [_throw(i, throws) for i in range(1, throws + 1)]
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


def _throw(i: int, throws: int) -> dict[str, Scalar]:
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
            ("C4", f"crankshaft_pin_mass_kg*{unit}"),
            webs("C6", right, "web", "cos"),
            webs("C7", right, "counterweight", "cos"),
            webs("C8", left, "counterweight", "sin"),
            webs("C9", right, "counterweight", "sin"),
            webs("C14", left, "web", "sin"),
            webs("C15", right, "web", "sin"),
        ]
    )
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
        **{key: Scalar(f"throw{i}_{key}", text, "Гоц, рис. 35") for key, text in forces.items()},
        **_reactions(i, throws, rod, rest),
    }
    side = f"throw{i}_C14 + throw{i}_C8" + (f" - throw{i}_C10" if i == 1 else "")
    cells["side"] = Scalar(f"throw{i}_side", side, "Гоц, рис. 35")
    return cells


def _reactions(i: int, throws: int, rod: str, rest: str) -> dict[str, Scalar]:
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


def journal_table(number: int, throws: int, rows: tuple[float, ...], *, forced: bool) -> TableSpec:
    """Reactions on main journal ``number`` with the columns of table 10, Gots (56)-(60)."""
    columns = [Column("phi_deg", None)]
    x_terms, y_terms = [], []
    for side, throw, support in (("a", number - 1, "P"), ("b", number, "L")):
        if not 1 <= throw <= throws:
            continue
        source = f"forced_{throw}" if forced else cylinder_table_id(throw)
        share = f"throw{throw}_share" if support == "P" else f"(1 - throw{throw}_share)"
        gamma = f"rad(throw_angle_{throw}_deg)"
        for axis, formula in (("T", "Гоц (51), (53), (55)"), ("K", "Гоц (50), (52), (55)")):
            constant = f"to_MPa(throw{throw}_R{axis}C{support}/F_piston)"
            name = f"{side}{axis}"
            columns += [
                Column(f"{name}_MPa", f"{share}*{source}.{axis}_MPa + {constant}", formula),
                Column(f"{name}cos_MPa", f"{name}_MPa*cos({gamma})", "Гоц, табл. 10"),
                Column(f"{name}sin_MPa", f"{name}_MPa*sin({gamma})", "Гоц, табл. 10"),
            ]
        x_terms += [f"{side}Tcos_MPa", f"-{side}Ksin_MPa"]
        y_terms += [f"{side}Tsin_MPa", f"{side}Kcos_MPa"]
    turn = "rad(phi_deg)"
    columns += [
        Column("Rx_MPa", " + ".join(x_terms).replace("+ -", "- "), "Гоц (56), (58)"),
        Column("Ry_MPa", " + ".join(y_terms), "Гоц (57), (58)"),
        Column("R_MPa", "sqrt(Rx_MPa**2 + Ry_MPa**2)", "Гоц (59)"),
        Column("psiR_deg", angle("Rx_MPa", "Ry_MPa"), "Гоц (60)"),
        Column(
            "block_x_MPa", f"-(Rx_MPa*cos({turn}) - Ry_MPa*sin({turn}))", "нагрузка на подшипник"
        ),
        Column(
            "block_y_MPa", f"-(Rx_MPa*sin({turn}) + Ry_MPa*cos({turn}))", "нагрузка на подшипник"
        ),
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


def box(table: str, name: str, sheet: str) -> Grid:
    """Corners that keep both axes of a polar diagram equal whatever the loads become."""
    cells = (
        Scalar(f"{name}_box1", f"-{name}_max", "оси диаграммы", of="box"),
        Scalar(f"{name}_box2", f"{name}_max", "оси диаграммы", of="box"),
    )
    return Grid(
        f"{table}_box", "Оси полярной диаграммы", sheet, ("−", "+"), (GridRow("box", cells),)
    )


def journal_blocks(throws: int, rows: tuple[float, ...], *, forced: bool) -> tuple[Block, ...]:
    """Crankpin, throws and every main journal."""
    tables = [journal_table(k, throws, rows, forced=forced) for k in range(1, throws + 2)]
    boxes = [box("crankpin", "Rpin", "Шатунная шейка")]
    boxes += [box(f"P4_3_{k}", f"Rmain{k}", f"П4.3 ({k})") for k in range(1, throws + 2)]
    return crankpin_table(rows), throws_grid(throws), *tables, *boxes
