"""Summary of results and checks."""

from __future__ import annotations

from reports.inputs.checks.power import MOST
from reports.inputs.sections.input_file import InputFile
from reports.shared.russian import capital
from reports.spec.blocks import Block, Grid, GridRow, Scalar, ScalarTable
from reports.spec.extremes import extreme_scalars
from reports.spec.judged import NO, YES, judged
from reports.spec.listing import grid_row, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape, pin_name, pin_table
from reports.tables.gas.cycle_names import section_of
from reports.tables.gas.cycle_speed import cycle_checks
from reports.tables.loads.wear import hole_scalars
from reports.tables.motion.rod_masses import USUAL_SHARE, is_usual_share

SHEET = "Итоги"


def summary(scope: Scope) -> Part:
    """Torque, crankpin, journals, running-on torques, checks."""
    model, shape = scope.input, scope.shape
    throws, pins = shape.throws, len(shape.pins)
    journals = throws + 1
    blocks: tuple[Block, ...] = (
        _torque(model, shape),
        *(_pin(number, shape) for number in range(1, pins + 1)),
        *(_journal(k) for k in range(1, journals + 1)),
        _running(throws),
        _loads(pins),
        _ranks(shape),
        checks(model, shape),
    )
    return Part(blocks)


def _torque(model: InputFile, shape: Shape) -> ScalarTable:
    efficiency, power, fullness = (
        "regime_mechanical_efficiency",
        "regime_indicated_power_kw",
        "*regime_fullness",
    )
    if section_of(model) is not None:
        efficiency, power, fullness = "cyc_eta_m", "cyc_N_gas", ""
    scalars = [
        Scalar("M_mean", "col_mean(P4_2.Msum_Nm)", "Гоц, 2.8"),
        *extreme_scalars("P4_2", "Msum_Nm", "M", "Гоц, 2.9"),
        *scalar_list(f"""
            M_e = M_mean*{efficiency} | Гоц (59), 2.8
            N_i_calc = to_kW(M_mean*omega) | Гоц, 2.8
            p_i_calc = to_MPa(M_mean*{shape.turn}/of_dm3(V_engine)) | Гоц, 2.8
            T_mean = to_MPa(M_mean/(F_piston*r_crank)) | Гоц, 2.8
            W_cycle = col_sum(gas.work_J) | ∫p dV
        """),
        *(_hung_work(shape) if shape.articulated else ()),
        Scalar(
            "W_torque",
            f"{shape.turn}*M_mean/engine_cylinders",
            "Гоц, 2.8",
            of="" if shape.strokes == 4 else "W_torque_two",
        ),
    ]
    if _power_is_known(model):
        reference = f"30/pi*of_kW({power})/(regime_speed_rpm*r_crank*F_piston{fullness})"
        scalars += scalar_list(f"""
            T_ref = to_MPa({reference}) | Гоц, 2.8
            T_error = (T_mean/T_ref - 1)*100 | Гоц, 2.8
        """)
    return ScalarTable("summary_torque", "Крутящий момент двигателя", SHEET, tuple(scalars))


def _power_is_known(model: InputFile) -> bool:
    return model.regime.indicated_power_kw is not None or section_of(model) is not None


def _hung_work(shape: Shape) -> tuple[Scalar, ...]:
    table = f"cylinder_{shape.cylinders}"
    return (Scalar("W_hung", f"col_sum({table}.work_J)", "∫p dV"),)


def _pin(number: int, shape: Shape) -> ScalarTable:
    n, several, table = pin_name(number), len(shape.pins) > 1, pin_table(number)
    throw = shape.throw_of(shape.pins[number - 1][0])
    least = f"Rpin{n}_min_kN = to_kN(of_MPa(Rpin{n}_min)*F_piston) | Гоц, 2.9"
    return ScalarTable(
        f"summary_pin{n}",
        f"Шатунная шейка {number if several else ''}".strip(),
        SHEET,
        _journal_loads(f"pin{n}", f"{table}.Rpin_MPa", f"pin_{{}}_{throw}_mm", "2.6", least),
    )


def _journal(k: int) -> ScalarTable:
    return ScalarTable(
        f"summary_main_{k}",
        f"Коренная шейка {k}",
        SHEET,
        _journal_loads(f"main{k}", f"P4_3_{k}.R_MPa", f"main_{{}}_{k}_mm", "2.9"),
    )


def _journal_loads(
    name: str, column: str, size: str, section: str, least: str = ""
) -> tuple[Scalar, ...]:
    """Loads of a journal, its pressures and its oil hole."""
    load, (table, key) = f"R{name}", column.split(".")
    projected = f"(of_mm({size.format('diameter')})*of_mm({size.format('length')}))"
    return (
        Scalar(f"{load}_mean", f"col_mean({column})", f"Гоц, {section}"),
        *extreme_scalars(table, key, load, f"Гоц, {section}"),
        *scalar_list(f"""
            {load}_max_kN = to_kN(of_MPa({load}_max)*F_piston) | Гоц, 2.9
            {least}
            q_{name}_mean = {load}_mean*F_piston/{projected} | Гоц, 2.6
            q_{name}_max = {load}_max*F_piston/{projected} | Гоц, 2.6
        """),
        *hole_scalars(name),
    )


def _running(throws: int) -> ScalarTable:
    swings = [(f"dM_main{k}", f"P4_4.Mmain{k}_Nm") for k in range(2, throws + 2)]
    swings += [(f"dM_pin{i}", f"P4_5.Mpin{i}_Nm") for i in range(1, throws + 1)]
    scalars = [Scalar(key, f"col_max({of}) - col_min({of})", "Гоц, 2.8") for key, of in swings]
    scalars += scalar_list("""
        worst_main_torque = first_largest(ranks.rank_dM_main) + 1 | Гоц, 2.8
        worst_pin_torque = first_largest(ranks.rank_dM_pin) | Гоц, 2.8
    """)
    return ScalarTable("summary_running", "Размах набегающих моментов", SHEET, tuple(scalars))


def _loads(pins: int) -> ScalarTable:
    lines = ["worst_main_load = first_largest(ranks.rank_Rmain) | Гоц, 2.9"]
    if pins > 1:
        lines.append("worst_pin_load = first_largest(ranks.rank_Rpin) | Гоц, 2.9")
    title = "Наиболее нагруженная коренная шейка" if pins == 1 else "Наиболее нагруженные шейки"
    return ScalarTable("summary_loads", title, SHEET, scalar_list(*lines))


def _ranks(shape: Shape) -> Grid:
    """What is compared among journals, pins and cylinders, equal values made equal."""
    journals, throws = range(1, shape.throws + 2), range(1, shape.throws + 1)
    most = max(shape.cylinders, shape.throws + 1)

    def row(of: str, texts: dict[int, str]) -> GridRow:
        rounded = (f"round({texts[n]}, 6)" if n in texts else None for n in range(1, most + 1))
        return grid_row(of, rounded, "округлено до шести знаков")

    rows = [
        row("rank_Rmain", {k: f"Rmain{k}_max" for k in journals}),
        row("rank_dM_main", {k: f"dM_main{k}" for k in journals if k > 1}),
        row("rank_dM_pin", {i: f"dM_pin{i}" for i in throws}),
    ]
    pins = range(1, len(shape.pins) + 1)
    if len(pins) > 1:
        rows.append(row("rank_Rpin", {n: f"Rpin{pin_name(n)}_max" for n in pins}))
    rows.append(row("rank_phase", {i: _phase(shape, i) for i in range(1, shape.cylinders + 1)}))
    labels = tuple(f"№ {n}" for n in range(1, most + 1))
    return Grid("ranks", "Сравнение шеек и цилиндров по номерам", SHEET, labels, tuple(rows))


def checks(model: InputFile, shape: Shape) -> ScalarTable:
    """Checks with their value and verdict; a failed check shows НЕТ."""
    throws = shape.throws
    work = "W_cycle" if not shape.articulated else "((W_cycle + W_hung)/2)"
    tests: list[tuple[str, str, str, str]] = [
        ("closure", "Последний набегающий момент равен суммарному: наибольшее расхождение, Н·м",
         f"abs(col_max(P4_4.Mmain{throws + 1}_Nm) - M_max)"
         f" + abs(col_min(P4_4.Mmain{throws + 1}_Nm) - M_min)", "{value} <= 0.000001"),
        ("work", "Работа момента равна работе газов ∫p dV: расхождение, %",
         f"(W_torque/{work} - 1)*100", "abs({value}) <= 5"),
        ("grid", "Сетка углов замыкает цикл: последний угол, °",
         "col_last(P4_2.phi_deg)", f"abs({{value}} - {shape.period}) <= 0.000001"),
        ("lam", "λ в обычных пределах 0,24…0,31 (расширенно 0,15…0,45)",
         "lam", "{value} >= 0.15 and {value} <= 0.45"),
        ("phases", "Углы колен согласованы с началом рабочих ходов: наибольшее расхождение, °",
         "col_max(ranks.rank_phase)", "{value} <= 0.01"),
        ("symmetry", "Колена симметричны: наибольшее отличие доли правой опоры от половины",
         f"max({', '.join(_asymmetry(shape, i) for i in range(1, throws + 1))})",
         "{value} <= 0.000001"),
    ]  # fmt: skip
    if section_of(model) is not None:
        tests += cycle_checks()
    if _power_is_known(model):
        tests.append(
            ("power", "Средняя тангенциальная сила сходится с мощностью цикла: расхождение, %",
             "T_error", f"abs({{value}}) <= {MOST:g}")
        )  # fmt: skip
    if model.masses.reciprocating_kg is None:
        tests.append(
            ("share", capital(USUAL_SHARE), "m_1/masses_rod_kg", is_usual_share("{value}"))
        )  # fmt: skip
    scalars = [
        scalar
        for key, title, value, test in tests
        for scalar in judged(f"value_{key}", f"check_{key}", value, test, title)
    ]
    return ScalarTable("checks", "Проверки", "Проверки", tuple(scalars), verdicts=(YES, NO))


def _phase(shape: Shape, i: int) -> str:
    """How far the throw under a cylinder is from where its firing offset wants it [deg]."""
    angle = f"throw_angle_{shape.throw_of(i)}_deg + firing_offset_{i}_deg"
    if shape.is_right(i):
        angle += f" - {shape.axis(i)}" + (" + crankshaft_split_pin_deg" if shape.split else "")
    return f"abs(mod({angle} + 180, 360) - 180)"


def _asymmetry(shape: Shape, throw: int) -> str:
    """How far the rods of a throw stand from its middle, over its length."""
    if shape.single_rods or shape.articulated:
        return f"abs(throw{throw}_share - 0.5)"
    return f"abs((throw{throw}_share + throw{throw}_share2)/2 - 0.5)"
