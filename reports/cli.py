"""The command line.  Heavy parts are imported inside the commands that need them."""

from __future__ import annotations

import os
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
    "[required]": "[обязательно]",
    "[default: ": "[по умолчанию: ",
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

    def invoke(self, ctx: click.Context) -> Any:  # noqa: ANN401
        """Run a command; an interruption is told in one line, without the empty one of click."""
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            raise click.Abort from None
        except BrokenPipeError:
            _forget_output()
            return DONE

    def main(self, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401
        """Run; exit codes as in the contract."""
        from reports.interrupt import stoppable

        kwargs["standalone_mode"] = False
        arguments = kwargs.get("args") or (args[0] if args else None) or sys.argv[1:]
        verbose = "-v" in arguments or "--verbose" in arguments
        with stoppable():
            try:
                code = super().main(*args, **kwargs)
                sys.stdout.flush()
            except BrokenPipeError:
                _forget_output()
                code = DONE
            except Exception as error:
                code = _failed(error, verbose)
        sys.exit(code if isinstance(code, int) else DONE)


def _forget_output() -> None:
    """What is left in the buffer has no reader: the end of the program must not mind."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _failed(error: Exception, verbose: bool) -> int:
    """Tell in a line what went wrong; the exit code."""
    if isinstance(error, click.exceptions.Exit):
        return error.exit_code
    if isinstance(error, KshmError):
        lines, code = error.lines(), error.exit_code
    elif isinstance(error, click.Abort):
        lines, code = ["прервано"], BAD
    elif isinstance(error, click.ClickException):
        lines, code = [f"kshm: {_translated(error)}; справка: kshm --help"], BAD
    elif verbose:
        raise error
    else:
        lines, code = [_unexpected(error)], BAD
    for line in lines:
        click.echo(line, err=True)
    return code


def _unexpected(error: Exception) -> str:
    from reports.errors import one_line

    if isinstance(error, OSError):
        from reports.files import reason

        place = f"{error.filename}" if error.filename else "вывод или временный файл"
        text = f"kshm: {place}: не удается записать или прочитать: {reason(error)}"
        return one_line(f"{text}; освободите место или укажите другое, подробности: ключ -v")
    if isinstance(error, MemoryError):
        return "kshm: не хватает памяти; закройте другие программы или увеличьте шаг расчёта"
    kind = type(error).__name__
    return one_line(f"kshm: внутренняя ошибка {kind}: {error}; подробности: ключ -v", 600)


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


_dask = click.option("--dask", metavar="ADDRESS", help="Считать на кластере Dask, tcp://host:8786.")


@main.command(context_settings=_HELP)
@click.argument(
    "sources", metavar="INPUT...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@click.option(
    "-o",
    "--output",
    "folder",
    type=click.Path(path_type=Path),
    default=Path(),
    help="Папка для результатов (по умолчанию текущая).",
)
@click.option(
    "--only", type=click.Choice(["xlsx", "pdf", "html"]), help="Только один вид документа."
)
@_dask
@_verbose
def build(
    sources: tuple[Path, ...], folder: Path, only: str | None, dask: str | None, verbose: bool
) -> int:  # fmt: skip
    """Сделать книгу Excel и отчёт PDF по файлу .toml или по изменённой книге."""
    from reports.builds import build_each

    inputs = [(source, _load(source)) for source in sources]
    code = LOOK if any(loaded.warnings for _, loaded in inputs) else DONE
    kinds = (only,) if only else ("xlsx", "pdf")
    for built in build_each(inputs, folder, kinds, dask):  # type: ignore[arg-type]
        for path in built.files:
            click.echo(f"{path}")
        if built.missing is not None:
            for line in built.missing.lines():
                click.echo(line, err=True)
            code = MISSING
    return code


def _path_option(*names: str, **more: Any) -> Callable[[_Command], _Command]:  # noqa: ANN401
    return click.option(*names, type=click.Path(path_type=Path), **more)


@main.command(context_settings=_HELP)
@_file("BASE")
@_path_option("--roster", required=True, metavar="CSV", help="Список группы.")
@_path_option("-o", "--output", "folder", required=True, help="Папка для выдачи.")
@click.option("--seed", default=1, show_default=True, help="Зерно: то же зерно — те же варианты.")
@_path_option("--rubric", metavar="FILE", help="Рубрика TOML (без неё — правила по умолчанию).")
@_path_option("--ranges", metavar="FILE", help="Диапазоны, если их нет в разделе [variants].")
@_path_option("--secret", metavar="FILE", help="Файл секрета преподавателя.")
@_verbose
def issue(
    source: Path,
    roster: Path,
    folder: Path,
    seed: int,
    rubric: Path | None,
    ranges: Path | None,
    secret: Path | None,
    verbose: bool,
) -> int:
    """Выдать каждому студенту свой вариант и рабочую книгу."""
    from reports.grading.issue import issue as issue_books

    done = issue_books(
        source, roster, folder, seed=seed,
        rubric_file=rubric, ranges_file=ranges, secret_file=secret,
    )  # fmt: skip
    if done.new_secret is not None:
        click.echo(
            f"Создан секрет: {done.new_secret}. Сохраните его: без него не проверить работы; "
            "студентам его не давайте.",
            err=True,
        )
    click.echo(f"{folder}: выдано вариантов: {len(done.register.books)}")
    return DONE


@main.command(context_settings=_HELP)
@click.argument("issued", required=False, type=click.Path(path_type=Path))
@click.argument("submitted", required=False, type=click.Path(path_type=Path))
@_path_option("-o", "--output", "folder", help="Папка для результатов.")
@_path_option("--rubric", metavar="FILE", help="Другая рубрика вместо выданной.")
@_path_option("--secret", metavar="FILE", help="Файл секрета преподавателя.")
@click.option("--pdf", is_flag=True, help="Сделать и PDF каждой страницы.")
@click.option("--jobs", default=0, help="Число процессов (по умолчанию все ядра).")
@click.option("--timeout", default=60.0, show_default=True, help="Секунд на один файл.")
@_dask
@click.option("--explain", nargs=2, metavar="FILE SHEET!COLUMN", help="Объяснить один вердикт.")
@_verbose
def grade(
    issued: Path | None,
    submitted: Path | None,
    folder: Path | None,
    rubric: Path | None,
    secret: Path | None,
    pdf: bool,
    jobs: int,
    timeout: float,
    dask: str | None,
    explain: tuple[str, str] | None,
    verbose: bool,
) -> int:
    """Проверить сданные работы: файл, папку или zip заданий Moodle.

    ISSUED — папка, которую сделала команда issue; SUBMITTED — что сдали студенты.
    """
    if explain is not None:
        from reports.grading.explain import explain as explain_column

        for line in explain_column(issued, Path(explain[0]), explain[1], rubric, secret):
            click.echo(line)
        return DONE
    from reports.grading.grade import Options
    from reports.grading.grade import grade as grade_all

    if issued is None or submitted is None or folder is None:
        msg = "нужны папка выдачи, сданные работы и папка для результатов (ключ -o)"
        raise KshmError(msg)
    if jobs < 0 or timeout <= 0:
        msg = "--jobs и --timeout должны быть положительными"
        raise KshmError(msg)
    done = grade_all(
        issued, submitted, folder, rubric_file=rubric, secret_file=secret,
        options=Options(workers=jobs, timeout_s=timeout, pdf=pdf, dask=dask),
    )  # fmt: skip
    found = done.summary
    click.echo(f"{folder}: проверено файлов: {found['files']}, с оценкой: {found['graded']}")
    if done.needs_a_person:
        click.echo(f"Нужна ручная проверка: {len(found['manual'])}", err=True)
        return LOOK
    return DONE


@main.command(context_settings=_HELP)
@_path_option("-o", "--output", "folder", default=Path(),
              help="Папка для результатов (по умолчанию текущая).")  # fmt: skip
@click.option(
    "--only", type=click.Choice(["csv", "html", "pdf"]), help="Только один вид документа."
)
@_verbose
def validate(folder: Path, only: str | None, verbose: bool) -> int:
    """Пересчитать печатные таблицы пяти источников и показать, что с ними сходится."""
    from reports.validation.write import KINDS, write

    book, files, missing = write(folder, (only,) if only else KINDS)  # type: ignore[arg-type]
    for path in files:
        click.echo(f"{path}")
    counts = book.counts
    click.echo(f"чисел: {counts.total}, совпадает: {counts.agrees}")
    if missing:
        click.echo(missing, err=True)
        return MISSING
    if counts.needs_a_person:
        first = book.new[0]
        where = ", ".join(filter(None, (first.table.place, first.cell.row, first.cell.column)))
        click.echo(
            f"Новых отклонений: {len(book.new)}, первое: {where}: {first.reason}; посмотрите "
            "строки «новое отклонение», запишите причину в errata.csv или исправьте расчёт",
            err=True,
        )
        return LOOK
    return DONE


@main.command(context_settings=_HELP)
@_file("BASE")
@click.option(
    "--vary",
    multiple=True,
    required=True,
    metavar="KEY=ОТ:ДО:N",
    help="Ключ файла и N значений, например geometry.bore_mm=84:92:9; можно не один.",
)
@click.option(
    "--quantity",
    "quantities",
    multiple=True,
    metavar="NAME",
    help="Величина: M_mean или столбец P4_1.N_MPa (по умолчанию основные).",
)
@click.option(
    "--pairwise", is_flag=True, help="Первое с первым, второе со вторым, а не все со всеми."
)
@_path_option(
    "-o",
    "--output",
    "target",
    required=True,
    metavar="FILE",
    help="Файл .parquet, .csv или .xlsx (с диаграммами).",
)
@click.option("--jobs", default=0, help="Число процессов (по умолчанию все ядра).")
@_dask
@_verbose
def sweep(
    source: Path, vary: tuple[str, ...], quantities: tuple[str, ...], pairwise: bool,
    target: Path, jobs: int, dask: str | None, verbose: bool,
) -> int:  # fmt: skip
    """Исследовать параметры: наибольшие и средние значения при всех сочетаниях.

    Первый ключ меняется быстрее всех; по нему строятся диаграммы, по второму — семейство
    кривых. Сочетание, которое не проходит проверку, остаётся строкой с причиной.
    """
    from reports.sweep.run import Options
    from reports.sweep.run import sweep as run_sweep

    if jobs < 0:
        msg = "--jobs не может быть отрицательным"
        raise KshmError(msg)
    done = run_sweep(
        source, vary, target, quantities=quantities, pairwise=pairwise,
        options=Options(jobs=jobs, dask=dask),
    )  # fmt: skip
    click.echo(f"{target}: сочетаний {done.points}")
    if done.failed:
        click.echo(f"Без результата: {done.failed}, например: {done.first_error}", err=True)
        return LOOK
    return DONE


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
