"""What a supervisor marks in the chapters: numbers against sentences, symbols, limits."""

import itertools
import math
import re

import numpy as np
import pytest

from reports.document.chapters.chapter import after_noun
from reports.document.text.texts import limits
from reports.formula.tex import to_tex
from reports.inputs.load import load_mapping
from reports.inputs.solve_input import refined, solved
from reports.new.generate import generate_engine
from reports.shared.russian import uncapital
from tests.conftest import sample
from tests.document.bare_pages import bare_page, formulas_of, plain
from tests.document.test_report_sentences import engine, page_of, printed_rows, text_of, words_of

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


def end_of(text):
    """The conclusion."""
    return text[text.index("Рассчитаны кинематика") :]


# --- usual limits ---


@pytest.mark.parametrize(
    ("usual", "shown"),
    [("0…2,2", "до 2,2"), ("0…40 МПа", "до 40 МПа"), ("-5…10", "−5…10"), ("1…1", "1"),
     ("0,1…0,4", "0,1…0,4")],
)  # fmt: skip
def test_limits_from_zero_have_an_upper_end_alone(usual, shown):
    assert limits(usual) == shown


def test_the_conclusion_tells_what_of_the_cycle_lies_outside():
    """ΔT and ξ_b of the turbocharged diesel: «в обычных пределах» would not be true."""
    page = page_of("cycle-turbo-diesel", "course")
    rows = printed_rows(page, "Результаты и обычные пределы")
    outside = [row[0] for row in rows if row[3] != "в пределах"]
    end = end_of(plain(page))
    assert outside and "подогрев свежего заряда ΔT 11,00 К (обычно −5…10)" in end
    assert "лежат в обычных пределах" not in end
    inside = words_of("cycle-tractor-diesel", "course")
    assert ("принятые данные и результаты расчёта цикла лежат в обычных пределах" in inside) == (
        "вне обычных пределов: " not in end_of(inside)
    )


@pytest.mark.parametrize("name", ["cycle-turbo-diesel", "cycle-petrol"])
def test_a_quantity_has_one_usual_span(name):
    """p_z and η_м stood beside two spans: of the data and of the cycle."""
    page = page_of(name, "course")
    data = {row[1]: row[3] for row in printed_rows(page, "Принятые данные и обычные пределы")}
    cycle = {row[0]: row[2] for row in printed_rows(page, "Результаты и обычные пределы")}
    for symbol, words in (("pz", "Максимальное давление"), ("ηм", "Механический КПД")):
        assert data[symbol] == next(span for title, span in cycle.items() if words in title)


@pytest.mark.parametrize(
    ("name", "known"), [("Дизель 4Ч", True), ("Двигатель с искровым зажиганием", True),
                        ("Двигатель", False)],
)  # fmt: skip
def test_spans_of_two_kinds_of_engine_are_not_called_those_of_this_kind(name, known):
    text = text_of(engine(engine__name=name, report__detail="course"))
    assert ("с обычными для двигателей этого вида" in text) == known
    assert ("двигателей с искровым зажиганием и дизелей" in text) == (not known)


def test_limits_of_a_throw_with_one_rod_are_called_so():
    said = "Пределы относятся к колену с одним шатуном"
    assert said in words_of("yamz-236")
    assert said not in text_of(engine(crankshaft__pin_mass_kg=0.1, report__detail="short"))


# --- the working cycle ---


def test_passes_that_changed_nothing_are_not_printed():
    for which in ("сжатия", "расширения"):
        caption = f"Последовательные приближения показателя политропы {which}"
        rows = printed_rows(page_of("cycle-turbo-diesel", "course"), caption)
        alike = [one[1:] == other[1:] for one, other in itertools.pairwise(rows)]
        assert not any(alike[:-1]) and alike[-1]


@pytest.mark.parametrize("name", ["cycle-turbo-diesel", "cycle-petrol", "cycle-tractor-diesel"])
def test_the_temperature_of_residual_gases_is_above_or_below(name):
    text = words_of(name, "course")
    rows = printed_rows(page_of(name, "course"), "Проверки расчёта")
    gap = next(row[1] for row in rows if row[0].startswith("Температура Tr"))
    assert f"она {'ниже' if gap.startswith('−') else 'выше'} принятой на" in text
    assert not re.search(r"отличается от принятой|принятой на −", text)


@pytest.mark.parametrize(
    "words",
    ["по правилу Ньютона", "начало видимого расширения", "Остаток включает", "Проход"],
)
def test_words_that_no_engineer_writes_of_a_cycle(words):
    for name in ("cycle-turbo-diesel", "cycle-petrol"):
        assert words not in words_of(name, "course")


@pytest.mark.parametrize("given", [True, False])
def test_constants_of_the_turbocharger_are_told(given):
    """Of those that the input gives the table of the data tells."""
    more = {"cycle__exhaust_heat_kj_kg_k": 1.16, "cycle__turbine_outlet_ratio": 1.05}
    model = engine(source="cycle-turbo-diesel", report__detail="course", **(more if given else {}))
    text = text_of(model)
    assert ("1,005 и 1,15 — теплоёмкости воздуха и газов" in text) == (not given)
    assert ("1,005 — теплоёмкость воздуха" in text) == given
    assert ("принято близким к атмосферному" in text) == (not given)
    assert "Здесь 1,005" not in words_of("cycle-petrol", "course")


# --- torsion, film and safety of the shaft ---


def number(text):
    return float(text.replace("{,}", ".").replace(",", ".").replace("−", "-").replace("\xa0", ""))


def test_the_amplitude_of_a_resonance_follows_from_its_substitution():
    """In radians by the formula, in degrees in print: the factor is written."""
    page = page_of("mwm-6", "course")
    tex = next(each for each in formulas_of(page) if each.startswith("A_{1} = "))
    tex = tex.replace(r"\,", "")
    match = re.fullmatch(r"A_\{1\} = \\dfrac\{(\S+) \\cdot (\S+)\}\{(\S+)\} \\cdot \\dfrac\{180\}\{"
                         r"\\pi\} = ([\d{},]+)\^\{\\circ\}", tex)  # fmt: skip
    assert match, tex
    moment, phases, loss, shown = map(number, match.groups())
    assert shown == pytest.approx(math.degrees(moment * phases / loss), rel=2e-4)


def test_symbols_of_the_train_and_its_stress_are_told():
    text = text_of(engine(report__detail="course", torsion__stress_allowed_mpa=30.0))
    for symbol in ("Jk — момент инерции", "ck — жёсткость", "Wp — полярный", "bk — сопротивл",
                   "Mν — амплитуда момента"):  # fmt: skip
        assert symbol in text, symbol
    assert "ωГ2" not in text and re.search(r"τ1,1 = [\d,]+ МПа", text)


def test_masses_about_a_node_have_names():
    text = words_of("mwm-6", "course")
    train = printed_rows(page_of("mwm-6", "course"), "Собственные частоты и формы")
    names = [row[0].replace("\xa0", " ") for row in train]
    matches = re.findall(r"между массами (.*?)\. ", text)
    named = re.findall(r"(\d+) и \d+ \(([^)]*?) и ([^)]*?)\)", " ".join(matches))
    assert named
    for k, first, second in named:
        assert (first, second) == (uncapital(names[int(k) - 1]), uncapital(names[int(k)]))


def test_safety_by_bending_follows_from_the_printed_stresses():
    """A mean below zero counts by its size; stresses of both planes are printed."""
    page = page_of("d-240-bearings", "course")
    text, data = plain(page), printed_rows(page, "Исходные данные для расчёта")
    given = {row[1]: number(row[2]) for row in data if re.fullmatch(r"−?[\d,]+", row[2])}
    rows = {re.split(r",| —", row[0].replace("\xa0", " "))[0]: row[1:]
            for row in printed_rows(page, "Запасы прочности шатунных шеек")}  # fmt: skip
    limit = number(re.search(r"σ−1 = (\d+) МПа", text)[1])
    assert r"\left" not in text and any(r"|\sigma_m|" in tex for tex in formulas_of(page))
    for swing, mean, shape, safety in (
        ("σa", "σm", "ασо", "nσ о"),
        ("σa к", "σm к", "ασг", "nσ г"),
    ):
        factor = 1 + given["qσ"] * (given[shape] - 1)
        factor /= given["εм"] * given["εпов"]
        for a, m, n in zip(*(map(number, rows[key]) for key in (swing, mean, safety)), strict=True):
            assert n == pytest.approx(limit / (factor * a + given["ψσ"] * abs(m)), abs=0.011)


def test_symbols_of_the_film_are_told():
    text = words_of("d-240-bearings", "course")
    assert (
        "F — нагрузка подшипника" in text
        and "ωцап и ωвкл — угловые скорости шейки и вкладыша" in text
    )


# --- what is given, what follows ---


@pytest.mark.parametrize(
    ("changes", "left"),
    [
        ({}, ["lambda", "S"]),  # the crank's radius and the rod's length are given
        ({"geometry__crank_radius_mm": None, "geometry__stroke_mm": 94.0}, ["r", "lambda"]),
        ({"geometry__rod_length_mm": None, "geometry__lambda": 0.28}, ["L", "S"]),
        ({"geometry__crank_radius_mm": None, "geometry__stroke_mm": 94.0,
          "geometry__rod_length_mm": None, "geometry__lambda": 0.28}, ["r", "L"]),
        ({"geometry__crank_radius_mm": None, "geometry__lambda": 0.28}, ["r", "S"]),
    ],
)  # fmt: skip
def test_a_given_size_does_not_follow_from_itself(changes, left):
    """S = 2r was printed where r is half of the given stroke, λ = r/L where L is r/λ."""
    page = bare_page(engine(report__detail="course", **changes))
    symbols = [tex.partition(" = ")[0] for tex in formulas_of(page)]
    assert symbols[: len(left) + 1] == [*(s.replace("lambda", r"\lambda") for s in left),
                                        r"F_{\mathrm{п}}"]  # fmt: skip


@pytest.mark.parametrize(("layout", "title"), [("offset", "Удвоенный радиус кривошипа"),
                                               ("basic", "Ход поршня")])  # fmt: skip
def test_the_stroke_of_an_offset_engine_is_not_twice_the_radius(layout, title):
    model = engine(layout, geometry__crank_radius_mm=None, geometry__stroke_mm=94.0,
                   report__detail="course")  # fmt: skip
    page = bare_page(model)
    rows = {row[0]: row[1:3] for row in printed_rows(page, "Исходные данные для расчёта")}
    assert rows[title] == ["2r" if layout == "offset" else "S", "94"]
    assert f"{title[0].lower()}{title[1:]} — 94 мм" in plain(page)


def test_the_factor_of_a_volume_is_told_beside_it():
    """It stood after the displacement of the piston, where 10³ is of millimetres."""
    text = text_of(engine("offset"))
    at = text.index("переводит м³ в дм³" if "переводит м³" in text else "переводит м3 в дм3")
    assert (
        at < text.index("Угловая скорость вала и средняя скорость поршня") < text.index("При φ =")
    )


@pytest.mark.parametrize(("layout", "said"), [("split", False), ("v_six", True), ("basic", True)])
def test_forces_of_turned_halves_of_a_pin_are_not_added_as_numbers(layout, said):
    page = bare_page(engine(layout, report__detail="course"))
    formulas = formulas_of(page)
    assert any(tex.startswith("K_r = ") for tex in formulas) == said
    assert ("не складываются арифметически" in plain(page)) == (not said)


@pytest.mark.parametrize(("layout", "words"), [("v_six", "сумма сил вдоль двух шатунов"),
                                               ("basic", "сила вдоль шатуна")])  # fmt: skip
def test_the_vector_of_a_pin_with_two_rods_is_their_sum(layout, words):
    assert f"Вектор от полюса O — {words}, от" in text_of(engine(layout, report__detail="course"))


def test_forces_that_are_zero_stand_in_no_table():
    """Counterweights across the throw and at the ends of the shaft, where there are none."""
    for name in ("gots-diesel", "d-240"):
        page = page_of(name, "course")
        rows = printed_rows(page, "Центробежные силы колен")
        assert all(any(cell.strip("0—") for cell in row[1:]) for row in rows)
        ends = any(re.match(r"C1[0-3],", row[0]) for row in rows)
        assert ("Знаки при C11 и C13" in plain(page)) == ends
        zeros = "C8, C9, C14, C15" if ends else "C8–C15"
        assert f"Равны нулю и в таблице не показаны: {zeros}." in plain(page)


def test_a_force_that_is_printed_as_zero_is_not_put_in_as_a_number():
    """0,097627 Н stood in the reaction of a bearing beside a table that says 0."""
    web = {"mass_kg": 0.245, "counterweight_kg": 1.092001}  # all but the rotating masses
    alone = {"crankshaft__nose_mass_kg": None, "crankshaft__rear_mass_kg": None}
    model = engine(report__detail="course", crankshaft__webs=[web] * 6, **alone)
    page = bare_page(model)
    rows = printed_rows(page, "Пролёты колен и реакции опор от центробежных сил")
    assert all(set(row[1:]) == {"0"} for row in rows[2:])
    shown = [tex for tex in formulas_of(page) if re.match(r"A_\{K\(i[^=]* = [\d(\\]", tex)]
    assert shown and not any("10^{-6}" in tex for tex in shown)


@pytest.mark.parametrize("name", ["d-240-bearings", "mwm-6", "gots-diesel"])
def test_the_aim_names_what_the_chapters_find(name):
    text = words_of(name, "course")
    aim = re.search(r"Цель работы — найти (.*?)\. ", text)[1]
    contents = text[text.index("Содержание ") :][:3000]
    for chapter, words in (("Крутильные колебания", "крутильные колебания вала"),
                           ("Масляная плёнка", "толщину масляной плёнки"),
                           ("Нагрузки на коренные", "нагрузки на шейки")):  # fmt: skip
        assert (words in aim) == (chapter in contents), (words, aim)


def test_the_task_of_a_cycle_names_its_power():
    text = words_of("cycle-turbo-diesel", "course")
    task = text[text.index("3. Исходные данные") : text.index("4. Содержание")]
    assert "заданная эффективная мощность — 70 кВт" in task
    assert "коэффициент избытка воздуха — 1,45" in task


def test_every_abbreviation_is_in_the_list():
    for name in ("gots-diesel", "d-240"):
        text = words_of(name, "course")
        assert text.count("КШМ") > 1 and "КШМ — кривошипно-шатунный механизм" in text


@pytest.mark.parametrize(
    ("layout", "words"),
    [("basic", "Рабочая длина шатунной шейки"), ("v_six", "Рабочая длина всей шатунной шейки")],
)
def test_the_length_of_a_pin_under_one_rod_is_not_called_whole(layout, words):
    assert words in text_of(engine(layout, report__detail="course"))


# --- balance and flywheel ---


@pytest.mark.parametrize("balanced", [False, True])
def test_before_and_after_are_of_an_engine_that_something_balances(balanced):
    more = {"balance__first_shafts_share": 1.0} if balanced else {}
    text = text_of(engine(report__detail="course", **more))
    assert ("до уравновешивания" in text) == balanced
    assert ("На колена добавлены противовесы для доли" in text) == balanced
    end = end_of(text)
    said = re.search(r"; ([^;]*) вектор момента 1-го порядка достигает ([\d ,]+) Н·м", end)
    assert said
    assert said[1] == ("после уравновешивания" if balanced else "с вращающимися массами")
    number = said[2].replace(" ", "\xa0")
    assert text.replace(" ", "\xa0").count(number) > 1


def test_the_conclusion_tells_no_vector_that_is_nothing():
    assert "вектор силы 1-го порядка достигает" not in text_of(engine())


@pytest.mark.parametrize(("inertia", "words"), [(0.9, "не меньше"), (0.01, "меньше"), (None, "")])
def test_the_flywheel_of_the_train_is_held_against_the_required_one(inertia, words):
    given = {"torsion__stress_allowed_mpa": 30.0, "torsion__flywheel_kg_m2": inertia}
    model = engine(report__detail="course", **{k: v for k, v in given.items() if v is not None})
    text = text_of(model)
    assert ("Маховик, принятый для крутильной схемы" in text) == bool(words)
    match = re.search(r"— (не меньше|меньше) требуемого\.", text)
    assert (match[1] if match else "") == words
    assert ("требуемого" in end_of(text)) == bool(words)


def test_the_approximate_inertia_is_told_where_it_is_shown():
    for detail in ("course", "full"):
        shown = detail == "full"
        assert (
            "приближённая формула, обычная для оценок" in words_of("gots-diesel", detail)
        ) == shown
        assert ("погрешность приближённой формулы" in words_of("gots-diesel", detail)) == shown


@pytest.mark.parametrize("name", ["yamz-238", "gots-diesel"])
def test_the_pressure_of_a_bearing_is_off_as_its_own_load_is(name):
    end = end_of(words_of(name, "course"))
    coarse, fine = (solved(each).scalars for each in (sample(name), refined(sample(name))))
    bearing = "подшипник каждого шатуна" if name == "yamz-238" else "шатунный подшипник"
    pressure, beside = re.search(
        rf"давление на {bearing} ([\d,]+) МПа(?: \(при шаге 1° — ([\d,]+) МПа\))?", end
    ).groups()  # fmt: skip
    assert number(pressure) == pytest.approx(coarse["q_pin_max"], abs=0.006)
    assert (beside is None) == (coarse["B_max"] / fine["B_max"] > 0.98)
    if beside:
        assert number(beside) == pytest.approx(fine["q_pin_max"], abs=0.006)


def test_torsion_of_crankpins_is_by_statics():
    """Of a split pin the rule of half a torque is far off; safety is found as the ranges are."""
    model = engine("split", report__detail="course", bearings__safety_allowed=2.0)
    table = printed_rows(bare_page(model), "Запасы прочности шатунных шеек")
    rows = {row[0].partition(",")[0]: row[1:] for row in table}
    solution = solved(model)
    for pin, shown in enumerate(rows["τaш"], 1):
        swing = np.ptp(solution.columns["P4_5s"][f"Mpins{pin}_Nm"]) / 2
        modulus = np.pi / 16 * (model.crankshaft.pin_diameter_mm / 10) ** 3
        assert number(shown) == pytest.approx(swing / modulus, abs=0.006)


# --- strength of the parts and names of the data ---


@pytest.fixture(scope="module")
def with_all_sizes():
    """A new V8 of petrol whose every size of a part is given."""
    data = generate_engine(8, layout="v", kind="petrol", strength=True).data
    return load_mapping(data | {"report": {"detail": "course"}}, source="t.toml").model


def test_sizes_that_are_given_stand_in_one_table(with_all_sizes):
    page = bare_page(with_all_sizes)
    assert printed_rows(page, "Размеры частей</div>") is None and "Размеры частей</div>" not in page
    assert "Размеры частей даны в таблице 1." in plain(page).replace("\u00a0", " ")
    usual = bare_page(engine(report__detail="course", strength__kind="diesel"))
    assert printed_rows(usual, "Размеры частей")


def test_stresses_are_named_as_quantities(with_all_sizes):
    """«Больше обычных пределов: днище поршня» is no sentence."""
    page = bare_page(with_all_sizes)
    rows = printed_rows(page, "Напряжения и обычные пределы")
    nouns = ("Напряжение", "Давление", "Овализация")
    assert rows and all(row[0].startswith(nouns) for row in rows)
    outside = [row[0] for row in rows if row[3] != "в пределах" and "…" in row[2]]
    end = end_of(plain(page))
    said = re.search(r"больше обычных пределов: ([^;.]*)", end)
    assert not said or all(part[:1].islower() for part in re.split(", | и ", said[1]) if outside)


def test_a_leading_minus_stands_without_brackets(with_all_sizes):
    """(−m ω²) r (1 + λ) was printed for −m ω² r (1 + λ)."""
    formulas = formulas_of(bare_page(with_all_sizes))
    assert to_tex("-m*w**2*r", str).startswith("-m")
    assert not any(re.search(r"= \\left\(-", tex) for tex in formulas)


def test_materials_have_their_noun(with_all_sizes):
    table = printed_rows(bare_page(with_all_sizes), "Исходные данные для расчёта")
    rows = {row[0]: row[2].replace("\xa0", " ") for row in table}
    assert rows["Материал поршня"] == "алюминиевый сплав" and rows["Материал щёк"] == "сталь 45"
    data = printed_rows(page_of("d-240-bearings", "course"), "Исходные данные для расчёта")
    assert ["Материал вала", "сталь\xa045"] in [[row[0], row[2]] for row in data]


def test_ratios_are_called_ratios(with_all_sizes):
    """«Ширина щеки к диаметру цилиндра» is no name of a quantity."""
    page = bare_page(with_all_sizes)
    named = [*printed_rows(page, "Исходные данные для расчёта"),
             *printed_rows(page, "Принятые данные и обычные пределы")]  # fmt: skip
    of = [
        row[0] for row in named if re.search(r" (к|на) (диаметру|площадь|частоте|моменту)", row[0])
    ]
    assert of and all(title.startswith("Отношение ") for title in of)


@pytest.mark.parametrize(("layout", "detail", "told"), [("four", "full", True),
                                                        ("four", "course", False),
                                                        ("offset", "full", False)])  # fmt: skip
def test_the_table_of_the_step_holds_what_the_note_tells(layout, detail, told):
    """Unevenness by the law of energy stood in the table of an engine without that chapter."""
    model = engine(layout, calculation__step_deg=30.0, report__detail=detail)
    coarse, fine = (solved(each).scalars["delta_speed"] for each in (model, refined(model)))
    assert abs(coarse / fine - 1) > 0.02
    rows = printed_rows(bare_page(model), "Результаты, для которых шаг таблиц велик")
    assert any("неравномерности хода по закону" in row[0] for row in rows) == told


@pytest.mark.parametrize(("kind", "noun"), [("diesel", "Дизель"), ("petrol", "Двигатель")])
def test_the_name_of_a_new_engine_can_be_declined(kind, noun):
    """«Двигателя (рядного, четырёхтактного, цилиндров 3)» is no Russian."""
    name = generate_engine(3, kind=kind).data["engine"]["name"]
    assert name.startswith(noun) and "трёхцилиндровый" in name
    assert "четырёхтактного, трёхцилиндрового)" in after_noun(name)
    assert "четырёхтактный, трёхцилиндровый)" in after_noun(name, genitive=False)


# --- formulas ---


def test_sizes_that_no_throw_has_stand_in_no_column():
    """Arms l_3 and l_4 of a second rod, webs without a thickness."""
    columns = {name: len(printed_rows(page_of(name, "course"), "Размеры колен, мм")[0])
               for name in ("gots-diesel", "d-240", "yamz-236")}  # fmt: skip
    assert columns == {"gots-diesel": 5, "d-240": 7, "yamz-236": 9}


def test_the_stroke_of_a_designed_engine_follows_from_the_accepted_one():
    """S of the formulas is that of S_пр: r is half of it and S is 2r."""
    heads = [tex.partition(" = ") for tex in formulas_of(page_of("cycle-turbo-diesel", "course"))]
    sizes = {head: rest for head, _, rest in heads if head in ("r", "L", "S", r"\lambda")}
    assert list(sizes) == ["r", "L", "S"] and r"S_{\mathrm{пр}}" in sizes["r"]


@pytest.mark.parametrize("pumping", ["no", "yes"])
def test_a_row_of_the_powers_follows_from_the_one_it_names(pumping):
    """«То же с коэффициентом полноты» stood below the dynamic calculation, which it is not of."""
    model = engine(source="cycle-turbo-diesel", report__detail="course", cycle__pumping=pumping)
    rows = printed_rows(bare_page(model), "Мощности расчёта цикла и динамического расчёта")
    pressures = [number(row[1].partition("=")[2].strip()) for row in rows if "=" in row[1]]
    first, indicated, effective = pressures[0], *pressures[-2:]
    named = rows[-2][0].replace("\xa0", " ")
    assert named.startswith("Первая диаграмма с коэффициентом полноты")
    assert ("за вычетом насосных потерь" in named) == (pumping == "yes")
    if pumping == "no":
        assert indicated == pytest.approx(
            first * number(named.rpartition("=")[2].strip()), abs=2e-4
        )
    factor = number(rows[-1][0].rpartition("=")[2].strip())
    assert effective == pytest.approx(indicated * factor, abs=2e-4)


def test_the_alternative_text_tells_the_first_of_equal_extremes():
    """The torque of three cylinders is least at 30, 270 and 510°: the text says 30."""
    page = page_of("cycle-turbo-diesel", "course")
    angle = re.search(r"наименьший [^.]*? — при φ = (\d+)°", plain(page))[1]
    spoken = next(
        each for each in re.findall(r"Индикаторный крутящий момент двигателя\. [^<\"]*", page)
    )
    assert re.search(r"наименьшее.*?=\s(\d+)°", spoken)[1] == angle


def test_numbers_of_the_tables_in_brackets_are_explained():
    said = "в скобках после названий таблиц приложений — номера таблиц пособия"
    for detail in ("short", "course"):
        text = words_of("gots-diesel", detail)
        assert (said in text) == ("(П3.1)" in text)


@pytest.mark.parametrize(("layout", "what"), [
    ("v_six", "составляющие моментов вдоль оси первого цилиндра"), ("basic", "моменты"),
])  # fmt: skip
def test_curves_of_free_moments_are_called_components_where_they_are(layout, what):
    """Of two banks the vector's greatest size stands in the table, its projection in the figure."""
    assert f"За оборот {what} изменяются по рисунку" in text_of(engine(layout))
