"""Sections that change no number: [report], [sheet], [workbook], [reference], [checks]."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated, Literal

from pydantic import Field, Strict

from reports.inputs.meta import Meta, StrictModel, choice, number, text
from reports.inputs.units import DEG, NONE

DETAILS = {
    "course": "главы курсового проекта, таблицы через 30°",
    "full": "все главы, все строки таблиц",
    "short": "расчёт до коренных шеек с проверкой и выводами, без приложений",
}
# Titles of the chapters that a report may do without; the introduction, the input data, the
# conclusion and the sources always stand.
CHAPTERS = {
    "rationale": "Обоснование исходных данных",
    "cycle": "Расчёт рабочего цикла",
    "kinematics": "Кинематика кривошипно-шатунного механизма",
    "dynamics": "Динамика кривошипно-шатунного механизма",
    "torque": "Крутящий момент двигателя",
    "crankpin": "Нагрузка на шатунную шейку",
    "journals": "Нагрузки на коренные шейки",
    "bearings": "Подшипники и изгиб вала",
    "running": "Набегающие моменты",
    "balance": "Уравновешенность и ход двигателя",
    "counterweights": "Подбор противовесов",
    "torsion": "Крутильные колебания вала",
    "oil": "Масляная плёнка подшипников и прочность шеек",
    "strength": "Прочность деталей",
    "own": "Расчёты из своих книг",
    "regimes": "Сравнение режимов работы",
    "reference": "Точность формул и справочные зависимости",
    "companions": "Гармоники момента и точное движение поршня",
    "checks": "Проверка результатов",
    "appendices": "Таблицы по углу поворота",
}
Detail = Literal["course", "full", "short"]
ChapterName = Literal[
    "rationale", "cycle", "kinematics", "dynamics", "torque", "crankpin", "journals", "bearings",
    "running", "balance", "counterweights", "torsion", "oil", "strength", "own", "regimes",
    "reference", "companions", "checks",
    "appendices",
]  # fmt: skip
FORMATS = {
    "xlsx": "книга Excel",
    "pdf": "отчёт PDF",
    "html": "отчёт HTML",
    "docx": "записка Word",
    "sheet": "лист динамики: PDF и DXF",
    "live": "живая страница",
}
Format = Literal["xlsx", "pdf", "html", "docx", "sheet", "live"]
USUAL_FORMATS: tuple[Format, ...] = ("xlsx", "pdf")
FILE_KEYS = ("style", "templates", "compare")  # what names files of the machine
FRAMES = {"none": "без рамки", "eskd": "рамка и основная надпись по ГОСТ 2.104"}
DIAGRAMS = {
    "pv": "индикаторная диаграмма свёрнутая",
    "p_phi": "индикаторная диаграмма развёрнутая",
    "forces": "удельные силы газов, инерции, суммарная",
    "side": "силы N и S",
    "crank": "силы K и T",
    "torque": "суммарный крутящий момент со средним",
    "pin_polar": "полярная диаграмма шатунной шейки",
    "pin_load": "развёрнутая нагрузка на шатунную шейку",
    "pin_wear": "диаграмма износа шатунной шейки",
    "main_polar": "полярная диаграмма коренной шейки",
    "main_load": "развёрнутая нагрузка на коренную шейку",
    "main_wear": "диаграмма износа коренной шейки",
    "shaft": "схема вала, звезда колен, порядок работы",
    "balance": "схема уравновешивания",
    "running": "таблица набегающих моментов",
    "results": "основные результаты",
    "throw": "колено вала с размерами",
    "mechanism": "механизм с размерами",
    "counterweight": "противовес щеки с размерами",
    "torsion": "напряжения вала от крутильных колебаний",
    "strength": "запасы прочности и напряжения деталей",
    "speed": "внешняя характеристика с регуляторной ветвью",
    "flywheel": "маховик с размерами",
}
Diagram = Literal[
    "pv", "p_phi", "forces", "side", "crank", "torque", "pin_polar", "pin_load", "pin_wear",
    "main_polar", "main_load", "main_wear", "shaft", "balance", "running", "results",
    "throw", "mechanism", "counterweight", "torsion", "strength", "speed", "flywheel",
]  # fmt: skip
USUAL = ("pv", "p_phi", "forces", "side", "crank", "torque", "pin_polar", "pin_load", "pin_wear",
         "main_wear", "shaft", "balance", "running", "results", "throw", "counterweight", "torsion",
         "strength", "speed", "flywheel", "main_polar")  # fmt: skip
SHEETS = {"A1": "A1, 841 × 594 мм", "A2": "A2, 594 × 420 мм"}
WAYS = {"landscape": "альбомная", "portrait": "книжная"}
SHEET_SETS = {"course": "листы курсового проекта", "full": "все листы"}
MAX_LAMBDAS = 12
BOOK_LAMBDAS = tuple(round(1 / value, 6) for value in (3.2, 3.4, 3.6, 3.8, 4.0, 4.2))
# Checks of the calculation, besides the keys of the file that `check` warns of.
CHECKS = (
    "supports", "virtual", "work", "lam", "phases", "symmetry", "cycle_rho", "cycle_pz", "cycle_Tr",
    "power", "share",
)  # fmt: skip


def _this_year() -> int:
    return datetime.now(tz=UTC).year


class ReportSection(StrictModel):
    """[report]: title page, assignment sheet, title block, manner of setting."""

    student: str = text("Студент", "")
    group: str = text("Группа", "")
    institution: str = text("Учебное заведение", "")
    department: str = text("Кафедра", "")
    supervisor: str = text("Руководитель", "")
    variant: str = text("Вариант", "")
    year: Annotated[int, Meta("Год", "", NONE, 1950, 2150)] = Field(default_factory=_this_year)
    city: str = text("Город", "")
    title: str = text("Тема работы", "Расчёт кинематики и динамики кривошипно-шатунного механизма")
    compare: str = text("Сравнить с двигателями: файлы через точку с запятой", "")
    discipline: str = text("Дисциплина", "")
    issued: str = text("Дата выдачи задания", "")
    due: str = text("Срок сдачи работы", "")
    head: str = text("Заведующий кафедрой", "")
    designation: str = text("Обозначение документа", "")
    controller: str = text("Нормоконтроль", "")
    approver: str = text("Утвердил", "")
    frame: Literal["none", "eskd"] = choice("Рамка листов отчёта", FRAMES, "none")
    detail: Detail = choice("Объём отчёта", DETAILS, "course")
    chapters: tuple[ChapterName, ...] | None = choice("Глава отчёта {n}", CHAPTERS, None)
    formats: tuple[Format, ...] | None = choice("Документ {n}", FORMATS, None)
    style: str = text("Файл оформления кафедры", "")
    templates: str = text("Папка со своими шаблонами отчёта", "")
    books: tuple[str, ...] | None = text("Своя книга {n}", None)


class SheetSection(StrictModel):
    """[sheet]: size of the sheet and what stands on it."""

    size: Literal["A1", "A2"] = choice("Формат листа", SHEETS, "A1")
    orientation: Literal["landscape", "portrait"] = choice("Ориентация листа", WAYS, "landscape")
    diagrams: tuple[Diagram, ...] | None = choice("Лист: место {n}", DIAGRAMS, None)


class WorkbookSection(StrictModel):
    """[workbook]: which sheets the Excel workbook has."""

    sheets: Literal["course", "full"] = choice(
        "Листы книги Excel", SHEET_SETS, "course", structural=True
    )


class ReferenceSection(StrictModel):
    """[reference]: with it come the sheets of tables 1-3 and 5-8 and figures 3-10."""

    lambdas: tuple[float, ...] = number(
        "Значение λ № {n}", "λ_{n}", NONE, 0.01, 0.7, BOOK_LAMBDAS, solver="reference_lambdas"
    )
    angle_deg: float = number(
        "Угол кривошипа на схемах рисунков 5 и 9", "φ", DEG, 5, 175, 50.0, solver="reference_angle"
    )


class AcceptedEntry(StrictModel):
    """[[checks.accepted]]: a check or a key, and why its failure or oddity is right."""

    what: str = text("Принято {n}: проверка или ключ")
    reason: str = text("Принято {n}: причина")


class ChecksSection(StrictModel):
    """[checks]."""

    accepted: Annotated[tuple[AcceptedEntry, ...], Strict(False)]
