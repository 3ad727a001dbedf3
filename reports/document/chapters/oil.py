"""Chapter on the oil film of the bearings and on the safety of the journals."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.page.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.page.writer import TablePlan
from reports.document.text.symbols import titled_html
from reports.document.text.terms import Terms
from reports.inputs.sections.bearings import MATERIALS
from reports.shared.russian import fixed
from reports.spec.parts import Scope
from reports.tables.oil.film import Case, cases_of

_FILM = (
    r"F\cos(\gamma - \delta) = F_D\cos\beta + F_V, \qquad "
    r"F\sin(\gamma - \delta) = -F_D\sin\beta\,\mathrm{sgn}\,\bar\omega"
)
_NUMBERS = (
    r"So_D = \dfrac{F_D\,\psi^2}{B\,D\,\eta\,|\bar\omega|}, \qquad "
    r"So_V = \dfrac{F_V\,\psi^2}{B\,D\,\eta\,\varepsilon'}, \qquad "
    r"\bar\omega = \omega_{\mathrm{ш}} + \omega_{\mathrm{в}} - 2\delta'"
)
_SAFETY = (
    r"n_{\sigma} = \dfrac{\sigma_{-1}}{k_{\sigma}\sigma_a/\varepsilon + \psi_{\sigma}\sigma_m}, "
    r"\qquad n = \dfrac{n_{\sigma} n_{\tau}}{\sqrt{n_{\sigma}^2 + n_{\tau}^2}}"
)
CLASS_RULE = 1.15  # what the rule asks of its ratio


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
    cases = cases_of(Scope(chapter.input))
    steady = min(
        (_worst(case, terms.value(f"oil_K{case.number}")) for case in cases),
        key=lambda each: each.value,
    )
    gaps = terms.column("oil_orbits.oil_orb_h_um")
    place = int(gaps.argmin())
    thin = _worst(cases[place], float(gaps[place]))
    under = float(terms.column("oil_orbits.oil_under")[place])
    critical = terms.value("oil_hcr_um")
    shown = cases[0].bearing
    pin, main = terms.value("safe_n_pin"), terms.value("safe_n_main")
    return chapter.page(
        "oil",
        section=section,
        material=MATERIALS[section.material].label,
        film=_FILM, numbers=_NUMBERS, safety_tex=_SAFETY,
        steady=TablePlan(partial(_steady, terms, cases), "Плёнка при средней нагрузке", keep=True),
        orbits=TablePlan(partial(_orbits, terms, cases), "Плёнка за цикл по орбитам", keep=True),
        safety=chapter.scalars("Запасы прочности шеек", _SAFE, keep=True),
        worst=steady,
        enough=steady.value >= section.reserve_allowed,
        thin=thin, under=fixed(under, 1), touches=thin.value < critical,
        angle=fixed(float(terms.column("oil_orbits.oil_orb_phi_deg")[place]), 0),
        open=float(terms.column("oil_orbits.oil_open").max()) > _CLOSED,
        shown=shown,
        of=f"коренного подшипника {shown}" if shown else "шатунного подшипника",
        holes=terms.has("oil_load_deg"),
        bent=terms.has("safe_class_Q"),
        strong=min(pin, main) >= section.safety_allowed,
        weakest="шатунной" if pin <= main else "коренной",
        class_ok=terms.has("safe_class_Q")
        and min(terms.value("safe_class_Q"), terms.value("safe_class_Q_hole")) >= CLASS_RULE,
    )  # fmt: skip


def concluded(chapter: Chapter) -> Markup:
    """The chapter's result in a line of the conclusion."""
    terms, section = chapter.terms, chapter.input.bearings
    if section is None:
        return Markup("")
    gaps = terms.column("oil_orbits.oil_orb_h_um")
    thin = _worst(cases_of(Scope(chapter.input))[int(gaps.argmin())], float(gaps.min()))
    side = "меньше" if thin.value < terms.value("oil_hcr_um") else "не меньше"
    pin, main = terms.value("safe_n_pin"), terms.value("safe_n_main")
    part = "шатунной" if pin <= main else "коренной"
    enough = "не меньше" if min(pin, main) >= section.safety_allowed else "меньше"
    line = (
        "самая тонкая масляная плёнка {} мкм — у {}, она {} критической {}; наименьший запас "
        "прочности {} — у {} шейки, он {} допускаемого {}"
    )
    return Markup(line).format(
        thin.text, thin.words, side, terms.val("oil_hcr_um"), fixed(min(pin, main), 2), part,
        enough, terms.num("bearings_safety_allowed"),
    )  # fmt: skip


_CLOSED = 1e-3
_SAFE = (
    "worst_main_torque", "safe_n_main", "safe_sigma_a_MPa", "safe_sigma_m_MPa", "safe_n_bend_hole",
    "safe_n_turn_hole", "safe_n_hole", "safe_n_bend_fillet", "safe_n_turn_fillet",
    "safe_n_fillet", "safe_n_pin", "safe_class_MPa", "safe_equal_MPa", "safe_class_Q",
    "safe_class_Q_hole",
)  # fmt: skip


def _worst(case: Case, value: float) -> Worst:
    name = f"коренного подшипника {case.bearing}" if case.bearing else "шатунного подшипника"
    gap = "наибольшем" if case.which == 2 else "наименьшем"
    return Worst(f"{name} при {gap} зазоре", value, fixed(value, 2))


def _steady(terms: Terms, cases: list[Case]) -> TableBlock:
    heads = [
        Column("Подшипник", 3.2, text=True), Column(symbol_head("k", "МПа")),
        Column(symbol_head(r"\chi", "")), Column(symbol_head(r"t_{\mathrm{м}}", "°C")),
        Column(symbol_head(r"\mu", "мПа·с")), Column(symbol_head(r"h_{\min}", "мкм")),
        Column(symbol_head("K", "")), Column(symbol_head(r"N_{\mathrm{тр}}", "Вт")),
        Column(symbol_head("Q", "л/мин")),
    ]  # fmt: skip
    keys = (
        "oil_k{}_MPa", "oil_chi{}", "oil_temp{}_C", "oil_visc{}_mPas", "oil_hmin{}_um", "oil_K{}",
        "oil_friction{}_W", "oil_through{}_l_min",
    )  # fmt: skip
    rows = [
        [titled_html(case.label), *(terms.num(key.format(case.number)) for key in keys)]
        for case in cases
    ]
    return table_block(heads, rows)


def _orbits(terms: Terms, cases: list[Case]) -> TableBlock:
    heads = [
        Column("Подшипник", 3.2, text=True), Column(symbol_head(r"\chi_{\max}", "")),
        Column(symbol_head(r"h_{\min}", "мкм")), Column(symbol_head(r"\varphi", "°")),
        Column(symbol_head(r"\delta_{\mathrm{в}}", "°")),
        Column(symbol_head(r"\delta_{\mathrm{ш}}", "°")), Column(symbol_head(r"\nu", "%")),
        Column(symbol_head(r"N_{\mathrm{тр}}", "Вт")), Column(symbol_head("Q", "л/мин")),
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
