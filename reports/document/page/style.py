"""Style file of a department: margins, type, front sheets, numbering."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from reports.inputs.load import tables_of
from reports.inputs.messages import explain
from reports.inputs.normalise import read_text
from reports.shared.errors import InputError, Problem

HINT = "исправьте файл оформления; ключи описаны в docs/report.md"
PX = 96 / 25.4  # CSS pixels in a millimetre
FRAME_MM = (20.0, 5.0, 185.0, 287.0)  # left, top, width, height of the frame
# Boxes 19-23 of ГОСТ 2.104 left of the frame, from below: words and height; widths of the columns.
_SIDES = (("Инв. № подл.", 25.0), ("Подп. и дата", 35.0), ("Взам. инв. №", 25.0),
          ("Инв. № дубл.", 25.0), ("Подп. и дата", 35.0))  # fmt: skip
SIDE_MM = (5.0, 7.0)
FRAMED_MM = 30.0  # bottom margin of a sheet with the title block, form 2а
_TABLE = 12 / 14  # type of tables relative to the text's
_HEAD_ROWS = 4  # of a table: caption, titles, numbers
_SIZES = {"": 1.0, "dense": 0.875, "tiny": 0.75}  # relative to the usual type of tables


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Margins(_Strict):
    """Margins of the sheet [mm]."""

    left: Annotated[float, Field(ge=15, le=50)] = 30.0
    right: Annotated[float, Field(ge=5, le=40)] = 15.0
    top: Annotated[float, Field(ge=10, le=40)] = 20.0
    bottom: Annotated[float, Field(ge=10, le=40)] = 20.0


class TitlePage(_Strict):
    """Words of the title page, and which sheets stand before the text."""

    ministry: str = ""
    kind: str = "Расчётно-пояснительная записка к курсовому проекту"
    assignment: bool = True
    abstract: bool = True
    review: bool = False


class Style(_Strict):
    """A department's style file; every key has the usual value."""

    font_size_pt: Annotated[float, Field(ge=10, le=16)] = 14.0
    line_spacing: Annotated[float, Field(ge=1, le=2)] = 1.5
    indent_cm: Annotated[float, Field(ge=0, le=2)] = 1.25
    heading_before_pt: Annotated[float, Field(ge=0, le=60)] = 14.0
    heading_after_pt: Annotated[float, Field(ge=0, le=60)] = 8.0
    formula_space_pt: Annotated[float, Field(ge=0, le=40)] = 6.0
    numbering: Literal["through", "chapter"] = "through"
    page_number: Literal["bottom-center", "bottom-right"] = "bottom-center"
    frame: Literal["none", "eskd"] | None = None
    frame_from: Annotated[int, Field(ge=2, le=20)] | None = None
    side_columns: bool = True
    appendix: Literal["ПРИЛОЖЕНИЕ", "Приложение"] = "ПРИЛОЖЕНИЕ"
    chapters_on_new_page: bool = True  # ГОСТ 7.32-2017
    tagged_tables: bool | None = None
    table_continuation: bool = True
    table_step_deg: Annotated[int, Field(ge=1, le=90)] = 30
    margins: Margins = Margins()
    title: TitlePage = TitlePage()

    @property
    def framed(self) -> Style:
        """The same for sheets with a frame: the title block stands at their foot."""
        margins = self.margins.model_copy(update={"bottom": FRAMED_MM})
        return self.model_copy(update={"margins": margins})

    @property
    def side_cells(self) -> tuple[tuple[str, float, float], ...]:
        """Boxes left of the frame: words, top and height [mm]; none where they are not wanted."""
        low, cells = FRAME_MM[1] + FRAME_MM[3], []
        for words, tall in _SIDES if self.side_columns else ():
            low -= tall
            cells.append((words, low, tall))
        return tuple(cells)

    @property
    def width_mm(self) -> float:
        """Width of the text [mm]."""
        return 210.0 - self.margins.left - self.margins.right

    @property
    def width_px(self) -> float:
        """Width of the text [CSS pixels]."""
        return self.width_mm * PX

    @property
    def height_px(self) -> float:
        """Height of the text on a page [CSS pixels]."""
        return (297.0 - self.margins.top - self.margins.bottom) * PX

    @property
    def row_em(self) -> float:
        """Height of a row of one line in a table relative to its type."""
        return 1.37

    @property
    def em_px(self) -> float:
        """Size of the text's type [CSS pixels]."""
        return self.font_size_pt * 96 / 72

    @property
    def table_pt(self) -> float:
        """Usual type of tables [pt]."""
        return round(self.font_size_pt * _TABLE, 2)

    def table_em_px(self, size: str) -> float:
        """Size of a table's type [CSS pixels] by the name of its size."""
        return self.table_pt * _SIZES[size] * 96 / 72

    def rows_on_page(self, size: str) -> int:
        """Rows of one line that a page holds at most, below the heading of a table."""
        return int(self.height_px / (self.row_em * self.table_em_px(size))) - _HEAD_ROWS

    def formula_em(self, *, numbered: bool) -> float:
        """Room for a line of a displayed formula, in em of the text."""
        return self.width_px / self.em_px * (0.86 if numbered else 1.0) - 0.6


USUAL = Style()


def read(path: Path) -> Style:
    """Read a style file.

    Raises:
        InputError: It cannot be read, is no TOML, or has a wrong key or value; one line.
    """
    try:
        return Style.model_validate(tables_of(read_text(path), source=str(path)))
    except ValidationError as error:
        raise InputError(Problem(str(path), _said(error), HINT)) from error


def _said(error: ValidationError) -> str:
    """Return validation errors in one line: key, fault, allowed values."""
    lines = []
    for item in error.errors():
        problem, hint = explain(item, None)
        limits = {"ge": "не меньше", "le": "не больше", "expected": "допустимо:"}
        allowed = [f"{word} {item['ctx'][name]}" for name, word in limits.items()
                   if name in item.get("ctx", {})]  # fmt: skip
        said = ", ".join(filter(None, (problem, hint, *allowed)))
        lines.append(f"{'.'.join(map(str, item['loc']))}: {said}")
    return "; ".join(lines)
