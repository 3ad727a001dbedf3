"""What a supervisor of a department struck out in nine notes, held by the kind of fault.

Sentences stand in one table: a report that has to say it and one that must not.
"""

import copy
import math
import re
from functools import lru_cache

import pytest

from kshm.nomenclature.quantity import quantity
from reports.document.chapters.closing import difference
from reports.document.text.terms import Terms
from reports.formula.tex import to_tex, to_tex_numbers
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.reasons import REASONS
from reports.inputs.solve_input import solved
from reports.model.evaluation import evaluate_model
from reports.new.generate import generate_engine
from reports.shared.russian import cylindered
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.document.bare_pages import bare_page
from tests.document.test_report_sentences import engine, page_of, plain, text_of

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


def words_of(source, detail="course"):
    return plain(page_of(source, detail))


@pytest.mark.parametrize(
    ("words", "said", "unsaid"),
    [
        ("Механизм центральный: ось цилиндра пересекает ось вала", "gots-diesel", "ecoboost-10"),
        ("В мёртвых точках кривошип и шатун лежат на одной прямой", "ecoboost-10", "gots-diesel"),
        ("в скобках после названий таблиц приложений — номера таблиц пособия", "gots-diesel", None),
        ("ось y направлена вдоль первого колена от оси вала", "gots-diesel", None),
        # Of an engine without counterweights on the ends nothing is told of them.
        ("Знаки при C11 и C13 взяты по статике", "gots-diesel", "d-240"),
        ("плечо противовеса на носке, мм", "gots-diesel", "d-240"),
        # Crankcase scavenging: no oil under pressure, no hole to be drilled.
        ("наименее изнашиваемое место шатунной шейки лежит под углом", "two-stroke", "d-240"),
        ("при смазке под давлением там располагают отверстие", "two-stroke", "d-240"),
        ("следует сверлить под углом", "gots-diesel", "two-stroke"),
        ("угол начала сгорания φc = 357,0° задан (по углу опережения", "gots-diesel", "d-240"),
        ("Массы шатуна и поршневой группы не заданы", "gots-diesel", "vw-1600"),
        ("Наибольшие нагрузки на шейки 2 и 4 одинаковы, здесь и ниже выбрана шейка 2",
         "d-240", "gots-diesel"),
        ("Здесь и ниже выбрана наиболее нагруженная шейка", "gots-diesel", "d-240"),
        ("где αцi — амплитуда колена, на котором стоит цилиндр i", "mwm-6", "gots-diesel"),
        ("наибольшее напряжение вала при амплитуде первой массы 1°", "mwm-6", "gots-diesel"),
        ("м³ в дм³. Угловая скорость вала", "ecoboost-10", None),
        ("Двигатель одноцилиндровый, двухтактный.", "two-stroke", "gots-diesel"),
        ("рядный, четырёхтактный, трёхцилиндровый, вал с тремя коленами; порядок", "gots-diesel",
         "two-stroke"),
        ("Давление под поршнем", "two-stroke", "gots-diesel"),
        ("Давление окружающей среды", "gots-diesel", "two-stroke"),
        ("МПа в ВМТ после скачка", "gots-diesel", "mwm-6"),
        ("эффективная мощность", "gots-diesel", None),
        # The second journal of one throw had the table of the first again.
        ("Удельные силы, одинаковые у коренных шеек 1 и 2 (П4.3.1, П4.3.2)", "two-stroke",
         "gots-diesel"),
        ("Удельные силы, действующие на коренную шейку 2 (П4.3.2)", "gots-diesel", "two-stroke"),
    ],
)  # fmt: skip
def test_a_sentence_stands_where_it_holds(words, said, unsaid):
    assert words in words_of(said)
    assert unsaid is None or words not in words_of(unsaid)


STRUCK = (
    "в единицах СИ",  # MPa and mm stand in formulas
    "Цилиндр центральный", "вытянуты в одну прямую", "направлена вверх в плоскости",
    "Принятая приближённая формула", "значит, что порядок", "для наименьшего порядка",
    "до уравновешивания",  # nothing is balanced
    "на площадь поршня", "деталь тоньше", "возвратно-движущихся", "оси цилиндра или пальца",
    "суммы умножены",
)  # fmt: skip


@pytest.mark.parametrize(
    "name", ["gots-diesel", "d-240", "ecoboost-10", "mwm-6", "two-stroke", "yamz-238"]
)
def test_what_was_struck_out_stays_out(name):
    assert [words for words in STRUCK if words in words_of(name)] == []


# --- numbers ---


def test_a_projection_has_its_force_and_its_angle(monkeypatch):
    """R'x = −0.215 − (−1.251) + … left the reader to find A_T cos γ himself."""
    known, formulas = Terms.substitution, {}

    def noted(terms, name, *more, **named):
        return formulas.setdefault(name, known(terms, name, *more, **named))

    monkeypatch.setattr(Terms, "substitution", noted)
    bare_page(engine(source="d-240", report__detail="course"))
    _, given, _ = formulas["P4_3_2.Rx_MPa"].split(" = ")
    assert given.count(r"\cos") == given.count(r"\sin") == 2 and r"180^{\circ}" in given


def test_a_term_of_no_part_is_left_out_of_a_formula():
    names = {"a": "a", "b": "b", "c": "c"}.__getitem__
    assert to_tex("a*c - b*(a + c)/a", names, {"b"}) == r"a \, c"
    assert to_tex("a*c - b*(a + c)/a", names).endswith(r"\dfrac{b \left(a + c\right)}{a}")


def test_no_sign_follows_a_sign_and_an_angle_has_its_factor():
    numbers = {"a": 2.0, "b": -3.0, "c": 4.0}.__getitem__
    tex = to_tex_numbers("a + b/c", lambda name: name, numbers)
    assert tex == r"2 + \left(-\dfrac{3}{4}\right)"
    assert to_tex_numbers("deg(a/c)", lambda name: name, numbers).endswith(
        r"\cdot \dfrac{180}{\pi}"
    )
    assert to_tex_numbers("deg(asin(a))", lambda name: name, numbers) == r"\arcsin 2"


_FUNCTIONS = {"sin": math.sin, "cos": math.cos, "tg": math.tan, "sqrt": math.sqrt, "min": min,
              "max": max, "pi": math.pi, "D": math.pi / 180, "abs": abs}  # fmt: skip
_BRACED = {r"\dfrac": "(({})/({}))", r"\sqrt": "sqrt({})"}


_WRITTEN = {"{,}": ".", r"\,[": "*(", r"\,": "", r"\left|": "abs(", r"\right|": ")", r"\left": "",
            r"\right": "", r"\cdot": "*", r"\pi": "pi", "[": "(", "]": ")", ";": ",",
            " ": ""}  # fmt: skip


def _argument(tex, start):
    """The text within the braces that open at ``start`` and the place after them."""
    depth = 0
    for position in range(start, len(tex)):
        depth += {"{": 1, "}": -1}.get(tex[position], 0)
        if depth == 0:
            return tex[start + 1 : position], position + 1
    raise ValueError(tex)


def _python(tex):
    """A formula with numbers as an expression of Python, read from its TeX alone."""
    for command, form in _BRACED.items():
        while command + "{" in tex:
            start = tex.index(command + "{")
            parts, end = [], start + len(command)
            for _ in range(form.count("{}")):
                part, end = _argument(tex, end)
                parts.append(part)
            tex = tex[:start] + form.format(*parts) + tex[end:]
    for old, new in _WRITTEN.items():
        tex = tex.replace(old, new)
    tex = re.sub(r"([\d.]+)\^\{\\circ\}", r"(\1*D)", tex)
    tex = re.sub(r"\\(sin|cos)\^\{2\}(\((?:[^()]|\([^()]*\))*\))", r"(\1\2)**2", tex)
    tex = re.sub(r"\\(arcsin|arccos|tg|sin|cos)(-?[\d.]+)", r"\\\1(\2)", tex)
    tex = re.sub(r"\^\{([^{}]*)\}", r"**(\1)", tex).replace("\\", "")
    return tex.replace(")(", ")*(")


def recomputed(tex):
    """Printed result of a formula, what its printed numbers give, and the last printed place."""
    *_, given, result = tex.split(" = ")
    shown = re.match(r"(-?[\d{},\\]*\d)(?: ?\\cdot 10\^\{(-?\d+)\})?(.*)", result)
    number = shown[1].replace("{,}", ".").replace(r"\,", "")
    turn = math.degrees if shown[3] == r"^{\circ}" else float
    arcs = {"arcsin": lambda x: turn(math.asin(x)), "arccos": lambda x: turn(math.acos(x))}
    power = 10.0 ** int(shown[2] or 0)
    whole, _, decimals = number.lstrip("-").partition(".")
    zeros = len(whole) - len(whole.rstrip("0")) if len(whole) > 4 else 0  # of five digits
    position = 10.0 ** -len(decimals) if decimals else 10.0**zeros
    value = eval(_python(given), {"__builtins__": {}}, _FUNCTIONS | arcs)
    return float(number) * power, value, position * power


_UNREADABLE = r"arctg|mathrm\{mod|\\sum|\\exp|\\ln|\\mathrm\{[а-я]"


@pytest.mark.parametrize(
    ("name", "least"),
    [("gots-diesel", 55), ("two-stroke", 55), ("ecoboost-10", 40), ("mwm-6", 55), ("tiny", 55)],
)
def test_the_numbers_of_a_formula_give_its_result(name, least, monkeypatch):
    """Also where terms cancel: 4 N of a throw that balances itself were 5 N by the numbers."""
    known, formulas = Terms.substitution, []

    def noted(terms, name, *more, **named):
        formulas.append((name, known(terms, name, *more, **named)))
        return formulas[-1][1]

    monkeypatch.setattr(Terms, "substitution", noted)
    bare_page(tiny() if name == "tiny" else engine(source=name, report__detail="course"))
    read = {key: tex for key, tex in formulas
            if not re.search(_UNREADABLE, tex.rsplit(" = ", 2)[-2])}  # fmt: skip
    results = [(tex, *recomputed(tex)) for tex in read.values()]
    wrong = [tex for tex, shown, value, position in results if abs(value - shown) > 0.51 * position]
    assert not wrong
    assert len(read) >= least


def tiny():
    """The engine of a model aeroplane: masses over the piston area as similarity has them."""
    raw = copy.deepcopy(generate_engine(1, strokes=2, bore_mm=14.0, stroke_mm=14.0).data)
    raw["masses"] |= {"piston_group_kg": 0.0075, "rod_kg": 0.006}
    raw["report"] = {"detail": "course"}
    return load_mapping(raw, source="t.toml").model


def test_a_small_bore_is_light_by_similarity():
    text = text_of(tiny())
    assert "у подобных двигателей удельная масса пропорциональна диаметру" in text
    assert "сечения тоньше обычных" not in text
    light = engine(crankshaft__pin_mass_kg=0.1, report__detail="course")
    assert "колено легче обычного" in text_of(light)
    assert "удельная масса пропорциональна" not in text_of(light)


def test_what_follows_from_several_values_is_said_once():
    text = text_of(tiny())
    assert re.search(
        r"Удельная масса поршневой группы [^.]* и удельная масса шатуна [^:]* меньше обычного:",
        text,
    )
    assert text.count("Эти значения в расчёте сохранены") == 1


def test_a_small_area_has_digits():
    """0.000154 m² of a bore of 14 mm had three beside five of the other sizes."""
    model = build_model(tiny())
    assert Terms(model, evaluate_model(model)).num("F_piston") == "0,00015394"


# --- closing ---


def test_a_failed_check_says_what_came_out_and_is_told_once():
    text = words_of("gots-diesel")
    chapter, end = text.split("Рассчитаны кинематика")[-2:]
    assert "сходится с мощностью цикла»: расхождение −46,71 %." in chapter
    assert end.count("46,71") == 1


def test_checks_that_are_not_in_the_report_are_those_of_the_workbook():
    where = "(таблица «Проверки» книги Excel)"
    alone = text_of(engine(report__chapters=["torque"], report__detail="course"))
    assert where in alone and where not in words_of("gots-diesel")


def test_the_conclusion_tells_of_the_continuous_shaft():
    """Its supports 2 and 6 bore 40 % more, and the conclusion told of the other scheme alone."""
    words = re.compile(
        r"неразрезного вала наибольшая реакция — у опор[ы]? ([\d и,]+): ([\d,]+) МПа"
    )
    page = page_of("d-240", "full")
    chapter, end = plain(page).split("Рассчитаны кинематика")[-2:]
    assert words.search(end)[2] == words.search(chapter)[2]
    scalars = solved(engine(source="d-240")).scalars
    most = max(value for key, value in scalars.items() if re.fullmatch(r"Rc\d+_max", key))
    assert words.search(end)[2] == f"{most:.3f}".replace(".", ",")
    assert not words.search(words_of("d-240"))


def test_sources_are_numbered_as_they_are_cited():
    page = page_of("mwm-6", "full")
    body = page[page.index("Введение</h1>") : page.index("Список использованных источников</h1>")]
    links = re.findall(r'<a class="ref" href="#(src[^"]*)">(\d+)</a>', body)
    numbers = list(dict.fromkeys(int(number) for _, number in links))
    assert numbers == sorted(numbers) and len(numbers) > 3


def test_a_difference_from_nothing_has_no_percents():
    """A journal that is free of load for a moment: 0.003 MPa were 790.8 % of 0.000."""
    assert difference(790.8, "0,000") == difference(5e3, "0,012") == "—"
    assert difference(-3.51, "2,115") == "−3,5"


def test_an_offset_tells_of_its_flywheel_and_of_what_is_offset():
    text = words_of("ecoboost-10")
    assert "из-за смещения оси цилиндра" in text or "из-за смещения поршневого пальца" in text
    assert re.search(r"неприменимы\. Маховик для неравномерности хода [\d,]+", text)
    assert "и маховик не рассчитаны" not in text


def test_a_count_of_cylinders_is_a_word():
    assert cylindered(2) == "двухцилиндровый" and cylindered(14) == "14-цилиндровый"


@pytest.mark.parametrize("source", ["one", "two-stroke", "gots-diesel", "vw-1600", "yamz-236"])
def test_no_table_of_an_appendix_repeats_another(source):
    """Of one cylinder the torques stood in the tables of forces, of the sum, of the journals."""
    page = bare_page(load_mapping(generate_engine(1).data, source="").model) if source == "one" \
        else page_of(source, "course")  # fmt: skip
    tables = {}
    for number, body in re.findall(r'num">(Б\.\d+)<.*?<tbody>(.*?)</tbody>', page, re.DOTALL):
        rows = [re.findall(r"<td.*?</td>", row) for row in re.findall(r"<tr.*?</tr>", body)]
        texts = [[re.sub("<[^>]+>|\\s", "", cell) for cell in row] for row in rows]
        tables[number] = set(zip(*texts, strict=True))
    assert len(tables) > 4
    repeats = [(a, b) for a in tables for b in tables if a != b and tables[a] <= tables[b]]
    assert repeats == []


# --- what a reader of a two-stroke, a large and a scaled engine disputed ---


@lru_cache(maxsize=1)
def large_note() -> str:
    """A medium-speed diesel with all its chapters, on a coarse grid."""
    made = generate_engine(12, layout="v", kind="diesel", bore_mm=300.0, stroke_mm=350.0,
                           speed_rpm=900.0, strength=True)  # fmt: skip
    raw = copy.deepcopy(made.data) | {"calculation": {"step_deg": 30}}
    model = load_mapping(raw | {"torsion": {}, "flywheel": {}}, source="t.toml").model
    return plain(bare_page(model))


def test_journals_loaded_at_one_angle_are_told_so_once():
    text = words_of("two-stroke")
    assert "кН на каждую, при φ = 180°" in text and "кН на каждую при φ = 180°" in text
    assert "у шейки 2 при φ" in words_of("d-240")  # journals 2 and 4 at their own angles


def test_specific_masses_of_a_large_engine_are_not_held_to_those_of_a_car():
    said = "у двигателя большего размера удельные массы растут вместе с ним"
    assert said in large_note() and said not in words_of("yamz-238")


def test_a_flywheel_of_the_train_is_set_against_the_one_that_is_sized():
    """One chapter drew a flywheel of 32 kg·m², the next took 742 without a word."""
    text = large_note()
    assert re.search(
        r"вместе с массами за маховиком: у маховика наименьших размеров \(таблица \d+\) "
        r"I′м = [\d,]+ кг·м2; принято Jм = [\d,]+ кг·м2",
        text,
    )


def test_orders_of_the_moment_are_told_how_far_they_go():
    text = large_note()
    assert "в ряд по порядкам ν до " in text
    assert not re.search(r"— (больше|меньше|почти такое же)\.", text)


def test_a_film_of_the_cycle_has_a_symbol_of_its_own():
    film, of_mean = quantity("oil_orb_h_um"), quantity("oil_hmin1_um")
    assert film.tex != of_mean.tex
    assert quantity("oil_orb_W").tex != quantity("oil_friction1_W").tex
    assert quantity("oil_orb_l_min").tex != quantity("oil_through1_l_min").tex
    assert {reason.tex for reason in REASONS if reason.key == "film"} == {film.tex}
    assert "φ — угол, при котором плёнка наименьшая" in words_of("d-240-bearings")


def test_what_is_stronger_than_usual_is_not_told_to_be_changed():
    raw = to_mapping(sample("two-stroke")) | {"strength": {}}
    text = plain(bare_page(load_mapping(raw, source="t.toml").model))
    assert "(взято с запасом)" in text and "что следует изменить): напряжение" not in text
