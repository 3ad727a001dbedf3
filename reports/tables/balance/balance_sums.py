"""Rotating masses, vector sums of the cylinders, first-order vectors, counterweights, shafts."""

from __future__ import annotations

from collections.abc import Iterable

from reports.spec.blocks import Grid, GridRow, Scalar, ScalarTable
from reports.spec.listing import grid_row, scalar_list
from reports.spec.shape import FIRING, Shape

RESULTS = "Уравновешивание, итоги"


def place(shape: Shape, cylinder: int) -> str:
    """Distance of a cylinder's rod from the middle of the shaft [mm]."""
    second = "2" if shape.arrangement[cylinder - 1].rod_place else ""
    return f"throw{shape.throw_of(cylinder)}_z_rod{second}"


def pin_angle(shape: Shape, cylinder: int) -> str:
    """Angle of a cylinder's crankpin from crank 1 [deg]."""
    angle = f"throw_angle_{shape.throw_of(cylinder)}_deg"
    turned = shape.arrangement[cylinder - 1].pin_angle
    return f"{angle} + crankshaft_split_pin_deg" if turned else angle


def sides(shape: Shape) -> tuple[str, ...]:
    """Directions in which the cylinders act: up, and to the right where axes differ."""
    return ("", "_right") if shape.banks else ("",)


def vector_sum(order: str, turn: str, across: str, side: str) -> str:
    """Sum of cos or sin of the phases over the cylinders, with arms, along one direction."""
    weight = f"cylinder_{'right' if side else 'up'}" + ("" if across == "order" else "_mm")
    return f"wave_{turn}(balance_cylinders.{weight}, {FIRING}, {order})"


def cylinders_grid(shape: Shape) -> Grid:
    """Directions, arms and crankpins of the cylinders side by side, to be summed over."""
    numbers = range(1, shape.cylinders + 1)
    rows = {"cylinder_z_mm": [place(shape, i) for i in numbers]}
    for side in sides(shape):
        key = f"cylinder_{'right' if side else 'up'}"
        turn = "sin" if side else "cos"
        along = [f"{turn}(rad({shape.axis(i)}))" if shape.banks else "1" for i in numbers]
        rows[key] = along
        rows[f"{key}_mm"] = [
            f"{place(shape, i)}*{text}" for i, text in zip(numbers, along, strict=True)
        ]
    rows["cylinder_crank_deg"] = [pin_angle(shape, i) for i in numbers]
    return Grid(
        "balance_cylinders",
        "Цилиндры: направления и плечи",
        RESULTS,
        tuple(f"цилиндр {i}" for i in numbers),
        tuple(grid_row(key, texts, "сложение векторов") for key, texts in rows.items()),
    )


def throws_grid(shape: Shape) -> Grid:
    """Centrifugal forces of each throw and their moments about the middle of the shaft."""
    throws = shape.throws
    cells: dict[str, list[Scalar]] = {}
    half = " + ".join(f"throw{i}_length" for i in range(1, throws + 1))
    for i in range(1, throws + 1):
        p, t = f"throw{i}_", f"throw_{i}"
        start = f"-(({half})/2)" if i == 1 else f"throw{i - 1}_z_left + throw{i - 1}_length"
        z, rod = f"{p}z_left", f"{p}z_rod"
        left, pin, right = f"{p}z_web", f"{p}z_pin", f"{p}z_web2"
        loads = {
            "up_bare": [(f"{p}C2", left), (f"{p}C3", rod), (f"{p}C4", pin), (f"{p}C6", right)],
            "side_bare": [(f"{p}C14", left), (f"{p}C15", right)],
        }
        made = {
            "z_left": start,
            "z_web": f"{z} + {p}arm_left",
            "z_rod": f"{z} + {p}arm_rod",
            "z_pin": f"{z} + {p}arm_pin",
            "z_web2": f"{z} + {p}length - {p}arm_right",
        }
        if not shape.single_rods:
            made["z_rod2"] = f"{rod} + {t}_l3_mm + {t}_l4_mm"
            loads["up_bare"].append((f"{p}C5", f"{p}z_rod2"))
        if shape.split:
            loads["side_bare"] += [(f"{p}C4x", pin), (f"{p}C5x", f"{p}z_rod2")]
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
        for part in ("up", "side", "up_bare", "side_bare"):
            made[f"F_{part}"] = _sum(force for force, _ in loads[part])
            made[f"L_{part}"] = "(" + _sum(f"{f}*{place}" for f, place in loads[part]) + ")/1000"
        turn = f"rad(throw_angle_{i}_deg)"
        for key in "FL":
            for bare in ("", "_bare"):
                up, side = f"{p}{key}_up{bare}", f"{p}{key}_side{bare}"
                made[f"{key}_re{bare}"] = f"{up}*cos({turn}) + {side}*sin({turn})"
                made[f"{key}_im{bare}"] = f"{up}*sin({turn}) - {side}*cos({turn})"
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


def clean(text: str) -> str:
    """Rounding noise of a sum that vanishes as zero: a chart would blow it up."""
    return f"round({text}, 11)"


def sums_table(shape: Shape) -> ScalarTable:
    """Vector sums of the cylinders and of the rotating masses."""
    scalars = [Scalar("Pj_unit_kN", "to_kN(m_j*r_crank*omega**2)", "Гоц (30)")]
    for across in ("order", "arm"):
        for side in sides(shape):
            for n in (1, 2, 4):
                for turn in ("cos", "sin"):
                    of = f"{across}{side}_{turn}" + ("_mm" if across == "arm" else "")
                    text = clean(vector_sum(str(n), turn, across, side))
                    key = f"balance{side}_{turn}{n}_{across}"
                    scalars.append(Scalar(key, text, f"порядок {n}", of=of))
    numbers = range(1, shape.throws + 1)
    for key in "FL":
        scale = "to_kN({})" if key == "F" else "{}"
        for bare in ("", "_bare"):
            re, im = (
                f"total({', '.join(f'throw{i}_{key}_{part}{bare}' for i in numbers)})"
                for part in ("re", "im")
            )
            if bare:
                size = f"sqrt(({re})**2 + ({im})**2)"
                scalars.append(Scalar(f"{key}rot_bare", scale.format(size), "сумма по коленам"))
            else:
                scalars += [
                    Scalar(f"{key}rot_re", clean(scale.format(f"({re})")), "сумма по коленам"),
                    Scalar(f"{key}rot_im", clean(scale.format(f"({im})")), "сумма по коленам"),
                    Scalar(
                        f"{key}rot", f"sqrt({key}rot_re**2 + {key}rot_im**2)", "сумма по коленам"
                    ),
                ]
        for part, turn in (("re", "cos"), ("im", "sin")):
            weight = "" if key == "F" else "balance_cylinders.cylinder_z_mm, "
            around = f"wave_{turn}({weight}balance_cylinders.cylinder_crank_deg, 1)"
            scalars.append(
                Scalar(f"{key}cw_{part}", clean(f"-(Pj_unit_kN*{around})"), "mj против колен")
            )
    title = "Векторные суммы при φ = 0"
    return ScalarTable("balance_sums", title, RESULTS, tuple(scalars))


def turning(shape: Shape, order: int, across: str) -> tuple[str, str, str, str]:
    """Twice the vectors that turn with and against rotation and make up one order.

    Of each the cosine and the sine, with rotation counted against it.
    """
    cos, sin = f"balance_cos{order}_{across}", f"balance_sin{order}_{across}"
    if not shape.banks:
        return cos, sin, cos, sin
    right_cos = f"balance_right_cos{order}_{across}"
    right_sin = f"balance_right_sin{order}_{across}"
    return (
        f"({cos} + {right_sin})",
        f"({sin} - {right_cos})",
        f"({cos} - {right_sin})",
        f"({sin} + {right_cos})",
    )


def vectors_table(shape: Shape) -> ScalarTable:
    """Greatest and smallest first-order vector with its direction, before and after."""
    scalars: list[Scalar] = []
    for key, across in (("F", "order"), ("L", "arm")):
        half = "Pj_unit_kN/2"
        for name in ("before", "after"):
            n = f"{key}1_{name}"
            rest = "*(1 - balance_first_shafts_share)" if name == "after" else ""
            more = "balance_counterweight_share" if name == "after" else "0"
            cos, sin, back_cos, back_sin = turning(shape, 1, across)
            add = {p: f" + {more}*{key}cw_{p}" if name == "after" else "" for p in ("re", "im")}
            least = f"round(min({n}_along, {n}_against), 9) == 0"
            angle = f"(deg(atan2({n}_im, {n}_re)) + deg(atan2({back_sin}, {back_cos})))/2"
            scalars += scalar_list(f"""
                {n}_re = {half}*{cos}{rest} + {key}rot_re{add["re"]} | разложение
                {n}_im = {key}rot_im{add["im"]} - {half}*{sin}{rest} | разложение
                {n}_along = sqrt({n}_re**2 + {n}_im**2) | вектор по вращению
                {n}_against = {half}*sqrt({back_cos}**2 + {back_sin}**2){rest}
                    | вектор против вращения
                {n}_max = {n}_along + {n}_against | большая полуось
                {n}_min = abs({n}_along - {n}_against) | малая полуось
                {n}_deg every 180 = 0 if {least}
                    else 90 - mod(90 - {angle} + 0.000001, 180) + 0.000001 | направление
            """)
    title = "Векторы 1-го порядка вместе с вращающимися массами"
    return ScalarTable("balance_vectors", title, RESULTS, tuple(scalars))


def devices_table(shape: Shape) -> ScalarTable:
    """Counterweights for the chosen share and shafts of a Lanchester pair."""
    radius = "of_mm(balance_shaft_radius_mm)"
    rods = "" if shape.single_rods else "2*"
    scalars = [
        *scalar_list(f"""
            counterweight_needed = m_r + {rods}balance_counterweight_share*m_j | доля масс mj
            counterweight_web = counterweight_needed/2 | на щёку
        """),
    ]
    for n, share in ((1, "first"), (2, "second")):
        size = "1" if n == 1 else "4*neiman_p2"
        cos, sin, back_cos, back_sin = turning(shape, n, "order")
        found = [(f"shaft{n}", cos, sin)]
        if shape.banks:
            found.append((f"shaft{n}_back", back_cos, back_sin))
        for key, one, other in found:
            scalars += scalar_list(f"""
                {key}_moment = balance_{share}_shafts_share*m_j*r_crank*({size})*sqrt({one}**2
                    + {other}**2)/{2 * n * n} | 2·mб·e·({n}ω)² = F{n}
                {key}_mass = {key}_moment/{radius} | mб
            """)
    title = "Противовесы и балансирные валы"
    return ScalarTable("balance_devices", title, RESULTS, tuple(scalars))
