"""What a person gives for a work or a column: points, a share, a factor, more or less, a mark."""

from __future__ import annotations

import re
from dataclasses import dataclass

from reports.grading.issuing.rubric import Rubric
from reports.shared.errors import InputError, Problem, one_line
from reports.shared.russian import short

ACCEPT, WITHDRAW = "+", "-"
_FACTOR = re.compile(r"[×*xхXХ✕⋅·]\s*(\d+(?:\.\d+)?)\s*(%?)|(\d+(?:\.\d+)?)\s*[×✕]")
_MORE = re.compile(r"(?:([-+−–])|(плюс|минус)\s)\s*(\d+(?:\.\d+)?)")
_SHARE = re.compile(r"(\d+(?:\.\d+)?)\s*%")
_MARK = re.compile(r"оценка\s*:?\s*(.+)")
_KINDS = "«75» — баллы, «×0,75» — умножить баллы каждого, «+5» или «-5» — прибавить или снять"


@dataclass(frozen=True, slots=True)
class Award:
    """Points as they are, or a change of the program's: a factor, or points more (less)."""

    points: float | None = None
    factor: float | None = None
    more: float | None = None

    @property
    def word(self) -> str:
        """A change as a person writes it, empty for points."""
        if self.factor is not None:
            return f"×{short(self.factor)}"
        if self.more is not None:
            return f"{'+' if self.more >= 0 else '-'}{short(abs(self.more))}"
        return ""

    @property
    def is_change(self) -> bool:
        """Whether there must be points of the program."""
        return self.points is None

    def of(self, points: float, most: float) -> float:
        """Points instead of those of the program, at least 0 and at most ``most``."""
        if self.factor is not None:
            return round(min(most, points * self.factor), 6)
        if self.more is not None:
            return round(min(most, max(0.0, points + self.more)), 6)
        return points if self.points is None else self.points


def award_of(text: str, rubric: Rubric, worth: float | None) -> Award:
    """Return the award that a person has written; ``worth`` is what a share is a share of.

    Args:
        text: 40, 50%, ×0,75, +5, -5, оценка 4; «+» takes the program's points as they are.
        rubric: the most points, and the points of marks.
        worth: points of the column or work; None where a share could be taken two ways.

    Raises:
        InputError: the text is none of these.
    """
    plain = " ".join(text.replace(",", ".").split()).casefold()
    if plain == ACCEPT:
        return Award()
    if match := _FACTOR.fullmatch(plain):
        factor = float(match[1] or match[3]) / (100 if match[2] else 1)
        return Award(factor=_within(factor, 10, text))
    if match := _MORE.fullmatch(plain):
        sign = 1 if (match[1] or match[2]) in ("+", "плюс") else -1
        return Award(more=sign * _within(float(match[3]), rubric.maximum, text))
    if match := _SHARE.fullmatch(plain):
        share = float(match[1]) / 100
        if worth is None:
            problem = "доля чего: баллов, которые уже есть, или наибольшего балла?"
            hint = f"«×{short(share)}» — умножить баллы каждого, " \
                   f"«{short(share * rubric.maximum)}» — поставить столько всем"  # fmt: skip
            raise InputError(Problem(one_line(text, 40), problem, hint))
        return Award(round(_within(share, 1, text) * worth, 6))
    return Award(_points(plain, text, rubric))


def _points(plain: str, text: str, rubric: Rubric) -> float:
    marks = {name.casefold(): least for name, least in rubric.scale.marks.items()}
    marks.setdefault(rubric.scale.none.casefold(), 0.0)
    called = match[1] if (match := _MARK.fullmatch(plain)) else plain
    if rubric.scale.marks and called in marks and (match or not called.isdigit()):
        return marks[called]
    try:
        value = float(plain)
    except ValueError:
        value = -1.0
    return _within(value, rubric.maximum, text)


def _within(value: float, most: float, text: str) -> float:
    if not 0 <= value <= most:
        hint = f"нужно число от 0 до {most:g}; {_KINDS}; «+» — принять баллы программы, " \
               "«-» — отменить решение"  # fmt: skip
        raise InputError(Problem(one_line(text, 40) or "баллы", "это не баллы", hint))
    return value
