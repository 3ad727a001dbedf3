"""The command line.  Heavy parts are imported inside the commands that need them."""

from __future__ import annotations

import sys
from typing import Any

import click

from reports.commands.common import BAD, DONE, HELP
from reports.commands.engine import build, check, doctor, new, solve
from reports.commands.group import grade, issue
from reports.commands.studies import compare, sweep, validate
from reports.commands.words import RussianGroup, advice, error_text
from reports.shared.errors import KshmError
from reports.shared.streams import forget, is_lost, prepare, without_reader
from reports.web.command import serve


class _Russian(RussianGroup):
    """A group whose unexpected errors are one line, with a traceback only after -v."""

    def invoke(self, ctx: click.Context) -> Any:  # noqa: ANN401
        """Run a command; an interruption is told in one line, without the empty one of click."""
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            raise click.Abort from None
        except Exception as error:
            from reports.shared.interrupt import asked

            if isinstance(error, OSError) and without_reader(error):
                raise _Unread from error
            # A library that calls back, as one that builds a schema, may tell of the signal by an
            # error of its own.
            if asked():
                raise click.Abort from None
            raise

    def make_context(self, *args: Any, **kwargs: Any) -> click.Context:  # noqa: ANN401
        """Read the arguments; the help that nobody reads any more ends as other output does."""
        try:
            return super().make_context(*args, **kwargs)
        except OSError as error:
            raise (_Unread if without_reader(error) else error) from None

    def main(self, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401
        """Run; exit codes as in the contract."""
        from reports.shared.interrupt import stoppable

        prepare()
        kwargs["standalone_mode"] = False
        kwargs.setdefault("prog_name", "kshm")
        arguments = kwargs.get("args") or (args[0] if args else None) or sys.argv[1:]
        verbose = "-v" in arguments or "--verbose" in arguments
        with stoppable():
            try:
                code = super().main(*args, **kwargs)
                sys.stdout.flush()
            except Exception as error:
                code = _ended(error, verbose)
        sys.exit(code if isinstance(code, int) else DONE)


class _Unread(Exception):  # noqa: N818 - no error
    """The reader of a stream is gone; click would end the program over an OSError."""


def _ended(error: Exception, verbose: bool) -> int:
    """The exit code of what did not come to its end, told where there is somebody to tell."""
    if isinstance(error, _Unread) or (isinstance(error, OSError) and without_reader(error)):
        # Output as long as it was wanted; but a warning unread has kept the work from being done.
        code = DONE if is_lost(sys.stdout) else BAD
        forget(sys.stdout)
        forget(sys.stderr)
        return code
    forget(sys.stdout)
    return _failed(error, verbose)


def _failed(error: Exception, verbose: bool) -> int:
    """Tell in a line what went wrong; the exit code."""
    if isinstance(error, click.exceptions.Exit):
        return error.exit_code
    if isinstance(error, KshmError):
        lines, code = error.lines(), error.exit_code
    elif isinstance(error, click.Abort):
        lines, code = ["прервано"], BAD
    elif isinstance(error, click.ClickException):
        lines, code = [f"kshm: {error_text(error)}; {advice(error)}"], BAD
    elif verbose:
        raise error
    else:
        lines, code = [_unexpected(error)], BAD
    try:
        for line in lines:
            click.echo(line, err=True)
    except OSError:  # nobody to tell
        forget(sys.stderr)
    return code


def _unexpected(error: Exception) -> str:
    from reports.shared.errors import one_line

    if isinstance(error, OSError):
        from reports.shared.files import reason

        place = f"{error.filename}" if error.filename else "вывод или временный файл"
        text = f"kshm: {place}: не удаётся записать или прочитать: {reason(error)}"
        return one_line(f"{text}; освободите место или укажите другое, подробности: ключ -v")
    if isinstance(error, MemoryError):
        return "kshm: не хватает памяти; закройте другие программы или увеличьте шаг расчёта"
    kind = type(error).__name__
    return one_line(f"kshm: внутренняя ошибка {kind}: {error}; подробности: ключ -v", 600)


@click.group(cls=_Russian, context_settings=HELP, invoke_without_command=True)
@click.version_option(package_name="kshm", message="kshm %(version)s", help="Показать версию.")
@click.pass_context
def main(context: click.Context) -> None:
    """Кинематика и динамика КШМ: книга Excel с формулами и отчёт PDF по одному файлу."""
    if context.invoked_subcommand is None:
        click.echo(context.get_help())


for _command in (new, check, solve, build, issue, grade, validate, sweep, compare, serve, doctor):
    main.add_command(_command)


if __name__ == "__main__":
    main()
