"""Many commands at the same time in one folder."""

from __future__ import annotations

import pytest

from reports.shared import files
from tests.cover import examples
from tests.robustness.command import leftovers, small_input, started

COUNT = examples(6, 20)


def test_many_commands_in_one_folder(tmp_path):
    out, alone = tmp_path / "out", tmp_path / "alone"
    sources = [small_input(tmp_path, name) for name in ("a", "b")]
    first = started("solve", sources[0], "--csv", alone, "--json", alone / "a.json")
    _, message = first.communicate()  # of the coarse grid
    assert first.returncode == 0 and message.startswith("Шаг таблиц") and message.count("\n") == 1
    # All write the same tables; half of them the same JSON as well.
    running = [
        started(
            "solve", sources[i % 2], "--csv", out, "--json", out / f"{sources[i % 2].stem}.json"
        )
        for i in range(COUNT)
    ]
    for process in running:
        _, error = process.communicate()
        assert process.returncode == 0, error
        assert error == message
    assert leftovers(out) == []
    names = {path.name for path in alone.iterdir()}
    assert {path.name for path in out.iterdir()} == names | {"b.json"}
    for name in names:
        assert (out / name).read_bytes() == (alone / name).read_bytes()


def test_what_another_has_locked_by_then_is_removed_under_a_lock(tmp_path, monkeypatch):
    """Between the look and the removal a writer took the file for its own, and lost it."""
    fcntl = pytest.importorskip("fcntl")
    left = tmp_path / ".kshm-left.csv"
    left.touch()
    free = []

    def removed(path):
        with path.open("rb") as stream:
            try:
                fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                path.unlink()
            else:
                free.append(path)

    monkeypatch.setattr(files, "_remove", removed)
    files._remove_abandoned(tmp_path)
    assert not free and not left.exists()
