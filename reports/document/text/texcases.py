r"""TeX of a value given by branches: ``lead \begin{cases} a, & if \\ b, & if \end{cases}``."""

from __future__ import annotations

import re
from collections.abc import Iterable

_CASES = re.compile(r"(.*?)\\begin\{cases\}(.*)\\end\{cases\}", re.DOTALL)


def cases(lead: str, branches: Iterable[tuple[str, str]]) -> str:
    """TeX of a value from its branches, each a formula and the condition of it."""
    body = r" \\ ".join(rf"{formula}, & {condition}" for formula, condition in branches)
    return rf"{lead} \begin{{cases}} {body} \end{{cases}}"


def is_cases(tex: str) -> bool:
    """A formula that is a value given by branches."""
    return _CASES.fullmatch(tex) is not None


def parts(tex: str) -> tuple[str, list[list[str]]]:
    """What stands before the brace, and the cells of each branch behind it."""
    found = _CASES.fullmatch(tex)
    if found is None:
        msg = f"no branches in {tex!r}"
        raise ValueError(msg)
    rows = found[2].split(r"\\")
    return found[1].strip(), [[cell.strip() for cell in row.split("&")] for row in rows]


def apart(tex: str) -> str:
    """The same as lines of their own, without a brace."""
    lead, rows = parts(tex)
    return r" \\ ".join(rf"{lead} " + r"\quad ".join(row) for row in rows)
