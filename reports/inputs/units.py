"""Units of the input file and their conversion to SI.

An input key ends in the `suffix` of its unit (``bore_mm``); a header or a
message shows the Russian `label`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from kshm.nomenclature.quantity import UNITS
from reports.shared.russian import power_of_ten, short


@dataclass(frozen=True, slots=True)
class InputUnit:
    """A unit of the input file: SI value = value * `times` / `over`.

    Two factors, because 47 / 1000 is the double nearest to 0.047 and
    47 * 0.001 need not be.
    """

    suffix: str
    label: str
    times: float = 1.0
    over: float = 1.0

    def to_si(self, value: float) -> float:
        """Convert a value in this unit to SI."""
        if self is DEG:
            return math.radians(value)
        return value * self.times / self.over

    def si(self, value: Any) -> Any:  # noqa: ANN401 - texts and choices have no unit
        """Convert to SI; keep values without a unit."""
        return value if self is NONE else self.to_si(value)

    def given(self, value: float | None) -> float | None:
        """Convert an optional value to SI."""
        return None if value is None else self.to_si(value)

    def from_si(self, value: float) -> float:
        """Convert an SI value to this unit."""
        if self is DEG:
            return math.degrees(value)
        return value * self.over / self.times

    def text(self, value: float) -> str:
        """Return the value with its label: ``88 мм``, ``15°``, ``0.317``."""
        return self._labelled(number_text(value))

    def limit(self, value: float) -> str:
        """Return a limit with its label, a large power of ten as such: ``10¹² Н·м/рад``."""
        return self._labelled(power_of_ten(value) or number_text(value))

    def _labelled(self, number: str) -> str:
        if not self.label:
            return number
        return number + self.label if self is DEG else f"{number} {self.label}"


NONE = InputUnit("", "")
MM = InputUnit("mm", "мм", over=1000.0)
KG = InputUnit("kg", "кг")
DEG = InputUnit("deg", "°", times=math.pi, over=180.0)
MPA = InputUnit("mpa", UNITS["MPa"].label, times=UNITS["MPa"].si)
RPM = InputUnit("rpm", "мин⁻¹", times=math.pi, over=30.0)
KW = InputUnit("kw", "кВт", times=1000.0)
KELVIN = InputUnit("k", "К")
MJ_KG = InputUnit("mj_kg", "МДж/кг", times=1e6)
KG_KMOL = InputUnit("kg_kmol", "кг/кмоль")
KJ_KG_K = InputUnit("kj_kg_k", "кДж/(кг·К)", times=1000.0)
PERCENT = InputUnit("percent", "%", over=100.0)
PER_MIN = InputUnit("per_min", "мин⁻¹", over=60.0)
KG_M2 = InputUnit("kg_m2", "кг·м²")
NM_RAD = InputUnit("nm_rad", "Н·м/рад")
NMS_RAD = InputUnit("nms_rad", "Н·м·с/рад")
KG_PER_M2 = InputUnit("kg_per_m2", "кг/м²")
UM = InputUnit("um", "мкм", over=1e6)
CELSIUS = InputUnit("c", "°C")
MPA_S = InputUnit("mpa_s", "мПа·с", over=1000.0)
KG_M3 = InputUnit("kg_m3", "кг/м³")
J_KG_K = InputUnit("j_kg_k", "Дж/(кг·К)")
MPA_S_M = InputUnit("mpa_s_m", f"{MPA.label}·с/м", times=MPA.times)


def is_within(value: float, span: tuple[float, float]) -> bool:
    """Whether a quotient lies in a span, its ends too: 0.3 as 1 − 104.3/149 is a little more."""
    return span[0] <= round(value, 9) <= span[1]


def span_text(low: float, high: float) -> str:
    """Both ends of a span as a sentence writes them: ``от 0,15 до 0,45``."""
    return f"от {number_text(low)} до {number_text(high)}"


def number_text(value: float) -> str:
    """Return a number as a sentence writes it: decimal comma, no trailing zeros."""
    return short(value, 10)
