"""What a table is: frozen descriptions that all renderers and the grading take."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from itertools import pairwise
from typing import Any

from kshm.arrays import Columns
from kshm.nomenclature.quantity import Quantity, quantity
from reports.inputs.fields import Field
from reports.inputs.sections.input_file import InputFile
from reports.model.charts import ChartSpec
from reports.shared.russian import short

_BEFORE = re.compile(r"\bprevious\(")
_KEY = re.compile(r"\w+(?:\.\w+)?")  # with the column of a table
_POINT = re.compile(r"gas_point_\d+_(?P<unit>deg|mpa)(?P<regime>_R\d+)?")

TURN = "360"
YES, NO = "да", "НЕТ"
ALLOWED = "allowed_"  # begins the keys of verdicts on what is held to an allowed value
# Equal extremes may differ in the last bit between spreadsheet programs.
TIE = "0.000001"


@dataclass(frozen=True, slots=True)
class Node:
    """One column or one named value with its formula.

    ``of`` names the quantity where the key alone does not.  A ``small`` engine has more
    decimals.  An angle is the same again after ``every`` degrees, 0: never.
    """

    key: str
    expr: str | None
    source: str = ""
    of: str = ""
    small: int = 0
    every: str = TURN
    own: Quantity | None = None  # of a department's book, which no other knows

    @property
    def quantity(self) -> Quantity:
        """Symbol, unit and title."""
        if self.own is not None:
            return self.own
        return quantity(self.of or self.key, self.small)


@dataclass(frozen=True, slots=True)
class Column(Node):
    """One column: its formula per row.

    ``expr`` is None for the column of angles, and for values that the table's ``computed``
    gives.  A helper column serves the formulas of the workbook and is no result.
    """

    helper: bool = False


@dataclass(frozen=True)
class TableSpec:
    """A table over the crank angle.  ``number`` is the book's, ``sheet`` where it stands.

    ``step`` is the distance of the rows of a table on its own grid, None the step of
    the calculation.  ``computed`` gives the columns without formulas that stand in the
    workbook as values: what no sheet can calculate.  ``draws`` are the columns of other tables and
    the runs whose charts are drawn from this one, each with the column or run here.
    """

    id: str
    number: str
    title: str
    sheet: str
    columns: tuple[Column, ...]
    rows: tuple[float, ...]
    note: str = ""
    helper: bool = False
    step: float | None = None
    computed: Callable[[InputFile], Columns] | None = None
    draws: tuple[tuple[str, str], ...] = ()

    @cached_property
    def row_by_row(self) -> bool:
        """Whether rows follow from the rows before them."""
        return any(column.expr and _BEFORE.search(column.expr) for column in self.columns)

    def is_computed(self, column: Column) -> bool:
        """Whether a column holds values in place of formulas."""
        return self.computed is not None and column.expr is None and column != self.columns[0]


@dataclass(frozen=True, slots=True)
class Scalar(Node):
    """One named value.  ``usual`` is the span of a value that is held to one, ends included."""

    expr: str
    note: str = ""
    usual: tuple[float, float] | None = None
    usual_unit: str = ""

    @property
    def usual_text(self) -> str:
        """The usual span in print, ``20…150 МПа``, ``до 40 МПа``; empty where there is none."""
        return f"{self.span_text} {self.usual_unit}" if self.usual_unit else self.span_text

    @property
    def span_text(self) -> str:
        """The usual span without its unit, of one from zero the upper end."""
        if not self.usual:
            return ""
        low, high = map(short, self.usual)
        return f"до {high}" if low == "0" else f"{low}…{high}"

    @property
    def united(self) -> str:
        """The note with the unit of the usual span."""
        return f"{self.note}, {self.usual_unit}" if self.usual_unit else self.note

    @property
    def label(self) -> str:
        """The note with the usual span, as a list says it."""
        return f"{self.note}: обычно {self.usual_text}" if self.usual else self.note


class Held(Enum):
    """What the verdicts of a list hold its values to."""

    CHECK = "signs of a right calculation"
    ALLOWED = "an allowed value"
    USUAL = "what is usual"


@dataclass(frozen=True, slots=True)
class ScalarTable:
    """A list of scalars, one below the other.

    ``verdicts``, the good word and the bad one, says that every value is followed by its
    verdict, which stands in the same row.
    """

    id: str
    title: str
    sheet: str
    scalars: tuple[Scalar, ...]
    note: str = ""
    verdicts: tuple[str, str] | None = None

    @property
    def held(self) -> Held | None:
        """What its verdicts are about; a verdict in words of its own, as of a span, is no check."""
        if not self.pairs:
            return None
        if self.verdicts not in (None, (YES, NO)):
            return Held.USUAL
        return Held.ALLOWED if self.scalars[-1].key.startswith(ALLOWED) else Held.CHECK

    @property
    def pairs(self) -> tuple[tuple[Scalar, Scalar], ...]:
        """Values with their verdicts."""
        return tuple(pair for pair in pairwise(self.scalars) if pair[1].of == "check")


@dataclass(frozen=True, slots=True)
class GridRow:
    """The same quantity for each instance; None where an instance has none."""

    of: str
    cells: tuple[Scalar | None, ...]
    small: int = 0
    own: Quantity | None = None

    @property
    def quantity(self) -> Quantity:
        """Symbol, unit and title."""
        return self.own or quantity(self.of, self.small)


@dataclass(frozen=True, slots=True)
class Grid:
    """Scalars as quantity × instance (throws, rays)."""

    id: str
    title: str
    sheet: str
    labels: tuple[str, ...]
    rows: tuple[GridRow, ...]
    note: str = ""


Block = TableSpec | ScalarTable | Grid


@dataclass(frozen=True, slots=True)
class TextLine:
    """A line of a chapter: its first word, ``paragraph`` without one; where it is written."""

    kind: str
    text: str
    book: str
    number: int

    @property
    def key(self) -> str:
        """What a line is about: the block that it shows, the value of its formula."""
        match = _KEY.match(self.text.strip())
        return match[0] if match else ""


@dataclass(frozen=True, slots=True)
class BookChapter:
    """A chapter that a book says itself: its title and lines, the name of one of the house."""

    title: str
    lines: tuple[TextLine, ...]
    name: str = ""


@dataclass(frozen=True)
class Model:
    """All specifications for one input file: what a workbook or a report consists of.

    ``remarks`` are the lines to stand beside the checks: what is odd about the input, what
    is odd and explained, what is not calculated and why.  ``chapters`` and ``own_nodes``
    are those of own books.  Of a short workbook ``left_out`` are the sheets that it has not,
    ``folded`` those of which it has what other formulas need, ``drawn`` those that charts alone
    are drawn from.
    """

    input: InputFile
    inputs: tuple[Field, ...]
    blocks: tuple[Block, ...]
    charts: tuple[ChartSpec, ...]
    remarks: tuple[str, ...] = ()
    chapters: tuple[BookChapter, ...] = ()
    own_nodes: frozenset[str] = frozenset()  # what no solver knows
    department: frozenset[str] = frozenset()  # those of them that own books have
    left_out: tuple[str, ...] = ()
    folded: frozenset[str] = frozenset()
    drawn: frozenset[str] = frozenset()

    @cached_property
    def tables(self) -> Mapping[str, TableSpec]:
        """Tables over the crank angle by id."""
        return {block.id: block for block in self.blocks if isinstance(block, TableSpec)}

    @cached_property
    def scalars(self) -> Mapping[str, Scalar]:
        """Computed scalars by key."""
        return {scalar.key: scalar for block in self.blocks for scalar in scalars_of(block)}

    @cached_property
    def fields(self) -> Mapping[str, Field]:
        """Input fields by the name of their cell."""
        return {field.name: field for field in self.inputs}

    @cached_property
    def input_runs(self) -> Mapping[str, tuple[str, ...]]:
        """Names of the cells of a diagram given by points, ``gas_points_deg`` and the like."""
        runs: dict[str, list[str]] = {}
        for item in self.inputs:
            match = _POINT.fullmatch(item.name)
            if match is not None:
                key = f"gas_points_{match['unit']}{match['regime'] or ''}"
                runs.setdefault(key, []).append(item.name)
        return {key: tuple(names) for key, names in runs.items()}

    @cached_property
    def charts_by_id(self) -> Mapping[str, ChartSpec]:
        """Charts of workbook and report by id."""
        return {chart.id: chart for chart in self.charts}

    @cached_property
    def sheets(self) -> tuple[str, ...]:
        """Titles of the sheets that carry blocks, in order."""
        return tuple(dict.fromkeys(block.sheet for block in self.blocks))

    @cached_property
    def nodes(self) -> Mapping[str, Node]:
        """Scalars by key and columns as ``table.column``."""
        return {key: node for block in self.blocks for key, node in nodes_in(block)}

    @cached_property
    def grid_runs(self) -> Mapping[str, tuple[str, ...]]:
        """Keys of the scalars of a grid's row, as ``grid.quantity``."""
        return {
            f"{block.id}.{row.of}": tuple(cell.key for cell in row.cells if cell is not None)
            for block in self.blocks
            if isinstance(block, Grid)
            for row in block.rows
        }

    @cached_property
    def draws(self) -> Mapping[str, str]:
        """Columns and runs that charts name → those that they are drawn from."""
        return {key: drawn for table in self.tables.values() for key, drawn in table.draws}

    @cached_property
    def grid_rows(self) -> Mapping[str, GridRow]:
        """Rows of grids as ``grid.quantity``."""
        return {
            f"{block.id}.{row.of}": row
            for block in self.blocks
            if isinstance(block, Grid)
            for row in block.rows
        }

    @cached_property
    def whole_tables(self) -> Mapping[str, TableSpec]:
        """Tables of the columns that are found together, not each for itself."""
        return {
            f"{table.id}.{column.key}": table
            for table in self.tables.values()
            for column in table.columns
            if table.is_computed(column) or (table.row_by_row and column.expr)
        }

    @cached_property
    def programs(self) -> dict[str, Any]:
        """How nodes are calculated, as ``reports.model.evaluation`` finds it out."""
        return {}

    def with_inputs(self, input_file: InputFile, inputs: tuple[Field, ...]) -> Model:
        """Return the same specifications for an input of the same structure."""
        copy = Model(input_file, inputs, self.blocks, self.charts, self.remarks, self.chapters,
                     self.own_nodes, self.department)  # fmt: skip
        # What follows from the blocks and from the names of the inputs is the same as well.
        for name in (
            "tables", "scalars", "input_runs", "sheets", "nodes", "grid_runs", "whole_tables",
            "programs",
        ):  # fmt: skip
            copy.__dict__[name] = getattr(self, name)
        return copy


def nodes_in(block: Block) -> Iterator[tuple[str, Node]]:
    """Columns as ``table.column`` or scalars by key."""
    if isinstance(block, TableSpec):
        yield from ((f"{block.id}.{column.key}", column) for column in block.columns)
    yield from ((scalar.key, scalar) for scalar in scalars_of(block))


def scalars_of(block: Block) -> Iterator[Scalar]:
    """All scalars of a block."""
    if isinstance(block, ScalarTable):
        yield from block.scalars
    elif isinstance(block, Grid):
        for row in block.rows:
            yield from (cell for cell in row.cells if cell is not None)


def judged(
    value_key: str,
    key: str,
    value: str,
    test: str,
    note: str,
    source: str = "проверка",
    words: tuple[str, str] = (YES, NO),
    usual: tuple[float, float] | None = None,
    unit: str = "",
) -> tuple[Scalar, Scalar]:
    """Return a value and whether it passes; ``{value}`` in the test stands for it."""
    good, bad = words
    verdict = f'"{good}" if {test.format(value=value_key)} else "{bad}"'
    return (
        Scalar(value_key, value, source, note=note, usual=usual, usual_unit=unit, of="check_value"),
        Scalar(key, verdict, note=note, usual=usual, usual_unit=unit, of="check"),
    )


def allowed(
    id_: str, title: str, sheet: str, limit: str, lines: Iterable[tuple[str, str, str]]
) -> ScalarTable:
    """Key, formula and name of values that are held to an input, ``>= name`` or ``<= name``."""
    scalars = [
        scalar
        for key, value, note in lines
        for scalar in judged(f"value_{key}", f"{ALLOWED}{key}", value, f"{{value}} {limit}", note,
                             "сравнение с допускаемым")
    ]  # fmt: skip
    return ScalarTable(id_, title, sheet, tuple(scalars), verdicts=(YES, NO))


def extreme_columns(column: str, name: str) -> tuple[Column, ...]:
    """Return helper columns: the angle where the value is the extreme, the last angle elsewhere."""
    high, low = f"{name}_max", f"{name}_min"
    return (
        Column(
            "at_max_deg",
            f"phi_deg if {column} > {high} - {TIE} else col_last(phi_deg)",
            "вспомогательный",
            helper=True,
        ),
        Column(
            "at_min_deg",
            f"phi_deg if {column} < {low} + {TIE} else col_last(phi_deg)",
            "вспомогательный",
            helper=True,
        ),
    )


def extreme_scalars(table: str, column: str, name: str, source: str) -> tuple[Scalar, ...]:
    """Largest and smallest value of a column and their angles."""
    return (
        Scalar(f"{name}_max", f"col_max({table}.{column})", source),
        Scalar(f"phi_{name}_max_deg", f"col_min({table}.at_max_deg)", source),
        Scalar(f"{name}_min", f"col_min({table}.{column})", source),
        Scalar(f"phi_{name}_min_deg", f"col_min({table}.at_min_deg)", source),
    )


def corners(
    grid: str, title: str, sheet: str, box: str, size: str, of: str = "box",
    source: str = "оси диаграммы",
) -> Grid:  # fmt: skip
    """Corners that keep both axes of a diagram equal whatever its values become."""
    cells = (
        Scalar(f"{box}{n}", text, source, of=of) for n, text in enumerate((f"-{size}", size), 1)
    )
    row = GridRow(of, tuple(cells))
    return Grid(grid, title, sheet, ("−", "+"), (row,))
