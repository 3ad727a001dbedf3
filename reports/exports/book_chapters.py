"""Mistakes in the chapters that own books say: what they name, show and refer to."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from difflib import get_close_matches

from reports.exports.book_faults import Own
from reports.formula.parse import names
from reports.model.blocks import ScalarTable
from reports.model.chapter_source import BookLine
from reports.model.context import CASE_MARK, DECIMALS, FREE_MARK, MARK
from reports.shared.errors import BookError, FormulaError

TABLE, FIGURE = "table", "figure"
KINDS = {"tab": TABLE, "fig": FIGURE}
_FURTHER = (*KINDS, "beyond", "member")
_CALLED = {TABLE: "таблица", FIGURE: "рисунок"}
_FORMULA = re.compile(r"[\w.]+\s*[,;.]?")
_ODD_MARK = re.compile("⟦[^⟧]*⟧?")


def lines_of(reading: Own) -> Iterator[tuple[str, str, BookLine]]:
    """Kinds and texts of the lines of all chapters, with their places."""
    for chapter in (each for each in reading.model.chapters if not each.name):
        for line in chapter.lines:
            first = replace(line, text=line.text.replace("@", "1"))  # members have alike keys
            text = first.key if line.kind in ("show", "formula") else first.text.strip()
            yield line.kind, text, BookLine(line.book, line.number, first.text)


def kinds_of(reading: Own, key: str) -> list[str]:
    """Whether a name is that of a figure, of a table or of both; the first one is shown."""
    kinds = [FIGURE] if key in reading.model.charts_by_id else []
    return kinds + [TABLE] * any(block.id == key for block in reading.model.blocks)


def unknown_in_chapters(reading: Own) -> Iterator[BookError]:
    """Yield what chapters name and the model has not."""
    yield from _unnamed_members(reading)
    model = reading.model
    for kind, text, line in lines_of(reading):
        if kind == "show" and not kinds_of(reading, text):
            yield reading.fault(line, f"показывать нечего: нет «{text}»",
                            "назовите список, таблицу, сетку или диаграмму", text)  # fmt: skip
        if kind == "formula" and getattr(model.nodes.get(text), "expr", None) is None:
            yield reading.fault(line, f"формулы «{text}» нет",
                            "назовите величину или ТАБЛИЦА.СТОЛБЕЦ", text)  # fmt: skip
        if kind == "formula" and not _FORMULA.fullmatch(line.text.strip()):
            yield reading.fault(line, f"за «{text}» стоит лишнее", f"пишите formula {text}.", text)
        yield from _misstated(reading, line)
        for word, key in MARK.findall(text):
            if word not in _FURTHER and key not in model.scalars and key not in model.fields:
                yield reading.fault(
                    line, f"в тексте нет «{key}»", "назовите величину или исходное", key
                )
            if word in KINDS and KINDS[word] not in kinds_of(reading, key):
                yield _of_another_kind(reading, line, word, key)
        odd = _ODD_MARK.search(FREE_MARK.sub("", CASE_MARK.sub("", MARK.sub("", text))))
        if odd is not None:
            yield reading.fault(line, f"«{odd[0].strip('⟦⟧')}» не разобрано",
                            'пишите {{ val("ИМЯ") }}')  # fmt: skip


def _misstated(reading: Own, line: BookLine) -> Iterator[BookError]:
    """Yield formulas of conditions and of numbers that mean nothing, lists that judge nothing."""
    model = reading.model
    formulas = []
    for word, text, _ in CASE_MARK.findall(line.text):
        lists = (block for block in model.blocks if block.id == text)
        if word == "when":
            formulas.append(text)
        elif word and not any(isinstance(each, ScalarTable) and each.held for each in lists):
            yield reading.fault(line, f"списка с проверками «{text}» нет",
                            "назовите список со словом verdicts", text)  # fmt: skip
    for word, text in FREE_MARK.findall(line.text):
        if word == "src":
            yield from _unknown_sources(reading, line, text.split())
        decimals, _, formula = text.partition(" ")
        if word == "calc":
            formulas.append(formula)
        if word == "calc" and decimals not in DECIMALS:
            yield reading.fault(line, f"знаков у calc «{decimals}», а можно от 0 до 9",
                                'пишите calc("ФОРМУЛА", 2)')  # fmt: skip
    for formula in formulas:
        try:
            unknown = names(formula) - model.nodes.keys() - model.fields.keys()
        except FormulaError as error:
            part = error.fragment
            yield reading.fault(line, f"в формуле не разобрано «{part}»", error.mend, part)
            continue
        for name in sorted(unknown):
            yield reading.fault(line, f"в тексте нет «{name}»", "назовите величину", name)


def _unknown_sources(reading: Own, line: BookLine, keys: list[str]) -> Iterator[BookError]:
    from reports.document.chapters.closing import SOURCES

    for key in keys:
        if key not in SOURCES:
            alike = get_close_matches(key, SOURCES, 1) or list(SOURCES)[:5]
            hint = f"есть, например: {', '.join(alike)}"
            yield reading.fault(line, f"источника «{key}» нет", hint, key)


def _unnamed_members(reading: Own) -> Iterator[BookError]:
    """Yield numbers of members that no line of their chapter puts into words."""
    for chapter in (each for each in reading.model.chapters if not each.name):
        named = {line.text.split(" ")[0] for line in chapter.lines if line.kind == "member"}
        for line in chapter.lines:
            for word, key in MARK.findall(line.text.replace("@", next(iter(named), "1"))):
                if word == "member" and key not in named:
                    yield reading.fault(
                        BookLine(line.book, line.number, line.text), f"член «{key}» не назван",
                        f"допишите строку member {key} СЛОВА",
                    )  # fmt: skip


def _of_another_kind(reading: Own, line: BookLine, word: str, key: str) -> BookError:
    kinds = kinds_of(reading, key)
    if not kinds:
        problem, mend = f"в тексте нет «{key}»", f"назовите то, что глава показывает: show {key}"
    else:
        other = next(each for each, of in KINDS.items() if of in kinds)
        problem, mend = f"«{key}» — {_CALLED[kinds[0]]}", f'пишите {{{{ {other}("{key}") }}}}'
    return reading.fault(line, problem, mend, f'{word}("{key}")')


def shown(reading: Own) -> Iterator[BookError]:
    """Yield what chapters show twice, cannot show, or refer to without showing it."""
    once: dict[str, dict[str, int]] = {"show": {}, "formula": {}}
    for kind, key, line in lines_of(reading):
        if kind not in once:
            continue
        if key in once[kind]:
            mend = f"оставьте одно {kind} (есть на строке {once[kind][key]})"
            yield reading.fault(line, f"«{key}» показано дважды", mend, key)
        once[kind].setdefault(key, line.number)
        chart = reading.model.charts_by_id.get(key) if kind == "show" else None
        if chart is not None and not chart.drawn_by("report"):
            yield reading.fault(line, f"у диаграммы «{key}» нет кривых для записки",
                            "уберите workbook у одной из них", key)  # fmt: skip
    theirs = reading.places.blocks.keys() | reading.places.charts.keys()
    for _, text, line in lines_of(reading):
        for word, key in MARK.findall(text):
            is_shown = key in once["show"] and kinds_of(reading, key)[:1] == [KINDS.get(word)]
            if word in KINDS and key in theirs and not is_shown:
                yield reading.fault(line, f"«{key}» в записке не показано",
                                f"допишите строку show {key}", f'{word}("{key}")')  # fmt: skip
