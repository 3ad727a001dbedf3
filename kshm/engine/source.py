"""What an engine was read from: the keys of its file, and what its file tells besides.

Engines stand here as ``Any``: an engine has a source, whose engines have sources in turn.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from kshm.nomenclature.quantity import Quantity

MakeEngine = Callable[[Sequence[Any]], Any]  # an engine with the values of a row


@dataclass(frozen=True, slots=True)
class Further:
    """Numbers beside the solver's, those of own books: by key, and columns by table and key."""

    scalars: Mapping[str, tuple[Quantity, float]] = field(default_factory=dict)
    tables: Mapping[str, Mapping[str, tuple[Quantity, Any]]] = field(default_factory=dict)


class Source(ABC):
    """Base of what engines are read from; the inputs of the report engine derive from it.

    ``cycle`` is the calculation that the engine's gas comes from, None without one.
    """

    cycle: Any = None

    @abstractmethod
    def has_made(self, engine: Any) -> bool:  # noqa: ANN401
        """Tell whether an engine is as it was read: no number of it was replaced since."""

    def further(self) -> Further:
        """Return the numbers of own books."""
        return Further()

    @abstractmethod
    def find(self, name: str) -> str:
        """Return the key of the file that a name means, empty if there is none."""

    @abstractmethod
    def unit(self, key: str) -> str:
        """Return the label of a key's unit."""

    @abstractmethod
    def title(self, key: str) -> str:
        """Return what a key means, with its unit."""

    @abstractmethod
    def values(self, key: str) -> Mapping[str, float]:
        """Return the values of a key, or of every member of a key with a star, by their keys."""

    @abstractmethod
    def names(self) -> Sequence[str]:
        """Return the keys of the file."""

    @abstractmethod
    def rows(self, keys: Sequence[str]) -> MakeEngine:
        """Return what makes an engine of other values of keys, with a source of its own.

        It raises InputError where the values are wrong, with the words of a file that has them.
        """
