"""Which chapters a report holds: profiles and a person's own choice."""

from __future__ import annotations

from reports.inputs.sections.report import Report

_ALWAYS = {"notation", "introduction", "inputs", "conclusion", "sources"}
_SHORT = {"cycle", "kinematics", "dynamics", "torque", "crankpin", "journals"}
_COURSE = _SHORT | {"running", "torsion", "oil", "regimes", "checks", "appendices"}
_FULL = _COURSE | {"bearings", "reference", "companions"}
_PROFILES = {"short": _SHORT, "course": _COURSE, "full": _FULL}


def chosen(report: Report) -> set[str]:
    """Names of the chapters that a report holds."""
    wanted = _PROFILES[report.detail] if report.chapters is None else set(report.chapters)
    return wanted | _ALWAYS
