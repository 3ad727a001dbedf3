"""Input data of other variants in a work, told by numbers of the work alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from reports.grading.issuing.assignment import Item
from reports.grading.judging.judgement import WRONG, Array, Judgement, explains, values_of
from reports.grading.judging.literal_tables import is_scaled, typed_numbers
from reports.grading.reading.student import StudentBook
from reports.model.evaluation import Evaluation
from reports.shared.russian import short

_OTHERS = 200  # variants that are tried
_LEADS = 2  # wrong columns that one variant explains together


@dataclass(frozen=True, slots=True)
class OtherVariant:
    """Drawn values of another student's variant by the name of their input cell."""

    number: int
    values: dict[str, float]


@dataclass(frozen=True)
class Variants:
    """The variants of the others, and the wrong items of a work that they may explain.

    Nobody's variant is named on the strength of a coincidence: the numbers must be typed in, or
    stand in the formulas, and of two variants that have them alike neither is named.
    """

    student: StudentBook
    others: Sequence[OtherVariant]
    whole: dict[int, Evaluation]  # other variants, the same for a class
    titles: dict[str, str]
    judgements: Sequence[Judgement] = ()

    def words(self, judgement: Judgement, fits: Callable[[Array], bool]) -> Iterator[str]:
        """Causes of a wrong item in words, the likeliest first."""
        item, numbers = judgement.item, self._numbers(judgement)
        if not (numbers or judgement.typed):
            return
        leading = self._leading
        if leading and any(fits(self._of(n, item)) for n in leading):
            yield self._named("исходные данные", leading)
        expected = self.student.expected
        values, inside = self._near(item)
        for (name, value), owners in self._parameters(inside).items():
            if judgement.typed or is_scaled(value, numbers):
                run = expected.fork({**values, name: value})
                if fits(values_of(item, run)):
                    title = self.titles.get(name, name)
                    yield f"{self._named(title, owners)}: {short(value)}"
        if "lam" in inside:
            for lam, owners in self._ratios.items():
                if fits(values_of(item, expected.fork({**values, "lam": lam}))):
                    yield f"{self._named('λ', owners)}: {short(lam, 4)}"
        owners = [other.number for other in self._tried if fits(self._of(other.number, item))]
        if owners:
            yield self._named("исходные данные", owners)

    def _named(self, trait: str, owners: Sequence[int]) -> str:
        """Something with its owner, where there is but one: the others are innocent."""
        lead = [n for n in owners if n in self._leading] if len(self._leading) == 1 else owners
        return f"{trait} из варианта {lead[0]}, а не вашего" if len(lead) == 1 else (
            f"{trait} не из вашего варианта")  # fmt: skip

    @cached_property
    def _tried(self) -> Sequence[OtherVariant]:
        return self.others[:_OTHERS]

    def _numbers(self, judgement: Judgement) -> frozenset[float]:
        return typed_numbers(self.student, judgement.item)

    def _near(self, item: Item) -> tuple[dict[str, object], frozenset[str]]:
        """Columns that a formula names, with their right values, and all inputs behind the rest."""
        graph = self.student.assignment.graph
        references = frozenset().union(*(graph.references(node) for node in item.nodes))
        values = {node: self.student.expected.value(node) for node in references if "." in node}
        return values, references | frozenset().union(
            *(graph.ancestors(n) for n in references if "." not in n)
        )

    def _parameters(self, inside: frozenset[str]) -> dict[tuple[str, float], list[int]]:
        """Owners of each value of each parameter that a formula depends on."""
        owners: dict[tuple[str, float], list[int]] = {}
        for other in self._tried:
            for name, value in other.values.items():
                if name in inside:
                    owners.setdefault((name, value), []).append(other.number)
        return owners

    def _run(self, number: int) -> Evaluation:
        run = self.whole.get(number)
        if run is None:
            values = next(other.values for other in self.others if other.number == number)
            run = self.whole[number] = self.student.expected.fork(dict(values))
        return run

    def _of(self, number: int, item: Item) -> Array:
        return values_of(item, self._run(number))

    @cached_property
    def _ratios(self) -> dict[float, list[int]]:
        owners: dict[float, list[int]] = {}
        for other in self._tried:
            owners.setdefault(float(self._run(other.number).value("lam")), []).append(other.number)
        return owners

    @cached_property
    def _leading(self) -> list[int]:
        """The variants that explain more of the wrong items together than any others."""
        wrong = [j for j in self.judgements if j.verdict == WRONG and self._is_of_numbers(j)]
        if len(wrong) < _LEADS:
            return []
        counts = {
            other.number: sum(self._explains(other.number, judgement) for judgement in wrong)
            for other in self._tried
        }
        most = max(counts.values(), default=0)
        return [n for n, count in counts.items() if count == most] if most >= _LEADS else []

    def _is_of_numbers(self, judgement: Judgement) -> bool:
        return bool(judgement.typed or self._numbers(judgement))

    def _explains(self, number: int, judgement: Judgement) -> bool:
        attempt = self._of(number, judgement.item)
        return explains(judgement.item, judgement.values, attempt, judgement.expected, self.student)
