"""Chapter on the torsional vibration of the shaft."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from markupsafe import Markup

from kshm.defaults import (
    DAMPING_SHARE,
    FLYWHEEL_SHARE,
    OTHER_FLYWHEEL,
    PULLEY_SHARE,
    SPEED_RANGE,
    SPEEDS,
)
from reports.document.chapters.chapter import Chapter
from reports.document.figures.curves import Mark
from reports.document.page.blocks import (
    TableBlock,
    TableColumn,
    grid_table,
    symbol_head,
    table_block,
)
from reports.document.page.numbering import TablePlan
from reports.document.text.terms import Terms, with_unit
from reports.document.text.texts import of_digits, significant, to_tex
from reports.formula.tex import as_put_in, number_tex
from reports.inputs.sections.torsion import TorsionSection
from reports.inputs.solve_input import INERTIAS, lighter_than
from reports.model.charts import Series
from reports.shared.russian import NBSP, fixed, short
from reports.tables.torsion_members import ray_of

_HOLZER = (
    r"M_k = M_{k-1} + \Omega^2 J_k\, \alpha_k, \qquad "
    r"\alpha_{k+1} = \alpha_k - \dfrac{M_k}{c_k}, \qquad \alpha_1 = 1"
)
_SUM = r"S_{\nu} = \left|\sum \alpha_{\mathrm{ц}i}\, e^{-j\nu\theta_i}\right|"
_ENERGY = (
    r"A = \dfrac{M_{\nu} S_{\nu}}{D_{\nu}}, \qquad D_{\nu} = \Omega \sum b_k \alpha_k^2 + "
    r"\eta_{\mathrm{в}} \sum c_k \left(\alpha_{k+1} - \alpha_k\right)^2"
)
_MOTION = (
    r"\left(-\Omega^2 \mathbf{J} + j\Omega \mathbf{b} + \mathbf{c}\,(1 + j\eta_{\mathrm{в}})\right)"
    r"\mathbf{\theta}_{\nu} = \mathbf{M}_{\nu}, \qquad "
    r"\Omega = \nu\,\omega"
)
_NAMED = {"wilson": "Кер-Вильсона", "carter": "Картера", "zimanenko": "Зиманенко"}
# Rows of the train; bounds of the frequencies are of the sheet alone.
_TRAIN = ("tor_J_kgm2", "tor_c_Nm_rad", "tor_W_cm3", "tor_b_Nms_rad")
_MIN_DIGITS, _MAX_DIGITS = 5, 12  # of numbers put into the chain
_FORM_DECIMALS = 5
_DIGITS = 3  # of an energy, which is 4896 J for a ship's engine and 0.0012 J for a model's
_NEAR = 0.02  # of a stress: a difference that changes no conclusion
_ALIKE = 0.5  # per cent between first frequencies: the formula of stiffness does not tell in them
_SURE = 4  # digits of a frequency that formulas find some per cent apart
_MAX_ROWS = 12
_MAX_RAYS = 8  # lines of a figure that are told apart
_FLANK = 0.6  # of a critical speed: from there on a resonance multiplies the twist by 1.5


@dataclass(frozen=True, slots=True)
class Peak:
    """The greatest stress of a curve over the speeds, printed, and where it stands.

    ``edge`` is −1 at the start of the range, 1 at its end: no resonance is met there; else 0.
    """

    stress: float
    text: str
    speed: str
    edge: int = 0

    @property
    def shown(self) -> Markup:
        """The stress with its unit."""
        return with_unit(self.text, "МПа")

    @property
    def at(self) -> Markup:
        """The speed with its unit, and that it is the end of the range."""
        text = with_unit(self.speed, "мин⁻¹")
        if not self.edge:
            return text
        where = "начале" if self.edge < 0 else "конце"
        return Markup("{}, в {} рабочего диапазона").format(text, where)


@dataclass(frozen=True, slots=True)
class Lead:
    """An order with its resonance nearest to the working speeds, printed; is it near to them?"""

    order: str
    mode: int
    at: Markup
    near: bool


def torsion(chapter: Chapter) -> Markup:
    """Train, frequencies, resonances, forced vibration, damper, flywheels."""
    terms, section = chapter.terms, chapter.input.torsion
    if section is None:
        return Markup("")
    modes = [m for m in (1, 2, 3) if terms.has(f"tor_f{m}_hz")]
    bare, damped, other = (_peak(terms, key) for key in ("", "_damped", "_other"))
    allowed = section.stress_allowed_mpa
    resonances = _resonances(terms, modes)
    return chapter.page(
        "torsion",
        section=section,
        formula=_NAMED[section.formula],
        own=bool(section.masses),
        assumed=_assumed(section),
        range_words=_range_words(section),
        throws_share=short(FLYWHEEL_SHARE),
        other_share=short(OTHER_FLYWHEEL),
        speeds=SPEEDS,
        free=section.ground_nm_rad + (section.masses[-1].stiffness_nm_rad
                                      if section.masses else 0) == 0,
        train=TablePlan(partial(grid_table, terms, chapter.grid("torsion_train"), _TRAIN),
                        "Крутильная схема вала"),
        least_order=short(float(terms.column("torsion_critical.tor_order")[0])),
        modes=modes,
        apart=terms.has("tor_f1_spread") and terms.value("tor_f1_spread") > _ALIKE,
        forms=TablePlan(partial(_forms, terms, modes), "Собственные частоты и формы", keep=True),
        holzer=_HOLZER,
        check=_holzer_row(terms),
        nodes={m: _nodes(terms, m) for m in modes},
        phase_sum=_SUM,
        energy=_ENERGY,
        motion=_MOTION,
        resonances=TablePlan(partial(_resonance_table, terms, resonances),
                             "Резонансы рабочего диапазона", keep=True) if resonances else None,
        hidden=_hidden(terms, modes) - len(resonances),
        rays=_rays(terms, resonances),
        shown_levels=tuple(f"tor_f{m}_hz" for m in modes if m in {mode for mode, _ in resonances}),
        dangerous=_dangerous(terms) if resonances else None,
        order=terms.value("tor_worst_order"),
        worst_order=fixed(terms.value("tor_worst_order"), 1).removesuffix(",0"),
        mode=round(terms.value("tor_worst_mode")),
        last=fixed(float(terms.column("torsion_critical.tor_order")[-1]), 1).removesuffix(",0"),
        bare=bare, damped=damped, other=other,
        allowed=allowed,
        far=abs(terms.value("tor_worst") / bare.stress - 1) > 0.3 if bare.stress else False,
        over=bare.stress > allowed, over_damped=damped.stress > allowed,
        over_other=other.stress > allowed,
        helps=damped.stress < (1 - _NEAR) * bare.stress,
        harms=damped.stress > (1 + _NEAR) * bare.stress,
        flywheels=TablePlan(partial(_flywheels, terms, bare, other), "Два маховика", keep=True),
        change=terms.value("tor_f1_change"),
        change_text=with_unit(fixed(abs(terms.value("tor_f1_change")), 1), "%"),
        articulated=chapter.shape.articulated,
        flywheel_needed=terms.has("I_flywheel") and terms.value("I_flywheel") > 0,
        light_flywheel=_lighter_than(chapter),
        sized_flywheel=terms.has("fw_I") and "balance" in chapter.relevant,
        heavier=terms.value("tor_flywheel_other") > terms.value("tor_flywheel"),
        other_helps=other.stress < (1 - _NEAR) * bare.stress,
        other_harms=other.stress > (1 + _NEAR) * bare.stress,
        work=_energy(terms),
        beyond=_beyond(terms, modes),
    )  # fmt: skip


def _assumed(section: TorsionSection) -> str:
    """What the file leaves out of the train, with its estimate, in a sentence; empty without."""
    parts = []
    if section.pulley_kg_m2 is None and not section.masses:
        parts.append(f"момент инерции шкива — {short(PULLEY_SHARE)} среднего момента инерции колен")
    if section.damping_nms_rad is None:
        share = short(DAMPING_SHARE / 1000)
        parts.append(
            f"сопротивление в каждом цилиндре — {share}{NBSP}кН·с/м³, умноженные на площадь поршня "
            "и квадрат радиуса кривошипа, как у дизеля MWM"
        )
    return " и ".join(parts)


def _range_words(section: TorsionSection) -> str:
    """Where the bounds of the working range come from."""
    stated = (section.speed_min_rpm is not None, section.speed_max_rpm is not None)
    shares = [short(share) for share in SPEED_RANGE]
    if all(stated):
        return "задан"
    if not any(stated):
        return f"принят: {shares[0]}…{shares[1]} расчётной частоты вращения"
    taken = stated.index(False)
    bound = ("нижняя", "верхняя")[taken]
    return f"{bound} граница принята: {shares[taken]} расчётной частоты вращения"


def _lighter_than(chapter: Chapter) -> str:
    """Return the lightest throw if the flywheel is lighter still; else empty."""
    section, inertias = chapter.input.torsion, chapter.terms.column(".".join(INERTIAS))
    if section is None or section.masses:
        return ""
    throw = lighter_than(inertias, chapter.shape.throws)
    return f"torJ{throw}" if throw else ""


def concluded(chapter: Chapter) -> Markup:
    """Return the chapter's result in a line of the conclusion."""
    terms, section = chapter.terms, chapter.input.torsion
    if section is None:
        return Markup("")
    bare = _peak(terms, "")
    over = bare.stress > section.stress_allowed_mpa
    line = (
        "первая собственная частота крутильных колебаний вала {}, наибольшая амплитуда "
        "напряжений кручения {} при частоте вращения {}, что {} {}"
    )
    verdict = "превышает допускаемую" if over else "не превышает допускаемой"
    allowed = terms.val("torsion_stress_allowed_mpa")
    first = with_unit(significant(terms.value("tor_f1_hz"), _SURE), terms.unit("tor_f1_hz"))
    return Markup(line).format(first, bare.shown, bare.at, verdict, allowed)


def _peak(terms: Terms, which: str) -> Peak:
    stresses = terms.column(f"torsion_response.tor_tau{which}_MPa")
    row = int(stresses.argmax())
    speed = terms.column("torsion_response.tor_speed_rpm")[row]
    edge = {0: -1, len(stresses) - 1: 1}.get(row, 0)
    return Peak(float(stresses[row]), fixed(float(stresses[row]), 1), fixed(float(speed), 0), edge)


def _beyond(terms: Terms, modes: list[int]) -> Lead | None:
    """Return order that gives most of the greatest stress, if it has no resonance in the range."""
    c, r = "torsion_critical", "torsion_response"
    index = int(terms.column(f"{r}.tor_tau_MPa").argmax())
    order = float(terms.column(f"{r}.tor_lead_order")[index])
    row = int(np.abs(terms.column(f"{c}.tor_order") - order).argmin())
    critical = {m: float(terms.column(f"{c}.tor_n{m}_rpm")[row]) for m in modes}
    least, most = terms.value("tor_n_min"), terms.value("tor_n_max")
    if any(least <= speed <= most for speed in critical.values()):
        return None
    mode = min(critical, key=lambda m: abs(critical[m] / least - 1) if critical[m] < least
               else critical[m] / most - 1)  # fmt: skip
    is_close = _FLANK * critical[mode] <= most and _FLANK * least <= critical[mode]
    text = with_unit(fixed(critical[mode], 0), "мин⁻¹")
    return Lead(fixed(order, 1).removesuffix(",0"), mode, text, is_close)


def _forms(terms: Terms, modes: list[int]) -> TableBlock:
    heads = [TableColumn("Масса", 2.6, text=True), TableColumn(symbol_head("J", "кг·м²"))]
    heads += [TableColumn(symbol_head(rf"\alpha_{{\mathrm{{ф}}{m}}}", "")) for m in modes]
    grid = next(block for block in terms.model.blocks if block.id == "torsion_train")
    labels = getattr(grid, "labels", ())
    inertia = "torsion_forms.tor_J_kgm2"
    rows = [
        [
            label,
            of_digits(float(terms.column(inertia)[k]), terms.quantity(inertia).digits),
            *(fixed(float(terms.column(f"torsion_forms.tor_theta{m}")[k]), 5) for m in modes),
        ]
        for k, label in enumerate(labels)
    ]
    rows.append(["частота, Гц", "—", *(terms.num(f"tor_f{m}_hz") for m in modes)])
    return table_block(heads, rows)


def _nodes(terms: Terms, mode: int) -> list[str]:
    """Places of the nodes: numbers and names of the masses before and after."""
    column = terms.column(f"torsion_forms.tor_node{mode}")
    grid = next(block for block in terms.model.blocks if block.id == "torsion_train")
    labels = getattr(grid, "labels", ())
    return [
        f"{k} и {k + 1} ({labels[k - 1]} и {labels[k]})"
        for k in (int(at) for at in column if at > 0)
    ]


def _holzer_row(terms: Terms) -> str:
    """Return the first step of the chain at the first frequency with its numbers."""
    inertia, spring = terms.value("torJ1"), terms.value("torc1")
    omega = 2 * np.pi * terms.value("tor_f1_hz")
    moment = omega**2 * inertia - terms.value("torsion_ground_nm_rad")
    ground, form = terms.value("torsion_ground_nm_rad"), terms.column("torsion_forms.tor_theta1")
    second = to_tex(fixed(float(form[1]), _FORM_DECIMALS))
    tried = range(_MIN_DIGITS, _MAX_DIGITS)
    digits = next((n for n in tried if _gives(n, omega, inertia, ground, spring)), _MIN_DIGITS)
    numbers = [number_tex(each, digits) for each in (omega, inertia, moment, spring)]
    numbers[2] = number_tex(moment, _MIN_DIGITS)
    less = rf" - {to_tex(fixed(ground, 0))}" if ground else ""
    return (
        rf"M_1 = {numbers[0]}^2 \cdot {numbers[1]}{less} = {numbers[2]}\;\mathrm{{Н·м}}, \qquad "
        rf"\alpha_2 = 1 - \dfrac{{{numbers[2]}}}{{{numbers[3]}}} = {second}"
    )


def _gives(digits: int, omega: float, inertia: float, ground: float, spring: float) -> bool:
    """Whether the step with numbers of so many digits gives what is printed."""
    first, second, third = (as_put_in(each, digits) for each in (omega, inertia, spring))
    moment = omega**2 * inertia - ground
    near, shown = (as_put_in(each, _MIN_DIGITS) for each in (first**2 * second - ground, moment))
    ends = (fixed(1 - each, _FORM_DECIMALS) for each in (shown / third, moment / spring))
    return near == shown and len(set(ends)) == 1


def _hidden(terms: Terms, modes: list[int]) -> int:
    """Return the number of the resonances within the working speeds."""
    return sum(
        int(np.count_nonzero(terms.column(f"torsion_critical.tor_in{m}_MPa"))) for m in modes
    )


def _resonances(terms: Terms, modes: list[int]) -> list[tuple[int, int]]:
    """Form and row of the strongest resonances within the working speeds."""
    resonances = []
    for m in modes:
        stresses = terms.column(f"torsion_critical.tor_in{m}_MPa")
        resonances += [(float(stresses[k]), m, int(k)) for k in np.flatnonzero(stresses)]
    return [(m, k) for _, m, k in sorted(resonances, reverse=True)[:_MAX_ROWS]]


def _rays(terms: Terms, resonances: list[tuple[int, int]]) -> tuple[Series, ...]:
    """Lines of the Campbell diagram: the orders of the strongest resonances."""
    orders = terms.column("torsion_critical.tor_order")
    strongest = [*dict.fromkeys(float(orders[k]) for _, k in resonances)][:_MAX_RAYS]
    return tuple(
        Series(
            "torsion_campbell.tor_speed_rpm",
            f"torsion_campbell.{ray_of(order)}",
            f"ν = {short(order)}",
        )
        for order in sorted(strongest)
    )


def _dangerous(terms: Terms) -> dict[str, tuple[Mark, ...]]:
    """Marks of the strongest resonance: over the orders and over the speed."""
    order, mode = terms.value("tor_worst_order"), round(terms.value("tor_worst_mode"))
    name = f"$\\nu$ = {short(order)} (форма {mode})"
    speed = f"{name}, {terms.num('tor_worst_rpm', beside='tor_n_max')} мин⁻¹"
    return {
        "stress": (Mark(name, order, terms.value("tor_worst")),),
        "speed": (Mark(speed, terms.value("tor_worst_rpm"), terms.value(f"tor_f{mode}_hz")),),
    }


def _resonance_table(terms: Terms, resonances: list[tuple[int, int]]) -> TableBlock:
    heads = [
        TableColumn("Форма"), TableColumn(symbol_head(r"\nu", "")),
        TableColumn(symbol_head(r"n_{\mathrm{кр}}", "мин⁻¹")), TableColumn(symbol_head(r"S_{\nu}",
                                                                                       "")),
        TableColumn(symbol_head(r"M_{\nu}", "Н·м")), TableColumn(symbol_head("A", "°")),
        TableColumn(symbol_head(r"\tau", "МПа")),
    ]  # fmt: skip
    moment = terms.quantity("torsion_critical.tor_M1_Nm").digits.decimals  # of the sheet
    keys = (("n{}_rpm", 0), ("sum{}", 3), ("M{}_Nm", max(0, moment - 1)), ("A{}_deg", 3),
            ("tau{}_MPa", 1))  # fmt: skip
    rows = [
        [
            str(m),
            fixed(float(terms.column("torsion_critical.tor_order")[k]), 1),
            *(
                fixed(float(terms.column(f"torsion_critical.tor_{key.format(m)}")[k]), digits)
                for key, digits in keys
            ),
        ]
        for m, k in sorted(resonances)
    ]
    return table_block(heads, rows)


def _flywheels(terms: Terms, bare: Peak, other: Peak) -> TableBlock:
    order, mode = terms.value("tor_worst_order"), round(terms.value("tor_worst_mode"))
    heads = [
        TableColumn("Величина", 3.4, text=True),
        TableColumn("маховик"),
        TableColumn("другой маховик"),
    ]
    firsts = [terms.value("tor_f1_hz"), terms.value("tor_f1_other_hz")]
    rows = [
        ["момент инерции, кг·м²", terms.num("tor_flywheel"), terms.num("tor_flywheel_other")],
        ["первая частота, Гц", *(fixed(f, 2) for f in firsts)],
    ]
    if order and mode == 1:
        title = f"резонанс порядка {fixed(order, 1).removesuffix(',0')}, мин⁻¹"
        rows.append([title, *(fixed(60 * f / order, 0) for f in firsts)])
    rows.append(["наибольшее напряжение, МПа", bare.text, other.text])
    rows.append(["при частоте вращения, мин⁻¹", bare.speed, other.speed])
    return table_block(heads, rows)


def _energy(terms: Terms) -> dict[str, Markup]:
    """Energy of a cycle at the speed of the greatest stress."""
    row = int(terms.column("torsion_response.tor_tau_MPa").argmax())
    columns = {key: f"torsion_response.tor_{key}_J" for key in ("work", "lost")}
    return {
        key: with_unit(significant(float(terms.column(name)[row]), _DIGITS), "Дж")
        for key, name in columns.items()
    }
