"""Words that a user reads are spelt as a dictionary spells them, or stand in a list of ours."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.conftest import missing

ROOT = Path(__file__).parents[2]
# Names, terms, abbreviations and parts of words that the dictionary has not.
OURS = Path(__file__).with_name("words.txt")
WORD = re.compile(r"[а-яё]{4,}", re.IGNORECASE)


def texts_of(path: Path) -> Iterator[str]:
    """All of a page or a template, the strings of a program."""
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".py":
        yield text
        return
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value


def words() -> dict[str, str]:
    """Every word with a file where it stands."""
    paths = [ROOT / "README.ru.md", *(ROOT / "docs").glob("*.md")]
    paths += [*(ROOT / "samples").glob("*.toml"), *(ROOT / "templates").rglob("*.*")]
    paths += (ROOT / "reports/web/static").glob("*.*")
    for room in ("kshm", "reports", "tools"):
        paths += (ROOT / room).rglob("*.py")
    return {
        word.lower(): str(path.relative_to(ROOT))
        for path in paths
        if path.suffix in (".py", ".md", ".toml", ".j2", ".css", ".js", ".html")
        for text in texts_of(path)
        for word in WORD.findall(text.replace("\u0301", "").replace("\u00ad", ""))
    }


def test_every_word_is_known() -> None:
    """A new term is added to the list by hand, which is when a person looks at it."""
    try:
        from pymorphy3 import MorphAnalyzer
    except ImportError:
        missing("pymorphy3", "python3-pip; pip install pymorphy3")
    known = MorphAnalyzer(lang="ru").word_is_known
    ours = set(OURS.read_text(encoding="utf-8").split())
    actual = words()
    assert len(actual) > 3000
    assert {word: actual[word] for word in sorted(actual.keys() - ours) if not known(word)} == {}


@pytest.mark.parametrize("word", ["двухтактый", "шатуная", "противавес"])
def test_a_slip_is_noticed(word: str) -> None:
    morphology = pytest.importorskip("pymorphy3")
    assert not morphology.MorphAnalyzer(lang="ru").word_is_known(word)
    assert word not in OURS.read_text(encoding="utf-8").split()
