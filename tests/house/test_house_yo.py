"""Words that a user sees are written with ё: where the dictionary knows them with it alone."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.conftest import missing
from tests.house.test_house_spelling import OURS

ROOT = Path(__file__).parents[2]
# Names of columns that a list may have, words that an input may use, titles as printed.
ALLOWED = {"reports/grading/issuing/roster.py", "reports/inputs/normalise.py"}
ALLOWED |= {f"kshm/mechanics/{name}.py" for name in ("dimensionless", "harmonics")}
SHORT = {"учеб"}  # учебное пособие
WORD = re.compile("[а-яё]*е[а-яё]*", re.IGNORECASE)
# The dictionary has other words that are written so, which do not occur here.
MEANT = re.compile(r"(?i)\b(?:объем|берет(?:ся)?|н?ее|(?:с|раз)вернут|все же|(?-i:Щеки))\b")
TITLES = re.compile(r"Конструкция и расчет|Несущая способность и расчет|«Расчет авто")
SEEN = (("kshm", "py"), ("reports", "py"), ("reports", "js"), ("templates", "j2"),
        ("samples", "toml"), ("tools", "py"), ("docs", "md"), (".", "ru.md"))  # fmt: skip


def without_dots(words: set[str]) -> set[str]:
    """Those that the dictionary, or our own list of words, has with their dots alone."""
    try:
        from pymorphy3 import MorphAnalyzer
    except ImportError:
        missing("pymorphy3", "python3-pip; pip install pymorphy3")
    parse = MorphAnalyzer(lang="ru").parse
    ours = OURS.read_text(encoding="utf-8").split()
    dotted = {own.replace("ё", "е") for own in ours if "ё" in own}
    plain = {word for word in words - SHORT if "ё" not in word.lower()}
    forms = {word: [p.word for p in parse(word) if p.is_known] for word in plain}
    known = {
        word
        for word, collected in forms.items()
        if collected and all("ё" in one for one in collected)
    }
    return known | {word for word in plain if word.lower() in dotted}


def test_what_a_user_reads_has_its_dots() -> None:
    texts = {
        str(path.relative_to(ROOT)): TITLES.sub("", path.read_text(encoding="utf-8"))
        for folder, kind in SEEN
        for path in sorted((ROOT / folder).glob(f"{'**/' * (folder != '.')}*.{kind}"))
    }
    texts = {name: text for name, text in texts.items() if name not in ALLOWED}
    matches = {word: name for name, text in texts.items() for word in WORD.findall(text)}
    assert len(matches) > 2500
    assert {word: matches[word] for word in without_dots(set(matches))} == {}
    assert {name: MEANT.findall(text) for name, text in texts.items() if MEANT.search(text)} == {}


def test_a_word_that_is_another_one_without_its_dots_is_noticed() -> None:
    for words in ("объем", "берется", "нее", "развернут", "Все же", "Щеки"):
        assert MEANT.search(words), words
    for words in ("объём", "берег", "все", "неё", "Щёки", "щеки"):
        assert not MEANT.search(words), words


@pytest.mark.parametrize(
    ("dotless", "right"),
    [
        (
            {"расчета", "Приведенная", "удается", "четырехтактный", "отчет", "ее", "смещенный"},
            False,
        ),
        ({"расчёта", "учебник", "отчётливо", "щека", "четверть", "все"}, True),
    ],
)
def test_a_word_without_its_dots_is_noticed(dotless: set[str], right: bool) -> None:
    assert without_dots(dotless) == (set() if right else dotless)
