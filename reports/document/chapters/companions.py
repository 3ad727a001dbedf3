"""Chapter on balance, motion of the shaft, torque orders and series of the piston motion."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np
from markupsafe import Markup

from kshm.chain.firing_orders import rank_firing_orders
from reports.document.chapters.chapter import Chapter
from reports.document.chapters.plots import PHI, phi, series
from reports.document.figures import Level, line_chart, polar_path
from reports.document.page.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.page.spec_tables import angle_table, scalar_table
from reports.document.page.writer import Figure, TablePlan
from reports.document.text.terms import Terms
from reports.inputs.to_si.engine import to_engine
from reports.shared.russian import fixed

_MOST_ORDERS = 8
_NOTHING = 1e-6  # N·m: rounding noise of balanced moments

# Definitions that no single formula of the sheets states.
_FORMULAS = {
    "inertia": r"I_{\mathrm{п}} = I_{\mathrm{к}} + m_{\mathrm{ш}}\dfrac{v_C^2}{\omega^2}"
    r" + I_{\mathrm{ш}}\dfrac{\omega_{\mathrm{ш}}^2}{\omega^2}"
    r" + m_{\mathrm{п}}\dfrac{v_{\mathrm{п}}^2}{\omega^2}",
    "harmonic": r"t_k = t_k^a \sin\left(k\varphi + \gamma_k\right)",
    "series": r"\dfrac{s}{R} = 1 + k - \cos\alpha - p_2\cos 2\alpha + p_4\cos 4\alpha"
    r" - p_6\cos 6\alpha + p_8\cos 8\alpha",
    "exact": r"j = \dfrac{\cos(\alpha+\beta)}{\cos\beta}"
    r" + \lambda\dfrac{\cos^2\alpha}{\cos^3\beta}",
}
_UNITS = {"kN": "кН", "Nm": "Н·м"}
_ALPHA = r"$\alpha$, °"


def companions(chapter: Chapter) -> Markup:
    """Balance, reduced inertia and flywheel, torque orders, exact motion and its series."""
    terms = chapter.terms
    if "balance_orders" not in terms.model.tables:  # no series: an offset or articulated rods
        return Markup("")
    return chapter.page(
        "companions.html.j2",
        formulas=_FORMULAS,
        figures=_figures(terms),
        tables=_tables(chapter),
        ranked="firing_orders" in terms.model.tables,
        banks="order_right_cos" in terms.values.columns["balance_orders"],
        zone=round(terms.value("zone")) if terms.has("zone") else 0,
        series_error=_power(terms.value("j_series_error")),
        moves=_is_there(terms, "balance.Lup_Nm"),
        pulls=_is_there(terms, "balance.Fup_kN"),
    )


def _is_there(terms: Terms, name: str) -> bool:
    return bool(np.abs(terms.column(name)).max() > _NOTHING)


def _vector(terms: Terms, key: str, unit: str, caption: str, label: str) -> Figure:
    """Path of the vector of all orders and of the rotating masses before balancing."""
    right = f"{key}right_{unit}"
    if right not in terms.values.columns["balance"]:
        right = f"{key}rot_right_{unit}"
    x, y = terms.column(f"balance.{right}"), terms.column(f"balance.{key}up_{unit}")
    axes = (f"${label}_x$, {_UNITS[unit]}", f"${label}_y$, {_UNITS[unit]}")
    draw = partial(polar_path, x, y, phi(terms, "balance"), *axes, most=95.0, least_step=30.0)
    return Figure(draw, caption)


def _power(value: float) -> str:
    """A small number as a power of ten."""
    digits, _, exponent = f"{value:.1e}".partition("e")
    superscripts = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
    return f"{digits.replace('.', ',')}·10{str(int(exponent)).translate(superscripts)}"


def _figures(terms: Terms) -> dict[str, Figure]:
    def over(table: str, caption: str, y: str, *keys: str) -> Figure:
        names = [f"{table}.{key}" for key in keys]
        x = phi(terms, table)
        label = PHI if table in ("balance", "inertia", "tangential") else _ALPHA
        curves = series(terms, *names)
        return Figure(partial(line_chart, x, curves, label, y, height=72.0), caption)

    orders = terms.model.tables["torque_orders"].rows
    flywheel = over("inertia", "Угловая скорость вала за цикл", r"$\omega$, с$^{-1}$", "omega_1_s")
    return {
        "forces": over(
            "balance", "Вертикальная свободная сила до и после уравновешивания", "$F$, кН",
            "Fup_kN", "Fup_after_kN",
        ),
        "moments": over(
            "balance", "Продольный свободный момент до и после уравновешивания", "$M$, Н·м",
            "Lup_Nm", "Lup_after_Nm",
        ),
        "inertia": over(
            "inertia", "Приведённый момент инерции одного цилиндра, точно и приближённо",
            "$I$, кг·м²", "I_exact_kgm2", "I_approx_kgm2",
        ),
        "work": over("inertia", "Избыточная работа", "$A$, Дж", "W_J", "Wgas_J"),
        "speed": Figure(
            partial(
                line_chart, phi(terms, "inertia"), series(terms, "inertia.omega_1_s"), PHI,
                r"$\omega$, с$^{-1}$", height=66.0, zero=False,
                levels=(Level(r"$\omega$", terms.value("omega")),),
            ),
            flywheel.caption,
        ),
        "orders": Figure(
            partial(
                line_chart, orders,
                series(terms, *(f"torque_orders.{k}_amplitude_MPa" for k in ("gas", "inertia"))),
                "$k$", "$t_k^a$, МПа", height=66.0, angle=False, x_step=1.0,
            ),
            "Амплитуды гармоник удельной тангенциальной силы по порядкам",
        ),
        "force_vector": _vector(
            terms, "F", "kN", "Конец вектора свободной силы за оборот до уравновешивания", "F"
        ),
        "moment_vector": _vector(
            terms, "L", "Nm", "Конец вектора продольного момента за оборот до уравновешивания", "M"
        ),
        **_suppression(terms),
        "errors": over(
            "segal_errors", "Погрешности приближённых формул", r"доля $R$, $\omega R$, $\omega^2R$",
            "ds", "dv", "dj",
        ),
        "harmonics": over(
            "neiman_motion", "Ускорение поршня и его гармоники", "$j$",
            "j_exact", "j_order1", "j_order2", "j_order4",
        ),
    }  # fmt: skip


def _suppression(terms: Terms) -> dict[str, Figure]:
    if "suppression" not in terms.model.tables:
        return {}
    speeds = tuple(float(v) for v in terms.column("suppression.n_rpm"))
    names = (f"suppression.{k}_MPa" for k in ("t_j2", "residual_bare", "residual_psi"))
    draw = partial(
        line_chart, speeds, series(terms, *names), "$n$, мин$^{-1}$", "$t$, МПа",
        height=66.0, angle=False,
    )  # fmt: skip
    return {
        "suppression": Figure(draw, "Инерционный коэффициент второго порядка и остаток момента")
    }


def _tables(chapter: Chapter) -> dict[str, TablePlan]:
    terms = chapter.terms

    def scalars(caption: str, *keys: str) -> TablePlan:
        present = [key for key in keys if terms.has(key)]
        return TablePlan(partial(scalar_table, terms, present), caption, size="dense", keep=True)

    vectors = [
        f"{key}1_{name}_{part}"
        for key in "FL" for name in ("before", "after") for part in ("max", "min", "deg")
    ]  # fmt: skip
    orders = ["order", "order_amplitude", "order_cos", "order_sin", "F_order_kN", "M_order_Nm",
              "F_left_kN", "M_left_Nm"]  # fmt: skip
    if "order_right_cos" in terms.values.columns["balance_orders"]:
        orders = ["order", "order_amplitude", "F_order_kN", "F_order_min_kN", "F_order_dir_deg",
                  "M_order_Nm", "M_order_min_Nm", "M_order_dir_deg"]  # fmt: skip
    torque = ["order", "gas_amplitude_MPa", "gas_phase_deg", "inertia_amplitude_MPa",
              "inertia_phase_deg", "cylinders_sum", "M_engine_order_Nm"]  # fmt: skip
    return {
        "orders": TablePlan(
            partial(angle_table, terms, "balance_orders", orders),
            "Свободные силы и моменты инерции по порядкам",
            keep=True,
        ),
        "vectors": scalars(
            "Вращающиеся массы и векторы первого порядка", "Frot_bare", "Frot", "Lrot_bare",
            "Lrot", *vectors,
        ),
        "devices": scalars(
            "Противовесы и балансирные валы", "counterweight_needed", "counterweight_web",
            "shaft1_moment", "shaft1_mass", "shaft1_back_moment", "shaft1_back_mass",
            "shaft2_moment", "shaft2_mass", "shaft2_back_moment", "shaft2_back_mass",
        ),
        "firing": TablePlan(
            partial(_firing, chapter), "Порядки работы, лучшие первыми", keep=True
        ),
        "inertia": scalars(
            "Момент инерции и неравномерность хода", "I_crank", "rod_mass", "rod_x", "I_rod",
            "piston_mass", "I_max", "I_min", "I_mean", "delta_I", "I_error_max", "I_engine_mean",
            "delta_I_engine", "W_range", "I_flywheel", "delta_work", "delta_speed",
        ),
        "rod": scalars(
            "Шатун по основным размерам", "rod_model_mass", "rod_model_centre",
            "rod_model_inertia",
        ),
        "torque": TablePlan(
            partial(angle_table, terms, "torque_orders", torque),
            "Гармоники удельной тангенциальной силы и момента двигателя",
            keep=True,
        ),
        "second": scalars(
            "Второй порядок крутящего момента", "d_j", "d_j_technical", "t_gas2",
            "gamma_gas2_deg", "t_inertia2", "t_j2", "t_gas2_idle", "n_zone1", "n_zone2",
            "psi_best_nominal", "h_shafts", "h_shafts_best", "P_shafts",
        ),
        "segal": scalars(
            "Погрешности приближений и крайние ускорения", "ds_max", "alpha_ds_deg", "dv_max",
            "alpha_dv_deg", "dj_max", "alpha_dj_deg", "j_rel_tdc", "j_rel_bdc", "j_exact_min",
            "alpha_j_exact_min_deg", "j_two_term_min", "alpha_j_two_term_min_deg",
        ),
        "neiman": scalars(
            "Коэффициенты ряда перемещения", "neiman_k",
            *(f"neiman_p{n}" for n in (2, 4, 6, 8)),
        ),
        "inverse": TablePlan(
            partial(angle_table, terms, "segal_inverse"),
            "Угол поворота кривошипа по положению поршня",
        ),
    }  # fmt: skip


def _firing(chapter: Chapter) -> TableBlock:
    """The best firing orders with the greatest load of a main journal."""
    columns = [
        Column("Порядок работы", 2.0),
        Column("Неравномерность чередования", 1.6),
        Column(symbol_head(r"\Sigma_{0{,}5}", ""), 1.2),
        Column(symbol_head(r"R_{\mathrm{к.ш}\,\max}", "кН"), 1.4),
    ]
    ranked = rank_firing_orders(to_engine(chapter.input))[:_MOST_ORDERS]
    rows: list[Sequence[str]] = [
        (
            "–".join(map(str, found.order)),
            fixed(found.unevenness, 3),
            fixed(found.half_order if np.abs(found.half_order) > 1e-9 else 0.0, 3),
            fixed(found.journal_load / 1000, 2),
        )
        for found in ranked
    ]
    return table_block(columns, rows)
