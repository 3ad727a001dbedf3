"""Free torsional vibration: Holzer's chain, bisection row by row, forms."""

from __future__ import annotations

from collections.abc import Sequence

from reports.inputs.sections.torsion import FORMULAS
from reports.spec.blocks import Block, Column, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, line
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope, stepped
from reports.tables.torsion.train import RESULTS, Train, asked, train_of

FREQUENCY, VARIANTS = "Крутильная частота {}", "Частоты вариантов"
FORMS = "Крутильные формы"
_SIGNS = 5
STEPS = 50  # 2⁻⁵⁰ of the bound
HOLZER = "цепочка Хольцера"


def free(scope: Scope) -> Part:
    """Sheets of the frequencies and the forms."""
    if asked(scope) is None:
        return Part()
    train = train_of(scope.input, scope.shape)
    inertias, springs = _names(train)
    tables = [
        _bisection(f"torsion_f{m}", f"К.{m}", f"Частота {m}: деление отрезка пополам",
                   FREQUENCY.format(m), inertias, springs, m)
        for m in train.modes
    ]  # fmt: skip
    tables.append(
        _bisection("torsion_f1_other", "К.м", "Первая частота с другим маховиком", VARIANTS,
                   _with_other_flywheel(train, inertias), springs, 1)
    )  # fmt: skip
    if not train.own:
        tables += [
            _bisection(f"torsion_f1_{key}", "К.ж", f"Первая частота при жёсткости: {name}",
                       VARIANTS, inertias, _springs_by(key, train, scope), 1)
            for key, name in FORMULAS.items()
        ]  # fmt: skip
    blocks: tuple[Block, ...] = (*tables, _forms(train), _results(train))
    return Part(blocks, _charts(train))


def _names(train: Train) -> tuple[list[str], list[str]]:
    numbers = range(1, train.count + 1)
    return [f"torJ{k}" for k in numbers], [f"torc{k}" for k in numbers]


def _with_other_flywheel(train: Train, inertias: Sequence[str]) -> list[str]:
    """The other flywheel in place of the one, which is the first of the greatest masses given."""
    if train.own:
        return [
            f"(tor_flywheel_other if tor_greatest == {k} else {name})"
            for k, name in enumerate(inertias, 1)
        ]
    last = train.flywheel - 1
    return [*inertias[:last], "tor_flywheel_other", *inertias[last + 1 :]]


def _springs_by(key: str, train: Train, scope: Scope) -> list[str]:
    """Stiffnesses with the compliances of one formula in place of the chosen one."""
    found = []
    for k, cell in enumerate(train.stiffnesses, 1):
        text = cell.expr
        for throw in range(scope.shape.throws, 0, -1):
            text = text.replace(f"tore{throw}", f"tore_{key}_{throw}")
        found.append(f"({text})" if text != cell.expr else f"torc{k}")
    section = scope.input.torsion
    if section is not None and section.driven_kg_m2 is not None and section.driven_nm_rad is None:
        found[-2] = found[-3]
    return found


def _bisection(
    table: str, number: str, title: str, sheet: str,
    inertias: Sequence[str], springs: Sequence[str], mode: int,
) -> TableSpec:  # fmt: skip
    """Half of the interval with the wanted frequency a row; the chain tells how many lie below."""
    chain, signs, before = [], [], "1"
    for k, (inertia, spring) in enumerate(zip(inertias, springs, strict=True), 1):
        angle = "1" if k == 1 else f"tor_angle{k}"
        past = "-torsion_ground_nm_rad" if k == 1 else f"tor_turned{k - 1}"
        if k > 1:
            chain.append(f"tor_angle{k} = {before} - tor_turned{k - 1}/{springs[k - 2]} | {HOLZER}")
            signs.append(f"1 if ({before} < 0) != ({angle} < 0) else 0")
        chain.append(f"tor_turned{k} = {past} + tor_mid**2*{inertia}*{angle} | {HOLZER}")
        before = angle
        if k == len(inertias):
            rest = f"{spring}*{angle} - tor_turned{k}"
            signs.append(f"1 if ({angle} < 0) != ({rest} < 0) else 0")
    # A formula that one can read holds the signs of a few masses.
    parts = [signs[at : at + _SIGNS] for at in range(0, len(signs), _SIGNS)]
    for k, part in enumerate(parts, 1):
        chain.append(f"tor_signs{k} = total({', '.join(part)}) | перемены знака")
    below = ", ".join(f"tor_signs{k}" for k in range(1, len(parts) + 1))
    # A train free at both ends turns as a whole: one frequency more, of zero.
    low = f"previous(tor_below) < {mode} + (1 if torsion_ground_nm_rad + {springs[-1]} == 0 else 0)"
    return TableSpec(
        table,
        number,
        title,
        sheet,
        column_list(
            "tor_step",
            f"""
            tor_low = 0 if tor_step == 0 else previous(tor_mid) if {low} else previous(tor_low)
                | деление пополам
            tor_high = tor_limit if tor_step == 0 else previous(tor_high) if {low}
                else previous(tor_mid) | деление пополам
            tor_mid = (tor_low + tor_high)/2 | деление пополам
            """,
            *chain,
            f"tor_below = total({below}) | перемены знака (Штурм)",
        ),
        stepped(0, STEPS, 1),
        note=(
            "Угол первой массы принят за 1. Перемены знака в цепочке углов и остаточного момента "
            "считают частоты ниже ω: пока их меньше нужного, берётся правая половина отрезка."
        ),
        step=1,
        helper=True,
    )


def _forms(train: Train) -> TableSpec:
    results = [Column("tor_mass", None)]
    helpers: list[Column] = []
    results += column_list("""
        tor_J_kgm2 = element(torsion_train.tor_J_kgm2, tor_mass) | крутильная схема
        tor_c_Nm_rad = element(torsion_train.tor_c_Nm_rad, tor_mass) | крутильная схема
    """)
    for m in train.modes:
        results += column_list(f"""
            tor_theta{m} = 1 if tor_mass == 1
                else previous(tor_theta{m}) - previous(tor_moment{m}_Nm)/previous(tor_c_Nm_rad)
                | {HOLZER}
        """)
        helpers += column_list(_along(m, train))
    for m in train.modes:
        a = f"tor_theta{m}"
        results += column_list(f"""
            tor_node{m} = 0 if tor_mass == 1
                else tor_mass - 1 + previous({a})/(previous({a}) - {a})
                if (previous({a}) < 0) != ({a} < 0) else 0 | перемена знака
        """)
    # The moments stand before the forms that the next row takes from them.
    return TableSpec(
        "torsion_forms",
        "К.ф",
        "Формы крутильных колебаний",
        FORMS,
        (*results, *helpers),
        stepped(1, train.count, 1),
        note=(
            "Угол первой массы принят за 1. Узел — место на участке перед массой, где форма меняет "
            "знак: 2,3 — между массами 2 и 3, в трёх десятых участка от массы 2."
        ),
        step=1,
    )


def _along(m: int, train: Train) -> str:
    """Sums along the form: moment, inertia, losses; stress of the shaft before the mass."""
    a, square = f"tor_theta{m}", f"(2*pi*tor_f{m}_hz)**2"
    twist = f"({a} - previous({a}))"
    end = f" + (torsion_loss_factor*tor_c_Nm_rad*{a}**2 if tor_mass == {train.count} else 0)"
    b = "element(torsion_train.tor_b_Nms_rad, tor_mass)"
    return f"""
        helpers:
        tor_moment{m}_Nm = (-torsion_ground_nm_rad if tor_mass == 1
            else previous(tor_moment{m}_Nm)) + {square}*tor_J_kgm2*{a} | {HOLZER}
        tor_whole{m} = (0 if tor_mass == 1 else previous(tor_whole{m})) + tor_J_kgm2*{a}**2
            | приведение к первой массе
        tor_spent{m} = (torsion_loss_factor*torsion_ground_nm_rad if tor_mass == 1
            else previous(tor_spent{m})
            + torsion_loss_factor*previous(tor_c_Nm_rad)*{twist}**2)
            + 2*pi*tor_f{m}_hz*{b}*{a}**2{end} | энергия
        tor_shaft{m}_MPa = 0 if tor_mass == 1
            else abs(previous(tor_c_Nm_rad)*{twist})
            /element(torsion_train.tor_W_cm3, tor_mass - 1)*pi/180 | τ = M/Wp
    """


def _results(train: Train) -> ScalarTable:
    lines = [
        f"tor_f{m}_hz = col_last(torsion_f{m}.tor_mid)/(2*pi) | деление пополам"
        for m in train.modes
    ]
    for m in train.modes:
        lines += [
            f"tor_rest{m} = (col_last(torsion_forms.tor_moment{m}_Nm)"
            f" - torc{train.count}*col_last(torsion_forms.tor_theta{m}))"
            f"/((2*pi*tor_f{m}_hz)**2*tor_brought{m}) | {HOLZER}: проверка",
            f"tor_brought{m} = col_last(torsion_forms.tor_whole{m}) | ΣJa²",
            f"tor_loss{m} = col_last(torsion_forms.tor_spent{m}) | ωΣba² + ηΣcΔa²",
            f"tor_twist{m} = col_max(torsion_forms.tor_shaft{m}_MPa) | τ = M/Wp",
        ]
    lines.append("tor_f1_other_hz = col_last(torsion_f1_other.tor_mid)/(2*pi) | деление пополам")
    lines.append("tor_f1_change = (tor_f1_other_hz/tor_f1_hz - 1)*100 | сравнение")
    if not train.own:
        firsts = [f"tor_f1_{key}_hz" for key in FORMULAS]
        lines += [
            f"{name} = col_last(torsion_f1_{key}.tor_mid)/(2*pi) | деление пополам"
            for name, key in zip(firsts, FORMULAS, strict=True)
        ]
        together = ", ".join(firsts)
        lines.append(
            f"tor_f1_spread = (max({together}) - min({together}))/tor_f1_hz*100 | сравнение"
        )
    return ScalarTable(
        "torsion_results", "Частоты и приведённые величины", RESULTS, scalar_list(*lines)
    )


def _charts(train: Train) -> tuple[ChartSpec, ...]:
    f = "torsion_forms"
    return (
        line("torsion_forms", FORMS, "Формы крутильных колебаний", ("номер массы", "a"),
             *(Series(f"{f}.tor_mass", f"{f}.tor_theta{m}", f"форма {m}") for m in train.modes),
             x_step=1.0),
    )  # fmt: skip
