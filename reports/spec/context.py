"""What the conditions of a book may ask: the shape of the engine, what is given, its values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from pydantic import BaseModel

from kshm.nomenclature.quantity import ray_key, roman
from reports.shared.russian import short
from reports.spec import shape
from reports.spec.extremes import TIE
from reports.spec.parts import Scope


@dataclass(frozen=True, slots=True)
class InputView:
    """A section of the input: ``section.key`` is a value or, of ``given``, whether there is one."""

    section: BaseModel
    whether: bool

    def __getattr__(self, name: str) -> object:
        """Value of a key; a section is another view, where the file has it."""
        if name not in type(self.section).model_fields:
            raise AttributeError(name)
        value = getattr(self.section, name)
        if isinstance(value, BaseModel):
            return InputView(value, self.whether)
        return value not in (None, ()) if self.whether else value


def names_of(scope: Scope, **further: object) -> Mapping[str, object]:
    """Names for the conditions of a book; ``further`` are those of its subject alone."""
    return {
        "engine": scope.shape,
        "given": InputView(scope.input, whether=True),
        "value": InputView(scope.input, whether=False),
        "forced": scope.forced,
        "turn": scope.turn,
        "cycle": scope.cycle,
        **{name: getattr(shape, name) for name in _SHAPE},
        "each": each,
        "cylinder_table": shape.cylinder_table_id,
        "ray_key": ray_key,
        "roman": roman,
        "short": short,
        "tie": TIE,
        **further,
    }


def each(text: str, members: Iterable[object], between: str = ", ") -> str:
    """The text for every number or name, which is ``@`` in it: arguments, or terms of a sum."""
    return between.join(text.replace("@", str(member)) for member in members)


_SHAPE = ("pin_table", "rays_table", "pin_figure", "pin_name", "rods_table")
