"""On a Dask cluster the results are those of one machine, even when a worker dies."""

from __future__ import annotations

import io
import json
import os
import re
import signal
import subprocess
import sys
import time
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from reports.cli import main
from reports.grading.batch import grade as grade_module
from reports.grading.batch import pool as cluster_module
from reports.grading.batch.grade import GradeSetup as GradeOptions
from reports.grading.batch.grade import grade
from reports.shared import parallel_map
from reports.shared.errors import KshmError
from reports.shared.resources import samples_dir
from reports.studies import sweep as run_module
from reports.studies.journal import journal_path
from reports.studies.sweep import SweepOptions, sweep
from reports.web.app import Settings, create_app
from tests.grading import classroom
from tests.grading.fill import filled_book
from tests.web.conftest import Page
from tests.web.test_files import made

BASE = samples_dir() / "gots-diesel.toml"
SMALL = samples_dir() / "two-stroke.toml"  # the smallest book
VARY = ("regime.speed_rpm=1500:4400:10", "geometry.bore_mm=84:92:6")


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """Two workers, each a process of its own; a dead one is started again."""
    distributed = pytest.importorskip("distributed")  # a second, which the quick tests spare
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None,
        silence_logs=50,
    ) as built:  # fmt: skip
        yield built


def killer(cluster: Any) -> tuple[Callable[..., Iterator[Any]], list[int]]:
    """``in_order`` that kills a worker while most of the work is still to be done."""
    victim = min(worker.pid for worker in cluster.workers.values())
    killed: list[int] = []

    def killing(*given: Any, **more: Any) -> Iterator[Any]:
        for result in parallel_map.in_order(*given, **more):
            if not killed:
                os.kill(victim, signal.SIGKILL)
                killed.append(victim)
            yield result

    return killing, killed


def gone(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return True
    return False


def test_a_study_survives_a_killed_worker_byte_for_byte(
    cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    killing, killed = killer(cluster)
    monkeypatch.setattr(run_module, "in_order", killing)
    options = SweepOptions(chunk=2, dask=cluster.scheduler_address)
    far, near = tmp_path / "far.parquet", tmp_path / "near.parquet"
    assert sweep(BASE, VARY, far, options=options).failed == 0
    monkeypatch.undo()
    sweep(BASE, VARY, near, options=SweepOptions(chunk=2, jobs=1))
    assert far.read_bytes() == near.read_bytes()
    assert len(killed) == 1
    assert gone(killed[0])


def share_done(part: Path) -> float:
    """How much of a study its file of finished rows holds."""
    if not part.exists() or b"\n" not in (data := part.read_bytes()):
        return 0.0
    head = json.loads(data.partition(b"\n")[0])
    return len(data) / (8 * head["rows"] * len(head["quantities"]))


def test_a_study_killed_at_a_third_goes_on_byte_for_byte(cluster: Any, tmp_path: Path) -> None:
    """``kill -9`` of the command, not of a worker; the cluster lives on."""
    vary = ("regime.speed_rpm=1500:4400:60", "crankshaft.webs.*.counterweight_kg=-0.1:1.5:40")
    far, near = tmp_path / "far.parquet", tmp_path / "near.parquet"
    words = [sys.executable, "-m", "reports", "sweep", BASE, "-o", far]
    words += ["--dask", cluster.scheduler_address]
    words += [word for text in vary for word in ("--vary", text)]
    process = subprocess.Popen(list(map(str, words)), stderr=subprocess.DEVNULL)
    while process.poll() is None and share_done(journal_path(far)) < 0.3:
        time.sleep(0.002)
    process.kill()
    process.wait()
    assert 0.3 <= share_done(journal_path(far)) < 1 and not far.exists()
    options = SweepOptions(dask=cluster.scheduler_address, resume=True)
    again = sweep(BASE, vary, far, options=options)
    whole = sweep(BASE, vary, near, options=SweepOptions(jobs=1))
    assert (again.points, again.failed) == (whole.points, whole.failed) and again.failed
    assert far.read_bytes() == near.read_bytes()
    assert [path.name for path in tmp_path.glob("far*")] == ["far.parquet"]


def tree(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


def test_grading_survives_a_killed_worker_byte_for_byte(
    cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    classroom.register()
    books = tmp_path / "books"
    books.mkdir()
    right = filled_book(classroom.handout(1), classroom.assignment(1))
    for number, data in enumerate((right, b"not a workbook", right[:3000])):
        (books / f"{number}.xlsx").write_bytes(data)
    issued, secret = classroom.folder() / "issued", classroom.folder() / "secret.key"
    killing, killed = killer(cluster)
    monkeypatch.setattr(cluster_module, "in_order", killing)
    monkeypatch.setattr(cluster_module, "PART", 1)
    monkeypatch.setattr(grade_module, "grade_all", classroom.graded_here)
    for name, options in (
        ("far", GradeOptions(dask=cluster.scheduler_address)),
        ("near", GradeOptions()),
    ):
        grade(issued, books, tmp_path / name, secret_file=secret, options=options)
    assert tree(tmp_path / "far") == tree(tmp_path / "near")
    assert len(list((tmp_path / "far" / "pages").iterdir())) == 3
    assert len(killed) == 1
    assert gone(killed[0])


def test_reports_are_built_on_the_cluster_byte_for_byte(cluster: Any, tmp_path: Path) -> None:
    text = SMALL.read_text(encoding="utf-8").replace("step_deg = 10", "step_deg = 15")
    sources = [tmp_path / f"{name}.toml" for name in "ab"]
    for source in sources:
        source.write_text(text, encoding="utf-8")
    arguments = ["build", *map(str, sources), "--only", "xlsx"]
    for name, more in (("far", ["--dask", cluster.scheduler_address]), ("near", [])):
        with pytest.raises(SystemExit) as stop:
            main([*arguments, "-o", str(tmp_path / name), *more])
        assert stop.value.code == 0
    assert tree(tmp_path / "far") == tree(tmp_path / "near")
    assert sorted(tree(tmp_path / "far")) == ["a.xlsx", "b.xlsx"]


def told(book: bytes) -> tuple[str, list[float]]:
    """A workbook's parts without the values of its cells, and those values."""
    archive = zipfile.ZipFile(io.BytesIO(book))
    text = "".join(archive.read(name).decode() for name in archive.namelist() if "xml" in name)
    value = re.compile(r"<(v|c:v)>(-?[0-9.]+(?:[eE][-+]?[0-9]+)?)</\1>")
    return value.sub("", text), [float(matches) for _, matches in value.findall(text)]


def test_the_page_s_files_are_built_on_the_cluster(cluster: Any, tmp_path: Path) -> None:
    def calculated() -> set[str]:
        return {event[0] for event in cluster.scheduler.transition_log if event[2] == "memory"}

    before = calculated()
    settings = Settings(tmp_path, per_s=1e6, workers=1, dask=cluster.scheduler_address)
    with TestClient(create_app(settings), base_url="http://localhost") as client:
        page = Page(client)
        job, _ = made(page, raw=page.sample(SMALL.stem), kind="xlsx")
        far = client.get(f"/api/files/{job}/engine.xlsx").content
    given = str(tmp_path / "jobs" / job / "engine.toml")
    with pytest.raises(SystemExit):
        main(["build", given, "--only", "xlsx", "-o", str(tmp_path / "near")])
    near = (tmp_path / "near" / "engine.xlsx").read_bytes()
    assert len(calculated() - before) == 1  # the cluster made the one, this process the other
    (far_text, far_values), (near_text, near_values) = map(told, (far, near))
    same = far_text == near_text  # to show where they differ would take minutes
    assert same
    np.testing.assert_allclose(far_values, near_values, rtol=1e-9, atol=1e-9)  # last digits differ


def test_inputs_whose_results_would_be_one_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "gots-diesel.toml"
    other.write_bytes(BASE.read_bytes())
    with pytest.raises(SystemExit) as stop:
        main(["build", str(BASE), str(other), "-o", str(tmp_path / "out")])
    assert stop.value.code == 2
    assert "два файла с этим именем" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_cluster_that_is_not_there_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parallel_map, "_CONNECT_S", 0.5)
    with pytest.raises(KshmError, match="планировщик не отвечает"):
        sweep(BASE, VARY, tmp_path / "a.csv", options=SweepOptions(dask="tcp://127.0.0.1:9"))
    assert list(tmp_path.iterdir()) == []
