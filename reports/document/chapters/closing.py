"""Checks, conclusions, bibliography and appendices."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from functools import partial
from types import MappingProxyType

from markupsafe import Markup

from reports.document.chapters import (
    balance,
    dynamics,
)
from reports.document.chapters.chapter import (
    BOOK,
    ELSEWHERE,
    STATICS,
    Chapter,
    leaders,
    pin_stems,
    pin_torque,
    worst_pin,
    worst_running,
)
from reports.document.chapters.journals import alike_journals, at_once, least_ray
from reports.document.chapters.oil_hole import oil_hole
from reports.document.chapters.repeats import printed, repeated
from reports.document.page.blocks import TableBlock, TableColumn, angle_table, table_block
from reports.document.page.numbering import TablePlan
from reports.document.text.checked import allows, beside_limit, outcome, shown
from reports.document.text.symbols import remark_html, titled_html
from reports.document.text.terms import Terms, crankcase_scavenges
from reports.document.text.texts import of_digits
from reports.inputs.solve_input import GridError
from reports.model.blocks import Held
from reports.model.shape import Shape, pin_table, rays_table, rods_table
from reports.shared.russian import NBSP, capital, fixed, joined
from reports.shared.standing import Standing
from reports.tables.left_out import without_orders
from reports.tables.verdicts import JudgedValue, reasons_of

_TEXT = "— Текст : непосредственный"
SOURCES = {
    BOOK:
        "Гоц, А. Н. Кинематика и динамика кривошипно-шатунного механизма поршневых двигателей : "
        "учебное пособие / А. Н. Гоц. — Владимир : Изд-во Владим. гос. ун-та, 2006. — 104 с. — "
        f"ISBN 5-89368-664-0. {_TEXT}.",
    "vikhert":
        "Конструкция и расчет автотракторных двигателей / М. М. Вихерт, Р. П. Доброгаев, "
        "М. И. Ляхов [и др.] ; "
        "под редакцией Ю. А. Степанова. — 2-е изд., перераб. и доп. — Москва : Машиностроение, "
        f"1964. — 552 с. {_TEXT}.",
    "gots_polar":
        "Гоц, А. Н. Построение полярной диаграммы нагрузки на коренные шейки / А. Н. Гоц. "
        f"{_TEXT} // Тракторы и сельскохозяйственные машины. — 2000. — № 6. — С. 16–18.",
    "segal":
        "Сегаль, В. Ф. Динамические расчёты двигателей внутреннего сгорания / В. Ф. Сегаль. — "
        f"Ленинград : Машиностроение, 1974. — 248 с. {_TEXT}.",
    "neiman":
        "Нейман, И. Ш. Динамика авиационных двигателей / И. Ш. Нейман. — Москва : Оборонгиз, "
        f"1940. — 489 с. {_TEXT}.",
    "den_hartog":
        "Ден-Гартог, Дж. П. Механические колебания / Дж. П. Ден-Гартог ; перевод с английского. "
        f"— Москва : Физматгиз, 1960. — 580 с. {_TEXT}.",
    "butenschon":
        "Butenschön, H.-J. Das hydrodynamische, zylindrische Gleitlager endlicher Breite unter "
        "instationärer Belastung : Dissertation / H.-J. Butenschön. — Karlsruhe, 1976. "
        f"{_TEXT}. — На немецком языке.",
    "booker":
        "Booker, J. F. Dynamically loaded journal bearings : mobility method of solution / "
        f"J. F. Booker. {_TEXT} // Transactions of the ASME. Journal of Basic Engineering. — "
        "1965. — Vol. 87, № 3. — P. 537–546. — На английском языке.",
    "kolchin":
        "Колчин, А. И. Расчёт автомобильных и тракторных двигателей : учебное пособие для вузов / "
        f"А. И. Колчин, В. П. Демидов. — 4-е изд. — Москва : Высшая школа, 2008. — 496 с. {_TEXT}.",
    "serensen":
        "Серенсен, С. В. Несущая способность и расчет деталей машин на прочность / "
        "С. В. Серенсен, В. П. Когаев, Р. М. Шнейдерович. — 3-е изд. — Москва : "
        f"Машиностроение, 1975. — 488 с. {_TEXT}.",
    "orlin_theory":
        "Двигатели внутреннего сгорания : Теория поршневых и комбинированных двигателей / "
        "Д. Н. Вырубов, Н. А. Иващенко, В. И. Ивин [и др.] ; под редакцией А. С. Орлина, "
        f"М. Г. Круглова. — 4-е изд. — Москва : Машиностроение, 1983. — 372 с. {_TEXT}.",
    "orlin_design":
        "Двигатели внутреннего сгорания : Конструирование и расчёт на прочность поршневых и "
        "комбинированных двигателей / Д. Н. Вырубов, С. И. Ефимов, Н. А. Иващенко [и др.] ; под "
        "редакцией А. С. Орлина, М. Г. Круглова. — 4-е изд. — Москва : Машиностроение, 1984. — "
        f"384 с. {_TEXT}.",
    "lukanin_cycle":
        "Двигатели внутреннего сгорания. В 3 кн. Кн. 1. Теория рабочих процессов / В. Н. Луканин, "
        "К. А. Морозов, А. С. Хачиян [и др.] ; под редакцией В. Н. Луканина, М. Г. Шатрова. — "
        f"2-е изд. — Москва : Высшая школа, 2005. — 479 с. {_TEXT}.",
    "lukanin_dynamics":
        "Двигатели внутреннего сгорания. В 3 кн. Кн. 2. Динамика и конструирование / "
        "В. Н. Луканин, И. В. Алексеев, М. Г. Шатров [и др.] ; под редакцией В. Н. Луканина, "
        f"М. Г. Шатрова. — 2-е изд. — Москва : Высшая школа, 2005. — 400 с. {_TEXT}.",
    "popyk":
        "Попык, К. Г. Динамика автомобильных и тракторных двигателей / К. Г. Попык. — 2-е изд. — "
        f"Москва : Высшая школа, 1970. — 328 с. {_TEXT}.",
    "istomin":
        "Истомин, П. А. Крутильные колебания в судовых ДВС / П. А. Истомин. — Ленинград : "
        f"Судостроение, 1968. — 304 с. {_TEXT}.",
    "terskikh":
        "Терских, В. П. Крутильные колебания валопровода силовых установок. Т. 1. Элементы системы "
        "и возмущающие моменты / В. П. Терских. — Ленинград : Судостроение, 1969. — 206 с. "
        f"{_TEXT}.",
    "maslov":
        "Маслов, Г. С. Расчёты колебаний валов : справочник / Г. С. Маслов. — 2-е изд. — Москва : "
        f"Машиностроение, 1980. — 151 с. {_TEXT}.",
    "zakharov":
        "Захаров, С. М. Подшипники коленчатых валов тепловозных дизелей / С. М. Захаров, "
        "А. П. Никитин, Ю. А. Загорянский. — Москва : Транспорт, 1981. — 181 с. "
        f"{_TEXT}.",
    "birger":
        "Биргер, И. А. Расчёт на прочность деталей машин : справочник / И. А. Биргер, Б. Ф. Шорр, "
        "Г. Б. Иосилевич. — 4-е изд. — Москва : Машиностроение, 1993. — 640 с. "
        f"{_TEXT}.",
}  # fmt: skip

# Chapters whose results the conclusion repeats.
_CONCLUDED = {"cycle", "kinematics", "dynamics", "torque", "crankpin", "journals", "running"}
_TEXTBOOKS = re.compile(r"П[\d.]+")  # numbers of the textbook's tables
_JOURNALS = "Удельные силы, одинаковые у коренных шеек {} ({})"
_MAX_PERCENT = 1000.0  # of a value near zero a difference in percent says nothing


def checks(chapter: Chapter) -> Markup:
    """Table of checks and what the failed ones mean."""
    terms = chapter.terms
    plan = TablePlan(partial(_check_table, terms), "Проверки расчёта", lined=True)
    return chapter.page(
        "checks",
        plan=plan,
        failed=failed(terms),
        verdict=verdict(chapter),
        accepted=_accepted(chapter),
        flywheel=balance.flywheel(chapter),
        reason=without_orders(chapter.input) if "balance" in chapter.chosen else "",
        grid=bool(_grid_errors(chapter)),
        errors=TablePlan(
            partial(_grid_table, chapter), "Результаты, для которых шаг таблиц велик", size="tiny"
        ),
    )


def _accepted(chapter: Chapter) -> list[tuple[Markup, Markup]]:
    """Failed checks that the author explains, with the reason; that of power has its chapter."""
    stated = {"power"} if "torque" in chapter.chosen else set()
    titles = {key: scalar.note for key, scalar in chapter.model.scalars.items()}
    return [
        (titled_html(titles[f"check_{key}"]), remark_html(reason.rstrip(".")))
        for key, reason in reasons_of(chapter.input).items()
        if f"check_{key}" in titles and key not in stated
    ]


def _grid_errors(chapter: Chapter) -> list[GridError]:
    """Errors of the step of results that the report tells."""
    written = chapter.relevant
    absent = tuple(key for record in chapter.records if record.name not in written
                   for key in record.keys)  # fmt: skip
    if not (chapter.whole and "balance" in written):
        absent += ("delta_speed",)
    return [error for error in chapter.grid_errors if not error.key.startswith(absent)]


def _grid_table(chapter: Chapter) -> TableBlock:
    """Results on the grid of the tables beside those of the fine step."""
    step = fixed(chapter.input.calculation.step_deg, 0)
    heads = (f"Шаг {step}°", "Шаг 1°", "Разность, %")
    columns = [TableColumn("Величина", 5, text=True), *(TableColumn(head, 1.5) for head in heads)]
    rows = []
    for error in _grid_errors(chapter):
        q, percent = error.quantity, error.percent
        unit = f", {q.unit_label}" if q.unit_label else ""
        texts = [of_digits(value, error.digits) for value in (error.coarse, error.fine)]
        rows.append([capital(error.title) + unit, *texts, difference(percent, texts[1])])
    return table_block(columns, rows)


def difference(percent: float, fine: str) -> str:
    """Return a difference from a value as printed; none from a value that is printed as zero."""
    comparable = abs(percent) < _MAX_PERCENT and fine.strip("0,−")
    return fixed(percent, 1) if comparable else "—"


def checked(terms: Terms) -> list[JudgedValue]:
    """Return checks of the calculation in order."""
    return [each for each in terms.judged if each.held is Held.CHECK]


def failed(terms: Terms, without: Collection[str] = ()) -> list[tuple[Markup, Markup]]:
    """Title and what came out of the checks that did not pass."""
    return [
        outcome(terms, each)
        for each in checked(terms)
        if each.standing is not Standing.INSIDE and each.name not in without
    ]


def _check_table(terms: Terms) -> TableBlock:
    columns = (
        TableColumn("Проверка", 6, text=True),
        TableColumn("Значение", 1.5),
        TableColumn("Допуск", 1.6),
        TableColumn("Выполнено", 1.5),
    )
    rows = [
        [
            titled_html(each.title),
            shown(terms, each),
            allows(terms, each),
            "да" if each.standing is Standing.INSIDE else "нет",
        ]
        for each in checked(terms)
    ]
    return table_block(columns, rows)


def conclusion(chapter: Chapter) -> Markup:
    """Conclusions, each from numbers."""
    terms, throws = chapter.terms, chapter.shape.throws
    names, pin = pin_stems(chapter.shape), worst_pin(terms)
    mains, pins = worst_running(terms, throws)
    peak = dynamics.greatest_pressure(chapter)
    return chapter.page(
        "conclusion",
        count=chapter.input.engine.cylinders,
        failed=failed(terms, {"power"} if "torque" in chapter.relevant else ()),
        verdict=verdict(chapter, briefly=True),
        load=chapter.worst("worst_main_load"),
        loads=leaders(terms, [f"Rmain{k}_max" for k in range(1, throws + 2)]),
        at_once=at_once(terms, range(1, throws + 2)),
        names=chapter.relevant & _CONCLUDED,
        mains=mains,
        pins=pins,
        pins_count=len(names),
        worst_pins=leaders(terms, [f"R{name}_max" for name in names]),
        own_rods=chapter.shape.rods_beside > 1,
        pressed=leaders(terms, [f"q_{name}_max" for name in names]),
        names_of_pins=names,
        pin_number=pin,
        pin=names[pin - 1],
        ray=least_ray(terms, names[pin - 1]),
        crankcase=crankcase_scavenges(chapter.input),
        has_power=terms.has("T_ref"),
        further=_further(chapter),
        step=chapter.input.calculation.step_deg,
        forced=chapter.input.crankshaft.force_offsets_deg is not None,
        pz=peak,
        pz_printed=_is_printed(chapter, peak.angle),
        powers=terms.has("cyc_N_gas"),
        hole=oil_hole(terms, pin),
    )


def _is_printed(chapter: Chapter, angle: float | None) -> bool:
    """Whether the printed tables have a row of the angle [deg]."""
    step = chapter.printed_step
    return angle is not None and (not step or angle % step == 0)


def _further(chapter: Chapter) -> list[Markup]:
    """Results of the chapters that not every report has."""
    lines = (record.conclude(chapter) for record in chapter.records
             if record.conclude is not None and record.name in chapter.chosen)  # fmt: skip
    return [line for line in lines if line]


def verdict(chapter: Chapter, *, briefly: bool = False) -> Markup:
    """How many checks passed, in words; where they stand if the report has no table of them.

    ``briefly`` counts the results that leave their limits, which the chapter of checks names.
    """
    terms = chapter.terms
    count, bad = len(checked(terms)), len(failed(terms))
    absent = "checks" not in chapter.relevant
    where = f" (таблица «Проверки» {ELSEWHERE})" if absent else ""
    beyond = _beyond(terms, names=absent or not briefly)
    if bad:
        also = Markup(" Кроме того, {}.").format(beyond) if beyond else ""
        passed = f"Проверок расчёта{where} выполнено {count - bad}{NBSP}из{NBSP}{count}."
        return Markup(passed) + also
    share = f"({count}{NBSP}из{NBSP}{count})"
    if beyond:
        passed = f"Проверки хода расчёта{where} выполнены {share}, но "
        return Markup("{}{}.").format(passed, beyond)
    return Markup(f"Все проверки расчёта{where} выполнены {share}.")


def _beyond(terms: Terms, *, names: bool) -> Markup:
    """Return what of the results is not as allowed, and how many leave their usual limits."""
    outside = [each for each in terms.judged if each.standing is not Standing.INSIDE]
    weak = [each for each in outside if each.held is Held.ALLOWED]
    odd = sum(each.held is Held.USUAL for each in outside)
    parts = []
    if weak and names:
        named = Markup("; ").join(beside_limit(terms, each) for each in weak)
        parts.append(Markup("не в допускаемых пределах: {}").format(named))
    elif weak:
        parts.append(Markup(f"результатов не в допускаемых пределах: {len(weak)}"))
    if odd:
        parts.append(Markup(f"результатов вне обычных пределов: {odd}"))
    return Markup("; ").join(parts)


def sources(chapter: Chapter) -> Markup:
    """Bibliography."""
    heading = chapter.writer.heading(1, "Список использованных источников", numbered=False)
    cited = [(key, SOURCES[key]) for key in chapter.writer.n.cited]
    return heading + chapter.writer.sources(cited)


def appendices(chapter: Chapter) -> Markup:
    """All tables over the crank angle: П3 in appendix А, П4 in appendix Б."""
    shape, terms = chapter.shape, chapter.terms
    wide = "dense" if shape.cylinders > 6 else ""
    # Statics gives a table of its own only where it differs from the rule.
    separate = pin_torque(terms, shape.throws, 1).startswith(STATICS)
    running = ("P4_4", "P4_5", *((STATICS,) if separate else ()))
    journals = alike_journals(terms, shape.throws)
    together = {f"P4_3_{alike[0]}": alike for alike in journals if len(alike) > 1}
    reactions = ["phi_deg", "Rx_MPa", "Ry_MPa", "R_MPa", "psiR_deg"]
    kinematic = [
        ("P3_1", None, ""),
        ("P3_2", None, ""),
        *([("offset", None, "")] if shape.offset else ()),
        *([("articulated", None, "")] if shape.articulated else ()),
    ]
    forces = [
        ("gas", None, ""),
        ("P4_1", None, ""),
        ("P4_2", None, wide),
        *((key, None, "") for key in _loads(shape)),
        *((f"P4_3_{alike[0]}", reactions, "") for alike in journals),
        *((key, _moments(terms, key), wide) for key in running),
        (rays_table(worst_pin(terms)), None, "dense"),
    ]
    same = repeated(terms, [(key, columns) for key, columns, _ in forces])
    for key, other in same.items():
        chapter.writer.n.stand_for("table", key, other)
    forces = [each for each in forces if each[0] not in same]
    holders = {key: tuple(k for k in same if same[k] == key) for key in same.values()}
    return chapter.page("appendices", kinematic=_plans(chapter, "А", kinematic),
                        forces=_plans(chapter, "Б", forces, together, holders))  # fmt: skip


def _loads(shape: Shape) -> list[str]:
    """Tables of the forces on throws and crankpins."""
    pins = [pin_table(number) for number in range(1, len(shape.pins) + 1)]
    throws = [] if shape.single_rods else [rods_table(k) for k in range(1, shape.throws + 1)]
    return [*throws, *pins]


def _moments(terms: Terms, table: str) -> list[str]:
    """Columns of the running-on tables; the cylinders' own torques stand in П4.2."""
    keys = printed(terms, table, None)
    return [key for key in keys if key == "phi_deg" or key.startswith(("Mmain", "Mpin"))]


def _plans(
    chapter: Chapter,
    letter: str,
    tables: Sequence[tuple[str, list[str] | None, str]],
    together: Mapping[str, tuple[int, ...]] = MappingProxyType({}),
    holders: Mapping[str, tuple[str, ...]] = MappingProxyType({}),
) -> list[tuple[str, TablePlan]]:
    """Tables of an appendix, numbered within it; the textbook's number stands in the title.

    ``together`` are the journals of a table that serves several, ``holders`` the tables that one
    serves beside itself.
    """
    plans = []
    for number, (key, columns, size) in enumerate(tables, 1):
        spec = chapter.model.tables[key]
        build = partial(
            angle_table,
            chapter.terms,
            key,
            columns,
            own_symbols=key in ("gas", "P4_1"),
            step=chapter.printed_step,
        )
        match = _TEXTBOOKS.fullmatch(spec.number)
        served = [chapter.model.tables[other].number for other in holders.get(key, ())]
        numbers = ", ".join([spec.number, *served])
        title = f"{spec.title} ({numbers})" if match else spec.title
        if key in together:  # equal loads are printed once
            title = _JOURNALS.format(
                joined([str(number) for number in together[key]]),
                ", ".join(f"П4.3.{number}" for number in together[key]),
            )
        usual = "" if chapter.whole else "dense"
        plan = TablePlan(build, title, number=f"{letter}.{number}", size=size or usual)
        plans.append((key, plan))
    return plans
