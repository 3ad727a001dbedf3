"""Values that the tables judge, as the report prints them beside what is allowed."""

from __future__ import annotations

import ast

from markupsafe import Markup

from kshm.nomenclature.digits import Digits
from reports.document.text.symbols import titled_html
from reports.document.text.terms import Terms, with_unit
from reports.document.text.tolerances import tolerance
from reports.formula.parse import names, parse
from reports.formula.spans import spans_of
from reports.model.blocks import Scalar
from reports.shared.russian import as_printed, fixed, uncapital
from reports.shared.standing import Standing
from reports.tables.verdicts import JudgedValue

_LARGE, _SMALL = 2, 3  # decimals of values from 1 on and of those below
_MAX_DECIMALS = 10  # decimals after which a value is the limit itself
_NOISE = 1e-5  # a smaller error is one of arithmetic


def allows(terms: Terms, each: JudgedValue) -> str:
    """Return what a verdict allows, in words."""
    return tolerance(_verdict(terms, each), each.scalar.key, terms.value, terms.symbol)


def shown(terms: Terms, each: JudgedValue) -> str:
    """Return a judged value as printed: a count is whole, no other looks better than it is."""
    value = each.value
    if _counts(terms, each.scalar):
        return fixed(value, 0)
    first = 0 if abs(value) < _NOISE else _LARGE if abs(value) >= 1 else _SMALL
    digits = next((n for n in range(first, _MAX_DECIMALS) if _alike(terms, each, n)), first)
    return fixed(value, digits)


def outcome(terms: Terms, each: JudgedValue) -> tuple[Markup, Markup]:
    """«Моменты равны: расхождение, %» and a value as title and «расхождение 3 %»."""
    value = shown(terms, each)
    head, colon, result = each.title.rpartition(": ")
    words, comma, unit = result.rpartition(", ")
    if not (colon and comma):
        return titled_html(each.title), Markup("получено {}").format(value)
    return titled_html(head), Markup("{} {}").format(titled_html(words), with_unit(value, unit))


def beside_limit(terms: Terms, each: JudgedValue) -> Markup:
    """«наибольшая амплитуда — 46,83 МПа (не более 30)»."""
    title, comma, unit = each.title.rpartition(", ")
    words = titled_html(uncapital(title if comma else each.title))
    value = with_unit(shown(terms, each), unit if comma else "")
    return Markup("{} — {} ({})").format(words, value, allows(terms, each))


def _verdict(terms: Terms, each: JudgedValue) -> str:
    return str(terms.model.scalars[each.key].expr)


def _alike(terms: Terms, each: JudgedValue, digits: int) -> bool:
    """Whether the value as printed has the verdict of the value."""
    tree = parse(_verdict(terms, each))
    condition = ast.unparse(tree.test) if isinstance(tree, ast.IfExp) else ast.unparse(tree)
    spans = spans_of(condition, each.scalar.key, terms.value)
    if spans is None:
        return True
    value = as_printed(each.value, digits)
    inside = any(
        span.low <= value <= span.high
        and not (span.above and value == span.low)
        and (span.upto or value != span.high)
        for span in spans
    )
    return inside == (each.standing is Standing.INSIDE)


def _counts(terms: Terms, scalar: Scalar) -> bool:
    """Whether a value is a number of things: of whole values without a unit."""
    parts = names(str(scalar.expr))
    return bool(parts) and all(_is_whole(terms, name) for name in parts)


def _is_whole(terms: Terms, name: str) -> bool:
    if name not in terms.model.scalars:
        return False
    of = terms.quantity(name)
    return not of.unit_label and of.digits == Digits(0)
