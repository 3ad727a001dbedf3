"""Russian for what click says: headings of the help, its notes, its errors."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable

import click

_USAGE = "Использование: "
_WORDS = {
    "[OPTIONS]": "[КЛЮЧИ]",
    "[COMMAND] [ARGS]...": "КОМАНДА [АРГУМЕНТЫ]...",
    "Show this message and exit.": "Показать эту справку.",
    "[required]": "[обязательно]",
    "[default: ": "[по умолчанию: ",
    " INTEGER RANGE": " ЧИСЛО",
    " INTEGER": " ЧИСЛО",
    " FLOAT": " ЧИСЛО",
    " PATH": " ПУТЬ",
    " FILE": " ФАЙЛ",
    " DIR": " ПАПКА",
    " URL": " АДРЕС",
    " NAME": " ИМЯ",
    " ADDRESS": " АДРЕС",
    "SHEET!COLUMN": "ЛИСТ!СТОЛБЕЦ",
    "KEY=": "КЛЮЧ=",
    "INPUT": "ФАЙЛ",
    "BASE": "БАЗА",
    "[ISSUED] [SUBMITTED]": "[ВЫДАЧА] [СДАНО]",
    "ISSUED": "ВЫДАЧА",
    "SUBMITTED": "СДАНО",
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


class _Formatter(click.HelpFormatter):
    """Help in Russian before its lines are broken: also on a narrow terminal."""

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
        """The first sentence whole: the list of commands breaks its lines by itself."""
        del limit
        return " ".join((self.help or "").split("\n\n")[0].split()).removesuffix(".")

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Errors of the parser know whose they are: it does not tell of all of them."""
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
    """A piece of help with its English words replaced."""
    for english, russian in _WORDS.items():
        text = text.replace(english, russian)
    return re.sub(r"(\d+)<=x<=(\d+)", r"от \1 до \2", text)


def advice(error: click.ClickException) -> str:
    """How to mend a command line: what was probably meant, where to read about it."""
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
        wrong, known = error.option_name, [*(error.possibilities or ())]
    elif isinstance(command, click.Group):
        found = re.search(_ERRORS[0][0], error.format_message())
        wrong, known = found[1] if found else "", [*command.commands]
    else:
        return
    near = difflib.get_close_matches(wrong.lower(), known, n=1, cutoff=0.5)
    if near:
        yield f"возможно, {near[0]}"


def error_text(error: click.ClickException) -> str:
    """What is wrong with a command line, without a word of English."""
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
        found = re.search(english, message)
        if found is not None:
            return russian.format(
                *(group.strip("'").replace("', '", ", ") for group in found.groups())
            )
    return "команда записана неверно"
