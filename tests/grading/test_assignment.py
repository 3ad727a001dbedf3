"""What is asked and paid is what a person would calculate: no marks, remarks and drawings."""

from __future__ import annotations

from reports.grading.issuing.assignment import Assignment, assignment_of
from reports.grading.issuing.handout import fill_cells
from reports.grading.issuing.rubric import rubric_of
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.tables.registry import build_model
from reports.workbook.layout import Layout
from tests.conftest import sample


def asked(name: str, *fill: str, **more: object) -> Assignment:
    raw = to_mapping(sample(name)) | more
    raw["calculation"]["step_deg"] = 30
    model = build_model(load_mapping(raw, source="test").model)
    return assignment_of(model, rubric_of({"work": {"fill": fill}}, "rubric"))


def test_marks_of_the_bearings_are_not_asked():
    built = asked("d-240-bearings", "oil*", "material*", "checks", "specific_masses")
    items = {item.id for item in built.items}
    # Reports of the program on itself, constants of a catalogue, a circle for a drawing.
    assert not items & {
        "oil_orbits.oil_changed", "oil_fresh.oil_fresh", "oil_grades.oil_grade_40",
        "oil_grades.oil_picked", "oil_orbit_0.oil_circle_x", "oil_orbit_0_box.oil_box",
        "materials.mat_tensile_MPa", "checks.check_lam", "specific_masses.area_piston_fits",
    }  # fmt: skip
    assert items >= {"oil_cases.oil_gap1_mm", "oil_holes.oil_load_deg", "oil_list.oil_vogel",
                     "checks.value_lam", "specific_masses.area_piston"}  # fmt: skip
    # None is worth more than a formula from which a whole sheet follows.
    assert max(built.points.values()) < 8
    # A value picked from what is given is a copy, not a formula.
    assert built.points["oil_holes.oil_film1_deg"] < built.points["oil_holes.oil_load_deg"] / 3
    # What is not asked stands in the book: a number, or a formula of the student's own.
    layout = Layout.of(built.model)
    nodes = {node for block in built.fill for node in fill_cells(block, layout)}
    for node in nodes - built.fill_nodes:
        assert built.states[node] != "hidden", node


def test_constants_of_materials_are_not_asked():
    """Of a steel that the input data name, a table tells them: they stand in the book."""
    built = asked(
        "two-stroke", "geometry", "masses", "P4_1", "strength*", strength={"kind": "petrol"}
    )
    blocks = {item.block for item in built.items}
    assert "strength_materials" not in blocks and "strength_eye" in blocks
    assert built.states["rod_tensile"] == built.states["bolt_expansion"] == "number"
    # What is calculated of such constants alone is a formula all the same.
    fuel = asked("cycle-petrol", "cycle_fuel")
    assert "cycle_fuel.cyc_L0" in {item.id for item in fuel.items}


def test_columns_of_the_textbook_stay_asked():
    built = asked("gots-diesel", "geometry", "masses", "P3_*", "P4_*")
    assert len(built.items) == 131
    # Helpers from which asked columns follow, and one that only closes the table.
    assert {"P4_1.beta_rad", "P4_1.j_m_s2", "P4_1.Mopr_Nm"} <= {item.id for item in built.items}
    assert 2.3 < built.points["geometry.omega"] < 2.5
