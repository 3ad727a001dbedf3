"""The changes of ``docs/new-module.md``: how many files they touch, and what comes of them."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys

import pytest

from tests.manual.pages import DOCS, ROOT, blocks

MOST = 6  # files that a new physics module may touch
TRY = """
import io, json, sys
import numpy as np
import openpyxl
from reports.document.report import Report
from reports.exports.numbers import export_tables
from reports.inputs.load import load_toml
from reports.inputs.solve_input import solved
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from reports.workbook.write import workbook_bytes

given = load_toml(sys.argv[1]).model
model = build_model(given)
values, solution = evaluate_model(model), solved(given)
sheet = openpyxl.load_workbook(io.BytesIO(workbook_bytes(model, values)))["Энергия"]
stated = values.columns["kinetic"]["Ek_J"], solution.columns["kinetic"]["Ek_J"]
print(json.dumps({
    "formulas": sum(cell.data_type == "f" for row in sheet.iter_rows() for cell in row),
    "charts": len(sheet._charts),
    "apart": float(np.abs(stated[0] - stated[1]).max()),
    "greatest": [values.scalars["Ek_max"], solution.scalars["Ek_max"], float(stated[0].max())],
    "exported": "kinetic" in export_tables(solution),
    "page": Report(model, values).page("screen"),
}))
"""


@pytest.fixture(scope="module")
def changed(tmp_path_factory):
    """A copy of the program with the changes of the page."""
    copy = tmp_path_factory.mktemp("program")
    for room in ("kshm", "reports", "templates"):
        shutil.copytree(ROOT / room, copy / room)  # with what is compiled
    change = "".join(blocks(DOCS / "new-module.md", "diff"))
    applied = subprocess.run(
        ["git", "apply", "-"],
        cwd=copy, input=change, text=True, capture_output=True, check=False,
        env=os.environ | {"GIT_CEILING_DIRECTORIES": str(copy.parent)},
    )  # fmt: skip
    assert applied.returncode == 0, applied.stderr
    return copy, re.findall(r"^\+\+\+ b/(\S+)", change, re.MULTILINE)


def test_a_module_touches_a_handful_of_files(changed):
    copy, files = changed
    assert len(set(files)) == len(files) <= MOST
    assert all((copy / file).exists() for file in files)


def test_it_is_in_the_workbook_the_report_and_the_results(changed, tmp_path):
    text = (ROOT / "samples" / "ecoboost-10.toml").read_text(encoding="utf-8")
    sample = tmp_path / "engine.toml"  # an offset has a term of its own
    assert "step_deg = 10" in text and "[report]\n" in text
    text = text.replace("[report]\n", '[report]\nchapters = ["own"]\n')
    sample.write_text(text.replace("step_deg = 10", "step_deg = 15"), encoding="utf-8")
    message = subprocess.run(
        [sys.executable, "-P", "-c", TRY, str(sample)],
        env=os.environ | {"PYTHONPATH": str(changed[0])},
        text=True, capture_output=True, check=True,
    )  # fmt: skip
    built = json.loads(message.stdout)
    assert built["formulas"] > 30 and built["charts"] == 1 and built["exported"]
    assert built["greatest"][0] == pytest.approx(built["greatest"][1]) == built["greatest"][2]
    assert built["apart"] < 1e-9 * built["greatest"][0]
    assert "Кинетическая энергия</h1>" in built["page"]
    assert "Кинетическая энергия поступательных масс цилиндра</figcaption>" in built["page"]
    assert "наибольшая кинетическая энергия поступательных масс цилиндра" in built["page"]
