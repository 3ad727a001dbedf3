"""The programmer's door: import, one engine, studies, searches; a study that goes on."""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import kshm
import reports
from kshm.engine.revised import engine_maker
from kshm.results.study import Study
from reports.shared.resources import samples_dir
from reports.studies import sweep as run_module
from reports.studies.plan import Chunk, SweepTask, solved
from reports.studies.sweep import SweepOptions
from reports.studies.sweep import sweep as run_sweep
from tests.bench._figure import Figure, interleaved, median, ratio
from tests.bench._process import median as process

BASE = samples_dir() / "gots-diesel.toml"
VARY = ("geometry.bore_mm=84:92:200", "masses.reciprocating_kg=1.8:2.6:50")
ROWS = 10_000
WEBS = "crankshaft.webs.*.counterweight_kg"


def figures() -> Iterator[Figure]:
    """Figures."""
    yield from _imports()
    engine = reports.load("gots-diesel", warn=False)
    times = interleaved(
        {
            "solve": lambda: kshm.solve(engine),
            "scalars": lambda: kshm.solve(engine).scalars,
            "tables": lambda: kshm.solve(engine).tables,
            "load": lambda: reports.load("gots-diesel", warn=False),
            "with": lambda: engine.with_(bore_mm=90),
        },
        rounds=51,
    )
    for name, label in (
        ("solve", "solve"), ("scalars", "solve и все итоги"), ("tables", "solve и все таблицы"),
        ("load", "reports.load"), ("with", "engine.with_"),
    ):  # fmt: skip
        note = "цель 0,57" if name == "solve" else ""
        yield Figure(label, 1e3 * median(times[name]), "мс", note)
    yield from _studies(engine)
    yield from _resumed()


def _imports() -> Iterator[Figure]:
    bare = process([sys.executable, "-c", ""], times=9)
    for words, target in (("import kshm", "цель 0,04 сверх пустого Python"),
                          ("import kshm; kshm.solve", ""), ("import reports", "")):  # fmt: skip
        cost = process([sys.executable, "-c", words], times=9)
        yield Figure(f"{words}, сверх пустого Python", cost.wall - bare.wall, "с", target)


def _studies(engine: kshm.Engine) -> Iterator[Figure]:
    """Studies and searches; what an engine of each costs."""
    bores = [84 + 0.008 * number for number in range(1000)]
    runs: dict[str, tuple[int, Callable[[], object]]] = {
        "kshm.sweep": (1000, lambda: kshm.sweep(engine, {"bore_mm": bores})),
        "kshm.tolerance": (1000, lambda: kshm.tolerance(
            engine, {"bore_mm": 0.02, "speed_rpm": 20, WEBS: 0.01})),
    }  # fmt: skip
    for name, (count, run) in runs.items():
        spent = _cpu(run)
        yield Figure(f"{name}, {count} двигателей: процессор", spent, "с",
                     f"{1e3 * spent / count:.2f} мс на двигатель")  # fmt: skip
    searches: dict[str, Callable[[], kshm.Optimum]] = {
        "kshm.solve_for": lambda: kshm.solve_for(
            engine, "speed_rpm", "c_m", 10, between=(1000, 6000)),
        "kshm.optimise по одной": lambda: kshm.optimise(engine, {WEBS: (0, 2)}, "Rmain2_mean"),
    }  # fmt: skip
    for name, search in searches.items():
        begin = time.process_time()
        count = search().solved
        spent = time.process_time() - begin
        yield Figure(f"{name}: процессор", spent, "с", f"{count} двигателей")
    study = Study.of(engine, ("bore_mm",), ["M_mean"])
    make = engine_maker(engine, ("bore_mm",))
    rows = [(bore,) for bore in bores[:20]]
    times = interleaved({
        "each": lambda: [study.solve([row]) for row in rows],
        "kept": lambda: [study.solve([row], make) for row in rows],
    })  # fmt: skip
    yield Figure("поиск: чтение базы для каждого шага / один раз", ratio(times, "each", "kept"),
                 "раз")  # fmt: skip


def _cpu(run: Callable[[], object]) -> float:
    begin = time.process_time()
    run()
    return time.process_time() - begin


def _resumed() -> Iterator[Figure]:
    """A study stopped when nine tenths are done, beside the whole: its rows are read back."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "study.csv"
        options = SweepOptions(jobs=1, chunk=100)
        whole = _cpu(lambda: run_sweep(BASE, VARY, target, options=options))
        _stop(target, options, rows=ROWS * 9 // 10)
        resumed = SweepOptions(jobs=1, chunk=100, resume=True)
        rest = _cpu(lambda: run_sweep(BASE, VARY, target, options=resumed))
    yield Figure(f"исследование {ROWS} двигателей: процессор", whole, "с")
    yield Figure("его последняя десятая после --resume: процессор", rest, "с")


def _stop(target: Path, options: SweepOptions, rows: int) -> None:
    done = 0

    def stopping(task: SweepTask) -> Chunk:
        nonlocal done
        if done >= rows:
            raise KeyboardInterrupt
        done += len(task.rows)
        return solved(task)

    run_module.solved = stopping
    try:
        run_sweep(BASE, VARY, target, options=options)
    except KeyboardInterrupt:
        pass
    finally:
        run_module.solved = solved
