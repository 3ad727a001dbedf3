"""Chudakov and Zharnov: harmonics of the torque, zones of speed, suppression by shafts."""

from __future__ import annotations

import math

from kshm.nomenclature.quantity import quantity
from reports.inputs.sections.gas import TableGasSection
from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Column, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, columns_of, line, over_phi
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope, stepped
from reports.spec.shape import FIRING, Shape
from reports.tables.gas.cycle_names import section_of
from reports.tables.gas.diagram import is_smooth, smooth_pressure, straight_pressure

SHEET, SHAFTS, RESULTS = "Гармоники момента", "Гашение 2-го порядка", "Гармоники момента, итоги"
LAST_ORDER = 8.0
_CANCELLED = 1e-6  # of a vector sum of unit vectors


def _tangential(model: InputFile, cycle: tuple[float, ...], *, motored: bool) -> TableSpec:
    shape = "sin(rad(phi_deg) + P4_1.beta_rad)/cos(P4_1.beta_rad)"
    knots: tuple[Column, ...] = ()
    if isinstance(model.gas, TableGasSection):
        way = smooth_pressure if is_smooth(model) else straight_pressure
        cold, knots = way("min(phi_deg, 720 - phi_deg)")
    else:
        cold = (
            "gas_intake_pressure_mpa"
            "*(geometry_compression_ratio/gas.volume_ratio)**gas_compression_exponent"
        )
    inside = "phi_deg > 180 and phi_deg < 540"
    compressed = column_list(f"""
        t_motored_MPa = (p_motored - gas_ambient_pressure_mpa)*{shape} | сжатие, отражённое от ВМТ
        helpers:
        p_motored = ({cold}) if {inside} else gas.p_MPa | политропа сжатия в обе стороны от ВМТ
    """)
    return TableSpec(
        "tangential",
        "М.т",
        "Удельные тангенциальные силы цилиндра 1",
        SHEET,
        (
            *column_list(f"""
                phi_deg
                t_gas_MPa = P4_1.Pg_MPa*{shape} | Чудаков, tг = Mг/(FпR)
                t_inertia_MPa = P4_1.Pj_MPa*{shape} | Чудаков (3)
            """),
            *((*compressed, *knots) if motored else ()),
        ),
        cycle,
    )


def _orders(model: InputFile) -> TableSpec:
    columns = [Column("order", None)]
    for name in ("gas", "inertia", "total"):
        for part in ("cos", "sin"):
            text = f"fourier_{part}(tangential.t_{name}_MPa, tangential.phi_deg, order)"
            if name == "total":
                text = f"gas_{part}_MPa + inertia_{part}_MPa"
            columns.append(Column(f"{name}_{part}_MPa", text, "ряд Фурье"))
        cos, sin, size = (f"{name}_{part}_MPa" for part in ("cos", "sin", "amplitude"))
        clean = f"(0 if round({cos}, 12) == 0 else {cos})"
        columns += column_list(f"""
            {size} = sqrt({cos}**2 + {sin}**2) | Чудаков (1)
            {name}_phase_deg = 0 if round({size}, 12) == 0 else deg(atan2({clean}, {sin}))
                | Чудаков (1)
        """)
    columns += column_list(f"""
        cylinders_sum = sqrt(wave_cos({FIRING}, order)**2
            + wave_sin({FIRING}, order)**2) | сложение векторов
        M_engine_order_Nm = of_MPa(total_amplitude_MPa)*F_piston*r_crank*cylinders_sum
            | сложение векторов
    """)
    step = 2 / model.engine.strokes
    last = min(LAST_ORDER, 180 / model.calculation.step_deg - step)
    turns = "цикл — два оборота" if model.engine.strokes == 4 else "цикл — один оборот"
    start = "перед впуском" if model.engine.strokes == 4 else "сгорания"
    return TableSpec(
        "torque_orders",
        "М.г",
        "Гармоники удельной тангенциальной силы и момента двигателя",
        SHEET,
        tuple(columns),
        stepped(step, last, step),
        note=(
            f"Гармоника порядка k есть A·sin(kφ + γ), φ от ВМТ {start}: {turns}. "
            "Двигатель: амплитуда цилиндра, умноженная на векторную сумму."
        ),
        step=step,
    )


def has_second_order(model: InputFile) -> bool:
    """Whether the second orders of the cylinders' torques do not cancel each other."""
    turns = [math.radians(2 * offset) for offset in model.crankshaft.firing_offsets_deg]
    together = math.hypot(sum(map(math.cos, turns)), sum(map(math.sin, turns)))
    return together > _CANCELLED


def _coefficients(model: InputFile) -> ScalarTable:
    efficiency = "regime_mechanical_efficiency" if section_of(model) is None else "cyc_eta_m"
    unit = "m_j*r_crank*omega**2/F_piston"
    shapes = ("lam/4", "-1/2", "-(3*lam/4)", "-(lam**2/4)")

    def second(of: str, curve: str) -> str:
        """Both parts of a curve's second order and its size."""
        waves = f"(tangential.t_{curve}_MPa, tangential.phi_deg, 2)"
        series = f"ряд Фурье: {quantity(of).symbol}"
        return f"""
            {of}_cos of t_part_cos = fourier_cos{waves} | {series}
            {of}_sin of t_part_sin = fourier_sin{waves} | {series}
            {of} = sqrt({of}_cos**2 + {of}_sin**2) | Чудаков (1)
        """

    shafts: tuple[Scalar, ...] = scalar_list("""
        P_shafts = to_kN(0.5*engine_cylinders*lam*m_j*r_crank*omega**2)
            | Чудаков, под (7): Pц = 0,5λmjRω²
    """)
    if Shape.of(model).banks:  # the shafts are those of cylinders in a row
        shafts = ()
    t_gas, t_cold = "t_gas2", "t_motored2"
    speeds = [f"sqrt(2*of_MPa({t})/d_j)*30/pi" for t in ("t_gas2_idle", t_gas)]
    zones = f"""
        n_zone1 = min({speeds[0]}, {speeds[1]}) | Чудаков, рис. 2
        n_zone2 = max({speeds[0]}, {speeds[1]}) | Чудаков, рис. 2
        zone = 1 if regime_speed_rpm <= n_zone1 else 2 if regime_speed_rpm <= n_zone2 else 3
            | Чудаков, рис. 2
        psi_best_nominal = max(0, 1 - {t_gas}/t_j2) | Чудаков (6), (7)
        h_shafts = to_mm(balance_suppression*L_rod) | Чудаков (8)
        h_shafts_best = to_mm(psi_best_nominal*L_rod) | Чудаков (8)
    """
    of_shafts = (*scalar_list(zones), *shafts) if has_second_order(model) else ()
    return ScalarTable(
        "torque_coefficients",
        "Гармонические коэффициенты 2-го порядка",
        RESULTS,
        (
            *(
                Scalar(f"t_j_order{n}", f"to_MPa({unit}*({shape}))", "двучленное движение")
                for n, shape in enumerate(shapes, 1)
            ),
            *scalar_list(
                """
                d_j = m_j*r_crank/F_piston | Чудаков, под (5)
                d_j_technical = 10*d_j | Чудаков, под (5)
                """,
                second("t_gas2", "gas"),
                "gamma_gas2_deg = deg(atan2(t_gas2_cos, t_gas2_sin)) | Чудаков (1)",
                second("t_inertia2", "inertia"),
                """
                gamma_inertia2_deg = mod(deg(atan2(t_inertia2_cos, t_inertia2_sin)), 360)
                    | Чудаков (2)
                t_j2 = to_MPa(d_j*omega**2/2) | Чудаков (5)
                """,
                second("t_motored2", "motored"),
                f"t_gas2_idle = {t_cold} + ({t_gas} - {t_cold})*(1 - {efficiency}) | линейно по pi",
            ),
            *of_shafts,
        ),
        note=(
            "На холостом ходу коэффициент газов взят линейно по среднему индикаторному давлению "
            "между циклом без сгорания и номинальным: кривых Терских в статье нет."
        ),
    )


def _suppression() -> TableSpec:
    gas = "t_gas2"
    rest = "(1 - balance_suppression)*t_j2_MPa"
    gamma = "rad(gamma_gas2_deg)"
    return TableSpec(
        "suppression",
        "М.в",
        "Гашение опрокидывающего момента 2-го порядка по частоте вращения",
        SHAFTS,
        column_list(f"""
            speed_share
            n_rpm = speed_share*regime_speed_rpm | доля номинальной
            t_j2_MPa = to_MPa(d_j*(n_rpm*pi/30)**2/2) | Чудаков (5)
            residual_bare_MPa = abs({gas} - t_j2_MPa) | Чудаков (6)
            residual_psi_MPa = abs({gas} - {rest}) | Чудаков (6), (7)
            residual_vector_MPa = sqrt(({gas}*cos({gamma}) - {rest})**2 + ({gas}*sin({gamma}))**2)
                | сложение векторов
            psi_best = max(0, 1 - {gas}/t_j2_MPa) | Чудаков, рис. 5
            psi_best_idle = max(0, 1 - t_gas2_idle/t_j2_MPa) | Чудаков, рис. 5
            h_best_mm = to_mm(psi_best*L_rod) | Чудаков (8)
        """),
        stepped(0.3, 1.2, 0.1),
        step=0.1,
    )


def torque_orders(scope: Scope) -> Part:
    """Sheets of the torque's harmonics and of the balance shafts."""
    model, shape = scope.input, scope.shape
    if shape.articulated:  # a hung cylinder's torque has a shape of its own
        return Part()
    # The compression alone and Chudakov's coefficients are those of a central mechanism.
    motored = shape.strokes == 4 and not shape.offset
    blocks = (
        _tangential(model, scope.cycle, motored=motored),
        _orders(model),
    )
    if not motored:
        return Part(blocks, _charts(motored=motored))
    if not has_second_order(model):
        return Part((*blocks, _coefficients(model)), _charts(motored=motored))
    charts = (*_charts(motored=motored), *_shaft_charts())
    return Part((*blocks, _suppression(), _coefficients(model)), charts)


def _charts(*, motored: bool) -> tuple[ChartSpec, ...]:
    """Tangential forces, amplitudes by order."""
    curves = ("gas", "inertia", "motored") if motored else ("gas", "inertia")
    o, k = "torque_orders", "порядок k"
    return (
        over_phi("torque_tangential", SHEET, "Удельные тангенциальные силы", "t, МПа",
                 *columns_of("tangential", *(f"t_{curve}_MPa" for curve in curves))),
        line("torque_amplitudes", SHEET, "Амплитуды гармоник цилиндра по порядкам", (k, "t, МПа"),
             Series(f"{o}.order", f"{o}.gas_amplitude_MPa"),
             Series(f"{o}.order", f"{o}.inertia_amplitude_MPa"),
             Series(f"{o}.order", f"{o}.total_amplitude_MPa", only="workbook"),
             caption="Амплитуды гармоник удельной тангенциальной силы по порядкам",
             y_tex="$t_k^a$, МПа", stems=True),
        line("torque_engine", SHEET, "Амплитуды гармоник момента двигателя", (k, "M, Н·м"),
             Series(f"{o}.order", f"{o}.M_engine_order_Nm"), stems=True),
    )  # fmt: skip


def _shaft_charts() -> tuple[ChartSpec, ...]:
    s, n = "suppression", "n, мин⁻¹"
    return (
        line("suppression", SHAFTS, "Остаток момента 2-го порядка", (n, "t, МПа"),
             *(Series(f"{s}.n_rpm", f"{s}.{k}_MPa")
               for k in ("t_j2", "residual_bare", "residual_psi")),
             caption="Инерционный коэффициент второго порядка и остаток момента"),
        line("suppression_best", SHAFTS, "Оптимальная степень гашения", (n, "ψ"),
             *(Series(f"{s}.n_rpm", f"{s}.{k}") for k in ("psi_best", "psi_best_idle"))),
    )  # fmt: skip
