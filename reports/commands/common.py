"""Exit codes, options, loading of an input, click's texts in Russian."""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from reports.inputs.load import Loaded


DONE, LOOK, BAD, MISSING = 0, 1, 2, 3
HELP = {"help_option_names": ["-h", "--help"]}

Command = Callable[..., int]
# `reports.cli` reads it before the commands do.
verbose_option = click.option(
    "-v", "--verbose", is_flag=True, expose_value=False, help="Показать подробности ошибки."
)
dask_option = click.option(
    "--dask", metavar="АДРЕС", help="Считать на кластере Dask, tcp://host:8786."
)
_USAGE = "Использование: "
_WORDS = {
    "[OPTIONS]": "[КЛЮЧИ]",
    "[COMMAND] [ARGS]...": "КОМАНДА [АРГУМЕНТЫ]...",
    "Show this message and exit.": "Показать эту справку.",
    "[required]": "[обязательно]",
    "[default: ": "[по умолчанию: ",
}
_HEADINGS = {
    "Options": "Ключи",
    "Commands": "Команды",
    "Positional arguments": "Аргументы",
    "Arguments": "Аргументы",
}
_ERRORS = (
    (r"No such command '(.*?)'", "нет команды {}"),
    (r"Missing command", "не указана команда"),
    (r"Got unexpected extra arguments? \((.*)\)", "лишний аргумент {}"),
    (r"Option '(.*?)' requires an argument", "ключу {} нужно значение"),
    (r"Option '(.*?)' requires (\d+) arguments", "ключу {} нужно значений: {}"),
    (r"Option '(.*?)' does not take a value", "ключ {} пишется без значения"),
    (r"Argument '(.*?)' takes (\d+) values", "аргументу {} нужно значений: {}"),
    (r"'(.*)' is not a valid (?:integer|float|boolean)", "нужно число, а задано «{}»"),
    (r"(.*) is not in the range (.*)<=x<=(.*)\.", "{} вне пределов от {} до {}"),
    (r"'(.*?)' is not one of (.*?)\.?$", "«{}»; допустимо: {}"),
)


def file_argument(text: str = "ФАЙЛ") -> Callable[[Command], Command]:
    """Return the file that a command reads."""
    return click.argument("source", metavar=text, type=click.Path(path_type=Path))


def path_option(*names: str, **more: Any) -> Callable[[Command], Command]:  # noqa: ANN401
    """Return an option whose value is a path."""
    return click.option(*names, type=click.Path(path_type=Path), **{"metavar": "ПУТЬ", **more})


def csv_options(command: Command) -> Command:
    """Return the options of a command that writes CSV."""
    for name, text in (
        ("--excel", "CSV для русского Excel: точка с запятой и десятичная запятая."),
        ("--units", "Вторая строка CSV — единицы."),
    ):
        command = click.option(name, is_flag=True, help=text)(command)
    return command


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
    """Return an option whose value is a number; ``unit`` is shown in its place."""
    return click.option(name, key, type=DecimalNumber(), metavar=unit, help=text)


def load(source: Path) -> Loaded:
    """Load a checked input; print its warnings."""
    from reports.exports.build import load_input

    loaded = load_input(source)
    tell(loaded, source)
    return loaded


def tell(loaded: Loaded, source: Path) -> None:
    """Print warnings and notes of an input."""
    from reports.exports.build import remarks_of

    for line in (*remarks_of(loaded), *(f"{source.name}: {note}" for note in notes_of(loaded))):
        click.echo(line, err=True)


def tell_written(target: Path, more: str = "") -> None:
    """Print the path of a written file; on stderr where the file is stdout."""
    from reports.shared.files import is_output

    click.echo(f"{target}{more}", err=is_output(target))


def tell_next(command: str, path: Path) -> None:
    """Print the command that follows, on stderr: the output stays what was asked for."""
    program = os.environ.get("KSHM_COMMAND", "kshm")  # as the script calls it that was typed
    name = f'"{path}"' if " " in str(path) else str(path)
    click.echo(f"Дальше: {program} {command} {name}", err=True)


def tell_solved(loaded: Loaded, *, aside: bool = False, every: bool = False) -> bool:
    """Print remarks on a solution, on stderr if ``aside``; return whether there is a warning.

    Failed checks are those of own books, with ``every`` those of the program too.
    """
    from reports.exports.department_chapters import failed_engine_checks
    from reports.inputs.solve_input import power_problems, solution_remarks
    from reports.shared.standing import Notice, Severity

    power, failed = power_problems(loaded.model), failed_engine_checks(loaded.model, every=every)
    lines = [*(each.line() for each in power), *(each.line() for each in failed)]
    remarks = [Notice(Severity.WARNING, line) for line in lines]
    remarks += solution_remarks(loaded.model)
    for remark in remarks:
        click.echo(remark.line, err=aside)
    return any(remark.severity is Severity.WARNING for remark in remarks)


def notes_of(loaded: Loaded) -> tuple[str, ...]:
    """Return notes on what is not calculated for an input."""
    geometry = loaded.model.geometry
    if not getattr(geometry, "is_offset", False) and loaded.model.articulated is None:
        return ()  # without loading the tables
    from reports.tables.left_out import left_out_note

    return (left_out_note(loaded.model),)


class _Formatter(click.HelpFormatter):
    """Translate help before its lines are wrapped."""

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:
        super().write_usage(prog, in_russian(args), _USAGE if prefix is None else prefix)

    def write_heading(self, heading: str) -> None:
        super().write_heading(_HEADINGS.get(heading, heading))

    def write_text(self, text: str) -> None:
        super().write_text(in_russian(text))

    def write_dl(
        self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2
    ) -> None:
        translated = [(in_russian(first), in_russian(second)) for first, second in rows]
        super().write_dl(translated, col_max, col_spacing)


class _Context(click.Context):
    formatter_class = _Formatter


class RussianCommand(click.Command):
    """A command whose help is Russian throughout."""

    context_class = _Context

    def get_short_help_str(self, limit: int = 45) -> str:
        """Return the whole first sentence; the list of commands wraps it."""
        del limit
        return " ".join((self.help or "").split("\n\n")[0].split()).removesuffix(".")

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse; give every usage error its context."""
        try:
            return super().parse_args(ctx, args)
        except click.UsageError as error:
            error.ctx = error.ctx or ctx
            raise


class RussianGroup(click.Group):
    """A group of such commands."""

    context_class = _Context
    command_class = RussianCommand


def in_russian(text: str) -> str:
    """Translate click's English words in a piece of help."""
    for english, russian in _WORDS.items():
        text = text.replace(english, russian)
    return re.sub(r"(\d+)<=x<=(\d+)", r"от \1 до \2", text)


def advice(error: click.ClickException) -> str:
    """Hint for a wrong command line: the nearest name and the help command."""
    context = error.ctx if isinstance(error, click.UsageError) else None
    where = "kshm" if context is None else context.command_path
    return "; ".join((*_meant(error, context), f"справка: {where} --help"))


def _meant(error: click.ClickException, context: click.Context | None) -> Iterable[str]:
    command = None if context is None else context.command
    if isinstance(error, click.BadOptionUsage) and context is not None:
        several = [
            option
            for option in context.command.params
            if error.option_name in option.opts and option.nargs > 1
        ]
        yield from (f"{option.opts[-1]} {option.make_metavar(context)}" for option in several)
        return
    if isinstance(error, click.NoSuchOption):
        wrong, possible = error.option_name, [*(error.possibilities or ())]
    elif isinstance(command, click.Group):
        match = re.search(_ERRORS[0][0], error.format_message())
        wrong, possible = match[1] if match else "", [*command.commands]
    else:
        return
    similar = difflib.get_close_matches(wrong.lower(), possible, n=1, cutoff=0.5)
    if similar:
        yield f"возможно, {similar[0]}"


def error_text(error: click.ClickException) -> str:
    """Russian message of a click error."""
    if isinstance(error, click.NoSuchOption):
        return f"нет ключа {error.option_name}"
    if isinstance(error, click.MissingParameter):
        kind = "ключ" if isinstance(error.param, click.Option) else "аргумент"
        return f"не указан {kind} {_name(error)}"
    if isinstance(error, click.BadParameter):
        return f"неверное значение {_name(error)}: {_sentence(error.message)}"
    return _sentence(error.format_message())


def _name(error: click.BadParameter) -> str:
    if error.param is None:
        return ""
    option = isinstance(error.param, click.Option)
    return error.param.opts[-1] if option else in_russian(error.param.human_readable_name)


def _sentence(message: str) -> str:
    for english, russian in _ERRORS:
        match = re.search(english, message)
        if match is not None:
            return russian.format(
                *(group.strip("'").replace("', '", ", ") for group in match.groups())
            )
    return "команда записана неверно"
