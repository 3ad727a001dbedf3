"""Safety of main journals and crankpins by the textbook's loads, Serensen and Kinasoshvili."""

from __future__ import annotations

from reports.inputs.sections.bearings import MATERIALS, BearingsSection
from reports.spec.blocks import Block, Grid, ScalarTable
from reports.spec.judged import allowed
from reports.spec.listing import grid_row, scalar_list
from reports.spec.parts import Part, Scope
from reports.tables.oil.pin_safety import SHEET, SK, modulus, pin_safety, safety_of

MATERIAL = "Материал вала"
_LEAST = (
    ("safe_main", "safe_n_main", "Наименьший запас коренной шейки"),
    ("safe_pin", "safe_n_pin", "Наименьший запас шатунной шейки"),
)


def safety(scope: Scope) -> Part:
    """Sheets of the material and of the safety."""
    section = scope.input.bearings
    if section is None:
        return Part()
    throws = scope.shape.throws
    blocks: list[Block] = [
        _list(scope),
        allowed(
            "safety_allowed",
            "Запас прочности не меньше допускаемого",
            SHEET,
            ">= bearings_safety_allowed",
            _LEAST,
        ),
        _journals(throws),
        *pin_safety(scope, section),
        _material(section),
        _materials(),
    ]
    return Part(tuple(blocks))


def _materials() -> Grid:
    rows = list(MATERIALS.values())
    numbers = {
        "mat_tensile_MPa": [row.tensile for row in rows],
        "mat_yield_MPa": [row.yielding for row in rows],
        "mat_bending_MPa": [row.bending for row in rows],
        "mat_torsion_MPa": [row.torsion for row in rows],
        "mat_making": [row.making for row in rows],
    }
    return Grid(
        "materials",
        "Материалы коленчатых валов",
        MATERIAL,
        tuple(row.label for row in rows),
        (
            *(
                grid_row(of, (f"{value:g}" for value in values), "см. примечание",
                         f"{of.replace('_', '')}at{{n}}")
                for of, values in numbers.items()
            ),
            grid_row("mat_picked", (f'1 if bearings_material == "{row.label}" else 0'
                                    for row in rows), "выбор в исходных данных", "matpicked{n}"),
        ),
        note="Источники: " + "; ".join(f"{row.label} — {row.source}" for row in rows) + ".",
    )  # fmt: skip


def _picked(key: str) -> str:
    terms = (f"matpicked{n}*{key.replace('_', '')}at{n}" for n in range(1, len(MATERIALS) + 1))
    return f"total({', '.join(terms)}) | таблица материалов"


def _material(section: BearingsSection) -> ScalarTable:
    def limit(key: str, given: str) -> str:
        if getattr(section, given) is not None:
            return f"{key} = bearings_{given} | задано"
        return f"{key} = {_picked(key)}"

    size = "(bearings_size_factor*bearings_surface_factor)"
    factors = "\n".join(
        f"safe_k{short}_{way} = (1 + bearings_sensitivity*(bearings_{where}_{key} - 1))/{size}"
        " | 1 + q(α − 1), без источника"
        for short, where in (("f", "fillet"), ("h", "hole"))
        for way, key in (("bend", "bending"), ("turn", "torsion"))
    )
    return ScalarTable(
        "material",
        "Материал вала и концентрация напряжений",
        MATERIAL,
        scalar_list(
            limit("mat_tensile_MPa", "tensile_mpa"),
            limit("mat_bending_MPa", "bending_limit_mpa"),
            limit("mat_torsion_MPa", "torsion_limit_mpa"),
            f"mat_making = {_picked('mat_making')}",
            factors,
        ),
        note=(
            "Концентрация, чувствительность, размер, поверхность — из исходных данных; значения по "
            "умолчанию — без источника."
        ),
    )


def _journals(throws: int) -> Grid:
    numbers = range(2, throws + 2)
    column = "P4_4.Mmain{k}_Nm"

    def each(text: str) -> list[str]:
        return [text.replace("{t}", column).replace("{k}", str(k)) for k in numbers]

    turn = {
        where: [
            safety_of(f"safe_tau_a{k}_MPa", f"safe_tau_m{k}_MPa", f"safe_k{where}_turn", "torsion")
            for k in numbers
        ]
        for where in "fh"
    }
    rows = (
        ("safe_W{n}_cm3", [modulus("main", k) for k in numbers], "сопротивление материалов"),
        ("safe_tau_max{n}_MPa", each("col_max({t})/safe_W{k}_cm3"), "Гоц, П4.4"),
        ("safe_tau_min{n}_MPa", each("col_min({t})/safe_W{k}_cm3"), "Гоц, П4.4"),
        ("safe_tau_a{n}_MPa", each("(safe_tau_max{k}_MPa - safe_tau_min{k}_MPa)/2"), "амплитуда"),
        ("safe_tau_m{n}_MPa", each("(safe_tau_max{k}_MPa + safe_tau_min{k}_MPa)/2"), "среднее"),
        ("safe_fillet{n}", turn["f"], SK),
        ("safe_hole{n}", turn["h"], SK),
        ("safe_n{n}", each("min(safe_fillet{k}, safe_hole{k})"), "наименьший из двух"),
        ("safe_rank{n}", each("round(0 - safe_n{k}, 6)"), "округлено до шести знаков"),
    )
    return Grid(
        "safe_main",
        "Кручение коренных шеек набегающими моментами",
        SHEET,
        tuple(f"шейка {k}" for k in numbers),
        tuple(grid_row(key.format(n=2), texts, source, key, first=2)
              for key, texts, source in rows),
    )  # fmt: skip


def _list(scope: Scope) -> ScalarTable:
    def weakest(row: str) -> str:
        return f"element(safe_pins.safe_pin_{row}1, safe_pin_weakest) | наименее прочная шейка"

    lines = [
        "safe_main_weakest = first_largest(safe_main.safe_rank2) + 1 | наименьший запас",
        "safe_n_main = element(safe_main.safe_n2, safe_main_weakest - 1) | наименее прочная шейка",
        "safe_pin_weakest = first_largest(safe_pins.safe_pin_rank1) | наименьший запас",
        f"safe_n_turn_fillet = {weakest('turn_fillet')}",
        f"safe_n_turn_hole = {weakest('turn_hole')}",
    ]
    if not scope.shape.split:
        lines += _bent()
    lines.append(f"safe_n_pin = {weakest('n')}")
    return ScalarTable(
        "safety",
        "Запасы прочности шеек",
        SHEET,
        scalar_list(*lines),
        note=(
            "Коренные шейки — кручение набегающим моментом (П4.4). Шатунные — изгиб в плоскости "
            "масляного отверстия (у галтели — в плоскости колена) и кручение (П4.5), оба одной и "
            "той же шейки; здесь — шейка с наименьшим запасом, остальные в таблице рядом. Правило "
            "обществ — второе мнение, наименьшее по шейкам."
        ),
    )


def _bent() -> list[str]:
    """The weakest pin's bending; the rule of the societies for the pin that it finds weakest."""
    own = {
        "safe_sigma_a_MPa": "bend_a1_MPa", "safe_sigma_m_MPa": "bend_m1_MPa",
        "safe_crank_a_MPa": "crank_a1_MPa", "safe_crank_m_MPa": "crank_m1_MPa",
        "safe_n_bend_hole": "bend_hole1", "safe_n_bend_fillet": "bend_fillet1",
        "safe_n_hole": "hole1", "safe_n_fillet": "fillet1",
    }  # fmt: skip
    lines = [
        f"{key} = element(safe_pins.safe_pin_{row}, safe_pin_weakest) | наименее прочная шейка"
        for key, row in own.items()
    ]
    return [
        *lines,
        "safe_class_Q = col_min(safe_pins.safe_Q_fillet1) | не меньше 1,15 по правилу",
        "safe_class_Q_hole = col_min(safe_pins.safe_Q_hole1) | не меньше 1,15 по правилу",
    ]
