"""Chapter on torque orders, exact motion of the piston and its series."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from kshm.nomenclature.digits import scientific
from reports.document.chapters.balance import asked_devices
from reports.document.chapters.chapter import Chapter
from reports.document.page.spec_tables import counted_table
from reports.document.page.writer import TablePlan
from reports.shared.russian import written

# Definitions that no single formula of the sheets states.
_FORMULAS = {
    "harmonic": r"t_k = t_k^a \sin\left(k\varphi + \gamma_k\right)",
    "series": r"\bar s = 1 + k_s - \cos\varphi - p_2\cos 2\varphi + p_4\cos 4\varphi"
    r" - p_6\cos 6\varphi + p_8\cos 8\varphi",
    "exact": r"\bar j = \dfrac{\cos(\varphi+\beta)}{\cos\beta}"
    r" + \lambda\dfrac{\cos^2\varphi}{\cos^3\beta}",
}
_LISTS = {
    "second": (
        "Второй порядок крутящего момента",
        ("d_j", "t_gas2", "gamma_gas2_deg", "t_inertia2", "t_j2", "t_gas2_idle",
         "n_zone1", "n_zone2", "psi_best_nominal", "h_shafts", "h_shafts_best", "P_shafts"),
    ),
    "segal": (
        "Погрешности приближений и крайние ускорения",
        ("ds_max", "alpha_ds_deg", "dv_max", "alpha_dv_deg", "dj_max", "alpha_dj_deg", "j_rel_tdc",
         "j_rel_bdc", "j_exact_min", "alpha_j_exact_min_deg", "j_two_term_min",
         "alpha_j_two_term_min_deg"),
    ),
    "neiman": (
        "Коэффициенты ряда перемещения",
        ("neiman_k", *(f"neiman_p{n}" for n in (2, 4, 6, 8))),
    ),
}  # fmt: skip
_TORQUE = ["order", "gas_amplitude_MPa", "gas_phase_deg", "inertia_amplitude_MPa",
           "inertia_phase_deg", "cylinders_sum", "M_engine_order_Nm"]  # fmt: skip


def companions(chapter: Chapter) -> Markup:
    """Torque orders, exact motion and its series."""
    terms = chapter.terms
    if "balance_orders" not in terms.model.tables:  # no series: an offset or articulated rods
        return Markup("")
    tables: dict[str, TablePlan | None] = {
        name: chapter.scalars(caption, keys, size="dense", keep=True)
        for name, (caption, keys) in _LISTS.items()
    }
    tables |= {
        "torque": TablePlan(
            partial(counted_table, terms, "torque_orders", _TORQUE),
            "Гармоники удельной тангенциальной силы и момента двигателя", keep=True,
        ),
        "inverse": chapter.columns(
            "segal_inverse", caption="Угол поворота кривошипа по положению поршня"
        ),
    }  # fmt: skip
    suppressed = terms.has("zone") and "suppression" in asked_devices(chapter)
    return chapter.page(
        "companions",
        formulas=_FORMULAS,
        tables=tables,
        zone=round(terms.value("zone")) if suppressed else 0,
        series_error=written(terms.value("j_series_error"), scientific(1)),
    )
