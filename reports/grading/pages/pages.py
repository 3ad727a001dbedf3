"""Pages of students and of the class."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import datetime
from functools import lru_cache
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

from kshm.nomenclature.digits import Digits
from reports.document.text.symbols import with_indices
from reports.grading.issuing.rubric import Rubric
from reports.grading.judging.judgement import PART, UNKNOWN, WORDS
from reports.grading.pages.gradebook import with_points
from reports.grading.pages.states import State, state_of_result
from reports.shared.resources import templates_dir
from reports.shared.russian import capital, fixed, short, written

WIDTH, HEIGHT = 640, 200
_LEFT, _RIGHT, _TOP, _BOTTOM = 80, 16, 26, 26
Points = Sequence[float | None]


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
        "indices": with_indices,
        "fixed": fixed,
        "with_points": with_points,
    }
    return environment


def student_page(result: dict[str, Any], rubric: Rubric) -> str:
    """Feedback of one submission as a page that needs no other file: what is wrong first."""
    full = rubric.feedback.mode == "full"
    lines = [_line(line, full) for line in result.get("items", [])]
    labels = {line["id"]: line["label"] for line in lines}
    wrong = [line for line in lines
             if line["verdict"] not in ("right", "carried") and line["block"] != PART]  # fmt: skip
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
    state = result.get("state") or state_of_result(result)
    template = _environment().get_template("student.html.j2")
    return template.render(
        result=result,
        state=state,
        held=state == State.HELD,
        wrong=(shown := [line for line in wrong if line not in empty]),
        figures=any(line["svg"] for line in shown),
        waits=bool(result["manual"] or state in (State.HELD, State.BY_HAND)),
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


def _line(line: dict[str, Any], full: bool) -> dict[str, Any]:
    defaults = {"message": "", "needs": (), "indexed": line["symbol"], **line}
    return {**defaults, "svg": _chart(line, full)}


def _by_heading(lines: list[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    groups: dict[str, list[dict[str, Any]]] = {}
    for line in lines:
        groups.setdefault(line["heading"], []).append(line)
    return groups


def _totals(lines: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Points of each table."""
    return [
        {
            "heading": heading,
            "points": sum(line["points"] for line in lines_of),
            "of": sum(line["of"] for line in lines_of),
            "wrong": sum(line["verdict"] not in ("right", "carried") for line in lines_of),
            "count": len(lines_of),
        }
        for heading, lines_of in _by_heading(lines).items()
    ]


def class_page(summary: dict[str, Any]) -> str:
    """Return the page of a class."""
    data = {"decided": (), "compared": (), **summary}
    return _environment().get_template("summary.html.j2").render(summary=data, words=WORDS)


def questions_page(sheets: Sequence[dict[str, Any]], rubric: Rubric, *, answers: bool) -> str:
    """Sheets of questions for the defence, with answers for the instructor."""
    template = _environment().get_template("questions.html.j2")
    return template.render(sheets=sheets, answers=answers, title=rubric.work.title)


def _chart(line: dict[str, Any], full: bool) -> Markup:
    chart = line.get("chart")
    if not chart or line["verdict"] not in ("wrong", "error"):
        return Markup("")
    # The right curve would give away what a hint only points at.
    right = chart["right"] if full else None
    # The chart is made of numbers and of names of units: no text of a person's is in it.
    axes = chart.get("over", ""), line["unit"]
    return Markup(line_chart(chart["x"], chart["own"], right, axes))


def number(value: float | None, digits: Mapping[str, Any] | None = None) -> str:
    """Return a number as Russian print has it, with a digit more than the book."""
    if value is None:
        return "—"
    return short(value) if digits is None else written(value, Digits(**digits), more=1)


def points(value: float) -> str:
    """Points without needless zeros."""
    return f"{round(value, 2):g}".replace(".", ",")


def moment(text: str) -> str:
    """Return a time as people write it: 05.12.2026 10:00."""
    return datetime.fromisoformat(text).strftime("%d.%m.%Y %H:%M")


def rows(labels: list[str], limit: int = 14) -> str:
    """Rows of a column in words."""
    named = [label.replace(".", ",") for label in labels if label]
    text = "; ".join(named[:limit])
    return f"{text} и ещё {len(named) - limit}" if len(named) > limit else text


def compared_page(
    names: Sequence[str], lines: Sequence[Mapping[str, Any]], text: str, bits: float, more: int
) -> str:
    """Return the page of works beside each other, for the teacher alone."""
    template = _environment().get_template("compared.html.j2")
    return template.render(names=names, lines=lines, text=text, bits=bits, more=more)


# --- curves --------------------------------------------------------------------------------------


def line_chart(
    x: Sequence[float], points: Points, right: Points | None, axes: tuple[str, str]
) -> str:
    """Return the chart's SVG; gaps where there is no number, one line where ``right`` is None."""
    finite = [v for line in (points, right or ()) for v in line if v is not None]
    if not finite or len(x) < 2:
        return ""
    low, high = min(finite), max(finite)
    if high - low < 1e-12 * max(1.0, abs(high)):
        low, high = low - 1, high + 1
    pad = (high - low) * 0.05
    low, high = low - pad, high + pad

    def at_x(value: float) -> float:
        share = (value - x[0]) / ((x[-1] - x[0]) or 1)
        return _LEFT + share * (WIDTH - _LEFT - _RIGHT)

    def at_y(value: float) -> float:
        return _TOP + (high - value) / (high - low) * (HEIGHT - _TOP - _BOTTOM)

    legend = "ваши значения" if right is None else "ваши значения и правильные"
    parts = [
        f'<svg class="chart" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="График столбца: {legend}">'
    ]
    for share in (0.0, 0.5, 1.0):
        value = low + pad + (high - low - 2 * pad) * share
        y = at_y(value)
        parts.append(
            f'<line class="grid" x1="{_LEFT}" x2="{WIDTH - _RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>'
        )
        label = short(value, 4)
        parts.append(f'<text x="{_LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{label}</text>')
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        value = x[0] + (x[-1] - x[0]) * share
        anchor = "start" if share == 0 else "end" if share == 1 else "middle"
        parts.append(
            f'<text x="{at_x(value):.1f}" y="{HEIGHT - 8}" text-anchor="{anchor}">{value:g}</text>'
        )
    over = at_x(x[0] + 0.875 * (x[-1] - x[0])), HEIGHT - 8
    for name, (left, top) in zip(axes, (over, (_LEFT, 14)), strict=True):
        words = f'<text x="{left:.1f}" y="{top}" text-anchor="middle">{escape(name)}</text>'
        parts.append(words)
    if right is not None:
        parts.append(_path(x, right, at_x, at_y, "right"))
    parts.append(_path(x, points, at_x, at_y, "own"))
    parts.append("</svg>")
    return "".join(parts)


def _path(x: Sequence[float], y: Points, at_x: object, at_y: object, name: str) -> str:
    assert callable(at_x) and callable(at_y)
    path, pen = [], "M"
    for position, value in zip(x, y, strict=True):
        if value is None:
            pen = "M"
            continue
        path.append(f"{pen}{at_x(position):.1f} {at_y(value):.1f}")
        pen = "L"
    return f'<path class="{name}" d="{"".join(path)}"/>'
