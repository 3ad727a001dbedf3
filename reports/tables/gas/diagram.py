"""Rounded diagram of figure 22 and points joined without overshoot."""

from __future__ import annotations

from collections.abc import Sequence

from reports.inputs.sections.gas import RoundedGasSection, TableGasSection
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.gas import places
from reports.spec.blocks import Block, Column, Grid, GridRow, Scalar, ScalarTable, TableSpec
from reports.spec.listing import column_list, scalar_list
from reports.spec.shape import central_volume_ratio

SHEET, POINTS = "Газы", "Точки диаграммы"
_EPS = "geometry_compression_ratio"
NODES = ("r", "a′", "a", "c′", "c″", "zд", "j", "b′", "b″", "r′", "r")
KNOT = "knot_number"  # helper column: the number of the last given point before the angle


def diagram_blocks(model: InputFile) -> tuple[Block, ...]:
    """Mean indicated pressure; points and slopes where the diagram is made of cubics."""
    mean = Scalar("p_i_area", "to_MPa(W_cycle/of_dm3(V_h))", "∮p dV/Vh")
    work = ScalarTable("diagram_work", "Среднее индикаторное давление", SHEET, (mean,))
    if isinstance(model.gas, RoundedGasSection):
        return _scalars(model.gas), _nodes(), work
    if isinstance(model.gas, TableGasSection) and is_smooth(model):
        return _points(len(model.gas.points)), work
    return (work,)


def is_smooth(model: InputFile) -> bool:
    """Whether points are joined by cubics."""
    return isinstance(model.gas, TableGasSection) and model.gas.interpolation == "monotone"


def peak_pressure(model: InputFile) -> str:
    """Largest pressure [MPa] of the diagram itself, between the rows of its table too."""
    if isinstance(model.gas, RoundedGasSection):
        return "col_max(nodes.node_MPa)"
    if isinstance(model.gas, TableGasSection):
        return "element(gas_points_mpa, first_largest(gas_points_mpa))"
    return "max(gas_max_pressure_mpa, p_start)"


def process_columns(parts: dict[str, str]) -> tuple[Column, ...]:
    """Helper columns from which a pressure is put together."""
    return tuple(Column(key, text, "Гоц, 2.4", helper=True) for key, text in parts.items())


def by_angle(phi: str, steps: Sequence[tuple[str, str]], last: str) -> str:
    """One value up to each angle, and the last one behind all."""
    text = last
    for limit, value in reversed(steps):
        text = f"({value}) if {phi} <= {limit} else ({text})"
    return text


def straight_pressure(phi: str) -> tuple[str, tuple[Column, ...]]:
    """Pressure [MPa] on straight lines between the given points, and its helper columns."""
    at = f"element(gas_points_deg, {KNOT})"
    after = f"element(gas_points_deg, {KNOT} + 1)"
    before = f"element(gas_points_mpa, {KNOT})"
    parts = {
        KNOT: f"place({phi}, gas_points_deg)",
        "knot_share": f"({phi} - {at})/({after} - {at})",
    }
    text = f"{before} + (element(gas_points_mpa, {KNOT} + 1) - {before})*knot_share"
    return text, process_columns(parts)


def smooth_pressure(phi: str) -> tuple[str, tuple[Column, ...]]:
    """Pressure [MPa] through the given points, and its helper columns."""
    return _cubic("points.point", phi)


def _cubic(points: str, phi: str) -> tuple[str, tuple[Column, ...]]:
    """Cubic from the last point before an angle."""
    zero, one, two, three = (
        f"element({points}_{key}, {KNOT})" for key in ("MPa", "slope", "two", "three")
    )
    parts = {
        KNOT: f"place({phi}, {points}_deg)",
        "knot_past_deg": f"{phi} - element({points}_deg, {KNOT})",
    }
    past = "knot_past_deg"
    return f"{zero} + {past}*({one} + {past}*({two} + {past}*{three}))", process_columns(parts)


def rounded_pressure(phi: str, ratio: str) -> tuple[str, tuple[Column, ...]]:
    """Pressure [MPa] of the rounded diagram at an angle and a volume ratio, and its helpers."""
    smooth, knots = _cubic("nodes.node", phi)
    parts = {
        "p_smooth_MPa": smooth,
        "p_compression_MPa": _compression(ratio),
        "p_expansion_MPa": _expansion(ratio),
    }
    text = by_angle(phi, (
        ("gas_intake_settle_deg", "p_smooth_MPa"),
        ("180", "gas_intake_pressure_mpa"),
        ("phi_c_deg", "p_compression_MPa"),
        ("phi_join_deg", "p_smooth_MPa"),
        ("phi_open_deg", "p_expansion_MPa"),
        ("phi_close_deg", "p_smooth_MPa"),
    ), "gas_residual_pressure_mpa")  # fmt: skip
    return text, (*knots, *process_columns(parts))


def _compression(ratio: str) -> str:
    return f"gas_intake_pressure_mpa*({_EPS}/({ratio}))**gas_compression_exponent"


def _expansion(ratio: str) -> str:
    return f"gas_max_pressure_mpa*(gas_preexpansion_ratio/({ratio}))**gas_expansion_exponent"


def _scalars(gas: RoundedGasSection) -> ScalarTable:
    share, peak, join = places(gas)
    names = [
        f"gas_{name}" if value is not None else f"{usual:g}"
        for name, value, usual in (
            ("peak_share", gas.peak_share, share),
            ("peak_after_tdc_deg", gas.peak_after_tdc_deg, peak),
            ("expansion_after_tdc_deg", gas.expansion_after_tdc_deg, join),
        )
    ]

    figure = "Гоц, рис. 22"
    start = "360 - gas_injection_advance_deg + gas_ignition_delay_deg"
    return ScalarTable(
        "gas_points",
        "Характерные точки индикаторной диаграммы",
        SHEET,
        scalar_list(f"""
            phi_c_deg = {start} | {figure}, c′
            phi_peak_deg = 360 + {names[1]} | {figure}, zд
            phi_join_deg = 360 + {names[2]} | выход на политропу
            phi_open_deg = 540 - gas_exhaust_start_before_bdc_deg | {figure}, b′
            phi_close_deg = 540 + gas_exhaust_end_after_bdc_deg | {figure}, r′
            peak_share = {names[0]} | pzд/pz
            x_start = {central_volume_ratio('phi_c_deg')} | Гоц (1)
            p_start = {_compression('x_start')} | политропа сжатия
            p_c_end = gas_intake_pressure_mpa*{_EPS}**gas_compression_exponent | политропа сжатия
            x_open = {central_volume_ratio('phi_open_deg')} | Гоц (1)
            p_open = {_expansion('x_open')} | политропа расширения
            p_b = {_expansion(central_volume_ratio('540'))} | политропа расширения, b
        """),
        note=(
            "c′ — видимое начало сгорания, c″ — ВМТ, zд — действительная точка конца сгорания, "
            "b′ — начало выпуска, b″ — НМТ: среднее между p_b и p_r. Между точками давление "
            "меняется по кубическим многочленам без выбросов (наклоны Фрича — Бутленда); у "
            "политроп наклон взят по последнему градусу."
        ),
    )  # fmt: skip


def _nodes() -> Grid:
    def squeezed(angle: str) -> str:
        return _compression(central_volume_ratio(angle))

    def expanded(angle: str) -> str:
        return _expansion(central_volume_ratio(angle))

    last = len(NODES)
    angles = (
        "0", "gas_intake_settle_deg", "180", "phi_c_deg", "360", "phi_peak_deg", "phi_join_deg",
        "phi_open_deg", "540", "phi_close_deg", "720",
    )  # fmt: skip
    pressures = (
        "gas_residual_pressure_mpa", "gas_intake_pressure_mpa", "gas_intake_pressure_mpa",
        "p_start", "gas_tdc_rise*p_c_end", "peak_share*gas_max_pressure_mpa",
        expanded("phi_join_deg"), "p_open", "(p_b + gas_residual_pressure_mpa)/2",
        "gas_residual_pressure_mpa", "gas_residual_pressure_mpa",
    )  # fmt: skip

    def held(wanted: str, chord: str) -> str:
        return f"max(min(0, 3*{chord}), min(max(0, 3*{chord}), {wanted}))"

    slopes = {
        4: held(f"p_start - {squeezed('(phi_c_deg - 1)')}", "node_chord4"),
        5: middle_slope("node_chord4", "node_chord5", "node_step4", "node_step5"),
        7: held(f"{expanded('(phi_join_deg + 1)')} - node_MPa7", "node_chord6"),
        8: held(f"p_open - {expanded('(phi_open_deg - 1)')}", "node_chord8"),
        9: middle_slope("node_chord8", "node_chord9", "node_step8", "node_step9"),
    }

    def row(of: str, texts: dict[int, str], source: str) -> GridRow:
        cells = tuple(
            Scalar(f"{of}{n}", texts[n], source, of=of) if n in texts else None
            for n in range(1, last + 1)
        )
        return GridRow(of, cells)

    spans = range(1, last)
    steps = {n: f"node_deg{n + 1} - node_deg{n}" for n in spans}
    chords = {n: f"(node_MPa{n + 1} - node_MPa{n})/node_step{n}" for n in spans}
    twos = {
        n: f"(3*node_chord{n} - 2*node_slope{n} - node_slope{n + 1})/node_step{n}" for n in spans
    }
    threes = {
        n: f"(node_slope{n} + node_slope{n + 1} - 2*node_chord{n})/node_step{n}**2" for n in spans
    }
    numbers = range(1, last + 1)
    return Grid(
        "nodes",
        "Точки скруглённой диаграммы и наклоны в них",
        SHEET,
        NODES,
        (
            row("node_deg", {n: angles[n - 1] for n in numbers}, "Гоц, рис. 22"),
            row("node_MPa", {n: pressures[n - 1] for n in numbers}, "Гоц, рис. 22"),
            row("node_step", steps, "шаг"),
            row("node_chord", chords, "наклон хорды"),
            row("node_slope", {n: slopes.get(n, "0") for n in numbers}, "Фрич и Бутленд"),
            row("node_two", {**twos, last: "0"}, "коэффициент при квадрате"),
            row("node_three", {**threes, last: "0"}, "коэффициент при кубе"),
        ),
    )


def middle_slope(before: str, after: str, left: str, right: str) -> str:
    """Slope between two chords: their weighted harmonic mean, none at an extreme."""
    one, two = f"(2*{right} + {left})", f"({right} + 2*{left})"
    mean = f"({one} + {two})/({one}/{before} + {two}/{after})"
    return f"({mean}) if {before}*{after} > 0 else 0"


def _points(count: int) -> TableSpec:
    """Points of the input, one below the other, with the cubics between them."""
    last, number = str(count), "point"
    before = f"element(point_chord, ({number} - 1) if {number} > 1 else {count - 1})"
    left = f"element(point_step, ({number} - 1) if {number} > 1 else {count - 1})"
    # The diagram closes: the chord after the last point is the first one.
    after = f"element(point_chord, 1 if {number} >= {last} else {number})"
    right = f"element(point_step, 1 if {number} >= {last} else {number})"
    inside = f"{number} < {last}"
    step = "point_step"
    ahead = "following(point_slope)"
    two = f"(3*point_chord - 2*point_slope - {ahead})/{step}"
    three = f"(point_slope + {ahead} - 2*point_chord)/{step}**2"
    return TableSpec(
        "points",
        "Т",
        "Точки диаграммы и кубические многочлены между ними",
        POINTS,
        column_list(f"""
            {number}
            point_deg = element(gas_points_deg, {number}) | исходные данные
            point_MPa = element(gas_points_mpa, {number}) | исходные данные
            {step} = following(point_deg) - point_deg if {inside} else 0 | шаг
            point_chord = (following(point_MPa) - point_MPa)/{step} if {inside} else 0
                | наклон хорды
            point_slope = {middle_slope(before, after, left, right)} | Фрич и Бутленд
            point_two = ({two}) if {inside} else 0 | коэффициент при квадрате
            point_three = ({three}) if {inside} else 0 | коэффициент при кубе
        """),
        tuple(float(n) for n in range(1, count + 1)),
        note="Между точками давление не выходит за давления соседних точек.",
        step=1.0,
    )
