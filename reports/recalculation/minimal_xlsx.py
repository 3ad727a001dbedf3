"""Write a grid as a minimal workbook for formualizer.

People's files are read once, into the grid; the library sees what the grid holds and
nothing else: no saved values, no formats, no formulas outside the whitelist.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Collection
from html import escape

from reports.recalculation.formulas import Token, column_letters, quoted, render, unquoted
from reports.recalculation.grid import Area, CellColumn, CellGrid, Constant, Run

_MAIN = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"'
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_TYPES = "application/vnd.openxmlformats-officedocument.spreadsheetml"


_DEEPEST = 60  # parentheses within each other
_CHAIN = 200  # operands in a row; formualizer takes 256
_CELL = re.compile(r"(?<![A-Za-z0-9])[A-Za-z]{1,3}[0-9]")


def folded(text: str) -> str:
    """Case-folded text; formualizer folds Latin letters only."""
    return text.lower()


def simple_workbook(grid: CellGrid, runs: Collection[Run]) -> bytes:
    """Return the workbook with all constants of a grid and some of its runs."""
    stream = io.BytesIO()
    numbers = range(1, len(grid.sheets) + 1)
    of_sheet: dict[str, list[Run]] = {}
    for run in runs:
        of_sheet.setdefault(run.sheet, []).append(run)
    with zipfile.ZipFile(stream, "w") as archive:  # read at once: not worth compressing
        overrides = "".join(
            f'<Override PartName="/xl/worksheets/sheet{i}.xml" '
            f'ContentType="{_TYPES}.worksheet+xml"/>'
            for i in numbers
        )
        archive.writestr(
            "[Content_Types].xml",
            f'<Types xmlns="{_PACKAGE}/content-types"><Default Extension="rels" '
            'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
            '<Default Extension="xml" ContentType="application/xml"/>'
            f'<Override PartName="/xl/workbook.xml" ContentType="{_TYPES}.sheet.main+xml"/>'
            f"{overrides}</Types>",
        )
        archive.writestr("_rels/.rels", _relations([("officeDocument", "xl/workbook.xml")]))
        sheets = "".join(
            f'<sheet name="{escape(title)}" sheetId="{i}" r:id="r{i}"/>'
            for i, title in zip(numbers, grid.sheets, strict=True)
        )
        archive.writestr(
            "xl/workbook.xml",
            f'<workbook {_MAIN} xmlns:r="{_OFFICE}"><sheets>{sheets}</sheets></workbook>',
        )
        parts = [("worksheet", f"worksheets/sheet{i}.xml") for i in numbers]
        archive.writestr("xl/_rels/workbook.xml.rels", _relations(parts))
        for i, (title, columns) in zip(numbers, grid.sheets.items(), strict=True):
            part = _sheet(grid, columns, of_sheet.get(title, []))
            archive.writestr(f"xl/worksheets/sheet{i}.xml", part)
    return stream.getvalue()


def _relations(parts: list[tuple[str, str]]) -> str:
    items = "".join(
        f'<Relationship Id="r{i}" Type="{_OFFICE}/{kind}" Target="{target}"/>'
        for i, (kind, target) in enumerate(parts, 1)
    )
    return f'<Relationships xmlns="{_PACKAGE}/relationships">{items}</Relationships>'


def _extent(area: Area, fixed: str = "") -> str:
    ends = ((area.first_column, area.first_row), (area.last_column, area.last_row))
    first, last = (f"{fixed}{column_letters(c)}{fixed}{r}" for c, r in ends)
    return first if first == last else f"{first}:{last}"


def _sheet(grid: CellGrid, columns: dict[int, CellColumn], runs: list[Run]) -> str:
    rows: dict[int, list[str]] = {}
    for number, column in columns.items():
        letters = column_letters(number)
        for row, value in column.constants.items():
            rows.setdefault(row, []).append(f'<c r="{letters}{row}"{_value(value)}</c>')
        for row, text in column.errors.items():
            cell = f'<c r="{letters}{row}" t="e"><v>{escape(text)}</v></c>'
            rows.setdefault(row, []).append(cell)
    for shared, run in enumerate(runs):
        letters = column_letters(run.column)
        attributes, follows = "", ""
        if run.array is not None:
            if run.column > run.array.first_column:
                continue  # its values come with those of the first column
            attributes = f' t="array" ref="{_extent(run.array)}"'
        elif run.count > 1 and not _is_misread(run):
            attributes = f' t="shared" ref="{letters}{run.first}:{letters}{run.last}" si="{shared}"'
            follows = f'<f t="shared" si="{shared}"/>'
        for row in range(run.first, run.last + 1 if run.array is None else run.first + 1):
            first = not follows or row == run.first
            text = f"<f{attributes}>{_formula(grid, run, row)}</f>" if first else follows
            rows.setdefault(row, []).append(f'<c r="{letters}{row}">{text}</c>')
    lines = "".join(f'<row r="{row}">{"".join(rows[row])}</row>' for row in sorted(rows))
    return f"<worksheet {_MAIN}><sheetData>{lines}</sheetData></worksheet>"


def _value(value: Constant) -> str:
    if isinstance(value, bool):
        return f' t="b"><v>{value:d}</v>'
    if isinstance(value, str):
        return f' t="str"><v>{escape(folded(value))}</v>'
    return f"><v>{value!r}</v>"


def _is_misread(run: Run) -> bool:
    """Whether the library would fill down what looks like a cell in the title of a sheet."""
    assert run.formula is not None
    return any(kind == "sheet" and _CELL.search(value) for kind, value in run.formula.pattern)


def _formula(grid: CellGrid, run: Run, row: int) -> str:
    text = formula_text(grid, run, row, run.column)
    if run.array is not None:  # its extent bounds what it fills
        area = run.array
        height, width = run.count, area.last_column - area.first_column + 1
        text = f"TAKE({text},{height},{width})"
    return escape(text, quote=False)


def formula_text(grid: CellGrid, run: Run, row: int, column: int) -> str:
    """Return formula of a run in one cell without its ``=``, as formualizer takes it."""
    assert run.formula is not None
    tokens = [_plain(grid, token) for token in run.formula.pattern]
    if len(tokens) > _CHAIN:
        tokens = _in_parts(tokens)
    return render(tokens, row, column)[1:]


def _in_parts(tokens: list[Token]) -> list[Token]:
    """Long sums and products with their parts in parentheses; what they give is the same.

    ``a+b-c+d`` is ``(a+b)+(-c+d)`` and ``a*b/c*d`` is ``(a*b)*(1/c*d)``.
    """
    ends: dict[int, int] = {}
    stack: list[int] = []
    deepest = 0
    for at, token in enumerate(tokens):
        if token in (("op", "("), ("op", "{")):
            stack.append(at)
            deepest = max(deepest, len(stack))
        elif token in (("op", ")"), ("op", "}")) and stack:
            ends[stack.pop()] = at
    if deepest > _DEEPEST:  # it will not be calculated anyway
        return tokens
    return _grouped(tokens, 0, len(tokens), ends)


def _grouped(tokens: list[Token], start: int, end: int, ends: dict[int, int]) -> list[Token]:
    """Tokens between two places, each argument in parts of its own."""
    grouped: list[Token] = []
    argument: list[list[Token]] = [[]]  # operands of a sum and the signs between them
    at = start
    while at < end:
        token = tokens[at]
        close = ends.get(at, 0)
        if close and token == ("op", "("):
            inside = _grouped(tokens, at + 1, close, ends)
            argument[-1] += [token, *inside, tokens[close]]
            at = close
        elif close:
            argument[-1] += tokens[at : close + 1]
            at = close
        elif (token[0] == "op" and token[1] in ",;") or _compares(token):
            grouped += [*_sum(argument), token]
            argument = [[]]
        elif token[0] == "op" and token[1] in "+-" and _is_binary(argument[-1]):
            argument.append([token])
        else:
            argument[-1].append(token)
        at += 1
    return grouped + _sum(argument)


def _compares(token: Token) -> bool:
    return token[0] == "op" and token[1] in ("=", "<", ">", "<=", ">=", "<>", "&")


def _is_binary(before: list[Token]) -> bool:
    """Whether a sign after these tokens stands between two operands."""
    return bool(before) and (before[-1][0] != "op" or before[-1][1] in ")}%")


def _sum(operands: list[list[Token]]) -> list[Token]:
    """Operands of a sum, each but the first with its sign, in parentheses by parts."""
    operands = [_product(operand) for operand in operands]
    if len(operands) <= _CHAIN:
        return [token for operand in operands for token in operand]
    terms: list[Token] = []
    for first in range(0, len(operands), _CHAIN):
        part = [token for operand in operands[first : first + _CHAIN] for token in operand]
        terms += [*([("op", "+")] if first else []), ("op", "("), *part, ("op", ")")]
    return terms


def _product(operand: list[Token]) -> list[Token]:
    factors: list[list[Token]] = [[]]
    depth = 0
    for token in operand:
        depth += token in (("op", "("), ("op", "{"))
        depth -= token in (("op", ")"), ("op", "}"))
        if depth == 0 and token[0] == "op" and token[1] in "*/" and factors[-1]:
            factors.append([token])
        else:
            factors[-1].append(token)
    if len(factors) <= _CHAIN:
        return operand
    sign = factors[0][:1] if factors[0][0] in (("op", "+"), ("op", "-")) else []
    product = [*sign]
    for first in range(0, len(factors), _CHAIN):
        part = factors[first : first + _CHAIN]
        tokens = [token for factor in part for token in factor]
        tokens = tokens[len(sign) :] if not first else [("number", "1"), *tokens]
        product += [*([("op", "*")] if first else []), ("op", "("), *tokens, ("op", ")")]
    return product


def _plain(grid: CellGrid, token: Token) -> Token:
    """Return token with its text folded, its sheet as it is called, its name as the cells meant."""
    kind, value = token
    if kind == "text":
        return kind, folded(value)
    if kind == "sheet":
        named = unquoted(value)
        return kind, quoted(grid.title(named) or named)
    area = grid.named(value.casefold()) if kind == "name" else None
    return token if area is None else ("area", f"{quoted(area.sheet)}{_extent(area, '$')}")
