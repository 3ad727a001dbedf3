"""Register of the issued work-books, their identifiers and the secret behind them."""

from __future__ import annotations

import base64
import csv
import hashlib
import hmac
import io
import json
import os
import re
import secrets
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from reports.exports.numbers import neutralised
from reports.grading.issuing.roster import Student
from reports.grading.issuing.rubric import Rubric, rubric_of
from reports.shared.errors import InputError, KshmError, Problem
from reports.shared.files import reason
from reports.shared.user_home import NO_HOME

ENVIRONMENT = "KSHM_SECRET"
SECRET = "secret.key"
PATTERN = re.compile(r"K[A-Z2-7]{24}")
_LENGTH = 32
VERSION = 1
FILE = "register.json"
MAX_BYTES = 50_000_000


def secret_path(path: Path | None) -> Path:
    """Path of the secret: the key, the environment, else the user's settings.

    Raises:
        KshmError: the user has no home.
    """
    if path is not None:
        return path
    if os.environ.get(ENVIRONMENT):
        return Path(os.environ[ENVIRONMENT])
    if os.environ.get(NO_HOME):
        msg = "нет домашней папки, где хранить секрет; укажите файл для него ключом --secret"
        raise KshmError(msg)
    home = Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config")
    return home / "kshm" / SECRET


def read_secret(path: Path) -> bytes:
    """Return the secret.

    Raises:
        InputError: it is missing or is none.
    """
    try:
        text = path.read_text(encoding="ascii").strip()
        secret = bytes.fromhex(text)
    except OSError as error:
        hint = "укажите файл, с которым выдавались варианты, ключом --secret"
        raise InputError(Problem(str(path), f"секрет не читается: {reason(error)}", hint)) from None
    except ValueError:
        raise InputError(_no_secret(path)) from None
    if len(secret) != _LENGTH:
        raise InputError(_no_secret(path))
    return secret


def _no_secret(path: Path) -> Problem:
    return Problem(str(path), "это не файл секрета kshm", "укажите другой файл ключом --secret")


def kept_secret(path: Path) -> bytes:
    """Return the secret of a file, a new one where there is none; InputError if it is none."""
    return read_secret(path) if path.exists() else make_secret(path)


def make_secret(path: Path) -> bytes:
    """Return a new secret in a file that only its owner can read.

    Raises:
        InputError: the file cannot be written.
    """
    secret = secrets.token_bytes(_LENGTH)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(handle, "w", encoding="ascii") as stream:
            stream.write(secret.hex() + "\n")
    except OSError as error:
        hint = "укажите другое место ключом --secret"
        problem = f"не удаётся записать секрет: {reason(error)}"
        raise InputError(Problem(str(path), problem, hint)) from None
    return secret


def ticket(secret: bytes, *, batch: str, student: str, file: str, variant: Any) -> str:  # noqa: ANN401
    """Return identifier of one issued work-book: 120 bits of an HMAC-SHA256 in capital letters."""
    message = json.dumps([batch, student, file, variant], ensure_ascii=False, sort_keys=True)
    digest = hmac.new(secret, message.encode(), hashlib.sha256).digest()
    return "K" + base64.b32encode(digest[:15]).decode("ascii")


# --- the register --------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Issued:
    """One work-book: whose, which variant, under which identifier."""

    number: int
    student: Student
    folder: str
    file: str
    ticket: str
    drawn: dict[str, float | int | str]
    raw: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Register:
    """All work-books of a batch and the rubric that they were issued under.

    ``former`` are those of students who have left; ``identity`` is that of the first issue.
    """

    batch: str
    seed: int
    source: str
    rubric: Rubric
    books: tuple[Issued, ...]
    former: tuple[Issued, ...] = ()
    identity: str = ""

    @property
    def trial_seed(self) -> str:
        """Seed of the input data on which formulas are tried; no student has all of it."""
        if self.identity:
            return self.identity
        return hashlib.sha256(" ".join(book.ticket for book in self.books).encode()).hexdigest()

    def json_text(self) -> str:
        """Return the register as a file."""
        data = {
            "format": "kshm-register",
            "version": VERSION,
            "batch": self.batch,
            "seed": self.seed,
            "source": self.source,
            "rubric": self.rubric.model_dump(mode="json"),
            "books": [asdict(book) for book in self.books],
        }
        if self.identity:
            data |= {"identity": self.identity, "former": [asdict(one) for one in self.former]}
        return json.dumps(data, ensure_ascii=False, indent=1) + "\n"

    def csv_text(self) -> str:
        """Return a table to look at: who got what."""
        stream = io.StringIO()
        writer = csv.writer(stream, delimiter=";", lineterminator="\n")
        keys = list(self.books[0].drawn)
        writer.writerow(["Вариант", "Фамилия", "Имя", "Группа", "Файл", "Идентификатор", *keys])
        for book in self.books:
            student = book.student
            texts = [str(book.number), student.surname, student.name, student.group,
                     f"{book.folder}/{book.file}", book.ticket]  # fmt: skip
            values = [str(book.drawn[key]) for key in keys]
            writer.writerow([neutralised(text) for text in texts] + values)
        return "\ufeff" + stream.getvalue()

    def check(self, secret: bytes, where: Path) -> None:
        """Make sure that the register was not changed since it was issued.

        Raises:
            InputError: an identifier that this secret did not make.
        """
        for book in (*self.books, *self.former):
            identifier = ticket_of(secret, self.batch, book.student, book.file, book.raw)
            if not hmac.compare_digest(identifier, book.ticket):
                problem = f"запись {book.number} ({book.student.full}) не соответствует секрету"
                hint = "реестр изменён или выдан с другим секретом; укажите его ключом --secret"
                raise InputError(Problem(str(where), problem, hint))


def ticket_of(secret: bytes, batch: str, student: Student, file: str, raw: dict[str, Any]) -> str:
    """Return identifier of a student's work-book."""
    return ticket(secret, batch=batch, student=student.id, file=file, variant=raw)


def load_register(folder: Path) -> Register:
    """Return the register of a folder that ``kshm issue`` made.

    Raises:
        InputError: there is none, or it is damaged.
    """
    path = folder / FILE if folder.is_dir() else folder
    try:
        size = path.stat().st_size
        data = {} if size > MAX_BYTES else json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        hint = "укажите папку, которую сделала команда kshm issue"
        raise InputError(Problem(str(path), f"нет реестра: {reason(error)}", hint)) from None
    except (ValueError, RecursionError):
        raise InputError(_damaged(path)) from None
    if size > MAX_BYTES:
        problem = f"файл больше {MAX_BYTES // 10**6} МБ"
        raise InputError(Problem(str(path), problem, "это не реестр kshm"))
    if not isinstance(data, dict) or data.get("format") != "kshm-register":
        raise InputError(_damaged(path))
    if data.get("version") != VERSION:
        problem = f"реестр версии {data.get('version')}, а нужна {VERSION}"
        raise InputError(Problem(str(path), problem, "обновите kshm"))
    rubric = rubric_of(data.get("rubric") or {}, str(path))
    try:
        books, former = (tuple(map(_issued, data.get(key) or ())) for key in ("books", "former"))
        return Register(str(data["batch"]), int(data["seed"]), str(data["source"]), rubric, books,
                        former, str(data.get("identity", "")))  # fmt: skip
    except (KeyError, TypeError, ValueError):
        raise InputError(_damaged(path)) from None


def _issued(book: dict[str, Any]) -> Issued:
    return Issued(
        int(book["number"]),
        Student(**book["student"]),
        str(book["folder"]),
        str(book["file"]),
        str(book["ticket"]),
        dict(book["drawn"]),
        dict(book["raw"]),
    )


def checked_register(issued: Path, secret_file: Path | None) -> Register:
    """Return the register, proved to be the one that was issued with the secret.

    Raises:
        InputError: it is not.
    """
    register = load_register(issued)
    if not register.books:
        raise InputError(Problem(str(issued), "в реестре нет ни одной работы", "выдайте варианты"))
    register.check(read_secret(secret_path(secret_file)), issued)
    return register


def _damaged(path: Path) -> Problem:
    return Problem(str(path), "это не реестр kshm или он повреждён", "возьмите его копию")
