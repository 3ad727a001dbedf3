"""What the conditions of a book may ask: the shape of the engine, what is given, its values."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import get_args

from pydantic import BaseModel

from kshm.nomenclature.quantity import ray_key, roman
from reports.inputs.sections.gas import RoundedGasSection, TableGasSection
from reports.model import shape
from reports.model.blocks import TIE
from reports.model.shape import Scope
from reports.shared.russian import short

# What a chapter's text says of a key: value with unit, number, symbol, symbol = value, title;
# places of tables and figures; the values of a list that are beyond its limits, each with its mend;
# the words for a member.
TEXT_WORDS = ("val", "num", "sym", "eqv", "title", "tab", "fig", "beyond", "member")
MARK = re.compile(rf"⟦({'|'.join(TEXT_WORDS)}) (\w+(?:\.\w+)?)⟧")
# A number that the text calculates, by its decimals and formula; sources; a place in the textbook.
FREE_MARK = re.compile(r"⟦(calc|src|book) ([^⟧]+)⟧")
# What it says by its values alone: where a condition holds, where a list is within its limits.
CASES = ("when", "within", "outside")
CASE_MARK = re.compile(rf"⟦(?:({'|'.join(CASES)}) ([^⟧]+)|(otherwise|end))⟧")
_SHAPE = ("pin_table", "rays_table", "pin_figure", "pin_name", "rods_table", "central_volume_ratio")


@dataclass(frozen=True, slots=True)
class InputView:
    """A section of the input: ``section.key`` is a value or, of ``given``, whether there is one.

    ``known`` are the keys of all kinds that the section may be of: those of others are not given.
    """

    section: BaseModel
    whether: bool
    known: frozenset[str] = frozenset()

    def __getattr__(self, name: str) -> object:
        """Value of a key; a section is another view, where the file has it; a list is views."""
        if name not in type(self.section).model_fields:
            if self.whether and name in self.known:
                return False
            raise AttributeError(name)
        value = getattr(self.section, name)
        if isinstance(value, BaseModel):
            return InputView(value, self.whether, _keys_of(type(self.section), name))
        if isinstance(value, tuple) and value and isinstance(value[0], BaseModel):
            return tuple(InputView(item, self.whether) for item in value)
        return value not in (None, ()) if self.whether else value


@lru_cache(maxsize=64)
def _keys_of(parent: type[BaseModel], name: str) -> frozenset[str]:
    """Keys of all kinds of a section."""
    kinds = get_args(parent.model_fields[name].annotation)
    return frozenset(key for kind in kinds for key in getattr(kind, "model_fields", ()))


def names_of(scope: Scope, **further: object) -> Mapping[str, object]:
    """Names for the conditions of a book; ``further`` are those of its subject alone."""
    return {
        "engine": scope.shape,
        "given": InputView(scope.input, whether=True),
        "value": InputView(scope.input, whether=False),
        "forced": scope.forced,
        "diagram": diagram_kind(scope.input.gas),
        "turn": scope.turn,
        "cycle": scope.cycle,
        **{name: getattr(shape, name) for name in _SHAPE},
        "each": each,
        "cylinder_table": shape.cylinder_table_id,
        "ray_key": ray_key,
        "roman": roman,
        "short": short,
        "tie": TIE,
        **{word: partial(_mark, word) for word in TEXT_WORDS + CASES},
        "calc": lambda formula, decimals: _mark("calc", f"{decimals} {formula}"),
        "src": lambda *keys: _mark("src", " ".join(keys)),
        "book": partial(_mark, "book"),
        "otherwise": "⟦otherwise⟧",
        "end": "⟦end⟧",
        **further,
    }


def diagram_kind(gas: BaseModel) -> str:
    """How the diagram is drawn: by polytropes, rounded, by points on smooth or straight lines."""
    if not isinstance(gas, TableGasSection):
        return "rounded" if isinstance(gas, RoundedGasSection) else "polytropic"
    return "smooth" if gas.interpolation == "monotone" else "straight"


def _mark(word: str, key: str) -> str:
    """Return what the report puts in place of a key, once its values are known."""
    return f"⟦{word} {key}⟧"


def each(text: str, members: Iterable[object], between: str = ", ") -> str:
    """Return text for every number or name, which is ``@`` in it: arguments, or terms of a sum."""
    return between.join(text.replace("@", str(member)) for member in members)
