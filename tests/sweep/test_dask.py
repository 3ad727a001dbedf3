"""On a Dask cluster the results are those of one machine, even when a worker dies."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from reports import ordered
from reports.errors import KshmError
from reports.resources import samples_dir
from reports.sweep import run as run_module
from reports.sweep.run import Options, sweep

distributed = pytest.importorskip("distributed")

BASE = samples_dir() / "gots-diesel.toml"
VARY = ("regime.speed_rpm=1500:4400:10", "geometry.bore_mm=84:92:6")


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """Two workers, each a process of its own; a dead one is started again."""
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None,
        silence_logs=50,
    ) as made:  # fmt: skip
        yield made


def pids(cluster: Any) -> set[int]:
    return {worker.pid for worker in cluster.workers.values()}


def test_a_killed_worker_changes_no_byte(
    cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = pids(cluster)
    killed: list[int] = []

    def killing(*given: Any, **more: Any) -> Iterator[Any]:
        for number, result in enumerate(ordered.in_order(*given, **more)):
            if number == 2:
                killed.append(min(before))
                os.kill(killed[0], signal.SIGKILL)
            yield result

    monkeypatch.setattr(run_module, "in_order", killing)
    options = Options(chunk=2, dask=cluster.scheduler_address)
    far, near = tmp_path / "far.parquet", tmp_path / "near.parquet"
    assert sweep(BASE, VARY, far, options=options).failed == 0
    monkeypatch.undo()
    sweep(BASE, VARY, near, options=Options(chunk=2, jobs=1))
    assert far.read_bytes() == near.read_bytes()
    assert killed
    with pytest.raises(ProcessLookupError):
        os.kill(killed[0], 0)


def test_a_cluster_that_is_not_there_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ordered, "_CONNECT_S", 0.5)
    with pytest.raises(KshmError, match="планировщик не отвечает"):
        sweep(BASE, VARY, tmp_path / "a.csv", options=Options(dask="tcp://127.0.0.1:9"))
    assert list(tmp_path.iterdir()) == []
