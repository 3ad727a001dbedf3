"""The command line; imports heavy parts inside the commands that need them."""

from __future__ import annotations

import errno
import io
import os
import select
import sys
from contextlib import suppress
from typing import Any, TextIO

import click

from reports.commands.class_commands import grade, issue
from reports.commands.common import BAD, DONE, HELP, RussianGroup, advice, error_text
from reports.commands.engine import build, check, doctor, new, schema, solve
from reports.commands.seek import optimise
from reports.commands.studies import compare, sweep, validate
from reports.shared.errors import KshmError, Unread
from reports.web.command import serve


def prepare() -> None:
    """Set UTF-8 on both output streams and reopen closed ones.

    What is redirected is a file of the program and as such UTF-8, whatever the system's code page
    is; a terminal keeps its encoding and shows «?» for what it does not have.
    """
    _open_closed()
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115, PTH123
        elif isinstance(stream, io.TextIOWrapper):
            encoding = stream.encoding if stream.isatty() else "utf-8"
            stream.reconfigure(encoding=encoding, errors="replace")


def _open_closed() -> None:
    """Hold descriptors 0-2, which else go to the next files opened."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)


def without_reader(error: OSError) -> bool:
    """Whether an error is a broken pipe; Windows reports ``EINVAL``."""
    if isinstance(error, BrokenPipeError):
        return True
    return os.name == "nt" and error.errno == errno.EINVAL and error.filename is None


def is_lost(stream: TextIO) -> bool:
    """Whether a stream's pipe is broken; True where the system has no ``poll``."""
    if not hasattr(select, "poll"):
        return True
    poll = select.poll()
    poll.register(stream.fileno(), select.POLLOUT)
    return any(event & (select.POLLERR | select.POLLHUP) for _, event in poll.poll(0))


def forget(stream: TextIO) -> None:
    """Flush a stream; discard unwritten output after a broken pipe."""
    try:
        stream.flush()
    except OSError:
        with suppress(OSError):  # a stream without a number
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


class _Russian(RussianGroup):
    """A group that prints unexpected errors as one line, with a traceback only after -v."""

    def invoke(self, ctx: click.Context) -> Any:  # noqa: ANN401
        """Run a command; turn interruptions into ``Abort``, without click's empty line."""
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            raise click.Abort from None
        except Exception as error:
            from reports.shared.interrupt import stopped

            if isinstance(error, OSError) and without_reader(error):
                raise Unread from error
            # A library that calls back, as one that builds a schema, may tell of the signal by an
            # error of its own.
            if stopped():
                raise click.Abort from None
            raise

    def make_context(self, *args: Any, **kwargs: Any) -> click.Context:  # noqa: ANN401
        """Parse the arguments; help into a broken pipe ends as other output does."""
        try:
            return super().make_context(*args, **kwargs)
        except OSError as error:
            raise (Unread if without_reader(error) else error) from None

    def main(self, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401
        """Run; exit codes as in the contract."""
        from reports.shared.interrupt import answered, stoppable
        from reports.shared.user_home import give_libraries_a_home

        prepare()
        give_libraries_a_home()
        kwargs["standalone_mode"] = False
        kwargs.setdefault("prog_name", "kshm")
        arguments = kwargs.get("args") or (args[0] if args else None) or sys.argv[1:]
        verbose = "-v" in arguments or "--verbose" in arguments
        with stoppable():
            try:
                code = super().main(*args, **kwargs)
                sys.stdout.flush()
            except Exception as error:
                answered()
                code = _ended(error, verbose)
        sys.exit(code if isinstance(code, int) else DONE)


def _ended(error: Exception, verbose: bool) -> int:
    """Exit code of a failed run; prints the error unless the pipe is broken."""
    if isinstance(error, Unread) or (isinstance(error, OSError) and without_reader(error)):
        # Output as long as it was wanted; but a warning unread has kept the work from being done.
        code = DONE if is_lost(sys.stdout) else BAD
        forget(sys.stdout)
        forget(sys.stderr)
        return code
    forget(sys.stdout)
    return _failed(error, verbose)


def _failed(error: Exception, verbose: bool) -> int:
    """Print an error in one line; return the exit code."""
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

        name = f"{error.filename}" if error.filename else "вывод или временный файл"
        text = f"kshm: {name}: не удаётся записать или прочитать: {reason(error)}"
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


for _command in (
    new,
    check,
    solve,
    build,
    issue,
    grade,
    validate,
    sweep,
    optimise,
    compare,
    serve,
    schema,
    doctor,
):
    main.add_command(_command)


if __name__ == "__main__":
    main()
