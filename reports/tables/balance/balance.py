"""Balancing: free forces and moments by orders, rotating masses, shafts, firing orders."""

from __future__ import annotations

from collections.abc import Iterator

from reports.spec.blocks import Block, Column, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, columns_of, over_phi, polar
from reports.spec.listing import column_list, corners
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape
from reports.tables.balance.balance_sums import (
    RESULTS,
    cylinders_grid,
    devices_table,
    sides,
    sums_table,
    throws_grid,
    vector_sum,
    vectors_table,
)
from reports.tables.balance.firing import MAX_CYLINDERS, firing_loads, firing_table, has_loads

SHEET, ORDERS_SHEET = "Уравновешивание", "Порядки сил"
LAST_ORDER = 8
SUM = "порядки 1, 2, 4 и вращающиеся массы"


def _amplitude() -> str:
    """Amplitude a_k of the series of the acceleration, Neiman (36)."""
    text = "0"
    for n in (8, 6, 4, 2):
        sign = "" if n % 4 == 2 else "-"
        text = f"{sign}({n * n}*neiman_p{n}) if order == {n} else ({text})"
    return f"1 if order == 1 else ({text})"


def _orders(shape: Shape) -> TableSpec:
    columns = [
        *column_list(f"""
        order
        order_amplitude = {_amplitude()} | Нейман (36)
    """)
    ]
    for across, letter, unit in (("order", "F", "kN"), ("arm", "M", "Nm")):
        columns += _order_columns(shape, across, letter, unit)
    first, second = "balance_first_shafts_share", "balance_second_shafts_share"
    rest = f"(1 - {first} if order == 1 else 1 - {second} if order == 2 else 1)"
    columns += column_list(f"""
        F_left_kN = F_order_kN*{rest} | балансирные валы
        M_left_Nm = M_order_Nm*{rest} | балансирные валы
    """)
    directed = (
        "Силы складываются по осям цилиндров, вверх — вдоль оси цилиндра 1; вектор порядка "
        "описывает эллипс, даны его полуоси и направление большей от оси цилиндра 1 по вращению"
        if shape.banks
        else "Силы направлены вдоль осей цилиндров"
    )
    return TableSpec(
        "balance_orders",
        "У.п",
        "Свободные силы и моменты инерции возвратно движущихся масс по порядкам",
        ORDERS_SHEET,
        tuple(columns),
        tuple(float(n) for n in range(1, LAST_ORDER + 1)),
        note=(
            f"{directed}; плечи отсчитаны от середины вала; амплитуды ускорения — по полному ряду "
            "Неймана (36). Нечётных порядков выше первого нет."
        ),
        step=1.0,
    )


def _order_columns(shape: Shape, across: str, letter: str, unit: str) -> Iterator[Column]:
    """Vector sums of one order and the force or the moment that they make."""
    end = "_mm" if across == "arm" else ""
    title = "свободная сила" if letter == "F" else "свободный момент"
    names = {}
    for side in sides(shape):
        for turn in ("cos", "sin"):
            key = names[turn + side] = f"{across}{side}_{turn}{end}"
            text = vector_sum("order", turn, across, side)
            yield Column(key, text, "сложение векторов")
    unit_force = "Pj_unit_kN*abs(order_amplitude)"
    cos, sin = names["cos"], names["sin"]
    if not shape.banks:
        size = f"sqrt({cos}**2 + {sin}**2)"
        sine = f"(0 if round({sin}, 9) == 0 else {sin})"
        phase = f"0 if round({size}, 9) == 0 else deg(atan2({sine}, {cos}))/order"
        yield Column(f"{letter}_order_{unit}", f"{unit_force}*{size}", title)
        yield Column(f"{letter}_order_deg", phase, "направление", every="360/order")
        return
    right_cos, right_sin = names["cos_right"], names["sin_right"]
    along, against = f"{across}_along{end}", f"{across}_against{end}"
    yield Column(
        along,
        f"sqrt(({cos} + {right_sin})**2 + ({sin} - {right_cos})**2)/2",
        "вектор по вращению",
        helper=True,
    )
    yield Column(
        against,
        f"sqrt(({cos} - {right_sin})**2 + ({sin} + {right_cos})**2)/2",
        "вектор против вращения",
        helper=True,
    )
    angle = (
        f"(deg(atan2({right_cos} - {sin}, {cos} + {right_sin}))"
        f" + deg(atan2({sin} + {right_cos}, {cos} - {right_sin})))/2"
    )
    yield Column(f"{letter}_order_{unit}", f"{unit_force}*({along} + {against})", title)
    yield Column(f"{letter}_order_min_{unit}", f"{unit_force}*abs({along} - {against})", title)
    yield Column(
        f"{letter}_order_dir_deg",
        f"0 if round(min({along}, {against}), 9) == 0"
        f" else 90 - mod(90 - {angle} + 0.000001, 180) + 0.000001",
        "направление",
        every="180",
    )


def _turn(shape: Shape, rows: tuple[float, ...]) -> TableSpec:
    """Forces and moments over a turn, before and after balancing."""
    columns = [Column("phi_deg", None)]
    for key, unit, across in (("F", "kN", "order"), ("L", "Nm", "arm")):
        columns += _turn_columns(shape, key, unit, across)
    return TableSpec(
        "balance",
        "У",
        "Свободные силы и моменты за оборот до и после уравновешивания",
        SHEET,
        tuple(columns),
        rows,
        note=(
            "Вверх — вдоль оси цилиндра 1 к его головке, вправо — куда ведёт вращение, если "
            "смотреть с носка. После уравновешивания: к валу добавлены противовесы для доли масс "
            "mj на каждом колене, балансирные валы снимают выбранные доли сил 1-го и 2-го порядка. "
            "Сложены порядки 1, 2, 4 и вращающиеся массы; 6-й и 8-й — на листе «Порядки сил»."
        ),
    )


def _turn_columns(shape: Shape, key: str, unit: str, across: str) -> Iterator[Column]:
    """Columns of the force (F) or of the moment (L)."""
    phi = "rad(phi_deg)"
    amplitude = {1: "1", 2: "4*neiman_p2", 4: "-(16*neiman_p4)"}
    for n, size in amplitude.items():
        for side in sides(shape):
            name = f"balance{side}_{{}}{n}_{across}"
            wave = f"{name.format('cos')}*cos({n}*{phi}) + {name.format('sin')}*sin({n}*{phi})"
            text = f"Pj_unit_kN*({size})*({wave})"
            yield Column(f"{key}{n}{side}_{unit}", text, f"порядок {n}")
    re, im = f"{key}rot_re", f"{key}rot_im"
    yield Column(f"{key}rot_up_{unit}", f"{re}*cos({phi}) - {im}*sin({phi})", "поворот вала")
    yield Column(f"{key}rot_right_{unit}", f"{re}*sin({phi}) + {im}*cos({phi})", "поворот вала")
    weight = "balance_counterweight_share"
    full_re, full_im = f"({re} + {weight}*{key}cw_re)", f"({im} + {weight}*{key}cw_im)"

    def orders(side: str) -> str:
        return " + ".join(f"{key}{n}{side}_{unit}" for n in amplitude)

    def left(side: str) -> str:
        return (
            f"{key}1{side}_{unit}*(1 - balance_first_shafts_share)"
            f" + {key}2{side}_{unit}*(1 - balance_second_shafts_share) + {key}4{side}_{unit}"
        )

    turned_up = f"{full_re}*cos({phi}) - {full_im}*sin({phi})"
    turned_right = f"{full_re}*sin({phi}) + {full_im}*cos({phi})"
    yield Column(f"{key}up_{unit}", f"{orders('')} + {key}rot_up_{unit}", SUM)
    if shape.banks:
        yield Column(f"{key}right_{unit}", f"{orders('_right')} + {key}rot_right_{unit}", SUM)
        turned_right = f"{left('_right')} + {turned_right}"
    yield Column(f"{key}up_after_{unit}", f"{left('')} + {turned_up}", SUM)
    yield Column(f"{key}right_after_{unit}", turned_right, SUM)


def numbers(shape: Shape) -> range:
    """Numbers of the cylinders."""
    return range(1, shape.cylinders + 1)


def balance(scope: Scope) -> Part:
    """Sheets of the balance; for pistons that Neiman's series describes."""
    shape = scope.shape
    if not shape.by_orders:
        return Part()
    blocks: list[Block] = [
        _turn(shape, scope.turn), devices_table(shape), vectors_table(shape), sums_table(shape),
        throws_grid(shape), cylinders_grid(shape), _orders(shape), *_boxes(shape),
    ]  # fmt: skip
    if shape.strokes == 4 and shape.cylinders <= MAX_CYLINDERS:
        loads = has_loads(shape, forced=scope.forced)
        blocks.append(firing_table(shape, loads=loads))
        if loads and shape.throws > 1:
            blocks.append(firing_loads(shape, scope.cycle))
    return Part(tuple(blocks), _charts(shape))


def _boxes(shape: Shape) -> Iterator[Block]:
    """Greatest components of the vectors: they keep the axes of the diagrams equal."""
    for key, unit in (("F", "kN"), ("L", "Nm")):
        right = "right" if shape.banks else "rot_right"
        parts = {}
        for when in ("", "_after"):
            across = f"{key}right_after_{unit}" if when else f"{key}{right}_{unit}"
            names = (f"balance.{key}up{when}_{unit}", f"balance.{across}")
            ends = ", ".join(f"col_max({name}), -col_min({name})" for name in names)
            parts[f"balance_{key}_reach{when}"] = f"max({ends})"
        # An axis needs a length even where there is nothing to be drawn.
        size, of = f"balance_{key}_size", f"box_{unit}"
        parts[size] = f"max({', '.join(parts)}, 0.001)"
        found = tuple(Scalar(k, text, "оси диаграммы", of=of) for k, text in parts.items())
        what = "силы" if key == "F" else "момента"
        yield ScalarTable(f"balance_{key}_sizes", f"Оси диаграммы {what}", RESULTS, found)
        box = f"balance_{key}_box"
        yield corners(box, f"Углы диаграммы {what}", RESULTS, box, size, of=of)


def _charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """Forces and moments over a turn, vector diagrams."""
    forces, moments = "F, кН", "M, Н·м"

    def over(chart: str, title: str, y: str, keys: str, caption: str = "") -> ChartSpec:
        columns = columns_of("balance", *keys.split())
        return over_phi(f"balance_{chart}", SHEET, title, y, *columns, caption=caption)

    return (
        over("F", "Свободные силы по порядкам", forces, "F1_kN F2_kN F4_kN"),
        over("L", "Свободные продольные моменты по порядкам", moments, "L1_Nm L2_Nm L4_Nm"),
        over("F_after", "Сила вдоль оси цилиндра 1 до и после уравновешивания", forces,
             "Fup_kN Fup_after_kN",
             "Свободная сила вдоль оси первого цилиндра до и после уравновешивания"),
        over("L_after", "Продольный момент до и после уравновешивания", moments,
             "Lup_Nm Lup_after_Nm", "Продольный свободный момент до и после уравновешивания"),
        _vector(shape, "F", "kN", "Вектор свободной силы: до и после уравновешивания",
                ("поперёк оси цилиндра 1, кН", "вдоль оси цилиндра 1, кН"), "свободной силы"),
        _vector(shape, "L", "Nm", "Вектор продольного момента: до и после",
                ("поперёк оси цилиндра 1, Н·м", "вдоль оси цилиндра 1, Н·м"),
                "продольного момента"),
    )  # fmt: skip


def _vector(
    shape: Shape, key: str, unit: str, title: str, axes: tuple[str, str], of: str
) -> ChartSpec:
    right = "right" if shape.banks else "rot_right"
    at, letter, label = f"balance.{key}", "F" if key == "F" else "M", axes[0].rpartition(", ")[2]
    return polar(
        f"balance_{key}_vector", SHEET, title, axes, f"balance_{key}_box.box_{unit}",
        Series(f"{at}{right}_{unit}", f"{at}up_{unit}", "до"),
        Series(f"{at}right_after_{unit}", f"{at}up_after_{unit}", "после", only="workbook"),
        caption=f"Конец вектора {of} за оборот до уравновешивания",
        x_tex=f"${letter}_x$, {label}", y_tex=f"${letter}_y$, {label}",
    )  # fmt: skip
