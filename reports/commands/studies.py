"""Commands about many numbers at once: comparison with the sources, parameter studies."""

from __future__ import annotations

from pathlib import Path

import click

from reports.commands.common import (
    DONE,
    HELP,
    LOOK,
    MISSING,
    RussianCommand,
    csv_options,
    dask_option,
    file_argument,
    load,
    path_option,
    tell_written,
    verbose_option,
)
from reports.shared.errors import KshmError


@click.command(cls=RussianCommand, context_settings=HELP)
@path_option("-o", "--output", "folder", default=Path(),
              help="Папка для результатов (по умолчанию текущая).")  # fmt: skip
@click.option(
    "--only", type=click.Choice(["csv", "html", "pdf"]), multiple=True,
    help="Только этот вид документа; можно повторить.",
)  # fmt: skip
@verbose_option
def validate(folder: Path, only: tuple[str, ...]) -> int:
    """Пересчитать печатные таблицы источников и показать, что с ними сходится."""
    from reports.studies.validation_page import KINDS, write

    book, files, missing = write(folder, only or KINDS)  # type: ignore[arg-type]
    for path in files:
        click.echo(f"{path}")
    counts = book.counts
    click.echo(f"чисел: {counts.total}, совпадает: {counts.agrees}")
    if missing:
        click.echo(missing, err=True)
        return MISSING
    if counts.needs_a_person:
        first = book.new[0]
        where = ", ".join(filter(None, (first.table.place, first.cell.row, first.cell.column)))
        click.echo(
            f"Новых отклонений: {len(book.new)}, первое: {where}: {first.reason}; посмотрите "
            "строки «новое отклонение», запишите причину в errata.csv или исправьте расчёт",
            err=True,
        )
        return LOOK
    return DONE


@click.command(cls=RussianCommand, context_settings=HELP)
@file_argument("БАЗА")
@click.option(
    "--vary",
    multiple=True,
    metavar="КЛЮЧ=ОТ:ДО:N",
    help="Ключ файла и N значений, например geometry.bore_mm=84:92:9; можно не один.",
)
@click.option(
    "--quantity",
    "quantities",
    multiple=True,
    metavar="ИМЯ",
    help="Величина: M_mean или столбец P4_1.N_MPa (по умолчанию основные).",
)
@click.option(
    "--tolerance", "tolerances", multiple=True, metavar="КЛЮЧ=Т",
    help="Вместо --vary: разброс результатов при допуске ±Т, например bore_mm=0.02.",
)  # fmt: skip
@click.option("--samples", default=1000, metavar="ЧИСЛО",
              help="Двигателей в выборке с --tolerance (по умолчанию 1000).")  # fmt: skip
@click.option(
    "--pairwise", is_flag=True, help="Первое с первым, второе со вторым, а не все со всеми."
)
@path_option(
    "-o",
    "--output",
    "target",
    required=True,
    metavar="ФАЙЛ",
    help="Файл .parquet, .csv или .xlsx (с диаграммами).",
)
@click.option("--jobs", default=0, metavar="ЧИСЛО", help="Число процессов (по умолчанию все ядра).")
@click.option("--resume", is_flag=True, help="Продолжить прерванное исследование.")
@csv_options
@dask_option
@verbose_option
def sweep(
    source: Path, vary: tuple[str, ...], quantities: tuple[str, ...], pairwise: bool,
    target: Path, jobs: int, dask: str | None, resume: bool, tolerances: tuple[str, ...],
    samples: int, **form: bool,
) -> int:  # fmt: skip
    """Исследовать параметры: наибольшие и средние значения при всех сочетаниях.

    Первый ключ меняется быстрее всех; по нему строятся диаграммы, по второму — семейство
    кривых. Сочетание, которое не проходит проверку, остаётся строкой с причиной.
    """
    from reports.exports.numbers import CsvForm
    from reports.studies.sweep import SweepOptions
    from reports.studies.sweep import sweep as run_sweep

    if jobs < 0:
        raise KshmError("--jobs не может быть отрицательным")
    if tolerances and (vary or dask or resume or pairwise):
        raise KshmError("--tolerance исключает --vary, --pairwise, --resume и --dask")
    if not tolerances and not vary:
        raise KshmError("нужен ключ --vary, пример: --vary geometry.bore_mm=84:92:9")
    if tolerances:
        from reports.commands.seek import scatter

        return scatter(source, tolerances, quantities, target, samples, jobs or 1)
    done = run_sweep(
        source, vary, target, quantities=quantities, pairwise=pairwise,
        options=SweepOptions(jobs=jobs, dask=dask, form=CsvForm(**form), resume=resume),
    )  # fmt: skip
    tell_written(target, f": сочетаний {done.points}")
    if done.failed:
        click.echo(f"Без результата: {done.failed}, например: {done.first_error}", err=True)
        return LOOK
    return DONE


@click.command(cls=RussianCommand, context_settings=HELP)
@click.argument(
    "sources", metavar="ФАЙЛ...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@path_option(
    "-o",
    "--output",
    "target",
    required=True,
    metavar="ФАЙЛ",
    help="Файл .xlsx, .pdf, .html, .csv или .json.",
)
@verbose_option
def compare(sources: tuple[Path, ...], target: Path) -> int:
    """Сравнить двигатели: данные, результаты, диаграммы и выводы рядом.

    От двух до шести файлов .toml или книг; проценты — отличие от первого.
    """
    from reports.studies.comparison import check_sources
    from reports.studies.comparison_page import check_suffix, write

    check_suffix(target)
    check_sources(sources, target)
    write(sources, [load(source).model for source in sources], target)
    tell_written(target, f": двигателей {len(sources)}")
    return DONE
