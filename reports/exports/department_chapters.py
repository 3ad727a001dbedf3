"""Whether own books hold together with an engine, and their numbers for other outputs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.nomenclature.quantity import Quantity
from reports.exports import book_faults as faults
from reports.exports.book_chapters import shown, unknown_in_chapters
from reports.exports.book_faults import Own
from reports.exports.book_meanings import compared, misread
from reports.inputs.findings import check_names
from reports.inputs.sections.input_file import InputFile
from reports.inputs.solve_input import POWER, power_problems
from reports.model.chapter_source import BookPlaces, Shelf, shelf_of
from reports.model.contents import contents_of
from reports.model.evaluation import Evaluation
from reports.model.shape import Scope
from reports.shared.errors import BookError, InputError, Problem
from reports.tables.contexts import book_part
from reports.tables.registry import kept_model
from reports.tables.verdicts import Failed, checks_of, failed_of

_MAX_TOLD = 20
# Each kind is asked for where the kinds before have no fault.
_KINDS = (
    faults.repeated, faults.sheets, faults.symbols, faults.odd_words, faults.unknown_in_charts,
    unknown_in_chapters, faults.unknown_names, compared, misread, faults.unfit, faults.infinite,
    shown,
)  # fmt: skip


def refuse_faults(model: InputFile) -> None:
    """Refuse own books in which something is wrong, as far as this engine uses them.

    Raises:
        InputError: a line for each fault: book, line, column, what, how to mend it.
    """
    if not model.books:
        return
    problems = list(_read_faults(model)) or list(check_names(model, _checks_of(model)))
    if problems:
        raise InputError(list(dict.fromkeys(problems))[:_MAX_TOLD])


def read_books(model: InputFile) -> Own:
    """Return the own books of an input as they are read for its engine.

    Raises:
        InputError: everything that cannot be read.
    """
    shelf, scope, lines = shelf_of(model.books), Scope(model), BookPlaces()
    parts = [name for names in contents_of(shelf).parts.values() for name in names]
    problems: list[Problem] = []
    for name in shelf.names:
        if name in parts:
            try:
                book_part(name, scope, lines)
            except BookError as error:
                problems += error.problems
        elif not _serves_others(shelf, name):
            problem = "нет строки place: книгу никто не читает"
            problems += BookError(
                shelf.called(name), 1, 1, problem, "добавьте place after 700"
            ).problems
    if problems:
        raise InputError(problems)
    return Own(kept_model(model), lines, shelf)


def _serves_others(shelf: Shelf, name: str) -> bool:
    return any(f'"{name}.book"' in text for _, text in shelf.texts())


def _read_faults(model: InputFile) -> Iterator[Problem]:
    """Faults of the first kind that has any."""
    try:
        own = read_books(model)
    except InputError as error:
        yield from error.problems
        return
    for kind in _KINDS:
        problems = [fault.problems[0] for fault in kind(own)]
        if problems:
            yield from problems
            return


def _checks_of(model: InputFile) -> set[str]:
    """Names of the checks of own books."""
    return set(checks_of(kept_model(model), department=True))


def failed_engine_checks(model: InputFile, *, every: bool) -> list[Failed]:
    """Return checks that an engine does not pass and does not explain.

    Those of own books, and with ``every`` those of the program.
    """
    if not model.books and not every:
        return []
    failed = failed_of(kept_model(model), department=not every)
    power_remarks = power_problems(model)  # which say more of it
    return [each for each in failed if not (power_remarks and each.key.startswith(POWER))]


@dataclass(frozen=True, slots=True)
class OwnNumbers:
    """Values of own books in units of the tables, with their quantities."""

    scalars: dict[str, tuple[Quantity, float | str]]
    tables: dict[str, dict[str, tuple[Quantity, Array]]]


def own_numbers(model: InputFile) -> OwnNumbers:
    """Return what books give for an engine whose numbers no solver knows; nothing without them."""
    if not model.books and not contents_of().alone:
        return OwnNumbers({}, {})
    built = kept_model(model)
    run = Evaluation(built)
    scalars = {
        key: (node.quantity, run.value(key))
        for key, node in built.scalars.items()
        if key in built.own_nodes and not node.of.startswith("check")
    }
    tables = {
        table.id: {
            column.key: (column.quantity, np.asarray(run.value(f"{table.id}.{column.key}")))
            for column in table.columns
        }
        for table in built.tables.values()
        if any(f"{table.id}.{column.key}" in built.own_nodes for column in table.columns)
    }
    return OwnNumbers(scalars, tables)
