"""What the cycle calculation says of its inputs: a key and numbers, for others to word."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Remark:
    """``key`` of what is wrong or odd, the input ``field`` it is about, its numbers in SI.

    ``field`` is the name of the input in the dataclasses of the cycle, such as
    ``boost.pressure_ratio``.
    """

    key: str
    field: str
    numbers: Mapping[str, float]


class CycleError(ValueError):
    """An input from which no cycle can be calculated; ``remark`` says which and why."""

    def __init__(self, key: str, field: str, **numbers: float) -> None:
        """Keep the remark; the text of the error is for developers."""
        shown = ", ".join(f"{name} = {value:.6g}" for name, value in numbers.items())
        super().__init__(f"{field}: {key}" + (f" ({shown})" if shown else ""))
        self.remark = Remark(key, field, numbers)
