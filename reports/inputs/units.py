"""Units people write and read, and their conversion to SI.

An input key ends in the `suffix` of its unit (``bore_mm``); a header or a
message shows the Russian `label`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from kshm.nomenclature.quantity import UNITS
from reports.shared.russian import power_of_ten, short


@dataclass(frozen=True, slots=True)
class Unit:
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

    def given(self, value: float | None) -> float | None:
        """Convert to SI what a file may leave out."""
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
        """A limit with its label, a large power of ten as such: ``10¹² Н·м/рад``."""
        return self._labelled(power_of_ten(value) or number_text(value))

    def _labelled(self, number: str) -> str:
        if not self.label:
            return number
        return number + self.label if self is DEG else f"{number} {self.label}"


NONE = Unit("", "")
MM = Unit("mm", "мм", over=1000.0)
KG = Unit("kg", "кг")
DEG = Unit("deg", "°", times=math.pi, over=180.0)
MPA = Unit("mpa", UNITS["MPa"].label, times=UNITS["MPa"].si)
RPM = Unit("rpm", "мин⁻¹", times=math.pi, over=30.0)
KW = Unit("kw", "кВт", times=1000.0)
KELVIN = Unit("k", "К")
MJ_KG = Unit("mj_kg", "МДж/кг", times=1e6)
KG_KMOL = Unit("kg_kmol", "кг/кмоль")
KJ_KG_K = Unit("kj_kg_k", "кДж/(кг·К)", times=1000.0)
PERCENT = Unit("percent", "%", over=100.0)
PER_MIN = Unit("per_min", "мин⁻¹", over=60.0)
KG_M2 = Unit("kg_m2", "кг·м²")
NM_RAD = Unit("nm_rad", "Н·м/рад")
NMS_RAD = Unit("nms_rad", "Н·м·с/рад")
KG_PER_M2 = Unit("kg_per_m2", "кг/м²")
UM = Unit("um", "мкм", over=1e6)
CELSIUS = Unit("c", "°C")
MPA_S = Unit("mpa_s", "мПа·с", over=1000.0)
KG_M3 = Unit("kg_m3", "кг/м³")
J_KG_K = Unit("j_kg_k", "Дж/(кг·К)")
MPA_S_M = Unit("mpa_s_m", f"{MPA.label}·с/м", times=MPA.times)


def is_within(value: float, span: tuple[float, float]) -> bool:
    """Whether a quotient lies in a span, its ends too: 0.3 as 1 − 104.3/149 is a little more."""
    return span[0] <= round(value, 9) <= span[1]


def span_text(low: float, high: float) -> str:
    """Both ends of a span as a sentence writes them: ``от 0,15 до 0,45``."""
    return f"от {number_text(low)} до {number_text(high)}"


def number_text(value: float) -> str:
    """Return a number as a sentence writes it: decimal comma, no trailing zeros."""
    return short(value, 10)
