"""Error values of a student's cells, as Excel in Russian calls them."""

from __future__ import annotations

from reports.grading.issuing.assignment import Item
from reports.grading.reading.student import Student

_ERRORS = {
    "#DIV/0!": "#ДЕЛ/0! — деление на ноль", "#N/A": "#Н/Д — значение не найдено",
    "#VALUE!": "#ЗНАЧ! — в вычислении текст", "#REF!": "#ССЫЛКА! — ссылка на удалённую ячейку",
    "#NUM!": "#ЧИСЛО! — вычислить нельзя", "#NAME?": "#ИМЯ? — неизвестное имя",
    "#CIRC!": "круговая ссылка", "#NULL!": "#ПУСТО! — области не пересекаются",
}  # fmt: skip


def shown_errors(item: Item, student: Student) -> str:
    """Which error values stand in the cells."""
    found: dict[str, None] = {}
    for node in item.nodes:
        place = student.placement.places.get(node)
        for row in place.rows if place is not None else ():
            if place is not None and row is not None:
                text = student.engine.shown(place.sheet, place.column, row)
                if isinstance(text, str) and text.startswith("#"):
                    found.setdefault(_ERRORS.get(text, text))
    return ", ".join(found)
