"""Printed tables in the order of the validation book, each with its look-up."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from reports.studies import validation_lookups as lookups
from reports.studies import validation_text as in_text
from reports.studies.validation_checks import (
    Lookup,
    PrintTolerance,
    Table,
    force_cells,
    outputs_of,
    text_of,
    window_cells,
)
from reports.studies.validation_text import Number, by_key

SOURCES: dict[str, str] = {
    "gots": "Гоц А. Н. Кинематика и динамика кривошипно-шатунного механизма поршневых "
    "двигателей: учеб. пособие. — Владимир, 2006",
    "segal": "Сегаль В. Ф. Динамические расчёты двигателей внутреннего сгорания",
    "neiman": "Нейман И. Ш. Динамика авиационных двигателей. — М.: Оборонгиз, 1940",
    "ilchenko": "Ільченко А. В., Кубрак Ю. О., Ломакін В. О. Приведений момент інерції "
    "кривошипно-шатунного механізму одноциліндрового поршневого двигуна, 2011",
    "chudakov": "Чудаков Д. А., Жарнов Э. М. Об уравновешивании тракторных "
    "четырёхцилиндровых дизелей",
    "opentorsion": "Aalto ARotor. openTorsion 0.3.2: тесты и пример ICE_example.py по статье "
    "Mendes A. S., Meirelles P. S., Zampieri D. E., 2008, doi 10.1243/14644193JMBD126",
    "butenschon": "Butenschön H. J. Das hydrodynamische, zylindrische Gleitlager endlicher Breite "
    "unter instationärer Belastung. Karlsruhe, 1976: таблицы (по пересказу в записке)",
    "course": "Курсовая работа по тракторному дизелю: шатунный подшипник 68 × 38 мм "
    "(по пересказу в записке)",
}
SHORT: dict[str, str] = {
    "gots": "Гоц",
    "segal": "Сегаль",
    "neiman": "Нейман",
    "ilchenko": "Ильченко и др.",
    "chudakov": "Чудаков, Жарнов",
    "opentorsion": "openTorsion",
    "butenschon": "Бутеншён",
    "course": "Курсовая работа",
}

_DINN = PrintTolerance(1.5, why="1,5 единицы последнего знака: программа считала с π = 3,14 или "
                  "0,017453 и округляла по пути")  # fmt: skip
_PRINTED = PrintTolerance(1.5, why="1,5 единицы последнего знака: округлялись и слагаемые")
_SUMMED = PrintTolerance(absolute=1.0, why="1 Н·м: складывались округлённые моменты")
_BY_HAND = PrintTolerance(1.0, why="единица последнего знака: ручной счёт")
_FIGURES = "формулы решателя kshm"
_DIESEL = "образец gots-diesel"

_REFERENCE: tuple[tuple[str, str], ...] = (
    ("table_1", "перемещение поршня"),
    ("table_2", "скорость поршня"),
    ("table_3", "ускорение поршня"),
    ("table_5", "tg β"),
    ("table_6", "1/cos β"),
    ("table_7", "sin(φ + β)/cos β"),
    ("table_8", "cos(φ + β)/cos β"),
)


def _text(
    name: str,
    source: str,
    printed_at: str,
    numbers: dict[str, Number],
    *,
    run: str = _FIGURES,
    title: str = "числа в тексте",
    notes: tuple[str, ...] = (),
) -> Table:
    """Numbers of running text, each with its own tolerance."""
    ours: Callable[[], Lookup] = partial(by_key, numbers)
    return Table(name, source, printed_at, title, run, ours, cells=text_of, notes=notes)


TABLES: tuple[Table, ...] = (
    *(
        Table(name, "gots", f"табл. {name.removeprefix('table_')}", title, _FIGURES,
              partial(lookups.reference, name), _PRINTED)
        for name, title in _REFERENCE
    ),
    _text("text_1_2", "gots", "п. 1.2", in_text.SECTION_1_2),
    _text("figure_6", "gots", "рис. 6", in_text.FIGURE_6,
          title="угол наибольшей скорости и её отношение к средней",
          notes=("Рисунок напечатан без чисел; его точки названы в тексте.",)),
    _text("text_1_4", "gots", "п. 1.4", in_text.SECTION_1_4),
    Table("P3_1", "gots", "табл. П3.1", "перемещение, скорость, ускорение поршня",
          "образец gots-p3", partial(lookups.kinematics, "P3_1"), _DINN),
    Table("P3_2", "gots", "табл. П3.2", "угол, угловая скорость, угловое ускорение шатуна",
          "образец gots-p3", partial(lookups.kinematics, "P3_2"), _DINN,
          notes=("Столбцы углового ускорения напечатаны в обратном порядке: под (1) стоит "
                 "приближённое, под (2) — точное. Сверка идёт с переставленными столбцами.",)),
    Table("P4_1", "gots", "табл. П4.1", "удельные силы и момент одного цилиндра", _DIESEL,
          partial(lookups.dynamics, "P4_1"), _DINN,
          notes=("Текст п. 2.9 называет в этой таблице и силу R′ш.ш; столбца с ней нет.",)),
    Table("P4_2", "gots", "табл. П4.2", "крутящие моменты цилиндров и дизеля", _DIESEL,
          partial(lookups.dynamics, "P4_2"), _SUMMED),
    Table("P4_3", "gots", "табл. П4.3", "нагрузка на третью коренную шейку",
          "образец gots-p43, сетка 3°", lookups.third_journal, _DINN,
          notes=("Таблица принадлежит другому расчёту, чем приложение 1: ей отвечают λ = 0,275, "
                 "p_z = 7,5 МПа, ρ = 1,30, p_r = 0,18 МПа; эти данные — в образце gots-p43.",
                 "Метки строк округлены: 10, 20, 40, 50… значат 9, 21, 39, 51… на сетке 3°.",
                 "Строка 110° пропущена; в ней должно стоять −1,588 и −1,212.",
                 "Фазы φ + 240 и φ + 480 — порядка работы 1-3-2 на валу с коленами для 1-2-3; "
                 "согласованные фазы дают наибольшую нагрузку 3,580 МПа при 132°.")),
    Table("P4_4", "gots", "табл. П4.4", "набегающие моменты на коренные шейки", _DIESEL,
          partial(lookups.dynamics, "P4_4"), _SUMMED),
    Table("P4_5", "gots", "табл. П4.5", "набегающие моменты на шатунные шейки", _DIESEL,
          partial(lookups.dynamics, "P4_5"), _SUMMED,
          notes=("Над третьим столбцом напечатано Mк.ш2 + 0,5M3ц; числа посчитаны с Mк.ш3.",)),
    Table("table_14", "gots", "табл. 14", "лучи, на которые действует сила, и суммы по лучам",
          "окна ±60° и суммы (kshm.mechanics.wear) для напечатанных сил", lookups.wear_windows,
          cells=window_cells,
          notes=("Силы взяты напечатанные: проверяется, на какие лучи попадает каждая и какие "
                 "суммы получаются. Пустая клетка печати проверяется тоже: там силы быть "
                 "не должно.",)),
    Table("table_14_forces", "gots", "табл. 14, силы", "нагрузка на шатунную шейку",
          _DIESEL, lookups.pin_forces, cells=lambda _name: force_cells("table_14"),
          notes=("Силы таблицы 14 принадлежат другому двигателю, чем приложение 1.",)),
    _text("text_2_9", "gots", "п. 2.9", in_text.SECTION_2_9,
          run="образцы gots-p3, gots-diesel, gots-p43 и листинг приложения 2",
          notes=("Массы и силы перемножены округлёнными, моменты П4.5 сложены из округлённых: "
                 "там допуск 1…3,5 единицы последнего знака.",)),
    _text("app1", "gots", "прил. 1", in_text.APPENDIX_1, title="данные, спорящие с таблицами",
          run="данные образца gots-diesel, по которым получается П4.1",
          notes=("Угол внешних противовесов 210° читается от соседнего кривошипа, на носке по "
                 "вращению, у маховика против него: так пара гасит момент трёх колен.",)),
    Table("app2_outputs", "gots", "прил. 2, результаты", "расчёт цикла",
          "расчёт цикла в режиме листинга; подобраны ψ = 1,0784 и n₂ = 1,227745",
          lookups.cycle_outputs, cells=outputs_of,
          notes=("Без двух подобранных чисел с печатью совпадают 27 из 34.",)),
    Table("app2_diagram", "gots", "прил. 2, диаграмма", "индикаторная диаграмма",
          "расчёт цикла в режиме листинга", lookups.cycle_diagram,
          PrintTolerance({"volume_dm3": 0.505, "": 0.5}, why="половина последнего знака; "
                    "V(180°) = 0,60535 округляется в обе стороны"),
          notes=("Столбец давления сведён из разных расчётов; по политропам самого листинга "
                 "посчитаны только 200, 350, 360…380, 410 и 450°.",)),
    Table("segal_t2", "segal", "табл. 2", "угол β", _FIGURES, lookups.segal_angles, _BY_HAND),
    Table("segal_t3", "segal", "табл. 3", "перемещение поршня, точно", _FIGURES,
          lookups.segal_displacements, _BY_HAND),
    _text("segal_text", "segal", "текст", in_text.SEGAL),
    Table("neiman_t1", "neiman", "табл. 1", "коэффициенты ряда", _FIGURES,
          lookups.neiman_multiples, _BY_HAND,
          notes=("В (21) показатели степени λ на единицу больше верных; (20) верна.",)),
    Table("neiman_t2", "neiman", "табл. 2", "коэффициенты скорости", _FIGURES,
          lookups.neiman_multiples, _BY_HAND,
          notes=("При 1/λ = 3,4 напечатано 8p₈ = 0,000008466: лишняя восьмёрка вместо нуля.",)),
    Table("neiman_t3", "neiman", "табл. 3", "наибольшая скорость", _FIGURES,
          lookups.neiman_speeds, _BY_HAND),
    Table("neiman_t4", "neiman", "табл. 4", "коэффициенты ускорения", _FIGURES,
          lookups.neiman_multiples, _BY_HAND),
    _text("neiman_text", "neiman", "текст", in_text.NEIMAN),
    _text("ilchenko_text", "ilchenko", "текст", in_text.ILCHENKO,
          notes=("(32), (33): d² по размерности — масса; для момента инерции нужно d⁴.",)),
    _text("chudakov_text", "chudakov", "текст", in_text.CHUDAKOV,
          run="формулы решателя kshm и образец d-240"),
    _text("torsion_discs", "opentorsion", "тесты", in_text.DISCS,
          title="частоты крутильных колебаний двух дисков"),
    _text("torsion_mwm", "opentorsion", "пример", in_text.MWM, run="образец mwm-6 и решатель kshm",
          title="частоты крутильных колебаний дизеля MWM",
          notes=("Пример частот не печатает: это числа, которые даёт сама программа для его "
                 "данных, с четырьмя знаками.",)),
    _text("oil_film", "butenschon", "таблицы", in_text.FILM,
          title="силы масляной плёнки при B/D = 1/2",
          notes=("SoD и β — формулы, приближающие таблицы: допуск — наибольшее отличие формул от "
                 "всех таблиц, 6,8 % и 2,4°; SoV — решение уравнения Рейнольдса, допуск 0,5 %.",)),
    _text("oil_pressure", "course", "текст", in_text.PRESSURE,
          title="среднее давление на подшипник"),
)  # fmt: skip


def table(name: str) -> Table:
    """Return a table by its id.

    Raises:
        KeyError: There is none.
    """
    return {one.id: one for one in TABLES}[name]
