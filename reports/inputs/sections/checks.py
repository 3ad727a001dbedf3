"""The [checks] section of the input file: what is odd about it and meant so."""

from __future__ import annotations

from typing import Annotated

from pydantic import Strict

from reports.inputs.meta import Strictly, text

# Checks of the calculation, besides the keys of the file that `check` warns of.
CHECKS = (
    "closure", "work", "grid", "lam", "phases", "symmetry", "cycle_rho", "cycle_pz", "cycle_Tr",
    "power", "share",
)  # fmt: skip


class Accepted(Strictly):
    """[[checks.accepted]]: a check or a key, and why its failure or oddity is right."""

    what: str = text("Принято {n}: проверка или ключ")
    reason: str = text("Принято {n}: причина")


class ChecksSection(Strictly):
    """[checks]."""

    accepted: Annotated[tuple[Accepted, ...], Strict(False)]
