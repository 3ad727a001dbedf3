"""Input files of the tests: samples and layouts with a section [torsion]."""

from __future__ import annotations

import copy
from typing import Any

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from tests.conftest import sample
from tests.layouts import MAKERS

TWO_DISCS = {
    "masses": [
        {"name": "ротор", "inertia_kg_m2": 211.4, "stiffness_nm_rad": 9.775e6},
        {"name": "двигатель", "inertia_kg_m2": 8.3, "throw": 1.0},
    ]
}


def laid_out(maker: str, torsion: dict[str, Any], **calculation: object) -> InputFile:
    """An engine of a layout with the section."""
    raw = MAKERS[maker](copy.deepcopy(to_mapping(sample("gots-diesel"))))
    raw["torsion"] = torsion
    raw["calculation"] |= calculation
    return load_mapping(raw, source=maker).model


def mwm(**torsion: object) -> InputFile:
    """The sample with other keys of its section, on a coarse grid."""
    raw = to_mapping(sample("mwm-6"))
    raw["torsion"] |= torsion
    raw["calculation"]["step_deg"] = 15
    return load_mapping(raw, source="mwm-6").model


def chain(
    inertias: list[float], springs: list[float], left: float = 0.0, right: float = 0.0
) -> dict[str, Any]:
    """A section with a train of its own; throw 1 stands on the first mass."""
    return {
        "ground_nm_rad": left,
        "masses": [
            {"inertia_kg_m2": inertia, "stiffness_nm_rad": spring, "throw": float(k == 0)}
            for k, (inertia, spring) in enumerate(zip(inertias, [*springs, right], strict=True))
        ],
    }
