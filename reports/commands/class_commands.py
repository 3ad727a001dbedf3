"""Commands for a group of students: variants out, marks in."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from getpass import getuser
from pathlib import Path
from typing import TYPE_CHECKING

import click

from reports.commands.common import (
    DONE,
    HELP,
    LOOK,
    RussianCommand,
    dask_option,
    file_argument,
    path_option,
    verbose_option,
)
from reports.shared.errors import KshmError

if TYPE_CHECKING:
    from reports.grading.issuing.issue import Result

_LEFT = "Не выдано"
_NOTHING_WRITTEN = "Ничего не записано: это показ."
_MIN_CHANGE = 0.005  # points that are printed


@click.command(cls=RussianCommand, context_settings=HELP)
@file_argument("БАЗА")
@path_option("--roster", metavar="ФАЙЛ", help="Список группы: .xlsx или CSV.")
@path_option("-o", "--output", "folder", help="Папка для выдачи.")
@click.option("--seed", default=1, metavar="ЧИСЛО", show_default=True,
              help="Зерно: то же зерно — те же варианты.")  # fmt: skip
@path_option("--rubric", metavar="ФАЙЛ", help="Рубрика TOML (без неё — правила по умолчанию).")
@path_option("--ranges", metavar="ФАЙЛ", help="Диапазоны, если их нет в разделе [variants].")
@path_option("--secret", metavar="ФАЙЛ", help="Файл секрета преподавателя.")
@click.option("--tries", type=click.IntRange(0, 20), metavar="ЧИСЛО",
              help="Попыток до срока: сервер сразу говорит, сколько столбцов верно.")  # fmt: skip
@click.option("--jobs", default=0, metavar="ЧИСЛО", help="Число процессов (по умолчанию все ядра).")
@path_option("--try-rubric", "samples", metavar="ФАЙЛ",
             help="Не выдавать, а проверить рубрику на пробных работах.")  # fmt: skip
@verbose_option
def issue(
    source: Path,
    roster: Path | None,
    folder: Path | None,
    seed: int,
    rubric: Path | None,
    ranges: Path | None,
    secret: Path | None,
    tries: int | None,
    jobs: int,
    samples: Path | None,
) -> int:
    """Выдать каждому студенту свой вариант и рабочую книгу."""
    if samples is not None:
        return _try_rubric(source, samples, rubric, ranges)
    from reports.grading.issuing.issue import issue as issue_books

    if roster is None or folder is None:
        raise KshmError("нужны список группы (--roster) и папка для выдачи (-o)")
    if jobs < 0:
        raise KshmError("--jobs должно быть положительным")

    done = issue_books(
        source, roster, folder, seed=seed,
        rubric_file=rubric, ranges_file=ranges, secret_file=secret, jobs=jobs,
        tries=tries,
    )  # fmt: skip
    if done.new_secret is not None:
        click.echo(
            f"Создан секрет: {done.new_secret}. Сохраните его: без него не проверить работы; "
            "студентам его не давайте.",
            err=True,
        )
    for line in _issued_lines(folder, done):
        click.echo(line, err=line.startswith(_LEFT))
    return DONE


def _issued_lines(folder: Path, done: Result) -> list[str]:
    """How many are issued of how many lines with a name, who is new, who has left."""
    books, former = done.register.books, done.register.former
    lines = [f"{folder}: выдано вариантов: {len(books)}, строк с именем в списке: "
            f"{len(books) + len(done.left)}"]  # fmt: skip
    lines += [f"{_LEFT}: {line}" for line in done.left]
    if done.kept:
        names = ", ".join(f"{book.number} ({book.student.full})" for book in books[done.kept :])
        lines.append(f"Прежние книги, варианты и идентификаторы сохранены: {done.kept}; "
                    f"новые варианты: {names or 'нет'}")  # fmt: skip
    if former:
        names = ", ".join(f"{book.number} ({book.student.full})" for book in former)
        lines.append(f"Нет в списке, варианты оставлены за ними: {names}")
    return lines


def _try_rubric(source: Path, samples: Path, rubric: Path | None, ranges: Path | None) -> int:
    from reports.grading.batch.rubric_trial import try_rubric
    from reports.shared.russian import short

    tried = try_rubric(source, samples, rubric_file=rubric, ranges_file=ranges)
    for one in tried:
        points, required = short(one.points, 4), short(one.sample.points, 4)
        said = "как задано" if one.is_as_expected else f"а задано {required}"
        click.echo(f"{one.sample.name}: {points} — {said}")
    unlike = sum(not one.is_as_expected for one in tried)
    if unlike:
        click.echo(f"Баллы не те, что заданы: {unlike} из {len(tried)}", err=True)
    return LOOK if unlike else DONE


def _user() -> str:
    """Login name, empty where the system has none: a container, Windows by the page."""
    with suppress(ImportError, KeyError, OSError):
        return getuser()
    return ""


def _is_for_many(decisions: tuple[tuple[str, str, str, str], ...]) -> bool:
    from reports.grading.pages.groups import NAME

    return any(NAME.fullmatch(who) for who, *_ in decisions)


def _tell_effects(effects: Sequence[tuple[str, float | None, float | None]]) -> None:
    """Who gains and who loses by a decision, and how many neither."""
    from reports.shared.russian import short

    alike = 0
    for who, before, after in effects:
        change = (after or 0.0) - (before or 0.0)
        if before is not None and abs(change) < _MIN_CHANGE:
            alike += 1
            continue
        first, last = ("—" if points is None else short(points, 4) for points in (before, after))
        sign = "+" if change >= 0 else "−"
        click.echo(f"{who}: {first} → {last} ({sign}{short(abs(change), 4)})", err=True)
    click.echo(f"Без изменений: {alike}", err=True)


@click.command(cls=RussianCommand, context_settings=HELP)
@click.argument("issued", metavar="[ВЫДАЧА]", required=False, type=click.Path(path_type=Path))
@click.argument("submitted", metavar="[СДАНО]", required=False, type=click.Path(path_type=Path))
@path_option("-o", "--output", "folder", help="Папка для результатов.")
@path_option("--rubric", metavar="ФАЙЛ", help="Другая рубрика вместо выданной.")
@path_option("--roster", metavar="ФАЙЛ", help="Список с продлёнными сроками (столбец «Срок»).")
@path_option("--memory", metavar="ПАПКА",
             help="Память прошлых лет: отпечатки редких формул и ошибок.")  # fmt: skip
@path_option("--secret", metavar="ФАЙЛ", help="Файл секрета преподавателя.")
@path_option("--form", metavar="ФАЙЛ", help="Ведомость института .xlsx: заполнить её оценками.")
@click.option("--copies", is_flag=True, help="Вернуть книги студентов с пометками в ячейках.")
@click.option("--questions", is_flag=True, help="Вопросы к защите по числам каждого студента.")
@click.option("--anonymous", is_flag=True, help="Номера вместо имён на страницах.")
@click.option("--pdf", is_flag=True, help="Сделать и PDF каждой страницы.")
@click.option("--jobs", default=0, metavar="ЧИСЛО", help="Число процессов (по умолчанию все ядра).")
@click.option(
    "--timeout", default=60.0, metavar="ЧИСЛО", show_default=True, help="Секунд на один файл."
)
@dask_option
@path_option(
    "--moodle",
    "worksheet",
    metavar="CSV",
    help="Ведомость оценивания Moodle: заполнить её оценками.",
)
@click.option(
    "--decide",
    "decisions",
    nargs=4,
    multiple=True,
    metavar="КТО ЧТО БАЛЛЫ ПРИМЕЧАНИЕ",
    help="Решение преподавателя: кто или группа Г-…, столбец или «всё», баллы (75, ×0,75, +5, -5, "
    "50% столбца; + принять, - отменить), примечание.",
)
@click.option("--request", "requests", nargs=3, multiple=True, metavar="КТО СТОЛБЕЦ СЛОВА",
              help="Студент просит посмотреть столбец ещё раз; ответ — решение о нём.")  # fmt: skip
@click.option("--preview", is_flag=True,
              help="С --decide или --rubric: показать, кому сколько баллов, ничего не "
                   "записывая.")  # fmt: skip
@click.option(
    "--author", metavar="ИМЯ", default="", help="Кто решает (по умолчанию имя пользователя)."
)
@click.option("--explain", nargs=2, metavar="ФАЙЛ ЛИСТ!СТОЛБЕЦ", help="Объяснить один вердикт.")
@verbose_option
def grade(
    issued: Path | None,
    submitted: Path | None,
    folder: Path | None,
    rubric: Path | None,
    roster: Path | None,
    memory: Path | None,
    form: Path | None,
    copies: bool,
    questions: bool,
    anonymous: bool,
    secret: Path | None,
    pdf: bool,
    jobs: int,
    timeout: float,
    dask: str | None,
    worksheet: Path | None,
    decisions: tuple[tuple[str, str, str, str], ...],
    requests: tuple[tuple[str, str, str], ...],
    preview: bool,
    author: str,
    explain: tuple[str, str] | None,
) -> int:
    """Проверить сданные работы: файл, папку или zip заданий Moodle.

    ВЫДАЧА — папка, которую сделала команда issue; СДАНО — что сдали студенты.
    """
    if explain is not None:
        from reports.grading.pages.explain import explain as explain_column

        # The command of Windows passes on the quotes that a POSIX shell takes off.
        column = re.sub(r"^'([^']*)'$", r"\1", explain[1])
        for line in explain_column(issued, Path(explain[0]), column, rubric, secret):
            click.echo(line)
        return DONE
    from reports.grading.batch.grade import decide as decide_all
    from reports.grading.batch.grade import grade as grade_all
    from reports.grading.batch.setup import GradeSetup

    author = author or _user()
    if preview and rubric is not None and None not in (issued, submitted, folder):
        from reports.grading.batch.rubric_preview import rubric_effects

        assert issued is not None and submitted is not None and folder is not None
        setup = GradeSetup(workers=jobs, timeout_s=timeout)
        _tell_effects(
            rubric_effects(issued, submitted, folder, rubric, secret_file=secret, options=setup)
        )
        click.echo(_NOTHING_WRITTEN, err=True)
        return DONE
    if preview and (not decisions or issued is not None):
        raise KshmError("--preview показывает решение: grade -o ПАПКА --decide … --preview, или "
                        "рубрику: grade ВЫДАЧА СДАНО -o ПАПКА --rubric ФАЙЛ --preview")  # fmt: skip
    if requests and (decisions or issued is not None or folder is None):
        raise KshmError("--request — отдельно: grade -o ПАПКА --request КТО СТОЛБЕЦ СЛОВА")
    if (decisions or requests) and issued is None and folder is not None:
        setup = GradeSetup(decisions=decisions, requests=requests, author=author, form=form)
        if preview or _is_for_many(decisions):
            seen = decide_all(folder, replace(setup, preview=True))
            _tell_effects(seen.effects)
            if preview:
                click.echo(_NOTHING_WRITTEN, err=True)
                return DONE
            if sys.stdin.isatty() and not click.confirm("Применить?", default=True):
                return DONE
        done = decide_all(folder, setup)
        kept = "решения записаны" if decisions else "просьба записана"
        click.echo(f"{folder}: {kept}, ведомость и страницы обновлены")
        return LOOK if done.needs_a_person else DONE
    if issued is None or submitted is None or folder is None:
        raise KshmError("нужны папка выдачи, сданные работы и папка для результатов (ключ -o)")
    if jobs < 0 or timeout <= 0:
        raise KshmError("--jobs и --timeout должны быть положительными")
    done = grade_all(
        issued, submitted, folder, rubric_file=rubric, secret_file=secret,
        options=GradeSetup(workers=jobs, timeout_s=timeout, pdf=pdf, dask=dask, decisions=decisions,
                        worksheet=worksheet,
                        author=author, roster=roster, memory=memory,
                        form=form, copies=copies, questions=questions, anonymous=anonymous),
    )  # fmt: skip
    summary = done.summary
    click.echo(f"{folder}: проверено файлов: {summary['files']}, с оценкой: {summary['graded']}")
    if done.needs_a_person:
        click.echo(f"Нужна ручная проверка: {len(summary['manual'])}", err=True)
        return LOOK
    return DONE
