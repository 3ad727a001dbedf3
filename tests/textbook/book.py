"""The printed tables of the textbook and the comparison with them.

@book{gots2006,
  author    = {Гоц, А. Н.},
  title     = {Кинематика и динамика кривошипно-шатунного механизма поршневых двигателей},
  publisher = {Владим. гос. ун-т},
  address   = {Владимир},
  year      = {2006},
  isbn      = {5-89368-664-0},
}
"""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from kshm import solve
from kshm.engine import Engine
from kshm.solution import Solution
from reports.inputs.convert import to_engine
from reports.inputs.load import load_toml
from reports.resources import samples_dir

DATA = Path(__file__).parent / "data"


@dataclass(frozen=True)
class Cell:
    row: float
    column: str
    printed: str
    ours: float

    @property
    def unit(self) -> float:
        """One unit of the last printed digit."""
        decimals = self.printed.partition(".")[2]
        return 10.0 ** -len(decimals)

    @property
    def deviation(self) -> float:
        """In units of the last printed digit; infinite where the print is no number."""
        try:
            return abs(float(self.printed) - self.ours) / self.unit
        except ValueError:
            return float("inf")

    @property
    def name(self) -> tuple[float, str]:
        return self.row, self.column


def rows_of(table: str) -> list[dict[str, str]]:
    with (DATA / f"{table}.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def cells(
    table: str,
    ours: Mapping[str, Sequence[float]],
    *,
    rename: Mapping[str, str] | None = None,
    rows: Mapping[float, float] | None = None,
) -> Iterator[Cell]:
    """Printed numbers beside ours; ``rename`` and ``rows`` map printed to our keys and angles."""
    angles = [float(angle) for angle in ours["phi_deg"]]
    for printed in rows_of(table):
        label = float(printed["phi_deg"])
        index = angles.index((rows or {}).get(label, label))
        for column, text in printed.items():
            if column == "phi_deg" or column.startswith(("sign", "phi_")):
                continue
            yield Cell(label, column, text, float(ours[(rename or {}).get(column, column)][index]))


def disagreeing(found: Iterator[Cell], units: float) -> tuple[int, set[tuple[float, str]]]:
    """Number of all cells, and the names of those further away than ``units``."""
    listed = list(found)
    return len(listed), {cell.name for cell in listed if not cell.deviation <= units + 1e-9}


def errata(table: str) -> set[tuple[float, str]]:
    """Cells that the errata name as misprints of a table."""
    return {
        (float(row["row"]), row["column"].replace("lambda=", "lambda_"))
        for row in rows_of("errata")
        if row["table"] == table
        and row["row"].isdigit()
        and not row["column"].startswith("sign")
        and row["printed"] != "(missing)"
    }


@lru_cache(maxsize=8)
def solution(sample: str, step_deg: int | None = None) -> Solution:
    """A sample solved, on its own or another grid of angles."""
    engine: Engine = to_engine(load_toml(samples_dir() / f"{sample}.toml").model)
    if step_deg is not None:
        engine = replace(engine, step_deg=step_deg)
    return solve(engine)


def on_grid(labels: Sequence[float], step: float) -> dict[float, float]:
    """Row labels rounded by the print → points of the program's grid below or at them."""
    return {label: float(np.floor(label / step + 0.5) * step) for label in labels}
