"""A chapter of the report as one record: every list of chapters follows from it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from markupsafe import Markup

from reports.document.page.numbering import Figure, TablePlan
from reports.inputs.sections.input_file import InputFile
from reports.model.shape import Shape

Write = Callable[[Any], Markup]  # of a Chapter, which holds the records itself
Profile = Literal["always", "short", "course", "full"]
# Each holds those before it; "always" also stands in a person's own list of chapters.
_PROFILES: tuple[Profile, ...] = ("always", "short", "course", "full")


def always(_: InputFile) -> bool:
    """Apply to every engine."""
    return True


def central(model: InputFile) -> bool:
    """Apply to engines without an offset and without articulated rods."""
    shape = Shape.of(model)
    return not (shape.offset or shape.articulated)


@dataclass(frozen=True, slots=True)
class Record:
    """A chapter; its title stands with the choices of the input file's key.

    Attributes:
        name: the name of the input file's key ``report.chapters``, and of the template.
        write: the chapter's text.
        profile: the shortest report that has it.
        applies: whether an engine has what it is about.
        conclude: its line of the conclusion, for a chapter that not every report has.
        keywords: its words in the abstract.
        aim: what the work is to find by it, in the accusative; equal aims are said once.
        findings: what the introduction says is found.
        sections: sections of the input file that no other chapter reads.
        keys: first letters of the results that it alone tells.
        views: tables and figures of the program's own, by the names that a book shows.
        inserts: text of the program's own, by the names that a book inserts.
    """

    name: str
    write: Write
    profile: Profile = "course"
    applies: Callable[[InputFile], bool] = always
    conclude: Write | None = None
    keywords: tuple[str, ...] = ()
    aim: str = ""
    findings: tuple[str, ...] = ()
    sections: tuple[str, ...] = ()
    keys: tuple[str, ...] = ()
    views: Mapping[str, Callable[[Any], TablePlan | Figure]] = field(default_factory=dict)
    inserts: Mapping[str, Write] = field(default_factory=dict)


def chosen(records: Iterable[Record], model: InputFile) -> set[str]:
    """Names of the report's chapters: its profile or the person's own list."""
    report = model.report
    if report.chapters is None:
        held = _PROFILES[: _PROFILES.index(report.detail) + 1]
        return {record.name for record in records if record.profile in held}
    names = set(report.chapters) | {each.name for each in records if each.profile == "always"}
    # Both were one chapter: files that name it get what they got.
    return names | {"balance"} if "companions" in names else names


def relevant(records: Iterable[Record], model: InputFile) -> set[str]:
    """Names of the chosen chapters that apply to the engine."""
    names = chosen(records, model)
    return {each.name for each in records if each.name in names and each.applies(model)}
