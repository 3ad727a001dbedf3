"""Orbits of the journals over the cycle: values of the solver; the best angle of the oil hole."""

from __future__ import annotations

from functools import partial

from kshm.arrays import Columns
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solved import solved
from reports.spec.blocks import Block, Column, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, over_phi, polar
from reports.spec.judged import allowed
from reports.spec.listing import column_list, corners, scalar_list
from reports.spec.parts import Part, Scope
from reports.tables.oil.film import bearings_of, cases_of

SUMMARY = "Орбиты подшипников"
BY_PROGRAM = "посчитано программой при сборке"
_VALUES = (
    "oil_eps_max", "oil_orb_h_um", "oil_orb_phi_deg", "oil_shell_deg", "oil_journal_deg",
    "oil_under", "oil_orb_W", "oil_orb_l_min", "oil_hole_deg", "oil_open", "oil_mark",
)  # fmt: skip
_OF_ORBIT = (
    "oil_eps1", "oil_eps2", "oil_delta1_deg", "oil_delta2_deg", "oil_h1_um", "oil_h2_um",
    "oil_x1", "oil_x2", "oil_y1", "oil_y2", "oil_load_x", "oil_load_y",
)  # fmt: skip


def orbit(scope: Scope) -> Part:
    """Sheets of the orbits."""
    if scope.input.bearings is None:
        return Part()
    bearings = bearings_of(scope)
    blocks: list[Block] = [_summary(scope), _fresh(), _allowed()]
    if 0 in bearings:
        blocks.append(_holes())
    for k in bearings:
        blocks += [
            _orbit(scope, k),
            corners(f"oil_orbit_{k}_box", "Оси диаграммы", sheet_of(k), f"oilbox{k}_", "1.05",
                    of="oil_box"),
        ]  # fmt: skip
    charts = tuple(chart for k in bearings for chart in _charts(k))
    return Part(tuple(blocks), charts)


def sheet_of(bearing: int) -> str:
    """Sheet of a bearing's orbit."""
    return f"Орбита к.п ({bearing})" if bearing else "Орбита ш.п"


def values_of(table: str, model: InputFile) -> Columns:
    """What the solver finds for a sheet, in units of the tables."""
    return solved(model).columns[table]


def _summary(scope: Scope) -> TableSpec:
    cases = cases_of(scope)
    row = f"(oil_case - {cases[0].number - 1})" if cases[0].number > 1 else "oil_case"
    live = (
        f"element(oil_cases.oil_F1_N, {row}) + element(oil_cases.oil_kmax1_MPa, {row})"
        f" + 100*element(oil_results.oil_chi1, {row}) + element(oil_results.oil_visc1_mPas, {row})"
    )
    return TableSpec(
        "oil_orbits",
        "М.о",
        f"Орбиты подшипников за цикл ({BY_PROGRAM})",
        SUMMARY,
        (
            Column("oil_case", None),
            *(Column(key, None, BY_PROGRAM) for key in _VALUES),
            *column_list(f"helpers:\noil_changed = abs(({live})/oil_mark - 1) | метка данных"),
        ),
        tuple(float(case.number) for case in cases),
        note=(
            f"Числа этого листа — значения, а не формулы: {BY_PROGRAM} по подвижности плёнки из "
            "уравнения Рейнольдса, пока цикл не замкнётся. Строки: "
            + "; ".join(f"{case.number} — {case.label}" for case in cases)
            + ". Плёнка с сохранением массы масла тоньше, чем по этому методу."
        ),
        step=1,
        computed=partial(values_of, "oil_orbits"),
    )


def _fresh() -> ScalarTable:
    yes, no = "отвечают исходным данным", "ДАННЫЕ ИЗМЕНЕНЫ: соберите книгу заново"
    text = f'"{yes}" if round(col_max(oil_orbits.oil_changed), 8) == 0 else "{no}"'
    return ScalarTable(
        "oil_fresh", "Значения орбит", SUMMARY,
        scalar_list(f"oil_fresh = {text}"),
    )  # fmt: skip


def _allowed() -> ScalarTable:
    least = "col_min(oil_orbits.oil_orb_h_um)/oil_hcr_um"
    line = "oil_orbit", least, "Наименьшая за цикл плёнка к критической"
    title = "Плёнка за цикл не тоньше критической"
    return allowed("oil_orbit_allowed", title, SUMMARY, ">= 1", [line])


def _holes() -> ScalarTable:
    t = "crankpin"
    return ScalarTable(
        "oil_holes",
        "Лучший угол масляного отверстия шатунной шейки: от колена против вращения",
        SUMMARY,
        scalar_list(f"""
            oil_load_deg = mod(deg(atan2(-col_mean({t}.T_MPa), -col_mean({t}.Krod_MPa))), 360)
                | против средней нагрузки
            oil_wear_deg = hole_pin_deg | Гоц, рис. 33: по износу
            oil_film1_deg = element(oil_orbits.oil_hole_deg, 1) | толще всего плёнка, Δmin
            oil_film2_deg = element(oil_orbits.oil_hole_deg, 2) | толще всего плёнка, Δmax
        """),
        note=(
            "По плёнке: угол шейки, где наименьший за цикл просвет больше всего (шаг 5°); "
            f"{BY_PROGRAM}."
        ),
    )


def _orbit(scope: Scope, bearing: int) -> TableSpec:
    name = f"коренном подшипнике {bearing}" if bearing else "шатунном подшипнике"
    axes = "вверх в плоскости первого ряда" if bearing else "вдоль шатуна к поршню"
    return TableSpec(
        f"oil_orbit_{bearing}",
        f"М.о{bearing}",
        f"Орбита шейки в {name} ({BY_PROGRAM})",
        sheet_of(bearing),
        (
            Column("phi_deg", None),
            *(Column(key, None, BY_PROGRAM) for key in _OF_ORBIT),
            *column_list("""
                helpers:
                oil_circle_x = sin(rad(phi_deg)) | круг зазора
                oil_circle_y = cos(rad(phi_deg)) | круг зазора
            """),
        ),
        scope.cycle,
        note=(
            f"Значения, а не формулы: {BY_PROGRAM}. Ось y — {axes}, x — по вращению вала; зазор 1 "
            "— наименьший, 2 — наибольший; вязкость — из теплового баланса при средней нагрузке."
        ),
        computed=partial(values_of, f"oil_orbit_{bearing}"),
    )


def _charts(bearing: int) -> tuple[ChartSpec, ...]:
    t, sheet = f"oil_orbit_{bearing}", sheet_of(bearing)
    of = f"коренного подшипника {bearing}" if bearing else "шатунного подшипника"
    return (
        polar(t, sheet, f"Орбита {of} и нагрузка",
              ("x (по вращению)", "y"), f"{t}_box.oil_box",
              Series(f"{t}.oil_x2", f"{t}.oil_y2", "Δmax"),  # the one whose angles are named
              Series(f"{t}.oil_x1", f"{t}.oil_y1", "Δmin"),
              Series(f"{t}.oil_load_x", f"{t}.oil_load_y", "нагрузка"),
              Series(f"{t}.oil_circle_x", f"{t}.oil_circle_y", "круг зазора"),
              caption=f"Орбиты центра шейки в круге зазора {of} при наибольшем (с углами φ) и "
                      "наименьшем зазоре; нагрузка — в долях наибольшей"),
        over_phi(f"{t}_gap", sheet, f"Плёнка {of} за цикл", "h, мкм",
                 Series("", f"{t}.oil_h2_um", "Δmax"), Series("", f"{t}.oil_h1_um", "Δmin"),
                 levels=("oil_hcr_um",),
                 caption=f"Наименьшая толщина плёнки {of} за цикл"),
    )  # fmt: skip
