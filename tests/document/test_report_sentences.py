"""Sentences of the report against the numbers that they speak of, on random engines too.

What a sentence claims is judged here from the solver's arrays and from the printed tables,
not by the functions that the chapters ask.
"""

import copy
import html
import re
from collections import defaultdict
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.solve_input import solved
from reports.shared import font_coverage
from reports.shared.russian import BREAK
from tests import layouts
from tests.conftest import sample
from tests.cover import charts, choices, samples_with
from tests.document.bare_pages import bare_page, plain

# One process with those of test_report_strict: they read the same pages.
pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


def text_of(model):
    return plain(bare_page(model))


def engine(layout="basic", source="gots-diesel", **changes):
    """A sample or a layout with keys «section__key» changed."""
    raw = copy.deepcopy(to_mapping(sample(source)))
    if source == "gots-diesel":
        raw = layouts.MAKERS[layout](raw)
    for path, value in changes.items():
        section, _, key = path.partition("__")
        if value is None:
            raw[section].pop(key, None)
        elif isinstance(value, float) and key.startswith("times_"):
            raw[section][key.removeprefix("times_")] *= value
        else:
            raw.setdefault(section, {})[key] = value
    raw["report"]["detail"] = changes.get("report__detail", "full")
    return load_mapping(raw, source="t.toml").model


@cache
def noted(source, detail="full"):
    """The page of a sample, once for all that read it, with the charts drawn on it."""
    drawn = []
    return bare_page(engine(source=source, report__detail=detail), drawn), drawn


def page_of(source="gots-diesel", detail="full"):
    return noted(source, detail)[0]


def words_of(source="gots-diesel", detail="full"):
    return plain(page_of(source, detail))


def printed_rows(page, caption):
    """Rows of the table with that caption, as texts of cells."""
    match = re.search(re.escape(caption) + r"</div>.*?<tbody>(.*?)</tbody>", page, re.DOTALL)
    if match is None:
        return None
    rows = re.findall(r"<tr.*?</tr>", match.group(1), re.DOTALL)
    return [
        [
            html.unescape(re.sub("<[^>]+>", "", cell)).strip()
            for cell in re.findall(r"<td.*?</td>", row, re.DOTALL)
        ]
        for row in rows
    ]


def numbers_in(rows):
    text = " ".join(cell for row in rows for cell in row)
    return [float(n.replace("−", "-").replace(",", ".").replace("\xa0", ""))
            for n in re.findall(r"−?\d[\d\xa0]*(?:,\d+)?", text)]  # fmt: skip


# --- pins ---


def pins_differ(model):
    """By the solver: whether the sorted loads of the crankpins are not the same."""
    columns = solved(model).columns
    names = [name for name in columns if re.fullmatch("crankpin(_[0-9]+)?", name)]
    loads = [np.sort(columns[name]["Rpin_MPa"][:-1]) for name in names]
    return len(loads) > 1 and any(
        not np.allclose(other, loads[0], atol=1e-6 * loads[0].max()) for other in loads[1:]
    )


@pytest.mark.parametrize("source", ["yamz-236", "yamz-238", "gots-diesel"])
def test_pins_are_called_alike_only_if_they_are(source):
    model, text = engine(source=source), words_of(source)
    assert ("нагружены по-разному" in text) == pins_differ(model)
    assert ("такие же нагрузки" in text) == (
        len(layouts_pins(model)) > 1 and not pins_differ(model)
    )


def layouts_pins(model):
    return [name for name in solved(model).columns if re.fullmatch("crankpin(_[0-9]+)?", name)]


def test_the_reason_that_is_given_is_the_one():
    text = text_of(engine("v_apart"))
    assert "через разные интервалы" not in text or "по-разному" in text


def light_first(**changes):
    """ЯМЗ-238 numbered from its other end: the first pin bears less than the others."""
    return engine(
        source="yamz-238", crankshaft__firing_order="1-2-6-3-7-5-4-8",
        crankshaft__firing_offsets_deg=[0, 90, 270, 540, 450, 180, 360, 630],
        crankshaft__throw_angles_deg=[0, 270, 90, 180], **changes,
    )  # fmt: skip


def assert_pins_agree(model, text):
    """Chapter, abstract and conclusion tell of the most loaded crankpin, by the solver."""
    scalars = solved(model).scalars
    loads = {key: value for key, value in scalars.items() if re.fullmatch(r"Rpin\d*_max", key)}
    most = [key for key in loads if loads[key] == pytest.approx(max(loads.values()), rel=1e-6)]
    pin = most[0].removeprefix("Rpin").removesuffix("_max")
    number = f" {pin or 1}" if len(loads) > 1 else ""
    for key, digits, said in (
        (f"Rpin{pin}_mean", 3, f"Средняя нагрузка R′ш.ш{pin} ср = "),
        (f"Rpin{pin}_max", 3, r"\. Наибольшая "),
        (f"Rpin{pin}_max_kN", 2, f"наибольшая нагрузка на шатунную шейку{number} — "),
        *(
            [
                (
                    f"hole_pin{pin}_deg",
                    0,
                    f"отверстие шатунной шейки{number} следует сверлить под углом ",
                )
            ]
            if model.bearings is None
            else []
        ),
    ):
        match = re.search(said + r"([\d,]+)", text)
        assert match, said
        shown = float(match.group(1).replace(",", "."))
        assert shown == pytest.approx(scalars[key], abs=0.6 * 10**-digits), key


@pytest.mark.parametrize("detail", ["course", "full"])
def test_the_chapter_is_of_the_most_loaded_pin(detail):
    text = text_of(light_first(report__detail=detail))
    assert_pins_agree(light_first(), text)
    assert "Ниже рассмотрена шейка 2, одна из наиболее нагруженных." in text
    match = re.search(r"Среднее давление на шатунный подшипник, МПа\s*qср2\s*([\d]+,\d\d)", text)
    assert match and f"среднее {match[1]} МПа" in text  # in the conclusion
    assert "Развёрнутая диаграмма нагрузки на шатунную шейку 2" in text


def test_the_greatest_pressure_of_another_pin_is_told():
    text = text_of(engine(crankshaft__pin_length_mm=None, crankshaft__pin_lengths_mm=[28, 28, 24]))
    assert "наибольшее давление — на шейку 3" in text
    assert re.search(r"наибольшее давление [\d,]+ МПа — у шатунной шейки 3", text)


# --- journals and torques ---


def claimed(text, before):
    """Numbers of journals after the words of a claim."""
    match = re.search(before + r" ([0-9][0-9, и]*)", text)
    assert match, before
    return [int(n) for n in re.findall("[0-9]+", match.group(1))]


def leaders(scalars, pattern, digits):
    collected = {}
    for key, value in scalars.items():
        match = re.fullmatch(pattern, key)
        if match:
            collected[int(match.group(1))] = value
    most = f"{max(collected.values()):.{digits}f}"
    return sorted(n for n, value in collected.items() if f"{value:.{digits}f}" == most)


def assert_claims_hold(model, page):
    """Every conditional sentence of the loads against the solver."""
    text = plain(page)
    if "Средняя нагрузка" in text and "следует сверлить" in text:
        assert_pins_agree(model, text)
    scalars = solved(model).scalars
    if "Наибольшая нагрузка приходится" in text:
        said = claimed(text, "Наибольшая нагрузка приходится на шейк[уи]")
        assert said == leaders(scalars, "Rmain([0-9]+)_max", 3)
    if "Наибольший размах среди" not in text:
        return
    main = claimed(text, "Наибольший размах среди коренных шеек — у ше(?:йки|ек)")
    assert main == leaders(scalars, "dM_main([0-9]+)", 0)
    if len(layouts_pins(model)) > 1:
        assert ("нагружены по-разному" in text) == pins_differ(model)
    order = re.search(r"чередуются через ([0-9,]+)°", text)
    offsets = np.unique(np.mod(model.crankshaft.firing_offsets_deg, 180 * model.engine.strokes))
    gaps = np.diff([*offsets, offsets[0] + 180 * model.engine.strokes])
    if order:
        assert np.allclose(gaps, float(order.group(1).replace(",", ".")), atol=0.005)
    assert ("рабочие ходы чередуются неравномерно" in text) == (
        not np.allclose(gaps, gaps[0], atol=1e-2)
    )
    assert ("проверок" not in text) or "Из 7 проверок" not in text


def assert_nothing_is_empty(page, drawn):
    """No table of zeros only, no rows all alike, no curve of nothing."""
    for caption, body in re.findall(
        r'class="tcap"[^>]*>(.*?)</div>.*?<tbody>(.*?)</tbody>', page, re.DOTALL
    ):
        if re.search(r"Таблица.[А-Я]?П?4|Центробежные силы|Щёки|Точки|Фазы|Размеры колен", caption):
            continue
        rows = [[html.unescape(re.sub("<[^>]+>", "", cell)).strip()
                 for cell in re.findall(r"<td.*?</td>", row, re.DOTALL)]
                for row in re.findall(r"<tr.*?</tr>", body, re.DOTALL)]  # fmt: skip
        values = [number for row in rows for number in numbers_in([row[1:]])]
        assert not values or any(values), f"only zeros: {plain(caption)}"
    for name, most in drawn:
        assert most > 0, f"nothing is drawn: {name}"


def assert_symbols_mean_one_number(page):
    """A symbol with a value in running text has the same value wherever it stands."""
    said = defaultdict(set)
    for symbol, value in re.findall(r'<span class="nb">(.*?)\xa0=\xa0(.*?)</span>', page):
        unit = re.sub(r"[−\d,\xa0·]+", "", html.unescape(re.sub("<[^>]+>", "", value)))
        said[symbol, unit].add(value)
    assert not {key: item for key, item in said.items() if len(item) > 1}


UNIT = r"%|°C|с\.|(?:мин|м|мм|мкм|кг|л|Гц|Дж|кДж|Вт|кВт|Н|кН|Н·м|МПа|мПа)(?![а-яё])"
PARTED = re.compile(rf".{{0,30}}\d (?:{UNIT}).{{0,10}}")


BESIDE = (
    r"скорость поршня (NUMBER) м/с при φ = [^,;]*,\d+°, средняя (NUMBER) м/с",
    r"давление газов (NUMBER) МПа [^;]*достигает (NUMBER) МПа",
    r"мёртвые точки — при (NUMBER)° и (NUMBER)°",
    r"средней нагрузки — (NUMBER)°, по условному износу — (NUMBER)°",
)


def assert_decimals_agree(text):
    """Values of one quantity beside each other have the same decimals."""
    for said in BESIDE:
        for pair in re.findall(said.replace("NUMBER", r"−?[\d ]+(?:,\d+)?"), text):
            assert len({len(number.partition(",")[2]) for number in pair}) == 1, pair


_UNSEEN = {"\n", "\u00ad", BREAK}  # where lines may end: no font draws them


def assert_set_well(page):
    """Every sign is in the report's font, no number leaves its unit, no line ends in «1-го»."""
    bare = re.sub(r"<(style|svg).*?</\1>", "", page, flags=re.DOTALL)
    free = re.sub('<span class="nb">.*?</span>|<[^>]+>', "", bare)
    assert re.findall(r".{0,20}(?<![\w-])\d+-[а-яё]{1,3}(?![\w-])", free) == []
    text = html.unescape(re.sub("<[^>]+>", "", bare))
    assert {
        sign for sign in set(text) - _UNSEEN if ord(sign) not in font_coverage.coverage()
    } == set()
    assert PARTED.findall(text) == []


# Words of the program, which speaks in the console, in the workbook and in the manual; then
# what was read in notes and sent back.
PROGRAM = re.compile(
    r"программ|по памяти|не сверен|проверьте|впишите|сверьте|задайте|Внимание|умолчани|сборк"
    r"|ukrbukva|источника не имеют|\b[\w-]+\.(?:toml|csv|xlsx)|в книге нет|\b[a-z]+_[a-z_]+"
    r"|в тексте сопровождаются|ось пальца не пересекает|Порядок начала|\d коленами|Порознь"
    r"|Второе мнение|Характерные точки, таблица|Материал вала — \S*\d|Кафедра:|приложены[.,]"
    r"|двигателя «[^»]*двигатель",
    re.IGNORECASE,
)


def assert_speaks_as_its_author(page):
    """No word of the program stands in the text."""
    text = re.sub(r"<title>.*?</title>|<svg.*?</svg>", "", page, flags=re.DOTALL)
    words = html.unescape(re.sub("<[^>]+>", " ", text))
    assert [words[m.start() - 40 : m.end() + 40] for m in PROGRAM.finditer(words)] == []


@pytest.mark.parametrize("detail", ["short", "course"])
@pytest.mark.parametrize("name", samples_with(charts, choices))
def test_no_word_of_the_program_stands_in_a_note(name, detail):
    assert_speaks_as_its_author(page_of(name, detail))


def assert_every_rule(model, page, drawn):
    assert_claims_hold(model, page)
    assert_nothing_is_empty(page, drawn)
    assert_symbols_mean_one_number(page)
    assert_decimals_agree(plain(page))
    assert_set_well(page)
    assert_speaks_as_its_author(page)


@pytest.mark.parametrize("name", samples_with(charts, choices))
def test_no_sentence_of_a_sample_is_denied(name):
    model, (page, drawn) = engine(source=name), noted(name)
    assert_every_rule(model, page, drawn)


@settings(max_examples=10)
@given(
    layout=st.sampled_from(sorted(layouts.MAKERS)),
    step=st.sampled_from([10.0, 15.0, 30.0]),
    speed=st.floats(0.3, 1.2),
    method=st.sampled_from(["textbook", "exact"]),
    detail=st.sampled_from(["full", "full", "course", "short"]),
)
def test_no_sentence_of_a_random_engine_is_denied(layout, step, speed, method, detail):
    model = engine(
        layout, calculation__step_deg=step, calculation__method=method,
        regime__times_speed_rpm=speed, report__detail=detail,
    )  # fmt: skip
    drawn = []
    page = bare_page(model, drawn)
    assert_every_rule(model, page, drawn)


# --- what was wrong, by name ---


def test_the_masses_outside_the_limits_are_named():
    """Once: what the chapter on the data judges, the one on the masses does not."""
    assert "удельная масса колена 647,9 кг/м2 (100…400 кг/м2)" in words_of("yamz-236")
    light = {"crankshaft__pin_mass_kg": 0.1}
    assert "Вне пределов" in text_of(engine(**light, report__detail="short"))
    text = text_of(engine(**light))
    assert "Вне пределов" not in text and "Удельная масса колена mк/Fп" in text
    assert "Вне пределов" not in text_of(engine(crankshaft__pin_mass_kg=0.8))


def test_the_pressure_after_the_jump_is_told_at_the_dead_centre():
    assert "наибольшее давление газов 7,27 МПа в ВМТ после скачка" in words_of("cycle-petrol")
    assert "между строками таблицы" not in words_of("yamz-236")


def test_data_that_the_cycle_does_not_take_stand_in_no_table():
    text = page_of("cycle-petrol")
    rows = printed_rows(text, "Исходные данные для расчёта")
    assert not [row for row in rows if row[0] == "Механический КПД"]


def test_a_rod_is_modelled_only_if_its_mass_is_not_given():
    assert "оценены по диаметру цилиндра" not in words_of("yamz-236")
    page = page_of()
    assert "оценены по диаметру цилиндра" in plain(page)
    named = {row[0]: row for row in printed_rows(page, "Момент инерции и неравномерность хода")}
    modelled = {row[0]: row for row in printed_rows(page, "Шатун по основным размерам")}
    assert named["Масса шатуна"][2] == "1,750"  # m2 / (1 - share), not the model's
    assert named["Масса шатуна"][1] != modelled["Масса шатуна по модели"][1]


def test_shafts_are_told_only_if_asked_for():
    assert "Балансирные валы" not in words_of()
    requested = text_of(engine(source="vw-1600", balance__first_shafts_share=0.5))
    assert "Балансирные валы снимают долю 0,5 сил и моментов первого порядка." in requested


def test_a_department_is_called_so_once():
    for said in ("Двигатели", "Кафедра тепловых двигателей"):
        text = text_of(engine(report__department=said))
        assert "Кафедра: Кафедра" not in text and "Кафедра" in text


def test_failed_checks_stand_in_a_sentence():
    text = words_of("gots-diesel")
    assert re.search(r"Проверок расчёта выполнено \d+ из \d+\.", text)
    assert "Все проверки расчёта выполнены (7 из 7)." in words_of("yamz-236")


def test_directions_are_from_the_axis_of_the_first_cylinder():
    assert "вертикал" not in words_of("yamz-236").lower()


def test_initials_do_not_leave_their_surname():
    page = page_of()
    assert "А.\xa0Н.\xa0Гоц" in page and not re.search(r"\b[А-Я]\. [А-Я]\.", page)


def test_only_cited_sources_are_listed():
    offset = text_of(engine("offset"))
    assert "Сегаль" not in offset and "Сегаль, В. Ф." in words_of()


@pytest.mark.usefixtures("nothing_is_drawn")
@pytest.mark.parametrize("name", ["two-stroke", "ecoboost-10", "cycle-petrol", "yamz-236"])
def test_what_a_strict_reader_asks_for(name):
    """No names of the program, no raw indices, no blank cells, no unit before a blank."""
    page = page_of(name, "course")
    text = plain(re.sub("<title>.*?</title>", "", page))  # what pictures are called aloud
    assert not re.search(r"[A-Za-zА-яλρ]_[A-Za-zА-я]", text)
    assert "<td></td>" not in page
    assert "· 1 +" not in text and "порядок работы 1." not in text
    ties = re.search(r"Наименьш(?:ая сумма — у луча|ие суммы — у лучей) ([IVXи, ]+)\.", text)
    pin = "\xa01" if len(layouts_pins(sample(name))) > 1 else ""
    rows = printed_rows(page, f"Суммы удельных сил по лучам шатунной шейки{pin}")
    least = min(float(row[2].replace(",", ".")) for row in rows)
    named = [row[0] for row in rows if float(row[2].replace(",", ".")) == least]
    assert re.findall("[IVX]+", ties.group(1)) == named


@pytest.mark.usefixtures("nothing_is_drawn")
def test_a_short_report_promises_no_appendix():
    page = page_of("gots-diesel", "short")
    text = plain(page)
    assert "напечатаны через" not in text and "0 прил." not in text
    page = page_of("gots-diesel", "course")
    assert "напечатаны через 30°" in plain(page) and "2 прил." in plain(page)


@pytest.mark.usefixtures("nothing_is_drawn")
@pytest.mark.parametrize(
    ("name", "said", "word"),
    [
        ("mwm-6", "превышает допускаемую", "КРУТИЛЬНЫЕ"),
        ("d-240-bearings", "плёнка", "ПЛЁНКА"),
        ("gots-regimes", "из 3 режимов работы расчёт определяют режимы: «", "КРИВОШИПНО"),
    ],
)
def test_the_conclusion_tells_of_every_chapter(name, said, word):
    page = page_of(name, "course")
    end = plain(page[page.index("Заключение</h1>") :])
    assert said in end and word in plain(page)
    # Between «…» and a bracket no line ends: a line with a word for each quarter of it came before.
    assert "» (" not in end
