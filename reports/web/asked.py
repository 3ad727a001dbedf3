"""What a request says, checked before anything else looks at it."""

from __future__ import annotations

import json
from typing import Any

from starlette.requests import Request

from reports.shared.errors import InputError, Problem


async def body(request: Request) -> dict[str, Any]:
    """The JSON object of a request.

    Raises:
        InputError: it is none.
    """
    try:
        found = json.loads(await request.body(), parse_constant=_no_number)
    except (ValueError, RecursionError):
        raise InputError(Problem("", "запрос не читается", "обновите страницу")) from None
    if not isinstance(found, dict):
        raise InputError(Problem("", "запрос не читается", "обновите страницу"))
    return found


def _no_number(_: str) -> Any:  # noqa: ANN401
    raise ValueError


def mapping(data: dict[str, Any], key: str) -> dict[str, Any]:
    """A mapping within a request.

    Raises:
        InputError: there is none.
    """
    found = data.get(key)
    if not isinstance(found, dict):
        raise InputError(Problem(key, "нет исходных данных", "обновите страницу"))
    return found


def visitor(request: Request) -> str:
    """Who orders: a browser by its cookie, else an address."""
    return request.cookies.get("kshm", "")[:64] or (request.client.host if request.client else "")
