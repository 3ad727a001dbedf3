"""The [reference] section of the input file: tables of chapters 1 and 2 for any λ."""

from __future__ import annotations

from reports.inputs.meta import Strictly, number
from reports.inputs.units import DEG, NONE

MOST_LAMBDAS = 12
BOOK_LAMBDAS = tuple(round(1 / value, 6) for value in (3.2, 3.4, 3.6, 3.8, 4.0, 4.2))


class ReferenceSection(Strictly):
    """[reference]: with it come the sheets of tables 1-3 and 5-8 and figures 3-10."""

    lambdas: tuple[float, ...] = number("Значение λ № {n}", "λ_{n}", NONE, 0.01, 0.7, BOOK_LAMBDAS)
    angle_deg: float = number("Угол кривошипа на схемах рисунков 5 и 9", "φ", DEG, 5, 175, 50.0)
