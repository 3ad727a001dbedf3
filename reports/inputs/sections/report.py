"""The [report] section of the input file: who, for whom, and how the report is set."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated, Literal

from pydantic import Field

from reports.inputs.meta import Strictly, choice, number, text
from reports.inputs.units import NONE

DETAILS = {"full": "все строки таблиц", "short": "каждая третья строка"}
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
        "Расчет кинематики и динамики кривошипно-шатунного механизма"
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
    detail: Annotated[
        Literal["full", "short"], choice("Таблицы в отчёте", DETAILS, structural=False)
    ] = "full"
    templates: Annotated[str, text("Папка со своими шаблонами отчёта")] = ""
