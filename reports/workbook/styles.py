"""Cell styles of the workbook; the legend on the contents sheet explains the colours."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Any

from openpyxl.cell.cell import Cell
from openpyxl.styles import Alignment, Border, Font, NamedStyle, PatternFill, Protection, Side
from openpyxl.workbook import Workbook
from openpyxl.worksheet.worksheet import Worksheet

from kshm.nomenclature.quantity import Quantity

FONT, SIZE = "Arial", 10  # Liberation Sans and others have its widths
# As the gallery of cell styles shows them.
INPUT, STRUCTURE, FORMULA, HELPER = (
    "КШМ исходное", "КШМ строение", "КШМ формула", "КШМ вспомогательное",
)  # fmt: skip
HEADER, NUMBER, TITLE, NOTE, TEXT, LINK = (
    "КШМ шапка", "КШМ номер столбца", "КШМ заголовок", "КШМ пояснение", "КШМ текст", "КШМ ссылка",
)  # fmt: skip
SUBTITLE, CHECK, ANSWER, LINE, UNIT = (
    "КШМ подзаголовок", "КШМ проверка", "КШМ ответ", "КШМ строка", "КШМ единица",
)  # fmt: skip

LEGEND = (
    (INPUT, "исходные данные: эти ячейки можно менять, всё остальное пересчитается"),
    (STRUCTURE, "строение расчёта (число цилиндров, шаг, источник данных): изменение вступит "
                "в силу после команды kshm build с этой книгой"),
    (FORMULA, "формула"),
    (HELPER, "вспомогательная формула: нужна другим формулам или диаграмме"),
    (HEADER, "заголовок; в примечании — смысл величины и номер формулы"),
)  # fmt: skip

# Number format of what a check measures, from what size on.
_FEW, _FORMATS = "0.00##", ((100, "0.0"), (10, "0.00"))
_MAX_DIGITS = 6  # significant digits of a typed number that count for its decimals
_TITLES_ROW = 3  # of tables side by side
_SIZES = {TITLE: 14, SUBTITLE: 11}
_COLOURS = {
    INPUT: "FFF2CC",
    STRUCTURE: "F8CBAD",
    HELPER: "F2F2F2",
    HEADER: "F2F2F2",
    ANSWER: "E2EFDA",
}


def wrong() -> dict[str, Any]:
    """How a conditional format shows what is not in order."""
    return {"font": Font(bold=True, color="9C0006"), "fill": PatternFill(bgColor="FFC7CE")}


def odd() -> dict[str, Any]:
    """How a conditional format shows what is only unusual."""
    return {"font": Font(color="7F6000"), "fill": PatternFill(bgColor="FFEB9C")}


def outdated() -> dict[str, Any]:
    """How a conditional format shows results that a change has left behind."""
    return {"font": Font(color="A6A6A6"), "fill": PatternFill(bgColor="EDEDED")}


def excel_format(quantity: Quantity, decimals: int = 0) -> str:
    """Number format of the cells of a quantity; ``decimals`` are those of others above it."""
    digits = quantity.digits
    plain = "0." + "0" * digits.decimals if digits.decimals else "0"
    if digits.kind != "fixed":
        return {"scientific": plain + "E+00", "text": "@"}[digits.kind]
    plain += _blank(digits.decimals, decimals)
    return {"": plain, "zeros": f"{plain};-{plain};", "unused": plain}[digits.hides]


def typed_format(value: object, decimals: int) -> str:
    """Number format of a cell that a person changes: all digits, the point below that of others."""
    return "General" + _blank(decimals_of([value]), decimals)


def few_digits(value: float) -> str:
    """Return the number format with as many digits as a value of this size needs."""
    if value.is_integer():
        return "General"
    return next((look for size, look in _FORMATS if abs(value) >= size), _FEW)


def _blank(digits: int, decimals: int) -> str:
    """Blank space as wide as the point and the decimals that a number has not."""
    return ("" if digits else "_.") + "_0" * (decimals - digits) if decimals > digits else ""


def decimals_of(numbers: Iterable[object]) -> int:
    """Most decimals of quantities and values one above another, whose points stand in a line."""
    return max(map(_decimals, numbers), default=0)


def _decimals(number: object) -> int:
    if isinstance(number, Quantity):
        return number.digits.decimals if number.digits.kind == "fixed" else 0
    text = f"{number:.{_MAX_DIGITS}g}" if isinstance(number, float) else ""
    return 0 if "e" in text else len(text.partition(".")[2])


def blanks(quantity: Quantity, decimals: int) -> int:
    """Letters of blank space behind a number that has fewer decimals than others above it."""
    digits = quantity.digits.decimals
    return len(_blank(digits, decimals)) // 2 if quantity.digits.kind == "fixed" else 0


def as_text(cell: Cell) -> Cell:
    """Return a person's text stays text even where it looks like a formula."""
    if isinstance(cell.value, str):
        cell.data_type = "s"
    return cell


def add_styles(book: Workbook) -> None:
    """Register all named styles in a workbook."""
    rule = Border(bottom=Side(style="thin", color="E4E4E4"))
    under = Border(bottom=Side(style="medium", color="595959"))
    centre = Alignment(horizontal="center", vertical="center", wrap_text=True)

    def style(name: str, **parts: object) -> None:
        named = NamedStyle(name=name)
        colour = _COLOURS.get(name)
        # On a light fill the letters stay dark where a program turns its own to white.
        named.font = Font(name=FONT, size=SIZE, color="000000" if colour else None)
        if colour:
            named.fill = PatternFill("solid", fgColor=colour)
        for key, value in parts.items():
            setattr(named, key, value)
        book.add_named_style(named)

    unlocked = Protection(locked=False)
    middle = Alignment(vertical="center")  # of a row that its title makes higher
    for name in (INPUT, STRUCTURE, ANSWER):
        style(name, border=rule, alignment=middle, protection=unlocked)
    style(FORMULA, border=rule, alignment=middle)
    style(HELPER, border=rule, alignment=middle, font=Font(name=FONT, size=SIZE, color="595959"))
    bold = Font(name=FONT, size=SIZE, bold=True, color="000000")
    style(HEADER, border=under, alignment=centre, font=bold)
    grey = Font(name=FONT, size=SIZE - 2, color="595959")
    style(NUMBER, border=rule, alignment=centre, font=grey)
    style(TITLE, font=Font(name=FONT, size=14, bold=True))
    style(SUBTITLE, font=Font(name=FONT, size=11, bold=True))
    style(NOTE, font=Font(name=FONT, size=SIZE - 1, color="595959"))
    style(TEXT, border=rule, alignment=Alignment(vertical="center", wrap_text=True))
    style(
        UNIT,
        border=rule,
        alignment=Alignment(horizontal="left", vertical="center", indent=1),
        font=Font(name=FONT, size=SIZE, color="595959"),
    )
    style(LINE, alignment=middle)
    style(
        LINK, alignment=middle, font=Font(name=FONT, size=SIZE, color="0563C1", underline="single")
    )
    style(CHECK, border=rule, alignment=centre, font=Font(name=FONT, size=SIZE, bold=True))


@cache
def _title_font(size: int, colour: str) -> Font:
    return Font(name=FONT, size=size, bold=True, color=colour)


def look(sheet: Worksheet, colour: str) -> None:
    """No grid, rows of one height, and the colour of the chapter over and under the titles."""
    sheet.sheet_view.showGridLines = False
    sheet.sheet_format.customHeight = True
    sheet.sheet_properties.tabColor = colour
    under = Border(bottom=Side(style="medium", color=colour))
    rows = range(1, sheet.max_row + 1)
    first = [cell for cell in (sheet.cell(row, 1) for row in rows) if isinstance(cell.value, str)]
    for cell in (*first, *sheet[_TITLES_ROW]):
        named = cell.style if cell.value is not None else ""  # takes long to find
        if named in _SIZES:
            cell.font = _title_font(_SIZES[named], colour)
        elif named == HEADER and sheet.cell(cell.row, 2).style == HEADER:
            for head in sheet[cell.row]:
                if head.value is not None and head.style == HEADER:
                    head.border = under
