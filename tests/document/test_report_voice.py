"""What a supervisor sends back: sentences that are not true, numbers told twice."""

import re
from functools import cache

import numpy as np
import pytest

from kshm.nomenclature.digits import Digits
from reports.document.chapters.chapter import after_noun
from reports.document.chapters.closing import SOURCES
from reports.document.chapters.front import title_page
from reports.document.page.style import Style, TitlePage
from reports.document.report import Report
from reports.document.text.texts import of_digits, of_digits_tex
from reports.document.text.tolerances import tolerance
from reports.formula.tex import to_tex, to_tex_numbers
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_remote
from reports.inputs.reasons import REASONS, prototype_file
from reports.inputs.solve_input import refined, solved
from reports.model.evaluation import evaluate_model
from reports.new.generate import file_text, generate_engine
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir
from reports.shared.russian import instrumental
from reports.tables.registry import build_model
from reports.tables.strength_members import SAFETIES
from tests.conftest import sample
from tests.document.bare_pages import bare_page
from tests.document.test_report_sentences import (
    assert_speaks_as_its_author,
    engine,
    page_of,
    plain,
    printed_rows,
    text_of,
    words_of,
)

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


@cache
def offset():
    """Remarks on an engine with an offset and its note."""
    built = build_model(engine("offset"), ("Внимание: t.toml: masses.piston_group_kg: 0,003",))
    return built.remarks, Report(built, evaluate_model(built)).page("screen")


def test_remarks_on_the_input_are_no_sentences_of_the_note():
    """A warning, and tables that an offset costs: the console and the workbook tell them."""
    remarks, page = offset()
    assert len(remarks) == 3  # a check of this sample is accepted
    assert not [line for line in remarks if line[:20] in plain(page)]
    assert_speaks_as_its_author(page[page.index("<body") :])


def test_results_of_a_coarse_step_stand_in_a_table_of_every_profile():
    caption = "Результаты, для которых шаг таблиц велик"
    for detail in ("short", "course", "full"):
        page = page_of("yamz-236", detail)
        assert printed_rows(page, caption), detail
        assert "в тексте сопровождаются" not in plain(page)
    assert printed_rows(page_of("two-stroke", "course"), caption) is None


def test_the_line_of_an_offset_pin_does_not_cross_the_axis():
    line = "Прямая, по которой движется ось поршневого пальца, не пересекает ось вала"
    assert line in plain(offset()[1])
    assert "Механизм центральный: ось цилиндра пересекает ось вала." in words_of()


@cache
def split():
    """An engine with split pins and its course note."""
    model = engine("split", report__detail="course")
    return model, bare_page(model)


def test_statics_leads_where_the_rule_of_half_a_torque_is_off():
    """The table, the sentence and the conclusion hold the range of the same torque."""
    model, page = split()
    text = plain(page)
    tables = solved(model).columns["P4_5s"]
    swings = [
        float(column.max() - column.min()) for key, column in tables.items() if "Mpins" in key
    ]
    said = re.search(r"среди шатунных — у ше(?:йки|ек) [^:]*: ([\d\xa0 ]+) Н·м", text)
    assert said, "no range of crankpins"
    rows = printed_rows(page, "Размах набегающих моментов")
    shown = [float(re.sub(r"\D", "", row[3])) for row in rows if row[0].startswith("Шатунная")]
    assert shown == pytest.approx(swings, abs=0.6)
    assert float(re.sub(r"\D", "", said[1])) == pytest.approx(max(swings), abs=0.6)
    assert f"— {said[1].strip()} Н·м" in text[text.index("Рассчитаны кинематика") :]


def test_the_step_error_of_a_torque_is_of_statics_where_it_leads():
    """The row and the words «при шаге 1°» hold the range that the conclusion tells."""
    model, page = split()
    rows = printed_rows(page, "Результаты, для которых шаг таблиц велик")
    shown = {row[0].split(", Н·м")[0][-1]: row[1:3] for row in rows if "шатунную шейку" in row[0]
             and "момента" in row[0]}  # fmt: skip
    assert shown
    for pin, numbers in shown.items():
        for number, each in zip(numbers, (model, refined(model)), strict=True):
            swing = np.ptp(solved(each).columns["P4_5s"][f"Mpins{pin}_Nm"])
            assert float(re.sub(r"\D", "", number)) == pytest.approx(swing, abs=0.6)


def test_a_vector_that_turns_with_the_shaft_can_be_balanced_on_it():
    """Of the right-angled V six wholly; in line a part of it turns against the shaft."""
    said = "вращается вместе с валом и не изменяется по величине"
    assert f"Вектор момента первого порядка {said}" in text_of(engine("v_six"))
    assert said not in text_of(engine()) and said not in text_of(engine("v_apart"))


def test_the_hole_lies_opposite_the_rays_of_the_least_sums():
    """On the ray of its own angle the sum may be the greatest: forces press on the other side."""
    text = text_of(engine("v_six", report__detail="course"))
    assert "от колена против вращения, напротив лучей с наименьшими суммами сил" in text
    assert "где суммы сил" not in text


@pytest.mark.parametrize(("hole", "title"), [(None, "Давление под поршнем"),
                                             (90.0, "Давление окружающей среды")])  # fmt: skip
def test_the_pressure_under_the_piston_is_that_of_a_crankcase_that_scavenges(hole, title):
    """A two-stroke with an oil hole has its oil under pressure and no mixture below the piston."""
    model = engine("two_stroke", report__detail="course", crankshaft__oil_hole_deg=hole)
    assert title in text_of(model)


@pytest.mark.parametrize(
    ("genitive", "words"),
    [(True, " (рядного, четырёхтактного)"), (False, " (рядный, четырёхтактный)")],
)
def test_the_name_of_an_engine_is_declined(genitive, words):
    assert after_noun("Дизель: рядный, четырёхтактный", genitive=genitive) == words


def test_the_assignment_names_the_engine_in_the_nominative():
    text = text_of(engine(engine__name="Дизель: рядный, четырёхтактный"))
    assert "Исходные данные: двигатель (рядный, четырёхтактный);" in text
    assert "механизм двигателя (рядного, четырёхтактного)" in text


def test_factors_that_are_told_together_share_their_verb():
    text = text_of(engine())
    assert re.search(r"Здесь множители [^.]* переводят Н в кН и Па в МПа", text)
    assert re.search(r"Здесь множитель \S+ переводит", text)
    assert not re.search(r"переводит [^.]*переводит", text)
    for chapter in page_of().split("<h1"):  # once in each
        said = " ".join(re.findall(r"Здесь множител[^.]*\.", plain(chapter)))
        pairs = re.findall(r"[А-Яа-я³]+ в [А-Яа-я³]+", said)
        assert len(set(pairs)) == len(pairs)


def test_the_flywheel_is_that_of_the_fine_step_wherever_it_is_told():
    model = engine(report__detail="course", calculation__step_deg=30.0)
    inertia = float(solved(refined(model)).scalars["I_flywheel"])
    text = text_of(model)
    said = {float(n.replace(",", ".")) for n in re.findall(r"J?I?м(?:ах)? = ([\d,]+) кг·м2", text)}
    end = text[text.index("Рассчитаны кинематика") :]
    number = re.search(r"маховик для неравномерности хода [\d,]+: ([\d,]+) кг", end)
    assert number, "the conclusion tells no flywheel"
    assert float(number[1].replace(",", ".")) == pytest.approx(inertia, rel=1e-3)
    assert said <= {float(number[1].replace(",", "."))}


@cache
def oiled(*, well):
    """A course note on smooth journals: of cast iron, with a given hole; or too small a reserve."""
    rough = ("journal_roughness_um", "shell_roughness_um", "form_um")
    more = {f"bearings__{key}": 0.3 for key in rough} | (
        {"bearings__material": "vch60", "crankshaft__oil_hole_deg": 300.0} if well
        else {"bearings__reserve_allowed": 3.0}
    )  # fmt: skip
    return text_of(engine(source="d-240-bearings", report__detail="course", **more))


@pytest.mark.parametrize(("well", "said"), [
    (True, r"([\d,]+) не меньше допускаемого 1,5: плёнки достаточно"),
    (False, r"([\d,]+) меньше допускаемого 3: плёнки недостаточно"),
])  # fmt: skip
def test_a_film_below_the_allowed_reserve_is_not_called_enough(well, said):
    """Above one too: 1.08 of an allowed 1.5 was."""
    text = oiled(well=well)
    match = re.search(f"Запас плёнки за цикл {said}", text)
    assert match and float(match[1].replace(",", ".")) > 1
    assert f"её запас {match[0].removeprefix('Запас плёнки за цикл ').partition(':')[0]}" in text


@pytest.mark.parametrize("well", [True, False])
def test_the_oil_hole_has_one_verdict(well):
    """As given, or between the angles of the film at both clearances; nowhere that of the wear."""
    text = oiled(well=well)
    ends = re.search(r"по плёнке — (\d+)° при наименьшем и (\d+)° при наибольшем", text).groups()
    angle, why = ("300", "как задано") if well else (
        "…".join(sorted(ends)), "там, где плёнка толще всего")  # fmt: skip
    assert f"следует сверлить под углом {angle}° от колена против вращения, {why};" in text
    assert ("Угол отверстия задан: 300°" in text) == well
    assert ("окончательно угол отверстия выбран ниже" in text) != well


def test_clearances_and_widths_of_the_film_are_printed():
    rows = printed_rows(page_of("d-240-bearings", "course"), "Размеры подшипников и зазоры")
    assert rows and all(len(row) == 5 and all(row) for row in rows)
    assert "0,007√d, мм" in plain(page_of("d-240-bearings", "course"))


def test_a_cycle_has_one_effective_torque():
    """A bridge of powers leads to it from the diagram; without a cycle there is one anyhow."""
    caption, formula = "Мощности расчёта цикла и динамического расчёта", 'id="eq-n.3a.M_e"'
    page, other = page_of("cycle-tractor-diesel", "course"), page_of("gots-diesel", "course")
    ends = [plain(each).partition("Рассчитаны кинематика")[2] for each in (page, other)]
    assert [end.count("эффективный момент") for end in ends] == [1, 1]
    assert formula in other and formula not in page and printed_rows(other, caption) is None
    *_, indicated, effective = printed_rows(page, caption)
    shown = [cell.partition("=")[2].strip() for cell in (indicated[2], effective[2], effective[3])]
    share = float(re.search(r"[\d,]+$", effective[0])[0].replace(",", "."))
    before, after = (float(text.replace(",", ".")) for text in shown[:2])
    assert after / before == pytest.approx(share, abs=1e-3)
    assert f"механического КПД {shown[2]} Н·м" in ends[0]


def test_the_jump_at_the_dead_centre_is_told():
    """p_z is reached at once in TDC where the rise by the angle does not end there."""
    at_once = engine(gas__combustion_start_deg=345.0, report__chapters=["dynamics"])
    jump = r"возрастает скачком от [\d,]+ МПа до [\d,]+ МПа"
    assert re.search(jump, words_of("gots-diesel", "course"))
    assert not re.search(jump, text_of(at_once))


@pytest.mark.parametrize(
    ("name", "angles"),
    [("d-240-bearings", ["c", "open", "close"]), ("mwm-6", []),
     ("two-stroke", ["c", "open", "scavenge", "close"])],
)  # fmt: skip
def test_angles_of_a_diagram_have_their_formulas(name, angles):
    page = page_of(name, "course")
    assert re.findall(r'id="eq-n\.3a\.phi_(c|open|scavenge|close)_deg"', page) == angles


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("Судовой дизель 6Ч 30/38", " 6Ч 30/38"),
        ("Бензиновый двигатель VR6", " VR6"),
        ("Дизель: рядный, четырёхтактный", " (рядного, четырёхтактного)"),
        ("Д-240", " «Д-240»"),
    ],
)
def test_an_engine_is_not_called_an_engine_twice(name, words):
    assert after_noun(name) == words


def test_counts_of_throws_are_words():
    assert instrumental(1, "коленом", "коленами") == "одним\xa0коленом"
    assert instrumental(4, "коленом", "коленами") == "четырьмя\xa0коленами"


@pytest.mark.parametrize(
    "said",
    [
        "Порядок работы цилиндров 1–3–4–2, рабочие ходы чередуются через 180°",
        "Схема вала с четырьмя коленами показана", "Отдельно для массы шатуна и массы колена",
        "Дополнительно прочность проверена по правилу классификационных обществ",
        "Характерные точки диаграммы приведены в таблице", "Материал вала — сталь 45:",
        "таблицы с расчётными формулами (книга Excel) приложены в электронном виде",
    ],
)  # fmt: skip
def test_the_wording_of_a_note(said):
    """What stood in their place stands in no note: PROGRAM of test_report_sentences."""
    assert said in words_of("d-240-bearings", "course")


def test_wordings_of_other_engines():
    assert "Материал вала — чугун ВЧ 60:" in oiled(well=True)
    uneven = "рабочие ходы чередуются неравномерно: через 90° и 150°"
    assert uneven in words_of("yamz-236", "short") and uneven not in words_of()


@pytest.mark.parametrize(
    ("condition", "shown"),
    [
        ("value_x <= 0.000001", "0"),
        ("value_x <= 0.01", "не более 0,01"),
        ("abs(value_x) <= 5", "±5"),
        ("abs(value_x - 720) <= 0.000001", "720"),
        ("value_x >= 0.15 and value_x <= 0.45", "0,15…0,45"),
        ("value_x > 1", "более 1"),
    ],
)
def test_a_check_says_what_it_allows(condition, shown):
    assert tolerance(condition, "value_x", {}.__getitem__, str) == shown


@pytest.mark.parametrize("name", ["gots-diesel", "cycle-petrol", "d-240-bearings"])
def test_every_check_stands_beside_its_tolerance_with_sensible_digits(name):
    """Whole where it is a count or nothing, three decimals below 1, two from 1 on."""
    rows = printed_rows(page_of(name, "course"), "Проверки расчёта")
    assert all(row[2] for row in rows)
    assert all(re.fullmatch(r"−?(\d+|0,\d{3}|[1-9]\d*,\d\d)", row[1]) for row in rows)


def test_a_number_of_many_zeros_is_a_power_of_ten():
    digits = Digits(10)
    assert re.sub("<.*?>", "", of_digits(8.721e-7, digits)) == "8,721·10−7"
    assert of_digits_tex(8.721e-7, digits) == r"8{,}721\cdot 10^{-7}"
    assert of_digits(0.0, digits).strip("0") == "," and of_digits(0.01234, Digits(5)) == "0,01234"


def test_zero_terms_are_left_out_of_substitutions():
    numbers = {"a": 2.0, "b": 0.0, "c": 3.0}.__getitem__
    assert to_tex_numbers("a*c - b*(b + c)/a", lambda name: name, numbers) == r"2 \cdot 3"
    assert to_tex_numbers("b + a", lambda name: name, numbers) == "2"
    assert to_tex_numbers("b - a", lambda name: name, numbers) == "-2"
    assert to_tex("a - b", lambda name: name) == "a - b"


def test_equal_tables_stand_once():
    """Of a symmetric throw statics says what the rule of half a torque says."""
    assert "Моменты в сечениях шатунных шеек по статике" not in plain(page_of("d-240", "full"))
    assert "Моменты в сечениях шатунных шеек по статике" in plain(split()[1])


def test_axes_have_the_symbol_before_the_unit():
    for name in ("gots-diesel", "two-stroke"):
        for chart in build_model(sample(name)).charts:
            assert not re.fullmatch(r"(МПа|кН|Н·м)", chart.y_title or ""), chart.id


@pytest.mark.parametrize("review", [True, False])
def test_the_title_page_has_lines_for_signatures(review):
    style = Style(title=TitlePage(review=review), heading_before_pt=21, formula_space_pt=9)
    model = build_model(engine(report__controller="Нормов Н. Н.", report__designation="КП.01 ПЗ",
                               report__department="Двигатели", report__detail="short"))  # fmt: skip
    page = Report(model, evaluate_model(model), style=style).page("print")
    text = plain(page)
    assert text.count("подпись, дата") == 3 and "Допущен к защите" in text
    framed = title_page(model.input, style.title, "eskd")  # the frame has them
    assert not framed["designation"] and not framed["controller"]
    assert "Нормов Н. Н." in text and "КП.01 ПЗ" in text and "Кафедра «Двигатели»" in text
    assert ("ОТЗЫВ РУКОВОДИТЕЛЯ" in text) == review
    assert "margin: 21.0pt 0 8.0pt" in page and ".eq { margin: 9.0pt 0" in page


def test_the_assignment_lists_the_sheet_when_it_is_made():
    model = build_model(engine(report__detail="short"))
    for built in (True, False):
        page = Report(model, evaluate_model(model), with_sheet=built).page("print")
        assert ("лист «Динамический расчёт двигателя» формата A1" in plain(page)) == built


@pytest.mark.parametrize(("name", "inside"), [("gots-diesel", False), ("d-240-bearings", True)])
def test_what_lies_outside_its_usual_span_is_told_with_what_follows(name, inside):
    page = page_of(name, "course")
    rows = printed_rows(page, "Принятые данные и обычные пределы")
    lengths = ["lш.ш/dш.ш", "qср", "qmax", *(["hц"] if inside else [])]
    assert [row[1] for row in rows][:4] == ["S/D", "λ", "cm", "ε"]
    assert [row[1] for row in rows][-len(lengths) :] == lengths  # the film where it is calculated
    assert all(
        re.fullmatch(r"принято|(табл\.|п\.)\s[\d.]+(, с ростом D)?", row[-1]) for row in rows
    )
    # Of the film its own chapter says that it is not enough: the table says no other thing.
    outside = [row[1] for row in rows if row[4] != "в пределах"]
    assert (outside == ["hц"] and rows[-1][4] == "недостаточно") == inside
    text, _, end = plain(page).partition("Рассчитаны кинематика")
    assert ("больше обычного (0,24…0,31): растут боковая сила" in text) != inside
    assert ("меньше допускаемого (4,50): возможно касание" in text) == inside
    assert ("вне обычных пределов: " in end and "(обычно 0,24…0,31)" in end) != inside
    assert ("(допускается не менее 4,50)" in end) == inside


@pytest.mark.parametrize(("allowed", "side"), [(1.0, "не меньше"), (9.0, "меньше")])
def test_the_least_safety_stands_beside_what_is_allowed(allowed, side):
    model = engine(strength__safety_allowed=allowed, report__chapters=["strength"])
    pattern = (
        r"из запасов прочности деталей — запас [^;]*, ([\d,]+), он (\D+) допускаемого ([\d,]+)"
    )
    least, said, of = re.search(pattern, text_of(model)).groups()
    assert said == side and float(of.replace(",", ".")) == allowed
    assert (float(least.replace(",", ".")) >= allowed) == (side == "не меньше")


def _least_safety(times: float) -> float:
    model = build_model(engine(regime__times_speed_rpm=times, strength__safety_allowed=1.0))
    scalars = evaluate_model(model).scalars
    return min(float(scalars[key]) for key in SAFETIES)


def test_a_safety_is_printed_less_than_what_it_does_not_reach():
    """«0,9994» stood as 1,00 in the conclusion and as 0,999 among the checks."""
    least = ((times, _least_safety(times)) for times in (1.0, 0.99, 0.98, 0.97, 0.96))
    times, allowed = next((t, round(n, 2)) for t, n in least if round(n, 2) > n)
    model = engine(regime__times_speed_rpm=times, strength__safety_allowed=allowed,
                   report__chapters=["strength"])  # fmt: skip
    said = re.search(r"деталей — запас [^;]*, ([\d,]+), он меньше допускаемого", text_of(model))
    assert float(said[1].replace(",", ".")) < allowed


def test_the_comments_of_a_new_engine_tell_the_same_spans():
    text = file_text(generate_engine(4, kind="petrol"))
    for reason in REASONS:
        if reason.key in ("stroke_bore", "lam", "pin", "main", "piston_speed"):
            assert reason.words("petrol") in text


STATED = {"name": "Д-240", "bore_mm": 110.0, "stroke_mm": 125.0, "cylinders": 4,
          "speed_rpm": 2200.0, "power_kw": 58.8}  # fmt: skip


@pytest.mark.parametrize(
    ("named", "words"),
    [
        ({"report__compare": "other.toml"}, "с прототипом «Дизель"),
        ({"prototype__file": "other.toml"}, "с прототипом «Дизель"),
        ({f"prototype__{key}": value for key, value in STATED.items()}, "с прототипом «Д-240»"),
        ({}, ""),
    ],
)
def test_the_prototype_stands_beside_the_engine(tmp_path, named, words):
    """Its file or its main values: S/D of both, volume and speed with the difference."""
    other = samples_dir() / "d-240.toml"
    (tmp_path / "other.toml").write_bytes(other.read_bytes())
    model = engine(report__detail="course", **named)
    report = Report.of(build_model(model), evaluate_model(build_model(model)), tmp_path / "t.toml")
    page = report.page("print")
    rows = printed_rows(page, "Принятые данные и обычные пределы")
    assert (len(rows[0]) == 7) == bool(named)
    assert words in plain(page)
    pairs = printed_rows(page, "Двигатель и прототип")
    if not named:
        assert pairs is None and "прототип" not in plain(page)
        return
    assert rows[0][3].replace("\xa0", "").strip() == "1,14"
    shown = {row[0].partition(",")[0]: row[2:] for row in pairs}
    assert shown["Рабочий объём двигателя"] == ["1,715", "4,752", "−63,9"]
    assert shown["Частота вращения"][1:] == ["2200", "100,0"]


@pytest.mark.parametrize(
    ("name", "words"),
    [("none.toml", "prototype.file: нет файла"), ("a.xlsx", "a.xlsx — не файл .toml")],
)
def test_a_prototype_of_no_file_is_refused(tmp_path, name, words):
    model = engine(prototype__file=name)
    with pytest.raises(InputError, match=words):
        prototype_file(model, tmp_path)
    with pytest.raises(InputError, match="файлов с диска здесь не читают"):
        load_remote(to_mapping(model))


@pytest.mark.parametrize("detail", ["short", "course"])
@pytest.mark.parametrize("name", ["gots-diesel", "mwm-6", "d-240-bearings"])
def test_the_table_of_data_holds_what_the_chapters_read(name, detail):
    """Zero counterweights, the fullness of no power, sections of chapters that are not there."""
    rows = printed_rows(page_of(name, detail), "Исходные данные для расчёта")
    titles = " ".join(row[0] for row in rows)
    model = sample(name)
    assert ("Внешний противовес" in titles) == bool(
        model.crankshaft.nose_mass_kg or model.crankshaft.rear_mass_kg
    )
    short = detail == "short"
    # The other two give the webs' sizes.
    assert ("толщины щеки к диаметру" in titles) == (name == "gots-diesel" and not short)
    assert ("Плотность масла" in titles) == (model.bearings is not None and not short)
    assert ("Модуль сдвига" in titles) == (model.torsion is not None and not short)


@pytest.mark.parametrize("key", SOURCES)
def test_a_source_is_complete(key):
    """Place, publisher, year and extent of a book; journal, year and pages of an article."""
    book = r" — (Москва|Ленинград|Владимир) : [^,]+, \d{4}\. — \d+ с\."
    article = r" — Текст : непосредственный // [^—]+ — \d{4}\. — [^—]*(№ \d+)\. — [СP]\. \d+–\d+\."
    thesis = r" : Dissertation / .* — Karlsruhe, \d{4}\."
    assert re.search(f"{book}|{article}|{thesis}", SOURCES[key]), SOURCES[key]
    assert "Текст : непосредственный" in SOURCES[key]
