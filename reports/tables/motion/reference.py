"""Tables 1-3 and 5-8 for any λ, figures 3-10 and 20 of the textbook."""

from __future__ import annotations

from collections.abc import Iterable

from kshm.results.reference import FIGURE_6
from reports.shared.russian import short
from reports.spec.blocks import Block, Column, Grid, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, columns_of, line, over_phi, polar
from reports.spec.listing import column_list, corners, grid_row, scalar_list
from reports.spec.parts import Part, Scope, stepped

MOTION, SPEED = "Движение поршня по λ", "Скорость поршня по λ"
VECTORS, SKETCH = "Векторы сил инерции", "Построение скорости"
KINEMATIC, FORCES = "Таблицы кинематики", "Таблицы сил"
INDEX = Column("phi_deg", None)
_PHI = "rad(phi_deg)"
_BETA = f"asin({{lam}}*sin({_PHI}))"

# number → title, sheet, formula, source
TABLES: dict[str, tuple[str, str, str, str]] = {
    "1": ("(1 − cos φ) + λ/4·(1 − cos 2φ)", KINEMATIC,
          f"(1 - cos({_PHI})) + {{lam}}/4*(1 - cos(2*{_PHI}))", "Гоц (3), табл. 1"),
    "2": ("sin φ + λ/2·sin 2φ", KINEMATIC,
          f"sin({_PHI}) + {{lam}}/2*sin(2*{_PHI})", "Гоц (4), табл. 2"),
    "3": ("cos φ + λ·cos 2φ", KINEMATIC,
          f"cos({_PHI}) + {{lam}}*cos(2*{_PHI})", "Гоц (6), табл. 3"),
    "5": ("tg β", FORCES, f"tan({_BETA})", "Гоц (34), табл. 5"),
    "6": ("1/cos β", FORCES, f"1/cos({_BETA})", "Гоц (35), табл. 6"),
    "7": ("sin(φ + β)/cos β", FORCES, f"sin({_PHI} + {_BETA})/cos({_BETA})", "Гоц (37), табл. 7"),
    "8": ("cos(φ + β)/cos β", FORCES, f"cos({_PHI} + {_BETA})/cos({_BETA})", "Гоц (36), табл. 8"),
}  # fmt: skip


def reference(scope: Scope) -> Part:
    """Figure 20 always, the other tables where the input has a section [reference]."""
    asked = scope.input.reference
    blocks: list[Block] = [_vectors(scope.turn), *_vector_boxes()]
    if asked is None:
        return Part(tuple(blocks), _vector_charts())
    count = len(asked.lambdas)
    half, whole = stepped(0, 180, 10), stepped(0, 360, 10)
    for number in TABLES:
        blocks.append(_table(number, count, half))
    blocks += [_lambdas(sheet, count) for sheet in (KINEMATIC, FORCES)]
    return Part(
        (*blocks, _motion(whole), _figure_6(), _sketch(), *_drawing()),
        (*_vector_charts(), *_charts(asked.lambdas)),
    )


def _table(number: str, count: int, rows: tuple[float, ...]) -> TableSpec:
    title, sheet, text, source = TABLES[number]
    columns = [
        Column(f"ref_lambda{i}", text.format(lam=f"reference_lambda_{i}_value"), source)
        for i in range(1, count + 1)
    ]
    return TableSpec(
        f"ref_{number}",
        number,
        f"Значение выражения {title}",
        sheet,
        (INDEX, *columns),
        rows,
        note="Для углов от 180 до 360°: таблицы 1, 3, 6, 8 чётны, таблицы 2, 5, 7 нечётны по φ.",
        step=10.0,
    )


def _lambdas(sheet: str, count: int) -> Grid:
    key = "kin" if sheet == KINEMATIC else "dyn"
    numbers = range(1, count + 1)
    texts = (f"reference_lambda_{i}_value" for i in numbers)
    row = grid_row("lambda_value", texts, "исходные данные", f"ref_{key}{{n}}")
    return Grid(f"ref_{key}_list", "Значения λ", sheet, tuple(f"λ{i}" for i in numbers), (row,))


def _motion(rows: tuple[float, ...]) -> TableSpec:
    root = f"sqrt(1 - lam**2*sin({_PHI})**2)"
    return TableSpec(
        "ref_motion",
        "3–10",
        "Движение поршня и шатуна по гармоникам при λ двигателя",
        MOTION,
        (
            INDEX,
            *column_list(f"""
                s1_rel = 1 - cos({_PHI}) | Гоц (3), рис. 3
                s2_rel = lam/4*(1 - cos(2*{_PHI})) | Гоц (3), рис. 3
                s_rel = s1_rel + s2_rel | Гоц (3), рис. 3
                v1_rel = sin({_PHI}) | Гоц (4), рис. 4
                v2_rel = lam/2*sin(2*{_PHI}) | Гоц (4), рис. 4
                v_rel = v1_rel + v2_rel | Гоц (4), рис. 4
                j1_rel = cos({_PHI}) | Гоц (6), рис. 7
                j2_rel = lam*cos(2*{_PHI}) | Гоц (6), рис. 7
                j_rel = j1_rel + j2_rel | Гоц (6), рис. 7
                omega_rod_rel = lam*cos({_PHI})/{root} | Гоц (8), рис. 10
                omega_rod_near_rel = lam*cos({_PHI}) | Гоц (8), рис. 10
                eps_rod_rel = -(lam*(1 - lam**2)*sin({_PHI})/{root}**3) | Гоц, рис. 10
                eps_rod_near_rel = -(lam*sin({_PHI})) | Гоц, рис. 10
            """),
        ),
        rows,
        note="Перемещение отнесено к r, скорость к rω, ускорение к rω²; у шатуна — к ω и ω².",
        step=10.0,
    )  # fmt: skip


def _figure_6() -> TableSpec:
    first, last, step = FIGURE_6
    quarter = "1/(4*lambda_value)"
    return TableSpec(
        "ref_fig6",
        "6",
        "Угол наибольшей скорости и отношение скоростей в зависимости от λ",
        SPEED,
        column_list(f"""
            lambda_value
            phi_vmax_deg = deg(acos(sqrt(({quarter})**2 + 1/2) - {quarter})) | Гоц (5)
            vmax_rel = sin(rad(phi_vmax_deg)) + lambda_value/2*sin(2*rad(phi_vmax_deg))
                | Гоц (4), 1.2
            v_ratio = pi/2*vmax_rel | Гоц, рис. 6
            v1_ratio = pi/2*(lambda_value/lambda_value) | Гоц, 1.2: 1,57
        """),
        stepped(first, last, step),
        step=step,
    )


def _vectors(rows: tuple[float, ...]) -> TableSpec:
    size = "-(m_j*r_crank*omega**2)"
    return TableSpec(
        "vectors",
        "20",
        "Векторы сил инерции первого и второго порядков",
        VECTORS,
        (
            INDEX,
            *column_list(f"""
                Pj1_kN = to_kN({size}*cos({_PHI})) | Гоц (31)
                Pj2_kN = to_kN(lam*({size})*cos(2*{_PHI})) | Гоц (31)
                C1_x_kN = to_kN({size}*sin({_PHI})) | Гоц, рис. 20, а
                C1_y_kN = to_kN({size}*cos({_PHI})) | Гоц, рис. 20, а
                C2_x_kN = to_kN(lam*({size})*sin(2*{_PHI})) | Гоц, рис. 20, б
                C2_y_kN = to_kN(lam*({size})*cos(2*{_PHI})) | Гоц, рис. 20, б
                rose1_x_kN = Pj1_kN*sin({_PHI}) | Гоц, рис. 20, в
                rose1_y_kN = Pj1_kN*cos({_PHI}) | Гоц, рис. 20, в
                rose2_x_kN = Pj2_kN*sin({_PHI}) | Гоц, рис. 20, г
                rose2_y_kN = Pj2_kN*cos({_PHI}) | Гоц, рис. 20, г
            """),
        ),
        rows,
        note=(
            "C = −mj·r·ω²: вектор первого порядка вращается с угловой скоростью ω, второго — с 2ω; "
            "силы равны их проекциям на ось цилиндра. В полярных координатах длина луча под углом "
            "φ равна силе при этом угле, отрицательная сила отложена в обратную сторону."
        ),
    )


def _vector_boxes() -> tuple[Block, ...]:
    """Sizes of the vectors, which also keep the axes of the diagrams equal."""
    sizes = ScalarTable(
        "vector_sizes",
        "Длины векторов",
        VECTORS,
        scalar_list("""
            C_vector = to_kN(m_j*r_crank*omega**2) | Гоц (31)
            C2_vector = lam*C_vector | Гоц (31)
        """),
    )
    boxes = (
        corners(f"{name}_box", "Оси диаграммы", VECTORS, f"{name}_box", size, "box_kN")
        for name, size in (("vector1", "C_vector"), ("vector2", "C2_vector"))
    )
    return (sizes, *boxes)


def _sketch() -> ScalarTable:
    phi = "rad(reference_angle_deg)"
    return ScalarTable(
        "sketch",
        "Графическое определение скорости поршня",
        SKETCH,
        scalar_list(f"""
            draw_B_x = sin({phi}) | Гоц, рис. 5
            draw_B_y = cos({phi}) | Гоц, рис. 5
            draw_beta_deg = deg(asin(lam*sin({phi}))) | Гоц (7)
            draw_A_y = draw_B_y + cos(rad(draw_beta_deg))/lam | Гоц (1)
            draw_H_x = sin({phi} + rad(draw_beta_deg))/cos(rad(draw_beta_deg))
                | Гоц, 1.2: vп = rω·OH/OB
        """),
        note=(
            "Ось шатуна отсекает на диаметре, перпендикулярном оси цилиндра, отрезок OH; "
            "в масштабе, в котором OB = rω, он равен скорости поршня. Длины — в долях r."
        ),
    )


def _drawing() -> tuple[Grid, ...]:
    """Polylines of the mechanism: O-B-A, A-H, H-O and the box that keeps the axes equal."""

    def points(
        name: str, key: str, title: str, labels: Iterable[str], x: list[str], y: list[str]
    ) -> Grid:
        source = "окружность кривошипа" if name == "circle" else "Гоц, рис. 5"
        rows = (
            grid_row(f"draw_{axis}", texts, source, f"{key}_{axis}{{n}}")
            for axis, texts in (("x", x), ("y", y))
        )
        return Grid(f"draw_{name}", title, SKETCH, tuple(labels), tuple(rows))

    numbers, steps = ("1", "2", "3"), range(0, 375, 15)
    return (
        points("links", "links", "Точки схемы", numbers,
               ["0", "draw_B_x", "0"], ["0", "draw_B_y", "draw_A_y"]),
        points("cut", "cut", "Точки схемы", numbers,
               ["0", "draw_H_x", "0"], ["draw_A_y", "0", "0"]),
        points("circle", "circle5", "Окружность кривошипа", (f"{d}°" for d in steps),
               [f"sin(rad({d}))" for d in steps], [f"cos(rad({d}))" for d in steps]),
        corners("draw_box", "Оси схемы", SKETCH, "draw_box", "(1 + 1/lam)", "draw_x", "оси"),
    )  # fmt: skip


def _vector_charts() -> tuple[ChartSpec, ...]:
    return (
        _vector_chart("fig20a", "20, а, в", "первого", "1", "C"),
        _vector_chart("fig20b", "20, б, г", "второго", "2", "λC"),
        over_phi("fig20p", VECTORS, "Силы инерции первого и второго порядков", "Pj, кН",
                 "vectors.Pj1_kN", "vectors.Pj2_kN", figure="20"),
    )  # fmt: skip


def _charts(lambdas: tuple[float, ...]) -> tuple[ChartSpec, ...]:
    def motion(figure: str, title: str, y: str, keys: str, caption: str = "") -> ChartSpec:
        columns = columns_of("ref_motion", *keys.split())
        return over_phi(f"ref_fig{figure}", MOTION, title, y, *columns, figure=figure,
                        caption=caption)  # fmt: skip

    curves = (
        Series("ref_3.phi_deg", f"ref_3.ref_lambda{i}", f"λ{i} = {short(value, 4)}")
        for i, value in enumerate(lambdas[:6], 1)
    )
    x = "ref_fig6.lambda_value"
    return (
        motion("3", "Перемещение поршня", "s/r", "s_rel s1_rel s2_rel",
               "Перемещение поршня и его гармоники"),
        motion("4", "Скорость поршня", "v/(rω)", "v_rel v1_rel v2_rel",
               "Скорость поршня и её гармоники"),
        motion("7", "Ускорение поршня", "j/(rω²)", "j_rel j1_rel j2_rel",
               "Ускорение поршня и его гармоники"),
        motion("10", "Угловые скорость и ускорение шатуна", "ω/ω, ε/ω²",
               "omega_rod_rel eps_rod_rel"),
        over_phi("ref_fig8", MOTION, "Ускорение поршня при разных λ", "j/(rω²)", *curves,
                 figure="8"),
        line("ref_fig6a", SPEED, "Угол наибольшей скорости поршня", ("λ", "φ, °"),
             Series(x, "ref_fig6.phi_vmax_deg"), figure="6", from_zero=False),
        line("ref_fig6b", SPEED, "Отношение наибольшей скорости к средней", ("λ", "v/cm"),
             Series(x, "ref_fig6.v_ratio"), Series(x, "ref_fig6.v1_ratio", only="workbook"),
             figure="6", from_zero=False,
             caption="Отношение наибольшей скорости поршня к средней"),
        polar("ref_fig5", SKETCH, "Графическое определение скорости поршня", ("x/r", "y/r"),
              "draw_box.draw_x",
              Series("draw_circle.draw_x", "draw_circle.draw_y", "кривошип"),
              Series("draw_links.draw_x", "draw_links.draw_y", "звенья"),
              Series("draw_cut.draw_x", "draw_cut.draw_y", "отрезок OH"), figure="5, 9"),
    )  # fmt: skip


def _vector_chart(chart: str, figure: str, word: str, order: str, vector: str) -> ChartSpec:
    x, y = (f"vectors.{{}}{order}_{axis}_kN" for axis in "xy")
    return polar(
        chart,
        VECTORS,
        f"Сила инерции {word} порядка",
        ("кН", "кН"),
        f"vector{order}_box.box_kN",
        Series(x.format("C"), y.format("C"), f"конец вектора {vector}", only="workbook"),
        Series(x.format("rose"), y.format("rose"), f"Pj{order}"),
        figure=figure,
        caption=f"Сила инерции {word} порядка в полярных координатах",
        x_tex="кН",
        y_tex="кН",
    )
