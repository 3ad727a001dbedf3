"""Chapter on balance, reduced inertia, evenness of running and the flywheel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from markupsafe import Markup

from kshm.chain.firing_orders import intervals, rank_firing_orders
from kshm.nomenclature.digits import scientific
from reports.document.chapters.chapter import Chapter
from reports.document.page.blocks import (
    TableBlock,
    TableColumn,
    counted_table,
    scalar_table,
    symbol_head,
    table_block,
)
from reports.document.page.charts import flywheel_figure
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.terms import Terms
from reports.document.text.texts import of_digits, rich
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import to_engine
from reports.shared.russian import MINUS, NBSP, fixed, joined, short, written

_MAX_ORDERS = 8
_FLYWHEEL = ("fw_outer_mm", "fw_bore_mm", "fw_disc_mm", "fw_rim_mm", "fw_density", "fw_I",
             "fw_mass_disc", "fw_mass_rim", "fw_mass", "fw_outer_most_mm")  # fmt: skip

# A definition that no single formula of the sheets states.
_FORMULAS = {
    "inertia": r"I_{\mathrm{п}} = I_{\mathrm{к}} + m_{\mathrm{ш}}\dfrac{v_C^2}{\omega^2}"
    r" + I_{\mathrm{ш}}\dfrac{\omega_{\mathrm{ш}}^2}{\omega^2}"
    r" + m_{\mathrm{п}}\dfrac{v_{\mathrm{п}}^2}{\omega^2}",
}
_LISTS = {
    "inertia": (
        "Момент инерции и неравномерность хода",
        ("I_crank", "rod_mass", "rod_x", "I_rod", "piston_mass", "I_max", "I_min", "I_mean",
         "delta_I", "I_error_max", "I_engine_mean", "delta_I_engine"),
    ),
    "rod": (
        "Шатун по основным размерам",
        ("rod_model_mass", "rod_model_centre", "rod_model_inertia"),
    ),
}  # fmt: skip
_BEFORE = " до уравновешивания"
_ZERO = f"0,{NBSP}{MINUS}"  # signs of a number that is printed as zero
_MASSES = "возвратно-поступательно движущиеся массы"
_DEVICES = {
    "counterweight": "противовесов",
    "first_shafts": "грузов валов первого порядка",
    "second_shafts": "грузов валов второго порядка",
}
_ORDERS = ["order", "order_amplitude", "order_cos", "order_sin", "F_order_kN", "M_order_Nm"]
_LEFT = ["F_left_kN", "M_left_Nm"]  # behind balance shafts
_SHAFTS = {"first_shafts": "первого", "second_shafts": "второго"}
_ORDERS_OF_BANKS = ["order", "order_amplitude", "F_order_kN", "F_order_min_kN", "F_order_dir_deg",
                    "M_order_Nm", "M_order_min_Nm", "M_order_dir_deg"]  # fmt: skip
_ZERO_SHARE = 2e-3  # of what it is measured by: no table and no curve shows it
# Definitions that no single formula of the sheets states.
_COMPANION_FORMULAS = {
    "harmonic": r"t_k = t_k^a \sin\left(k\varphi + \gamma_k\right)",
    "series": r"\bar s = 1 + k_s - \cos\varphi - p_2\cos 2\varphi + p_4\cos 4\varphi"
    r" - p_6\cos 6\varphi + p_8\cos 8\varphi",
    "exact": r"\bar j = \dfrac{\cos(\varphi+\beta)}{\cos\beta}"
    r" + \lambda\dfrac{\cos^2\varphi}{\cos^3\beta}",
}
_COMPANION_LISTS = {
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


def balance(chapter: Chapter) -> Markup:
    """Balance by orders, firing orders, reduced inertia and flywheel."""
    terms = chapter.terms
    if "balance_orders" not in terms.model.tables:  # no series: an offset or articulated rods
        return Markup("")
    banks = terms.has("balance_orders.order_right_cos")
    tables: dict[str, TablePlan | None] = {
        name: chapter.scalars(caption, keys, size="dense", keep=True)
        for name, (caption, keys) in _LISTS.items()
    }
    devices = asked_devices(chapter.input)
    after, busy = bool(devices - {"suppression"}), devices - _idle(terms)
    if not chapter.whole:  # the approximate formula is compared there alone
        name, keys = "inertia", [key for key in _LISTS["inertia"][1] if key != "I_error_max"]
        tables[name] = chapter.scalars(_LISTS[name][0], keys, size="dense", keep=True)
    tables |= _vectors(chapter, after=after) | {
        "devices": _devices(chapter, busy),
        "flywheel": chapter.scalars("Размеры маховика", _FLYWHEEL, size="dense", keep=True),
        "orders": TablePlan(
            partial(_orders, terms, banks=banks, left=bool(_SHAFTS.keys() & devices)),
            "Свободные силы и моменты инерции по порядкам", keep=True,
        ),
        "firing": TablePlan(partial(_firing, chapter), "Порядки работы, лучшие первыми", keep=True),
    }  # fmt: skip
    return chapter.page(
        "balance",
        formulas=_FORMULAS,
        tables=tables,
        ranked=chapter.whole and "firing_orders" in terms.model.tables,
        banks=banks,
        moves=not _is_balanced(terms, "L"),
        pulls=not _is_balanced(terms, "F"),
        # What is left behind the shafts is so with the usual counterweights too.
        counterweights=after and terms.value("balance_counterweight_share") > 0,
        shafts=[
            (terms.num(f"balance_{key}_share"), of) for key, of in _SHAFTS.items() if key in devices
        ],
        idle=[of for key, of in _SHAFTS.items() if key in devices and key not in busy],
        shafts_second="second_shafts" in busy,
        devices=joined([word for key, word in _DEVICES.items() if key in busy] or [""]),
        round=all(_is_round(terms, f"{letter}1_before") for letter in "FL"),
        turning=[] if after or not banks else _turning(terms),
        over_turn=_over_turn(terms, after=after),
        paths={
            x: chapter.model.charts_by_id[f"balance_{x}_vector"].words + _BEFORE * bool(devices)
            for x in "FL"
        },
        own_flywheel=_own_flywheel(chapter),
        flywheel_needed=is_flywheel_needed(chapter),
        coarse=chapter.terms.has("W_fresh"),
        **_flywheel_part(chapter),
        rod_given=chapter.input.masses.rod_kg is not None,
    )


def _flywheel_part(chapter: Chapter) -> dict[str, object]:
    """Return what the text on the flywheel's sizes needs."""
    section, terms = chapter.input.flywheel, chapter.terms
    if section is None or not terms.has("fw_mass"):
        return {"flywheel_part": False}
    return {
        "flywheel_part": True,
        "flywheel_given": section.outer_mm is not None,
        "fast": terms.value("fw_speed") > terms.value("fw_limit"),
        "flywheel_sketch": Figure(partial(flywheel_figure, terms), "Маховик, размеры в мм"),
    }


def concluded(chapter: Chapter) -> Markup:
    """Return the chapter's results in a line of the conclusion."""
    terms = chapter.terms
    if "balance_orders" not in terms.model.tables:
        return flywheel(chapter)
    stage = "after" if asked_devices(chapter.input) & _DEVICES.keys() else "before"
    free = [
        Markup("{} {} порядка {}").format(words, rich(f"{order:.0f}-го"), terms.val(name, order))
        for name, words in (
            ("balance_orders.F_order_kN", "силу"), ("balance_orders.M_order_Nm", "момент"),
        )
        for order in (1.0, 2.0)
        if terms.num(name, order).strip(_ZERO)
    ]  # fmt: skip
    forces = (
        Markup("{}{} дают {}").format(
            _MASSES, _BEFORE * bool(stage == "after"), Markup(joined(free))
        )
        if free
        else rich(f"{_MASSES} не дают свободных сил и моментов 1-го и 2-го порядков")
    )
    first = _whole_first(terms, stage) if free else ""
    return Markup("{}{}; {}").format(forces, first, flywheel(chapter))


def flywheel(chapter: Chapter) -> Markup:
    """Return the flywheel that the evenness needs, beside the given one; empty without either."""
    terms = chapter.terms
    if not terms.has("I_flywheel"):
        return Markup("")
    needed, inertia = is_flywheel_needed(chapter), _own_flywheel(chapter)
    line = Markup("маховик для неравномерности хода {}{} {}").format(
        terms.val("balance_irregularity"), ":" if needed else "",
        terms.val("I_flywheel") if needed else "не нужен",
    )  # fmt: skip
    if inertia:
        line += Markup(", принятый {} {} требуемого").format(
            terms.val("torsion_flywheel_kg_m2"), inertia
        )
    return line


def _whole_first(terms: Terms, stage: str) -> Markup:
    """Return the sum of the first order and the rotating masses, for the conclusion."""
    parts = [
        Markup("вектор {} {} порядка достигает {}").format(
            words, rich("1-го"), terms.val(f"{letter}1_{stage}_max")
        )
        for letter, words in (("F", "силы"), ("L", "момента"))
        if terms.num(f"{letter}1_{stage}_max").strip(_ZERO)
    ]
    if not parts:
        return Markup("")
    with_what = "после уравновешивания" if stage == "after" else "с вращающимися массами"
    return Markup("; {} {}").format(with_what, Markup(" и ").join(parts))


def _own_flywheel(chapter: Chapter) -> str:
    """Compare the flywheel of the torsional train with the required one; empty without either."""
    section = chapter.input.torsion
    inertia = None if section is None else section.flywheel_kg_m2
    if inertia is None or not is_flywheel_needed(chapter):
        return ""
    return "меньше" if inertia < chapter.terms.value("I_flywheel") else "не меньше"


def _orders(terms: Terms, *, banks: bool, left: bool) -> TableBlock:
    """Return forces and moments by orders; what is printed as zero has no direction."""
    keys = _ORDERS_OF_BANKS if banks else [*_ORDERS, *(_LEFT if left else ())]
    block = counted_table(terms, "balance_orders", keys)
    directions = {keys.index(key): keys.index(key.replace("dir_deg", unit))
                  for key, unit in (("F_order_dir_deg", "kN"), ("M_order_dir_deg", "Nm"))
                  if key in keys}  # fmt: skip
    rows = (
        tuple(
            "—" if number in directions and not row[directions[number]].strip(_ZERO) else cell
            for number, cell in enumerate(row)
        )
        for row in block.rows
    )
    return replace(block, rows=tuple(rows))


def asked_devices(model: InputFile) -> set[str]:
    """Devices of balancing that the input itself asks for."""
    section = model.balance
    return {
        name
        for key in (
            "counterweight_share",
            "first_shafts_share",
            "second_shafts_share",
            "suppression",
        )
        if key in section.asked and getattr(section, key) > 0
        for name in (key.removesuffix("_share"),)
    }


def _idle(terms: Terms) -> set[str]:
    """Balance shafts whose order has no force."""
    return {
        name
        for order, name in enumerate(_SHAFTS, 1)
        if not any(terms.num(f"shaft{order}{side}_moment").strip(_ZERO) for side in ("", "_back")
                   if terms.has(f"shaft{order}{side}_moment"))
    }  # fmt: skip


def _is_balanced(
    terms: Terms, letter: str, ends: Sequence[str] = ("",), sums: Sequence[str] = ("up", "right")
) -> bool:
    """Whether the forces (F) or moments (L) vanish against those of one cylinder."""
    unit = "kN" if letter == "F" else "Nm"
    force = terms.value("Pj_unit_kN")
    scale = force if letter == "F" else 1000 * force * terms.value("S_stroke")
    names = [f"balance.{letter}{side}{end}_{unit}" for side in sums for end in ends]
    return _are_nothing(terms, [name for name in names if terms.has(name)], scale)


def _are_nothing(terms: Terms, columns: Sequence[str], scale: float) -> bool:
    """Whether columns are zero compared with a scale in their unit."""
    return all(np.abs(terms.column(name)).max() <= _ZERO_SHARE * scale for name in columns)


def _over_turn(terms: Terms, *, after: bool) -> list[str]:
    """Diagrams over a turn that do not vanish: after balancing, or by orders without it."""
    if after:
        unbalanced = [x for x in "FL" if not _is_balanced(terms, x, ("", "_after"), ("up",))]
        return [f"balance_{x}_after" for x in unbalanced]
    orders = ("1", "2", "4")
    return [f"balance_{x}" for x in "FL" if not _is_balanced(terms, x, sums=orders)]


def _vectors(chapter: Chapter, *, after: bool) -> dict[str, TablePlan | None]:
    """Rotating masses and first orders of what is not balanced; after balancing if asked for."""
    terms, keys = chapter.terms, []
    for letter in "FL":
        firsts = [f"{letter}1_{name}" for name in ("before", *(("after",) if after else ()))]
        # A circle has no direction of its greatest radius.
        of = [f"{letter}rot_bare", f"{letter}rot"]
        for first in firsts:
            parts = ("max", "min") if _is_round(terms, first) else ("max", "min", "deg")
            of += [f"{first}_{part}" for part in parts]
        if not _is_balanced(terms, letter) and any(terms.num(key).strip(_ZERO) for key in of):
            keys += of
    caption = "Вращающиеся массы и векторы первого порядка"
    build = scalar_table if after else _without_stage
    plan = TablePlan(partial(build, terms, keys), caption, size="dense", keep=True)
    return {"vectors": plan if keys else None}


def _without_stage(terms: Terms, keys: Sequence[str]) -> TableBlock:
    """Return the values of an engine that nothing balances: there is no before and after."""
    block = scalar_table(terms, [key for key in keys if terms.has(key)])
    return replace(block, rows=tuple((row[0].replace(_BEFORE, ""), *row[1:]) for row in block.rows))


def _turning(terms: Terms) -> list[str]:
    """Vectors of the first order, in words, that turn with the shaft and keep their size."""
    parts = {"силы": "order_{}", "момента": "arm_{}_mm"}
    pairs = {
        word: [
            terms.value("balance_orders." + key.format(way), 1.0) for way in ("along", "against")
        ]
        for word, key in parts.items()
    }
    most = 1e-6  # of the vector that turns with the shaft
    return [word for word, (along, against) in pairs.items() if against < most * along]


def _is_round(terms: Terms, first: str) -> bool:
    """Whether the vector of the first order goes round a circle, as printed."""
    return terms.num(f"{first}_max") == terms.num(f"{first}_min")


def _devices(chapter: Chapter, devices: set[str]) -> TablePlan | None:
    """Masses of the counterweights and of the shafts that are asked for."""
    keys = ["counterweight_needed", "counterweight_web"] if "counterweight" in devices else []
    for number, name in enumerate(("first_shafts", "second_shafts"), 1):
        if name in devices:
            keys += [f"shaft{number}{side}_{of}" for side in ("", "_back")
                     for of in ("moment", "mass")]  # fmt: skip
    if not keys:
        return None
    return chapter.scalars("Противовесы и балансирные валы", keys, size="dense", keep=True)


def is_flywheel_needed(chapter: Chapter) -> bool:
    """Whether the required flywheel is more than zero as printed."""
    value, digits = chapter.terms.value("I_flywheel"), chapter.terms.quantity("I_flywheel").digits
    return bool(str(of_digits(value, digits.within(value))).strip(_ZERO))


def _firing(chapter: Chapter) -> TableBlock:
    """Return the best firing orders with the greatest load of a main journal."""
    columns = [
        TableColumn("Порядок работы", 1.7),
        TableColumn("Промежутки, °", 3.2),
        TableColumn("Неравномерность чередования", 1.9),
        TableColumn(symbol_head(r"\Sigma_{0{,}5}", ""), 0.9),
        TableColumn(symbol_head(r"R_{\mathrm{к.ш}\,\max}", "кН"), 1.4),
    ]
    load = chapter.terms.quantity("Rmain1_max_kN")
    rows = [
        (
            "–".join(map(str, ranked.order)),
            ", ".join(
                short(round(gap, 2)) for gap in np.degrees(intervals(np.array(ranked.offsets)))
            ),
            fixed(ranked.unevenness, 3),
            fixed(ranked.half_order if np.abs(ranked.half_order) > 1e-9 else 0.0, 3),
            of_digits(ranked.journal_load / 1000, load.digits),
        )
        for ranked in rank_firing_orders(to_engine(chapter.input))[:_MAX_ORDERS]
    ]
    return table_block(columns, rows)


def companions(chapter: Chapter) -> Markup:
    """Torque orders, exact motion and its series."""
    terms = chapter.terms
    if "balance_orders" not in terms.model.tables:  # no series: an offset or articulated rods
        return Markup("")
    tables: dict[str, TablePlan | None] = {
        name: chapter.scalars(caption, keys, size="dense", keep=True)
        for name, (caption, keys) in _COMPANION_LISTS.items()
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
    suppressed = terms.has("zone") and "suppression" in asked_devices(chapter.input)
    return chapter.page(
        "companions",
        formulas=_COMPANION_FORMULAS,
        tables=tables,
        zone=round(terms.value("zone")) if suppressed else 0,
        series_error=written(terms.value("j_series_error"), scientific(1)),
    )
