"""Figures of the cycle: indicated and effective, sizes, turbocharger, heat balance."""

from __future__ import annotations

from reports.inputs.sections.cycle import PUMPING, ROUNDINGS, CycleSection
from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Block, Grid, Scalar, ScalarTable
from reports.spec.listing import scalar_list
from reports.spec.parts import Part, Scope
from reports.tables.gas.cycle import EPS, air_energy, cell, passes, products_energy, weight
from reports.tables.gas.cycle_names import (
    SHEET,
    SOURCE,
    R,
    friction_by_speed,
    given,
    is_boosted,
    section_of,
    sizes_are_found,
)

STROKE_PASSES = 6  # Newton's rule: four are enough, two to spare


def results(scope: Scope) -> Part:
    """What follows from the processes; nothing without a cycle."""
    model = scope.input
    section = section_of(model)
    if section is None:
        return Part()
    blocks: list[Block] = [_indicated()]
    if sizes_are_found(model):
        if friction_by_speed(section):
            blocks.append(_stroke_passes())
        blocks.append(_sizes(section))
    blocks.append(_effective(model, section))
    if is_boosted(section):
        blocks.append(_turbo(section))
    blocks.append(_balance(section))
    return Part(tuple(blocks))


def _table(name: str, title: str, *scalars: Scalar) -> ScalarTable:
    return ScalarTable(f"cycle_{name}", title, SHEET, scalars)


def _s(key: str, expr: str, source: str = SOURCE) -> Scalar:
    return Scalar(key, expr, source)


def _indicated() -> ScalarTable:
    work = (
        "cyc_lambda_p*(cyc_rho - 1)"
        " + cyc_lambda_p*cyc_rho/(cyc_n2 - 1)*(1 - cyc_delta**(1 - cyc_n2))"
        " - (1 - cyc_T_a/cyc_T_c)/(cyc_n1 - 1)"
    )
    rounded = "cycle_fullness*cyc_p_theory"
    p_i = f'({rounded} - (cyc_p_r - cyc_p_a)) if cycle_pumping == "{PUMPING["yes"]}" else {rounded}'
    return _table(
        "indicated",
        "Индикаторные показатели",
        _s("cyc_work", work),
        _s("cyc_p_theory", f"cyc_p_c*cyc_work/({EPS} - 1)"),
        _s("cyc_p_i", p_i),
        _s("cyc_g_i", f"3600000*cyc_eta_v*cyc_p_k/({R}*cyc_T_k*cyc_M1*cyc_p_i)"),
        _s("cyc_eta_i", "3600/(cyc_g_i*cyc_Hu)"),
    )


_VOLUME = "30*engine_strokes*cycle_power_kw/({p_e}*regime_speed_rpm*engine_cylinders)"


def _stroke_passes() -> Grid:
    """Newton's rule for S = F(S): F falls with the cube root of p_e, p_e with the speed."""
    names = ("pass_c_m", "pass_p_e", "pass_F", "pass_S")
    rows: dict[str, list[str]] = {name: [] for name in names}
    for i in range(1, STROKE_PASSES + 1):
        stroke = "100" if i == 1 else cell("pass_S", "stroke", i - 1)
        c_m, p_e, found = (cell(name, "stroke", i) for name in names[:3])
        volume = _VOLUME.format(p_e=p_e)
        slope = f"{found}/3*cycle_friction_b_mpa_s_m*regime_speed_rpm/30000/{p_e}"
        rows["pass_c_m"].append(f"of_mm({stroke})*regime_speed_rpm/30")
        rows["pass_p_e"].append(f"cyc_p_i - cycle_friction_a_mpa - cycle_friction_b_mpa_s_m*{c_m}")
        rows["pass_F"].append(f"100*cycle_stroke_bore*(4*({volume})/(pi*cycle_stroke_bore))**(1/3)")
        rows["pass_S"].append(f"{stroke} - ({stroke} - {found})/(1 - {slope})")
    title = "Ход поршня по мощности при потерях, зависящих от скорости поршня"
    return passes("stroke", title, STROKE_PASSES, rows)


def _sizes(section: CycleSection) -> ScalarTable:
    if friction_by_speed(section):
        last = cell("pass_p_e", "stroke", STROKE_PASSES)
        p_e = last
    else:
        p_e = "regime_mechanical_efficiency*cyc_p_i"
    step = given(section, "size_step_mm", "1")

    def rounded(size: str) -> str:
        nearest = f"{step}*round({size}/{step})"
        up = f"-({step}*floor(-round({size}/{step}, 9)))"
        if section.rounding is None:
            return nearest
        return f'({up}) if cycle_rounding == "{ROUNDINGS["up"]}" else ({nearest})'

    return _table(
        "sizes",
        "Размеры цилиндра по заданной мощности",
        _s("cyc_p_e_0", p_e),
        _s("cyc_V_h_0", _VOLUME.format(p_e="cyc_p_e_0"), "Гоц, 2.9"),
        _s("cyc_D_0", "100*(4*cyc_V_h_0/(pi*cycle_stroke_bore))**(1/3)", "Гоц, 2.9"),
        _s("cyc_S_0", "cyc_D_0*cycle_stroke_bore", "Гоц, 2.9"),
        _s("cyc_D", rounded("cyc_D_0"), "Гоц, 2.9"),
        _s("cyc_S", rounded("cyc_S_0"), "Гоц, 2.9"),
    )


def _effective(model: InputFile, section: CycleSection) -> ScalarTable:
    losses = "(1 - regime_mechanical_efficiency)*cyc_p_i"
    if friction_by_speed(section):
        losses = "cycle_friction_a_mpa + cycle_friction_b_mpa_s_m*c_m"
    power = "*V_engine*regime_speed_rpm/(30*engine_strokes)"
    scalars = [
        _s("cyc_p_m", losses),
        _s("cyc_p_e", "cyc_p_i - cyc_p_m"),
        _s("cyc_eta_m", "cyc_p_e/cyc_p_i"),
        _s("cyc_eta_e", "cyc_eta_i*cyc_eta_m"),
        _s("cyc_g_e", "cyc_g_i/cyc_eta_m"),
        _s("cyc_N_i", f"cyc_p_i{power}"),
        _s("cyc_N_e", f"cyc_p_e{power}"),
        _s("cyc_N_gas", f"(cyc_p_theory - (cyc_p_r - cyc_p_a)){power}"),
        _s("cyc_M_e", "30000/pi*cyc_N_e/regime_speed_rpm"),
        _s("cyc_G_f", "cyc_g_e*cyc_N_e/1000"),
        _s("cyc_G_a", "cycle_excess_air*cyc_air_mass*cyc_G_f"),
    ]
    if sizes_are_found(model):
        scalars.append(_s("cyc_N_error", "(cyc_N_e/cycle_power_kw - 1)*100"))
    return _table("effective", "Эффективные показатели", *scalars)


def _turbo(section: CycleSection) -> ScalarTable:
    outlet = given(section, "turbine_outlet_ratio", "1.03")
    heat = given(section, "exhaust_heat_kj_kg_k", "1.15")
    stream = f"cyc_G_t*{heat}*cycle_turbine_efficiency"
    w_b, u_b = cell("blend", "turbo", 1), cell("pass_U_b", "turbo", 1)
    fall = f"(cyc_U_z - {u_b})"
    return _table(
        "turbo",
        "Турбокомпрессор",
        _s("cyc_G_k", "cyc_G_a/3600"),
        _s("cyc_N_k", "1.005*cyc_G_k*(cyc_T_comp - cycle_ambient_temperature_k)"),
        _s("cyc_G_t", "(cyc_G_a + cyc_G_f)/3600"),
        *scalar_list(f"""
            {w_b} of blend = {weight("cyc_T_b - 273")} | {SOURCE}
            {u_b} of pass_U_b = {products_energy("cyc_T_b - 273", w_b)} | {SOURCE}
        """),
        _s("cyc_k_gas", f"1 + {R}*(cyc_T_z - cyc_T_b)/{fall}"),
        _s("cyc_e_gas", "(cyc_k_gas - 1)/cyc_k_gas"),
        _s("cyc_p_t", "cyc_p_r"),
        _s("cyc_T_t", "cyc_T_b*(cyc_p_t/cyc_p_b)**cyc_e_gas"),
        _s("cyc_p_out", f"{outlet}*gas_ambient_pressure_mpa"),
        _s("cyc_N_t", f"{stream}*cyc_T_t*max(0, 1 - (cyc_p_out/cyc_p_t)**cyc_e_gas)"),
        _s(
            "cyc_p_bal",
            f"(cyc_p_out**cyc_e_gas + cyc_N_k*cyc_p_b**cyc_e_gas/({stream}*cyc_T_b))"
            "**(1/cyc_e_gas)",
        ),
        _s("cyc_C2_bal", "cyc_p_bal/cyc_p_k"),
    )


def _balance(section: CycleSection) -> ScalarTable:
    t_r, t_k = "cycle_residual_temperature_k - 273", "cyc_T_k - 273"
    gas = f"cyc_M2*(bal_U_r + {R}*({t_r})) - cyc_M1*(bal_U_k + {R}*({t_k}))"
    scalars = [
        _s("bal_w_r", weight(t_r)),
        _s("bal_U_r", products_energy(t_r, "bal_w_r")),
        _s("bal_U_k", air_energy(t_k, "0")),
        _s("bal_total", "cyc_Hu*cyc_G_f/3.6"),
        _s("bal_useful", "cyc_N_e"),
        _s("bal_exhaust", f"cyc_G_f/3600*({gas})"),
        _s("bal_incomplete", "cyc_dHu*cyc_G_f/3.6"),
        _s("bal_rest", "bal_total - bal_useful - bal_exhaust - bal_incomplete"),
    ]
    if is_boosted(section):
        drop = given(section, "cooler_drop_k", "0")
        scalars.append(_s("bal_cooler", f"1.005*cyc_G_a/3600*{drop}"))
    scalars += [
        _s(f"bal_{part}_share", f"bal_{part}/bal_total*100")
        for part in ("useful", "exhaust", "incomplete", "rest")
    ]
    return _table("balance", "Тепловой баланс", *scalars)
