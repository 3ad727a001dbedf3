"""Sheet of the moving mechanism, drawn by formulas and charts at a chosen angle.

Every cell is an expression of the same language as the tables; points are in millimetres, the
crank turns clockwise, the cylinder stands upright.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import count
from typing import Any

import numpy as np
from openpyxl.workbook import Workbook
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.datavalidation import DataValidation
from openpyxl.worksheet.worksheet import Worksheet

from kshm.nomenclature.quantity import quantity
from reports.formula.excel import compile_formula
from reports.formula.numeric import evaluate
from reports.inputs.to_si.engine import smallness_of
from reports.model.blocks import Model
from reports.model.charts import Series
from reports.model.shape import Shape, cylinder_table_id
from reports.workbook import styles
from reports.workbook.chart_ranges import Drawn, drawn_from
from reports.workbook.charts import HIGH, drawing
from reports.workbook.layout import NOTE_ROW, Cell, Layout, RowReferences, column_range, quoted
from reports.workbook.places import GAP, Box, anchor
from reports.workbook.sheets import BlockWriter

SHEET = "Механизм"
ANGLE, CYLINDER = "view_phi_deg", "view_cylinder"
# Values whose size goes with the engine's: they have the decimals of their columns.
_ON_PIN = quantity("Krod_MPa")
_AS_IN_TABLES = {"gas_V": "volume_dm3", "torque": "Msum_Nm"}
_SERVING = {"view_knot", "view_share", "r", "L", "D", "scale", "xa", "ya", "xb", "yb"}
_FORCES = {"P": "Ps_MPa", "N": "N_MPa", "S": "S_MPa", "T": "T_MPa", "K": "K_MPa"}
_TABLES = ("P4_1", "P4_2", "gas", "crankpin")
_BOX = "crankpin_box.box"  # limits of the pin's diagram
_FRAME, _STEP = ("crankpin_frame.frame_x", "crankpin_frame.frame_y"), "crankpin_frame.frame_step"
_POINTS = 54  # row of the first point: below the charts
_WIDTHS = {"A": 24, "B": 9, "C": 8}
_LEFT = 287  # px of these columns, beside the charts
WIDE = 384  # px: three to a row
_START = 30.0  # deg
SHAPE = 0.68  # width of the drawing over its height


@dataclass
class _View(RowReferences):
    """Cells of the sheet by key, besides all that the book has."""

    layout: Layout
    inputs: dict[str, Any]
    own: dict[str, str] = field(default_factory=dict)
    values: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__init__(self.layout, None)

    def name(self, key: str) -> str:
        """Return a cell of this sheet, or a name of the book."""
        return self.own.get(key) or super().name(key)

    def column(self, key: str, *, repeat_last: bool) -> str:
        """Return a column of this sheet, or of a table."""
        return self.own.get(key) or super().column(key, repeat_last=repeat_last)

    def value(self, key: str) -> Any:  # noqa: ANN401
        """Return what a key stands for."""
        return self.values[key] if key in self.values else self.inputs[key]


def nodes_read(model: Model) -> list[str]:
    """Columns of the cylinders that the sheet shows."""
    cylinders = range(1, Shape.of(model.input).cylinders + 1)
    nodes = (f"{cylinder_table_id(i)}.{of}" for i in cylinders for of in _FORCES.values())
    return [node for node in nodes if node in model.nodes]


def can_move(writer: BlockWriter) -> bool:
    """Whether the book has the numbers of all tables that the sheet shows."""
    columns = writer.values.columns
    return (
        all(
            name in columns and all(np.isfinite(c).all() for c in columns[name].values())
            for name in _TABLES
        )
        and {"r_crank", "L_rod", "lam", "F_piston", *writer.layout.keys_of_run(_BOX)}
        <= writer.values.scalars.keys()
    )


def write_motion(book: Workbook, model: Model, writer: BlockWriter) -> list[Box]:
    """Fill the sheet; the places of its charts."""
    sheet = book[SHEET]
    inputs: dict[str, Any] = {f.name: f.value for f in model.inputs} | writer.values.scalars
    for table, columns in writer.values.columns.items():
        inputs |= {f"{table}.{key}": column for key, column in columns.items()}
    view = _View(writer.layout, inputs)
    shape = Shape.of(model.input)
    numbers = [i for i in range(1, shape.cylinders + 1) if not shape.is_hung(i)]
    for letter, width in _WIDTHS.items():
        sheet.column_dimensions[letter].width = width
    _choices(book, sheet, model, view, numbers)
    _by_cylinder(sheet, writer, view, numbers, shape)
    _chosen(sheet, writer, view, shape, smallness_of(model.input))
    drawn = _drawings(sheet, writer, view, shape)
    return _charts(sheet, writer, drawn)


def _put(
    sheet: Worksheet, writer: BlockWriter, view: _View, at: tuple[int, int], key: str, text: str
) -> None:
    """One cell: its formula, its value for the cache, its key for further formulas."""
    row, column = at
    value = float(evaluate(text, view.value))
    view.values[key] = value
    view.own[key] = _local(Cell(SHEET, row, column).absolute)
    writer.formula(sheet, row, column, compile_formula(text, view), value)
    cell = sheet.cell(row, column)
    cell.style, cell.number_format = styles.FORMULA, "0.000"


def _local(address: str) -> str:
    """Return an address without its sheet."""
    return address.rpartition("!")[2]


def _choices(
    book: Workbook, sheet: Worksheet, model: Model, view: _View, cylinders: Sequence[int]
) -> None:
    """Write the two cells that a person changes."""
    angles = model.tables["P4_1"].rows
    step = angles[1] - angles[0]
    start = step * round(_START / step)
    listed = (
        (4, ANGLE, "Угол поворота вала φ", start, "°",
         "=" + view.column("P4_1.phi_deg", repeat_last=False)),
        (5, CYLINDER, "Цилиндр", cylinders[0], "", '"' + ",".join(map(str, cylinders)) + '"'),
    )  # fmt: skip
    for row, key, title, value, unit, choices in listed:
        sheet.cell(row, 1, title).style = styles.TEXT
        sheet.cell(row, 2, value).style = styles.INPUT
        sheet.cell(row, 3, unit or None).style = styles.UNIT
        rule = DataValidation(type="list", formula1=choices.removeprefix("="), allow_blank=False)
        rule.showErrorMessage, rule.error = True, "Выберите значение из списка."
        sheet.add_data_validation(rule)
        rule.add(sheet.cell(row, 2))
        view.values[key], view.own[key] = float(value), f"$B${row}"
        cell = Cell(SHEET, row, 2).absolute
        book.defined_names[key] = DefinedName(key, attr_text=cell)
    sheet.cell(NOTE_ROW, 3, "Выберите угол из списка (Alt+↓, затем ↑ и ↓): всё встанет на место.")
    sheet.cell(NOTE_ROW, 3).style = styles.NOTE


def _by_cylinder(
    sheet: Worksheet, writer: BlockWriter, view: _View, cylinders: Sequence[int], shape: Shape
) -> None:
    """Own angle and forces of every cylinder at the chosen angle, below the charts."""
    head = ("Цилиндр", "ψ, °", *(f"{force}, МПа" for force in _FORCES))
    row = _POINTS + 12
    sheet.cell(row - 1, 1, "Цилиндры при этом угле").style = styles.SUBTITLE
    for column, title in enumerate(head, 1):
        sheet.cell(row, column, title).style = styles.HEADER
    numbers = range(1, shape.cylinders + 1)
    serving = row + len(numbers) + 3
    sheet.cell(serving - 1, 1, "Для чертежа").style = styles.SUBTITLE
    _put(sheet, writer, view, (serving, 2), "view_row", f"round({ANGLE}/calculation_step_deg) + 1")
    sheet.cell(serving, 1, "Строка таблиц").style = styles.TEXT
    sheet.cell(serving, 2).number_format = "0"
    for i in numbers:
        sheet.cell(row + i, 1, f"цилиндр {i}").style = styles.HEADER
        texts = {"psi": f"mod({ANGLE} - firing_offset_{i}_deg, {shape.period})"}
        for force, of in _FORCES.items():
            table = cylinder_table_id(i)
            is_input = f"{table}.{of}" in view.inputs and i in cylinders
            texts[force] = f"element({table}.{of}, view_row)" if is_input else "0"
        for column, (key, text) in enumerate(texts.items(), 2):
            _put(sheet, writer, view, (row + i, column), f"{key}_{i}", text)
    for column, key in enumerate(("psi", *_FORCES), 2):
        run = column_range(SHEET, column, row + 1, row + shape.cylinders)
        view.own[f"all_{key}"] = _local(run)
        view.values[f"all_{key}"] = np.array([view.values[f"{key}_{i}"] for i in numbers])


def _chosen(sheet: Worksheet, writer: BlockWriter, view: _View, shape: Shape, small: int) -> None:
    """Write what is known of the chosen cylinder: angles, forces, pressure, torque."""

    def at_psi(column: str) -> str:
        before = f"element({column}, view_knot)"
        return f"{before} + view_share*(element({column}, view_knot + 1) - {before})"

    def of_pin(column: str) -> str:
        return at_psi(column) if shape.single_rods else f"element({column}, view_row)"

    lines = (
        ("psi", "Угол от его ВМТ ψ", "°", f"element(all_psi, {CYLINDER})"),
        ("beta", "Угол шатуна β", "рад", shape.beta("psi")),
        ("view_knot", "Строка таблиц до ψ", "", "floor(psi/calculation_step_deg) + 1"),
        ("view_share", "Доля шага после неё", "",
         "psi/calculation_step_deg - floor(psi/calculation_step_deg)"),
        *((f, f"Сила {f}", "МПа", f"element(all_{f}, {CYLINDER})") for f in _FORCES),
        ("gas_p", "Давление газов p", "МПа", at_psi("gas.p_MPa")),
        ("gas_V", "Объём V", "дм³", at_psi("gas.volume_dm3")),
        ("torque", "Суммарный момент ΣM", "Н·м", "element(P4_2.Msum_Nm, view_row)"),
        ("pin_T", "Нагрузка шейки: T", "МПа", of_pin("crankpin.T_MPa")),
        ("pin_K", f"Нагрузка шейки: {_ON_PIN.symbol}", "МПа", of_pin("crankpin.Krod_MPa")),
        ("r", "Радиус кривошипа r", "мм", "to_mm(r_crank)"),
        ("L", "Длина шатуна L", "мм", "to_mm(L_rod)"),
        ("D", "Диаметр цилиндра D", "мм", "to_mm(sqrt(4*F_piston/pi))"),
        ("scale", "Масштаб сил", "мм/МПа",
         "1.1*r/max(col_max(P4_1.S_MPa), 0 - col_min(P4_1.S_MPa), 0.001)"),
        ("xa", "Шатунная шейка: x", "мм", "r*sin(rad(psi))"),
        ("ya", "Шатунная шейка: y", "мм", "r*cos(rad(psi))"),
        ("xb", "Поршневой палец: x", "мм", "xa - L*sin(beta)"),
        ("yb", "Поршневой палец: y", "мм", "ya + L*cos(beta)"),
    )  # fmt: skip
    read, serving = count(6), count(_POINTS + 12 + shape.cylinders + 4)
    for key, title, unit, text in lines:
        row = next(serving if key in _SERVING else read)
        sheet.cell(row, 1, title).style = styles.TEXT
        sheet.cell(row, 3, unit or None).style = styles.UNIT
        _put(sheet, writer, view, (row, 2), key, text)
        if key in _AS_IN_TABLES:
            look = styles.excel_format(quantity(_AS_IN_TABLES[key], small))
            sheet.cell(row, 2).number_format = look


def _shapes(shape: Shape) -> dict[str, list[tuple[str, str]]]:
    """Broken lines of the drawing by what they show, as expressions of x and y."""
    low, high = "L - r - 0.45*D", "L + r + 0.6*D"
    wall, half = "0.52*D", "0.5*D"
    weight = [(f"1.15*r*sin(rad(psi + {a}))", f"1.15*r*cos(rad(psi + {a}))")
              for a in (130, 150, 170, 190, 210, 230)]  # fmt: skip
    shapes = {
        "цилиндр": [(f"xb - {wall}", low), (f"xb - {wall}", high), (f"xb + {wall}", high),
                    (f"xb + {wall}", low)],
        "противовес": [("0", "0"), *weight, ("0", "0")],
        "кривошип": [("0", "0"), ("xa", "ya")],
        "шатун": [("xa", "ya"), ("xb", "yb")],
        "поршень": [(f"xb {x} {half}", f"yb {y}") for x, y in
                    (("-", "- 0.35*D"), ("-", "+ 0.45*D"), ("+", "+ 0.45*D"), ("+", "- 0.35*D"),
                     ("-", "- 0.35*D"))],
    }  # fmt: skip
    along, across = ("sin(rad(psi))", "cos(rad(psi))"), ("cos(rad(psi))", "-sin(rad(psi))")
    arrows = {
        "P": ("xb", "yb", "0", "0 - P"),
        "N": ("xb", "yb", "0 - N", "0"),
        "S": ("xb", "yb", "S*sin(beta)", "0 - S*cos(beta)"),
        "T": ("xa", "ya", f"T*{across[0]}", f"T*({across[1]})"),
        "K": ("xa", "ya", f"0 - K*{along[0]}", f"0 - K*{along[1]}"),
    }
    for force, (x, y, dx, dy) in arrows.items():
        tip = (f"{x} + scale*({dx})", f"{y} + scale*({dy})")
        barbs = [
            (
                f"{x} + scale*(0.82*({dx}) {a} 0.08*({dy}))",
                f"{y} + scale*(0.82*({dy}) {b} 0.08*({dx}))",
            )
            for a, b in ("+-", "-+")
        ]
        shapes[force] = [(x, y), tip, barbs[0], tip, barbs[1]]
    throws = range(1, shape.throws + 1)
    star = [(f"sin(rad(throw_angle_{t}_deg + {ANGLE}))", f"cos(rad(throw_angle_{t}_deg + {ANGLE}))")
            for t in throws]  # fmt: skip
    shapes["колена"] = [p for end in star for p in (("0", "0"), end)]
    shapes["первое колено"] = [("0", "0"), star[0]]
    side = "(2*r + 0.62*D + L)"
    shapes["рамка"] = [
        (f"0 - {side}*{SHAPE / 2}", "0 - 1.3*r"),
        (f"{side}*{SHAPE / 2}", f"{side} - 1.3*r"),
    ]
    return shapes


def _drawings(
    sheet: Worksheet, writer: BlockWriter, view: _View, shape: Shape
) -> dict[str, tuple[Drawn, list[float], list[float]]]:
    """Points of the broken lines, two columns each, and the moving points of the charts."""
    column = 10
    top = sheet.cell(_POINTS - 2, column, "Точки чертежа, мм")
    top.style = styles.SUBTITLE
    drawings: dict[str, tuple[Drawn, list[float], list[float]]] = {}
    for name, points in _shapes(shape).items():
        for offset, letter in enumerate("xy"):
            sheet.cell(_POINTS - 1, column + offset, f"{name}: {letter}").style = styles.HEADER
        for i, pair in enumerate(points):
            for offset, text in enumerate(pair):
                at = (_POINTS + i, column + offset)
                _put(sheet, writer, view, at, f"point_{column + offset}_{i}", text)
        across, up = (
            [float(view.values[f"point_{column + o}_{i}"]) for i in range(len(points))]
            for o in (0, 1)
        )
        last = _POINTS + len(points) - 1
        xs, ys = (column_range(SHEET, column + o, _POINTS, last) for o in (0, 1))
        drawings[name] = (Drawn(name, xs, ys), across, up)
        column += 2
    moving = {
        "p–V": ("gas_V", "gas_p"), "силы": ("psi", "P"), "момент": (ANGLE, "torque"),
        "шейка": ("pin_T", "pin_K"),
    }  # fmt: skip
    for name, (x, y) in moving.items():
        line = Drawn(name, _whole(view.own[x]), _whole(view.own[y]), point=True)
        drawings[name] = (line, [view.values[x]], [view.values[y]])
    return drawings


def _whole(cell: str) -> str:
    """Return a cell of the sheet as charts name it."""
    return f"{quoted(SHEET)}!{cell}"


def _charts(
    sheet: Worksheet, writer: BlockWriter, drawn: dict[str, tuple[Drawn, list[float], list[float]]]
) -> list[Box]:
    """Return the mechanism on the left, five diagrams with a moving point beside it."""
    for line, xs, ys in drawn.values():
        writer.caches.ranges |= {line.x: xs, line.y: ys}
    layout, values = writer.layout, writer.values

    def curve(name: str, x: str, y: str) -> Drawn:
        series = drawn_from(Series(x, y, name), layout)
        for at in (series.x, series.y):
            table, key = at.split(".")
            writer.caches.ranges[layout.range_of(at)] = values.columns[table][key].tolist()
        return Drawn(name, layout.range_of(series.x), layout.range_of(series.y))

    def run(key: str) -> str:
        numbers = [float(values.scalars[name]) for name in layout.keys_of_run(key)]
        writer.caches.ranges[layout.range_of(key)] = numbers
        return layout.range_of(key)

    is_live = _FRAME[0] in layout.model.grid_runs
    across, up = map(run, _FRAME if is_live else (_BOX, _BOX))
    step = float(values.scalars[layout.keys_of_run(_STEP)[0]]) if is_live else 0.0
    of = {name: line for name, (line, _, _) in drawn.items()}
    frame = Drawn("рамка", of["рамка"].x, of["рамка"].y, hidden=True)
    turn = float(values.columns["P4_1"]["phi_deg"][-1])
    charts = (
        drawing("Механизм и силы", ("мм", "мм"), [
            *(of[n] for n in ("цилиндр", "противовес", "кривошип", "шатун", "поршень", *_FORCES)),
            frame], shape=SHAPE, wide=WIDE),
        drawing("Индикаторная диаграмма", ("V, дм³", "p, МПа"),
                [curve("p", "gas.volume_dm3", "gas.p_MPa"), of["p–V"]]),
        drawing("Удельные силы", ("ψ, °", "МПа"),
                [curve("Pг", "P4_1.phi_deg", "P4_1.Pg_MPa"),
                 curve("Pj", "P4_1.phi_deg", "P4_1.Pj_MPa"),
                 curve("P", "P4_1.phi_deg", "P4_1.Ps_MPa"), of["силы"]], turn=turn),
        drawing("Крутящий момент двигателя", ("φ, °", "ΣM, Н·м"),
                [curve("ΣM", "P4_2.phi_deg", "P4_2.Msum_Nm"), of["момент"]], turn=turn),
        drawing("Нагрузка шатунной шейки 1", ("T, МПа", _ON_PIN.header),
                [curve("R", "crankpin.T_MPa", "crankpin.Krod_MPa"), of["шейка"],
                 Drawn("оси", across, up, hidden=True)], shape=1.0, downwards=True, wide=WIDE,
                limit=max(map(abs, writer.caches.ranges[across])), step=step),
        drawing("Звезда кривошипов с носка вала", ("", ""),
                [of["колена"], of["первое колено"]], shape=1.0, unit=True, wide=WIDE),
    )  # fmt: skip
    top, right = 64, _LEFT + GAP + WIDE + GAP
    boxes = [
        Box(_LEFT + GAP, top, WIDE, 2 * HIGH + GAP),
        *(Box(right + (WIDE + GAP) * (n % 2), top + (HIGH + GAP) * (n // 2), WIDE, HIGH)
          for n in range(5)),
    ]  # fmt: skip
    for chart, box in zip(charts, boxes, strict=True):
        chart.anchor = anchor(sheet, box)
        sheet.add_chart(chart)
    return boxes
