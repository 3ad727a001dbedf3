"""Balancing: free forces and moments by orders, rotating masses, shafts, firing orders."""

from __future__ import annotations

from collections.abc import Iterable

from reports.tables.spec import (
    Block,
    ChartSpec,
    Column,
    Grid,
    GridRow,
    Scalar,
    ScalarTable,
    Series,
    TableSpec,
)

SHEET, ORDERS_SHEET, FIRING_SHEET = "Уравновешивание", "Порядки сил", "Порядки работы"
RESULTS = "Уравновешивание, итоги"
LAST_ORDER = 8
MAX_CYLINDERS = 7
_NOTHING = "0.000000001"


def _grid(throws: int) -> Grid:
    """Centrifugal forces of each throw and their moments about the middle of the shaft."""
    cells: dict[str, list[Scalar]] = {}
    half = " + ".join(f"throw{i}_length" for i in range(1, throws + 1))
    for i in range(1, throws + 1):
        p, t = f"throw{i}_", f"throw_{i}"
        start = f"-(({half})/2)" if i == 1 else f"throw{i - 1}_z_left + throw{i - 1}_length"
        z, rod = f"{p}z_left", f"{p}z_rod"
        left = f"({z} + {t}_l1_mm + {t}_left_web_mm/2)"
        right = f"({z} + {p}length - {t}_l6_mm - {t}_right_web_mm/2)"
        pin = f"({rod} + {t}_l3_mm)"
        loads = {
            "up_bare": [(f"{p}C2", left), (f"{p}C3", rod), (f"{p}C4", pin), (f"{p}C6", right)],
            "side_bare": [(f"{p}C14", left), (f"{p}C15", right)],
        }
        loads["up"] = [*loads["up_bare"], (f"-{p}C1", left), (f"-{p}C7", right)]
        loads["side"] = [*loads["side_bare"], (f"{p}C8", left), (f"{p}C9", right)]
        if i == 1:
            nose = f"({z} - crankshaft_nose_arm_mm)"
            loads["up"].append((f"{p}C11", nose))
            loads["side"].append((f"-{p}C10", nose))
        if i == throws:
            rear = f"({z} + {p}length + crankshaft_rear_arm_mm)"
            loads["up"].append((f"{p}C13", rear))
            loads["side"].append((f"{p}C12", rear))
        made = {
            "z_left": start,
            "z_rod": f"{z} + {t}_l1_mm + {t}_left_web_mm + {t}_l2_mm",
        }
        for part in ("up", "side", "up_bare", "side_bare"):
            made[f"F_{part}"] = _sum(force for force, _ in loads[part])
            made[f"L_{part}"] = "(" + _sum(f"{f}*{place}" for f, place in loads[part]) + ")/1000"
        for key, text in made.items():
            cells.setdefault(key, []).append(Scalar(p + key, text, "статика, рис. 35 Гоца"))
    return Grid(
        "balance_throws",
        "Вращающиеся массы колен: силы и моменты относительно середины вала",
        RESULTS,
        tuple(f"колено {i}" for i in range(1, throws + 1)),
        tuple(GridRow(key, tuple(row)) for key, row in cells.items()),
    )


def _sum(terms: Iterable[str]) -> str:
    return " + ".join(terms).replace("+ -", "- ")


def _amplitude() -> str:
    """Amplitude a_k of the series of the acceleration, Neiman (36)."""
    text = "0"
    for n in (8, 6, 4, 2):
        sign = "" if n % 4 == 2 else "-"
        text = f"{sign}({n * n}*neiman_p{n}) if order == {n} else ({text})"
    return f"1 if order == 1 else ({text})"


def _orders(cylinders: int) -> TableSpec:
    numbers = range(1, cylinders + 1)

    def total(turn: str, weight: str = "") -> str:
        terms = (f"{weight.format(i=i)}{turn}(rad(order*firing_offset_{i}_deg))" for i in numbers)
        return "total(" + ", ".join(terms) + ")"

    far = "max(" + ", ".join(f"abs(throw{i}_z_rod)" for i in numbers) + ")"

    def phase(name: tuple[str, str], scale: str) -> str:
        size = f"sqrt({name[0]}**2 + {name[1]}**2)"
        least = f"{_NOTHING}*{scale}"
        sine = f"(0 if abs({name[1]}) < {least} else {name[1]})"
        return f"0 if {size} < {least} else deg(atan2({sine}, {name[0]}))/order"

    first, second = "balance_first_shafts_share", "balance_second_shafts_share"
    rest = f"(1 - {first} if order == 1 else 1 - {second} if order == 2 else 1)"
    weight = "throw{i}_z_rod*"
    columns = (
        Column("order", None),
        Column("order_amplitude", _amplitude(), "Нейман (36)"),
        Column("order_cos", total("cos"), "сложение векторов"),
        Column("order_sin", total("sin"), "сложение векторов"),
        Column(
            "F_order_kN",
            "Pj_unit_kN*abs(order_amplitude)*sqrt(order_cos**2 + order_sin**2)",
            "свободная сила",
        ),
        Column("F_order_deg", phase(("order_cos", "order_sin"), "1"), "направление"),
        Column("arm_cos_mm", total("cos", weight), "сложение векторов"),
        Column("arm_sin_mm", total("sin", weight), "сложение векторов"),
        Column(
            "M_order_Nm",
            "Pj_unit_kN*abs(order_amplitude)*sqrt(arm_cos_mm**2 + arm_sin_mm**2)",
            "свободный момент",
        ),
        Column("M_order_deg", phase(("arm_cos_mm", "arm_sin_mm"), far), "направление"),
        Column("F_left_kN", f"F_order_kN*{rest}", "валы Ланчестера"),
        Column("M_left_Nm", f"M_order_Nm*{rest}", "валы Ланчестера"),
    )
    return TableSpec(
        "balance_orders",
        "У.п",
        "Свободные силы и моменты инерции возвратно движущихся масс по порядкам",
        ORDERS_SHEET,
        columns,
        tuple(float(n) for n in range(1, LAST_ORDER + 1)),
        note=(
            "Силы направлены вдоль осей цилиндров, плечи отсчитаны от середины вала; амплитуды "
            "ускорения — по полному ряду Неймана (36). Нечётных порядков выше первого нет."
        ),
        step=1.0,
    )


def _turn(rows: tuple[float, ...]) -> TableSpec:
    """Forces and moments over a turn, before and after balancing."""
    columns = [Column("phi_deg", None)]
    phi = "rad(phi_deg)"
    for key, unit, across in (("F", "kN", "order"), ("L", "Nm", "arm")):
        for n in (1, 2, 4):
            wave = (
                f"balance_cos{n}_{across}*cos({n}*{phi}) + balance_sin{n}_{across}*sin({n}*{phi})"
            )
            size = {1: "1", 2: "4*neiman_p2", 4: "-(16*neiman_p4)"}[n]
            columns.append(
                Column(f"{key}{n}_{unit}", f"Pj_unit_kN*({size})*({wave})", f"порядок {n}")
            )
        re, im = f"{key}rot_re", f"{key}rot_im"
        weight = "balance_counterweight_share"
        full_re = f"({re} + {weight}*{key}cw_re)"
        full_im = f"({im} + {weight}*{key}cw_im)"
        columns += [
            Column(f"{key}rot_up_{unit}", f"{re}*cos({phi}) - {im}*sin({phi})", "поворот вала"),
            Column(f"{key}rot_right_{unit}", f"{re}*sin({phi}) + {im}*cos({phi})", "поворот вала"),
            Column(
                f"{key}up_{unit}",
                " + ".join(f"{key}{n}_{unit}" for n in (1, 2, 4)) + f" + {key}rot_up_{unit}",
                "сумма",
            ),
            Column(
                f"{key}up_after_{unit}",
                f"{key}1_{unit}*(1 - balance_first_shafts_share)"
                f" + {key}2_{unit}*(1 - balance_second_shafts_share) + {key}4_{unit}"
                f" + {full_re}*cos({phi}) - {full_im}*sin({phi})",
                "сумма",
            ),
            Column(
                f"{key}right_after_{unit}",
                f"{full_re}*sin({phi}) + {full_im}*cos({phi})",
                "сумма",
            ),
        ]
    return TableSpec(
        "balance",
        "У",
        "Свободные силы и моменты за оборот до и после уравновешивания",
        SHEET,
        tuple(columns),
        rows,
        note=(
            "Вверх — к головке цилиндров, вправо — куда ведёт вращение, если смотреть с носка. "
            "После уравновешивания: к валу добавлены противовесы для доли масс mj на каждом "
            "колене, балансирные валы снимают выбранные доли сил 1-го и 2-го порядка."
        ),
    )


def _clean(text: str) -> str:
    """Rounding noise of a sum that vanishes as zero: a chart would blow it up."""
    return f"0 if abs({text}) < {_NOTHING} else {text}"


def _sums(cylinders: int, throws: int) -> ScalarTable:
    """Vector sums of the cylinders and of the rotating masses."""
    scalars = [Scalar("Pj_unit_kN", "to_kN(m_j*r_crank*omega**2)", "Гоц (30)")]
    for across, weight in (("order", ""), ("arm", "throw{i}_z_rod*")):
        for n in (1, 2, 4):
            for turn in ("cos", "sin"):
                terms = ", ".join(
                    f"{weight.format(i=i)}{turn}(rad({n}*firing_offset_{i}_deg))"
                    for i in range(1, cylinders + 1)
                )
                of = f"{across}_{turn}" + ("_mm" if weight else "")
                text = _clean(f"total({terms})")
                scalars.append(Scalar(f"balance_{turn}{n}_{across}", text, f"порядок {n}", of=of))
    numbers = range(1, throws + 1)
    for key in "FL":
        scale = "to_kN({})" if key == "F" else "{}"
        for bare in ("", "_bare"):
            re = _sum(
                f"throw{i}_{key}_up{bare}*cos(rad(throw_angle_{i}_deg))"
                f" + throw{i}_{key}_side{bare}*sin(rad(throw_angle_{i}_deg))"
                for i in numbers
            )
            im = _sum(
                f"throw{i}_{key}_up{bare}*sin(rad(throw_angle_{i}_deg))"
                f" - throw{i}_{key}_side{bare}*cos(rad(throw_angle_{i}_deg))"
                for i in numbers
            )
            if bare:
                size = f"sqrt(({re})**2 + ({im})**2)"
                scalars.append(Scalar(f"{key}rot_bare", scale.format(size), "сумма по коленам"))
            else:
                scalars += [
                    Scalar(f"{key}rot_re", _clean(scale.format(f"({re})")), "сумма по коленам"),
                    Scalar(f"{key}rot_im", _clean(scale.format(f"({im})")), "сумма по коленам"),
                    Scalar(
                        f"{key}rot", f"sqrt({key}rot_re**2 + {key}rot_im**2)", "сумма по коленам"
                    ),
                ]
        weight = "" if key == "F" else "throw{i}_z_rod*"
        for part, turn in (("re", "cos"), ("im", "sin")):
            terms = ", ".join(
                f"{weight.format(i=i)}{turn}(rad(throw_angle_{i}_deg))" for i in numbers
            )
            scalars.append(
                Scalar(
                    f"{key}cw_{part}", _clean(f"-(Pj_unit_kN*total({terms}))"), "mj против колен"
                )
            )
    title = "Векторные суммы при φ = 0"
    return ScalarTable("balance_sums", title, RESULTS, tuple(scalars))


def _vectors() -> ScalarTable:
    """Greatest and smallest first-order vector with its direction, before and after."""
    scalars = []
    for key, across in (("F", "order"), ("L", "arm")):
        half = "Pj_unit_kN/2"
        scale = "Pj_unit_kN" + ("" if key == "F" else "*(-throw1_z_left)")
        for name in ("before", "after"):
            n = f"{key}1_{name}"
            rest = "*(1 - balance_first_shafts_share)" if name == "after" else ""
            more = "balance_counterweight_share" if name == "after" else "0"
            cos, sin = f"balance_cos1_{across}", f"balance_sin1_{across}"
            add = {p: f" + {more}*{key}cw_{p}" if name == "after" else "" for p in ("re", "im")}
            least = f"min({n}_along, {n}_against) <= {_NOTHING}*{scale}"
            angle = f"(deg(atan2({n}_im, {n}_re)) + deg(atan2({sin}, {cos})))/2"
            scalars += [
                Scalar(f"{n}_re", f"{half}*{cos}{rest} + {key}rot_re{add['re']}", "разложение"),
                Scalar(f"{n}_im", f"{key}rot_im{add['im']} - {half}*{sin}{rest}", "разложение"),
                Scalar(f"{n}_along", f"sqrt({n}_re**2 + {n}_im**2)", "вектор по вращению"),
                Scalar(
                    f"{n}_against",
                    f"{half}*sqrt({cos}**2 + {sin}**2){rest}",
                    "вектор против вращения",
                ),
                Scalar(f"{n}_max", f"{n}_along + {n}_against", "большая полуось"),
                Scalar(f"{n}_min", f"abs({n}_along - {n}_against)", "малая полуось"),
                Scalar(
                    f"{n}_deg",
                    f"0 if {least} else 90 - mod(90 - {angle} + 0.000001, 180) + 0.000001",
                    "направление",
                ),
            ]
    title = "Векторы 1-го порядка вместе с вращающимися массами"
    return ScalarTable("balance_vectors", title, RESULTS, tuple(scalars))


def _devices() -> ScalarTable:
    """Counterweights for the chosen share and shafts of a Lanchester pair."""
    radius = "of_mm(balance_shaft_radius_mm)"
    scalars = [
        Scalar("counterweight_needed", "m_r + balance_counterweight_share*m_j", "доля масс mj"),
        Scalar("counterweight_web", "counterweight_needed/2", "на щёку"),
    ]
    for n, share in ((1, "first"), (2, "second")):
        size = "1" if n == 1 else "4*neiman_p2"
        sums = f"sqrt(balance_cos{n}_order**2 + balance_sin{n}_order**2)"
        scalars += [
            Scalar(
                f"shaft{n}_moment",
                f"balance_{share}_shafts_share*m_j*r_crank*({size})*{sums}/{2 * n * n}",
                f"2·mб·e·({n}ω)² = F{n}",
            ),
            Scalar(f"shaft{n}_mass", f"shaft{n}_moment/{radius}", "mб"),
        ]
    title = "Противовесы и балансирные валы"
    return ScalarTable("balance_devices", title, RESULTS, tuple(scalars))


def _firing(cylinders: int) -> TableSpec:
    columns = [Column("variant", None)]
    numbers = range(1, cylinders + 1)
    for i in numbers:
        base = f"mod(720 - throw_angle_{i}_deg, 360)"
        turn = f" + 360*mod(floor((variant - 1)/{2 ** (i - 2)}), 2)" if i > 1 else ""
        columns.append(Column(f"theta{i}_deg", base + turn, "колено в ВМТ"))
    digits, gaps = [], []
    for i in numbers:
        before = [
            f"(1 if theta{j}_deg < theta{i}_deg + {'0.0001' if j < i else '-0.0001'} else 0)"
            for j in numbers
            if j != i
        ]
        place = " - ".join([str(cylinders - 1), *before])
        digits.append(f"{i}*10**({place})")
        # Of two cylinders that fire together the later number follows the earlier one.
        others = [
            f"(mod(theta{j}_deg - theta{i}_deg {'-' if j < i else '+'} 0.0001, 720)"
            f" {'+' if j < i else '-'} 0.0001)"
            for j in numbers
            if j != i
        ]
        gaps.append(f"min({', '.join(others)})" if others else "720")

    def vector(order: str) -> str:
        terms = {
            turn: ", ".join(f"{turn}(rad({order}*theta{i}_deg))" for i in numbers)
            for turn in ("cos", "sin")
        }
        return f"sqrt(total({terms['cos']})**2 + total({terms['sin']})**2)"

    columns += [
        Column("order_code", " + ".join(digits), "по возрастанию θ"),
        Column("gap_max_deg", f"max({', '.join(gaps)})", "промежутки"),
        Column("gap_min_deg", f"min({', '.join(gaps)})", "промежутки"),
        Column("unevenness", f"(gap_max_deg - gap_min_deg)/(720/{cylinders})", "промежутки"),
        Column("half_order_sum", vector("0.5"), "сложение векторов"),
        Column("first_order_sum", vector("1"), "сложение векторов"),
    ]
    return TableSpec(
        "firing_orders",
        "У.р",
        "Порядки работы, возможные при этом коленчатом вале",
        FIRING_SHEET,
        tuple(columns),
        tuple(float(n) for n in range(1, 2 ** (cylinders - 1) + 1)),
        note=(
            "Силы инерции повторяются каждый оборот и у всех порядков одинаковы; различаются "
            "чередование рабочих ходов, моменты низких порядков и нагрузки коренных шеек."
        ),
        step=1.0,
    )


def balance_blocks(cylinders: int, throws: int, turn: tuple[float, ...]) -> tuple[Block, ...]:
    """Sheets of the balance."""
    blocks: list[Block] = [
        _turn(turn), _devices(), _vectors(), _sums(cylinders, throws), _grid(throws),
        _orders(cylinders),
    ]  # fmt: skip
    if cylinders <= MAX_CYLINDERS:
        blocks.append(_firing(cylinders))
    return tuple(blocks)


def balance_charts() -> tuple[ChartSpec, ...]:
    """Forces and moments over a turn, vector diagrams."""
    x = "balance.phi_deg"

    def over(chart: str, title: str, y: str, *keys: str) -> ChartSpec:
        series = tuple(Series(x, f"balance.{key}") for key in keys)
        return ChartSpec(chart, SHEET, title, "line", series, "φ, ° ПКВ", y)

    return (
        over("balance_F", "Свободные силы по порядкам", "F, кН", "F1_kN", "F2_kN", "F4_kN"),
        over("balance_L", "Свободные продольные моменты по порядкам", "M, Н·м",
             "L1_Nm", "L2_Nm", "L4_Nm"),
        over("balance_F_after", "Вертикальная сила до и после уравновешивания", "F, кН",
             "Fup_kN", "Fup_after_kN"),
        over("balance_L_after", "Продольный момент до и после уравновешивания", "M, Н·м",
             "Lup_Nm", "Lup_after_Nm"),
        ChartSpec(
            "balance_F_vector", SHEET, "Вектор свободной силы: до и после уравновешивания", "line",
            (Series("balance.Frot_right_kN", "balance.Fup_kN", "до"),
             Series("balance.Fright_after_kN", "balance.Fup_after_kN", "после")),
            "вправо, кН", "вверх, кН",
        ),
        ChartSpec(
            "balance_L_vector", SHEET, "Вектор продольного момента: до и после", "line",
            (Series("balance.Lrot_right_Nm", "balance.Lup_Nm", "до"),
             Series("balance.Lright_after_Nm", "balance.Lup_after_Nm", "после")),
            "в горизонтальной плоскости, Н·м", "в вертикальной плоскости, Н·м",
        ),
    )  # fmt: skip
