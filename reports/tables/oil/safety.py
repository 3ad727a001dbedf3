"""Safety of main journals and crankpins by the textbook's loads, Serensen and Kinasoshvili."""

from __future__ import annotations

from reports.inputs.sections.bearings import MATERIALS, BearingsSection
from reports.spec.blocks import Block, Grid, ScalarTable
from reports.spec.listing import grid_row, scalar_list
from reports.spec.parts import Part, Scope

MATERIAL, SHEET = "Материал вала", "Прочность шеек"
SK, IACS = "Серенсен, Кинасошвили", "IACS UR M53, по памяти"
_PARTS = ("tensile", "yield", "bending", "torsion")


def safety(scope: Scope) -> Part:
    """Sheets of the material and of the safety."""
    section = scope.input.bearings
    if section is None:
        return Part()
    throws = scope.shape.throws
    blocks: list[Block] = [
        _list(scope),
        _journals(throws),
        _pins(throws),
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
    fillet = "0.06*pin_diameter_1_mm | оценка: 0,06d, без источника"
    if section.fillet_mm is not None:
        fillet = "bearings_fillet_mm | задано"
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
            f"safe_fillet_mm = {fillet}",
        ),
        note=(
            "Концентрация, чувствительность, размер, поверхность — из исходных данных; значения по "
            "умолчанию — без источника."
        ),
    )


def _safety(amplitude: str, mean: str, factor: str, way: str) -> str:
    limit = f"mat_{way}_MPa"
    return f"{limit}/({factor}*{amplitude} + bearings_mean_{way}*abs({mean}))"


def _modulus(part: str, number: int) -> str:
    d, hole = f"{part}_diameter_{number}_mm", f"bearings_{part}_bore_mm"
    return f"pi/16*{d}**3*(1 - ({hole}/{d})**4)/1000"


def _journals(throws: int) -> Grid:
    numbers = range(2, throws + 2)
    column = "P4_4.Mmain{k}_Nm"

    def each(text: str) -> list[str]:
        return [text.replace("{t}", column).replace("{k}", str(k)) for k in numbers]

    turn = {
        where: [
            _safety(f"safe_tau_a{k}_MPa", f"safe_tau_m{k}_MPa", f"safe_k{where}_turn", "torsion")
            for k in numbers
        ]
        for where in "fh"
    }
    rows = (
        ("safe_W{n}_cm3", [_modulus("main", k) for k in numbers], "сопротивление материалов"),
        ("safe_tau_max{n}_MPa", each("col_max({t})/safe_W{k}_cm3"), "Гоц, П4.4"),
        ("safe_tau_min{n}_MPa", each("col_min({t})/safe_W{k}_cm3"), "Гоц, П4.4"),
        ("safe_tau_a{n}_MPa", each("(safe_tau_max{k}_MPa - safe_tau_min{k}_MPa)/2"), "амплитуда"),
        ("safe_tau_m{n}_MPa", each("(safe_tau_max{k}_MPa + safe_tau_min{k}_MPa)/2"), "среднее"),
        ("safe_fillet{n}", turn["f"], SK),
        ("safe_hole{n}", turn["h"], SK),
    )
    return Grid(
        "safe_main",
        "Кручение коренных шеек набегающими моментами",
        SHEET,
        tuple(f"шейка {k}" for k in numbers),
        tuple(grid_row(key.format(n=2), texts, source, key, first=2)
              for key, texts, source in rows),
    )  # fmt: skip


def _pins(throws: int) -> Grid:
    numbers = range(1, throws + 1)
    sums = {
        sign: [f"(col_max({t}) {sign} col_min({t}))/2/safe_pin_W{k}_cm3" for k in numbers
               for t in (f"P4_5.Mpin{k}_Nm",)]
        for sign in "+-"
    }  # fmt: skip
    turn = {
        where: [
            _safety(f"safe_pin_a{k}_MPa", f"safe_pin_m{k}_MPa", f"safe_k{where}_turn", "torsion")
            for k in numbers
        ]
        for where in "fh"
    }
    rows = (
        ("safe_pin_W{n}_cm3", [_modulus("pin", k) for k in numbers], "сопротивление материалов"),
        ("safe_pin_a{n}_MPa", sums["-"], "Гоц, П4.5"),
        ("safe_pin_m{n}_MPa", sums["+"], "Гоц, П4.5"),
        ("safe_pin_fillet{n}", turn["f"], SK),
        ("safe_pin_hole{n}", turn["h"], SK),
    )
    return Grid(
        "safe_pins",
        "Кручение шатунных шеек набегающими моментами",
        SHEET,
        tuple(f"шейка {k}" for k in numbers),
        tuple(grid_row(key.format(n=1), texts, source, key) for key, texts, source in rows),
    )


def _list(scope: Scope) -> ScalarTable:
    throws = scope.shape.throws
    at = "worst_main_torque - 1"
    fillet, hole = (
        f"min({', '.join(f'safe_pin_{where}{k}' for k in range(1, throws + 1))})"
        for where in ("fillet", "hole")
    )
    lines = [
        f"safe_n_main = min(element(safe_main.safe_fillet2, {at}),"
        f" element(safe_main.safe_hole2, {at})) | наименьший из двух",
        f"safe_n_turn_fillet = {fillet} | наименьший по шейкам",
        f"safe_n_turn_hole = {hole} | наименьший по шейкам",
    ]
    if scope.shape.split:
        lines.append("safe_n_pin = min(safe_n_turn_fillet, safe_n_turn_hole) | наименьший")
    else:
        lines += _bent(throws)
    return ScalarTable(
        "safety",
        "Запасы прочности шеек",
        SHEET,
        scalar_list(*lines),
        note=(
            "Коренная шейка — кручение набегающим моментом с наибольшим размахом (П4.4). Шатунная "
            "— изгиб первой шейки в плоскости масляного отверстия (у галтели — в плоскости колена) "
            "и кручение самой нагруженной шейки (П4.5). Правило обществ — второе мнение."
        ),
    )


def _bent(throws: int) -> list[str]:
    half = "(safe_pin_W1_cm3/2)"
    lever = "of_MPa(1)*F_piston*of_mm(throw1_length)/4/2"
    turned = f"max({', '.join(f'safe_pin_a{k}_MPa' for k in range(1, throws + 1))})"
    scale = "bearings_size_factor*bearings_surface_factor"

    def equal(part: str, bend: str) -> str:
        return (
            f"{scale}*sqrt((safe_k{part}_bend*{bend})**2 + 3*(safe_k{part}_turn*{turned})**2)"
            f" | {IACS}"
        )

    def strength(radius: str) -> str:
        return (
            "mat_making*(0.42*mat_tensile_MPa + 39.3)*(0.264 + 1.073*pin_diameter_1_mm**(0-0.2)"
            f" + (785 - mat_tensile_MPa)/4900 + 196/mat_tensile_MPa*sqrt(1/{radius})) | {IACS}"
        )

    top, low = "col_max(pin_bending.plane1_MPa)", "col_min(pin_bending.plane1_MPa)"
    joined = "1/sqrt(1/safe_n_bend_{w}**2 + 1/safe_n_turn_{w}**2) | " + SK
    return [
        f"safe_sigma_a_MPa = Malpha_swing/{half} | Гоц, 2.6",
        f"safe_sigma_m_MPa = Malpha_mean/{half} | Гоц, 2.6",
        f"safe_crank_a_MPa = ({top} - {low})*{lever}/{half} | Гоц, 2.6",
        f"safe_crank_m_MPa = ({top} + {low})*{lever}/{half} | Гоц, 2.6",
        "safe_n_bend_hole = "
        + _safety("safe_sigma_a_MPa", "safe_sigma_m_MPa", "safe_kh_bend", "bending") + f" | {SK}",
        "safe_n_bend_fillet = "
        + _safety("safe_crank_a_MPa", "safe_crank_m_MPa", "safe_kf_bend", "bending") + f" | {SK}",
        "safe_n_hole = " + joined.format(w="hole"),
        "safe_n_fillet = " + joined.format(w="fillet"),
        "safe_n_pin = min(safe_n_hole, safe_n_fillet) | наименьший из двух",
        f"safe_class_MPa = {strength('safe_fillet_mm')}",
        f"safe_class_hole_MPa = {strength('(bearings_hole_mm/2)')}",
        f"safe_equal_MPa = {equal('f', 'safe_crank_a_MPa')}",
        f"safe_equal_hole_MPa = {equal('h', 'safe_sigma_a_MPa')}",
        "safe_class_Q = safe_class_MPa/safe_equal_MPa | не меньше 1,15 по правилу",
        "safe_class_Q_hole = safe_class_hole_MPa/safe_equal_hole_MPa | не меньше 1,15 по правилу",
    ]  # fmt: skip
