"""No decision is taken by reading Russian text: a judgement is a value, words are written of it."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
_RUSSIAN = re.compile("[А-Яа-яЁё]")
_READING = {
    "startswith", "endswith", "partition", "rpartition", "index", "rindex", "find", "rfind",
    "count", "split", "rsplit",
}  # fmt: skip
# Where people's files and letters are read, and what is grammar or notation and no judgement.
READERS = {
    "reports/grading/batch/awards.py": "words of a decision as typed",
    "reports/grading/issuing/roster.py": "a list of students",
    "reports/grading/pages/moodle.py": "a file of Moodle",
    "reports/inputs/toml_errors.py": "words typed into a file",
    "reports/shared/russian.py": "letters of the alphabet and conjunctions",
    "reports/document/chapters/front.py": "a department's name as typed, headings of appendices",
    "reports/document/text/symbols.py": "superscripts of an own formula",
    "reports/document/text/terms.py": "marks of cast irons, names of printed sources",
    "reports/document/page/fitting.py": "places where a line may break",
}


def decisions(tree: ast.AST) -> Iterator[ast.expr]:
    """Comparisons with a Russian text and calls that look for one."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            texts = [node.left, *node.comparators]
        elif (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Attribute)
            and node.func.attr in _READING
        ):
            texts = [*node.args, *(word.value for word in node.keywords)]
        else:
            continue
        if any(map(_russian, texts)):
            yield node


def _russian(node: ast.expr) -> bool:
    """Whether an expression is a Russian text, or a tuple or set with one."""
    if isinstance(node, ast.Tuple | ast.List | ast.Set):
        return any(map(_russian, node.elts))
    return (
        isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and _RUSSIAN.search(node.value) is not None
    )


def test_no_decision_reads_russian_text() -> None:
    places = [
        f"{name}:{node.lineno}: {ast.unparse(node)}"
        for room in ("kshm", "reports")
        for path in sorted((ROOT / room).rglob("*.py"))
        for name in (path.relative_to(ROOT).as_posix(),)
        if name not in READERS
        for node in decisions(ast.parse(path.read_text(encoding="utf-8")))
    ]
    assert places == []


def test_no_template_decides_by_russian_text() -> None:
    """Of the report: books compare a choice with its label, which is the cell's own word."""
    compared = re.compile(r'(?:==|!=|\bin) "[^"]*[А-Яа-яЁё]|\.startswith\("[А-Яа-яЁё]')
    reading = {
        f"{path.name}: {matches[0]}"
        for path in (ROOT / "templates").rglob("*.j2")
        for matches in compared.finditer(path.read_text(encoding="utf-8"))
    }
    assert reading == {'macros.html.j2: .startswith("П'}  # a heading of an appendix


@pytest.mark.parametrize(
    "text",
    [
        'any(line.startswith("Внимание") for line in lines)',
        'value == "НЕТ"',
        '"точн" in title',
        'status not in ("не сдано", "проверено")',
        'note.partition(": обычно ")',
    ],
)
def test_the_rule_sees_each_kind(text: str) -> None:
    assert list(decisions(ast.parse(text)))


def test_no_usual_span_is_typed_where_it_is_said() -> None:
    """It stands as numbers in a table of spans: warnings, comments, books and chapters read it."""
    typed = re.compile(r"обычно (?:от )?[−-]?\d|span_text\(-?[\d.]+, ")
    places = [
        f"{path.relative_to(ROOT)}: {matches[0]}"
        for pattern in ("reports/**/*.py", "kshm/**/*.py", "templates/**/*.book")
        for path in ROOT.glob(pattern)
        for matches in typed.finditer(path.read_text(encoding="utf-8"))
    ]
    assert places == []


def test_every_reader_still_reads() -> None:
    for name in READERS:
        assert list(decisions(ast.parse((ROOT / name).read_text(encoding="utf-8")))), name
