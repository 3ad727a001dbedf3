"""A checked input whose values change at a few paths: only what reads them is done again.

A check that has read none of the changed keys says of every revision what it has said of the
input, and a part of the engine made of the same sections is the same part.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from pydantic import ValidationError

from kshm.cycle.cycle import CycleRun
from kshm.engine.engine import Engine
from reports.inputs.checks.cross_checks import CHECKS, Check
from reports.inputs.checks.layout import check_room
from reports.inputs.fields import Path, set_value
from reports.inputs.findings import ValidValues
from reports.inputs.load import load_mapping
from reports.inputs.meta import hints
from reports.inputs.registry import SECTIONS
from reports.inputs.to_si.engine import KeptParts, engine_and_cycle


@dataclass(slots=True)
class _Recorded(ValidValues):
    """Valid values that remember which were read: that a key is there does not change."""

    read: set[tuple[str, str]] = field(default_factory=set)

    def get(self, section: str, key: str) -> Any:  # noqa: ANN401
        """Return a valid value, or None."""
        self.read.add((section, key))
        return self.sections.get(section, {}).get(key)


class Revisions:
    """Engines of an input with other values at the given paths.

    ``revised`` is the input with the values of the last row.

    Raises:
        InputError: the input itself is wrong.
    """

    def __init__(self, raw: dict[str, Any], source: str, paths: Sequence[Path]) -> None:
        self._raw, self._source, self._paths = copy.deepcopy(raw), source, paths
        self._model = self.revised = load_mapping(raw, source=source).model
        self._changed = tuple(dict.fromkeys(str(path[0]) for path in paths))
        # A calculated cycle and further regimes are checked as wholes.
        all_known = set(self._changed) <= SECTIONS.keys()
        self._quick = all_known and self._model.cycle is None and not self._model.regimes
        self._values = ValidValues()
        self._kept = KeptParts()
        if self._quick:
            for name in SECTIONS:
                if getattr(self._model, name) is not None:
                    self._put(name, getattr(self._model, name))
            self._checks = [check for check in CHECKS if self._reads_changed(check)]

    def engine(self, row: Sequence[float | int]) -> tuple[Engine, CycleRun | None]:
        """Engine with the values of a row, in the order of the paths, and its cycle.

        Raises:
            InputError: the values are wrong, with the words of a file that has them.
        """
        for path, value in zip(self._paths, row, strict=True):
            set_value(self._raw, path, value)
        if not (self._quick and self._revise()):
            self.revised = load_mapping(self._raw, source=self._source).model
            return engine_and_cycle(self.revised)
        self.revised = self._model
        return engine_and_cycle(self._model, self._kept)

    def _put(self, name: str, section: Any) -> None:  # noqa: ANN401
        keys = hints(type(section))  # type: ignore[arg-type]
        values = {key: getattr(section, spec.name) for key, spec in keys.items()}
        self._values.sections[name] = values
        for key, value in values.items():
            if isinstance(value, tuple):
                self._values.counts[name, key] = len(value)

    def _reads_changed(self, check: Check) -> bool:
        recorded = _Recorded(self._values.sections, self._values.counts)
        list(check(recorded))
        return not recorded.read.isdisjoint((str(a), str(b)) for a, b, *_ in self._paths)

    def _revise(self) -> bool:
        """Take the changed sections; False where a check has something against them."""
        changed = {}
        for name in self._changed:
            try:
                section = type(getattr(self._model, name)).model_validate(self._raw[name])
            except ValidationError:
                return False
            changed[name] = section
            self._put(name, section)
        self._model = self._model.model_copy(update=changed)
        findings = [finding for check in self._checks for finding in check(self._values)]
        if "crankshaft" in self._changed:  # of what is implausible only this is refused
            findings += check_room(self._model, frozenset())
        return all(finding.warning for finding in findings)
