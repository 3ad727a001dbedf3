"""Words that a user sees are written with ё: where the dictionary knows them with it alone."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.conftest import missing
from tests.house.test_house_spelling import OURS

ROOT = Path(__file__).parents[2]
# Names of columns that a list may have, words that an input may use, titles as printed.
ALLOWED = {"reports/grading/issuing/roster.py", "reports/inputs/understood.py"}
ALLOWED |= {f"kshm/mechanics/{name}.py" for name in ("dimensionless", "torque_harmonics")}
SHORT = {"учеб"}  # учебное пособие
WORD = re.compile("[а-яё]*е[а-яё]*", re.IGNORECASE)
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
    known = {word for word, found in forms.items() if found and all("ё" in one for one in found)}
    return known | {word for word in plain if word.lower() in dotted}


def test_what_a_user_reads_has_its_dots() -> None:
    found = {
        word: str(path.relative_to(ROOT))
        for folder, kind in SEEN
        for path in sorted((ROOT / folder).glob(f"{'**/' * (folder != '.')}*.{kind}"))
        if str(path.relative_to(ROOT)) not in ALLOWED
        for word in WORD.findall(TITLES.sub("", path.read_text(encoding="utf-8")))
    }
    assert len(found) > 2500
    assert {word: found[word] for word in without_dots(set(found))} == {}


@pytest.mark.parametrize(
    ("dotless", "right"),
    [
        ({"расчета", "Приведенная", "удается", "четырехтактный", "отчет", "смещенный"}, False),
        ({"расчёта", "учебник", "отчётливо", "щека", "четверть", "все"}, True),
    ],
)
def test_a_word_without_its_dots_is_noticed(dotless: set[str], right: bool) -> None:
    assert without_dots(dotless) == (set() if right else dotless)
