"""Command ``kshm serve``."""

from __future__ import annotations

import contextlib
import os
import socket
import sys
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
@path_option("--certificate", metavar="ФАЙЛ", help="Сертификат TLS (PEM): соединения шифруются.")
@path_option("--key", metavar="ФАЙЛ", help="Ключ к сертификату, если он в своём файле.")
@dask_option
@verbose_option
def serve(
    port: int, host: str, folder: Path, public: str, books: Path | None,
    certificate: Path | None, key: Path | None, dask: str | None,
) -> int:  # fmt: skip
    """Открыть страницу в браузере: числа, диаграммы, файлы, группа преподавателя."""
    packages = ("starlette", "uvicorn", "itsdangerous", "segno")
    need_packages("для kshm serve", **{name: name for name in packages})
    address = urlsplit(public)
    if public and (address.scheme not in ("http", "https") or not address.hostname):
        raise KshmError(f"--public {public}: нужен адрес вида https://kafedra.example/kshm")
    if books is not None and not books.is_dir():
        raise KshmError(f"--books {books}: нет такой папки")
    _check_certificate(certificate, key)
    from reports.grading.issuing.register import SECRET

    with _private():
        private_dir(folder, SECRET)
        with _alone(folder):
            return _served(port, host, folder, public, books, certificate, key, dask)


def _check_certificate(certificate: Path | None, key: Path | None) -> None:
    if certificate is None:
        if key is not None:
            raise KshmError("--key: ключ без сертификата; добавьте --certificate")
        return
    import ssl

    try:
        ssl.create_default_context(ssl.Purpose.CLIENT_AUTH).load_cert_chain(certificate, key)
    except OSError as error:
        is_wrong = isinstance(error, ssl.SSLError)
        why = "сертификат или ключ не читается" if is_wrong else reason(error)
        hint = "нужны файлы PEM: сертификат и его ключ без пароля"
        raise KshmError(f"--certificate {certificate}: {why}; {hint}") from None


@contextlib.contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Hold a folder of data: a second server would do each job once more."""
    with (folder / "lock").open("a+") as stream:
        try:
            if sys.platform == "win32":
                import msvcrt

                msvcrt.locking(stream.fileno(), msvcrt.LK_NBLCK, 1)
            else:
                import fcntl

                fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            problem = "папку уже держит другой сервер"
            hint = "остановите его или укажите другую папку"
            raise KshmError(f"--data {folder}: {problem}; {hint}") from None
        yield


@contextlib.contextmanager
def _private() -> Iterator[None]:
    """Set the umask to private: rosters and works are written."""
    before = os.umask(0o077)
    try:
        yield
    finally:
        os.umask(before)


def _served(
    port: int, host: str, folder: Path, public: str, books: Path | None,
    certificate: Path | None, key: Path | None, dask: str | None,
) -> int:  # fmt: skip
    """Serve until somebody ends it."""
    bound = _bound(host, port)
    import uvicorn

    from reports.grading.issuing.register import SECRET, kept_secret
    from reports.web.app import create_app
    from reports.web.classes import token_of
    from reports.web.http_guards import Settings
    from reports.web.shared_engines import Connection, ProxyConnection

    wide = host in ("0.0.0.0", "::")
    hosts = (socket.gethostname(), "*") if wide else (host,)
    names = _own_addresses() if wide else [host]
    urls = [f"{'https' if certificate else 'http'}://{f'[{name}]' if ':' in name else name}:{port}"
             for name in names]  # fmt: skip
    urls = [public.rstrip("/")] if public else urls
    settings = Settings(folder.resolve(), hosts, public, dask, books=books, addresses=tuple(urls))
    app = create_app(settings)
    token = token_of(kept_secret(folder / SECRET))
    click.echo(f"Страница: {urls[0]}/")
    click.echo(f"Преподавателю: {urls[0]}/teacher#{token}")
    for address in urls[1:]:
        click.echo(f"Ещё адрес: {address}/")
    if wide and not certificate and not public:
        click.echo("Внимание: соединения не шифруются: ключ, ссылки и работы видны всем в этой "
                   "сети; нужны --certificate или прокси с TLS", err=True)  # fmt: skip
    if wide and sys.stdout.isatty():
        import segno

        segno.make(f"{urls[0]}/", micro=False).terminal(compact=True)
    click.echo("Остановить: Ctrl-C", err=True)
    kind = ProxyConnection if public else Connection
    config = uvicorn.Config(
        app, log_level="warning", access_log=False, server_header=False, http=kind, ws="none",
        limit_concurrency=1000, timeout_keep_alive=30, timeout_graceful_shutdown=3,
        ssl_certfile=certificate, ssl_keyfile=None if key is None else str(key),
    )  # fmt: skip
    with contextlib.suppress(KeyboardInterrupt):  # the usual end
        uvicorn.Server(config).run([bound])
    return DONE


def _own_addresses() -> list[str]:
    """Addresses of this machine in its networks, that of the way out first."""
    names = []
    with contextlib.suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as way:
        way.connect(("192.0.2.1", 9))  # nothing is sent: the system only chooses the way
        names.append(way.getsockname()[0])
    with contextlib.suppress(OSError):
        entries = socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)
        names += [str(info[4][0]) for info in entries]
    addresses = [name for name in dict.fromkeys(map(str, names)) if not name.startswith("127.")]
    return [*addresses, "127.0.0.1"]


def _bound(host: str, port: int) -> socket.socket:
    """Bind a socket; KshmError in one line if it fails."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family, dualstack_ipv6=":" in host)
    except OSError as error:
        where = f"--host {host} --port {port}"
        raise KshmError(f"{where}: {reason(error)}; укажите другой адрес или порт") from None
