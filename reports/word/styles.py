"""Named styles of the Word file, by the department's style file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reports.document.page.style import Style
from reports.word.markup import Element, twips, w

if TYPE_CHECKING:
    from docx.document import Document

FONT = "Times New Roman"
SIZES = ("", "dense", "tiny")
DASH, HEADINGS = 1, 2  # numbers of the lists
_LINE = 240  # of an interval of one line
_HIGH = 1.15  # of a line of Times New Roman over its size
_TIGHT = 1.3  # interval of headings and captions
_CELL = 1.1


@dataclass(frozen=True, slots=True)
class ParagraphStyle:
    """A paragraph style; lengths in points, the indents in twips."""

    name: str
    base: str = "Normal"
    jc: str = ""
    line: float = 0.0
    before: float | None = None
    after: float | None = None
    left: int | None = None
    first: int | None = None
    size: float = 0.0
    level: int = 0
    bold: bool | None = None
    italic: bool | None = None
    caps: bool | None = None
    keep_next: bool = False
    keep_lines: bool = False
    new_page: bool | None = None
    list_number: int | None = None
    right_tab: int = 0
    following: str = ""


def cell_style(size: str, *, text: bool) -> str:
    """Id of the style of a cell by the name of its type."""
    return f"Cell{size.capitalize()}{'Text' if text else ''}"


def looks(style: Style) -> dict[str, ParagraphStyle]:
    """All paragraph styles by id."""
    indent, size = twips(10 * style.indent_cm), style.font_size_pt
    width = twips(style.width_mm)
    hang = round(2.2 * size * 20)
    above, below = style.heading_before_pt, style.heading_after_pt
    spacing = style.formula_space_pt / 2  # the rows of formulas that follow one another add up
    styles = {
        "BodyText": ParagraphStyle("Body Text", jc="both", first=indent),
        "Flush": ParagraphStyle("Текст без отступа", jc="both"),
        "Where": ParagraphStyle("Где", line=style.line_spacing, left=hang, first=-hang),
        "Heading1": ParagraphStyle("heading 1", line=_TIGHT, before=0, after=below, left=indent,
                                   first=0,
                         size=size + 2, level=1, bold=True, keep_next=True, keep_lines=True,
                         new_page=True, list_number=HEADINGS, following="BodyText"),
        "Heading2": ParagraphStyle("heading 2", line=_TIGHT, before=above, after=below, left=indent,
                                   first=0,
                         level=2, bold=True, keep_next=True, keep_lines=True,
                         list_number=HEADINGS, following="BodyText"),
        "Heading3": ParagraphStyle("heading 3", line=_TIGHT, before=above, after=below, left=indent,
                                   first=0,
                         level=3, bold=True, italic=True, keep_next=True, keep_lines=True,
                         list_number=HEADINGS, following="BodyText"),
        "HeadingPlain": ParagraphStyle("Заголовок без номера", "Heading1", jc="center", left=0,
                                       caps=True,
                             list_number=0, following="BodyText"),
        "Appendix": ParagraphStyle("Приложение", "HeadingPlain", caps=False, following="BodyText"),
        "FrontHeading": ParagraphStyle("Заголовок листа", jc="center", line=_TIGHT, after=below,
                                       size=size + 2,
                             bold=True, caps=True, keep_next=True, new_page=True),
        "Caption": ParagraphStyle("caption", line=_TIGHT),
        "FigureCaption": ParagraphStyle("Название рисунка", "Caption", jc="center", before=4,
                                        after=10),
        "TableCaption": ParagraphStyle("Название таблицы", "Caption", before=10, after=2,
                                       keep_next=True,
                             keep_lines=True),
        "TableContinued": ParagraphStyle("Продолжение таблицы", "Caption", line=1.0),
        "Figure": ParagraphStyle("Рисунок", jc="center", line=1.0, before=10, keep_next=True),
        "Formula": ParagraphStyle("Формула", jc="center", line=1.0, before=spacing, after=spacing),
        "FormulaNumber": ParagraphStyle("Номер формулы", jc="right", line=1.0),
        "BodyAfterTable": ParagraphStyle("Текст после таблицы", "BodyText", before=8),
        "FlushAfterTable": ParagraphStyle("Текст без отступа после таблицы", "Flush", before=8),
        "AfterTable": ParagraphStyle("После таблицы", line=1.0, size=6),
        "ListBullet": ParagraphStyle("List Bullet", jc="both", left=indent, first=0,
                                     list_number=DASH),
        "Source": ParagraphStyle("Источник", jc="both", first=indent),
        "Keywords": ParagraphStyle("Ключевые слова", before=8, after=8),
        "Notation": ParagraphStyle("Обозначение", line=1.15, size=0.86 * size),
        "TOCHeading": ParagraphStyle("TOC Heading", "FrontHeading"),
        "Title": ParagraphStyle("Title", jc="center", line=_TIGHT, before=17, size=18, bold=True),
        "Cover": ParagraphStyle("Титульный лист", jc="center", line=_TIGHT),
        "CoverKind": ParagraphStyle("Вид работы", "Cover", before=128),
        "CoverPeople": ParagraphStyle("Исполнители", "Cover", jc="left", before=10),
        "CoverPerson": ParagraphStyle("Исполнитель с подписью", "Cover", jc="left", before=10),
        # Lines as far apart as the PDF's: Word multiplies the letters' own height.
        "Task": ParagraphStyle("Задание", line=1.25 / _HIGH, after=6, size=13),
        "TaskCentre": ParagraphStyle("Задание по центру", "Task", jc="center"),
        "TaskHead": ParagraphStyle("Задание: заголовок", "Task", jc="center", bold=True,
                                   before=23, after=17),
        "TaskApprove": ParagraphStyle("Задание: утверждаю", "Task", left=round(0.55 * width),
                                      before=14),
        "Header": ParagraphStyle("header", line=1.0),
        "Footer": ParagraphStyle("footer", line=1.0, size=12),
        "Stamp": ParagraphStyle("Основная надпись", jc="center", line=1.0, size=8.5, italic=True),
    }  # fmt: skip
    for number in (1, 2, 3):
        styles[f"TOC{number}"] = ParagraphStyle(f"toc {number}", line=_TIGHT,
                                              left=twips(12.5) * (number - 1),
                                    right_tab=width)  # fmt: skip
    for name, word in zip(SIZES, ("", " мелкая", " мельчайшая"), strict=True):
        points = round(style.table_em_px(name) * 0.75, 2)
        styles[cell_style(name, text=False)] = ParagraphStyle(f"Ячейка{word}", jc="center",
                                                            line=_CELL,
                                                  size=points)  # fmt: skip
        usual = cell_style(name, text=False)
        styles[cell_style(name, text=True)] = ParagraphStyle(
            f"Ячейка{word}: текст", usual, jc="left", left=52
        )
    return styles


def dress(document: Document, style: Style) -> None:
    """Replace the template's styles, lists and settings by our own."""
    sheet = document.styles.element
    for child in list(sheet):
        sheet.remove(child)
    sheet.append(_defaults(style))
    sheet.append(_normal(style))
    for key, look in looks(style).items():
        sheet.append(_paragraph_style(key, look))
    sheet.extend(_table_styles())
    lists = document.part.numbering_part.element
    for child in list(lists):
        lists.remove(child)
    lists.extend(_lists(style))
    _settings(document)


def _settings(document: Document) -> None:
    """Russian hyphenation; fields are renewed when Word opens the file: contents need pages."""
    settings = document.settings.element
    for child in list(settings):
        settings.remove(child)
    compatible = w("compatSetting", name="compatibilityMode", val=15,
                   uri="http://schemas.microsoft.com/office/word")  # fmt: skip
    settings.extend([
        w("zoom", percent=100), w("defaultTabStop", val=709), w("autoHyphenation", val="true"),
        w("characterSpacingControl", val="doNotCompress"), w("updateFields", val="true"),
        w("compat", compatible), w("themeFontLang", val="ru-RU"), w("decimalSymbol", val=","),
        w("listSeparator", val=";"),
    ])  # fmt: skip


def _defaults(style: Style) -> Element:
    fonts = w("rFonts", ascii=FONT, hAnsi=FONT, eastAsia=FONT, cs=FONT)
    language = w("lang", val="ru-RU", eastAsia="ru-RU", bidi="ar-SA")
    size = round(2 * style.font_size_pt)
    faces = w("rPr", fonts, w("sz", val=size), w("szCs", val=size), language)
    return w("docDefaults", w("rPrDefault", faces), w("pPrDefault", w("pPr")))


def _normal(style: Style) -> Element:
    spacing = w("spacing", before=0, after=0, line=round(_LINE * style.line_spacing),
                lineRule="auto")  # fmt: skip
    element = w("style", w("name", val="Normal"), w("qFormat"), w("pPr", spacing), type="paragraph")
    element.set(spacing.tag.replace("spacing", "default"), "1")
    element.set(spacing.tag.replace("spacing", "styleId"), "Normal")
    return element


def _paragraph_style(key: str, look: ParagraphStyle) -> Element:
    properties = [w("name", val=look.name), w("basedOn", val=look.base)]
    if look.following:
        properties.append(w("next", val=look.following))
    properties.append(w("qFormat"))
    return w(
        "style", *properties, _paragraph_looks(look), _letters(look), type="paragraph", styleId=key
    )


def _paragraph_looks(look: ParagraphStyle) -> Element:
    """Properties of the paragraph in the order of the schema."""
    properties = w("pPr")
    if look.keep_next:
        properties.append(w("keepNext"))
    if look.keep_lines:
        properties.append(w("keepLines"))
    if look.new_page is not None:
        properties.append(w("pageBreakBefore", val=int(look.new_page)))
    if look.list_number is not None:
        level = [w("ilvl", val=look.level - 1)] if look.level > 1 else []
        properties.append(w("numPr", *level, w("numId", val=look.list_number)))
    if look.right_tab:
        properties.append(w("tabs", w("tab", val="right", leader="dot", pos=look.right_tab)))
    spacing = {
        "before": None if look.before is None else round(20 * look.before),
        "after": None if look.after is None else round(20 * look.after),
        "line": round(_LINE * look.line) or None,
    }
    attributes: dict[str, object] = {
        key: value for key, value in spacing.items() if value is not None
    }
    if attributes:
        properties.append(w("spacing", **attributes, **({"lineRule": "auto"} if look.line else {})))
    ends = {"left": look.left, "firstLine": look.first}
    if look.first is not None and look.first < 0:
        ends = {"left": look.left, "hanging": -look.first}
    sides: dict[str, object] = {key: value for key, value in ends.items() if value is not None}
    if sides:
        properties.append(w("ind", **sides))
    if look.jc:
        properties.append(w("jc", val=look.jc))
    if look.level:
        properties.append(w("outlineLvl", val=look.level - 1))
    return properties


def _letters(look: ParagraphStyle) -> Element:
    properties = w("rPr")
    for name, value in (("b", look.bold), ("i", look.italic), ("caps", look.caps)):
        if value is not None:
            properties.append(w(name, val=int(value)))
    if look.size:
        properties.extend([w("sz", val=round(2 * look.size)), w("szCs", val=round(2 * look.size))])
    return properties


def _table_styles() -> list[Element]:
    def borders(*sides: str) -> Element:
        rules = (w(side, val="single", sz=4, space=0, color="auto") for side in sides)
        return w("tblBorders", *rules)

    margins = w("tblCellMar", w("left", w=28, type="dxa"), w("right", w=28, type="dxa"))
    outer = ("top", "left", "bottom", "right")
    usual = w("style", w("name", val="Normal Table"), w("tblPr", w("tblInd", w=0, type="dxa"),
              margins), type="table", styleId="TableNormal")  # fmt: skip
    usual.set(f"{{{usual.nsmap['w']}}}default", "1")
    styles = [usual]
    for key, name, sides in (
        ("ReportTable", "Таблица отчёта", (*outer, "insideV")),
        ("ReportTableLined", "Таблица отчёта с линиями", (*outer, "insideH", "insideV")),
        ("FormulaTable", "Формула с номером", ()),
        ("SignTable", "Подписи титульного листа", ()),
    ):
        styles.append(w("style", w("name", val=name), w("basedOn", val="TableNormal"),
                      w("tblPr", *([borders(*sides)] if sides else [])),
                      type="table", styleId=key))  # fmt: skip
    return styles


def _lists(style: Style) -> list[Element]:
    """Return the dash of lists and the numbers of headings."""
    indent = twips(10 * style.indent_cm)
    dash = w("lvl", w("start", val=1), w("numFmt", val="bullet"), w("suff", val="space"),
             w("lvlText", val="—"), w("lvlJc", val="left"),
             w("pPr", w("ind", left=indent, firstLine=0)), ilvl=0)  # fmt: skip
    levels = [
        w("lvl", w("start", val=1), w("numFmt", val="decimal"), w("pStyle", val=f"Heading{n}"),
          w("suff", val="space"), w("lvlText", val=".".join(f"%{i}" for i in range(1, n + 1))),
          w("lvlJc", val="left"), w("pPr", w("ind", left=indent, firstLine=0)), ilvl=n - 1)
        for n in (1, 2, 3)
    ]  # fmt: skip
    kinds = ((DASH, "hybridMultilevel", [dash]), (HEADINGS, "multilevel", levels))
    abstract = [
        w("abstractNum", w("multiLevelType", val=kind), *parts, abstractNumId=number)
        for number, kind, parts in kinds
    ]
    numbers = [w("num", w("abstractNumId", val=n), numId=n) for n, _, _ in kinds]
    return [*abstract, *numbers]
