"""Which chapters a report holds: profiles and a person's own choice."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.report import Report
from reports.spec.shape import Shape
from reports.tables.gas.cycle_names import section_of

_ALWAYS = {"notation", "introduction", "inputs", "conclusion", "sources"}
_SHORT = {"cycle", "kinematics", "dynamics", "torque", "crankpin", "journals"}
_COURSE = _SHORT | {"running", "torsion", "oil", "regimes", "checks", "appendices"}
_FULL = _COURSE | {"bearings", "reference", "companions"}
_PROFILES = {"short": _SHORT, "course": _COURSE, "full": _FULL}


def chosen(report: Report) -> set[str]:
    """Names of the chapters that a report holds."""
    wanted = _PROFILES[report.detail] if report.chapters is None else set(report.chapters)
    return wanted | _ALWAYS


def told(model: InputFile) -> set[str]:
    """Those of them that have something to tell of an engine."""
    lacking = {"torsion"} if model.torsion is None else set()
    lacking |= {"oil"} if model.bearings is None else set()
    lacking |= {"cycle"} if section_of(model) is None else set()
    shape = Shape.of(model)
    lacking |= {"companions"} if shape.offset or shape.articulated else set()
    return chosen(model.report) - lacking
