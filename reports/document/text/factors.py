"""Numbers within formulas that turn one unit into another, and the words for them.

A factor of the unit functions, as ``of_mm``, has its words by its units; a number that the source
itself writes into a formula has them here.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from kshm.nomenclature.quantity import UNITS
from reports.formula.tex import exponent_of

Factor = tuple[str, str]  # TeX of the number, what it turns into what

_PLAIN = {"MPa": "Па", "kN": "Н", "mm": "м", "kW": "Вт", "dm3": "м³"}  # units of SI
_AREA: Factor = ("100", "см² в мм²")
_METRE: Factor = ("1000", "м в мм")
_ARM: Factor = ("1000", "мм в м")
_TORQUE: Factor = ("1000", "Н·м в Н·мм")
_PERCENT: Factor = ("100", "долю в проценты")
WRITTEN: Mapping[str, tuple[Factor, ...]] = {
    "st_press_MPa": (_AREA,), "st_pull_MPa": (_AREA,), "st_cap_MPa": (_AREA,),
    "st_shank_x_MPa": (_AREA,), "st_shank_y_MPa": (_AREA,), "st_shank_min_MPa": (_AREA,),
    "st_shank_Kx": (_METRE, _AREA), "st_shank_Ky": (_METRE, _AREA),
    "st_bush_gap_mm": (("1000", "мкм в мм"), ("10^{6}", "миллионные доли 1/К в 1/К")),
    "st_draw_M0": (_ARM,), "st_draw_M": (_ARM,), "st_draw_MPa": (_TORQUE,),
    "st_web_W": (("1000", "мм³ в см³"),),
    "cyc_q": (("1000", "МДж в кДж"),), "cyc_D_0": (("100", "дм в мм"),),
    "cyc_G_f": (("1000", "г в кг"),), "gov_ge": (("1000", "кг в г"),),
    "cyc_g_i": ((r"3{,}6 \cdot 10^{6}", "кг/кДж в г/(кВт·ч)"),),
    "T_error": (_PERCENT,),
}  # fmt: skip
WRITTEN_ALL = frozenset(factor for factors in WRITTEN.values() for factor in factors)


def of_scale(scale: str) -> Factor:
    """Power of ten of a unit function and its words: ``of_mm`` turns mm into m."""
    way, unit = scale.split("_", 1)
    pair = (_PLAIN[unit], UNITS[unit].label)
    first, last = pair if way == "to" else reversed(pair)
    return f"10^{{{exponent_of(scale)}}}", f"{first} в {last}"


def written_in(name: str) -> Iterator[Factor]:
    """Factors that the source writes into the formula of a node."""
    yield from WRITTEN.get(name.rpartition(".")[2], ())
