"""What fits by chance accuses nobody: only what stands in the work itself does."""

from __future__ import annotations

from functools import cache
from typing import Any

from tests.grading.drawn.engine import Engine, base_of
from tests.grading.fill import Formula

M, V1, J, OMEGA = "P4_1.M_Nm", "P3_1.v1_m_s", "P4_1.j_m_s2", "geometry.omega"
# The stroke is 94 mm: the bore of the first student, or of another.
OWN_IS_STROKE, ANOTHERS_IS_STROKE = 94.0, 88.0
FILL = ("geometry", "masses", "P3_1", "P4_1")


@cache
def engine(bore: float, count: int = 4) -> Engine:
    """A class whose first student has this bore, and others the stroke's."""
    ranges = {"geometry.bore_mm": {"values": [94.0, 88.0, 91.0, 92.0]},
              "geometry.rod_length_mm": {"min": 144, "max": 156, "step": 1},
              "regime.speed_rpm": {"min": 4000, "max": 4600, "step": 50}}  # fmt: skip
    for seed in range(5, 40):
        built = Engine(base_of("gots-diesel", ranges), FILL, count=count, seed=seed)
        bores = [book.drawn["geometry.bore_mm"] for book in built.register.books]
        if bores[0] == bore and 94.0 in bores:
            return built
    raise AssertionError(bore)


def line(built: Engine, changes: dict[str, list[Formula]], name: str) -> dict[str, Any]:
    return next(x for x in built.marked(changes)["items"] if x["id"] == name)


def each(built: Engine, node: str, text: str) -> dict[str, list[Formula]]:
    rows = built.rows(node)
    return {node: [text.replace("{r}", str(row)) for row in rows]}


def test_the_stroke_for_the_bore_is_no_other_students_bore():
    built = engine(ANOTHERS_IS_STROKE)
    said = line(built, {"F_piston": ["=PI()*S_stroke^2/4"]}, "geometry.F_piston")
    assert (said["verdict"], said["cause"]) == ("wrong", "ход поршня S вместо диаметра цилиндра")


def test_half_the_bore_for_the_radius_is_no_number_typed_in():
    built = engine(OWN_IS_STROKE)
    text = "=G{r}*10^6*F_piston*geometry_bore_mm/2000"
    said = line(built, each(built, M, text), M)
    assert (said["verdict"], said["points"]) == ("unknown", 0)
    assert "совпало" in said["reason"]
    # The same number in its place is one.
    typed = line(built, each(built, M, "=G{r}*10^6*F_piston*0.047"), M)
    assert typed["verdict"] == "right"  # alike for the class, which may type it in
    typed = line(built, each(built, M, "=G{r}*10^6*PI()*0.094^2/4*r_crank"), M)
    assert typed["verdict"] == "typed" and "вместо ссылки" in typed["reason"]


def test_one_variant_that_explains_all_is_named_before_single_parameters():
    built = engine(ANOTHERS_IS_STROKE, count=12)
    other = built.register.books[5]
    values = built.values(6)
    nodes = ["omega", "L_rod", "lam", "F_piston", "V_h", "v_max", V1, J, "P4_1.Ps_MPa", M]
    result = built.marked({node: values[node] for node in nodes})
    wrong = [x for x in result["items"] if x["verdict"] == "wrong"]
    assert len(wrong) >= 8
    for said in wrong:
        assert f"из варианта {other.number}," in said["cause"], (said["id"], said["cause"])


def test_a_value_that_several_have_names_none_of_them():
    built = engine(ANOTHERS_IS_STROKE, count=12)
    bores = [book.drawn["geometry.bore_mm"] for book in built.register.books]
    bore = next(b for b in bores if bores.count(b) > 1 and b not in (bores[0], 94.0))
    said = line(built, {"F_piston": [f"=PI()*({bore}/1000)^2/4"]}, "geometry.F_piston")
    assert "не из вашего варианта" in said["cause"]


def test_twice_two_is_no_square():
    """The ratio of this pump is 2: its square and its double are one number."""
    book = (
        "section pump: Насос\n"
        "input pump.ratio: Передаточное отношение | i | | 1…4 | 2\n"
        "quantity pump_speed: частота вращения насоса | n_{\\mathrm{н}} | мин⁻¹ | 1\n"
        "place after 700\n"
        "sheet Насос in Расчёты кафедры 1: Насос\n"
        "list pump: Насос\n"
        "pump_speed = pump_ratio*regime_speed_rpm/10 | передача\n"
    )
    ranges = {"regime.speed_rpm": {"min": 4000, "max": 4600, "step": 50},
              "own.pump.ratio": {"values": [2, 3]}}  # fmt: skip
    for seed in range(5, 40):
        base = base_of("gots-diesel", ranges, own={"pump": {"ratio": 2}},
                       report={"books": ["вентилятор.book"]})  # fmt: skip
        built = Engine(base, ("pump",), book=book, seed=seed)
        if built.register.books[0].drawn["own.pump.ratio"] == 2:
            break
    doubled = line(built, {"pump_speed": ["=2*pump_ratio*regime_speed_rpm/10"]}, "pump.pump_speed")
    squared = line(built, {"pump_speed": ["=pump_ratio^2*regime_speed_rpm/10"]}, "pump.pump_speed")
    assert "в квадрате" in squared["cause"]
    assert doubled["cause"] == "результат вдвое больше правильного"


def test_numbers_in_the_guise_of_formulas_are_told_in_one_line():
    built = engine(ANOTHERS_IS_STROKE)
    values, nodes = built.values(1), [V1, J, M, "P3_1.s1_mm", "P4_1.N_MPa"]
    texts = ["=IF(TRUE,{v},0)", "=IFERROR({v}+0*SIN(A6),0)"]
    changes = {
        node: [texts[at % 2].replace("{v}", repr(v)) for v in values[node]]
        for at, node in enumerate(nodes)
    }
    result = built.marked(changes)
    assert "число под видом формулы, столбцов: 5" in result["manual"]
    few = built.marked({V1: changes[V1]})
    assert few["manual"] == []


def test_a_wrong_number_in_the_place_of_a_reference_is_named():
    built = engine(ANOTHERS_IS_STROKE)
    own = str(built.right["P4_1.Pg_MPa"][0])
    assert "gas_ambient_pressure_mpa" in own
    texts = [
        str(f).replace("gas_ambient_pressure_mpa", "0.115") for f in built.right["P4_1.Pg_MPa"]
    ]
    said = line(built, {"P4_1.Pg_MPa": list(texts)}, "P4_1.Pg_MPa")
    assert "вписано число 0,115, а у вас 0,1" in said["cause"]
