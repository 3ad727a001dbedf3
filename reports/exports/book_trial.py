"""A trial of the documents of own books: what ``build`` could not build, ``check`` tells."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

from reports.document.chapters.chapter import FORMULA
from reports.document.report import Report
from reports.document.text.mathsvg import formula
from reports.exports.book_chapters import KINDS, kinds_of, lines_of
from reports.exports.book_faults import Own
from reports.exports.department_chapters import read_books, refuse_faults
from reports.inputs.department_chapters import declared, line_of_quantity, read_text
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_toml
from reports.inputs.sections.input_file import InputFile
from reports.model.blocks import Model
from reports.model.chapter_source import BookLine, cause_of
from reports.model.context import MARK
from reports.model.evaluation import Values, evaluate_model
from reports.shared.errors import BookError, FormulaImageError, InputError, KshmError, Problem
from reports.shared.resources import samples_dir
from reports.word.omml import omath
from reports.word.write import report_docx
from reports.workbook.course import short_model
from reports.workbook.write import workbook_bytes

_CHAPTERS = ("own", "checks")  # what a book adds to a report
# Engines of every kind that a book alone is tried on.
TRIED = ("gots-diesel", "yamz-236", "two-stroke", "vw-1600", "cycle-petrol", "cycle-turbo-diesel",
         "mwm-6", "gots-regimes")  # fmt: skip


def refuse_unbuilt(model: InputFile, *, whole: bool) -> None:
    """Refuse own books, read without a fault, of which a document cannot be made.

    Args:
        model: a checked input.
        whole: whether the workbook and the Word document are tried besides the page.

    Raises:
        InputError: a line for each fault.
    """
    if not model.books:
        return
    reading = read_books(model)
    values = evaluate_model(reading.model)
    for faults in (
        _unset_symbols(reading),
        _unplaced(reading, values),
        _unmade(reading, values, whole=whole),
    ):
        problems = [fault.problems[0] for fault in faults]
        if problems:
            raise InputError(problems)


def _unset_symbols(reading: Own) -> Iterator[BookError]:
    """Symbols that are no TeX."""
    for stem, (_, text) in zip(reading.shelf.names, reading.shelf.own, strict=True):
        for key, quantity in declared(text).quantities.items():
            try:
                formula(quantity.tex)
                omath(quantity.tex)
            except (FormulaImageError, ValueError, KeyError, IndexError):
                line = BookLine(f"{stem}.book", line_of_quantity(text, key), "")
                yield reading.fault(line, f"обозначение «{quantity.tex}» не набирается",
                                "проверьте скобки и команды TeX", quantity.tex)  # fmt: skip


def _unplaced(reading: Own, values: Values) -> Iterator[BookError]:
    """Yield what a chapter shows again or refers to though the report has it nowhere."""
    report = Report(replace(reading.model, chapters=()), values)
    placed, elsewhere = report.names
    shows = {(of, text) for kind, text, _ in lines_of(reading) if kind == "show"
             for of in kinds_of(reading, text)[:1]}  # fmt: skip
    for kind, text, line in lines_of(reading):
        first = kinds_of(reading, text)[:1] if kind == "show" else []
        if any((of, text) in placed for of in first):
            word = next(word for word, of in KINDS.items() if of in first)
            yield reading.fault(line, f"«{text}» уже стоит в записке",
                            f'сошлитесь: {{{{ {word}("{text}") }}}}', text)  # fmt: skip
        if kind == "formula" and ("formula", FORMULA + text) in placed:
            yield reading.fault(line, f"формула «{text}» уже стоит в записке",
                            f'назовите значение: {{{{ eqv("{text}") }}}}', text)  # fmt: skip
        for word, key in MARK.findall(text):
            name = (KINDS.get(word, ""), key)
            if name[0] and name not in shows | placed | elsewhere:
                yield reading.fault(line, f"«{key}» в записке нигде нет",
                                f"допишите строку show {key}", key)  # fmt: skip


def _unmade(reading: Own, values: Values, *, whole: bool) -> Iterator[BookError]:
    """Documents that are not made."""
    report = Report(_alone(reading.model), values)
    makers: list[tuple[str, Callable[[], object]]] = [
        ("записка", lambda: report.page("screen")),
    ]
    if whole:
        short = short_model(reading.model)
        makers += [("записка Word", lambda: report_docx(report)),
                   ("книга Excel", lambda: workbook_bytes(short, values))]  # fmt: skip
    for name, make in makers:
        try:
            make()
        except BookError as error:
            yield error
            return
        except KshmError:
            raise
        except Exception as error:
            yield reading.fault(None, f"{name} с этой книгой не складывается: {cause_of(error)}",
                            "уберите последнее, что написали, и проверьте снова")  # fmt: skip
            return


def _alone(model: Model) -> Model:
    """Return the model of a report of little else than own chapters."""
    report = model.input.report.model_copy(update={"chapters": _CHAPTERS})
    return replace(model, input=model.input.model_copy(update={"report": report}))


def check_alone(path: Path) -> Iterator[str]:
    """Lines on a book alone: what it declares, and on which samples it was tried.

    Raises:
        InputError: what is wrong with it.
    """
    text = read_text(path.parent, path.name, "")
    raw = {"report": {"books": [path.name]}, "books": {path.name: text}}
    for sample in TRIED:
        base = to_mapping(load_toml(samples_dir() / f"{sample}.toml").model)
        base["report"] |= raw["report"]
        model = load_mapping({**base, "books": raw["books"]}, source=path.name).model
        try:
            refuse_faults(model)
            refuse_unbuilt(model, whole=sample == TRIED[0])
        except InputError as error:
            if sample == TRIED[0]:
                raise
            raise InputError([_on_sample(each, sample) for each in error.problems]) from None
    declared_names = declared(text)
    inputs = len(declared_names.model.model_fields) if declared_names.model is not None else 0
    yield f"{path}: ошибок нет; исходных {inputs}, своих величин {len(declared_names.quantities)}"
    yield f"Проверено на образцах: {', '.join(TRIED)}"


def _on_sample(problem: Problem, sample: str) -> Problem:
    """Return a fault that the samples before have not, with the sample that has it."""
    return Problem(problem.where, f"на образце {sample}: {problem.what}", problem.hint)
