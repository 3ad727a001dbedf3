"""Works with a common origin, told by how rare what they share is in the class and before it.

The evidence of two works is a sum of bits.  A trait that so many of the others have is no
evidence; a formula of the textbook is no trait at all.  Of traits that go together, one manner or
one slip, the first counts in full, each further one half as much.  Forms that differ speak
against a common origin.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from math import log2

import numpy as np

from reports.grading.judging.traits import (
    ERROR,
    FORM,
    HELPER,
    IDLE,
    LAYOUT,
    NAME,
    SLIP,
    TEXT,
)
from reports.grading.judging.work_digest import Trait, Work
from reports.shared.russian import short

# Kind → the share of people who would have it by chance, before the class tells, and its most bits.
_KINDS = {
    FORM: (0.25, 2.5), SLIP: (0.15, 3.0), ERROR: (0.03, 5.0), IDLE: (0.01, 6.0),
    HELPER: (0.08, 4.0), TEXT: (0.05, 3.0), LAYOUT: (0.1, 3.0), NAME: (0.05, 3.0),
}  # fmt: skip
_WEIGHT = 20  # students that the share before the class counts for
HELD, TOLD = 20.0, 17.0  # bits from which works are held, and told
_FORMS_ALONE = 30.0  # bits that hold though most are of forms, where these are spelt alike
_WHOLE_FORMS = 24  # rare forms that hold by themselves though all are of one manner
_RARE = 2.0  # bits of such a form
_SPELT = 0.8  # share of the common forms that must be spelt alike for that
_NEAR = 12.0  # bits from which works may be of one ring, before it is seen whose traits they are
_RING, _MIN_RING = 5, 4  # a ring is at most a fifth of a class; what more share is common
_PAIR = 2
_CLASS = 12  # students in whose class a form may be rare at all
_FORMS_BESIDE = 8.0  # bits that forms add to other evidence at most
_UNLIKE = 1.0  # bits that a form which differs takes away
KINDS = {
    FORM: "редкая формула", SLIP: "та же ошибка", ERROR: "та же редкая ошибка",
    IDLE: "лишнее действие", HELPER: "вспомогательный столбец", TEXT: "заголовок",
    LAYOUT: "раскладка", NAME: "своё имя ячейки",
}  # fmt: skip
_WORDS = {
    FORM: "редких формул", SLIP: "одинаковых ошибок", ERROR: "одинаковых редких ошибок",
    IDLE: "формул с лишним действием", HELPER: "редких вспомогательных столбцов",
    TEXT: "одинаковых заголовков", LAYOUT: "одинаковых раскладок",
    NAME: "одинаковых своих имён",
}  # fmt: skip

Past = Sequence["PastWork"]


@dataclass(frozen=True, slots=True)
class PastWork:
    """The traits of a work of an earlier class: no name and no marks."""

    batch: str
    number: int
    traits: tuple[Trait, ...]


@dataclass(frozen=True, slots=True)
class Ring:
    """Works that share what is rare; ``held`` where that is beyond chance."""

    works: tuple[Work, ...]
    past: tuple[PastWork, ...]
    shared: tuple[Trait, ...]
    bits: float
    held: bool
    weights: tuple[float, ...] = ()  # bits of each of ``shared``

    def text(self, of: Work | None = None) -> str:
        """Tell what is shared and with whom, for one of them or for the class."""
        others = [who(work) for work in self.works if work is not of]
        counts = Counter(past.batch for past in self.past)
        others += [f"работы прошлых лет ({batch}): {n}" for batch, n in sorted(counts.items())]
        kinds = Counter(kind for kind, *_ in self.shared)
        listed = ", ".join(f"{_WORDS[kind]} {kinds[kind]}" for kind in _KINDS if kinds[kind])
        labels = {line.id: line.label for work in self.works for line in work.items}
        items = dict.fromkeys(labels[item] for _, item, *_ in self.shared if item in labels)
        named = ", ".join(list(items)[:3]) + (f" и ещё {len(items) - 3}" if len(items) > 3 else "")
        where = f" ({named})" if named else ""
        begin = "общее с" if of is not None else "редкое общее у"
        return f"{begin}: {', '.join(others)} — {listed}{where}, {short(self.bits, 3)} бит"


def who(work: Work) -> str:
    """Return a work in a message."""
    return f"{work.student} ({work.file})" if work.student else work.file


@dataclass(frozen=True, slots=True)
class _Evidence:
    """Bits that speak for a common origin of two works, and the traits that give them."""

    bits: float
    held: bool
    shared: tuple[Trait, ...]
    weights: tuple[float, ...]  # bits of each


def rings_of(graded: Sequence[Work], past: Past = (), *, past_holds: bool = True) -> list[Ring]:
    """Rings of a class, the held ones first; ``past_holds``: works of earlier years hold, too."""
    people = [work for work in graded if work.traits]
    everyone: list[Work | PastWork] = [*people, *past]
    owners = _owners(everyone)
    count = len({_owner(work) for work in everyone})
    near: dict[tuple[int, int], _Evidence] = {}
    for one, other in _near(everyone, len(people), owners, count):
        evidence = _evidence(everyone[one].traits, everyone[other].traits, owners, count)
        if evidence.bits >= _NEAR:
            near[one, other] = evidence
    pairs: dict[tuple[int, int], _Evidence] = {}
    for group in _groups(near):
        within = {pair: near[pair] for pair in near if pair[0] in group}
        pairs |= _as_ring(group, everyone, within, owners, count)
    pairs = {
        pair: _with_past(evidence, everyone[pair[1]], holds=past_holds)
        for pair, evidence in pairs.items()
        if evidence.bits >= TOLD
    }
    rings: list[Ring] = []
    for held in (True, False):
        links = {pair: evidence for pair, evidence in pairs.items() if evidence.held == held}
        for group in _groups(links):
            ring = _ring(group, everyone, links, held=held)
            if not any(_has(within, ring) for within in rings):  # a part of what is told already
                rings.append(ring)
    return rings


def _with_past(evidence: _Evidence, other: Work | PastWork, *, holds: bool) -> _Evidence:
    """Evidence beside a work of an earlier year: the rubric says whether it holds points."""
    return replace(evidence, held=holds) if isinstance(other, PastWork) else evidence


def _as_ring(
    group: Sequence[int], everyone: Sequence[Work | PastWork],
    evidence: Mapping[tuple[int, int], _Evidence],
    owners: Mapping[tuple[str, str, str], int], count: int,
) -> dict[tuple[int, int], _Evidence]:  # fmt: skip
    """Evidence in a group, where what its members share is no less rare for their number.

    What a whole subgroup has of its lecturer stays common: a ring is a small part of a class.
    """
    size = len({_owner(everyone[index]) for index in group})
    if not _PAIR < size <= max(_MIN_RING, count // _RING):
        return dict(evidence)
    inside = _owners([everyone[index] for index in group])
    outside = {key: n - max(0, inside.get(key, 0) - _PAIR) for key, n in owners.items()}
    left = count - (size - _PAIR)
    return {
        (one, other): _evidence(everyone[one].traits, everyone[other].traits, outside, left,
                                small=count < _CLASS)
        for one, other in combinations(group, 2)
        if isinstance(everyone[one], Work) and _owner(everyone[one]) != _owner(everyone[other])
    }  # fmt: skip


def _has(whole: Ring, part: Ring) -> bool:
    keys = {work.key for work in whole.works}
    return whole.held and keys >= {work.key for work in part.works} and not part.past


def _owner(work: Work | PastWork) -> tuple[str, object]:
    if isinstance(work, PastWork):
        return work.batch, work.number
    return "", work.number or work.key


def _key(trait: Trait) -> tuple[str, str, str]:
    return trait[0], trait[1], trait[2]


def _owners(everyone: Sequence[Work | PastWork]) -> Counter[tuple[str, str, str]]:
    """Kind, item and digest → how many people have the trait."""
    seen = {(_owner(work), _key(trait)) for work in everyone for trait in work.traits}
    return Counter(key for _, key in seen)


def _bits(trait: Trait, owners: Mapping[tuple[str, str, str], int], count: int) -> float:
    """Evidence of a trait that two works share: the fewer others have it, the more."""
    share, most = _KINDS[trait[0]]
    others = owners[_key(trait)] - 2
    return min(most, -log2((others + _WEIGHT * share) / (count - 2 + _WEIGHT)))


def _near(
    everyone: Sequence[Work | PastWork], people: int,
    owners: Mapping[tuple[str, str, str], int], count: int,
) -> list[tuple[int, int]]:  # fmt: skip
    """Pairs of this class, and of it with earlier ones, that share enough to be looked at."""
    keys = {key: at for at, key in enumerate(key for key, n in owners.items() if n > 1)}
    if not keys:
        return []
    table = np.zeros((len(everyone), len(keys)), dtype=np.float32)
    for row, work in enumerate(everyone):
        for trait in work.traits:
            at = keys.get(_key(trait))
            if at is not None:
                table[row, at] = _bits(trait, owners, count) ** 0.5
    sums = table[:people] @ table.T
    pairs = np.argwhere(sums >= _NEAR - 1e-3)
    return [
        (int(one), int(other))
        for one, other in pairs
        if one < other and _owner(everyone[one]) != _owner(everyone[other])
    ]


def _evidence(
    mine: Sequence[Trait], theirs: Sequence[Trait],
    owners: Mapping[tuple[str, str, str], int], count: int, *, small: bool | None = None,
) -> _Evidence:  # fmt: skip
    """Evidence of two works; ``small``: no form is rare in so few works."""
    small = count < _CLASS if small is None else small
    others = {_key(trait): trait for trait in theirs}
    shared = [trait for trait in mine if _key(trait) in others]
    sums = dict.fromkeys(_KINDS, 0.0)
    times: Counter[tuple[str, str]] = Counter()
    weights: dict[Trait, float] = {}
    for trait in sorted(shared, key=lambda trait: -_bits(trait, owners, count)):
        group = trait[0], trait[4] or trait[0]
        weights[trait] = _bits(trait, owners, count) * 0.5 ** times[group]
        sums[trait[0]] += weights[trait]
        times[group] += 1
    forms, strong = sums[FORM], sum(sums.values()) - sums[FORM]
    unlike = _differing(mine, theirs)
    forms = max(0.0, forms - _UNLIKE * unlike)
    if small:
        forms = min(forms, _FORMS_BESIDE)
    common = [trait for trait in shared if trait[0] == FORM]
    alike = sum(trait[3] == others[_key(trait)][3] for trait in common)
    rare = sum(_bits(trait, owners, count) >= _RARE for trait in common)
    whole = not small and rare >= _WHOLE_FORMS and unlike <= (1 - _SPELT) * rare
    alone = (whole or forms + strong >= _FORMS_ALONE) and alike >= _SPELT * len(common)
    if whole and alone:  # all of one manner: half as much for each further one tells too little
        forms = max(forms, _FORMS_ALONE)
    held = alone or strong + min(forms, _FORMS_BESIDE) >= HELD
    telling = tuple(trait for trait in shared if _bits(trait, owners, count) >= 1)
    return _Evidence(forms + strong, held, telling, tuple(weights[t] for t in telling))


def _differing(mine: Sequence[Trait], theirs: Sequence[Trait]) -> int:
    """Items that one of two works, or both, have in a form that the other has not."""
    one, other = ({t[1]: t[2] for t in side if t[0] == FORM} for side in (mine, theirs))
    return sum(one.get(item) != other.get(item) for item in one.keys() | other.keys())


def _groups(links: Mapping[tuple[int, int], object]) -> list[list[int]]:
    """Works that are linked, through others too."""
    leader: dict[int, int] = {}

    def top(index: int) -> int:
        while leader.setdefault(index, index) != index:
            index = leader[index]
        return index

    for one, other in links:
        leader[top(one)] = top(other)
    groups: dict[int, list[int]] = {}
    for index in sorted(leader):
        groups.setdefault(top(index), []).append(index)
    return sorted(groups.values())


def _ring(
    group: Sequence[int], everyone: Sequence[Work | PastWork],
    links: Mapping[tuple[int, int], _Evidence], *, held: bool,
) -> Ring:  # fmt: skip
    inside = [evidence for pair, evidence in links.items() if pair[0] in group]
    counts = Counter(trait for evidence in inside for trait in evidence.shared)
    shared = [trait for trait, n in counts.items() if 2 * n >= len(inside)]
    weights = {t: w for each in inside for t, w in zip(each.shared, each.weights, strict=True)}
    works = [everyone[index] for index in group]
    return Ring(
        tuple(work for work in works if isinstance(work, Work)),
        tuple(work for work in works if isinstance(work, PastWork)),
        tuple(sorted(shared)),
        max(evidence.bits for evidence in inside),
        held,
        tuple(weights[trait] for trait in sorted(shared)),
    )
