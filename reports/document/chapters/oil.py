"""Chapter on the oil film of the bearings and on the safety of the journals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from markupsafe import Markup

from kshm.arrays import Array
from reports.document.chapters.chapter import Chapter
from reports.document.page.blocks import TableBlock, TableColumn, symbol_head, table_block
from reports.document.page.charts import sketches_figure
from reports.document.page.numbering import TablePlan
from reports.document.text.symbols import titled_html
from reports.document.text.terms import Terms, material_name
from reports.formula.numeric import evaluate
from reports.inputs.reasons import FILM_REQUIRED
from reports.inputs.sections.bearings import MATERIALS
from reports.model.blocks import Grid
from reports.model.shape import Scope
from reports.shared.russian import NBSP, capital, fixed
from reports.tables.oil_members import FilmCase, film_cases

_REYNOLDS = (
    r"\dfrac{\partial}{\partial\theta}\left(H_{\Delta}^3\dfrac{\partial\bar p}"
    r"{\partial\theta}\right) + "
    r"\dfrac{1}{\beta_{\mathrm{п}}^2}H_{\Delta}^3\dfrac{\partial^2\bar p}{\partial\zeta^2} = "
    r"-12\cos(\theta - \gamma_v), \quad H_{\Delta} = 1 - \chi\cos\theta, \quad \bar p \ge 0"
)
_MOTION = (
    r"\chi' = \bar M\cos\gamma_v\dfrac{F\,\psi_{\Delta}^2}"
    r"{B\,d\,\eta}, \quad "
    r"\chi\,\delta_F' = \bar M\sin\gamma_v\dfrac{F\,\psi_{\Delta}^2}"
    r"{B\,d\,\eta} + "
    r"\chi\dfrac{\omega_{\mathrm{цап}} + \omega_{\mathrm{вкл}}}{2}"
)
_SAFETY = (
    r"n_{\sigma} = "
    r"\dfrac{\sigma_{-1}}{k_{\sigma}\sigma_a/\varepsilon_{\sigma} + \psi_{\sigma}|\sigma_m|}, "
    r"\qquad n_{\mathrm{о,\,г}} = \dfrac{n_{\sigma} n_{\tau}}{\sqrt{n_{\sigma}^2 + n_{\tau}^2}}"
)
CLASS_RULE = 1.15  # what the rule asks of its ratio
_TOLD = 1.05
_CLOSED = 1e-3
_SAFE_MAINS = ("safe_tau_a2_MPa", "safe_tau_m2_MPa", "safe_fillet2", "safe_hole2", "safe_n2")
_SAFE_PINS = (
    "safe_pin_bend_a1_MPa", "safe_pin_bend_m1_MPa", "safe_pin_a1_MPa", "safe_pin_m1_MPa",
    "safe_pin_bend_hole1", "safe_pin_turn_hole1", "safe_pin_hole1",
    "safe_pin_crank_a1_MPa", "safe_pin_crank_m1_MPa", "safe_pin_bend_fillet1",
    "safe_pin_turn_fillet1", "safe_pin_fillet1", "safe_pin_n1", "safe_Q_fillet1", "safe_Q_hole1",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Worst:
    """The bearing and clearance with the thinnest film, in words."""

    words: str
    value: float
    text: str


def oil(chapter: Chapter) -> Markup:
    """Film under the mean load, orbits, angle of the oil hole, safety."""
    terms, section = chapter.terms, chapter.input.bearings
    if section is None:
        return Markup("")
    cases = film_cases(Scope(chapter.input))
    steady = min(
        (_worst(case, terms.value(f"oil_K{case.number}")) for case in cases),
        key=lambda each: each.value,
    )
    gaps = terms.column("oil_orbits.oil_orb_h_um")
    mean = [terms.value(f"oil_hmin{case.number}_um") for case in cases]
    thinnest = int(gaps.argmin())
    thin = _worst(cases[thinnest], float(gaps[thinnest]))
    under = float(terms.column("oil_orbits.oil_under")[thinnest])
    critical = terms.value("oil_hcr_um")
    bearing = cases[0].bearing
    pin, main = terms.value("safe_n_pin"), terms.value("safe_n_main")
    return chapter.page(
        "oil",
        section=section,
        clearances_given=all(
            getattr(section, f"{of}_clearance_{end}_mm") is not None
            for of in ("pin", "main") for end in ("min", "max")
        ),
        material=material_name(MATERIALS[section.material].label),
        reynolds=_REYNOLDS, motion=_MOTION, safety_tex=_SAFETY,
        steady=TablePlan(partial(_steady, terms, cases), "Плёнка при средней нагрузке", keep=True),
        orbits=TablePlan(partial(_orbits, terms, cases), "Плёнка за цикл по орбитам", keep=True),
        mains=_safety(chapter, "safe_main", _SAFE_MAINS, "Запасы прочности коренных шеек"),
        pins=_safety(chapter, "safe_pins", _SAFE_PINS, "Запасы прочности шатунных шеек"),
        crank=sketches_figure(terms, "Шейки колена, размеры", "crank"),
        several=chapter.shape.throws > 1,
        worst=steady,
        enough=steady.value >= section.reserve_allowed,
        thicker=_times(mean, gaps),
        sizes=TablePlan(partial(_sizes, terms, cases), "Размеры подшипников и зазоры", keep=True),
        reserve=fixed(thin.value / critical, 2),
        carries=thin.value >= float(evaluate(FILM_REQUIRED, terms.value)),
        given_hole=chapter.input.crankshaft.oil_hole_deg is not None,
        thin=thin, under=fixed(under, 1), touches=thin.value < critical,
        angle=fixed(float(terms.column("oil_orbits.oil_orb_phi_deg")[thinnest]), 0),
        open=float(terms.column("oil_orbits.oil_open").max()) > _CLOSED,
        shown=bearing,
        of=f"коренного подшипника {bearing}" if bearing else "шатунного подшипника",
        holes=terms.has("oil_load_deg"),
        bent=terms.has("safe_class_Q"),
        strong=min(pin, main) >= section.safety_allowed,
        weakest=_weakest(chapter),
        least=fixed(min(pin, main), 2),
        class_ok=terms.has("safe_class_Q")
        and min(terms.value("safe_class_Q"), terms.value("safe_class_Q_hole")) >= CLASS_RULE,
    )  # fmt: skip


def concluded(chapter: Chapter) -> Markup:
    """Return the chapter's result in a line of the conclusion."""
    terms, section = chapter.terms, chapter.input.bearings
    if section is None:
        return Markup("")
    gaps = terms.column("oil_orbits.oil_orb_h_um")
    thin = _worst(film_cases(Scope(chapter.input))[int(gaps.argmin())], float(gaps.min()))
    reserve = thin.value / terms.value("oil_hcr_um")
    side = "меньше" if reserve < section.reserve_allowed else "не меньше"
    pin, main = terms.value("safe_n_pin"), terms.value("safe_n_main")
    part = _weakest(chapter)
    enough = "не меньше" if min(pin, main) >= section.safety_allowed else "меньше"
    line = (
        "самая тонкая масляная плёнка {} мкм — у {}, её запас {} {} допускаемого {}; "
        "наименьший запас прочности {} — у {}, он {} допускаемого {}"
    )
    return Markup(line).format(
        thin.text, thin.words, fixed(reserve, 2), side, terms.num("bearings_reserve_allowed"),
        fixed(min(pin, main), 2), part, enough, terms.num("bearings_safety_allowed"),
    )  # fmt: skip


def _times(mean: Sequence[float], gaps: Array) -> str:
    """Ratio of film thicknesses, mean load to cycle; empty below one."""
    times = float((np.array(mean) / gaps).max())
    return fixed(times, 1) if times >= _TOLD else ""


def _worst(case: FilmCase, value: float) -> Worst:
    name = f"коренного подшипника {case.bearing}" if case.bearing else "шатунного подшипника"
    gap = "наибольшем" if case.which == 2 else "наименьшем"
    return Worst(f"{name} при {gap} зазоре", value, fixed(value, 2))


def _weakest(chapter: Chapter) -> str:
    """Return the journal or crankpin with the least safety, in words and with its number."""
    terms = chapter.terms
    part, name = "шатунной", "pin"
    if terms.value("safe_n_main") < terms.value("safe_n_pin"):
        part, name = "коренной", "main"
    several = name == "main" or chapter.shape.throws > 1
    number = f"{NBSP}{round(terms.value(f'safe_{name}_weakest'))}" if several else ""
    return f"{part} шейки{number}"


def _safety(chapter: Chapter, grid: str, keys: Sequence[str], caption: str) -> TablePlan:
    """Stresses and safety of all journals of a kind side by side."""
    block = chapter.grid(grid)
    build = partial(_beside, chapter.terms, block, keys)
    return TablePlan(build, caption, keep=True, size="dense" if len(block.labels) > 5 else "")


def _beside(terms: Terms, grid: Grid, keys: Sequence[str]) -> TableBlock:
    """Titles of a grid's quantities with units; a column of values for each journal."""
    by_key = {row.of: row for row in grid.rows}
    rows = []
    for row in (by_key[key] for key in keys if key in by_key):
        q = row.quantity
        head = Markup("{}{}").format(
            symbol_head(f"{q.tex}", q.unit_label), Markup(" — {}").format(titled_html(q.title))
        )
        rows.append([head, *(terms.num(cell.key) for cell in row.cells if cell is not None)])
    columns = [
        TableColumn("Величина", 5.0, text=True),
        *(TableColumn(capital(n)) for n in grid.labels),
    ]
    return table_block(columns, rows)


def _steady(terms: Terms, cases: list[FilmCase]) -> TableBlock:
    keys = (
        "oil_k{}_MPa", "oil_chi{}", "oil_temp{}_C", "oil_visc{}_mPas", "oil_hmin{}_um", "oil_K{}",
        "oil_friction{}_W", "oil_through{}_l_min",
    )  # fmt: skip
    measures = [terms.quantity(key.format(cases[0].number)) for key in keys]
    heads = [
        TableColumn("Подшипник", 3.2, text=True),
        *(TableColumn(symbol_head(each.tex, each.unit_label)) for each in measures),
    ]
    rows = [
        [titled_html(case.label), *(terms.num(key.format(case.number)) for key in keys)]
        for case in cases
    ]
    return table_block(heads, rows)


def _sizes(terms: Terms, cases: list[FilmCase]) -> TableBlock:
    """Diameter, width of the carrying part and clearances of every bearing."""
    heads = [
        TableColumn("Подшипник", 3.0, text=True),
        TableColumn(symbol_head("d", "мм")),
        TableColumn(symbol_head("B", "мм")),
        TableColumn(symbol_head(r"\Delta_{\min}", "мм")),
        TableColumn(symbol_head(r"\Delta_{\max}", "мм")),
    ]
    rows = []
    for least, most in zip(cases[::2], cases[1::2], strict=True):
        n, parts = least.number, round(terms.value(f"oil_lands{least.number}"))
        width = terms.num(f"oil_land{n}_mm")
        rows.append([
            titled_html(least.label.partition(",")[0]),
            terms.num(f"oil_d{n}_mm"),
            f"{parts} × {width}" if parts > 1 else width,
            terms.num(f"oil_gap{n}_mm"),
            terms.num(f"oil_gap{most.number}_mm"),
        ])  # fmt: skip
    return table_block(heads, rows)


def _orbits(terms: Terms, cases: list[FilmCase]) -> TableBlock:
    heads = [
        TableColumn("Подшипник", 3.2, text=True), TableColumn(symbol_head(r"\chi_{\max}", "")),
        TableColumn(symbol_head(r"h_{\min}", "мкм")), TableColumn(symbol_head(r"\varphi", "°")),
        TableColumn(symbol_head(r"\delta_{\mathrm{в}}", "°")),
        TableColumn(symbol_head(r"\delta_{\mathrm{цап}}", "°")),
        TableColumn(symbol_head(r"\zeta_{\mathrm{кр}}", "%")),
        TableColumn(symbol_head(r"N_{\mathrm{тр}}", "Вт")),
        TableColumn(symbol_head(r"Q_{\mathrm{м}}", "л/мин")),
    ]  # fmt: skip
    keys = (
        ("oil_eps_max", 4), ("oil_orb_h_um", 2), ("oil_orb_phi_deg", 0), ("oil_shell_deg", 0),
        ("oil_journal_deg", 0), ("oil_under", 1), ("oil_orb_W", 1), ("oil_orb_l_min", 3),
    )  # fmt: skip
    rows = [
        [
            titled_html(case.label),
            *(fixed(float(terms.column(f"oil_orbits.{key}")[k]), digits) for key, digits in keys),
        ]
        for k, case in enumerate(cases)
    ]
    return table_block(heads, rows)
