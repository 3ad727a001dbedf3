"""Resonances of the torsional vibration by the energy method, damper, forced vibration."""

from __future__ import annotations

from kshm.arrays import Columns
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.torsion import DAMPERS, TorsionSection
from reports.inputs.solved import solved
from reports.shared.russian import short
from reports.spec.blocks import Block, Column, Grid, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, line, polar
from reports.spec.judged import allowed
from reports.spec.listing import column_list, corners, grid_row, scalar_list
from reports.spec.parts import Part, Scope, stepped
from reports.tables.torsion.train import GIVEN, GUESS, MEMORY, RESULTS, Train, asked, train_of

CRITICAL, STAR, CAMPBELL = "Резонансы", "Звезда фаз", "Диаграмма Кэмпбелла"
FORCED, TORQUE = "Вынужденные колебания", "Момент по порядкам"
BY_PROGRAM = "посчитано программой при сборке"
LAST_ORDER, RAYS, STARS, SPEEDS = 12.0, 12, 6, 63
_TIE = "0.999999999"


def resonance(scope: Scope) -> Part:
    """Sheets of the resonances and of the forced vibration."""
    section = asked(scope)
    if section is None:
        return Part()
    train = train_of(scope.input, scope.shape)
    blocks: tuple[Block, ...] = (
        _torque(scope), _critical(scope, train, section), _star(scope), _phases(scope, train),
        _box(), _campbell(scope, train), _worst(train), _damper(section), _forced(), _fresh(),
        _allowed(),
    )  # fmt: skip
    return Part(blocks, _charts(scope, train))


def _torque(scope: Scope) -> TableSpec:
    lever = "F_piston*r_crank*sin(rad(phi_deg) + P4_1.beta_rad)/cos(P4_1.beta_rad)"
    return TableSpec(
        "torsion_torque",
        "К.о",
        "Моменты газовых сил и сил инерции цилиндра 1",
        TORQUE,
        column_list(f"""
            phi_deg
            tor_gas_Nm = of_MPa(P4_1.Pg_MPa)*{lever} | Гоц (37)
            tor_in_Nm = of_MPa(P4_1.Pj_MPa)*{lever} | Гоц (37)
        """),
        scope.cycle,
        helper=True,
    )


def _critical(scope: Scope, train: Train, section: TorsionSection) -> TableSpec:
    shape, model = scope.shape, scope.input
    step = 2 / shape.strokes
    last = min(LAST_ORDER, 180 / model.calculation.step_deg - step)
    columns = [Column("tor_order", None)]
    for m in train.modes:
        size, phase = f"torsion_phases.tor_amplitude{m}", "torsion_phases.tor_phase_deg"
        waves = (f"wave_{turn}({size}, {phase}, tor_order)**2" for turn in ("cos", "sin"))
        columns += column_list(f"tor_sum{m} = sqrt({' + '.join(waves)}) | сложение векторов")
    for m in train.modes:
        columns += column_list(
            f"tor_n{m}_rpm = 60*tor_f{m}_hz/tor_order | n = 60f/ν",
            f"""
            tor_M{m}_Nm = sqrt((tor_gas_cos*tor_scale{m} + tor_in_cos*{_faster(m)})**2
                + (tor_gas_sin*tor_scale{m} + tor_in_sin*{_faster(m)})**2) | ряд Фурье
            tor_A{m}_deg = deg(tor_M{m}_Nm*tor_sum{m}/tor_loss{m}) if tor_loss{m} > 0 else 0
                | энергия: A = MνS/D
            tor_tau{m}_MPa = tor_A{m}_deg*tor_twist{m} | форма колебаний
            tor_in{m}_MPa = tor_tau{m}_MPa if tor_n{m}_rpm >= tor_n_min
                and tor_n{m}_rpm <= tor_n_max else 0 | рабочий диапазон
            """,
        )
    columns += column_list(_helpers(train, section))
    columns = [columns[0], *sorted(columns[1:], key=lambda column: _place(column.key))]
    return TableSpec(
        "torsion_critical",
        "К.р",
        "Критические частоты вращения и резонансы по порядкам",
        CRITICAL,
        tuple(columns),
        stepped(step, last, step),
        note=(
            "Энергетический метод: на резонансе работа возмущения равна потерям, форма — "
            "собственная. Возмущение — гармоника момента цилиндра 1: газовые силы по расчётной "
            "индикаторной диаграмме, силы инерции по частоте вращения резонанса."
            + (" Моменты прицепных шатунов приняты равными моменту главного."
               if shape.articulated else "")
        ),
        step=step,
    )  # fmt: skip


def _place(key: str) -> tuple[int, str]:
    """Results by quantity and form, then the helpers."""
    kinds = ("tor_sum", "tor_n", "tor_M", "tor_A", "tor_tau", "tor_in", "tor_")
    helper = key.startswith(
        ("tor_gas", "tor_in_", "tor_speed", "tor_row", "tor_part", "tor_scale", "tor_at")
    )
    place = len(kinds) if helper else next(i for i, k in enumerate(kinds) if key.startswith(k))
    return place, "" if helper else key


def _faster(m: int) -> str:
    return f"(tor_n{m}_rpm/regime_speed_rpm)**2"


def _helpers(train: Train, section: TorsionSection) -> str:
    t = "torsion_torque"
    lines = ["helpers:"]
    for name in ("gas", "in"):
        lines += [
            f"tor_{name}_{turn} = fourier_{turn}({t}.tor_{name}_Nm, {t}.phi_deg, tor_order)"
            " | ряд Фурье"
            for turn in ("cos", "sin")
        ]
    for m in train.modes:
        lines += [
            *_scale(m, len(section.peaks)),
            f"tor_at{m} = tor_order if tor_worst_mode == {m}"
            f" and tor_in{m}_MPa >= tor_worst*{_TIE} else 0 | наибольший резонанс",
        ]
    return "\n".join(lines)


def _scale(m: int, points: int) -> list[str]:
    """The peak of the pressure at the critical speed over that of the diagram."""
    why, most = "давления по частоте вращения", "tor_diagram_MPa"
    if points < 2:
        return [f"tor_scale{m} = {'1' if not points else f'torpeakp1/{most}'} | {why}"]
    n, p = "torsion_peaks.tor_peak_rpm", "torsion_peaks.tor_peak_MPa"
    row = f"tor_row{m}"
    low, next_p, next_n = f"element({p}, {row})", f"element({p}, {row} + 1)", f"{row} + 1"
    return [
        f"tor_speed{m}_rpm = min(max(tor_n{m}_rpm, torpeakn1), torpeakn{points}) | {why}",
        f"{row} = place(tor_speed{m}_rpm, {n}) | {why}",
        f"tor_part{m} = (tor_speed{m}_rpm - element({n}, {row}))"
        f"/(element({n}, {next_n}) - element({n}, {row})) | {why}",
        f"tor_scale{m} = ({low} + tor_part{m}*({next_p} - {low}))/{most} | {why}",
    ]


def _worst(train: Train) -> ScalarTable:
    c = "torsion_critical"
    tops = [f"col_max({c}.tor_in{m}_MPa)" for m in train.modes]
    mode = "0"
    for m in reversed(train.modes):
        mode = f"{m} if {tops[m - 1]} >= tor_worst*{_TIE} else {mode}"
    speed = " + ".join(f"(tor_f{m}_hz if tor_worst_mode == {m} else 0)" for m in train.modes)
    return ScalarTable(
        "torsion_worst",
        "Наибольший резонанс рабочего диапазона",
        RESULTS,
        scalar_list(
            f"tor_worst = max({', '.join(tops)}) | наибольшее из таблицы",
            f"tor_worst_mode = 0 if tor_worst == 0 else {mode} | наибольшее из таблицы",
            f"tor_worst_order = max({', '.join(f'col_max({c}.tor_at{m})' for m in train.modes)})"
            " | наибольшее из таблицы",
            f"tor_worst_rpm = 60*({speed})/tor_worst_order if tor_worst_order > 0 else 0"
            " | n = 60f/ν",
        ),
    )  # fmt: skip


def _phases(scope: Scope, train: Train) -> Grid:
    """Angles of the cylinders and their amplitudes in the forms."""
    shape = scope.shape
    numbers = range(1, shape.cylinders + 1)
    masses = [train.mass_of(shape.throw_of(i)) for i in numbers]

    def sizes(m: int) -> list[str]:
        return [f"element(torsion_forms.tor_theta{m}, {k})" if k else "0" for k in masses]

    return Grid(
        "torsion_phases",
        "Цилиндры в формах колебаний",
        STAR,
        tuple(f"цилиндр {i}" for i in numbers),
        (
            grid_row("tor_phase_deg", (f"firing_offset_{i}_deg" for i in numbers), GIVEN,
                     "torphase{n}"),
            *(
                grid_row(f"tor_amplitude{m}", sizes(m), "форма колебаний", f"toramplitude{m}_{{n}}")
                for m in train.modes
            ),
        ),
    )  # fmt: skip


def _star_orders(scope: Scope) -> list[float]:
    """The lowest orders; higher ones add up as one of them does where the firing is regular."""
    shape = scope.shape
    return [k * 2 / shape.strokes for k in range(1, min(STARS, shape.cylinders) + 1)]


def _star(scope: Scope) -> TableSpec:
    lines = ["tor_cylinder"]
    a = "element(torsion_phases.tor_amplitude1, tor_cylinder)"
    for k, order in enumerate(_star_orders(scope), 1):
        turn = f"rad({order:g}*element(torsion_phases.tor_phase_deg, tor_cylinder))"
        lines += [
            f"tor_star_{axis}{k} = 0 if tor_cylinder == 0"
            f" else previous(tor_star_{axis}{k}) {sign} {a}*{wave}({turn}) | сложение векторов"
            for axis, sign, wave in (("x", "-", "sin"), ("y", "+", "cos"))
        ]
    stars = range(1, len(_star_orders(scope)) + 1)
    ends = ", ".join(f"abs(tor_star_{axis}{k})" for k in stars for axis in "xy")
    lines += ["helpers:", f"tor_star_most = max({ends}) | наибольшее из строки"]
    return TableSpec(
        "torsion_star",
        "К.з",
        "Звёзды фаз первой формы: векторы цилиндров один за другим",
        STAR,
        column_list("\n".join(lines)),
        stepped(0, scope.shape.cylinders, 1),
        note=(
            "Вектор цилиндра — амплитуда формы у его колена под углом −νθ. Конец ломаной — "
            "векторная сумма: прямая значит, что порядок складывается, замкнутая — что он гасится. "
            "При равном чередовании порядки, различающиеся на число рабочих ходов за оборот, "
            "складываются одинаково."
        ),
        step=1,
    )


def _box() -> Grid:
    return corners("torsion_star_box", "Границы звёзд фаз", STAR, "torstar",
                   "(col_max(torsion_star.tor_star_most)*1.1)", of="tor_star_box")  # fmt: skip


def ray_of(order: float) -> str:
    """Column of the Campbell diagram with the frequency of an order."""
    return f"torsion_campbell.tor_{'half' if order % 1 else 'ray'}{int(order)}_hz"


def _campbell(scope: Scope, train: Train) -> TableSpec:
    strokes = scope.shape.strokes
    orders = [k * 2 / strokes for k in range(1, RAYS * strokes // 2 + 1)]
    return TableSpec(
        "torsion_campbell",
        "К.к",
        "Диаграмма Кэмпбелла: частоты возмущений по частоте вращения",
        CAMPBELL,
        column_list(
            "tor_point",
            "tor_speed_rpm = 1.2*tor_n_max*tor_point/12 | до 1,2 nmax",
            *(f"tor_level{m}_hz = tor_f{m}_hz | собственная частота" for m in train.modes),
            *(
                f"{ray_of(order).partition('.')[2]} = {2 * order:g}*tor_speed_rpm/120 | f = νn/60"
                for order in orders
            ),
        ),
        stepped(0, 12, 1),
        step=1,
    )


def _damper(section: TorsionSection) -> ScalarTable:
    tuned = f'torsion_damper == "{DAMPERS["tuned"]}"'

    def given(key: str, guess: str, words: str) -> str:
        return f"torsion_{key} | {GIVEN}" if getattr(section, key) is not None else (
            f"{guess} | {words}")  # fmt: skip

    spring = "tor_ring*(2*pi*tor_kappa*tor_f1_hz)**2"
    best = f"2*(tor_zeta if {tuned} else tor_zeta_viscous)*tor_ring*2*pi*tor_f1_hz"
    if section.damper_nm_rad is not None:
        spring = "torsion_damper_nm_rad"
    return ScalarTable(
        "torsion_damper_list",
        "Гаситель на первой массе",
        RESULTS,
        scalar_list(f"""
            tor_ring = {given("damper_kg_m2", "0.2*tor_brought1", f"{GUESS}: 0,2 Jпр1")}
            tor_mu = tor_ring/tor_brought1 | доля кольца
            tor_kappa = 1/(1 + tor_mu) | Ден-Гартог, {MEMORY}
            tor_zeta = sqrt(3*tor_mu/(8*(1 + tor_mu)**3)) | Ден-Гартог, {MEMORY}
            tor_zeta_viscous = 1/sqrt(2*(1 + tor_mu)*(2 + tor_mu)) | {MEMORY}
            tor_damper_c = {spring} if {tuned} else 0 | наилучшая настройка или задано
            tor_damper_b = {given("damper_nms_rad", best, "наилучшее затухание 2ζJгω1")}
        """),
    )


def forced_values(model: InputFile) -> Columns:
    """What the solver finds for the sheet of the forced vibration, in units of the tables."""
    return solved(model).columns["torsion_response"]


def _forced() -> TableSpec:
    keys = (
        "tor_speed_rpm", "tor_tau_MPa", "tor_tau_damped_MPa", "tor_tau_other_MPa",
        "tor_shaft_no", "tor_lead_order", "tor_moment_Nm", "tor_front_deg", "tor_work_J",
        "tor_lost_J", "tor_mark",
    )  # fmt: skip
    return TableSpec(
        "torsion_response",
        "К.в",
        f"Вынужденные колебания ({BY_PROGRAM})",
        FORCED,
        (Column("tor_point", None), *(Column(key, None, BY_PROGRAM) for key in keys)),
        stepped(0, SPEEDS - 1, 1),
        note=(
            f"Числа этого листа — значения, а не формулы: {BY_PROGRAM} решением уравнений "
            "(−ω²J + iωB + K(1 + iη))θ = Mν для всех порядков и сложением во времени. После "
            "правки исходных данных соберите книгу заново."
        ),
        step=1,
        computed=forced_values,
    )


def _main_orders(scope: Scope) -> list[float]:
    """Orders to draw: those at which the cylinders of a common engine add up."""
    fired = 2 * scope.shape.cylinders / scope.shape.strokes  # in a turn
    step = fired if fired > 1 else 2.0
    if step >= 6 and step % 2 == 0:
        step /= 2
    return [k * step for k in range(1, int(RAYS / step) + 1)] or [float(RAYS)]


def _allowed() -> ScalarTable:
    lines = [
        (f"tor_top{which}", f"tor_top{which}_MPa", f"Наибольшая амплитуда напряжения {words}, МПа")
        for which, words in (("", "без гасителя"), ("_damped", "с гасителем"),
                             ("_other", "с другим маховиком"))
    ]  # fmt: skip
    title = "Амплитуда напряжения не больше допускаемой"
    return allowed("torsion_allowed", title, FORCED, "<= torsion_stress_allowed_mpa", lines)


def _fresh() -> ScalarTable:
    """Whether the values belong to the data of the open workbook."""
    live = (
        "col_sum(torsion_critical.tor_M1_Nm) + tor_f1_hz + tor_f1_other_hz + tor_loss1"
        " + tor_damper_b + tor_worst_order"
    )
    stored = "col_last(torsion_response.tor_mark)"
    yes, no = "отвечают исходным данным", "ДАННЫЕ ИЗМЕНЕНЫ: соберите книгу заново"
    text = f'"{yes}" if round(({live})/{stored}, 8) == 1 else "{no}"'
    t, most = "torsion_response", "наибольшее из таблицы"
    return ScalarTable(
        "torsion_fresh",
        "Значения этого листа",
        FORCED,
        scalar_list(f"""
            tor_fresh = {text}
            tor_top_MPa = col_max({t}.tor_tau_MPa) | {most}
            tor_top_rpm = element({t}.tor_speed_rpm, first_largest({t}.tor_tau_MPa)) | {most}
            tor_top_damped_MPa = col_max({t}.tor_tau_damped_MPa) | {most}
            tor_top_other_MPa = col_max({t}.tor_tau_other_MPa) | {most}
        """),
    )


def _charts(scope: Scope, train: Train) -> tuple[ChartSpec, ...]:
    c, k, f, n = "torsion_critical", "torsion_campbell", "torsion_response", "n, мин⁻¹"
    at = f"{k}.tor_speed_rpm"
    return (
        line("torsion_resonance", CRITICAL, "Резонансные напряжения по порядкам", ("ν", "τ, МПа"),
             *(Series(f"{c}.tor_order", f"{c}.tor_in{m}_MPa", f"форма {m}") for m in train.modes),
             caption="Резонансные напряжения в рабочем диапазоне по порядкам", stems=True),
        polar("torsion_star", STAR, "Звёзды фаз первой формы", ("x", "y"),
              "torsion_star_box.tor_star_box",
              *(Series(f"torsion_star.tor_star_x{o}", f"torsion_star.tor_star_y{o}",
                       f"ν = {short(order)}", only="" if o == 1 else "workbook")
                for o, order in enumerate(_star_orders(scope), 1)),
              caption="Сложение векторов цилиндров для наименьшего порядка, первая форма"),
        line("torsion_campbell", CAMPBELL, "Диаграмма Кэмпбелла", (n, "f, Гц"),
             *(Series(at, f"{k}.tor_level{m}_hz", f"f{m}", only="workbook") for m in train.modes),
             *(Series(at, ray_of(o), f"ν = {short(o)}") for o in _main_orders(scope)),
             levels=tuple(f"tor_f{m}_hz" for m in train.modes)),
        line("torsion_stress", FORCED, "Напряжения вала по частоте вращения", (n, "τ, МПа"),
             Series(f"{f}.tor_speed_rpm", f"{f}.tor_tau_MPa", "без гасителя"),
             Series(f"{f}.tor_speed_rpm", f"{f}.tor_tau_damped_MPa", "с гасителем"),
             Series(f"{f}.tor_speed_rpm", f"{f}.tor_tau_other_MPa", "другой маховик"),
             levels=("torsion_stress_allowed_mpa",),
             caption="Наибольшие напряжения кручения вала по частоте вращения"),
    )  # fmt: skip
