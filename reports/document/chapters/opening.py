"""Introduction and the tables of input data."""

from __future__ import annotations

import math
import re
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import accumulate

import numpy as np
from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.figures.schemes import engine_scheme
from reports.document.page.blocks import (
    TableBlock,
    TableColumn,
    list_block,
    symbol_head,
    table_block,
    unit_cell,
)
from reports.document.page.charts import mechanism_of, sizes_figure, throw_of
from reports.document.page.numbering import Figure, TablePlan
from reports.document.text.symbols import inline_html
from reports.document.text.terms import (
    Terms,
    field_title,
    input_text,
    is_twice_radius,
    plain_number,
)
from reports.formula.tex import input_symbol_tex
from reports.inputs.fields import Field
from reports.inputs.sections.gas import TableGasSection
from reports.inputs.sections.input_file import LAYOUTS, InputFile
from reports.model.context import diagram_kind
from reports.model.shape import Shape
from reports.shared.errors import SymbolError
from reports.shared.russian import cylindered, instrumental, joined
from reports.tables.left_out import unused

POINTS_FILE = "диаграмма.csv"  # all points of a diagram, attached to the PDF
_LISTS = ("firing_offset_", "throw_angle_", "force_offset_", "web_", "gas_point_")
_ARMS = ("l1", "l2", "l3", "l4", "l5", "l6", "left_web", "right_web")
# Sections that are told elsewhere.
_OTHERS = {"report", "workbook", "prototype", "regimes", "checks"}
_LEFT_OUT = {"engine_name", "engine_layout", "engine_strokes"}
# Ways of calculating, which the chapters' formulas show.
_LEFT_OUT |= {f"strength_{form}_form" for form in ("crown", "pin", "oval", "bolt")}
# Subjects whose symbols are listed where a formula or a sentence has them.
_SUBJECTS = ("tor_", "oil_", "safe_", "mat_", "st_", "cw_")


# Abbreviations of the report and the nodes whose symbols run through it.
_ABBREVIATIONS = (
    ("ВМТ", "верхняя мёртвая точка"),
    ("КПД", "коэффициент полезного действия"),
    ("КШМ", "кривошипно-шатунный механизм"),
    ("НМТ", "нижняя мёртвая точка"),
)
_SYMBOLS = (
    "phi_deg", "P3_2.beta_rad", "lam", "r_crank", "L_rod", "geometry_bore_mm", "S_stroke",
    "geometry_compression_ratio", "k_offset", "F_piston", "V_h", "V_c", "omega",
    "regime_speed_rpm", "c_m", "P3_1.s_mm", "P3_1.v_m_s", "P3_1.j_m_s2", "m_j", "m_1", "m_2",
    "m_r", "K_r", "gas.p_MPa", "P4_1.Pg_MPa", "P4_1.Pj_MPa", "P4_1.Ps_MPa", "P4_1.N_MPa",
    "P4_1.S_MPa", "P4_1.T_MPa", "P4_1.K_MPa", "P4_1.M_Nm", "P4_2.Msum_Nm", "M_mean",
    "crankpin.Rpin_MPa", "crankpin.psi_deg", "P4_3_1.R_MPa",
)  # fmt: skip
_ACROSS, _COLUMN = 40, 40  # letters of a line, lines of a column in the list of symbols
Points = Sequence[tuple[float, float]]


def notation(chapter: Chapter, text: str | None = None) -> Markup:
    """Abbreviations and symbols that run through the report.

    Args:
        chapter: tools.
        text: the other chapters once they are written; the list, which stands before them, is
            then written again with what occurs in them.
    """
    terms = chapter.terms
    present = [name for name in _SYMBOLS if name == "phi_deg" or terms.has(name)]
    present += _of_subjects(chapter)
    abbreviations, again = list(_ABBREVIATIONS), {}
    if text is not None:
        formulas = "\n".join(chapter.writer.formulas)
        present = [name for name in present if _occurs(_tex(terms, name), text, formulas)]
        abbreviations = [pair for pair in abbreviations if re.search(rf"\b{pair[0]}\b", text)]
        again = {"h": chapter.writer.heading_again}
    symbols = [(terms.sym(name), terms.title(name), terms.unit(name)) for name in present]
    second = _second_column(abbreviations, symbols)
    return chapter.page("notation", abbreviations=abbreviations, symbols=symbols, second=second,
                        **again)  # fmt: skip


def _second_column(
    abbreviations: Sequence[tuple[str, str]], symbols: Sequence[tuple[Markup, str, str]]
) -> int | None:
    """Return the symbol that begins the second column; none where a page does not hold them."""
    lengths = [sum(map(len, each)) for each in abbreviations]
    lengths += [len(sign.striptags()) + len(title) + len(unit) for sign, title, unit in symbols]
    ends = list(accumulate(math.ceil((length + len(" — , ")) / _ACROSS) for length in lengths))
    if ends[-1] > 2 * _COLUMN:
        return None
    return bisect_left(ends, ends[-1] / 2) + 1 - len(abbreviations)


def _of_subjects(chapter: Chapter) -> list[str]:
    """One name for every symbol of the chapters that have quantities of their own."""
    model = chapter.model
    nodes = dict(model.scalars.items()) | {
        f"{table}.{column.key}": column
        for table, block in model.tables.items()
        for column in block.columns
    }
    others = {_bare(input_symbol_tex(field.symbol or "")) for field in model.fields.values()}
    own: dict[str, dict[str, str]] = {}  # symbol → title → name
    for name, node in nodes.items():
        tex = node.quantity.tex
        if not name.rpartition(".")[2].startswith(_SUBJECTS):
            others.add(_bare(tex))
        elif len(tex) > 1:  # a letter alone counts rows
            title = re.sub(r"\d", "", node.quantity.title)
            own.setdefault(tex, {}).setdefault(title, name)
    others.add(_bare(chapter.terms.tex("phi_deg")))
    return [
        next(iter(names.values()))
        for tex, names in own.items()
        if _bare(tex) not in others and _is_simple(tex)
    ]


def _bare(tex: str) -> str:
    """Return a symbol without braces and spaces, which do not tell it from another."""
    return re.sub(r"[{}\s]", "", tex)


def _is_simple(tex: str) -> bool:
    """Whether a symbol is a letter with indices, not a formula or a sign of a helper."""
    try:
        return bool(re.match(r"(<span class=\"bar\">)?<i>|[ΔΣ]", inline_html(tex)))
    except SymbolError:
        return False


def _tex(terms: Terms, name: str) -> str:
    """Symbol of a name; of the subjects' ones, which are many, that of their quantity."""
    own = name.rpartition(".")[2].startswith(_SUBJECTS)
    return terms.quantity(name).tex if own else terms.tex(name)


def _occurs(tex: str, text: str, formulas: str) -> bool:
    """Whether a symbol stands in the text or in the formulas, and no longer one of its letters."""
    shown = str(inline_html(tex))
    if shown not in text and tex not in formulas:  # told at once of most
        return False
    written = re.escape(shown) + "(?!<su[bp]>|′)"
    return bool(re.search(written, text)) or bool(
        re.search(rf"(?<![A-Za-z\\]){re.escape(tex)}(?![A-Za-z_'])", formulas)
    )


def introduction(chapter: Chapter) -> Markup:
    """Introduction: what is computed and how."""
    names = chapter.relevant
    # Some things have an «и» of their own.
    findings = (words for each in chapter.records if each.name in names for words in each.findings)
    results = joined(list(findings), ", а также ")
    return chapter.page(
        "introduction", found=results, cycle="cycle" in names, appended="appendices" in names
    )


def input_data(chapter: Chapter) -> Markup:
    """Tables of the input data."""
    model = chapter.input
    fields = chapter.model.inputs
    shown, step = printed(model, chapter.printed_step or model.calculation.step_deg)
    plans = {
        "inputs": TablePlan(
            partial(_general, model, fields, unused(model) | _elsewhere(chapter)),
            "Исходные данные для расчёта",
            size="dense",
        ),
        "phases": TablePlan(partial(_phases, fields, model), "Фазы работы цилиндров и углы колен"),
        "webs": TablePlan(partial(_webs, fields), "Щёки и их противовесы", keep=True),
        "arms": TablePlan(partial(_arms, fields), "Размеры колен, мм", size="dense", keep=True),
        "points": TablePlan(partial(_points, shown), "Точки индикаторной диаграммы"),
    }
    return chapter.page(
        "inputs",
        plans=plans,
        scheme=partial(scheme_text, chapter),
        sizes=Figure(
            partial(sizes_figure, throw_of(chapter.terms), mechanism_of(chapter.terms), size=1.0),
            "Размеры, мм: а — колено вала; б — кривошипно-шатунный механизм",
        ),
        by_points=isinstance(model.gas, TableGasSection),
        smooth=diagram_kind(model.gas) == "smooth",
        points_step=step,
        points_file=POINTS_FILE,
    )


def _elsewhere(chapter: Chapter) -> set[str]:
    """Names of the fields that only chapters read which this report has not."""
    readers = {section: record.name for record in chapter.records for section in record.sections}
    return {
        field.name
        for field in chapter.model.inputs
        if readers.get(str(field.path[0]), "inputs") not in chapter.relevant
    }


def _is_listed(field: Field) -> bool:
    return field.name.startswith(_LISTS) or field.name.startswith("throw_")


def _general(model: InputFile, fields: Sequence[Field], unused: set[str]) -> TableBlock:
    rows = []
    for field in fields:
        if field.name in unused:
            continue
        if field.path[0] in _OTHERS or field.name in _LEFT_OUT or _is_listed(field):
            continue
        tex = "2r" if is_twice_radius(field, model) else input_symbol_tex(field.symbol or "")
        symbol = inline_html(tex) if field.symbol else "—"
        value, degrees, _ = input_text(field).partition("°" if field.choices is not None else "\0")
        unit = degrees or ("—" if field.choices is not None else unit_cell(field.unit))
        row = [field_title(field, model), symbol, value, unit]
        if row not in rows:  # what several sections need is told once
            rows.append(row)
    return list_block(rows)


def _named(fields: Sequence[Field], pattern: str, count: int) -> Iterator[str]:
    """Values of the fields ``pattern`` with the numbers 1 … count."""
    values = {field.name: field.value for field in fields}
    for number in range(1, count + 1):
        yield plain_number(float(values[pattern.format(number)]))


def _numbered(fields: Sequence[Field], patterns: Sequence[str], count: int) -> list[list[str]]:
    """Rows of the numbers 1 … count with the values of the fields after them."""
    columns = [map(str, range(1, count + 1)), *(_named(fields, p, count) for p in patterns)]
    return [list(row) for row in zip(*columns, strict=True)]


def _phases(fields: Sequence[Field], model: InputFile) -> TableBlock:
    shape = Shape.of(model)
    count, numbers = shape.cylinders, range(1, shape.cylinders + 1)
    angles = list(_named(fields, "throw_angle_{}_deg", shape.throws))
    columns = [
        TableColumn("Цилиндр" if shape.banks else "Цилиндр и колено"),
        TableColumn(symbol_head(r"\theta_i", "°")),
        TableColumn(symbol_head(r"\gamma_i", "°")),
    ]
    cells = [
        [str(i) for i in numbers],
        list(_named(fields, "firing_offset_{}_deg", count)),
        [angles[shape.throw_of(i) - 1] for i in numbers],
    ]
    if shape.banks:
        columns[1:1] = [TableColumn("Ряд"), TableColumn("Колено")]
        banks = ["правый" if shape.is_right(i) else "левый" for i in numbers]
        cells[1:1] = [banks, [str(shape.throw_of(i)) for i in numbers]]
    if model.crankshaft.force_offsets_deg is not None:
        columns.append(TableColumn(symbol_head(r"\theta^{*}_i", "°")))
        cells.append(list(_named(fields, "force_offset_{}_deg", count)))
    return table_block(columns, list(zip(*cells, strict=True)))


def _webs(fields: Sequence[Field]) -> TableBlock:
    count = sum(field.name.endswith("_counterweight_kg") for field in fields)
    keys: tuple[str, ...] = (
        "mass_kg", "angle_deg", "counterweight_kg", "counterweight_angle_deg",
    )  # fmt: skip
    heads = (
        (r"m_{\mathrm{щ}}", "кг"),
        (r"\alpha_{\mathrm{щ}}", "°"),
        (r"m_{\mathrm{пр}}", "кг"),
        (r"\alpha_{\mathrm{пр}}", "°"),
    )
    columns = [TableColumn("Щека"), *(TableColumn(symbol_head(tex, unit)) for tex, unit in heads)]
    names = {field.name for field in fields}
    if "web_1_actual_mass_kg" in names:
        keys = ("actual_mass_kg", "centre_mm", *keys[1:])
        columns.insert(2, TableColumn(symbol_head(r"\rho", "мм")))
    elif "web_1_mass_kg" not in names:  # estimated: see the section on masses
        keys, columns = keys[1:], [columns[0], *columns[2:]]
    return table_block(columns, _numbered(fields, [f"web_{{}}_{key}" for key in keys], count))


def _arms(fields: Sequence[Field]) -> TableBlock:
    count = sum(field.name.endswith("_l1_mm") for field in fields)
    heads = [rf"l_{i}" for i in range(1, 7)] + [r"h_{\mathrm{Л}}", r"h_{\mathrm{П}}"]
    columns = [TableColumn("Колено", 1.3), *(TableColumn(inline_html(tex)) for tex in heads)]
    rows = _numbered(fields, [f"throw_{{}}_{key}_mm" for key in _ARMS], count)
    # Arms of a second rod and webs that are not given are zero on every throw.
    columns_used = [n for n in range(len(columns)) if any(row[n] != "0" for row in rows)]
    return table_block(
        [columns[n] for n in columns_used], [[row[n] for n in columns_used] for row in rows]
    )


def printed(model: InputFile, step: float) -> tuple[Points, float]:
    """Points to print, and the step by which they were taken, 0 for all of them.

    Of more points than rows of a table with that step the nearest to each row stand there,
    and the highest.
    """
    if not isinstance(model.gas, TableGasSection):
        return (), 0.0
    points = model.gas.points
    angles = np.array(points)[:, 0]
    rows = np.arange(0, angles[-1] + step / 2, step)
    if len(points) <= len(rows) + 1:
        return points, 0.0
    nearest = np.abs(angles[:, None] - rows).argmin(axis=0)
    top = max(range(len(points)), key=lambda i: points[i][1])
    return [points[i] for i in np.union1d(nearest, [top])], step


def _points(points: Points) -> TableBlock:
    """Points in three pairs of columns, read down each pair."""
    texts = [(plain_number(angle), plain_number(p)) for angle, p in points]
    groups = 3 if len(texts) > 12 else 1
    rows = -(-len(texts) // groups)
    cells = [
        [part for g in range(groups) for part in _at(texts, g * rows + row)] for row in range(rows)
    ]
    heads = [symbol_head(r"\varphi", "°"), symbol_head(r"p_{\mathrm{г}}", "МПа")]
    return table_block([TableColumn(head) for _ in range(groups) for head in heads], cells)


def _at(texts: Sequence[tuple[str, str]], index: int) -> tuple[str, str]:
    return texts[index] if index < len(texts) else ("—", "—")


def scheme_text(chapter: Chapter) -> Markup:
    """Scheme of the engine drawn from the input, with the order of the power strokes."""
    shape, shaft = chapter.shape, chapter.input.crankshaft
    numbers = range(1, shape.cylinders + 1)
    bank = shaft.bank_angle_deg or 0.0
    draw = partial(
        engine_scheme,
        tuple(bank if shape.is_right(i) else 0.0 for i in numbers),
        tuple(shape.throw_of(i) for i in numbers),
        tuple(shaft.throw_angles_deg),
        tuple(shaft.firing_offsets_deg),
        float(shape.period),
    )
    scheme = Figure(draw, "Схема двигателя с носка вала и рабочие ходы цилиндров")
    return chapter.page(
        "layout",
        scheme=scheme,
        layout=LAYOUTS[chapter.input.engine.layout],
        cylindered=cylindered(shape.cylinders),
        throws_text=instrumental(shape.throws, "коленом", "коленами"),
    )
