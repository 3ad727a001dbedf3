"""Symbols, values and formulas of a model as the report prints them."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from kshm.nomenclature.digits import Digits
from kshm.nomenclature.quantity import Quantity, quantity
from reports.document.text.symbols import inline_html
from reports.document.text.texts import of_digits, of_digits_tex, powers, rich, to_tex
from reports.formula import tex as formulas
from reports.formula.numeric import evaluate
from reports.formula.parse import scales
from reports.inputs.checks.bands import stated_kind
from reports.inputs.fields import Field
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solve_input import GridError, grid_errors
from reports.inputs.to_si.engine import smallness_of
from reports.model.blocks import Model, Node
from reports.model.evaluation import Values
from reports.model.shape import TIMING, Shape
from reports.shared.russian import NBSP, fixed
from reports.shared.standing import Standing
from reports.tables.verdicts import JudgedValue, outcomes

# Symbols that would be ambiguous within a formula.
_SYMBOLS = {
    "M_Nm": r"M_{\mathrm{ц}}",
    "volume_ratio": "x",
    "share": r"\dfrac{a_{\mathrm{ш}}}{l}",
    "share2": r"\dfrac{a_{\mathrm{ш}2}}{l}",
    "throw": "",
    TIMING: r"\varphi",  # of one cylinder the same angle, counted on past the end of the cycle
}
_EXTREME = re.compile(r"col_(max|min)\(([\w.]+)\)")
_TORQUE = re.compile(r"(?:P4_1|cylinder_(\d+))\.M_Nm|P4_2\.M(\d+)_Nm")
_PROJECTION = re.compile(r"\\(cos|sin)\b")
_SIGNIFICANT, _MAX_SIGNIFICANT = 5, 8  # digits of a number put into a formula
_EXACT = 17  # digits, and decimals, of a number that is not rounded
_NO_SPACE = {"°"}
_GIVEN = 8  # significant digits of an input that nobody would write by hand
# Words of a field's title for who fills it in, which a note does not repeat.
_HINTS = re.compile(r",? (если|0 —) .*|,? PL\d| \((двухтактный двигатель|сдвинутой — [^)]*)\)")
_ADVANCE = {"diesel": "впрыска", "petrol": "зажигания"}


def unit_tex(label: str) -> str:
    r"""Return a unit for TeX: ``м/с²`` gives ``\mathrm{м/с}^{2}``."""
    if not label:
        return ""
    if label == "°":
        return r"^{\circ}"
    if label == "%":
        return r"\,\%"
    text = powers(label, r"}}^{{{}}}\mathrm{{")
    return r"\;" + rf"\mathrm{{{text}}}".replace(r"\mathrm{}", "")


def material_name(label: str) -> str:
    """Return a material with its noun: «сталь 45», «чугун ВЧ 60»; «алюминиевый сплав» has one."""
    if label[:1].islower():
        return label
    return f"{'чугун' if label.startswith(('ВЧ', 'СЧ')) else 'сталь'}{NBSP}{label}"


def input_text(field: Field) -> str:
    """Return an input value as printed: the label of a choice, a number with decimal comma."""
    if field.choices is not None:
        label = field.choices.get(str(field.value), str(field.value))
        return material_name(label) if str(field.path[-1]).endswith("material") else label
    return field.value if isinstance(field.value, str) else plain_number(float(field.value))


def plain_number(value: float) -> str:
    """Return a number with the digits it was given with; what was calculated for it has no more."""
    value = float(f"{value:.{_GIVEN}g}")
    digits = next((d for d in range(12) if round(value, d) == value), 12)
    return fixed(value, digits)


def crankcase_scavenges(model: InputFile) -> bool:
    """Whether no oil under pressure reaches the crankpin: a two-stroke without told bearings."""
    hole = model.crankshaft.oil_hole_deg
    return model.engine.strokes == 2 and model.bearings is None and hole is None


def field_title(field: Field, model: InputFile) -> str:
    """Title of a field of the input as a note has it, of the engine at hand."""
    title = _HINTS.sub("", field.title)
    advance = _ADVANCE.get(stated_kind(model), "")
    if advance:
        title = title.replace("впрыска (зажигания)", advance)
    if field.path[-1] == "ambient_pressure_mpa" and crankcase_scavenges(model):
        title = "Давление под поршнем"
    if field.path[-1] == "pin_length_mm" and Shape.of(model).split:
        title = title.replace("всей", "каждой половины")
    if field.path[-1] == "pin_length_mm" and Shape.of(model).single_rods:
        title = title.replace("всей ", "")
    if is_twice_radius(field, model):
        title = "Удвоенный радиус кривошипа"
    return title


def is_twice_radius(field: Field, model: InputFile) -> bool:
    """Whether a field is the stroke of an offset engine, whose real stroke is longer than 2r."""
    return field.path[-1] == "stroke_mm" and Shape.of(model).offset


@dataclass(frozen=True, slots=True)
class WhereItem:
    """A line of the «где» list: symbol in TeX, what it means, unit."""

    symbol: str
    meaning: str
    unit: str = ""


@dataclass(frozen=True)
class Terms:
    """Symbols, numbers and formulas of a model's nodes for the text.

    A node is a scalar (``omega``), an input (``geometry_bore_mm``) or a column
    (``P4_1.T_MPa``); a column's number is taken at the row of an angle.
    """

    model: Model
    values: Values
    fine: Mapping[str, Mapping[str, NDArray[np.float64]]] = field(default_factory=dict)
    put_in: set[tuple[str, float | None]] = field(default_factory=set)  # formulas with numbers
    speed_decimals: dict[int, int] = field(default_factory=dict)  # by how many those are

    @cached_property
    def grid_errors(self) -> tuple[GridError, ...]:
        """Results whose error from the tables' step is visible."""
        return grid_errors(self.model.input)

    @cached_property
    def judged(self) -> tuple[JudgedValue, ...]:
        """Values that the tables judge."""
        return outcomes(self.model, self.values.scalars)

    def agrees(self, key: str) -> bool:
        """Whether a check passed; one that there is not did not."""
        return any(each.key == key and each.standing is Standing.INSIDE for each in self.judged)

    def curves(self, names: Sequence[str]) -> list[NDArray[np.float64]]:
        """Columns to draw together: at the fine step where all of them are known so."""
        keys = [name.rpartition(".")[::2] for name in names]
        if all(key in self.fine.get(table, {}) for table, key in keys):
            return [np.asarray(self.fine[table][key], dtype=np.float64) for table, key in keys]
        return [self.column(name) for name in names]

    def has(self, name: str) -> bool:
        """Whether the model has the scalar, input or column."""
        return name in self.model.scalars or name in self.model.fields or self._column(name)

    def quantity(self, name: str) -> Quantity:
        """Quantity of a scalar or a column."""
        table, _, key = name.rpartition(".")
        node = self._node(name)
        if node is not None:
            return node.quantity
        return quantity(key if table else name, smallness_of(self.model.input))

    def tex(self, name: str) -> str:
        """TeX symbol of a node."""
        if name in self.model.fields:
            return formulas.input_symbol_tex(self.model.fields[name].symbol)
        key = name.rpartition(".")[2]
        family = key.split("_", 1)[1] if key.startswith("throw") else key
        return _SYMBOLS[family] if family in _SYMBOLS else self.quantity(name).tex

    def symbol(self, name: str) -> str:
        """Symbol in plain text."""
        field = self.model.fields.get(name)
        return self.quantity(name).symbol if field is None else field.symbol or field.title

    def sym(self, name: str) -> Markup:
        """Symbol for running text."""
        return inline_html(self.tex(name))

    def title(self, name: str) -> str:
        """Russian name of a node, for the «где» list."""
        if name in self.model.fields:
            title = field_title(self.model.fields[name], self.model.input)
            return title[:1].lower() + title[1:]
        return self.quantity(name).title

    def unit(self, name: str) -> str:
        """Return the unit label of a node."""
        if name in self.model.fields:
            return self.model.fields[name].unit
        return self.quantity(name).unit_label

    def value(self, name: str, at: float | None = None) -> float:
        """Return the number of a node; of a column the one at an angle [deg].

        Raises:
            KeyError: nothing has that name.
        """
        if name in self.model.fields:
            return float(self.model.fields[name].value)
        if name in self.values.scalars:
            return float(self.values.scalars[name])
        table, _, key = name.rpartition(".")
        if at is None:
            msg = f"no angle for the column {name}"
            raise KeyError(msg)
        return float(self.values.columns[table][key][self.row(table, at)])

    def column(self, name: str) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
        """Return a whole column."""
        table, _, key = name.rpartition(".")
        return np.asarray(self.values.columns[table][key], dtype=np.float64)

    def row(self, table: str, at: float) -> int:
        """Row of an angle in a table; the nearest one if the grid lacks it."""
        rows = np.asarray(self.model.tables[table].rows)
        return int(np.abs(rows - at).argmin())

    def num(self, name: str, at: float | None = None, beside: str = "") -> str:
        """Number alone, with the decimals of its quantity, no more than one ``beside`` it has."""
        value = self.value(name, at)
        if name in self.model.fields:
            return plain_number(value)
        if self._is_speed(name):
            return fixed(value, self._speed_decimals)
        digits = self._digits(name)
        if beside:
            other = self._digits(beside).within(self.value(beside))
            digits = replace(digits, decimals=min(digits.decimals, other.decimals))
        return of_digits(value, digits)

    def val(self, name: str, at: float | None = None, beside: str = "") -> Markup:
        """Return the number with unit: ``829 Н·м``, ``30°``."""
        return with_unit(self.num(name, at, beside), self.unit(name))

    def eqv(self, name: str, at: float | None = None) -> Markup:
        """Symbol, equals sign, number and unit for running text."""
        return Markup('<span class="nb">{}\u00a0=\u00a0{}</span>').format(
            self.sym(name), self.val(name, at)
        )

    def where(self, *names: str) -> list[WhereItem]:
        """Lines of a «где» list; what the model lacks is left out."""
        present = (name for name in names if self.has(name))
        return [WhereItem(self.tex(n), self.title(n), self.unit(n)) for n in present]

    def formula(self, name: str, at: float | None = None, zeros: Collection[str] = ()) -> str:
        """``symbol = expression`` in symbols, of the branch in force, without ``zeros``."""
        expr = self._expr(name, at)
        return f"{self.tex(name)} = {formulas.to_tex(expr, self._symbols(name), zeros)}"

    def substitution(self, name: str, at: float | None = None, *, symbols: bool = False) -> str:
        """``symbol = numbers = result unit``; with ``symbols`` the expression stands before."""
        expr = self._expr(name, at)
        parts = [self.tex(name)]
        if symbols:
            parts.append(formulas.to_tex(expr, self._symbols(name)))
        table, (digits, decimals) = name.rpartition(".")[0], self._precision(name, expr, at)

        def number(inner: str) -> float | str:
            node = self._global(inner, table)
            if self._is_speed(node) and decimals == _EXACT:  # by the frequency of rotation
                spelled = formulas.to_tex_numbers(
                    self._node_expr(node), self._symbols(node), number
                )
                return formulas.Raw(rf"\left({spelled}\right)")
            if not self._is_product(node):
                return self._number(node, at, digits)
            product = formulas.to_tex_numbers(self._node_expr(node), self._symbols(name), number)
            return formulas.Raw("0" if product.startswith(r"0 \cdot") else product)

        given = formulas.to_tex_numbers(
            self._with_extremes(name, expr, digits), self._symbols(name), number
        )
        if given != parts[-1]:  # an extreme of a column has no numbers to put in
            parts.append(given)
        parts.append(self.result_tex(name, at))
        return " = ".join(parts)

    def scales(self, name: str, at: float | None = None) -> list[str]:
        """Scale functions whose factors the substitution shows."""
        formula = self.substitution(name, at)
        return [
            scale
            for scale in scales(self._expr(name, at))
            if rf"10^{{{formulas.exponent_of(scale)}}}" in formula
        ]

    def result_tex(self, name: str, at: float | None = None) -> str:
        """Return the result with unit for TeX."""
        if name in self.model.fields:
            return to_tex(self.num(name, at)) + unit_tex(self.unit(name))
        return self._result_tex(name, self.value(name, at)) + unit_tex(self.unit(name))

    def branches(self, name: str) -> list[formulas.Piece]:
        """All branches of a formula with choices."""
        return formulas.pieces(self._node_expr(name), self._symbols(name))

    def book(self, *names: str) -> str:
        """Where the book has them: «формула (3)», «формулы (51), (53)», «п. 2.8», empty else."""
        return book_place(*(node.source for node in map(self._node, names) if node is not None))

    def _result_tex(self, name: str, value: float) -> str:
        if self._is_speed(name):
            return to_tex(fixed(value, self._speed_decimals))
        return of_digits_tex(value, self._digits(name))

    def _digits(self, name: str) -> Digits:
        """Digits of a node; of a column those that its table has."""
        digits = self.quantity(name).digits
        return digits.within(np.abs(self.column(name)).max()) if self._column(name) else digits

    def _is_speed(self, name: str) -> bool:
        """Whether a node is an angular speed of the shaft, which a note writes in one way."""
        return name in self.model.scalars and self.model.scalars[name].quantity.unit == "rad_s"

    @property
    def _speed_decimals(self) -> int:
        """Decimals of the angular speeds: one more where a formula put in asks for it."""
        known = self.speed_decimals
        if len(self.put_in) not in known:
            decimals = _SIGNIFICANT - 1 - math.floor(math.log10(self.value("omega")))
            known[len(self.put_in)] = decimals
            known[len(self.put_in)] += any(self._is_spelled(*each) for each in self.put_in)
        return known[len(self.put_in)]

    def _is_spelled(self, name: str, at: float | None) -> bool:
        """Whether no digits of the other numbers make the speeds as written give the result."""
        expr = self._expr(name, at)
        return not self._is_speed(name) and self._precision(name, expr, at)[1] == _EXACT

    def _precision(self, name: str, expr: str, at: float | None) -> tuple[int, int]:
        """Fewest digits of the numbers put in, decimals of the speeds, that give the result."""
        for decimals in (self._speed_decimals, _EXACT):
            for digits in range(_SIGNIFICANT, _MAX_SIGNIFICANT + 1):
                try:
                    if self._fits(name, expr, at, digits, decimals):
                        return digits, decimals
                except (IndexError, KeyError, TypeError, ValueError):  # whole columns, choices
                    return _SIGNIFICANT, self._speed_decimals
        return _SIGNIFICANT, self._speed_decimals

    def _fits(self, name: str, expr: str, at: float | None, digits: int, decimals: int) -> bool:
        """Whether numbers of so many digits, speeds of so many decimals give the printed result."""
        table = name.rpartition(".")[0]

        def rounded(inner: str) -> float:
            node = self._global(inner, table)
            if self._is_product(node):
                return float(evaluate(self._node_expr(node), rounded))
            value = self.value(node, at)
            if self._is_speed(node):
                return round(value, decimals)
            if node not in self.model.fields and self.quantity(node).unit == "rad":
                return float(np.radians(round(float(np.degrees(value)), _decimals_deg(digits))))
            return formulas.as_put_in(value, digits)

        given = self._result_tex(name, self.value(name, at))
        put_in = self._with_extremes(name, expr, digits)
        return self._result_tex(name, float(evaluate(put_in, rounded))) == given

    def _with_extremes(self, name: str, expr: str, digits: int) -> str:
        """Return a formula with numbers for the extremes of columns, unless it is one itself."""
        if _EXTREME.fullmatch(expr):
            return expr
        table = name.rpartition(".")[0]

        def number(match: re.Match[str]) -> str:
            column = self.column(self._global(match[2], table))
            value = column.max() if match[1] == "max" else column.min()
            return repr(formulas.as_put_in(round(float(value), 12), digits))

        return _EXTREME.sub(number, expr)

    def _symbols(self, name: str) -> formulas.Symbols:
        table = name.rpartition(".")[0]

        def symbol(inner: str) -> str:
            node = self._global(inner, table)
            torque = _TORQUE.fullmatch(node)
            if torque is None or node == f"{table}.M_Nm":
                return self.tex(node)
            if not self.has("P4_2.M2_Nm"):  # no other cylinder to tell it from
                return self.tex("P4_1.M_Nm")
            return rf"M_{{{torque[1] or torque[2] or 1}\mathrm{{ц}}}}"

        return symbol

    def _global(self, inner: str, table: str) -> str:
        local = f"{table}.{inner}"
        return local if table and "." not in inner and self._column(local) else inner

    def _column(self, name: str) -> bool:
        table, _, key = name.rpartition(".")
        return table in self.values.columns and key in self.values.columns[table]

    def _node(self, name: str) -> Node | None:
        if name in self.model.scalars:
            return self.model.scalars[name]
        table, _, key = name.rpartition(".")
        if table in self.model.tables:
            columns = self.model.tables[table].columns
            return next((column for column in columns if column.key == key), None)
        return None

    def _node_expr(self, name: str) -> str:
        node = self._node(name)
        if node is None or node.expr is None:
            msg = f"no formula for {name}"
            raise KeyError(msg)
        return node.expr

    def _expr(self, name: str, at: float | None) -> str:
        table = name.rpartition(".")[0]

        def lookup(inner: str) -> float | str:
            node = self._global(inner, table)
            field = self.model.fields.get(node)
            if field is not None and isinstance(field.value, str):
                return (field.choices or {}).get(field.value, field.value)
            return self.value(node, at)

        return formulas.chosen(self._node_expr(name), lambda test: bool(evaluate(test, lookup)))

    def _is_product(self, name: str) -> bool:
        """Whether the symbol of a node is itself a formula, as that of a projection of a force."""
        return self._column(name) and bool(_PROJECTION.search(self.tex(name)))

    def _number(self, name: str, at: float | None, digits: int) -> float | str:
        value = self.value(name, at)
        if name in self.model.fields:
            return formulas.Raw(_number_tex(value, digits))
        if self._is_speed(name):
            return formulas.Raw(to_tex(fixed(value, self._speed_decimals)))
        quantity = self.quantity(name)
        if quantity.unit == "rad":
            text = to_tex(fixed(float(np.degrees(value)), _decimals_deg(digits)))
            return formulas.Raw(text + r"^{\circ}")
        # A force of a throw that its table prints as zero is none.
        least = 0.5 if name.startswith("throw") else 1e-9
        noise = (
            quantity.digits.kind == "fixed" and abs(value) < least * 10.0**-quantity.digits.decimals
        )
        return formulas.Raw(_number_tex(0.0 if noise else value, digits))


def _decimals_deg(digits: int) -> int:
    """Decimals of an angle among numbers of so many digits."""
    return digits - 2


def _number_tex(value: float, digits: int) -> str:
    text = formulas.number_tex(value, digits)
    return rf"\left({text}\right)" if r"\cdot" in text else text


def with_unit(number: str, unit: str) -> Markup:
    """Return a number with its unit behind a space that does not break."""
    if not unit:
        return Markup(number)
    space = "" if unit in _NO_SPACE else NBSP
    look = '{}{}<span class="nb">{}</span>' if "/" in unit else "{}{}{}"
    return Markup(look).format(number, space, rich(unit))


def book_place(*sources: str) -> str:
    """Places in the textbook from sources of specifications; empty for other sources."""
    sources_of_textbook = [source for source in sources if source.startswith("Гоц")]
    named = list(
        dict.fromkeys(
            n for source in sources_of_textbook for n in re.findall(r"\(\d+[а-я]?\)", source)
        )
    )
    word = "формула" if len(named) == 1 else "формулы"
    parts = [f"{word}\u00a0{', '.join(named)}"] if named else []
    others = (
        _section_place(source)
        for source in sources_of_textbook
        if not re.search(r"\(\d+[а-я]?\)", source)
    )
    return ", ".join([*parts, *dict.fromkeys(reference for reference in others if reference)])


def _section_place(source: str) -> str:
    """Return a figure, a table or a section that a source names instead of a formula."""
    match = re.search(r"(рис|табл)\.\s*(\d+)", source)
    if match:
        return f"{match.group(1)}.\u00a0{match.group(2)}"
    match = re.search(r"\d\.\d", source)
    return f"п.\u00a0{match.group()}" if match else ""
