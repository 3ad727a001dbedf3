"""Rod bearing, bending of the crankpin, continuous shaft: Gots 2.6, 2.7 and (54)."""

from __future__ import annotations

from kshm.engine.arrangement import throws as throws_of
from kshm.results.pin_bearing import PLANES
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import arrangement_of
from reports.spec.blocks import Block, Column, Grid, GridRow, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, over_phi, polar
from reports.spec.extremes import NEVER, TIE, extreme_columns, extreme_scalars
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape, rods_table
from reports.tables.loads.cylinder import cylinder_table_id

BEARING, BENDING, SHAFT = "Шатунный подшипник", "Изгиб шейки", "Неразрезная схема"
RESULTS = "Схемы опор"
INDEX = Column("phi_deg", None)
_UNIT = "r_crank*omega**2"


def bearings(scope: Scope) -> Part:
    """All blocks that apply to the layout."""
    model, rows = scope.input, scope.cycle
    arrangement = arrangement_of(model)
    blocks: list[Block] = []
    if all(c.master is None for c in arrangement):
        blocks += [_rod_bearing(rows), *_bearing_results()]
    if all(c.pin_angle == 0 for c in arrangement):
        blocks += [_bending(model, rows), *_bending_results(model)]
    if has_continuous(model):
        blocks += [_beam(model), _pivots(model), _continuous(model, rows), _compared(model)]
    return Part(tuple(blocks), _charts(model))


def has_continuous(model: InputFile) -> bool:
    """Whether there are inner supports and rods that pull at undivided pins."""
    whole = all(c.pin_angle == 0 and c.master is None for c in arrangement_of(model))
    forced = model.crankshaft.force_offsets_deg is not None
    return len(model.crankshaft.throw_angles_deg) > 1 and whole and not forced


def _rod_bearing(rows: tuple[float, ...]) -> TableSpec:
    turn = "rad(phi_deg) + P4_1.beta_rad"
    return TableSpec(
        "rod_bearing",
        "Ш.п",
        "Нагрузка на шатунный подшипник в осях шатуна",
        BEARING,
        (
            INDEX,
            Column("Kown_MPa", f"P4_1.K_MPa - to_MPa(m_2*{_UNIT}/F_piston)", "Гоц (40)",
                   helper=True, of="Krod_MPa"),
            *column_list(f"""
                Bx_MPa = Kown_MPa*sin({turn}) - P4_1.T_MPa*cos({turn})
                    | Гоц, 2.6: поворот на 180° + φ + β
                By_MPa = Kown_MPa*cos({turn}) + P4_1.T_MPa*sin({turn})
                    | Гоц, 2.6: поворот на 180° + φ + β
                B_MPa = sqrt(Bx_MPa**2 + By_MPa**2) | Гоц, 2.6
            """),
            *extreme_columns("B_MPa", "B"),
        ),
        rows,
        note=(
            "Каждый вектор нагрузки на шейку повернут на 180° + φ + β: он противоположен и отнесён "
            "к неподвижному шатуну. Ось y — вдоль шатуна к поршню, x — поперёк, по вращению вала."
        ),
    )  # fmt: skip


def _bearing_results() -> tuple[Block, ...]:
    extremes = extreme_scalars("rod_bearing", "B_MPa", "B", "Гоц, 2.6")
    mean = Scalar("B_mean", "col_mean(rod_bearing.B_MPa)", "Гоц, 2.6")
    cells = scalar_list("""
        B_box1 of box = -B_max | оси диаграммы
        B_box2 of box = B_max | оси диаграммы
    """)
    box = Grid(
        "rod_bearing_box", "Оси полярной диаграммы", BEARING, ("−", "+"), (GridRow("box", cells),)
    )
    title = "Нагрузка на шатунный подшипник"
    return ScalarTable("rod_bearing_list", title, BEARING, (mean, *extremes)), box


def _bending(model: InputFile, rows: tuple[float, ...]) -> TableSpec:
    """Projections of R_к on planes through the pin's axis, Gots 2.6."""
    single = Shape.of(model).single_rods
    inward = "crankpin.Ksum_MPa" if single else f"{rods_table(1)}.Ksum_MPa"
    ahead = "crankpin.T_MPa" if single else f"{rods_table(1)}.Tsum_MPa"
    planes = [
        Column(
            f"plane{i}_MPa",
            f"{inward}*cos(rad({10 * (i - 1)})) + T_MPa*sin(rad({10 * (i - 1)}))",
            "Гоц, 2.6, рис. 31",
        )
        for i in range(1, PLANES + 1)
    ]
    return TableSpec(
        "pin_bending",
        "Ш.и",
        "Изгиб шатунной шейки в плоскости масляного отверстия и в плоскостях через 10°",
        BENDING,
        (
            INDEX,
            Column("T_MPa", ahead, "Гоц (37)", helper=True),
            *column_list(f"""
                Ralpha_MPa = {inward}*cos(rad(alpha_oil_deg)) + T_MPa*sin(rad(alpha_oil_deg))
                    | Гоц, 2.6
                Malpha_Nm = of_MPa(Ralpha_MPa)*F_piston*of_mm(throw1_length)/4 | Гоц, 2.6: Rl/4
            """),
            *planes,
        ),
        rows,
        note=(
            "Проекция силы Rк на плоскость отверстия: KΣ·cosα + T·sinα, момент — как у балки на "
            "двух опорах с силой посередине пролёта l, то есть для симметричного колена. Угол α "
            "отсчитан от колена против вращения; плоскость № i наклонена к колену на 10°(i − 1)."
        ),
    )


def _bending_results(model: InputFile) -> tuple[Block, ...]:
    lever = "F_piston*of_mm(throw1_length)/4"
    own = "crankshaft_oil_hole_deg" if model.crankshaft.oil_hole_deg is not None else "hole_pin_deg"
    numbers = range(1, PLANES + 1)
    column = "pin_bending.plane{i}_MPa"
    swing = f"of_MPa(col_max({column}) - col_min({column}))*{lever}/2"
    names = [f"swing{i}" for i in numbers]
    low = f"min({', '.join(names)})"
    rows = (
        GridRow("plane_deg", tuple(
            Scalar(f"plane_deg{i}", f"({i} - 1)*180/{PLANES}", "плоскости", of="plane_deg")
            for i in numbers)),
        GridRow("plane_swing", tuple(
            Scalar(f"swing{i}", swing.format(i=i), "Гоц, 2.6", of="plane_swing")
            for i in numbers)),
        GridRow("plane_best", tuple(
            Scalar(f"plane_best{i}", f"plane_deg{i} if swing{i} <= {low} + {TIE}*max(1, {low})"
                   f" else {NEVER}", "наименьший размах", of="plane_best") for i in numbers)),
    )  # fmt: skip
    labels = tuple(str(i) for i in numbers)
    grid = Grid("planes", "Размах момента по плоскостям", BENDING, labels, rows)
    best = f"min({', '.join(f'plane_best{i}' for i in numbers)})"
    t = "pin_bending"
    return grid, ScalarTable(
        "bending_list",
        "Изгиб шатунной шейки",
        BENDING,
        (
            Scalar("alpha_oil_deg", own, "задано" if "oil" in own else "Гоц, 2.6: по износу"),
            *scalar_list(f"""
                Ralpha_max = col_max({t}.Ralpha_MPa) | Гоц, 2.6
                Ralpha_min = col_min({t}.Ralpha_MPa) | Гоц, 2.6
                Malpha_max = col_max({t}.Malpha_Nm) | Гоц, 2.6
                Malpha_min = col_min({t}.Malpha_Nm) | Гоц, 2.6
                Malpha_swing = (Malpha_max - Malpha_min)/2 | амплитуда
                Malpha_mean = (Malpha_max + Malpha_min)/2 | среднее цикла
                alpha_best_deg = {best} | плоскость наименьшей амплитуды
                Mbest_swing = {low} | наименьшая амплитуда
            """),
        ),
    )


def _groups(model: InputFile) -> list[list[tuple[int, str]]]:
    """Cylinders (from 1) of every throw with the name of the rod's place."""
    arrangement = arrangement_of(model)
    return [
        [(c + 1, "b" if arrangement[c].rod_place else "a") for c in group]
        for group in throws_of(arrangement)
    ]


def _beam(model: InputFile) -> Grid:
    """Load terms of every span: rods by their coefficients, centrifugal forces by themselves."""
    columns = [_span(i, group) for i, group in enumerate(_groups(model), 1)]
    ends = _overhangs(len(columns))
    keys = list(dict.fromkeys(key for column in columns for key in column))
    rows = [GridRow(key, tuple(column.get(key) for column in columns)) for key in keys]
    for key in ("end_x", "end_y"):
        cells = [None] * len(columns)
        row: list[Scalar | None] = list(cells)
        row[0], row[-1] = ends[f"{key}1"], ends[f"{key}2"]
        rows.append(GridRow(key, tuple(row)))
    return Grid(
        "beam",
        "Грузовые члены уравнений трёх моментов",
        RESULTS,
        tuple(f"пролёт {i}" for i in range(1, len(columns) + 1)),
        tuple(rows),
        note=(
            "Вал — прямая балка постоянной жёсткости при изгибе в обеих плоскостях на жёстких "
            "соосных опорах. Оси вала: x — влево, если смотреть с носка, y — вверх в плоскости "
            "первого колена. Момент положителен, если его создала бы сила вдоль оси на простой "
            "балке. В (54) второй индекс последнего момента прочитан как П (правая опора)."
        ),
    )


def _span(i: int, group: list[tuple[int, str]]) -> dict[str, Scalar]:
    t, p = f"throw_{i}", f"throw{i}_"
    near = f"({t}_l1_mm + {t}_left_web_mm + {t}_l2_mm)"
    length = f"of_mm({p}length)"
    places = {
        "a": f"of_mm{near}",
        "b": f"of_mm({near} + {t}_l3_mm + {t}_l4_mm)",
        "pin": f"of_mm({near} + {t}_l3_mm)",
        "left": f"of_mm({t}_l1_mm + {t}_left_web_mm/2)",
        "right": f"({length} - of_mm({t}_l6_mm + {t}_right_web_mm/2))",
    }

    def right(at: str) -> str:
        return f"{at}*({length}**2 - {at}**2)/{length}"

    def left(at: str) -> str:
        return f"({length} - {at})*({length}**2 - ({length} - {at})**2)/{length}"

    cells: dict[str, Scalar] = {}
    for name in dict.fromkeys(place for _, place in group):
        for side, term in (("A", right), ("B", left)):
            key = f"beam{side}{name}"
            cells[key] = Scalar(f"beam{i}_{side}{name}", term(places[name]), "три момента", of=key)
    spin = f"m_2*{_UNIT}"
    for side, term in (("A", right), ("B", left)):
        rods = " + ".join(f"{spin}*beam{i}_{side}{name}" for _, name in group)
        ups = (
            f"{rods} + {p}C4*({term(places['pin'])})"
            f" + ({p}C2 - {p}C1)*({term(places['left'])})"
            f" + ({p}C6 - {p}C7)*({term(places['right'])})"
        )
        sides = (
            f"({p}C8 + {p}C14)*({term(places['left'])})"
            f" + ({p}C9 + {p}C15)*({term(places['right'])})"
        )
        for axis, text in (("U", ups), ("L", sides)):
            key = f"beam{side}{axis}"
            cells[key] = Scalar(f"beam{i}_{side}{axis}", text, "центробежные силы", of=key)
    return cells


def _overhangs(throws: int) -> dict[str, Scalar]:
    """Moments of the external counterweights at the end supports in shaft axes [N·m]."""
    found = {}
    for end, throw, side, up, arm, sign in (
        (1, 1, "C10", "C11", "crankshaft_nose_arm_mm", "-"),
        (2, throws, "C12", "C13", "crankshaft_rear_arm_mm", ""),
    ):
        gamma = f"rad(throw_angle_{throw}_deg)"
        across, along = f"({sign}throw{throw}_{side})", f"throw{throw}_{up}"
        x = f"-({across}*cos({gamma}) - {along}*sin({gamma}))*of_mm({arm})"
        y = f"-({across}*sin({gamma}) + {along}*cos({gamma}))*of_mm({arm})"
        found[f"end_x{end}"] = Scalar(f"end_x{end}", x, "вынос противовеса", of="end_x")
        found[f"end_y{end}"] = Scalar(f"end_y{end}", y, "вынос противовеса", of="end_y")
    return found


def _pivots(model: InputFile) -> Grid:
    """Diagonal of the equations after elimination, for every inner support."""
    throws = len(model.crankshaft.throw_angles_deg)
    cells = []
    for k in range(2, throws + 1):
        text = f"2*of_mm(throw{k - 1}_length + throw{k}_length)"
        if k > 2:
            text += f" - of_mm(throw{k - 1}_length)**2/pivot{k - 1}"
        cells.append(Scalar(f"pivot{k}", text, "исключение неизвестных", of="pivot"))
    labels = tuple(f"опора {k}" for k in range(2, throws + 1))
    title = "Исключение неизвестных в уравнениях трёх моментов"
    return Grid("pivots", title, RESULTS, labels, (GridRow("pivot", tuple(cells)),))


def _continuous(model: InputFile, rows: tuple[float, ...]) -> TableSpec:
    groups, throws = _groups(model), len(model.crankshaft.throw_angles_deg)
    columns: list[Column] = [INDEX]
    inner = range(2, throws + 1)
    for i, group in enumerate(groups, 1):
        for axis, force in (("U", "K"), ("L", "T")):
            for side in ("A", "B"):
                rods = "".join(
                    f" - beam{i}_{side}{name}*of_MPa({cylinder_table_id(c)}.{force}_MPa)*F_piston"
                    for c, name in group
                )
                columns.append(
                    Column(f"load{i}_{side}{axis}", f"beam{i}_{side}{axis}{rods}", "грузовой член",
                           helper=True, of=f"load_{side}{axis}")
                )  # fmt: skip
    for axis in "xy":
        for k in inner:
            known = f"-({_turned(k - 1, 'A', axis)} + {_turned(k, 'B', axis)})"
            if k == 2:
                known += f" - of_mm(throw1_length)*end_{axis}1"
            if k == throws:
                known += f" - of_mm(throw{throws}_length)*end_{axis}2"
            if k > 2:
                known += f" - of_mm(throw{k - 1}_length)*step{axis}{k - 1}"
            text = f"({known})/pivot{k}"
            columns.append(Column(f"step{axis}{k}", text, "исключение", helper=True, of="step_m"))
        for k in reversed(inner):
            after = f" - of_mm(throw{k}_length)/pivot{k}*Ms{axis}{k + 1}_Nm" if k < throws else ""
            text = f"step{axis}{k}{after}"
            columns.append(Column(f"Ms{axis}{k}_Nm", text, "Гоц (54)"))
    for k in range(1, throws + 2):
        for axis in "xy":
            extra = _correction(k, throws, axis)
            split = f"P4_3_{k}.R{axis}_MPa"
            text = f"{split} + to_MPa(({extra})/F_piston)"
            columns.append(Column(f"Rc{axis}{k}_MPa", text, "Гоц (54), (55)"))
        columns.append(Column(f"Rc{k}_MPa", f"sqrt(Rcx{k}_MPa**2 + Rcy{k}_MPa**2)", "Гоц (59)"))
    return TableSpec(
        "continuous",
        "Н",
        "Реакции опор неразрезного вала по уравнениям трёх моментов",
        SHAFT,
        tuple(_sorted(columns)),
        rows,
        note="К реакциям разрезной схемы добавлены поправки (54) от опорных моментов.",
    )


def _sorted(columns: list[Column]) -> list[Column]:
    """Helpers last, moments by support: as the solver lists them."""
    results = [c for c in columns if not c.helper]
    moments = [c for c in results if c.key.startswith("Ms")]
    rest = [c for c in results if not c.key.startswith("Ms")]
    moments.sort(key=lambda c: (int(c.key[3:-3]), c.key[2]))
    return [rest[0], *moments, *rest[1:], *(c for c in columns if c.helper)]


def _turned(throw: int, side: str, axis: str) -> str:
    """Load term of a span in an axis of the shaft."""
    gamma = f"rad(throw_angle_{throw}_deg)"
    left, up = f"load{throw}_{side}L", f"load{throw}_{side}U"
    if axis == "x":
        return f"{left}*cos({gamma}) - {up}*sin({gamma})"
    return f"{left}*sin({gamma}) + {up}*cos({gamma})"


def _correction(k: int, throws: int, axis: str) -> str:
    """What the inner support moments add to a support's reaction [N], Gots (54)."""

    def moment(support: int) -> str:
        return f"Ms{axis}{support}_Nm" if 2 <= support <= throws else "0"

    parts = []
    if k > 1:
        parts.append(f"-({moment(k - 1)} - {moment(k)})/of_mm(throw{k - 1}_length)")
    if k <= throws:
        parts.append(f"-({moment(k + 1)} - {moment(k)})/of_mm(throw{k}_length)")
    return " + ".join(f"({part})" for part in parts)


def _compared(model: InputFile) -> Grid:
    """Both schemes side by side for every support."""
    throws = len(model.crankshaft.throw_angles_deg)
    numbers = range(1, throws + 2)

    def row(of: str, key: str, text: str, source: str) -> GridRow:
        return GridRow(
            of, tuple(Scalar(key.format(k=k), text.format(k=k), source, of=of) for k in numbers)
        )

    projected = "(of_mm(crankshaft_main_diameter_mm)*of_mm(main_length_{k}_mm))"
    return Grid(
        "schemes",
        "Разрезная и неразрезная схемы",
        RESULTS,
        tuple(f"опора {k}" for k in numbers),
        (
            row("Rsplit_mean", "Rsplit{k}_mean", "Rmain{k}_mean", "разрезная схема"),
            row("Rc_mean", "Rc{k}_mean", "col_mean(continuous.Rc{k}_MPa)", "Гоц (54)"),
            row("dRc_mean", "dRc{k}_mean", "(Rc{k}_mean/Rmain{k}_mean - 1)*100", "сравнение"),
            row("Rsplit_max", "Rsplit{k}_max", "Rmain{k}_max", "разрезная схема"),
            row("Rc_max", "Rc{k}_max", "col_max(continuous.Rc{k}_MPa)", "Гоц (54)"),
            row("dRc_max", "dRc{k}_max", "(Rc{k}_max/Rmain{k}_max - 1)*100", "сравнение"),
            row("qc_max", "qc{k}_max", f"Rc{{k}}_max*F_piston/{projected}", "Гоц, 2.6"),
        ),
    )


def _charts(model: InputFile) -> tuple[ChartSpec, ...]:
    """Diagrams of the bearings, bending in the hole's plane, both schemes over the angle."""
    arrangement = arrangement_of(model)
    journals = range(1, len(model.crankshaft.throw_angles_deg) + 2)
    of = "нагрузки на {} подшипник"
    made: list[ChartSpec] = []
    if all(c.master is None for c in arrangement):
        made.append(
            polar("rod_bearing", BEARING, "Нагрузка на шатунный подшипник",
                  ("поперёк шатуна, МПа", "вдоль шатуна к поршню, МПа"), "rod_bearing_box.box",
                  Series("rod_bearing.Bx_MPa", "rod_bearing.By_MPa", "B"),
                  caption=f"Полярная диаграмма {of.format('шатунный')}")
        )  # fmt: skip
    if all(c.pin_angle == 0 for c in arrangement):
        made.append(
            over_phi("pin_bending", BENDING, "Момент, изгибающий шейку в плоскости отверстия",
                     "M, Н·м", "pin_bending.Malpha_Nm", figure="31",
                     caption="Момент, изгибающий шатунную шейку в плоскости масляного отверстия")
        )  # fmt: skip
    made += [
        polar(f"main_bearing_{k}", f"П4.3 ({k})", f"Нагрузка на коренной подшипник {k}",
              ("Qx, МПа (влево)", "Qy, МПа"), f"P4_3_{k}_box.box",
              Series(f"P4_3_{k}.block_x_MPa", f"P4_3_{k}.block_y_MPa", "Q"), x_reversed=True,
              caption=f"Полярная диаграмма {of.format('коренной')} {k}")
        for k in journals
    ]  # fmt: skip
    if has_continuous(model):
        x = "continuous.phi_deg"
        made += [
            over_phi(f"continuous_{k}", SHAFT, f"Опора {k}: разрезная и неразрезная схемы",
                     "R, МПа", Series(x, f"P4_3_{k}.R_MPa", "разрезная"),
                     Series(x, f"continuous.Rc{k}_MPa", "неразрезная"),
                     caption=f"Реакция опоры {k} по двум схемам")
            for k in journals
        ]  # fmt: skip
    return tuple(made)
