"""Grading once more: all is checked before anything is written, and decisions stand throughout."""

from __future__ import annotations

import pytest

from reports.grading.batch import grade as room
from reports.shared.errors import InputError
from tests.grading import classroom
from tests.grading.test_decisions import decide_in_gradebook, run, submitted


@pytest.fixture(autouse=True)
def _by_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "grade_all", classroom.graded_here)


@pytest.mark.parametrize("where_it_stands", ["gradebook", "command", "column"])
def test_a_lower_maximum_is_refused_before_anything_is_written(
    tmp_path, monkeypatch, where_it_stands
):
    """Half-way it left tables without the decisions, and a CSV without most of the class."""
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out)
    if where_it_stands == "gradebook":
        decide_in_gradebook(where, out, 2, 90)
    else:
        what = "всё" if where_it_stands == "command" else "geometry.V_c"
        run(where, out, ("1", what, "90", "защита"))
    before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
    rubric = tmp_path / "rubric.toml"
    rubric.write_text("maximum = 50\n", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        run(where, out, rubric=rubric)
    assert "90" in str(caught.value.problems[0])
    assert {path: path.read_bytes() for path in out.rglob("*") if path.is_file()} == before


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("Никто", "всё", "5", ""), "нет такого студента"), (("1", "P9.x", "5", ""), "столбца"),
        (("1", "всё", "101", ""), "это не баллы"),
    ],
)  # fmt: skip
def test_a_wrong_word_is_refused_before_the_grading(tmp_path, words, message):
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    with pytest.raises(InputError, match=message):
        run(where, out, words)
    assert not out.exists()


def test_the_tables_of_before_stand_until_all_is_graded(tmp_path, monkeypatch):
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out, ("2", "всё", "55", "защита"))
    table = (out / "gradebook.csv").read_bytes()
    monkeypatch.setattr(room, "_EVERY_S", -1.0)
    seen = []

    def watched(*given, **options):
        for outcome in classroom.graded_here(*given, **options):
            seen.append((out / "gradebook.csv").read_bytes())
            yield outcome

    monkeypatch.setattr(room, "grade_all", watched)
    monkeypatch.setattr(room, "source_digest", lambda: "another")
    assert run(where, out)[2]["points"] == 55
    assert len(seen) == 2 and set(seen) == {table}
