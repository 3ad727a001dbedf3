"""Rules of the house for charts and formulas; each function names what breaks one."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Iterator

from lxml import etree

from reports.formula.parse import SCALES, parse
from reports.model.blocks import Model, TableSpec, scalars_of
from reports.workbook.chapters import chapter_of
from reports.workbook.charts import HIGH, WIDE
from reports.workbook.inputs import options
from reports.workbook.motion import SHAPE as MECHANISM
from reports.workbook.motion import WIDE as MOVING

C = "{http://schemas.openxmlformats.org/drawingml/2006/chart}"
A = "{http://schemas.openxmlformats.org/drawingml/2006/main}"
MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"

# All of Excel 2007 and before, none volatile, the same in LibreOffice and formualizer.
ALLOWED = {
    "ABS", "ACOS", "AND", "ASIN", "ATAN2", "AVERAGE", "CHOOSE", "COS", "COUNT", "COUNTIF",
    "DEGREES", "EXP", "IF", "INDEX", "INT", "ISERROR", "LN", "MATCH", "MAX", "MIN", "MOD", "NOT",
    "OR", "PI", "RADIANS", "ROUND", "ROUNDUP", "SIN", "SQRT", "SUM", "SUMPRODUCT", "TAN",
}  # fmt: skip
VOLATILE = {"CELL", "INDIRECT", "INFO", "NOW", "OFFSET", "RAND", "RANDBETWEEN", "TODAY"}
OF_RANGES = {
    "AVERAGE", "COUNT", "COUNTIF", "INDEX", "MATCH", "MAX", "MIN", "SUM", "SUMPRODUCT",
}  # fmt: skip
FINE = 200  # points of a curve that is saved by its shape
LONGEST = 200  # characters of a formula that a person reads
_GUARD = re.compile(r"\b0\.0{6,}1\b|\b9999\b|\bMAX\(1,ABS\(")
_LINES = ("19050", "57150")  # EMU: 1.5 pt, and 4.5 pt for worn depths

# Literals that the compiler writes: scales of units, degrees and the two of a Fourier sum,
# the one of a rank, digits of ROUND.
COMPILED = {0.0, 1.0, 2.0, 180.0, *SCALES.values(), *(round(1 / x) for x in SCALES.values())}
LITERAL = re.compile(r"(?<![A-Za-z0-9_.$])(\d+(?:\.\d*)?(?:E[+-]?\d+)?)(?![A-Za-z0-9_(.])")
_NAME = re.compile(r"([A-Z][A-Z0-9.]*)\(")
_RANGE = re.compile(r"\$?[A-Z]{1,3}\$?\d+:\$?[A-Z]{1,3}\$?\d+")


def chart_problems(root: etree._Element) -> list[str]:
    """What a picture made by LibreOffice cannot show of Excel."""
    collected = [*_axis_problems(root), *_title_problems(root), *_series_problems(root)]
    if _val(root, "roundedCorners") != "0":
        collected.append("rounded corners")
    if _val(root, ".//" + C + "scatterStyle", whole=True) != "lineMarker":
        collected.append("scatterStyle")
    return collected + _cache_problems(root) + _polar_problems(root)


def _val(element: etree._Element, path: str, *, whole: bool = False) -> str | None:
    child = element.find(path if whole else f"{C}{path}")
    return None if child is None else child.get("val")


def _axis_problems(root: etree._Element) -> Iterator[str]:
    axes = root.findall(f".//{C}valAx")
    if len(axes) != 2:
        yield f"{len(axes)} axes"
    for axis in axes:
        name = f"axis {_val(axis, 'axId')}"
        if _val(axis, "delete") != "0":
            yield f"{name} is hidden in Excel"
        # Below or left of the plot, whichever way the other axis runs.
        turned = any(_val(a.find(f"{C}scaling"), "orientation") == "maxMin"
                     for a in axes if a is not axis)  # fmt: skip
        if _val(axis, "tickLblPos") != ("high" if turned else "low"):
            yield f"{name}: labels are not low"
        numbers = axis.find(f"{C}numFmt")
        if numbers is None or numbers.get("sourceLinked") != "0":
            yield f"{name}: number format linked to the source"
        if axis.find(f"{C}majorGridlines/{C}spPr/{A}ln") is None:
            yield f"{name}: no gridlines"


def _title_problems(root: etree._Element) -> Iterator[str]:
    titles = root.findall(f".//{C}title")
    if root.find(f"{C}chart/{C}title") is None:
        yield "no title"
    for title in titles:
        if _val(title, "overlay") != "0":
            yield "a title lies over the plot"
        if not "".join(text.text or "" for text in title.iter(f"{A}t")).strip():
            yield "an empty title"


def _series_problems(root: etree._Element) -> Iterator[str]:
    series = root.findall(f".//{C}ser")
    if not series:
        yield "no series"
    titles = {
        "".join(t.text or "" for t in title.iter(f"{A}t")) for title in root.iter(f"{C}title")
    }
    for index, one in enumerate(series):
        where = one.findtext(f"{C}xVal/{C}numRef/{C}f", "")
        try:
            round_too = chapter_of(where.rpartition("!")[0].strip("'")).smooth
        except LookupError:  # a sheet of a study
            round_too = False
        if _val(one, "smooth") not in (("0", "1") if round_too else ("0",)):
            yield f"series {index} is smoothed"
        symbol = one.find(f"{C}marker/{C}symbol")
        ends = where.rpartition("!")[2].split(":")
        moving = ends[0] == ends[-1]  # a point by one cell
        stem = one.find(f"{C}errBars") is not None
        if stem != bool({"порядок k", "ν"} & titles):
            yield f"series {index}: orders stand on stems, nothing lies between them"
        dotted = moving or stem
        if symbol is None or symbol.get("val") != ("circle" if dotted else "none"):
            yield f"series {index} has markers"
        line = one.find(f"{C}spPr/{A}ln")
        if line is None or (line.find(f"{A}noFill") is None and line.get("w") not in _LINES):
            yield f"series {index}: the line is not 1.5 pt"
        elif line.find(f"{A}noFill") is not None and line.find(f"{A}prstDash") is not None:
            yield f"series {index}: Gnumeric draws its hidden line"


def _cache_problems(root: etree._Element) -> list[str]:
    collected = []
    for reference in root.iterfind(f".//{C}numRef"):
        where = reference.findtext(f"{C}f")
        points = [point.text for point in reference.iterfind(f"{C}numCache/{C}pt/{C}v")]
        count = reference.find(f"{C}numCache/{C}ptCount")
        least = 2 if len(set(where.rpartition("!")[2].split(":"))) > 1 else 1
        # Of a fine curve the rows between which it is straight, its ends among them.
        rows = [int(point.get("idx")) for point in reference.iterfind(f"{C}numCache/{C}pt")]
        whole = int(count.get("val")) if count is not None else 0
        thinned = whole > FINE and _val(root.find(f"{C}chart"), "dispBlanksAs") == "span"
        filled = thinned and len(rows) >= whole / 10 and rows[0] == 0 and rows[-1] == whole - 1
        if not (filled or len(points) == whole) or whole < least:
            collected.append(f"{where}: the cache is not filled")
        elif not all(_is_number(text) for text in points):
            collected.append(f"{where}: the cache holds no number")
    return collected


def _is_number(text: str | None) -> bool:
    return bool(re.fullmatch(r"-?\d+(\.\d+)?(E[+-]?\d+)?", text or "", re.IGNORECASE))


def _polar_problems(root: etree._Element) -> list[str]:
    """Polar diagrams: a square inner plot area and equal limits on both axes."""
    layout = root.find(f".//{C}plotArea/{C}layout/{C}manualLayout")
    if layout is None:
        return []
    collected = []
    # In a square chart, or in one of the first sheet's, which are as wide as all others.
    shape = float(_val(layout, "w") or 0) / float(_val(layout, "h") or 1)
    shapes = (1.0, HIGH / WIDE, HIGH / MOVING, MECHANISM * 2 * HIGH / MOVING)
    square = any(math.isclose(shape, wanted, rel_tol=1e-9) for wanted in shapes)
    if not square or _val(layout, "layoutTarget") != "inner":
        collected.append("the plot area is not square")
    box = [s for s in root.findall(f".//{C}ser") if s.find(f"{C}spPr/{A}ln/{A}noFill") is not None]
    widths = [
        ends[-1] - ends[0]
        for s in box
        for cache in s.iterfind(f".//{C}numCache")
        if len(ends := [float(value.text) for value in cache.iter(f"{C}v")]) > 1
    ]
    limits = [axis.find(f"{C}scaling/{C}max") for axis in root.findall(f".//{C}valAx")]
    # Equal limits are fixed, or a corner series spans the same range on both axes.
    if math.isclose(shape, shapes[-1], rel_tol=1e-9):
        return collected  # its limits follow from a frame of the plot's shape
    are_fixed = all(limit is not None for limit in limits)
    if not are_fixed and not math.isclose(widths[-1], widths[-2], rel_tol=1e-4):
        collected.append("the axes may have different limits")
    steps = {_val(axis, "majorUnit") for axis in root.findall(f".//{C}valAx")}
    if len(steps) != 1:  # equal limits end alike where the divisions are the same
        collected.append("the axes are divided differently")
    return collected


def formula_problems(cell: etree._Element) -> list[str]:
    """What breaks the subset on which Excel, LibreOffice and formualizer agree."""
    formula = cell.find(f"{MAIN}f")
    text = re.sub(r'"[^"]*"', '""', formula.text or "")
    used = set(_NAME.findall(text))
    collected = [f"{name} is volatile" for name in sorted(used & VOLATILE)]
    collected += [
        f"{name} is not shared by all engines" for name in sorted(used - ALLOWED - VOLATILE)
    ]
    if "_xlfn" in text:
        collected.append("newer than Excel 2007")
    # LibreOffice loads array formulas dirty, and the first edit stops there.
    if formula.get("t") not in (None, "shared"):
        collected.append(f"array formula {dict(formula.attrib)}")
    if formula.get("t") == "shared" and "!" in text:  # Excel shares none with another sheet
        collected.append("a shared formula names another sheet")
    # Gnumeric lifts a function over a range in array formulas alone.
    if re.search(r"\b(?:SIN|COS)\([^()]*:", text):
        collected.append("a function over a range")
    if re.search(r"\dE[+-]?\d", text) or re.search(r"(^=?|[(,*/+^<>=-])-\(", text):
        collected.append("an exponent or a sign before a bracket")
    if len(formula.text or "") > LONGEST:
        collected.append("too long to be read")
    if _GUARD.search(text):
        collected.append("a guard in place of a rounding, or a sentinel")
    if "[" in text or "#" in text:
        collected.append("an external link or an error value")
    collected += [f"{name} over a range" for name in _over_ranges(text)]
    return collected if has_value(cell) else [*collected, "no cached value"]


def has_value(cell: etree._Element) -> bool:
    """Whether a cell carries a cached value."""
    value = cell.find(f"{MAIN}v")
    return value is not None and bool(value.text)


def _over_ranges(text: str) -> Iterator[str]:
    """Arithmetic on ranges: only in SUMPRODUCT, and there no function but SIN and COS."""
    stack: list[str] = []  # functions around the place, "" for a plain bracket
    pattern = re.compile(rf"({_NAME.pattern})|(\()|(\))|({_RANGE.pattern})")
    for match in pattern.finditer(text):
        if match[1]:
            stack.append(match[2])
        elif match[3]:
            stack.append("")
        elif match[4]:
            if stack:
                stack.pop()
        else:
            names = [name for name in stack if name]
            innermost = names[-1] if names else ""
            alone = _stands_alone(text, match.start(), match.end())
            within = names[names.index("SUMPRODUCT") + 1 :] if "SUMPRODUCT" in names else None
            if within is not None and not set(within) - {"SIN", "COS"}:
                continue
            if within or not alone or innermost not in OF_RANGES:
                yield f"{innermost or 'arithmetic'} on {match[0]}"


def _stands_alone(text: str, start: int, end: int) -> bool:
    """Whether a range is a whole argument: brackets or commas around it and its sheet."""
    before = re.sub(r"('[^']*'|[^\s!'(),*/+^<>=-]+)!$", "", text[:start])
    return before[-1:] in ("(", ",") and text[end : end + 1] in (")", ",")


def literals(formula: str) -> set[float]:
    """Numbers typed into a formula."""
    bare = re.sub(r"'[^']*'!|\"[^\"]*\"", " ", formula)
    return {float(text) for text in LITERAL.findall(bare)}


def expressions(model: Model) -> dict[str, str]:
    """Key → expression of every computed column and scalar."""
    collected = {}
    for block in model.blocks:
        if isinstance(block, TableSpec):
            collected |= {
                f"{block.id}.{c.key}": c.expr for c in block.columns if c.expr is not None
            }
        else:
            collected |= {scalar.key: scalar.expr for scalar in scalars_of(block)}
    return collected


def limits(model: Model) -> set[float]:
    """Numbers by which the sheet of inputs tells whether a cell holds what it may."""
    collected = {0.0, 1.0}
    for item in model.inputs:
        collected |= {float(end) for end in (item.minimum, item.maximum) if end is not None}
        collected |= {float(value) for value in options(item) if isinstance(value, int)}
    return collected | {abs(end) for end in collected}  # a sign is no part of a literal


def constants(model: Model) -> set[float]:
    """Numbers that the expressions themselves contain, and steps of tables with own rows."""
    collected = {float(table.step) for table in model.tables.values() if table.step is not None}
    for expression in expressions(model).values():
        for node in ast.walk(parse(expression)):
            if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
                collected.add(float(node.value))
    return collected
