"""Film under the mean load: eccentricity and temperature by halving, as course works ask."""

from __future__ import annotations

from dataclasses import dataclass

from reports.inputs.checks.pairs import CLEARANCES
from reports.inputs.sections.bearings import MEMORY, OILS, BearingsSection
from reports.spec.blocks import Block, Grid, GridRow, Scalar, ScalarTable, TableSpec
from reports.spec.judged import allowed
from reports.spec.listing import column_list, grid_row, scalar_list
from reports.spec.parts import Part, Scope, stepped

SHEET, FILM = "Подшипники", "Плёнка {}"
STEPS = 42  # beyond that the halves differ by less than the rounding of the temperatures
GIVEN, BUT = "задано", "Бутеншён, 1976 (формулы по таблицам)"
ISO = "ISO 7902, по памяти"
_RULES = {
    "min": "0,007√d (по памяти, без источника)",
    "max": "вдвое больше наименьшего (без источника)",
}


@dataclass(frozen=True, slots=True)
class Case:
    """A bearing with one of its clearances; ``number`` as the solver counts them."""

    bearing: int
    which: int

    @property
    def number(self) -> int:
        """Number from 1; 1 and 2 are the big end."""
        return 2 * self.bearing + self.which

    @property
    def label(self) -> str:
        """What the column is called."""
        name = f"коренной {self.bearing}" if self.bearing else "шатунный"
        return f"{name}, Δ{'max' if self.which == 2 else 'min'}"

    @property
    def part(self) -> str:
        """Whose keys of the section it takes."""
        return "main" if self.bearing else "pin"


def bearings_of(scope: Scope) -> range:
    """Numbers of the bearings; articulated rods leave the big end, 0, out."""
    return range(1 if scope.shape.articulated else 0, scope.shape.throws + 2)


def cases_of(scope: Scope) -> list[Case]:
    """All bearings with both clearances."""
    return [Case(k, which) for k in bearings_of(scope) for which in (1, 2)]


def film(scope: Scope) -> Part:
    """Sheets of the film under the mean load."""
    section = scope.input.bearings
    if section is None:
        return Part()
    cases = cases_of(scope)
    blocks: list[Block] = [
        _results(cases), _allowed(cases), _oil_list(section), _oils(),
        _cases(scope, section, cases),
        *(_halving(case, section) for case in cases),
    ]  # fmt: skip
    return Part(tuple(blocks))


def _row(cases: list[Case], key: str, text: str, source: str, of: str = "") -> GridRow:
    """A quantity of every case; ``{n}`` in the formula is the case's number."""
    made = (text.format(n=case.number) for case in cases)
    name = of or key.replace("{n}", "1")
    return GridRow(
        name,
        tuple(
            Scalar(key.format(n=case.number), expr, source, of=name)
            for case, expr in zip(cases, made, strict=True)
        ),
    )


def _each(cases: list[Case], key: str, texts: list[str], sources: list[str]) -> GridRow:
    return GridRow(
        key.format(n=1),
        tuple(
            Scalar(key.format(n=case.number), expr, source, of=key.format(n=1))
            for case, expr, source in zip(cases, texts, sources, strict=True)
        ),
    )


def _cases(scope: Scope, section: BearingsSection, cases: list[Case]) -> Grid:
    diameters, widths, gaps, sources, forces, peaks, lands = [], [], [], [], [], [], []
    throw = scope.shape.throw_of(1)
    rods = scope.shape.rods_beside
    for case in cases:
        k, end, part = case.bearing, "max" if case.which == 2 else "min", case.part
        diameters.append(f"main_diameter_{k}_mm" if k else f"pin_diameter_{throw}_mm")
        width = f"main_length_{k}_mm" if k else f"pin_length_{throw}_mm/{rods}"
        if getattr(section, f"{part}_width_mm") is not None:
            width = f"bearings_{part}_width_mm"
        widths.append(f"({width} - bearings_{part}_groove_mm)/oil_lands{case.number}")
        lands.append(f"2 if bearings_{part}_groove_mm > 0 else 1")
        key = f"{part}_clearance_{end}_mm"
        given = getattr(section, key) is not None
        gaps.append(
            f"bearings_{key}" if given else f"{CLEARANCES[end]}*sqrt(oil_d{case.number}_mm)"
        )
        sources.append(GIVEN if given else _RULES[end])
        name = f"Rmain{k}" if k else "B"
        forces.append(f"of_MPa({name}_mean)*F_piston")
        peaks.append(
            f"of_MPa({name}_max)*F_piston/(oil_lands{case.number}*oil_land{case.number}_mm"
            f"*oil_d{case.number}_mm)"
        )
    same = [GIVEN] * len(cases)
    gots = ["Гоц, 2.6, 2.7"] * len(cases)
    b = "oil_b{n}"
    a1 = f"1.1642 - 1.9456*{b} + 7.1161*{b}**2 - 10.1073*{b}**3 + 5.0141*{b}**4"
    a2 = f"-1.000026 - 0.023634*{b} - 0.4215*{b}**2 - 0.038817*{b}**3 - 0.090551*{b}**4"
    turn = (
        f"1.152624 - 0.104565*{b}", f"-2.5905 + 0.798745*{b}", f"8.73393 - 2.3291*{b}",
        f"-13.3414 + 3.424337*{b}", f"6.6294 - 1.591732*{b}",
    )  # fmt: skip
    q = "(1.204 + 0.368*oil_spot{n} - 1.046*oil_spot{n}**2 + 1.942*oil_spot{n}**3)"
    feed = (
        "pi*of_MPa(bearings_supply_mpa)*of_mm(oil_d{n}_mm)**3*oil_psi{n}**3/48"
        "*(1/oil_b{n} if oil_lands{n} == 2 else 1/(-ln(oil_spot{n})*" + q + "))"
    )
    return Grid(
        "oil_cases",
        "Подшипники: размеры, нагрузки и постоянные формул плёнки",
        SHEET,
        tuple(case.label for case in cases),
        (
            _each(cases, "oil_d{n}_mm", diameters, same),
            _each(cases, "oil_gap{n}_mm", gaps, sources),
            _row(cases, "oil_psi{n}", "oil_gap{n}_mm/oil_d{n}_mm", "Δ/d"),
            _each(cases, "oil_lands{n}", lands, ["канавка делит подшипник надвое"] * len(cases)),
            _each(cases, "oil_land{n}_mm", widths, same),
            _row(cases, "oil_b{n}", "oil_land{n}_mm/oil_d{n}_mm", "B/d"),
            _each(cases, "oil_F{n}_N", forces, gots),
            _row(cases, "oil_k{n}_MPa", "oil_F{n}_N/(oil_lands{n}*oil_land{n}_mm*oil_d{n}_mm)",
                 "Fср/(Bd)"),
            _each(cases, "oil_kmax{n}_MPa", peaks, gots),
            _row(cases, "oil_unit{n}",
                 "oil_F{n}_N*oil_psi{n}**2/(oil_lands{n}*of_mm(oil_land{n}_mm)"
                 "*of_mm(oil_d{n}_mm)*omega)", "Fψ²/(zBн d ω)"),
            _row(cases, "oil_one{n}", a1, BUT),
            _row(cases, "oil_two{n}", a2, BUT),
            *(_row(cases, f"oila{i}_{{n}}", text, BUT, of=f"oil_a{i}")
              for i, text in enumerate(turn, 3)),
            _row(cases, "oil_shear{n}",
                 "pi*oil_lands{n}*of_mm(oil_land{n}_mm)*of_mm(oil_d{n}_mm)**2*omega**2"
                 "/(2*oil_psi{n})", BUT),
            _row(cases, "oil_side{n}",
                 "of_mm(oil_d{n}_mm)**3*oil_psi{n}*omega*(oil_b{n} - 0.223*oil_b{n}**3)/4", ISO),
            _row(cases, "oil_spot{n}", "min(bearings_hole_mm/oil_land{n}_mm, 0.9)", "dм/B"),
            _row(cases, "oil_feed{n}", feed, ISO),
        ),
        note=(
            "Зазор — по диаметру. Формулы Бутеншёна записаны для B/d от 0,1 до 1; канавка делит "
            "подшипник на две несущие части, каждая несёт половину нагрузки."
        ),
    )  # fmt: skip


def _oils() -> Grid:
    numbers = range(1, len(OILS) + 1)
    oils = list(OILS.values())
    return Grid(
        "oil_grades",
        "Масла: вязкость по сортам",
        SHEET,
        tuple(oil.label for oil in oils),
        (
            grid_row("oil_grade_40", (f"{oil.at_40:g}" for oil in oils), MEMORY, "oilcold{n}"),
            grid_row("oil_grade_100", (f"{oil.at_100:g}" for oil in oils), MEMORY, "oilwarm{n}"),
            grid_row("oil_picked", (f'1 if bearings_oil == "{oil.label}" else 0' for oil in oils),
                     "выбор в исходных данных", "oilpicked{n}"),
        ),
        note=(
            "Динамические вязкости — середины классов, по памяти. Между 40 и 100 °C и дальше — "
            f"закон Фогеля с постоянной 95 °C. Сортов {len(numbers)}; вместо них можно задать две "
            "вязкости своего масла."
        ),
    )  # fmt: skip


def _allowed(cases: list[Case]) -> ScalarTable:
    reserve = f"min({', '.join(f'oil_K{case.number}' for case in cases)})"
    line = "oil_K", reserve, "Наименьший запас плёнки среди подшипников"
    title = "Запас плёнки при средней нагрузке не меньше допускаемого (решает орбита)"
    return allowed("oil_allowed", title, SHEET, ">= bearings_reserve_allowed", [line])


def _oil_list(section: BearingsSection) -> ScalarTable:
    def viscosity(t: int, row: str) -> str:
        if getattr(section, f"viscosity_{t}_mpa_s") is not None:
            return f"bearings_viscosity_{t}_mpa_s | {GIVEN}"
        terms = ", ".join(f"oilpicked{n}*{row}{n}" for n in range(1, len(OILS) + 1))
        return f"total({terms}) | таблица масел"

    return ScalarTable(
        "oil_list",
        "Масло и критическая толщина плёнки",
        SHEET,
        scalar_list(f"""
            oil_hcr_um = bearings_journal_roughness_um + bearings_shell_roughness_um
                + bearings_form_um | сумма неровностей и отклонений
            oil_eta40 = {viscosity(40, "oilcold")}
            oil_eta100 = {viscosity(100, "oilwarm")}
            oil_vogel = ln(oil_eta40/oil_eta100)/(1/135 - 1/195) | закон Фогеля, 95 °C
        """),
    )


def table_of(case: Case) -> str:
    """Id of the table of a case."""
    return f"oil_film_{case.number}"


def _halving(case: Case, section: BearingsSection) -> TableSpec:
    """Half of the interval of eccentricities a row: viscosity that carries, heat it makes."""
    n, fixed = case.number, section.oil_temperature_c is not None
    x, mode = "oil_mid", "previous(oil_more) == 1"
    viscosity = f"1000*oil_unit{n}/oil_So | плёнка держит среднюю нагрузку"
    warm = f"oil_vogel/max(ln(oil_eta_mPas/oil_eta100) + oil_vogel/195, oil_vogel/495) - 95 | {BUT}"
    warm = warm.replace(BUT, "закон Фогеля, не выше 400 °C")
    more = "1 if oil_t_C < oil_balance_C else 0 | плёнка холоднее, чем её греет трение"
    if fixed:
        warm = f"bearings_oil_temperature_c | {GIVEN}"
        viscosity = "oil_eta100*exp(oil_vogel*(1/(oil_t_C + 95) - 1/195)) | закон Фогеля"
        more = f"1 if oil_So < 1000*oil_unit{n}/oil_eta_mPas else 0 | плёнка не держит нагрузку"
    lines = [
        f"oil_low = 0 if oil_step == 0 else previous(oil_mid) if {mode} else previous(oil_low)"
        " | деление пополам",
        f"oil_high = 1 if oil_step == 0 else previous(oil_high) if {mode} else previous(oil_mid)"
        " | деление пополам",
        "oil_mid = (oil_low + oil_high)/2 | деление пополам",
        f"oil_So = oil_b{n}**2*{x}/(2*(1 - {x}**2)**2)*sqrt(pi**2*(1 - {x}**2) + 16*{x}**2)"
        f"*oil_one{n}*({x} - 1)/(oil_two{n} + {x}) | {BUT}",
    ]
    oil = [f"oil_eta_mPas = {viscosity}", f"oil_t_C = {warm}"]
    lines += reversed(oil) if fixed else oil
    lines += [
        f"oil_beta = atan2(pi*sqrt(1 - {x}**2), 2*{x})*(oila3_{n} + {x}*(oila4_{n}"
        f" + {x}*(oila5_{n} + {x}*(oila6_{n} + {x}*oila7_{n})))) | {BUT}",
        f"oil_power_W = oil_shear{n}*oil_eta_mPas/1000/sqrt(1 - {x}**2)"
        f" + oil_psi{n}*{x}/4*oil_F{n}_N*sin(oil_beta)*of_mm(oil_d{n}_mm)*omega | {BUT}",
        f"oil_flow_l_min = 60000*(oil_side{n}*{x} + oil_feed{n}*1000/oil_eta_mPas"
        f"*((1 + 1.5*{x}**2) if oil_lands{n} == 2 else (1 + {x})**3)) | {ISO}",
        "oil_balance_C = bearings_supply_c + 30000*oil_power_W"
        "/(bearings_density_kg_m3*bearings_heat_j_kg_k*oil_flow_l_min) | баланс: t0 + ΔT/2",
        f"oil_more = {more}",
    ]
    name = f"коренной подшипник {case.bearing}" if case.bearing else "шатунный подшипник"
    return TableSpec(
        table_of(case),
        f"М.{n}",
        f"{name[0].upper()}{name[1:]}, {'наибольший' if case.which == 2 else 'наименьший'} зазор:"
        " плёнка при средней нагрузке",
        FILM.format(f"к.п {case.bearing}" if case.bearing else "ш.п"),
        column_list("oil_step", *lines),
        stepped(0, STEPS, 1),
        note=(
            "Эксцентриситет задан: число Зоммерфельда даёт вязкость, при которой плёнка держит "
            "среднюю нагрузку, вязкость — температуру, трение и расход — температуру по тепловому "
            "балансу. Пока первая ниже второй, берётся правая половина отрезка."
            if not fixed
            else "Температура масла задана: пока плёнка не держит нагрузку, берётся правая "
            "половина отрезка."
        ),
        step=1,
        helper=True,
    )


def _results(cases: list[Case]) -> Grid:
    def last(column: str) -> list[str]:
        return [f"col_last({table_of(case)}.{column})" for case in cases]

    halving = ["деление пополам"] * len(cases)
    heat = "bearings_density_kg_m3*bearings_heat_j_kg_k*oil_through{n}_l_min"
    return Grid(
        "oil_results",
        "Масляная плёнка при средней за цикл нагрузке",
        SHEET,
        tuple(case.label for case in cases),
        (
            _each(cases, "oil_chi{n}", last("oil_mid"), halving),
            _each(cases, "oil_temp{n}_C", last("oil_t_C"), halving),
            _each(cases, "oil_visc{n}_mPas", last("oil_eta_mPas"), halving),
            _row(cases, "oil_hmin{n}_um", "1000*oil_gap{n}_mm/2*(1 - oil_chi{n})", "Δ/2·(1 − χ)"),
            _row(cases, "oil_K{n}", "oil_hmin{n}_um/oil_hcr_um", "hmin/hкр"),
            _each(cases, "oil_friction{n}_W", last("oil_power_W"), halving),
            _each(cases, "oil_through{n}_l_min", last("oil_flow_l_min"), halving),
            _row(cases, "oil_hot{n}_C", "60000*oil_friction{n}_W/(" + heat + ")", "N/(ρcQ)"),
        ),
        note=(
            "Оценка по средней за цикл нагрузке, как в курсовых работах. Она завышает плёнку: "
            "нагрузка бывает больше средней, и плёнка за цикл — в несколько раз тоньше; решает "
            "орбита на своих листах. Давление плёнки обрезано там, где оно было бы отрицательным: "
            "плёнка с сохранением массы масла тоньше, чем здесь."
        ),
    )
