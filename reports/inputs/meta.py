"""Metadata of input fields: words, unit, limits, solver's name; limits enter pydantic's schema."""

from __future__ import annotations

import functools
import typing
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler
from pydantic.fields import FieldInfo
from pydantic_core import CoreSchema, PydanticCustomError, PydanticKnownError, core_schema

from kshm.nomenclature.quantity import quantity
from kshm.nomenclature.symbols import symbol_runs
from reports.inputs import units
from reports.inputs.units import InputUnit
from reports.shared.russian import NBSP, capital, uncapital

MAX_TEXT = 300
USUAL = object()  # the default of a key is that of the solver
_MAX_LISTED = 8  # choices that a message lists one by one
_REFUSED = {"Cc", "Cs", "Cn", "Zl", "Zp"}


def title_of(key: str) -> str:
    """Return the title that the tables give a quantity, as a heading."""
    return capital(quantity(key).title)


def named(key: str) -> tuple[str, str]:
    """Return title and symbol that the tables give a quantity, the index after «_»."""
    pieces = symbol_runs(quantity(key).tex)
    symbol = "".join(f"{level}{text}" for text, level in pieces)
    return title_of(key), symbol.replace(NBSP, " ")


class StrictModel(BaseModel):
    """Base of the input models: unknown keys, other types, nan and inf are refused."""

    model_config = ConfigDict(
        strict=True,
        extra="forbid",
        allow_inf_nan=False,
        frozen=True,
    )

    def __init_subclass__(cls, usual: tuple[type, ...] = (), **kwargs: Any) -> None:  # noqa: ANN401
        """Give the keys whose default is `USUAL` that of the solver's dataclasses `usual`."""
        super().__init_subclass__(**kwargs)
        for key, info in list(vars(cls).items()):
            if isinstance(info, FieldInfo) and info.default is USUAL:
                meta = next(part for part in info.metadata if isinstance(part, Meta))
                name = solver_name(key, meta)
                default: Any = next(f.default for t in usual for f in fields(t) if f.name == name)
                usual_value = default if meta.choices is not None else meta.unit.from_si(default)
                setattr(cls, key, _field(meta, usual_value))


@dataclass(frozen=True, slots=True)
class Meta:
    """Russian title, symbol, unit, limits and choices of one input field.

    `title` and `symbol` of a list entry contain ``{n}``, its 1-based number.
    A subscript in `symbol` follows an underscore.  `structural` marks a field
    whose value changes the shape of the workbook.  `solver` names the solver's
    input that the value gives, with its owner before a dot, where it is not
    the key without its unit.
    """

    title: str
    symbol: str = ""
    unit: InputUnit = units.NONE
    minimum: float | None = None
    maximum: float | None = None
    choices: Mapping[str, str] | None = field(default=None, hash=False)  # a dict: no hash
    structural: bool = False
    solver: str = ""

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Add the limits to the schema of the annotated type."""
        return self._limited(dict(handler(source)))

    def _limited(self, schema: dict[str, Any]) -> CoreSchema:
        if schema["type"] == "nullable":  # a field that may be left out
            schema["schema"] = self._limited(dict(schema["schema"]))
        if schema["type"] == "tuple":  # a list, which a file has in place of a tuple
            schema["strict"] = False
            schema["items_schema"] = [self._limited(dict(item)) for item in schema["items_schema"]]
        if schema["type"] in ("float", "int"):
            if self.minimum is not None:
                schema["ge"] = self.minimum
            if self.maximum is not None:
                schema["le"] = self.maximum
        if schema["type"] == "str":
            schema["max_length"] = MAX_TEXT
            return core_schema.no_info_after_validator_function(
                _printable, typing.cast(CoreSchema, schema)
            )
        if schema["type"] == "literal" and isinstance(schema["expected"][0], int):
            return core_schema.no_info_before_validator_function(
                _whole_number, typing.cast(CoreSchema, schema)
            )
        return typing.cast(CoreSchema, schema)

    def range_text(self, *, labels: bool = False) -> str:
        """Return the allowed values in words: ``допустимо от 10 до 1200 мм``."""
        if self.choices is not None and len(self.choices) == 1:
            return "пока поддерживается только " + next(iter(self.choices))
        if self.choices is not None:
            names = list(self.choices.values() if labels else self.choices)
            if names == [str(n) for n in range(1, len(names) + 1)] and len(names) > _MAX_LISTED:
                return f"допустимо от 1 до {names[-1]}"
            return "допустимо: " + ", ".join(names)
        if self.minimum is None or self.maximum is None:
            return ""
        low = units.number_text(self.minimum)
        return f"допустимо от {low} до {self.unit.limit(self.maximum)}"

    def numbered(self, number: int) -> Meta:
        """Return the metadata of the list entry with this 1-based number."""
        return replace(self, title=self.title.format(n=number), symbol=self.symbol.format(n=number))


def _printable(value: str) -> str:
    # Control characters are illegal in XML and would break the workbook much later.
    if any(unicodedata.category(char) in _REFUSED for char in value):
        raise PydanticCustomError("control_character", "control character")
    return value


def _whole_number(value: object) -> object:
    # To a Literal[1] true and 1.0 are the same as 1; to a strict file they are not.
    if type(value) is not int:
        raise PydanticKnownError("literal_error", {"expected": "int"})
    return value


def number(
    title: str,
    symbol: str,
    unit: InputUnit,
    low: float,
    high: float,
    default: object = ...,
    *,
    structural: bool = False,
    solver: str = "",
    alias: str | None = None,
) -> Any:  # noqa: ANN401 - of the field's own type, as pydantic's Field
    """Return the field of a number, or of a list of them, with inclusive hard limits."""
    meta = Meta(title, symbol, unit, low, high, structural=structural, solver=solver)
    return _field(meta, default, alias)


def text(title: str, default: object = ...) -> Any:  # noqa: ANN401
    """Return the field of a line of text."""
    return _field(Meta(title), default)


def choice(
    title: str,
    options: Mapping[str, str],
    default: object = ...,
    *,
    structural: bool = False,
    symbol: str = "",
    solver: str = "",
) -> Any:  # noqa: ANN401
    """Return the field of a choice; `options` maps each value to its Russian label."""
    meta = Meta(title, symbol, choices=options, structural=structural, solver=solver)
    return _field(meta, default)


def borrowed(model: type[BaseModel], key: str, title: str) -> Any:  # noqa: ANN401
    """Return an optional field with the unit and limits of another model's key."""
    meta = hints(model)[key].metas[0]
    named = f"{title}: {uncapital(meta.title)}"
    return _field(replace(meta, title=named, structural=False, solver=""), None)


def _field(meta: Meta, default: object, alias: str | None = None) -> Any:  # noqa: ANN401
    info: Any = Field(default, alias=alias)
    info.metadata.append(meta)
    return info


@dataclass(frozen=True, slots=True)
class Key:
    """Description of one TOML key of a model.

    Attributes:
        name: The model's own name of it.
        metas: What a person is told, two for a point's pair.
        inner: The model of the records of a list.
        types: The types of single values, None left out.
        optional: The key may be left out of the file.
    """

    name: str
    metas: tuple[Meta, ...]
    inner: type[StrictModel] | None
    types: frozenset[type]
    optional: bool


@functools.cache
def hints(model: type[BaseModel]) -> dict[str, Key]:
    """Return the descriptions of a model's TOML keys, in the order of the file (do not change)."""
    return {info.alias or name: _key(name, info) for name, info in model.model_fields.items()}


def _key(name: str, info: FieldInfo) -> Key:
    parts = [*info.metadata, *_parts(info.annotation)]
    types = {part for part in parts if isinstance(part, type)} - {type(None)}
    return Key(
        name,
        tuple(part for part in parts if isinstance(part, Meta)),
        next((part for part in types if issubclass(part, StrictModel)), None),
        frozenset(types),
        not info.is_required(),
    )


def _parts(annotation: object) -> Iterator[object]:
    """Types of single values inside an annotation, and their metadata."""
    parts = typing.get_args(annotation)
    if typing.get_origin(annotation) is typing.Literal:
        parts = tuple(map(type, parts))
    for part in parts:
        yield from _parts(part)
    if not parts:
        yield annotation


def solver_name(key: str, meta: Meta) -> str:
    """Return the name of the solver's input that a key gives: ``pin_width`` of ``pin_width_mm``."""
    return meta.solver or key.removesuffix(f"_{meta.unit.suffix}")


def solver_values(section: BaseModel, target: type, owner: str = "") -> dict[str, Any]:
    """Return the values of a section in SI that a dataclass of the solver has fields for.

    A key that is left out takes the solver's own default, so it is left out here as well.

    Args:
        section: A section of the input, or a record of one of its lists.
        target: The dataclass.
        owner: What stands before the dot of the solver's names of its fields.
    """
    names = {field.name for field in fields(target)}
    values = {}
    for key, spec in hints(type(section)).items():
        value = getattr(section, spec.name)
        if value is None or spec.inner is not None or len(spec.metas) != 1:
            continue
        meta = spec.metas[0]
        before, _, name = solver_name(key, meta).rpartition(".")
        if before == owner and name in names:
            many = isinstance(value, tuple)
            values[name] = tuple(map(meta.unit.si, value)) if many else meta.unit.si(value)
    return values
