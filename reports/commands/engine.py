"""Commands for one engine: new, check, solve, build, doctor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from reports.commands.common import (
    BAD,
    DONE,
    HELP,
    LOOK,
    MISSING,
    RussianCommand,
    csv_options,
    dask_option,
    file_argument,
    load,
    notes_of,
    number_option,
    path_option,
    tell,
    tell_next,
    tell_solved,
    tell_written,
    verbose_option,
)
from reports.shared.errors import KshmError

if TYPE_CHECKING:
    from kshm.nomenclature.quantity import Quantity
    from reports.grading.reading.selfcheck import BookFinding
    from reports.inputs.load import Loaded


@click.command(cls=RussianCommand, context_settings=HELP)
@path_option("-o", "--output", help="Куда записать (иначе на экран).")
@click.option("--sample", metavar="ИМЯ", help="Взять за основу образец, например gots-diesel.")
@path_option("--from", "base", metavar="ФАЙЛ", help="Вариант этого двигателя по подобию.")
@path_option("--book", metavar="ФАЙЛ", help="Заготовка своей книги расчёта, насос.book.")
@click.option("--cylinders", type=int, metavar="ЧИСЛО", help="Число цилиндров, от 1 до 12.")
@click.option("--layout", type=click.Choice(["inline", "v", "opposed"]),
              help="Рядный, V-образный или оппозитный.")  # fmt: skip
@click.option("--strokes", type=click.Choice(["4", "2"]), help="Тактность.")
@click.option("--fuel", "--kind", "kind", type=click.Choice(["diesel", "petrol"]),
              help="Дизель или с искровым зажиганием.")  # fmt: skip
@click.option("--strength", is_flag=True, help="Добавить прочность деталей с обычными размерами.")
@click.option("--cycle", is_flag=True, help="Давления из рабочего цикла, подобранного по мощности.")
@number_option("--power", "power_kw", "кВт", "Эффективная мощность, кВт.")
@number_option("--speed", "speed_rpm", "МИН⁻¹", "Частота вращения, мин⁻¹.")
@number_option("--bore", "bore_mm", "ММ", "Диаметр цилиндра, мм.")
@number_option("--stroke", "stroke_mm", "ММ", "Ход поршня, мм.")
@number_option("--rod", "rod_mm", "ММ", "Длина шатуна, мм.")
@number_option("--lambda", "lambda_", "ЧИСЛО", "Отношение радиуса кривошипа к длине шатуна.")
@number_option("--compression", "compression", "ЧИСЛО", "Степень сжатия.")
@number_option("--efficiency", "efficiency", "ЧИСЛО", "Механический КПД.")
@verbose_option
def new(
    output: Path | None,
    base: Path | None,
    book: Path | None,
    **options: Any,  # noqa: ANN401
) -> int:
    """Дать файл исходных данных с пояснениями.

    С ключом --cylinders — свой двигатель: что задано ключами, то в нём и стоит, остальное из
    обычных значений, давления подобраны по мощности. Вместе с --from — вариант данного
    двигателя с другим числом цилиндров.
    """
    from reports.commands.new_engine import new_book, new_text
    from reports.shared.files import is_stream, write_text

    base_model = None if base is None else (str(base), lambda: load(base).model)
    if book is None:
        text = new_text(base_model, **options)
    else:
        text, output = new_book(book, [*options.values(), base, output]), book
    if output is None:
        click.echo(text, nl=False)
        return DONE
    if output.exists() and not is_stream(output):
        raise KshmError(f"{output}: файл уже есть; укажите другое имя ключом -o или удалите его")
    if book is None and not is_stream(output):
        from reports.inputs.schema import LINE, write_beside

        text = f"#{LINE}\n{text}"
        write_beside(output)
    write_text(output, text)
    tell_written(output)
    tell_next("check", output)
    return DONE


@click.command(cls=RussianCommand, context_settings=HELP)
@click.argument("source", metavar="[ФАЙЛ]", required=False, type=click.Path(path_type=Path))
@path_option("-o", "--output", help="Куда записать (иначе на экран).")
@verbose_option
def schema(source: Path | None, output: Path | None) -> int:
    """Дать схему файла исходных данных (JSON Schema): редактор подскажет и проверит ключи.

    У файла со своими книгами расчёта в схеме есть и их ключи.
    """
    from reports.inputs.schema import schema_text
    from reports.shared.files import write_text

    text = schema_text(() if source is None else load(source).model.books)
    if output is None:
        click.echo(text, nl=False)
    else:
        write_text(output, text)
        tell_written(output)
    return DONE


def _with_named(source: Path, loaded: Loaded, *, whole: bool = False) -> Loaded:
    """Check that templates and engines named by an input exist, and that own books are built.

    ``whole`` tries documents that the command does not make itself.
    """
    report = loaded.model.report
    if report.templates:
        from reports.exports.build import find_templates

        find_templates(source, loaded)
    if report.compare:
        from reports.studies.comparison_page import with_others

        loaded = with_others(source, loaded)
    if loaded.model.books:
        from reports.exports.book_trial import refuse_unbuilt

        refuse_unbuilt(loaded.model, whole=whole)
    return _with_prototype(source, loaded)


def _with_prototype(source: Path, loaded: Loaded) -> Loaded:
    """Check the prototype's file and keep it from being written over."""
    if loaded.model.prototype is None:
        return loaded
    from reports.inputs.load import load_toml
    from reports.inputs.reasons import prototype_file

    other = prototype_file(loaded.model, source.parent)
    if other is None:
        return loaded
    load_toml(other)
    return replace(loaded, beside=(*loaded.beside, other))


def _chapters(source: Path, loaded: Loaded) -> Sequence[Any]:
    """Further chapters of an input's report."""
    if not loaded.model.report.compare:
        return ()
    from reports.studies.comparison_page import comparison_chapters

    return comparison_chapters(source, loaded)


@click.command(cls=RussianCommand, context_settings=HELP)
@file_argument()
@click.option("--json", "as_json", is_flag=True, help="Результат проверки в JSON.")
@verbose_option
def check(source: Path, as_json: bool) -> int:
    """Проверить исходные данные, не делая документов; рабочую книгу — перед сдачей.

    Свою книгу расчёта (.book) проверяет на образцах.
    """
    import json

    from reports.exports.build import BOOKS, load_input
    from reports.shared.errors import InputError, Problem

    if source.suffix.lower() == ".book":
        from reports.exports.book_trial import check_alone

        for remark in check_alone(source):
            click.echo(remark)
        return DONE
    if source.suffix.lower() == ".zip":
        from reports.grading.reading.selfcheck import findings_in_archive

        return _tell_findings(source, findings_in_archive(source), as_json=as_json)
    if source.suffix.lower() in BOOKS:
        from reports.grading.reading.selfcheck import findings, is_work_book

        if is_work_book(source):
            return _tell_findings(source, findings(source), as_json=as_json)
    try:
        loaded = _with_named(source, load_input(source), whole=True)
        problems: tuple[Any, ...] = ()
        warnings, accepted = loaded.warnings, loaded.accepted
        if as_json:
            from reports.exports.department_chapters import failed_engine_checks
            from reports.inputs.solve_input import power_problems

            failed = (
                Problem("", each.line()) for each in failed_engine_checks(loaded.model, every=True)
            )
            warnings = (*warnings, *power_problems(loaded.model), *failed)
    except InputError as error:
        if not as_json:
            raise
        problems, warnings, accepted = error.problems, (), ()
    if as_json:
        data = {
            "ok": not problems,
            "errors": [_as_dict(problem) for problem in problems],
            "warnings": [_as_dict(problem) for problem in warnings],
        }
        notes = () if problems else (*loaded.notes, *notes_of(loaded))
        if notes:
            data["notes"] = list(notes)
        if accepted:
            data["accepted"] = [
                _as_dict(item.problem) | {"reason": item.reason} for item in accepted
            ]
        click.echo(json.dumps(data, ensure_ascii=False, indent=1))
        return BAD if problems else (LOOK if warnings else DONE)
    tell(loaded, source)
    click.echo(f"{source}: ошибок нет")
    odd = tell_solved(loaded, every=True)
    tell_next("build", source)
    return LOOK if warnings or odd else DONE


def _as_dict(problem: Any) -> dict[str, str]:  # noqa: ANN401
    return {"where": problem.where, "what": problem.what, "hint": problem.hint}


def _tell_findings(source: Path, findings: Sequence[BookFinding], *, as_json: bool) -> int:
    """Print the findings of a self-check."""
    import json

    if as_json:
        data = {"ok": not findings, "findings": [asdict(item) for item in findings]}
        click.echo(json.dumps(data, ensure_ascii=False, indent=1))
    else:
        for item in findings:
            click.echo(f"{item.where}: {item.what}")
        click.echo(f"{source}: замечаний {len(findings)}; верны ли значения, здесь не проверяется")
    return LOOK if findings else DONE


@click.command(cls=RussianCommand, context_settings=HELP)
@file_argument()
@path_option("--csv", "folder", help="Папка для таблиц CSV.")
@click.option("--json", "target", metavar="ФАЙЛ", help="Файл JSON; «-» — на экран.")
@csv_options
@verbose_option
def solve(source: Path, folder: Path | None, target: str | None, **form: bool) -> int:
    """Посчитать числа без документов."""
    from kshm.nomenclature.quantity import quantity
    from reports.exports.department_chapters import own_numbers
    from reports.exports.numbers import CsvForm, csv_text, export_tables, json_text
    from reports.inputs.solve_input import solved
    from reports.inputs.to_si.engine import smallness_of
    from reports.shared.files import refuse_own, write_together

    style = CsvForm(**form)
    loaded = load(source)
    own = (source, *loaded.beside)
    if target is not None and target != "-":
        refuse_own([Path(target)], own)
    solution, theirs = solved(loaded.model), own_numbers(loaded.model)
    files: dict[Path, bytes] = {}
    if folder is not None:
        files = {
            folder / f"{name}.csv": csv_text(columns, style).encode(style.encoding)
            for name, columns in export_tables(solution, theirs).items()
        }
        refuse_own(files, own)
    if target is not None:
        text = json_text(loaded.model, solution, notes_of(loaded), theirs)
        if target != "-":
            files[Path(target)] = text.encode()
    write_together(files)
    if folder is not None:
        click.echo(folder)
    if target == "-":
        click.echo(text, nl=False)
    elif target is not None:
        tell_written(Path(target))
    wordless = folder is not None or target is not None
    if not wordless:
        small = smallness_of(loaded.model)
        quantities = {key: (quantity(key, small), each) for key, each in solution.scalars.items()}
        _print_summary({**quantities, **theirs.scalars})
    tell_solved(loaded, aside=wordless)
    return DONE


def _print_summary(scalars: Mapping[str, tuple[Quantity, float | str]]) -> None:
    from reports.shared.russian import written

    for key, (measure, value) in scalars.items():
        if key.startswith("throw"):
            continue
        text = value if isinstance(value, str) else written(value, measure.digits)
        gap = "" if measure.unit_label == "°" else " "
        click.echo(f"{measure.title}: {measure.symbol} = {text}{gap}{measure.unit_label}".rstrip())


@click.command(cls=RussianCommand, context_settings=HELP)
@click.argument(
    "sources", metavar="ФАЙЛ...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@path_option(
    "-o",
    "--output",
    "folder",
    default=Path(),
    help="Папка для результатов (по умолчанию текущая).",
)
@click.option(
    "--only", type=click.Choice(["xlsx", "pdf", "html", "docx", "sheet", "live"]), multiple=True,
    help="Только этот вид документа; можно повторить.",
)  # fmt: skip
@path_option("--style", metavar="ФАЙЛ", help="Оформление отчёта: файл кафедры .toml.")
@dask_option
@verbose_option
def build(
    sources: tuple[Path, ...],
    folder: Path,
    only: tuple[str, ...],
    style: Path | None,
    dask: str | None,
) -> int:
    """Сделать книгу Excel, отчёт PDF и другое по файлу .toml или по изменённой книге."""
    from reports.exports.build import build_each, find_templates

    inputs = [(source, _with_named(source, load(source))) for source in sources]
    for source, loaded in inputs:
        find_templates(source, loaded, style)
    code = LOOK if any(loaded.warnings for _, loaded in inputs) else DONE
    for built in build_each(inputs, folder, only, dask, _chapters, style):  # type: ignore[arg-type]
        for path in built.files:
            click.echo(f"{path}")
        for line in built.failed:
            click.echo(f"Внимание: {line}", err=True)
            code = max(code, LOOK)
        for line in built.weak:
            click.echo(line, err=True)
        if built.missing is not None:
            for line in built.missing.lines():
                click.echo(line, err=True)
            code = MISSING
    return code


@click.command(cls=RussianCommand, context_settings=HELP)
@verbose_option
def doctor() -> int:
    """Проверить, чего не хватает на этом компьютере."""
    from reports.shared.doctor import check_system

    parts = check_system()
    for part in parts:
        mark = "есть" if part.ok else "НЕТ" if part.required else "нет"
        click.echo(f"{mark:>4}  {part.name}: {part.detail}")
    commands = [part.install_command for part in parts if part.install_command]
    for command in dict.fromkeys(commands):
        click.echo(f"      установить: {command}")
    return DONE if all(part.ok or not part.required for part in parts) else MISSING
