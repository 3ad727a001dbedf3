"""Speed characteristic, indicator diagram and plausibility of the calculated cycle."""

from __future__ import annotations

from kshm.cycle.speed_characteristic import IDLE_SHARE, LEIDERMAN
from kshm.cycle.usual_ranges import usual_ranges
from kshm.nomenclature.dizdn_listing import EXTRA, INPUTS, OUTPUTS
from kshm.results.cycle import DIAGRAM_STEP, SPEED_STEP, diagram_rows, speed_rows
from reports.inputs.sections.cycle import CycleSection
from reports.shared.russian import short
from reports.spec.blocks import Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, line, over_phi
from reports.spec.judged import judged
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope
from reports.tables.gas.cycle_names import SHEET, SOURCE, is_boosted, section_of

SPEED_SHEET, DIAGRAM_SHEET, RANGE_SHEET = "ВСХ", "Диаграмма цикла", "Правдоподобие цикла"
UNCHECKED = "обычные значения, с книгой не сверены"
LEIDERMAN_SOURCE = "Лейдерман, по памяти"
INSIDE, OUTSIDE = "в пределах", "вне пределов"
EPS = "geometry_compression_ratio"

# Where the results and inputs with a usual range stand among the scalars and inputs.
_RANGE_NAMES = {
    "inputs.excess_air": "cycle_excess_air",
    "inputs.charge_heating": "cycle_charge_heating_k",
    "inputs.t_residual": "cycle_residual_temperature_k",
    "inputs.recharge": "cycle_recharge",
    "inputs.scavenging": "cycle_scavenging",
    "inputs.xi_z": "cycle_xi_z",
    "inputs.xi_b": "cycle_xi_b",
    "inputs.fullness": "cycle_fullness",
    "charge.gamma": "cyc_gamma",
    "charge.t_a": "cyc_T_a",
    "charge.eta_v": "cyc_eta_v",
    "compression.n_1": "cyc_n1",
    "compression.p_c": "cyc_p_c",
    "compression.t_c": "cyc_T_c",
    "combustion.lambda_p": "cyc_lambda_p",
    "combustion.t_z": "cyc_T_z",
    "combustion.p_z": "cyc_p_z",
    "expansion.n_2": "cyc_n2",
    "expansion.p_b": "cyc_p_b",
    "expansion.t_b": "cyc_T_b",
    "effective.eta_m": "cyc_eta_m",
    "indicated.p_i": "cyc_p_i",
}


def speed(scope: Scope) -> Part:
    """Diagram, speed characteristic and plausibility; nothing without a cycle."""
    section = section_of(scope.input)
    if section is None:
        return Part()
    blocks = (
        _diagram_points(),
        _law(section),
        _diagram(),
        _speed(section),
        _ranges(section),
    )
    return Part(blocks, _charts())


def _diagram() -> TableSpec:
    rise = "(1 - sqrt(1 - lam**2*sin(rad(phi_deg))**2))/lam"
    z = "cyc_rho/cd_ratio"
    pressure = f"(cyc_p_c/cd_ratio**cyc_n1) if phi_deg < 360 else (cyc_p_z*min(1, {z})**cyc_n2)"
    temperature = (
        "(cyc_T_c/cd_ratio**(cyc_n1 - 1)) if phi_deg < 360"
        f" else (cyc_T_z*min(1, cd_ratio/cyc_rho)*min(1, {z})**(cyc_n2 - 1))"
    )
    return TableSpec(
        "cycle_diagram",
        "Ц",
        "Индикаторная диаграмма цикла по точкам",
        DIAGRAM_SHEET,
        column_list(f"""
            phi_deg
            cd_s_mm = to_mm(r_crank*((1 - cos(rad(phi_deg))) + {rise})) | Гоц (1)
            cd_ratio = 1 + ({EPS} - 1)*of_mm(cd_s_mm)/S_stroke | {SOURCE}
            cd_V_dm3 = V_c*cd_ratio | {SOURCE}
            cd_p_MPa = {pressure} | {SOURCE}
            cd_T_K = {temperature} | {SOURCE}
        """),
        tuple(float(x) for x in diagram_rows()),
        note="Нескруглённая диаграмма; при 360° стоит точка z′, конец сжатия c — на листе «Цикл».",
        step=DIAGRAM_STEP,
    )


def _diagram_points() -> ScalarTable:
    s = f"(2*(cyc_rho - 1)/({EPS} - 1))"
    half = f"{s}*(2/lam - {s})/(4*(1 + 1/lam - {s}))"
    return ScalarTable(
        "cycle_points",
        "Точка z",
        SHEET,
        scalar_list(f"""
            cyc_phi_z = 360 + 2*deg(asin(sqrt(max(0, min(1, {half}))))) | Гоц (1), обращение
        """),
    )


def _speed(section: CycleSection) -> TableSpec:
    x = "speed_percent/100"
    return TableSpec(
        "speed",
        "С",
        "Внешняя скоростная характеристика",
        SPEED_SHEET,
        column_list(f"""
            speed_percent
            speed_n = regime_speed_rpm*{x} | {SOURCE}
            speed_Ne = pi*speed_Me*speed_n/30000 | Гоц, 2.9
            speed_Me = cyc_M_e*(spd_a + spd_b*{x} - spd_c*({x})**2) | {LEIDERMAN_SOURCE}
            speed_ge = cyc_g_e*(spd_fa + spd_fb*{x} + spd_fc*({x})**2) | {LEIDERMAN_SOURCE}
            speed_Gf = speed_ge*speed_Ne/1000 | {SOURCE}
        """),
        tuple(float(x) for x in speed_rows(section.kind)),
        step=SPEED_STEP,
    )


def _law(section: CycleSection) -> ScalarTable:
    base = LEIDERMAN[section.speed_law or section.kind]
    if section.adaptability is not None:
        ratio = "cycle_torque_speed_rpm/regime_speed_rpm"
        source = "по заданным K и n_M"
        c = f"(cycle_adaptability - 1)/(1 - {ratio})**2"
        law = (f"cycle_adaptability - spd_c*({ratio})**2", f"2*spd_c*{ratio}", c)
    else:
        source = LEIDERMAN_SOURCE
        law = (repr(base.a), repr(base.b), repr(base.c))
    scalars = [
        Scalar(key, expr, source)
        for key, expr in zip(("spd_a", "spd_b", "spd_c"), law, strict=True)
    ]
    scalars += [
        Scalar(key, repr(value), LEIDERMAN_SOURCE)
        for key, value in zip(("spd_fa", "spd_fb", "spd_fc"), base.fuel, strict=True)
    ]
    scalars += [
        *scalar_list("""
            spd_Kc = min(1, spd_b/(2*spd_c)) | Гоц, 2.9
            spd_K = spd_a + spd_b*spd_Kc - spd_c*spd_Kc**2 | Гоц, 2.9
        """),
        *_regimes(section),
    ]
    return ScalarTable(
        "speed_law", "Внешняя скоростная характеристика и режимы", SHEET, tuple(scalars)
    )


def _regimes(section: CycleSection) -> list[Scalar]:
    middle, idle = section.torque_speed_rpm is not None, section.idle_speed_rpm is not None
    share = IDLE_SHARE[section.kind]
    x = "(reg_n_M/regime_speed_rpm)"
    return [
        Scalar(
            "reg_n_M",
            "cycle_torque_speed_rpm" if middle else "spd_Kc*regime_speed_rpm",
            "задано" if middle else "производный: вершина M(n)",
        ),
        *scalar_list(f"""
            reg_Me_M = cyc_M_e*(spd_a + spd_b*{x} - spd_c*{x}**2) | {LEIDERMAN_SOURCE}
            reg_Ne_M = pi*reg_Me_M*reg_n_M/30000 | Гоц, 2.9
        """),
        Scalar(
            "reg_n_idle",
            "cycle_idle_speed_rpm" if idle else f"{share}*regime_speed_rpm",
            "задано" if idle else f"производный: {short(share)}·n, по памяти",
        ),
    ]


def _ranges(section: CycleSection) -> ScalarTable:
    titles = {q.key: q for q in (*OUTPUTS, *EXTRA)}
    titles |= {f"inputs.{q.key}": q for q in INPUTS}
    scalars: list[Scalar] = []
    for key, usual in usual_ranges(section.kind, boosted=is_boosted(section)).items():
        about, name = titles[key], _RANGE_NAMES[key]
        unit = f", {about.unit}" if about.unit else ""
        low, high = map(short, (usual.low, usual.high))
        note = f"{about.title} {about.symbol.replace('_', '')}{unit}: обычно {low}…{high}"
        # A limit is met, though the last digit of a computed value may miss it.
        rounded = "round({value}, 9)"
        scalars += judged(
            f"range_value_{name}",
            f"range_{name}",
            name,
            f"{rounded} >= {usual.low!r} and {rounded} <= {usual.high!r}",
            note,
            usual.reference or UNCHECKED,
            (INSIDE, OUTSIDE),
        )
    return ScalarTable(
        "cycle_ranges",
        "Правдоподобие: результат и обычные пределы",
        RANGE_SHEET,
        tuple(scalars),
        note="Пределы не взяты из учебника: у каждого указано, откуда он.",
        verdicts=(INSIDE, OUTSIDE),
    )


def _charts() -> tuple[ChartSpec, ...]:
    names = (
        ("Ne", "Эффективная мощность", "мощность", "Nе, кВт"),
        ("Me", "Эффективный крутящий момент", "крутящий момент", "Mе, Н·м"),
        ("ge", "Удельный расход топлива", "удельный расход топлива", "gе, г/(кВт·ч)"),
        ("Gf", "Часовой расход топлива", "часовой расход топлива", "Gт, кг/ч"),
    )
    return (
        line("cycle_pv", DIAGRAM_SHEET, "Диаграмма цикла p–V: расчётная и принятая в динамике",
             ("V, дм³", "p, МПа"),
             Series("cycle_diagram.cd_V_dm3", "cycle_diagram.cd_p_MPa", "расчётный цикл"),
             Series("gas.volume_dm3", "gas.p_MPa", "принято в динамике", only="workbook"),
             caption="Нескруглённая индикаторная диаграмма рассчитанного цикла",
             levels=("gas_ambient_pressure_mpa",)),
        over_phi("cycle_T", DIAGRAM_SHEET, "Температура газов в цилиндре", "T, К",
                 "cycle_diagram.cd_T_K", x=("phi_deg", "угол, ° ПКВ"), from_zero=False,
                 caption="Температура газов в цилиндре при сжатии, сгорании и расширении"),
        *(
            line(f"speed_{key}", SPEED_SHEET, f"{title} по внешней характеристике",
                 ("n, мин⁻¹", label), Series("speed.speed_n", f"speed.speed_{key}"),
                 group="Внешняя скоростная характеристика", panel=panel)
            for key, title, panel, label in names
        ),
    )  # fmt: skip
