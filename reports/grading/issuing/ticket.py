"""The identifier that ties file, student and variant, and the instructor's secret behind it."""

from __future__ import annotations

import base64
import hashlib
import hmac
import json
import os
import re
import secrets
from pathlib import Path
from typing import Any

from reports.shared.errors import InputError, Problem
from reports.shared.files import reason

ENVIRONMENT = "KSHM_SECRET"
SECRET = "secret.key"
PATTERN = re.compile(r"K[A-Z2-7]{24}")
_LENGTH = 32


def secret_path(given: Path | None) -> Path:
    """Where the secret lies: the key, the environment, else the user's settings."""
    if given is not None:
        return given
    if os.environ.get(ENVIRONMENT):
        return Path(os.environ[ENVIRONMENT])
    home = Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config")
    return home / "kshm" / SECRET


def read_secret(path: Path) -> bytes:
    """The secret.

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
    """The secret of a file, a new one where there is none; InputError if it is none."""
    return read_secret(path) if path.exists() else make_secret(path)


def make_secret(path: Path) -> bytes:
    """A new secret in a file that only its owner can read.

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
        what = f"не удаётся записать секрет: {reason(error)}"
        raise InputError(Problem(str(path), what, hint)) from None
    return secret


def ticket(secret: bytes, *, batch: str, student: str, file: str, variant: Any) -> str:  # noqa: ANN401
    """Identifier of one issued work-book: 120 bits of an HMAC-SHA256 in capital letters."""
    message = json.dumps([batch, student, file, variant], ensure_ascii=False, sort_keys=True)
    digest = hmac.new(secret, message.encode(), hashlib.sha256).digest()
    return "K" + base64.b32encode(digest[:15]).decode("ascii")
