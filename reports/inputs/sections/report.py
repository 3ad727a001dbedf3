"""The [report] section of the input file: who, for whom, and how the report is set."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated, Literal

from pydantic import Field

from reports.inputs.meta import Meta, Strictly, choice, text
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
    "balance": "уравновешенность и маховик",
    "torsion": "крутильные колебания",
    "oil": "масляная плёнка и прочность шеек",
    "regimes": "сравнение режимов",
    "reference": "точность формул и справочные зависимости",
    "companions": "гармоники момента, точное движение поршня",
    "checks": "проверка результатов",
    "appendices": "таблицы по углу поворота",
}
Detail = Literal["course", "full", "short"]
ChapterName = Literal[
    "cycle", "kinematics", "dynamics", "torque", "crankpin", "journals", "bearings", "running",
    "balance", "torsion", "oil", "regimes", "reference", "companions", "checks", "appendices",
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


class ReportSection(Strictly):
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
