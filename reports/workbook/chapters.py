"""Sheets by chapters: their order, the colours of their tabs, their headings.

A sheet is known by the beginning of its title: numbers of journals and regimes follow.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

from reports.spec.blocks import Block

_REGIME = re.compile(r" р(\d+)$")
_NUMBER = re.compile(r" \((?P<a>\d+)\)$|(?<=[а-я]) (?P<b>\d+)$")


@dataclass(frozen=True, slots=True)
class Chapter:
    """Title, colour of the tabs, sheets with their headings in order.

    ``smooth`` says that its curves over the angle have no corners.
    """

    title: str
    colour: str
    sheets: tuple[tuple[str, str], ...]
    smooth: bool = False


CHAPTERS = (
    Chapter("Двигатель", "1F3864", (
        ("Исходные данные", "Исходные данные"),
        ("Что если", "Что изменится: выданные данные и изменённые"),
        ("Механизм", "Механизм, силы и диаграммы при выбранном угле"),
        ("Схема", "Схема двигателя: колена, ряды, порядок работы"),
        ("Массы", "Размеры, массы и постоянные силы инерции"),
        ("Массы шатуна", "Массы шатуна и щёк, удельные массы"),
    )),
    Chapter("Итоги", "C00000", (
        ("Итоги", "Итоги расчёта: момент, нагрузки шеек"),
        ("Проверки", "Проверки расчёта"),
        ("Режимы", "Режимы двигателя: сравнение"),
        ("Режимы, силы", "Режимы двигателя: крайние значения сил"),
    )),
    Chapter("Рабочий цикл", "BF8F00", (
        ("Цикл", "Расчет рабочего цикла"),
        ("Правдоподобие цикла", "Правдоподобие рабочего цикла"),
        ("ВСХ", "Внешняя скоростная характеристика"),
        ("Диаграмма цикла", "Диаграмма расчётного цикла"),
        ("Газы", "Индикаторная диаграмма"),
        ("Точки диаграммы", "Точки индикаторной диаграммы"),
    )),
    Chapter("Кинематика", "2E75B6", (
        ("П3.1", "Перемещение, скорость и ускорение поршня"),
        ("П3.2", "Угловое перемещение, скорость и ускорение шатуна"),
        ("Дезаксиал", "Смещённый механизм"),
        ("Прицепной шатун", "Прицепной шатун"),
    ), smooth=True),
    Chapter("Силы и моменты", "548235", (
        ("П4.1", "Силы и момент одного цилиндра"),
        ("Цилиндры", "Силы в остальных цилиндрах"),
        ("П4.2", "Крутящий момент двигателя"),
        ("П4.4", "Набегающие моменты на коренные шейки"),
        ("П4.5", "Набегающие моменты на шатунные шейки"),
    )),
    Chapter("Шейки и подшипники", "7030A0", (
        ("Колено", "Силы двух шатунов на колене"),
        ("Колена", "Центробежные силы колен и реакции опор от них"),
        ("Шатунная шейка", "Нагрузки на шатунную шейку"),
        ("П4.3", "Нагрузки на коренную шейку"),
        ("Фазы П4.3", "Нагрузки на шейку при заданных фазах сил"),
        ("Износ ш.ш", "Износ шатунной шейки"),
        ("Износ к.ш", "Износ коренной шейки"),
        ("Шатунный подшипник", "Нагрузка на шатунный подшипник"),
        ("Изгиб шейки", "Изгиб шатунной шейки"),
        ("Неразрезная схема", "Реакции опор неразрезного вала"),
        ("Схемы опор", "Разрезная и неразрезная схемы вала"),
    )),
    Chapter("Уравновешивание", "C55A11", (
        ("Уравновешивание", "Свободные силы и моменты двигателя"),
        ("Уравновешивание, итоги", "Уравновешивание: суммы, противовесы, балансирные валы"),
        ("Порядки сил", "Свободные силы и моменты по порядкам"),
        ("Порядки работы", "Порядки работы, возможные при этом вале"),
        ("Векторы сил инерции", "Силы инерции первого и второго порядков"),
        ("Момент инерции", "Приведённый момент инерции и ход за цикл"),
        ("Маховик", "Неравномерность хода и маховик"),
        ("Модель шатуна", "Шатун по основным размерам двигателя"),
        ("Гармоники момента", "Гармоники крутящего момента"),
        ("Гармоники момента, итоги", "Гармонические коэффициенты момента"),
        ("Гашение 2-го порядка", "Гашение второго порядка момента"),
    ), smooth=True),
    Chapter("Крутильные колебания", "00808A", (
        ("Крутильная схема", "Крутильная схема вала"),
        ("Крутильные итоги", "Крутильные колебания: частоты, резонансы, гаситель"),
        ("Крутильные формы", "Формы крутильных колебаний"),
        ("Резонансы", "Критические частоты вращения и резонансы"),
        ("Звезда фаз", "Звёзды фаз первой формы"),
        ("Диаграмма Кэмпбелла", "Диаграмма Кэмпбелла"),
        ("Вынужденные колебания", "Вынужденные колебания: значения, посчитанные при сборке"),
        ("Крутильная частота", "Частота делением отрезка пополам: форма"),
        ("Частоты вариантов", "Первая частота с другим маховиком и другими жёсткостями"),
        ("Момент по порядкам", "Моменты газовых сил и сил инерции цилиндра 1"),
    )),
    Chapter("Точность формул", "7F7F7F", (
        ("Погрешность", "Погрешность двучленных формул"),
        ("Погрешность, итоги", "Наибольшие погрешности двучленных формул"),
        ("Точность формул", "Точные и приближённые формулы движения поршня"),
        ("Точность формул, итоги", "Погрешности приближений и крайние ускорения"),
        ("Гармоники движения", "Гармоники движения поршня и шатуна"),
        ("Гармоники движения, ряд", "Коэффициенты ряда при λ двигателя"),
        ("Движение поршня по λ", "Движение поршня и его гармоники"),
        ("Скорость поршня по λ", "Наибольшая скорость поршня при разных λ"),
        ("Построение скорости", "Графическое определение скорости поршня"),
        ("Таблицы кинематики", "Значения тригонометрических выражений кинематики"),
        ("Таблицы сил", "Значения тригонометрических выражений сил"),
    ), smooth=True),
)  # fmt: skip
OTHER = Chapter("Прочее", "404040", ())
DIAGRAMS = "Диаграммы"


@lru_cache(maxsize=512)
def place_of(sheet: str) -> tuple[int, int, int, int]:
    """Where a sheet stands: chapter, place in it, regime, number of the journal."""
    regime = _REGIME.search(sheet)
    base = _REGIME.sub("", sheet)
    number = _NUMBER.search(base)
    name = base if number is None else _NUMBER.sub("", base)
    order = (int(regime[1]) if regime else 0, int(number["a"] or number["b"]) if number else 0)
    for chapter, about in enumerate(CHAPTERS):
        if base == diagrams_of(about):
            return chapter, -1, *order
        for place, (title, _) in enumerate(about.sheets):
            if name == title:
                return chapter, place, *order
    return len(CHAPTERS), 0, *order


def chapter_of(sheet: str) -> Chapter:
    """The chapter of a sheet."""
    return (*CHAPTERS, OTHER)[place_of(sheet)[0]]


def ordered(sheets: Iterable[str]) -> list[str]:
    """Sheets by chapters; those of further regimes behind all of the first."""
    return sorted(sheets, key=lambda s: (place_of(s)[2], *place_of(s)))


def diagrams_of(chapter: Chapter) -> str:
    """The sheet of the chapter's charts that have no room beside their tables."""
    return f"{DIAGRAMS}, {chapter.title[0].lower()}{chapter.title[1:]}"[:31]


def heading(sheet: str, blocks: Sequence[Block] = ()) -> str:
    """What stands above a sheet and in the contents."""
    chapter, place, regime, number = place_of(sheet)
    if chapter == len(CHAPTERS):
        return blocks[0].title if blocks else sheet
    if place < 0:
        return f"{DIAGRAMS}: {CHAPTERS[chapter].title[0].lower()}{CHAPTERS[chapter].title[1:]}"
    text = CHAPTERS[chapter].sheets[place][1]
    text += f" {number}" if number else ""
    return text + (f", режим {regime}" if regime else "")
