"""Which chapters a report holds: profiles and a person's own choice."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile
from reports.model.shape import Shape
from reports.tables.cycle_names import section_of

_ALWAYS = {"notation", "introduction", "inputs", "conclusion", "sources"}
_SHORT = {"cycle", "kinematics", "dynamics", "torque", "crankpin", "journals"}
_COURSE = _SHORT | {"running", "torsion", "oil", "regimes", "checks", "appendices"}
_FULL = _COURSE | {"balance", "bearings", "reference", "companions"}
_PROFILES = {"short": _SHORT, "course": _COURSE, "full": _FULL}


def chosen(model: InputFile) -> set[str]:
    """Names of the chapters that a report holds."""
    report = model.report
    wanted = _PROFILES[report.detail] if report.chapters is None else set(report.chapters)
    # Who fills in the section wants to read of it; the short report ends before.
    asked = report.chapters is None and report.detail == "course" and model.balance.asked
    # Both were one chapter: files that name it get what they got.
    if asked or "companions" in wanted:
        wanted = wanted | {"balance"}
    return wanted | _ALWAYS


def told(model: InputFile) -> set[str]:
    """Those of them that have something to tell of an engine."""
    lacking = {"torsion"} if model.torsion is None else set()
    lacking |= {"oil"} if model.bearings is None else set()
    lacking |= {"cycle"} if section_of(model) is None else set()
    shape = Shape.of(model)
    lacking |= {"balance", "companions"} if shape.offset or shape.articulated else set()
    return chosen(model) - lacking
