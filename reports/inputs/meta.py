"""What a person is told about an input field; also carries its hard limits into pydantic."""

from __future__ import annotations

import functools
import typing
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler
from pydantic.fields import FieldInfo
from pydantic_core import CoreSchema, PydanticCustomError, PydanticKnownError, core_schema

from kshm.nomenclature.quantity import quantity
from reports.inputs import units
from reports.inputs.units import Unit
from reports.shared.russian import capital

MAX_TEXT = 300
_MOST_LISTED = 8  # choices that a message lists one by one
_REFUSED = {"Cc", "Cs", "Cn", "Zl", "Zp"}


def title_of(key: str) -> str:
    """The title that the tables give a quantity, as a heading."""
    return capital(quantity(key).title)


class Strictly(BaseModel):
    """Base of the input models: unknown keys, other types, nan and inf are refused."""

    model_config = ConfigDict(
        strict=True,
        extra="forbid",
        allow_inf_nan=False,
        frozen=True,
    )


@dataclass(frozen=True, slots=True)
class Meta:
    """Russian title, symbol, unit, limits and choices of one input field.

    `title` and `symbol` of a list entry contain ``{n}``, its 1-based number.
    A subscript in `symbol` follows an underscore.  `structural` marks a field
    whose value changes the shape of the workbook.
    """

    title: str
    symbol: str = ""
    unit: Unit = units.NONE
    minimum: float | None = None
    maximum: float | None = None
    choices: Mapping[str, str] | None = field(default=None, hash=False)  # a dict: no hash
    structural: bool = False

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
            if names == [str(n) for n in range(1, len(names) + 1)] and len(names) > _MOST_LISTED:
                return f"допустимо от 1 до {names[-1]}"
            return "допустимо: " + ", ".join(names)
        if self.minimum is None or self.maximum is None:
            return ""
        low = units.number_text(self.minimum)
        return f"допустимо от {low} до {self.unit.limit(self.maximum)}"

    def numbered(self, number: int) -> Meta:
        """Return the metadata of the list entry with this 1-based number."""
        return Meta(
            self.title.format(n=number),
            self.symbol.format(n=number),
            self.unit,
            self.minimum,
            self.maximum,
            self.choices,
            self.structural,
        )


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
    unit: Unit,
    low: float,
    high: float,
    default: object = ...,
    *,
    structural: bool = False,
    alias: str | None = None,
) -> Any:  # noqa: ANN401 - of the field's own type, as pydantic's Field
    """Return the field of a number, or of a list of them, with inclusive hard limits."""
    return _field(Meta(title, symbol, unit, low, high, structural=structural), default, alias)


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
) -> Any:  # noqa: ANN401
    """Return the field of a choice; `options` maps each value to its Russian label."""
    return _field(Meta(title, symbol, choices=options, structural=structural), default)


def _field(meta: Meta, default: object, alias: str | None = None) -> Any:  # noqa: ANN401
    info: Any = Field(default, alias=alias)
    info.metadata.append(meta)
    return info


@dataclass(frozen=True, slots=True)
class Key:
    """What a model says of one TOML key.

    Attributes:
        name: The model's own name of it.
        metas: What a person is told, two for a point's pair.
        inner: The model of the records of a list.
        types: The types of single values, None left out.
        optional: The key may be left out of the file.
    """

    name: str
    metas: tuple[Meta, ...]
    inner: type[Strictly] | None
    types: frozenset[type]
    optional: bool


@functools.cache
def hints(model: type[BaseModel]) -> dict[str, Key]:
    """Return what a model says of its TOML keys, in the order of the file (do not change)."""
    return {info.alias or name: _key(name, info) for name, info in model.model_fields.items()}


def _key(name: str, info: FieldInfo) -> Key:
    parts = [*info.metadata, *_parts(info.annotation)]
    types = {part for part in parts if isinstance(part, type)} - {type(None)}
    return Key(
        name,
        tuple(part for part in parts if isinstance(part, Meta)),
        next((part for part in types if issubclass(part, Strictly)), None),
        frozenset(types),
        not info.is_required(),
    )


def _parts(annotation: object) -> Iterator[object]:
    """Types of single values inside an annotation, and what is told about them."""
    parts = typing.get_args(annotation)
    if typing.get_origin(annotation) is typing.Literal:
        parts = tuple(map(type, parts))
    for part in parts:
        yield from _parts(part)
    if not parts:
        yield annotation
