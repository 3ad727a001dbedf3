"""A study that was stopped goes on: the file is that of the whole run, byte for byte."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.shared.errors import InputError
from reports.studies import sweep as run_module
from reports.studies.journal import journal_path
from reports.studies.plan import solved
from reports.studies.sweep import SweepOptions, sweep
from tests.conftest import ROOT

BASE = ROOT / "samples" / "gots-diesel.toml"
VARY = ["geometry.bore_mm=80:95:60", "crankshaft.webs.*.counterweight_kg=-0.1:1.5:100"]
ROWS = 6000


def whole(target: Path) -> bytes:
    sweep(BASE, VARY, target, options=SweepOptions(jobs=1))
    return target.read_bytes()


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
@pytest.mark.parametrize("stop", ["SIGKILL", "SIGINT"])
def test_a_killed_study_goes_on(tmp_path: Path, suffix: str, stop: str) -> None:
    target = tmp_path / f"study{suffix}"
    words = [sys.executable, "-m", "reports", "sweep", BASE, "-o", target, "--jobs", "1"]
    words += [word for text in VARY for word in ("--vary", text)]
    process = subprocess.Popen(list(map(str, words)), cwd=ROOT, stderr=subprocess.PIPE, text=True)
    kept = journal_path(target)
    while process.poll() is None and not (kept.exists() and kept.stat().st_size > 400_000):
        time.sleep(0.01)
    process.send_signal(getattr(signal, stop))
    said = process.communicate()[1]
    assert kept.exists() and not target.exists()
    if stop == "SIGINT":
        assert f"из {ROWS}; продолжит та же команда с ключом --resume" in said
    with kept.open("r+b") as stream:  # the last record is torn
        stream.truncate(kept.stat().st_size - 5)
    assert b'"vary": {"geometry.bore_mm": [60, "80", "95"]' in kept.read_bytes()[:4000]
    again = sweep(BASE, VARY, target, options=SweepOptions(jobs=2, resume=True))
    assert again.points == ROWS and again.failed
    assert "crankshaft.webs.*.counterweight_kg = −0,1: " in again.first_error
    assert target.read_bytes() == whole(tmp_path / f"whole{suffix}")
    assert not kept.exists() and len([*tmp_path.iterdir()]) == 2


def stopped(monkeypatch: pytest.MonkeyPatch, target: Path, chunks: int, **options: object) -> list:
    """Rows that a study solves before it is stopped."""
    done: list = []

    def once(task):
        if len(done) >= chunks:
            raise KeyboardInterrupt
        done.append(task.rows)
        return solved(task)

    monkeypatch.setattr(run_module, "solved", once)
    try:
        sweep(BASE, VARY[:1], target, options=SweepOptions(jobs=1, chunk=10, **options))
    except KeyboardInterrupt:
        assert journal_path(target).exists()
    return done


def test_what_is_done_is_not_done_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "study.csv"
    first = stopped(monkeypatch, target, 2)
    second = stopped(monkeypatch, target, 3, resume=True)
    third = stopped(monkeypatch, target, 9, resume=True)
    rows = [row for chunk in (*first, *second, *third) for row in chunk]
    assert len(rows) == len(set(rows)) == 60
    assert [len(first), len(second), len(third)] == [2, 3, 1]
    assert target.exists() and not journal_path(target).exists()


def test_a_study_of_something_else_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "study.csv"
    stopped(monkeypatch, target, 2)
    monkeypatch.undo()
    words = ["sweep", str(BASE), "-o", str(target), "--vary", "geometry.bore_mm=80:96:60"]
    done = CliRunner().invoke(main, words)
    assert done.exit_code == 2
    assert "незаконченное исследование; продолжите его ключом --resume или удалите" in done.output
    done = CliRunner().invoke(main, [*words, "--resume"])
    assert done.exit_code == 2 and "начато с другими данными, ключами" in done.output
    options = SweepOptions(jobs=1, chunk=20, resume=True)
    with pytest.raises(InputError, match="начато другими порциями"):
        sweep(BASE, VARY[:1], target, options=options)
    journal_path(target).write_bytes(b"1\n")
    with pytest.raises(InputError, match="это не начатое исследование"):
        sweep(BASE, VARY[:1], target, options=options)
