"""What the commands share: exit codes, Russian help, options, loading of an input."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from reports.inputs.load import Loaded

DONE, LOOK, BAD, MISSING = 0, 1, 2, 3
HELP = {"help_option_names": ["-h", "--help"]}

Command = Callable[..., int]


def file_argument(text: str = "INPUT") -> Callable[[Command], Command]:
    """The file that a command reads."""
    return click.argument("source", metavar=text, type=click.Path(path_type=Path))


# `reports.cli` reads it before the commands do.
verbose_option = click.option(
    "-v", "--verbose", is_flag=True, expose_value=False, help="Показать подробности ошибки."
)


dask_option = click.option(
    "--dask", metavar="ADDRESS", help="Считать на кластере Dask, tcp://host:8786."
)


def path_option(*names: str, **more: Any) -> Callable[[Command], Command]:  # noqa: ANN401
    """An option whose value is a path."""
    return click.option(*names, type=click.Path(path_type=Path), **more)


class DecimalNumber(click.ParamType):  # type: ignore[type-arg]
    """A number with a decimal point or comma."""

    name = "float"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Read it."""
        try:
            return float(str(value).replace(",", ".", 1))
        except ValueError:
            self.fail(f"'{value}' is not a valid float", param, ctx)


def number_option(name: str, key: str, unit: str, text: str) -> Callable[[Command], Command]:
    """An option whose value is a number; ``unit`` is shown in its place."""
    return click.option(name, key, type=DecimalNumber(), metavar=unit, help=text)


def load(source: Path) -> Loaded:
    """A checked input; its warnings are told."""
    from reports.exports.build import load_input

    loaded = load_input(source)
    tell(loaded, source)
    return loaded


def tell(loaded: Loaded, source: Path) -> None:
    """What is odd about an input, and what it explains itself."""
    from reports.exports.build import remarks_of

    for line in (*remarks_of(loaded), *(f"{source.name}: {note}" for note in notes_of(loaded))):
        click.echo(line, err=True)


def tell_written(target: Path, more: str = "") -> None:
    """Name a file that is there now; where it is the output itself, beside the output."""
    from reports.shared.files import is_output

    click.echo(f"{target}{more}", err=is_output(target))


def tell_solved(loaded: Loaded, *, aside: bool = False) -> bool:
    """What the solution shows, ``aside`` of the output; whether it needs a person's eye."""
    from reports.inputs.checks.flywheel import solution_remarks
    from reports.inputs.checks.power import power_problems

    power = (f"Внимание: {problem.line()}" for problem in power_problems(loaded.model))
    lines = (*power, *solution_remarks(loaded.model))
    for line in lines:
        click.echo(line, err=aside)
    return any(line.startswith("Внимание") for line in lines)


def notes_of(loaded: Loaded) -> tuple[str, ...]:
    """What is not calculated for an input and why."""
    geometry = loaded.model.geometry
    if not getattr(geometry, "is_offset", False) and loaded.model.articulated is None:
        return ()  # without loading the tables
    from reports.tables.left_out import left_out_note

    return (left_out_note(loaded.model),)
