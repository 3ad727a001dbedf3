"""Input files of the tests: samples and layouts with a section [bearings]."""

from __future__ import annotations

import copy
from typing import Any

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from tests.conftest import sample
from tests.layouts import MAKERS


def laid_out(maker: str, bearings: dict[str, Any], **calculation: object) -> InputFile:
    """An engine of a layout with the section."""
    raw = MAKERS[maker](copy.deepcopy(to_mapping(sample("gots-diesel"))))
    raw["bearings"] = bearings
    raw["calculation"] |= calculation
    return load_mapping(raw, source=maker).model


def tractor(step: int = 15, **bearings: object) -> InputFile:
    """The tractor diesel whose bearing the companions' note describes, on a coarse grid."""
    raw = to_mapping(sample("d-240"))
    raw["bearings"] = {"pin_clearance_min_mm": 0.057, "pin_clearance_max_mm": 0.131} | bearings
    raw["calculation"]["step_deg"] = step
    return load_mapping(raw, source="d-240").model
