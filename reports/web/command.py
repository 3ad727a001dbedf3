"""Command ``kshm serve``."""

from __future__ import annotations

import contextlib
import os
import socket
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import click

from reports.commands.common import (
    DONE,
    HELP,
    RussianCommand,
    dask_option,
    path_option,
    verbose_option,
)
from reports.shared.doctor import need_packages
from reports.shared.errors import KshmError
from reports.shared.files import private_dir, reason


@click.command(cls=RussianCommand, context_settings=HELP)
@click.option("--port", type=click.IntRange(1, 65535), metavar="ЧИСЛО", default=8321,
              show_default=True, help="Порт.")  # fmt: skip
@click.option("--host", default="127.0.0.1", show_default=True, metavar="ИМЯ",
              help="Адрес, на котором ждать; 0.0.0.0 — вся сеть.")  # fmt: skip
@path_option("--data", "folder", metavar="ПАПКА", default=Path("kshm-data"),
             help="Папка, где лежат файлы и группы (по умолчанию kshm-data).")  # fmt: skip
@click.option("--public", metavar="АДРЕС", default="",
              help="Адрес за прокси, например https://kafedra.example/kshm.")  # fmt: skip
@path_option("--books", metavar="ПАПКА",
             help="Разрешить свои книги расчётов из этой папки (без ключа — никаких).")  # fmt: skip
@dask_option
@verbose_option
def serve(
    port: int, host: str, folder: Path, public: str, books: Path | None, dask: str | None
) -> int:
    """Открыть страницу в браузере: числа, диаграммы, файлы, группа преподавателя."""
    packages = ("starlette", "uvicorn", "itsdangerous")
    need_packages("для kshm serve", **{name: name for name in packages})
    address = urlsplit(public)
    if public and (address.scheme not in ("http", "https") or not address.hostname):
        raise KshmError(f"--public {public}: нужен адрес вида https://kafedra.example/kshm")
    if books is not None and not books.is_dir():
        raise KshmError(f"--books {books}: нет такой папки")
    with _private():
        return _served(port, host, folder, public, books, dask)


@contextlib.contextmanager
def _private() -> Iterator[None]:
    """Set the umask to private: rosters and works are written."""
    before = os.umask(0o077)
    try:
        yield
    finally:
        os.umask(before)


def _served(
    port: int, host: str, folder: Path, public: str, books: Path | None, dask: str | None
) -> int:
    """Serve until somebody ends it."""
    from reports.grading.issuing.register import SECRET, kept_secret

    private_dir(folder, SECRET)
    bound = _bound(host, port)
    import uvicorn

    from reports.web.app import create_app
    from reports.web.classes import token_of
    from reports.web.doors import Settings

    wide = host in ("0.0.0.0", "::")
    hosts = (socket.gethostname(), "*") if wide else (host,)
    app = create_app(Settings(folder.resolve(), hosts, public, dask, books=books))
    shown = public.rstrip("/") or f"http://{'127.0.0.1' if host == '0.0.0.0' else host}:{port}"
    click.echo(f"Страница: {shown}/")
    click.echo(f"Преподавателю: {shown}/teacher#{token_of(kept_secret(folder / SECRET))}")
    click.echo("Остановить: Ctrl-C", err=True)
    config = uvicorn.Config(
        app, log_level="warning", access_log=False, server_header=False,
        limit_concurrency=1000, timeout_keep_alive=30, timeout_graceful_shutdown=3,
    )  # fmt: skip
    with contextlib.suppress(KeyboardInterrupt):  # the usual end
        uvicorn.Server(config).run([bound])
    return DONE


def _bound(host: str, port: int) -> socket.socket:
    """Bind a socket; KshmError in one line if it fails."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family, dualstack_ipv6=":" in host)
    except OSError as error:
        where = f"--host {host} --port {port}"
        raise KshmError(f"{where}: {reason(error)}; укажите другой адрес или порт") from None
