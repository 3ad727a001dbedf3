"""Frame of the sheet and its title block, form 1 of ГОСТ 2.104."""

from __future__ import annotations

from reports.drawing.lettering import fitted, wrapped
from reports.drawing.primitives import FRAME, THIN, Canvas
from reports.inputs.sections.input_file import InputFile
from reports.shared.russian import surname

WIDTH, HEIGHT = 185.0, 55.0
MARGINS = (20.0, 5.0, 5.0, 5.0)  # left, right, top, bottom of the frame
_COLUMNS = (0.0, 7.0, 17.0, 40.0, 55.0, 65.0)
_HEADS = ("Изм.", "Лист", "№ докум.", "Подп.", "Дата")
_NAME = (65.0, 135.0)
_LEAST = 1.0  # height of letters
_READABLE = 2.0  # of a name; one that would be smaller leaves the surname alone


def frame(canvas: Canvas, width: float, height: float) -> None:
    """Outer edge and frame."""
    canvas.box(0, 0, width, height, THIN)
    left, right, top, bottom = MARGINS
    canvas.box(left, bottom, width - right, height - top, FRAME)


def title_block(canvas: Canvas, model: InputFile, left: float, low: float) -> None:
    """Form 1 with its lower left corner at a place."""
    report = model.report

    def line(x1: float, y1: float, x2: float, y2: float, *, thick: bool = True) -> None:
        layer = FRAME if thick else THIN
        canvas.line((left + x1, low + y1), (left + x2, low + y2), layer=layer)

    def cell(text: str, box: tuple[float, float, float, float], most: float = 2.5) -> None:
        x1, y1, x2, y2 = box
        room = x2 - x1 - 1
        height = most
        lines = wrapped(text, room, height, hyphens=True)
        while (len(lines) * 1.7 * height > y2 - y1) and height > _LEAST:
            height -= 0.25
            lines = wrapped(text, room, height, hyphens=True)
        y = (y1 + y2) / 2 + (len(lines) * 1.7 * height) / 2 - 1.4 * height
        for words in lines:
            size = fitted(words, room, height, 0.5)
            canvas.words((left + (x1 + x2) / 2, low + y), words, size, align=0.5)
            y -= 1.7 * height

    canvas.box(left, low, left + WIDTH, low + HEIGHT, FRAME)
    for x in (17.0, 40.0, 55.0, 65.0):
        line(x, 0, x, HEIGHT)
    line(7, 30, 7, HEIGHT)
    for row in range(1, 11):
        y = 5.0 * row
        line(0, y, 65, y, thick=row in (6, 7))
    for number, word in enumerate(_HEADS):
        cell(word, (_COLUMNS[number], 30, _COLUMNS[number + 1], 35))
    people = (("Разраб.", report.student), ("Пров.", report.supervisor), ("Т. контр.", ""),
              ("", ""), ("Н. контр.", report.controller),
              ("Утв.", report.approver or report.head))  # fmt: skip
    for row, (post, name) in enumerate(people):
        y = 25.0 - 5.0 * row
        cell(post, (0, y, 17, y + 5))
        small = fitted(name, 22, 2.5) < _READABLE
        cell(surname(name) if small else name, (17, y, 40, y + 5))
    line(65, 40, WIDTH, 40)
    line(65, 15, WIDTH, 15)
    line(135, 0, 135, 40)
    line(135, 35, WIDTH, 35)
    line(135, 20, WIDTH, 20)
    for x in (150.0, 167.0):
        line(x, 20, x, 40)
    line(155, 15, 155, 20)
    for x in (140.0, 145.0):
        line(x, 20, x, 35, thick=False)
    for word, x1, x2 in (("Лит.", 135, 150), ("Масса", 150, 167), ("Масштаб", 167, 185)):
        cell(word, (x1, 35, x2, 40))
    cell("Лист", (135, 15, 155, 20))
    cell("Листов 1", (155, 15, WIDTH, 20))
    cell("У", (140, 20, 145, 35), 3.5)
    cell(report.designation, (65, 40, WIDTH, 55), 5.0)
    cell(f"Динамический расчёт двигателя. {model.engine.name}", (*_NAME[:1], 15, _NAME[1], 40), 5.0)
    places = (report.institution, report.department, report.group)
    cell(", ".join(filter(None, places)), (135, 0, WIDTH, 15), 3.5)
