"""The sheet of the cycle: the method of Grinevetsky and Mazing step by step.

Passes of Newton's rule stand in visible grids, one column a pass, so that nothing needs
iterative calculation; the solver makes the same passes.
"""

from __future__ import annotations

from kshm.cycle.fuel import FUELS
from kshm.cycle.heat import SPECIES, TEMPERATURE_PASSES
from kshm.cycle.processes import N1_PASSES, N1_START, N2_PASSES, N2_START
from reports.inputs.sections.cycle import CycleSection
from reports.spec.blocks import Grid, Scalar, ScalarTable
from reports.spec.listing import grid_row
from reports.spec.parts import Part, Scope
from reports.tables.gas.cycle_names import SHEET, SOURCE, R, given, is_boosted, section_of

EPS = "geometry_compression_ratio"
_COMPLETE = ("CO2", "H2O", "O2", "N2")
_RICH = ("CO2", "CO", "H2O", "H2", "O2", "N2")


def processes(scope: Scope) -> Part:
    """Fuel, charge, compression, combustion, expansion; nothing without a cycle."""
    section = section_of(scope.input)
    if section is None:
        return Part()
    blocks = (
        _fuel(section),
        _heat(section),
        _charge(section),
        _compression_passes(),
        _compression(),
        _content(section),
        _temperature_passes(section),
        _combustion(section),
        _expansion_passes(),
        _expansion(),
    )
    return Part(blocks)


def _table(name: str, title: str, *scalars: Scalar) -> ScalarTable:
    return ScalarTable(f"cycle_{name}", title, SHEET, scalars)


def _s(key: str, expr: str, source: str = SOURCE) -> Scalar:
    return Scalar(key, expr, source)


# --- energy of gases by the mean heat capacities, t in °C ---


def weight(t: str) -> str:
    """Weight of the upper heat capacity formula, blended between 1400 and 1500 °C."""
    return f"max(0, min(1, ({t} - 1400)/100))"


def air_energy(t: str, w: str) -> str:
    """Internal energy of air above 0 °C [kJ/kmol]."""
    return f"({t})*((1 - {w})*(20.6 + 0.002638*({t})) + {w}*(22.387 + 0.001449*({t})))"


def products_mean(t: str, w: str) -> str:
    """Mean heat capacity of the products [kJ/(kmol·K)]."""
    low = f"(heat_a + heat_b*({t}) + heat_c*({t})**2)"
    return f"(1 - {w})*{low} + {w}*(hot_a + hot_b*({t}))"


def products_energy(t: str, w: str) -> str:
    """Internal energy of the products above 0 °C [kJ/kmol]."""
    return f"({t})*({products_mean(t, w)})"


def products_true(t: str, w: str) -> str:
    """True heat capacity dU/dt of the products [kJ/(kmol·K)]."""
    low = f"(heat_a + 2*heat_b*({t}) + 3*heat_c*({t})**2)"
    gap = f"(hot_a + hot_b*({t}) - heat_a - heat_b*({t}) - heat_c*({t})**2)"
    blend = f"({t})*{gap}/100"
    return (
        f"(1 - {w})*{low} + {w}*(hot_a + 2*hot_b*({t})) + ({blend} if {w} > 0 and {w} < 1 else 0)"
    )


# --- fuel, mixture, heat capacities ---


def _species(section: CycleSection) -> tuple[str, ...]:
    return _COMPLETE if section.kind == "diesel" else _RICH


def _fuel(section: CycleSection) -> ScalarTable:
    fuel = None if section.fuel == "own" else FUELS[section.fuel]
    alpha, missing = "cycle_excess_air", "max(1 - cycle_excess_air, 0)"
    rich = section.kind == "petrol"
    source = "ввод"
    if fuel is not None:
        source = {
            "listing": "Гоц, прил. 2",
            "stoichiometry": "по молекуле",
            "memory": "по памяти, не сверено",
        }[fuel.source]
    if fuel is None:
        parts = ["cycle_fuel_carbon", "cycle_fuel_hydrogen", "cycle_fuel_oxygen"]
        heat, mass = "cycle_fuel_heating_value_mj_kg", "cycle_fuel_molar_mass_kg_kmol"
    else:
        parts = [repr(fuel.carbon), repr(fuel.hydrogen), repr(fuel.oxygen)]
        heat, mass = repr(fuel.heating_value / 1e6), repr(fuel.vapour_molar_mass)
    ratio = given(section, "h2_co_ratio", "0.5")
    scalars = [
        *(
            _s(key, expr, source)
            for key, expr in zip(("cyc_C", "cyc_H", "cyc_O"), parts, strict=True)
        ),
        _s("cyc_Hu", heat, source),
        _s("cyc_L0", "(cyc_C/12 + cyc_H/4 - cyc_O/32)/0.208"),
        _s("cyc_air_mass", "28.96*cyc_L0"),
        _s("cyc_M1", f"{alpha}*cyc_L0" + (f" + 1/{mass}" if rich else "")),
    ]
    if rich:
        scalars += [
            _s("mix_CO", f"2*0.208*{missing}*cyc_L0/(1 + {ratio})"),
            _s("mix_H2", f"{ratio}*mix_CO"),
            _s("mix_CO2", "cyc_C/12 - mix_CO"),
            _s("mix_H2O", "cyc_H/2 - mix_H2"),
        ]
    else:
        scalars += [_s("mix_CO2", "cyc_C/12"), _s("mix_H2O", "cyc_H/2")]
    amounts = ", ".join(f"mix_{name}" for name in _species(section))
    scalars += [
        _s("mix_O2", f"0.208*max({alpha} - 1, 0)*cyc_L0"),
        _s("mix_N2", f"0.792*{alpha}*cyc_L0"),
        _s("cyc_M2", f"total({amounts})"),
        _s("cyc_mu0", "cyc_M2/cyc_M1"),
        _s("cyc_dHu", f"119.95*{missing}*cyc_L0"),
    ]
    return _table("fuel", "Топливо, свежий заряд и продукты сгорания", *scalars)


def _heat(section: CycleSection) -> ScalarTable:
    def mixed(part: str, index: int) -> str:
        terms = []
        for name in _species(section):
            value = getattr(SPECIES[name], part)[index]
            if value:
                terms.append(f"{value!r}*mix_{name}")
        return f"total({', '.join(terms)})/cyc_M2"

    return _table(
        "heat",
        "Средняя мольная теплоёмкость продуктов сгорания при V = const",
        _s("heat_a", mixed("lower", 0)),
        _s("heat_b", mixed("lower", 1)),
        _s("heat_c", mixed("lower", 2)),
        _s("hot_a", mixed("upper", 0)),
        _s("hot_b", mixed("upper", 1)),
    )


# --- charge ---


def _charge(section: CycleSection) -> ScalarTable:
    p_0, t_0 = "gas_ambient_pressure_mpa", "cycle_ambient_temperature_k"
    scalars = []
    if is_boosted(section):
        loss = given(section, "cooler_loss_mpa", "0")
        drop = given(section, "cooler_drop_k", "0")
        rise = "(cycle_boost_ratio**(0.4/1.4) - 1)/cycle_compressor_efficiency"
        scalars = [
            _s("cyc_p_k", f"{p_0}*cycle_boost_ratio - {loss}", "Гоц, прил. 2"),
            _s("cyc_T_comp", f"{t_0}*(1 + {rise})", "Гоц, прил. 2"),
            _s("cyc_T_k", f"cyc_T_comp - {drop}", "Гоц, прил. 2"),
        ]
    else:
        scalars = [_s("cyc_p_k", p_0), _s("cyc_T_k", t_0)]
    residual = (
        "20.2 + 0.92/max(cycle_excess_air, 1)"
        " + (15.5 + 13.8/max(cycle_excess_air, 1))*0.0001*cycle_residual_temperature_k"
    )
    scalars += [
        _s("cyc_T_x", "cyc_T_k + cycle_charge_heating_k"),
        _s("cyc_p_a", "cycle_intake_factor*cyc_p_k", "Гоц, прил. 2"),
        _s("cyc_p_r", "cycle_exhaust_factor*cyc_p_k", "Гоц, прил. 2"),
        _s(
            "cyc_eta_v",
            f"cycle_recharge*({EPS}*cyc_p_a - cyc_p_r)/(({EPS} - 1)*cyc_p_k)*cyc_T_k/cyc_T_x",
        ),
        _s(
            "cyc_gamma",
            "cycle_scavenging*cyc_p_r*cyc_T_k"
            f"/(({EPS} - 1)*cyc_p_k*cycle_residual_temperature_k*cyc_eta_v)",
        ),
        _s("cyc_psi", f"({residual} + {R})/(20.16 + 0.001738*cyc_T_x + {R})"),
        _s(
            "cyc_T_a",
            "(cyc_T_x + cyc_psi*cyc_gamma*cycle_residual_temperature_k)/(1 + cyc_psi*cyc_gamma)",
        ),
    ]
    return _table("charge", "Наполнение", *scalars)


# --- compression ---


def passes(name: str, title: str, count: int, rows: dict[str, list[str]]) -> Grid:
    """A grid of passes: quantity → formulas; cells are called ``quantity_name_pass``."""
    return Grid(
        f"cycle_{name}",
        title,
        SHEET,
        tuple(f"проход {i}" for i in range(1, count + 1)),
        tuple(grid_row(of, exprs, SOURCE, f"{of}_{name}_{{n}}") for of, exprs in rows.items()),
    )


def cell(quantity: str, name: str, number: int) -> str:
    """Key of a cell of a grid of passes."""
    return f"{quantity}_{name}_{number}"


def _compression_passes() -> Grid:
    rows: dict[str, list[str]] = {"pass_T_c": [], "pass_g": [], "pass_x": []}
    for i in range(1, N1_PASSES + 1):
        x = f"{N1_START - 1:.2f}" if i == 1 else cell("pass_x", "n1", i - 1)
        t_c, g = cell("pass_T_c", "n1", i), cell("pass_g", "n1", i)
        rows["pass_T_c"].append(f"cyc_T_a*{EPS}**{x}")
        rows["pass_g"].append(f"{R}/(20.6 + 0.002638*(cyc_T_a + {t_c} - 546))")
        rows["pass_x"].append(f"{x} + ({g} - {x})/(1 + {g}**2*0.002638*{t_c}*ln({EPS})/{R})")
    return passes("n1", "Показатель политропы сжатия: n1 − 1 = g(n1)", N1_PASSES, rows)


def _compression() -> ScalarTable:
    return _table(
        "compression",
        "Сжатие",
        _s("cyc_n1", f"1 + {cell('pass_x', 'n1', N1_PASSES)}"),
        _s("cyc_p_c", f"cyc_p_a*{EPS}**cyc_n1"),
        _s("cyc_T_c", f"cyc_T_a*{EPS}**(cyc_n1 - 1)"),
    )


# --- combustion ---


def _extra(section: CycleSection) -> str:
    """What is added to the heat capacity: R at constant pressure, nothing at constant volume."""
    return R if section.kind == "diesel" else "0"


def _content(section: CycleSection) -> ScalarTable:
    t_c, extra = "cyc_T_c - 273", _extra(section)
    scalars = [
        _s("cyc_mu", "(cyc_mu0 + cyc_gamma)/(1 + cyc_gamma)"),
        _s("cyc_q", "1000*(cyc_Hu - cyc_dHu)/(cyc_M1*(1 + cyc_gamma))"),
        _s("cyc_w_c", weight(t_c)),
        _s("cyc_U_air", air_energy(t_c, "cyc_w_c")),
        _s("cyc_U_rest", products_energy(t_c, "cyc_w_c")),
        _s("cyc_U_c", "(cyc_U_air + cyc_gamma*cyc_U_rest)/(1 + cyc_gamma)"),
    ]
    content = "cycle_xi_z*cyc_q + cyc_U_c"
    if section.kind == "diesel":
        scalars.append(_s("cyc_lambda_p", "cycle_max_pressure_mpa/cyc_p_c"))
        content += f" + {R}*(cyc_lambda_p*({t_c}) + 273*(cyc_lambda_p - cyc_mu))"
    linear = f"cyc_mu*(hot_a + {extra})" if extra != "0" else "cyc_mu*hot_a"
    quadratic = "4*cyc_mu*hot_b*cyc_content"
    scalars += [
        _s("cyc_content", content),
        _s("cyc_t_root", f"(sqrt(({linear})**2 + {quadratic}) - {linear})/(2*cyc_mu*hot_b)"),
    ]
    return _table("content", "Сгорание: уравнение теплового баланса", *scalars)


def _temperature_passes(section: CycleSection) -> Grid:
    names = ("blend", "pass_mean", "pass_true", "pass_t_z")
    rows: dict[str, list[str]] = {name: [] for name in names}
    extra = "" if section.kind == "petrol" else f" + {R}"
    for i in range(1, TEMPERATURE_PASSES + 1):
        t = "cyc_t_root" if i == 1 else cell("pass_t_z", "tz", i - 1)
        w, mean, true = (cell(name, "tz", i) for name in names[:3])
        rows["blend"].append(weight(t))
        rows["pass_mean"].append(products_mean(t, w))
        rows["pass_true"].append(products_true(t, w))
        rows["pass_t_z"].append(
            f"{t} - (cyc_mu*({mean}{extra})*{t} - cyc_content)/(cyc_mu*({true}{extra}))"
        )
    title = "Температура tz при корне ниже 1500 °C (иначе берётся корень)"
    return passes("tz", title, TEMPERATURE_PASSES, rows)


def _combustion(section: CycleSection) -> ScalarTable:
    last = cell("pass_t_z", "tz", TEMPERATURE_PASSES)
    scalars = [_s("cyc_T_z", f"(cyc_t_root + 273) if cyc_t_root >= 1500 else ({last} + 273)")]
    if section.kind == "diesel":
        scalars += [
            _s("cyc_p_z", "cycle_max_pressure_mpa", "ввод"),
            _s("cyc_rho", "cyc_mu*cyc_T_z/(cyc_lambda_p*cyc_T_c)"),
        ]
    else:
        scalars += [
            _s("cyc_lambda_p", "cyc_mu*cyc_T_z/cyc_T_c"),
            _s("cyc_p_z", "cyc_lambda_p*cyc_p_c"),
            _s("cyc_rho", "1", "V = const"),
        ]
    t_z = "cyc_T_z - 273"
    scalars += [
        _s("cyc_delta", f"{EPS}/cyc_rho"),
        _s("cyc_w_z", weight(t_z)),
        _s("cyc_U_z", products_energy(t_z, "cyc_w_z")),
        _s("cyc_Q_exp", "(cycle_xi_b - cycle_xi_z)*cyc_q/cyc_mu"),
    ]
    return _table("combustion", "Сгорание: точка z", *scalars)


# --- expansion ---


def _expansion_passes() -> Grid:
    names = ("pass_T_b", "blend", "pass_U_b", "pass_h", "pass_c_b", "pass_x")
    rows: dict[str, list[str]] = {name: [] for name in names}
    for i in range(1, N2_PASSES + 1):
        x = f"{N2_START - 1:.2f}" if i == 1 else cell("pass_x", "n2", i - 1)
        t_b, w, u_b, h, c_b = (cell(name, "n2", i) for name in names[:5])
        t = f"{t_b} - 273"
        rows["pass_T_b"].append(f"cyc_T_z/cyc_delta**{x}")
        rows["blend"].append(weight(t))
        rows["pass_U_b"].append(products_energy(t, w))
        rows["pass_h"].append(f"(cyc_Q_exp + cyc_U_z - {u_b})/(cyc_T_z - {t_b})")
        rows["pass_c_b"].append(products_true(t, w))
        slope = f"{x}*({h} - {c_b})*{t_b}*ln(cyc_delta)/(cyc_T_z - {t_b})"
        rows["pass_x"].append(f"{x} - ({x}*{h} - {R})/({h} - {slope})")
    return passes("n2", "Показатель политропы расширения", N2_PASSES, rows)


def _expansion() -> ScalarTable:
    return _table(
        "expansion",
        "Расширение",
        _s("cyc_n2", f"1 + {cell('pass_x', 'n2', N2_PASSES)}"),
        _s("cyc_p_b", "cyc_p_z/cyc_delta**cyc_n2"),
        _s("cyc_T_b", "cyc_T_z/cyc_delta**(cyc_n2 - 1)"),
        _s("cyc_T_r_check", "cyc_T_b*(cyc_p_r/cyc_p_b)**(1/3)"),
    )
