"""Explanation of a verdict: formula, precedents and numbers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from reports.formula.excel import compile_formula
from reports.grading.issuing.assignment import Item
from reports.grading.issuing.register import FILE, checked_register
from reports.grading.issuing.rubric import load_rubric
from reports.grading.judging.causes import Causes
from reports.grading.judging.judgement import CARRIED, WORDS, WRONG, Judgement, tolerance
from reports.grading.judging.marking import Marker
from reports.grading.judging.verdicts import judge_all, own_values
from reports.grading.pages.pages import number, rows
from reports.grading.reading.student import StudentBook
from reports.grading.reading.submissions import collect, find_owner
from reports.recalculation.formulas import column_number, render
from reports.recalculation.read import read_grid
from reports.shared.errors import BadBook, InputError, Problem
from reports.shared.russian import short
from reports.workbook.intake import check_data
from reports.workbook.layout import Layout, RowReferences, at_row

_SHOWN = 6


def explain(
    issued: Path | None, file: Path, target: str, rubric: Path | None, secret: Path | None
) -> Iterator[str]:
    """Lines that explain the verdict on ``SHEET!COLUMN`` of a submitted workbook.

    Raises:
        InputError: the file or the column cannot be found or read.
    """
    register = checked_register(issued or _find_issued(file), secret)
    if rubric is not None:
        from dataclasses import replace

        register = replace(register, rubric=load_rubric(rubric))
    if not file.is_file():
        raise InputError(Problem(str(file), "нет такого файла", "проверьте путь"))
    submission = collect(file)[0]
    data = submission.read()
    package = check_data(data, file.name)
    try:
        grid = read_grid(package)
    except BadBook as error:
        raise InputError(Problem(file.name, str(error), "сдайте его заново")) from None
    match = find_owner(register, submission, grid, package)
    if match.book is None:
        raise InputError(Problem(file.name, "; ".join(match.doubts), "проверьте файл"))
    marker = Marker(register)
    student = marker.student(match.book, grid, package)
    item = _find_item(student, target)
    response = marker.response(student)
    judgements = judge_all(student, response).judgements
    judgement = next(j for j in judgements if j.item is item)
    yield f"Студент: {match.book.student.full}, вариант {match.book.number}"
    yield "Основание: " + "; ".join(match.evidence)
    others = marker.others(match.book.number)
    titles = marker.titles(student.assignment)
    causes = Causes(student, others, titles, response=response, judgements=judgements)
    yield from _about(student, item, judgement, causes)


def _find_issued(file: Path) -> Path:
    """Return the nearest folder with a register: here, beside the file or above it."""
    for folder in (Path(), *file.resolve().parents):
        for candidate in (folder, folder / "issued"):
            if (candidate / FILE).is_file():
                return candidate
    problem = "не найден реестр выдачи"
    raise InputError(Problem(str(file), problem, "укажите папку выдачи первым аргументом"))


def _find_item(student: StudentBook, target: str) -> Item:
    """Return item under ``SHEET!COLUMN``: a letter, a header's symbol, a cell or an item's id."""
    sheet, _, column = target.rpartition("!")
    address = column.strip().replace("$", "")
    items = student.assignment.items
    for item in items:
        if target in (item.id, *item.nodes):
            return item
    letters = address.rstrip("0123456789")
    digits = address[len(letters) :]
    at = column_number(letters) if letters.isascii() and letters.isalpha() else 0
    hits = []
    for item in items:
        for node in item.nodes:
            location = student.placement.places.get(node)
            if location is None or location.sheet.casefold() != sheet.strip("'").casefold():
                continue
            by_cell = location.column == at and (not digits or int(digits) in location.rows)
            if by_cell or address in (item.symbol, item.quantity.header):
                hits.append(item)
                break
    if not hits:
        hint = "пример: «П3.1!D», «Массы!C9» или «P3_1.s_mm»"
        raise InputError(Problem(target, "такого заполняемого столбца в книге нет", hint))
    return hits[0]


def _about(student: StudentBook, item: Item, judgement: Judgement, causes: Causes) -> Iterator[str]:
    assignment = student.assignment
    unit = f", {item.quantity.unit_label}" if item.quantity.unit_label else ""
    yield f"Столбец: {item.id} — {item.symbol}{unit}, {item.title}"
    for node in item.nodes[:1]:
        location = student.placement.places.get(node)
        if location is not None:
            how = "по определённому имени" if location.by == "name" else "по заголовку"
            yield f"Где: лист «{location.sheet}», найдено {how}"
        yield f"Формула учебника ({item.source or 'без номера'}): {_textbook(student, node)}"
        for run in student.runs(node)[:_SHOWN]:
            text = (
                render(run.formula.pattern, run.first, run.column)
                if run.formula
                else "=" + run.text
            )
            yield f"Формула студента, строки {run.first}–{run.last}: {text[:300]}"
    precedents = frozenset().union(*(student.precedents(node) for node in item.nodes))
    names = ", ".join(sorted(precedents)) or "ни на одну величину книги"
    yield f"Ссылается на: {names}"
    for name in sorted(precedents):
        answer = student.answers.get(name)
        if answer is not None:
            right = np.ravel(np.asarray(student.expected.value(name), dtype=object))
            pair = f"{number(float(answer.values[0]))} при правильном {_value(right[0])}"
            yield f"  {name}: у студента {pair} (первая строка)"
    allowed = tolerance(item, judgement.expected, student)
    printed = short(10.0**-item.quantity.digits.decimals)
    yield f"Допуск: {number(allowed)} (округление учебника {printed})"
    carried = judgement.verdict == CARRIED
    mine = own_values(item, student, judgement.precedents - set(item.nodes)) if carried else None
    for index in _rows_to_show(judgement):
        value = mine[index] if mine is not None else None
        line = (
            f"  {item.labels[index] or 'значение'}: у студента {number(judgement.values[index])}, "
            f"правильно {number(judgement.expected[index])}"
        )
        yield line + (f", по его предыдущим значениям {number(value)}" if value is not None else "")
    yield f"Вердикт: {WORDS[judgement.verdict]}"
    if judgement.reason:
        yield f"Пояснение: {judgement.reason}"
    if judgement.origins:
        yield "Откуда: " + ", ".join(judgement.origins)
    if carried:
        yield "Почему перенос: при других исходных данных его формула даёт правильный столбец"
    if judgement.typed:
        yield "Числа вместо формул: " + rows([item.labels[i] for i in judgement.typed])
    if judgement.verdict == WRONG:
        yield f"Вероятная причина: {causes.find(judgement) or 'обычные ошибки не подходят'}"
    yield f"Баллы за столбец: {number(assignment.points[item.id])} при верном ответе"


def _rows_to_show(judgement: Judgement) -> list[int]:
    rows = list(judgement.rows) or list(range(len(judgement.values)))
    return rows[:_SHOWN]


def _value(value: object) -> str:
    return number(float(value)) if isinstance(value, (int, float)) else str(value)


def _textbook(student: StudentBook, node: str) -> str:
    text = student.assignment.graph.expression(node)
    if text is None:
        return "—"
    layout: Layout = student.layout
    table = student.assignment.model.tables.get(node.partition(".")[0]) if "." in node else None
    formula = compile_formula(text, RowReferences(layout, table))
    return at_row(formula, layout.rows_of(table)[0]) if table is not None else formula
