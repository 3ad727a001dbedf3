"""The report engine: files, tables and people around the solver `kshm`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kshm.engine.engine import Engine

__all__ = ["load"]


def load(source: Path | str | Mapping[str, Any]) -> Engine:
    """Engine of an input file, of a workbook that a person edited, or of a mapping of sections.

    What is allowed but odd is a ``UserWarning``, one line each, in Russian.

    Raises:
        reports.shared.errors.InputError: with everything that is wrong with the input.

    >>> engine = load("samples/gots-diesel.toml")
    >>> engine.cylinders, round(engine.geometry.bore, 3)  # SI units
    (3, 0.088)
    """
    import warnings

    from reports.exports.build import load_input
    from reports.inputs.load import load_mapping
    from reports.inputs.to_si.engine import to_engine

    loaded = (
        load_mapping(source, source="") if isinstance(source, Mapping) else load_input(Path(source))
    )
    for odd in loaded.warnings:
        warnings.warn(odd.line(), stacklevel=2)
    return to_engine(loaded.model)
