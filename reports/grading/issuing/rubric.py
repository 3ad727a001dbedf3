"""The rubric: what is filled in, what it is worth, what is allowed.  Every rule has a default."""

from __future__ import annotations

import re
from datetime import date, datetime
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator
from pydantic_core import PydanticCustomError

from reports.formula.parse import parse
from reports.inputs import messages
from reports.inputs.load import tables_of
from reports.inputs.normalise import read_text
from reports.shared.errors import FormulaError, InputError, Problem, one_line

Share = Annotated[float, Field(ge=0, le=1)]
Positive = Annotated[float, Field(gt=0)]
Points = Annotated[float, Field(ge=0, le=1e6)]
Name = Annotated[str, Field(min_length=1, max_length=100)]
PartName = Annotated[str, Field(pattern=r"^[^\W\d_][\w -]{0,39}$")]
Letters = Annotated[str, Field(pattern=r"^[A-Z]{0,3}$")]
_WANTED = {
    "less_than_equal": "нужно число от 0 до 1",
    "greater_than_equal": "нужно число не меньше нуля",
    "greater_than": "нужно положительное число",
    "float_type": "нужно число",
    "float_parsing": "нужно число",
    "finite_number": "нужно конечное число",
    "bool_parsing": "нужно true или false",
    "bool_type": "нужно true или false",
    "int_type": "нужно целое число",
    "int_parsing": "нужно целое число",
    "tuple_type": "нужен список",
    "dict_type": "нужен раздел",
    "model_type": "нужен раздел",
    "string_type": "нужен текст",
    "missing": "ключ обязателен",
    "parts": "части [parts] вместе не больше maximum",
    "formula": "нужна формула на языке таблиц: r_crank*(1 - cos(rad(phi_deg)))",
    "string_pattern_mismatch": "нужны буквы столбца или адрес ячейки: B, E12",
    "string_too_short": "нужен текст",
    "datetime_from_date_parsing": "нужна дата и время: 2026-12-20T23:59:00",
    "datetime_parsing": "нужна дата и время: 2026-12-20T23:59:00",
}


class _Section(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class WorkTables(_Section):
    """[work]: the tables of the work-book, by id; ``*`` stands for any ending.

    ``without`` names columns and values of the tables to fill in that nobody is asked for.
    """

    title: Annotated[str, Field(max_length=200)] = ""
    fill: tuple[str, ...] = ("geometry", "masses", "P3_*", "P4_*")
    given: tuple[str, ...] = ()
    without: tuple[str, ...] = ()


class Credit(_Section):
    """[credit]: share of the points; ``rows`` for the right rows of a column with wrong ones."""

    carried: Share = 1.0
    typed: Share = 0.5
    rows: Share = 1.0


class Formulas(_Section):
    """[formulas]: where formulas are demanded."""

    required: bool = True
    optional: tuple[str, ...] = ()


class ToleranceRules(_Section):
    """[tolerance]: ``units`` of the last printed digit, and absolute ones by item."""

    units: Positive = 0.5
    share: Share = 0.01
    items: dict[str, Positive] = {}


class LateRule(_Section):
    """After so many hours past the deadline the points are multiplied by the factor."""

    after_hours: Annotated[float, Field(ge=0)] = 0.0
    factor: Share


class Late(_Section):
    """[late]: no deadline, no rule.

    ``per_day`` is taken off for each day begun after the free ones, instead of the rules.
    """

    deadline: datetime | None = None
    per_day: Share = 0.0
    free_days: Annotated[int, Field(ge=0, le=365)] = 0
    least: Share = 0.0
    rules: tuple[LateRule, ...] = (LateRule(after_hours=0, factor=0.9),)

    @field_validator("deadline", mode="before")
    @classmethod
    def _with_its_hour(cls, value: object) -> object:
        """Refuse a date without a time: midnight would be its beginning."""
        if type(value) is date:
            raise PydanticCustomError("datetime_parsing", "no hour")
        return value


class Message(_Section):
    """[[messages]]: own words for a wrong item whose cause or numbers fit.

    ``cause`` is a part of the program's cause, ``formula`` a wrong formula in the language of the
    tables; without both the words stand at every mistake of the items.
    """

    items: Name = "*"
    cause: Annotated[str, Field(max_length=200)] = ""
    formula: Annotated[str, Field(max_length=500)] = ""
    text: Annotated[str, Field(min_length=1, max_length=500)]

    @field_validator("formula")
    @classmethod
    def _in_the_language(cls, value: str) -> str:
        if value:
            try:
                parse(value)
            except FormulaError as error:
                raise PydanticCustomError("formula", "no formula") from error
        return value


class Attempts(_Section):
    """[attempts]: which of several files counts, and how many a student may hand in.

    With ``tries`` the server says at once how many columns are right; 0 sets no limit and says
    nothing.
    """

    count: Literal["last", "best"] = "last"
    tries: Annotated[int, Field(ge=0, le=20)] = 0


class Copying(_Section):
    """[copying]: likeness with a work of an earlier year: hold the points, or report."""

    past: Literal["hold", "tell"] = "hold"


class Minimum(_Section):
    """[minimum]: share of the items that must be filled in for any points at all.

    ``tables`` are such shares of single tables, for the points of these tables.
    """

    filled: Share = 0.0
    tables: dict[str, Share] = {}


class MarkScale(_Section):
    """[scale]: least points of each mark, or of the credit."""

    marks: dict[str, Points] = {}
    none: Annotated[str, Field(max_length=20)] = "2"

    def mark(self, points: float) -> str:
        """Return the mark for points."""
        reached = [(least, mark) for mark, least in self.marks.items() if points >= least]
        return max(reached)[1] if reached else self.none


class Form(_Section):
    """[form]: cells of the institute's own form; columns are letters."""

    sheet: Annotated[str, Field(max_length=31)] = ""
    first_row: Annotated[int, Field(ge=1, le=10_000)] = 2
    student: Letters = "B"
    mark: Letters = ""
    points: Letters = ""
    number: Letters = ""
    cells: dict[Annotated[str, Field(pattern=r"^[A-Z]{1,3}[1-9][0-9]{0,4}$")], str] = {}


class Feedback(_Section):
    """[feedback]: hints only, or the right values too."""

    mode: Literal["hints", "full"] = "hints"


class Rubric(_Section):
    """All rules; ``parts`` are what a person marks beside the book: note, defence, sheet."""

    maximum: Positive = 100.0
    work: WorkTables = WorkTables()
    points: dict[str, Points] = {}
    parts: dict[PartName, Positive] = {}
    credit: Credit = Credit()
    formulas: Formulas = Formulas()
    tolerance: ToleranceRules = ToleranceRules()
    late: Late = Late()
    attempts: Attempts = Attempts()
    copying: Copying = Copying()
    minimum: Minimum = Minimum()
    needs: dict[str, tuple[Name, ...]] = {}
    messages: tuple[Message, ...] = ()
    scale: MarkScale = MarkScale()
    form: Form = Form()
    feedback: Feedback = Feedback()

    @property
    def calculated(self) -> float:
        """Maximum points of the workbook: the total less the parts that a person marks."""
        return self.maximum - sum(self.parts.values())

    @model_validator(mode="after")
    def _leaves_points(self) -> Self:
        if self.calculated < 0:
            raise PydanticCustomError("parts", "more than the maximum")
        return self


def load_rubric(path: Path | None) -> Rubric:
    """Return the rubric of a file, or the defaults.

    Raises:
        InputError: everything that is wrong with the file.
    """
    if path is None:
        return Rubric()
    rubric = rubric_of(tables_of(read_text(path), source=path.name), path.name)
    late = rubric.late
    needed = "deadline" if late.deadline is None else "per_day"
    idle = [key for key in ("per_day", "free_days", "least") if getattr(late, key)]
    if idle and not getattr(late, needed):
        problem = f"без ключа {needed} за опоздание ничего не снимается"
        hint = f"впишите {needed} или удалите {', '.join(idle)}"
        raise InputError(Problem(f"{path.name}: late.{idle[0]}", problem, hint))
    return rubric


def rubric_of(raw: dict[str, Any], source: str) -> Rubric:
    """Return the rubric of a mapping.

    Raises:
        InputError: everything that is wrong with it.
    """
    try:
        return Rubric.model_validate(raw)
    except ValidationError as error:
        problems = []
        for item in error.errors(include_url=False, include_context=False)[:50]:
            key = ".".join(str(part) for part in item["loc"])
            where = one_line(f"{source}: {key}", 120)
            if item["type"] == "extra_forbidden":
                likely = messages.likely_word(str(item["loc"][-1]), _keys(item["loc"]))
                hint = f"возможно, имелось в виду {likely}" if likely else "удалите его"
                problems.append(Problem(where, "неизвестный ключ", hint))
            else:
                problem = f"недопустимое значение {messages.shown(item.get('input'))}"
                words = (
                    re.findall(r"'(\w+)'", item["msg"]) if item["type"] == "literal_error" else []
                )
                hint = "нужно " + " или ".join(f'"{word}"' for word in words)
                expected = _WANTED.get(item["type"], "смотрите образец")
                problems.append(Problem(where, problem, hint if words else expected))
        raise InputError(problems) from None


def _keys(location: tuple[int | str, ...]) -> list[str]:
    model: Any = Rubric
    for part in location[:-1]:
        info = getattr(model, "model_fields", {}).get(str(part))
        model = info.annotation if info is not None else None
    return list(getattr(model, "model_fields", {}))
