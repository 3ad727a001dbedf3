"""Pages for people: feedback of a student and the summary of a class."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from functools import lru_cache
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from kshm.nomenclature.digits import Digits
from reports.grading.issuing.rubric import Rubric
from reports.grading.judging.judgement import UNKNOWN, WORDS
from reports.grading.pages.chart import line_chart
from reports.shared.resources import templates_dir
from reports.shared.russian import capital, short, written


@lru_cache(maxsize=1)
def _environment() -> Environment:
    environment = Environment(
        loader=FileSystemLoader(templates_dir() / "grading"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "number": number,
        "points": points,
        "rows": rows,
        "moment": moment,
        "capitalize_first": capital,
    }
    return environment


def student_page(result: dict[str, Any], rubric: Rubric) -> str:
    """Feedback of one submission as a page that needs no other file: what is wrong first."""
    full = rubric.feedback.mode == "full"
    lines = [{**line, "svg": _chart(line, full)} for line in result.get("items", [])]
    labels = {line["id"]: line["label"] for line in lines}
    wrong = [line for line in lines if line["verdict"] not in ("right", "carried")]
    rank = {word: number for number, word in enumerate(WORDS)}
    wrong.sort(key=lambda line: (rank[line["verdict"]], -(line["of"] - line["points"])))
    empty = [
        line
        for line in wrong
        if (line["verdict"] == "empty" and not line["rows"]) or line["verdict"] == "groundless"
    ]
    counts = dict.fromkeys(WORDS, 0)
    for line in lines:  # what a person has decided asks for nobody
        counts[line["verdict"]] += line["verdict"] != UNKNOWN or "decision" not in line
    template = _environment().get_template("student.html.j2")
    return template.render(
        result=result,
        wrong=[line for line in wrong if line not in empty],
        empty=_by_heading(empty),
        carried=_by_heading([line for line in lines if line["verdict"] == "carried"]),
        right=_by_heading([line for line in lines if line["verdict"] == "right"]),
        totals=_totals(lines),
        labels=labels,
        counts={key: n for key, n in counts.items() if n},
        words=WORDS,
        full=full,
        maximum=rubric.maximum,
        share=rubric.credit.carried,
        title=rubric.work.title,
    )


def _by_heading(lines: list[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    found: dict[str, list[dict[str, Any]]] = {}
    for line in lines:
        found.setdefault(line["heading"], []).append(line)
    return found


def _totals(lines: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Points of each table."""
    return [
        {
            "heading": heading,
            "points": sum(line["points"] for line in own),
            "of": sum(line["of"] for line in own),
            "wrong": sum(line["verdict"] not in ("right", "carried") for line in own),
            "count": len(own),
        }
        for heading, own in _by_heading(lines).items()
    ]


def class_page(summary: dict[str, Any]) -> str:
    """The summary of a class."""
    return _environment().get_template("summary.html.j2").render(summary=summary, words=WORDS)


def _chart(line: dict[str, Any], full: bool) -> Markup:
    chart = line.get("chart")
    if not chart or line["verdict"] not in ("wrong", "error"):
        return Markup("")
    # The right curve would give away what a hint only points at.
    right = chart["right"] if full else None
    # The chart is made of numbers only: no text of a person's is in it.
    return Markup(line_chart(chart["x"], chart["own"], right))


def number(value: float | None, digits: Mapping[str, Any] | None = None) -> str:
    """A number as Russian print has it, with a digit more than the book."""
    if value is None:
        return "—"
    return short(value) if digits is None else written(value, Digits(**digits), more=1)


def points(value: float) -> str:
    """Points without needless zeros."""
    return f"{round(value, 2):g}".replace(".", ",")


def moment(text: str) -> str:
    """A time as people write it: 05.12.2026 10:00."""
    return datetime.fromisoformat(text).strftime("%d.%m.%Y %H:%M")


def rows(labels: list[str], limit: int = 14) -> str:
    """Rows of a column in words."""
    named = [label.replace(".", ",") for label in labels if label]
    text = "; ".join(named[:limit])
    return f"{text} и ещё {len(named) - limit}" if len(named) > limit else text
