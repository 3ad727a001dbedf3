"""Books with the names that their subject alone has: members of grids and of repeated tables."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from kshm.cycle.fuel import FUELS, SPECIES, TEMPERATURE_PASSES
from kshm.cycle.governor import GOVERNOR_IRREGULARITY, IDLE_FUEL_SHARE
from kshm.cycle.processes import N1_PASSES, N1_START, N2_PASSES, N2_START
from kshm.cycle.speed_characteristic import IDLE_SHARE, LEIDERMAN
from kshm.defaults import (
    FINE_STEP,
    FLYWHEEL_DISC_SHARE,
    FLYWHEEL_STROKES,
    OUTER_SHARE,
    SKIRT_SHARE,
)
from kshm.engine.flywheel import DENSITIES, RIM_SPEEDS
from kshm.mechanics.journals import PLANES
from kshm.ranges import (
    MASSES_BORES,
    MASSES_STROKE_BORE,
    PISTON_MASSES,
    RANGES,
    ROD_MASSES,
    THROW_MASSES,
    hull,
)
from reports.inputs.sections.gas import PUMPING, ROUNDINGS, RoundedGasSection
from reports.inputs.sections.input_file import METHODS
from reports.inputs.solve_input import MAX_POWER_ERROR
from reports.inputs.to_si.engine import places
from reports.inputs.to_si.masses import PIN_SHARE, ROD_SHARE, to_estimate
from reports.inputs.units import MM, number_text
from reports.model.blocks import nodes_in
from reports.model.chapter_reader import read_book
from reports.model.chapter_source import BookLine, BookPlaces, shelf_of
from reports.model.contents import contents_of
from reports.model.context import names_of
from reports.model.shape import Part, Scope, pin_figure, pin_name, pin_table, rays_table
from reports.tables.cycle_members import ranges_of, section_of, sizes_are_found
from reports.tables.oil_members import oil_names, safety_names
from reports.tables.strength_members import strength_names
from reports.tables.torsion_members import torsion_names

Bounds = tuple[float, float]
_SHARE = RANGES["rod_share"].of()
USUAL_SHARE = f"доля массы шатуна на поршневом пальце {'…'.join(map(number_text, _SHARE))}"
_CANCELLED = 1e-6  # of a vector sum of unit vectors


def is_usual_share(name: str) -> str:
    """Expression that tells whether the share of that name is usual, its ends included."""
    low, high = _SHARE
    return f"round({name}, 6) >= {low:g} and round({name}, 6) <= {high:g}"


@dataclass(frozen=True, slots=True)
class Surface:
    """A journal's surface in the wear diagrams; forces as columns of its table."""

    table: str
    number: str
    which: str  # which sheet of its kind
    name: str
    of: str  # which one, in the genitive's end
    size: str
    up: str
    against: str
    is_pin: bool
    chart: str
    journal: tuple[str, int]  # how the input names its sizes


def _surfaces(scope: Scope) -> dict[str, Any]:
    shape = scope.shape
    several = len(shape.pins) > 1
    pins = [
        Surface(
            rays_table(n), "14" if n == 1 else f"14.Ш{n}",
            "" if n == 1 else f" ({n})", f"pin{pin_name(n)}",
            f" {n}" if several else "", f"{pin_table(n)}.Rpin_MPa", f"-{pin_table(n)}.Krod_MPa",
            f"-{pin_table(n)}.T_MPa", True, pin_figure("fig52", n),
            ("pin", shape.throw_of(shape.pins[n - 1][0])),
        )
        for n in shape.pin_numbers
    ]  # fmt: skip
    mains = [
        Surface(
            f"table_14_main_{k}", f"14.{k}", f" ({k})", f"main{k}", f" {k}",
            f"P4_3_{k}.R_MPa", f"P4_3_{k}.Ry_MPa", f"P4_3_{k}.Rx_MPa", False, f"fig54_{k}",
            ("main", k),
        )
        for k in shape.journal_numbers
    ]  # fmt: skip
    return {"surfaces": [*pins, *mains]}


def _torque_orders(scope: Scope) -> dict[str, Any]:
    """Whether the second orders of the cylinders' torques do not cancel each other."""
    turns = [math.radians(2 * offset) for offset in scope.input.crankshaft.firing_offsets_deg]
    together = math.hypot(sum(map(math.cos, turns)), sum(map(math.sin, turns)))
    return {"second_order": together > _CANCELLED}


def _cycle(scope: Scope) -> dict[str, Any]:
    """Data of the cycle: its fuel, heat capacities, passes, words, law of speed, usual ranges."""
    section = section_of(scope.input)
    if section is None:
        return {}
    return {
        "fuel": FUELS.get(section.fuel),
        "heats": SPECIES,
        "passes": {"n1": N1_PASSES, "n2": N2_PASSES, "tz": TEMPERATURE_PASSES},
        "starts": {"n1": N1_START, "n2": N2_START},
        "sizes_found": sizes_are_found(scope.input),
        "words": {"subtract": PUMPING["yes"], "up": ROUNDINGS["up"]},
        "law": LEIDERMAN[section.speed_law or section.kind],
        "idle_share": IDLE_SHARE[section.kind],
        "governor": (GOVERNOR_IRREGULARITY, IDLE_FUEL_SHARE),
        "ranges": tuple(ranges_of(section)),
    }


def _summary(scope: Scope) -> dict[str, Any]:
    return {
        "usual_share": USUAL_SHARE,
        "is_usual_share": is_usual_share,
        "power_gap": MAX_POWER_ERROR,
        "lam_limits": RANGES["lam"].doubtful[""],
        "lam_usual": RANGES["lam"].of(),
        **_surfaces(scope),
    }


@dataclass(frozen=True, slots=True)
class Table4:
    """Bounds of table 4, masses of the parts over the piston's area [kg/m²]."""

    piston: Bounds
    rod: Bounds
    throw: Bounds


def _table_4(scope: Scope) -> dict[str, Any]:
    """Bounds for the kind of engine, and those between which the estimate is made."""
    masses, cycle = scope.input.masses, scope.input.cycle
    kind = masses.estimate_fuel or (cycle.kind if cycle is not None else None)
    fuels = ("petrol", "diesel") if kind is None else (kind,)
    names: dict[str, Any] = {
        "usual": Table4(
            hull(
                PISTON_MASSES[material, fuel]
                for material in ("aluminium", "iron")
                for fuel in fuels
            ),
            hull(ROD_MASSES[fuel] for fuel in fuels),
            hull(THROW_MASSES[shaft, fuel] for shaft in ("steel", "iron") for fuel in fuels),
        ),
        "usual_share": USUAL_SHARE,
        "is_usual_share": is_usual_share,
        "rod_share": ROD_SHARE,
    }
    estimate = to_estimate(masses)
    if estimate is None:
        return names
    fuel, material, shaft = estimate.fuel, estimate.piston_material, estimate.shaft
    return names | {
        "estimate": Table4(
            PISTON_MASSES[material, fuel], ROD_MASSES[fuel], THROW_MASSES[shaft, fuel]
        ),
        "bores_mm": tuple(map(MM.from_si, MASSES_BORES[fuel])),
        "stroke_bore": MASSES_STROKE_BORE,
        "pin_share": PIN_SHARE,
    }


def _cylinders(scope: Scope) -> dict[str, Any]:
    """Cylinders after the first, then all in the phases that reproduce the printed П4.3."""
    numbers = scope.shape.numbers
    forced = [(i, True) for i in numbers] if scope.forced else []
    return {"shifted": [*((i, False) for i in numbers[1:]), *forced], "exact": METHODS["exact"]}


def _rounded(scope: Scope) -> dict[str, Any]:
    """Places of a rounded diagram that a file need not give."""
    gas = scope.input.gas
    if not isinstance(gas, RoundedGasSection):
        return {}
    share, peak, join = places(gas)
    return {"usual_share": share, "usual_peak": peak, "usual_join": join}


# Names that one book has besides the common ones.
_OF_BOOK: dict[str, Callable[[Scope], dict[str, Any]]] = {
    "bearings": lambda _: {"planes": PLANES},
    "counterweight": lambda _: {"skirt_share": SKIRT_SHARE, "outer_share": OUTER_SHARE},
    "cylinders": _cylinders,
    "flywheel": lambda _: {
        "densities": DENSITIES,
        "speeds": RIM_SPEEDS,
        "strokes": FLYWHEEL_STROKES,
        "disc_share": FLYWHEEL_DISC_SHARE,
    },
    "fine": lambda _: {"exact": METHODS["exact"]},
    "gas": _rounded,
    "cycle": _cycle,
    "cycle_results": _cycle,
    "cycle_speed": _cycle,
    "cycle_text": _cycle,
    "inertia": lambda _: {"fine_step": FINE_STEP},
    "oil": oil_names,
    "rod_masses": _table_4,
    "safety": safety_names,
    "strength": strength_names,
    "summary": _summary,
    "torque_orders": _torque_orders,
    "torsion": torsion_names,
    "wear": _surfaces,
}


def book_part(
    book: str, scope: Scope, lines: BookPlaces | dict[str, BookLine] | None = None
) -> Part:
    """Blocks and charts of a book; ``lines`` takes the lines of what it says.

    A book that replaces one of the house has the names of that subject.
    """
    further = _OF_BOOK.get(book)
    names = names_of(scope, **(further(scope) if further else {}))
    return read_book(f"{book}.book", names, shelf_of(scope.input.books).of_book(book), lines)


def books(scope: Scope, names: Iterable[str]) -> Part:
    """Blocks and charts of books of the house, one after another."""
    shelf = shelf_of(scope.input.books)
    names, theirs = tuple(names), shelf.names
    alone = {*theirs, *contents_of(shelf).alone}
    parts = [book_part(name, scope) for name in names]
    nodes = {name: frozenset(key for block in part.blocks for key, _ in nodes_in(block))
             for name, part in zip(names, parts, strict=True)
             if name in alone}  # fmt: skip
    return Part(
        tuple(block for part in parts for block in part.blocks),
        tuple(chart for part in parts for chart in part.charts),
        tuple(chapter for part in parts for chapter in part.chapters),
        frozenset().union(*nodes.values()),
        frozenset().union(*(keys for name, keys in nodes.items() if name in theirs)),
    )
