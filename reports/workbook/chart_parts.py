"""Parts of charts that many charts have alike: openpyxl makes the XML of each kind once."""

from __future__ import annotations

from copy import deepcopy
from functools import cache
from typing import ClassVar

from lxml import etree
from openpyxl.chart.error_bar import ErrorBars
from openpyxl.chart.label import DataLabel, DataLabelList
from openpyxl.chart.marker import Marker
from openpyxl.chart.series import XYSeries
from openpyxl.chart.shapes import GraphicalProperties
from openpyxl.chart.text import RichText, Text
from openpyxl.chart.title import Title
from openpyxl.descriptors.serialisable import Serialisable
from openpyxl.drawing.line import LineEndProperties, LineProperties
from openpyxl.drawing.text import (
    CharacterProperties,
    Paragraph,
    ParagraphProperties,
    RegularTextRun,
)

from reports.workbook.chart_ranges import CurveRanges

COLOURS = ("2F7ED8", "D94A3D", "2B9348", "A05FD0")  # of the page
RED, RAY = "C00000", "F4B183"
LINE, DEEP = 19050, 57150  # EMU: 1.5 pt, 4.5 pt
# Told apart without colour too: solid, dashed, dotted.
_DASHES = ("solid", "dash", "sysDot", "dashDot")
_TEXT = "{http://schemas.openxmlformats.org/drawingml/2006/main}t"


_trees: dict[tuple[int, str], tuple[Serialisable, etree._Element]] = {}


def _copy(part: Serialisable, tag: str) -> etree._Element:
    """Return the XML of a part that many have and no one changes; its hash takes longer."""
    key = id(part), tag
    if key not in _trees:
        _trees[key] = part, part.to_tree(tag)  # with the part: no other gets its number
    return deepcopy(_trees[key][1])


class Curve(XYSeries):  # type: ignore[misc]
    """A curve of two ranges, whose looks are shared parts."""

    parts: ClassVar[tuple[str, ...]] = ("spPr", "marker", "dLbls", "errBars")

    def __init__(
        self, number: int, curve: CurveRanges, look: GraphicalProperties,
        marker: Marker | None = None, labels: DataLabelList | None = None,
    ) -> None:  # fmt: skip
        super().__init__(idx=number, order=number, spPr=look, marker=marker or unmarked())
        self.curve = curve
        self.dLbls = labels
        self.smooth = False

    def to_tree(self, tagname: str | None = None, idx: int | None = None) -> etree._Element:
        """Return the XML of the series, as openpyxl orders it."""
        root = etree.Element(tagname or self.tagname)
        number = str(self.idx if idx is None else idx)
        for tag in ("idx", "order"):
            etree.SubElement(root, tag, val=number)
        if self.curve.cell:
            name = etree.SubElement(etree.SubElement(root, "tx"), "strRef")
            etree.SubElement(name, "f").text = self.curve.cell
        elif self.curve.name:
            etree.SubElement(etree.SubElement(root, "tx"), "v").text = self.curve.name
        for tag in self.parts:
            if (part := getattr(self, tag)) is not None:
                root.append(_copy(part, tag))
        for tag, cells in (("xVal", self.curve.x), ("yVal", self.curve.y)):
            root.append(_numbers(tag, cells))
        etree.SubElement(root, "smooth", val=str(int(self.smooth)))
        return root


def _numbers(tag: str, cells: str) -> etree._Element:
    """Return numbers of a range; without one a zero."""
    root = etree.Element(tag)
    if cells:
        etree.SubElement(etree.SubElement(root, "numRef"), "f").text = cells
        return root
    literal = etree.SubElement(root, "numLit")
    etree.SubElement(literal, "ptCount", val="1")
    point = etree.SubElement(literal, "pt", idx="0")
    etree.SubElement(point, "v").text = "0"
    return root


class ChartTitle(Title):  # type: ignore[misc]
    """A title of moderate size (hundredths of a point) that leaves the plot its room."""

    def __init__(self, text: str, size: int) -> None:
        super().__init__(overlay=False)
        self.words, self.size = text, size

    def to_tree(
        self, tagname: str | None = None, idx: int | None = None, namespace: str | None = None
    ) -> etree._Element:
        """Return the XML of a title with these words."""
        root = _copy(_title(self.size), tagname or self.tagname)
        next(root.iter(_TEXT)).text = self.words
        return root


@cache
def _title(size: int) -> Title:
    look = CharacterProperties(sz=size, b=False)
    paragraph = Paragraph(pPr=ParagraphProperties(defRPr=look), r=[RegularTextRun(rPr=look, t="-")])
    return Title(tx=Text(rich=RichText(p=[paragraph])), overlay=False)


@cache
def end_label(position: str) -> DataLabelList:
    """Name of a line of two points at its second one."""
    label = DataLabel(idx=1, dLblPos=position, showSerName=True)
    label.showVal = label.showLegendKey = label.showCatName = label.showPercent = False
    labels = DataLabelList(dLbl=[label], showSerName=False, showVal=False)
    labels.showLegendKey = labels.showCatName = labels.showPercent = False
    return labels


@cache
def name_label(position: str = "r") -> DataLabelList:
    """Name of a point beside it."""
    labels = DataLabelList(dLblPos=position, showSerName=True, showVal=False)
    labels.showLegendKey = labels.showCatName = labels.showPercent = False
    return labels


@cache
def dot(size: int, colour: str = RED) -> Marker:
    """A round point."""
    return Marker(symbol="circle", size=size, spPr=GraphicalProperties(solidFill=colour))


@cache
def unmarked() -> Marker:
    """No marker."""
    return Marker(symbol="none")


@cache
def grid() -> GraphicalProperties:
    """Lines of a grid."""
    return GraphicalProperties(ln=LineProperties(solidFill="D9D9D9", w=6350))


@cache
def hidden() -> GraphicalProperties:
    """No line."""
    line = LineProperties(w=LINE, noFill=True)
    line.prstDash = None  # openpyxl calls it solid: then Gnumeric draws it
    return GraphicalProperties(ln=line)


@cache
def stroke(colour: str, width: int = LINE, dash: str | None = "solid", end: str | None = None
           ) -> GraphicalProperties:  # fmt: skip
    """A line; one of curves stays told apart from others without colour too."""
    line = LineProperties(w=width, solidFill=colour, prstDash=dash)
    if end:
        line.tailEnd = LineEndProperties(type=end)
    return GraphicalProperties(ln=line)


@cache
def stem(line: GraphicalProperties) -> ErrorBars:
    """Line from a point to the axis."""
    return ErrorBars(
        errDir="y", errBarType="minus", errValType="percentage", val=100, noEndCap=True, spPr=line
    )


def look(number: int, *, solid: bool = False) -> GraphicalProperties:
    """Line of a curve: shifted after all colours are used, so that twelve curves differ."""
    dash = _DASHES[(number + number // len(COLOURS)) % len(_DASHES)]
    return stroke(COLOURS[number % len(COLOURS)], dash="solid" if solid else dash)
