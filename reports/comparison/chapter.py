"""The comparison as a chapter of an engine's report: the engines that its file names."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from markupsafe import Markup

from reports.comparison.conclusions import conclusions
from reports.comparison.engines import (
    Chart,
    Difference,
    Row,
    apart,
    charts,
    check_sources,
    differences,
    read_engines,
    results,
)
from reports.exports.build import load_input
from reports.inputs.load import Loaded
from reports.shared.errors import InputError, Problem
from reports.shared.russian import uncapital

if TYPE_CHECKING:
    from reports.document.chapters.chapter import Chapter

KEY = "report.compare"
_FEW = 3  # engines whose columns fit at the usual size of dense tables


def with_others(path: Path, loaded: Loaded) -> Loaded:
    """The input with the files it is compared with among those that were read.

    Raises:
        InputError: one of them is missing or wrong, or there are too many.
    """
    others = _others(path, loaded)
    for other in others:
        load_input(other)
    return replace(loaded, beside=(*loaded.beside, *others))


def _others(path: Path, loaded: Loaded) -> list[Path]:
    names = [name.strip() for name in loaded.model.report.compare.split(";") if name.strip()]
    others = [path.parent / name for name in names]
    for other in others:
        if not other.is_file():
            hint = "укажите файлы от файла исходных данных, через точку с запятой"
            raise InputError(Problem(KEY, f"нет файла {other}", hint))
    if others:
        check_sources([path, *others], where=KEY)
    return others


def comparison_chapters(path: Path, loaded: Loaded) -> tuple[ComparisonChapter, ...]:
    """The chapter of a checked input, none where its file names no other engines.

    Raises:
        InputError: a named file is wrong, or an engine gives no finite result.
    """
    others = _others(path, loaded)
    if not others:
        return ()
    models = [loaded.model, *(load_input(other).model for other in others)]
    engines = read_engines([path, *others], models)
    return (
        ComparisonChapter(
            engines=tuple((e.label, e.model.engine.name, e.source.name) for e in engines),
            differences=differences(engines),
            rows=results(engines),
            charts=charts(engines),
        ),
    )


@dataclass(frozen=True, slots=True)
class ComparisonChapter:
    """What the chapter prints; the first engine is that of the report."""

    engines: tuple[tuple[str, str, str], ...]  # label, name, file
    differences: tuple[Difference, ...]
    rows: tuple[Row, ...]
    charts: tuple[Chart, ...]

    def __call__(self, chapter: Chapter) -> Markup:
        """Set the chapter."""
        from reports.comparison.page import curves_of, data_block, results_block
        from reports.document.page.writer import Figure, TablePlan

        labels = [label for label, *_ in self.engines]
        size = "dense" if len(labels) <= _FEW else "tiny"
        different, only = apart(self.differences, labels)
        shown, lacking = apart(self.rows, labels)
        data = TablePlan(
            partial(data_block, labels, different),
            "Исходные данные, которые не совпадают", size=size, lined=True,
        )  # fmt: skip
        groups: dict[str, list[Row]] = {}
        for row in shown:
            groups.setdefault(row.group, []).append(row)
        tables = [
            (f"compare_{number}",
             TablePlan(partial(results_block, labels, rows), f"Сравнение: {uncapital(group)}",
                       size=size, lined=True))
            for number, (group, rows) in enumerate(groups.items(), 1)
        ]  # fmt: skip
        figures = [
            (f"compare_{chart.key}",
             Figure(partial(curves_of, labels, chart), f"{chart.title}: сравнение двигателей",
                    f"{chart.title}: {', '.join(labels)}"))
            for chart in self.charts
        ]  # fmt: skip
        return chapter.page(
            "comparison",
            engines=self.engines,
            data=data,
            only=only,
            tables=tables,
            lacking=lacking,
            figures=figures,
            sentences=conclusions(labels, self.rows),
        )
