"""The command that looks for inputs: those of the least result, or the one that makes a result."""

from __future__ import annotations

import difflib
import math
from pathlib import Path
from typing import TYPE_CHECKING

import click

from reports.commands.common import (
    DONE,
    HELP,
    LOOK,
    RussianCommand,
    file_argument,
    path_option,
    tell_next,
    tell_written,
    verbose_option,
)
from reports.shared.errors import NO_LIMITS, InputError, KshmError, Problem, SystemPartMissing

if TYPE_CHECKING:
    from kshm.engine.engine import Engine
    from kshm.results.search import Optimum
    from reports.studies.plan import Axis

_INSTALL = 'pip install "kshm[optimise]"'
_EXAMPLE = "пример: --vary geometry.bore_mm=84:92"


@click.command(cls=RussianCommand, context_settings=HELP)
@file_argument("БАЗА")
@click.option("--vary", multiple=True, required=True, metavar="КЛЮЧ=ОТ:ДО",
              help="Ключ файла и его пределы; от одного до трёх, с --reach один.")  # fmt: skip
@click.option("--least", metavar="ИМЯ", help="Величина, которая должна быть наименьшей.")
@click.option("--most", metavar="ИМЯ", help="Величина, которая должна быть наибольшей.")
@click.option("--reach", metavar="ИМЯ=ЧИСЛО", help="Величина и значение, которое ей нужно.")
@path_option("-o", "--output", "target", metavar="ФАЙЛ",
             help="Записать файл исходных данных с найденными значениями.")  # fmt: skip
@verbose_option
def optimise(
    source: Path, vary: tuple[str, ...], least: str | None, most: str | None, reach: str | None,
    target: Path | None,
) -> int:  # fmt: skip
    """Найти исходные данные, при которых величина наименьшая, наибольшая или равна заданной.

    Величина — как у команды kshm sweep: итог M_mean или P4_1.N_MPa.max.
    """
    from reports.inputs.units import number_text
    from reports.shared.files import write_text

    aims = [aim for aim in (least, most, reach) if aim is not None]
    if len(aims) != 1:
        raise InputError(Problem("", "нужен один из ключей --least, --most и --reach"))
    axes, solution = _found(source, vary, least, most, reach)
    for axis in axes:
        unit = f" {axis.unit}" if axis.unit else ""
        value = number_text(float(f"{solution.values[axis.key]:.8g}"))
        title = "" if "*" in axis.key else f" ({axis.title})"
        click.echo(f"{axis.key} = {value}{unit}{title}")
    name = aims[0].partition("=")[0]
    click.echo(
        f"{name} = {number_text(float(f'{solution.result:.8g}'))}; решено: {solution.solved}"
    )
    if target is not None:
        from reports.python.api import dump

        write_text(target, dump(solution.engine))
        tell_written(target)
        tell_next("build", target)
    return DONE


def _found(
    source: Path, vary: tuple[str, ...], least: str | None, most: str | None, reach: str | None
) -> tuple[tuple[Axis, ...], Optimum]:
    from kshm.results.search import MAX_NAMES, solve_for
    from kshm.results.search import optimise as least_of
    from reports.python.api import load, loaded_of
    from reports.shared.progress import Progress
    from reports.studies.plan import make_plan

    _, loaded = loaded_of(source)
    axes = make_plan(loaded.model, source.name, list(map(_two_points, vary)), pairwise=False).axes
    limits = {axis.key: (float(axis.values[0]), float(axis.values[-1])) for axis in axes}
    for key, (low, high) in limits.items():
        if low >= high:
            raise InputError(Problem(f"--vary {key}", "пределы не возрастают", _EXAMPLE))
    most_names = 1 if reach is not None else MAX_NAMES
    if len(limits) > most_names:
        problem = f"ключей {len(limits)}, а можно до {most_names}"
        raise InputError(Problem("--vary", problem, "остальные задайте в файле"))
    engine = load(source, warn=False)
    try:
        with Progress("Поиск"):
            if reach is not None:
                name, value = _aim(reach)
                _check(engine, name)
                (key,) = limits
                return axes, solve_for(engine, key, name, value, between=limits[key])
            name = least or most or ""
            _check(engine, name)
            return axes, least_of(engine, limits, name, most=most is not None)
    except InputError as error:
        raise InputError(_in_words(error.problems[0])) from None
    except KshmError as error:
        if "scipy" not in str(error):
            raise
        raise SystemPartMissing("пакет scipy", _INSTALL) from None


def _check(engine: Engine, quantity: str) -> None:
    """Refuse a quantity that there is not, in the words of the command."""
    from kshm.chain.solve import solve_batch
    from kshm.results.chosen import PARTS
    from kshm.results.study import cycle_of
    from reports.studies.quantities import choose

    name, _, part = quantity.rpartition(".")
    is_part = part in PARTS and "." in name
    chosen = choose(solve_batch([engine]), [name if is_part else quantity], cycle_of(engine))
    if not is_part and len(chosen.names) > 1:
        problem, hint = "это несколько чисел", f"назовите одно: {', '.join(chosen.names[:6])}"
        raise InputError(Problem(quantity, problem, hint))


def _two_points(text: str) -> str:
    """Return a range as a study has it."""
    return f"{text}:2" if text.partition("=")[2].count(":") == 1 else text


def _aim(text: str) -> tuple[str, float]:
    name, _, number = text.partition("=")
    try:
        return name, float(number.replace(",", "."))
    except ValueError:
        problem = "нужно ИМЯ=ЧИСЛО"
        raise InputError(
            Problem(f"--reach {text}", problem, "пример: --reach delta_speed=0.02")
        ) from None


def _in_words(problem: Problem) -> Problem:
    from reports.inputs.units import number_text

    if problem.limits == NO_LIMITS:
        _, _, reason = problem.what.partition(": ")
        known = problem.what.startswith("no engine")
        return Problem("", f"в этих пределах нет годного двигателя: {reason}") if known else problem
    low, high = (number_text(float(f"{each:.6g}")) for each in problem.limits if each is not None)
    value = number_text(float(problem.value))
    hint = f"величина меняется от {low} до {high}; раздвиньте пределы"
    return Problem(problem.where, f"в этих пределах не достигает {value}", hint)


def scatter(
    source: Path, tolerances: tuple[str, ...], quantities: tuple[str, ...], target: Path,
    samples: int, jobs: int,
) -> int:  # fmt: skip
    """Write the bands of results within tolerances; return the exit code."""
    from kshm.results.study import MAIN
    from kshm.results.tolerance import MAX_SAMPLES, MIN_SAMPLES, tolerance
    from reports.python.api import load
    from reports.shared.files import refuse_own
    from reports.shared.progress import Progress
    from reports.studies.tolerance import check_suffix, write

    check_suffix(target)
    refuse_own([target], [source])
    if not MIN_SAMPLES <= samples <= MAX_SAMPLES:
        raise InputError(Problem("--samples", f"нужно от {MIN_SAMPLES} до {MAX_SAMPLES}"))
    engine = load(source, warn=False)
    spans = dict(_tolerance(text, engine) for text in tolerances)
    names = quantities or MAIN
    _check(engine, names[0])
    with Progress("Разброс") as progress:

        def tell(done: int, total: int) -> None:
            progress.step(f"Разброс: {done} из {total}")

        try:
            bands = tolerance(engine, spans, quantities=names, samples=samples, jobs=jobs,
                              progress=tell)  # fmt: skip
        except InputError as error:
            raise InputError(_in_words(error.problems[0])) from None
        except KshmError as error:
            raise SystemPartMissing("пакет scipy", _INSTALL) from error
    write(bands, engine, names, target)
    tell_written(target, f": двигателей {samples}")
    if bands.failed:
        click.echo(f"Без результата: {bands.failed}; уменьшите допуски", err=True)
        return LOOK
    return DONE


def _tolerance(text: str, engine: Engine) -> tuple[str, float]:
    key, _, number = text.partition("=")
    where, source = f"--tolerance {text}", engine.source
    try:
        half = float(number.replace(",", "."))
    except ValueError:
        half = 0.0
    if not 0 < half < math.inf:
        problem, hint = "нужно КЛЮЧ=ДОПУСК, число больше нуля", "пример: geometry.bore_mm=0.02"
        raise InputError(Problem(where, problem, hint))
    if source is None or not source.find(key):
        close = difflib.get_close_matches(key, source.names() if source else (), n=3, cutoff=0.5)
        hint = f"похожи: {', '.join(close)}" if close else "ключи смотрите в файле"
        raise InputError(Problem(where, f"в файле нет ключа {key}", hint))
    return key, half
