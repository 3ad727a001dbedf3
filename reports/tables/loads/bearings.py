"""Rod and main bearings, bending of the crankpin: Gots 2.6."""

from __future__ import annotations

from kshm.mechanics.pin_bearing import PLANES
from reports.spec.blocks import Block, Grid, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, over_phi, polar
from reports.spec.extremes import TIE, extreme_columns, extreme_scalars
from reports.spec.listing import column_list, grid_row, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape, rods_table
from reports.tables.loads.crankpins import polar_box

BEARING, BENDING = "Шатунный подшипник", "Изгиб шейки"


def bearings(scope: Scope) -> Part:
    """Loads on the bearings and what bends the crankpin, where the layout has them."""
    shape, rows = scope.shape, scope.cycle
    blocks: list[Block] = []
    charts: list[ChartSpec] = []
    if not shape.articulated:
        blocks += [_rod_bearing(rows), *_bearing_results()]
        charts.append(
            polar("rod_bearing", BEARING, "Нагрузка на шатунный подшипник",
                  ("поперёк шатуна, МПа", "вдоль шатуна к поршню, МПа"), "rod_bearing_box.box",
                  Series("rod_bearing.Bx_MPa", "rod_bearing.By_MPa", "R′ш.п"),
                  caption="Полярная диаграмма нагрузки на шатунный подшипник")
        )  # fmt: skip
    if not shape.split:
        first = " 1" if shape.throws > 1 else ""
        given = scope.input.crankshaft.oil_hole_deg is not None
        blocks += [_bending(shape, rows), *_bending_results(given=given)]
        charts.append(
            over_phi("pin_bending", BENDING, "Момент, изгибающий шейку в плоскости отверстия",
                     "M, Н·м", "pin_bending.Malpha_Nm", figure="31",
                     caption=f"Момент, изгибающий шатунную шейку{first} в плоскости масляного"
                             " отверстия")
        )  # fmt: skip
    charts += [
        polar(f"main_bearing_{k}", f"П4.3 ({k})", f"Нагрузка на коренной подшипник {k}",
              ("R′к.п x, МПа (влево)", "R′к.п y, МПа"), f"P4_3_{k}_box.box",
              Series(f"P4_3_{k}.block_x_MPa", f"P4_3_{k}.block_y_MPa", "R′к.п"), x_reversed=True,
              caption=f"Полярная диаграмма нагрузки на коренной подшипник {k}")
        for k in range(1, shape.throws + 2)
    ]  # fmt: skip
    return Part(tuple(blocks), tuple(charts))


def _rod_bearing(rows: tuple[float, ...]) -> TableSpec:
    turn, source = "rad(phi_deg) + P4_1.beta_rad", "Гоц, 2.6: поворот на 180° + φ + β"
    return TableSpec(
        "rod_bearing",
        "Ш.п",
        "Нагрузка на шатунный подшипник в осях шатуна",
        BEARING,
        (
            *column_list("phi_deg"),
            *column_list("""
                helpers:
                Kown_MPa of Krod_MPa = P4_1.K_MPa - to_MPa(m_2*r_crank*omega**2/F_piston)
                    | Гоц (40)
            """),
            *column_list(f"""
                Bx_MPa = Kown_MPa*sin({turn}) - P4_1.T_MPa*cos({turn}) | {source}
                By_MPa = Kown_MPa*cos({turn}) + P4_1.T_MPa*sin({turn}) | {source}
                B_MPa = sqrt(Bx_MPa**2 + By_MPa**2) | Гоц, 2.6
            """),
            *extreme_columns("B_MPa", "B"),
        ),
        rows,
        note=(
            "Каждый вектор нагрузки на шейку повёрнут на 180° + φ + β: он противоположен и отнесён "
            "к неподвижному шатуну. Ось y — вдоль шатуна к поршню, x — поперёк, по вращению вала."
        ),
    )


def _bearing_results() -> tuple[Block, ...]:
    mean = scalar_list("B_mean = col_mean(rod_bearing.B_MPa) | Гоц, 2.6")
    extremes = extreme_scalars("rod_bearing", "B_MPa", "B", "Гоц, 2.6")
    return (
        ScalarTable(
            "rod_bearing_list", "Нагрузка на шатунный подшипник", BEARING, (*mean, *extremes)
        ),
        polar_box("rod_bearing", "B", BEARING),
    )


def _bending(shape: Shape, rows: tuple[float, ...]) -> TableSpec:
    """Projections of R_к on planes through the pin's axis, Gots 2.6."""
    inward, ahead, across = "crankpin.Ksum_MPa", "crankpin.T_MPa", "T_MPa"
    if not shape.single_rods:
        inward, ahead = f"{rods_table(1)}.Ksum_MPa", f"{rods_table(1)}.Tsum_MPa"
        across = "T_MPa of Tthrow_MPa"

    def on(plane: str) -> str:
        return f"{inward}*cos(rad({plane})) + T_MPa*sin(rad({plane}))"

    return TableSpec(
        "pin_bending",
        "Ш.и",
        "Изгиб шатунной шейки в плоскости масляного отверстия и в плоскостях через 10°",
        BENDING,
        (
            *column_list("phi_deg"),
            *column_list(f"helpers:\n{across} = {ahead} | Гоц (37)"),
            *column_list(
                f"Ralpha_MPa = {on('alpha_oil_deg')} | Гоц, 2.6",
                "Malpha_Nm = of_MPa(Ralpha_MPa)*F_piston*of_mm(throw1_length)/4 | Гоц, 2.6: Rl/4",
                *(
                    f"plane{i}_MPa = {on(str(10 * (i - 1)))} | Гоц, 2.6, рис. 31"
                    for i in range(1, PLANES + 1)
                ),
            ),
        ),
        rows,
        note=(
            "Проекция силы Rк на плоскость отверстия: KΣ·cosα + T·sinα, момент — как у балки на "
            "двух опорах с силой посередине пролёта l, то есть для симметричного колена. Угол α "
            "отсчитан от колена против вращения; плоскость № i наклонена к колену на 10°(i − 1)."
        ),
    )


def _bending_results(*, given: bool) -> tuple[Block, ...]:
    numbers = range(1, PLANES + 1)
    t, plane = "pin_bending", "pin_bending.plane{i}_MPa"
    swing = f"of_MPa(col_max({plane}) - col_min({plane}))*F_piston*of_mm(throw1_length)/4/2"
    low = "col_min(planes.plane_swing)"
    best = f"plane_deg{{i}} if swing{{i}} < {low} + {TIE} else plane_deg{PLANES}"
    grid = Grid(
        "planes",
        "Размах момента по плоскостям",
        BENDING,
        tuple(map(str, numbers)),
        (
            grid_row("plane_deg", (f"({i} - 1)*180/{PLANES}" for i in numbers), "плоскости"),
            grid_row("plane_swing", (swing.format(i=i) for i in numbers), "Гоц, 2.6", "swing{n}"),
            grid_row("plane_best", (best.format(i=i) for i in numbers), "наименьший размах"),
        ),
    )
    hole = "crankshaft_oil_hole_deg | задано" if given else "hole_pin_deg | Гоц, 2.6: по износу"
    found = scalar_list(f"""
        alpha_oil_deg = {hole}
        Ralpha_max = col_max({t}.Ralpha_MPa) | Гоц, 2.6
        Ralpha_min = col_min({t}.Ralpha_MPa) | Гоц, 2.6
        Malpha_max = col_max({t}.Malpha_Nm) | Гоц, 2.6
        Malpha_min = col_min({t}.Malpha_Nm) | Гоц, 2.6
        Malpha_swing = (Malpha_max - Malpha_min)/2 | амплитуда
        Malpha_mean = (Malpha_max + Malpha_min)/2 | среднее цикла
        alpha_best_deg = col_min(planes.plane_best)
            | плоскость наименьшей амплитуды
        Mbest_swing = {low} | наименьшая амплитуда
    """)
    return grid, ScalarTable("bending_list", "Изгиб шатунной шейки", BENDING, found)
