"""What ``kshm sweep`` does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from kshm.chain.solve import chunk_size, solve_batch
from reports.exports.build import load_input
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.aside import processors
from reports.shared.errors import KshmError, OutputError
from reports.shared.files import atomic_path, reason, refuse_own
from reports.shared.ordered import in_order
from reports.shared.progress import Progress
from reports.studies.files import SUFFIXES, sink
from reports.studies.plan import make_plan
from reports.studies.points import solved, tasks
from reports.studies.quantities import choose

# Starting processes takes longer than that many combinations.
_FEW = 4000


@dataclass(frozen=True, slots=True)
class Options:
    """How a study runs; the results do not depend on it."""

    jobs: int = 0  # 0: all cores
    dask: str | None = None
    chunk: int | None = None  # combinations at a time


@dataclass(frozen=True, slots=True)
class Studied:
    """How many combinations a study had and how many have no result."""

    points: int
    failed: int
    first_error: str = ""


def sweep(
    source: Path,
    vary: Sequence[str],
    target: Path,
    *,
    quantities: Sequence[str] = (),
    pairwise: bool = False,
    options: Options | None = None,
) -> Studied:
    """Vary keys of a base file and write the results to ``target``, whole or not at all.

    Raises:
        InputError: the base or what is asked for is wrong.
        OutputError: the file cannot be written.
    """
    options = options or Options()
    suffix = target.suffix.lower()
    if suffix not in SUFFIXES:
        raise KshmError(f"{target}: нужно окончание {', '.join(SUFFIXES)}; укажите его в ключе -o")
    loaded = load_input(source)
    refuse_own([target], [source, *loaded.beside])
    model = loaded.model
    plan = make_plan(model, source.name, vary, pairwise=pairwise)
    engine, cycle = engine_and_cycle(model)
    wanted = choose(solve_batch([engine]), quantities, cycle)
    size = options.chunk or chunk_size(engine)
    jobs = options.jobs or processors()
    if plan.count <= _FEW and not options.jobs:
        jobs = 1
    done = failed = 0
    first_error = ""
    with Progress("Исследование") as progress, atomic_path(target) as temporary:
        try:
            with sink(temporary, suffix, plan, wanted) as out:
                work = tasks(plan, wanted, size)
                for chunk in in_order(solved, work, jobs=jobs, dask=options.dask):
                    out.write(chunk)
                    done += len(chunk.rows)
                    errors = [error for error in chunk.errors if error]
                    failed += len(errors)
                    first_error = first_error or next(iter(errors), "")
                    progress.step(f"Исследование: {done} из {plan.count}")
        except OSError as error:
            raise OutputError(f"{target}: не записать: {reason(error)}") from None
    return Studied(done, failed, first_error)
