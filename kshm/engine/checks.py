"""Checks of an engine's numbers and kinds; errors of one line."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence, Set
from dataclasses import fields
from functools import cache, wraps
from inspect import signature
from numbers import Integral, Real
from types import NoneType, UnionType
from typing import Any, Literal, ParamSpec, TypeVar, Union, get_args, get_origin, get_type_hints

from kshm.errors import NO_LIMITS, InputError, Limits, Problem

POSITIVE, NOT_NEGATIVE, FINITE = "positive", "not negative", "finite"
_WORDS = {float: "a number", int: "a whole number", str: "a text"}
_SHOWN = 40  # characters of a value that is told
_LIMITS: dict[str, Limits] = {POSITIVE: (0.0, None), NOT_NEGATIVE: (0.0, None)}

Arguments = ParamSpec("Arguments")
Made = TypeVar("Made")
# Annotations of a class or function are texts until they are asked for; always the same.
_hints = cache(get_type_hints)


def refuse(*problems: tuple[bool, str]) -> None:
    """Raise the first problem that is one.

    Raises:
        InputError: with the text of that problem.
    """
    for wrong, text in problems:
        if wrong:
            raise InputError(text)


def check_numbers(part: object, want: str, *names: str) -> None:
    """Kinds of all fields of a part, and its numbers; None counts as not given where it may be.

    Args:
        part: a dataclass; its name and the field's are told.
        want: "positive", "not negative" or "finite".
        names: fields to check; all others must be finite.

    Raises:
        InputError: a field is of the wrong kind, a number is NaN, infinite or not as wanted.
    """
    owner: Any = type(part)
    for name, kind_of in _kinds(owner):
        value = getattr(part, name)
        kind = want if name in names else FINITE
        if type(value) is float and kind_of is float and _is(value, kind):
            continue  # as nearly all are: many engines are made for a study
        where = f"{owner.__name__}.{name}"
        check_kind(where, value, kind_of)
        if as_scalar(value) is not value:
            value = as_scalar(value)
            object.__setattr__(part, name, value)
        for number in value if isinstance(value, tuple) else (value,):
            if isinstance(number, Real) and not _is(float(number), kind):
                problem = f"must be {kind}, not {float(number):g}"
                limits = _LIMITS.get(kind, NO_LIMITS)
                raise InputError(Problem(where, problem, limits=limits, value=number))


@cache
def _kinds(owner: Any) -> tuple[tuple[str, Any], ...]:  # noqa: ANN401
    """Names of the fields of a dataclass and their annotations, always the same."""
    hints = _hints(owner)
    return tuple((field.name, hints[field.name]) for field in fields(owner))


def as_scalar(value: Any) -> Any:  # noqa: ANN401
    """Return the number that an array without dimensions holds; anything else as it is."""
    return value.item() if getattr(value, "ndim", None) == 0 else value


def takes_kinds(function: Callable[Arguments, Made]) -> Callable[Arguments, Made]:
    """Refuse arguments of another kind than the function's annotations say, by their names.

    Arrays without dimensions are the numbers that they hold.
    """
    names = tuple(signature(function).parameters)

    @wraps(function)
    def checked(*args: Arguments.args, **keywords: Arguments.kwargs) -> Made:
        kinds = _hints(function)
        for name, value in (*zip(names, args, strict=False), *keywords.items()):
            if name in kinds:  # of unknown names Python tells itself
                check_kind(name, value, kinds[name])
        numbers: Any = map(as_scalar, args)
        named: Any = {name: as_scalar(value) for name, value in keywords.items()}
        return function(*numbers, **named)

    return checked


def check_kind(name: str, value: object, kind: Any) -> None:  # noqa: ANN401
    """Refuse a value that does not fit an annotation.

    Raises:
        InputError: with the name, the kind and the value, of which the text has the beginning.
    """
    if not _fits(value, kind):
        printed = " ".join(repr(value).split())
        printed = printed if len(printed) <= _SHOWN else printed[: _SHOWN - 1] + "…"
        raise InputError(Problem(name, f"must be {_words(kind)}, not {printed}", value=value))


def _fits(value: object, kind: Any) -> bool:  # noqa: ANN401
    # Nearly all values are plain numbers: many engines are made for a study.
    if kind is type(value):
        return True
    value = as_scalar(value)
    origin = get_origin(kind)
    if origin in (Union, UnionType):
        return any(_fits(value, each) for each in get_args(kind))
    if origin is Literal:
        return True  # the one who takes it tells the words it knows
    if origin is tuple:
        return isinstance(value, tuple) and _each_fits(value, get_args(kind))
    if origin in (Sequence, Collection):
        several = isinstance(value, Collection)
        plain = (
            not isinstance(value, str | bytes | Mapping | Set) and getattr(value, "ndim", 1) == 1
        )
        return several and plain and all(_fits(each, get_args(kind)[0]) for each in value)  # type: ignore[attr-defined]
    number = {float: Real, int: Integral}.get(kind)
    return isinstance(value, number or kind)


def _each_fits(values: tuple[object, ...], kinds: tuple[Any, ...]) -> bool:
    if kinds[-1] is Ellipsis:
        return all(_fits(value, kinds[0]) for value in values)
    return len(values) == len(kinds) and all(map(_fits, values, kinds))


def _words(kind: Any) -> str:  # noqa: ANN401
    if get_origin(kind) in (Union, UnionType):
        return " or ".join(_words(each) for each in get_args(kind) if each is not NoneType)
    if get_origin(kind) in (tuple, Sequence, Collection):
        return f"a list, each {_words(get_args(kind)[0])}"
    return _WORDS.get(kind) or str(kind.__name__)


def _is(number: float, kind: str) -> bool:
    least = {POSITIVE: math.ulp(0.0), NOT_NEGATIVE: 0.0}.get(kind, -math.inf)
    return math.isfinite(number) and number >= least
