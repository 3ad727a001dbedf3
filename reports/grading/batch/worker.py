"""Grader of one submission; imports all before memory is limited."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import formualizer
import lxml.etree
import numpy as np

from reports.grading.issuing.register import load_register
from reports.grading.judging.marking import Marker
from reports.grading.pages.pages import student_page
from reports.grading.reading.submissions import Submission
from reports.shared.gc_pause import uncollected

assert formualizer
assert lxml.etree


def marking(register_folder: Path) -> Callable[[Submission], tuple[dict[str, Any], str]]:
    """Grader that returns result and page, by the register of a folder."""
    np.ones((8, 8)) @ np.ones((8, 8))  # its library takes memory of its own
    marker = Marker(load_register(register_folder))

    def mark(submission: Submission) -> tuple[dict[str, Any], str]:
        with uncollected():  # what a work leaves behind is found young, by one look
            result = marker.mark(submission, submission.read())
            return result, student_page(result, marker.register.rubric)

    return mark
