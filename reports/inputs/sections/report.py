"""The [report] section of the input file: who, for whom, and how the report is set."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated, Literal

from pydantic import Field, Strict

from reports.inputs.meta import Strictly, choice, number, text
from reports.inputs.units import NONE

DETAILS = {
    "course": "главы курсового проекта, таблицы через 30°",
    "full": "все главы, все строки таблиц",
    "short": "расчёт до коренных шеек с выводами, без приложений",
}
# Chapters that a report may do without; the introduction, the input data, the conclusion and
# the sources always stand.
CHAPTERS = {
    "cycle": "рабочий цикл",
    "kinematics": "кинематика",
    "dynamics": "динамика",
    "torque": "крутящий момент",
    "crankpin": "шатунная шейка",
    "journals": "коренные шейки",
    "bearings": "подшипники и изгиб вала",
    "running": "набегающие моменты",
    "torsion": "крутильные колебания",
    "oil": "масляная плёнка и прочность шеек",
    "regimes": "сравнение режимов",
    "reference": "точность формул и справочные зависимости",
    "companions": "уравновешенность, ход, гармоники",
    "checks": "проверка результатов",
    "appendices": "таблицы по углу поворота",
}
Detail = Literal["course", "full", "short"]
ChapterName = Literal[
    "cycle", "kinematics", "dynamics", "torque", "crankpin", "journals", "bearings", "running",
    "torsion", "oil", "regimes", "reference", "companions", "checks", "appendices",
]  # fmt: skip
FORMATS = {
    "xlsx": "книга Excel",
    "pdf": "отчёт PDF",
    "html": "отчёт HTML",
    "docx": "записка Word",
    "sheet": "лист динамики: PDF и DXF",
}
Format = Literal["xlsx", "pdf", "html", "docx", "sheet"]
USUAL_FORMATS: tuple[Format, ...] = ("xlsx", "pdf")
FILE_KEYS = ("style", "templates", "compare")  # what names files of the machine
FRAMES = {"none": "без рамки", "eskd": "рамка и основная надпись по ГОСТ 2.104"}


def _this_year() -> int:
    return datetime.now(tz=UTC).year


class Report(Strictly):
    """[report]: title page, assignment sheet, title block, manner of setting."""

    student: Annotated[str, text("Студент")] = ""
    group: Annotated[str, text("Группа")] = ""
    institution: Annotated[str, text("Учебное заведение")] = ""
    department: Annotated[str, text("Кафедра")] = ""
    supervisor: Annotated[str, text("Руководитель")] = ""
    variant: Annotated[str, text("Вариант")] = ""
    year: Annotated[int, number("Год", "", NONE, 1950, 2150)] = Field(default_factory=_this_year)
    city: Annotated[str, text("Город")] = ""
    title: Annotated[str, text("Тема работы")] = (
        "Расчёт кинематики и динамики кривошипно-шатунного механизма"
    )
    compare: Annotated[str, text("Сравнить с двигателями: файлы через точку с запятой")] = ""
    discipline: Annotated[str, text("Дисциплина")] = ""
    issued: Annotated[str, text("Дата выдачи задания")] = ""
    due: Annotated[str, text("Срок сдачи работы")] = ""
    head: Annotated[str, text("Заведующий кафедрой")] = ""
    designation: Annotated[str, text("Обозначение документа")] = ""
    controller: Annotated[str, text("Нормоконтроль")] = ""
    approver: Annotated[str, text("Утвердил")] = ""
    frame: Annotated[
        Literal["none", "eskd"], choice("Рамка листов отчёта", FRAMES, structural=False)
    ] = "none"
    detail: Annotated[Detail, choice("Объём отчёта", DETAILS, structural=False)] = "course"
    chapters: Annotated[
        tuple[Annotated[ChapterName, choice("Глава отчёта {n}", CHAPTERS, structural=False)], ...]
        | None,
        Strict(False),
    ] = None
    formats: Annotated[
        tuple[Annotated[Format, choice("Документ {n}", FORMATS, structural=False)], ...] | None,
        Strict(False),
    ] = None
    style: Annotated[str, text("Файл оформления кафедры")] = ""
    templates: Annotated[str, text("Папка со своими шаблонами отчёта")] = ""
