"""The command line.  Heavy parts are imported inside the commands that need them."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from reports.errors import KshmError

if TYPE_CHECKING:
    from reports.inputs.load import Loaded

DONE, LOOK, BAD, MISSING = 0, 1, 2, 3
_HELP = {"help_option_names": ["-h", "--help"]}


_WORDS = {
    "Usage:": "Использование:",
    "[OPTIONS]": "[КЛЮЧИ]",
    "COMMAND [ARGS]...": "КОМАНДА [АРГУМЕНТЫ]...",
    "Options:": "Ключи:",
    "Commands:": "Команды:",
    "Show this message and exit.": "Показать эту справку.",
}


def _in_russian(text: str) -> str:
    for english, russian in _WORDS.items():
        text = text.replace(english, russian)
    return text


class _RussianCommand(click.Command):
    """A command whose help is Russian throughout."""

    def get_help(self, ctx: click.Context) -> str:
        """Help with Russian headings."""
        return _in_russian(super().get_help(ctx))


class _Russian(click.Group):
    """A group whose unexpected errors are one line, with a traceback only after -v."""

    command_class = _RussianCommand

    def get_help(self, ctx: click.Context) -> str:
        """Help with Russian headings."""
        return _in_russian(super().get_help(ctx))

    def main(self, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401
        """Run; exit codes as in the contract."""
        kwargs["standalone_mode"] = False
        arguments = kwargs.get("args") or (args[0] if args else None) or sys.argv[1:]
        verbose = "-v" in arguments or "--verbose" in arguments
        try:
            code = super().main(*args, **kwargs)
            sys.exit(code if isinstance(code, int) else DONE)
        except click.exceptions.Exit as stop:
            sys.exit(stop.exit_code)
        except click.Abort:
            click.echo("прервано", err=True)
            sys.exit(BAD)
        except click.ClickException as error:
            click.echo(f"kshm: {_translated(error)}; справка: kshm --help", err=True)
            sys.exit(BAD)
        except KshmError as error:
            for line in error.lines():
                click.echo(line, err=True)
            sys.exit(error.exit_code)
        except BrokenPipeError:
            sys.exit(DONE)
        except Exception as error:
            if verbose:
                raise
            kind = type(error).__name__
            click.echo(f"kshm: внутренняя ошибка {kind}: {error}; подробности: ключ -v", err=True)
            sys.exit(BAD)


def _translated(error: click.ClickException) -> str:
    if isinstance(error, click.NoSuchOption):
        return f"нет ключа {error.option_name}"
    if isinstance(error, click.MissingParameter):
        name = error.param.human_readable_name if error.param else ""
        return f"не указан аргумент {name}"
    if isinstance(error, click.BadParameter):
        name = error.param.human_readable_name if error.param else ""
        return f"неверное значение {name}: {error.message}"
    message = error.format_message()
    return message.replace("No such command", "нет команды").replace(
        "Got unexpected extra argument", "лишний аргумент"
    )


_Command = Callable[..., int]


def _file(text: str = "INPUT") -> Callable[[_Command], _Command]:
    return click.argument("source", metavar=text, type=click.Path(path_type=Path))


_verbose = click.option("-v", "--verbose", is_flag=True, help="Показать подробности ошибки.")


@click.group(cls=_Russian, context_settings=_HELP)
@click.version_option(package_name="kshm", message="kshm %(version)s", help="Показать версию.")
def main() -> None:
    """Кинематика и динамика КШМ: книга Excel с формулами и отчёт PDF по одному файлу."""


@main.command(context_settings=_HELP)
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), help="Куда записать (иначе на экран)."
)
@click.option("--sample", metavar="NAME", help="Взять за основу образец, например gots-diesel.")
@_verbose
def new(output: Path | None, sample: str | None, verbose: bool) -> int:
    """Дать файл исходных данных с пояснениями."""
    from reports.files import write_text
    from reports.inputs.template import new_file

    text = new_file(sample)
    if output is None:
        click.echo(text, nl=False)
        return DONE
    if output.exists():
        msg = f"{output}: файл уже есть; укажите другое имя ключом -o или удалите его"
        raise KshmError(msg)
    write_text(output, text)
    click.echo(f"{output}")
    return DONE


@main.command(context_settings=_HELP)
@_file()
@click.option("--json", "as_json", is_flag=True, help="Результат проверки в JSON.")
@_verbose
def check(source: Path, as_json: bool, verbose: bool) -> int:
    """Проверить исходные данные, ничего не считая."""
    import json

    from reports.build import load_input
    from reports.errors import InputError

    try:
        loaded = load_input(source)
        problems: tuple[Any, ...] = ()
        warnings = loaded.warnings
    except InputError as error:
        if not as_json:
            raise
        problems, warnings = error.problems, ()
    if as_json:
        data = {
            "ok": not problems,
            "errors": [_as_dict(problem) for problem in problems],
            "warnings": [_as_dict(problem) for problem in warnings],
        }
        click.echo(json.dumps(data, ensure_ascii=False, indent=1))
        return BAD if problems else (LOOK if warnings else DONE)
    for problem in warnings:
        click.echo(f"Внимание: {problem.line()}", err=True)
    click.echo(f"{source}: ошибок нет")
    return LOOK if warnings else DONE


def _as_dict(problem: Any) -> dict[str, str]:  # noqa: ANN401
    return {"where": problem.where, "what": problem.what, "hint": problem.hint}


def _load(source: Path) -> Loaded:
    from reports.build import load_input

    loaded = load_input(source)
    for problem in loaded.warnings:
        click.echo(f"Внимание: {problem.line()}", err=True)
    return loaded


@main.command(context_settings=_HELP)
@_file()
@click.option("--csv", "folder", type=click.Path(path_type=Path), help="Папка для таблиц CSV.")
@click.option("--json", "target", metavar="FILE", help="Файл JSON; «-» — на экран.")
@_verbose
def solve(source: Path, folder: Path | None, target: str | None, verbose: bool) -> int:
    """Посчитать числа без документов."""
    from kshm import solve as solve_engine
    from reports.exports import csv_text, export_tables, json_text
    from reports.files import atomic_path, make_dir, write_text
    from reports.inputs.convert import to_engine

    loaded = _load(source)
    solution = solve_engine(to_engine(loaded.model))
    if folder is not None:
        make_dir(folder)
        for name, columns in export_tables(solution).items():
            write_text(folder / f"{name}.csv", csv_text(columns))
    if target == "-":
        click.echo(json_text(loaded.model, solution), nl=False)
    elif target is not None:
        with atomic_path(Path(target)) as temporary:
            temporary.write_text(json_text(loaded.model, solution), encoding="utf-8")
    if folder is None and target is None:
        _print_summary(solution.scalars)
    return DONE


def _print_summary(scalars: dict[str, float]) -> None:
    from kshm.nomenclature import quantity

    for key, value in scalars.items():
        if key.startswith("throw"):
            continue
        about = quantity(key)
        digits = len(about.fmt.split(".")[1]) if "." in about.fmt else 0
        text = f"{value:.{digits}f}".replace(".", ",").replace("-", "−")
        click.echo(f"{about.title}: {about.symbol} = {text} {about.unit_label}".rstrip())


@main.command(context_settings=_HELP)
@_file()
@click.option("-o", "--output", "folder", type=click.Path(path_type=Path), default=Path(),
              help="Папка для результатов (по умолчанию текущая).")  # fmt: skip
@click.option(
    "--only", type=click.Choice(["xlsx", "pdf", "html"]), help="Только один вид документа."
)
@_verbose
def build(source: Path, folder: Path, only: str | None, verbose: bool) -> int:
    """Сделать книгу Excel и отчёт PDF по файлу .toml или по изменённой книге."""
    from reports.build import build as build_files

    loaded = _load(source)
    if (
        source.suffix.lower() == ".xlsx"
        and (folder / f"{source.stem}.xlsx").resolve() == source.resolve()
    ):
        msg = f"{source}: результат лёг бы поверх вашей книги; укажите другую папку ключом -o"
        raise KshmError(msg)
    kinds = (only,) if only else ("xlsx", "pdf")
    built = build_files(source, loaded, folder, kinds)  # type: ignore[arg-type]
    for path in built.files:
        click.echo(f"{path}")
    if built.missing is not None:
        for line in built.missing.lines():
            click.echo(line, err=True)
        return MISSING
    return LOOK if loaded.warnings else DONE


@main.command(context_settings=_HELP)
@_verbose
def doctor(verbose: bool) -> int:
    """Проверить, чего не хватает на этом компьютере."""
    from reports.doctor import check_system

    complete = True
    for part in check_system():
        mark = "есть" if part.ok else "НЕТ"
        click.echo(f"{mark:>4}  {part.name}: {part.detail}")
        if not part.ok:
            complete = False
            if part.install_command:
                click.echo(f"      установить: {part.install_command}")
    return DONE if complete else MISSING


if __name__ == "__main__":
    main()
