"""A book of the manual with a small slip: fine at check and at build, or one sentence at check."""

from __future__ import annotations

import random
import re

import pytest

from reports.exports.book_trial import refuse_unbuilt
from reports.exports.department_chapters import refuse_faults
from reports.shared.errors import InputError
from tests.cover import ALL
from tests.manual.pages import DOCS, blocks
from tests.own.test_book_mistakes import engine

(BOOK,) = blocks(DOCS / "own-chapter.md", "book")
SIGNS = "()|=:;,.{}%\"^$\\_ 0x-+*/<>'#й@&~…—"
SLIPS, GROUPS = 200, 10


def slipped(number: int) -> str:
    """The book with one or two slips of a hand: a sign, a word or a line is lost or moved."""
    drawn, text = random.Random(number), BOOK
    for _ in range(drawn.choice((1, 1, 2))):
        lines, at = text.split("\n"), drawn.randrange(len(text))
        one, other = drawn.randrange(len(lines)), drawn.randrange(len(lines))
        word = drawn.choice(list(re.finditer(r"\w+", text)))
        match drawn.choice(
            ("lost", "sign", "no line", "twice", "another", "case", "moved", "no word")
        ):
            case "lost":
                text = text[:at] + text[at + 1 :]
            case "sign":
                text = text[:at] + drawn.choice(SIGNS) + text[at:]
            case "no line":
                text = "\n".join(lines[:one] + lines[one + 1 :])
            case "twice":
                text = "\n".join([*lines[:one], lines[other], *lines[one:]])
            case "another":
                text = text[: word.start()] + drawn.choice(BOOK.split()) + text[word.end() :]
            case "case":
                text = text[: word.start()] + word[0].swapcase() + text[word.end() :]
            case "moved":
                lines[one], lines[other] = lines[other], lines[one]
                text = "\n".join(lines)
            case _:
                text = text[: word.start()] + text[word.end() :]
    return text


# Two groups in a day's run, all of them with KSHM_ALL=1.
@pytest.mark.parametrize("group", range(GROUPS if ALL else 2))
def test_a_slip_is_told_or_does_no_harm(group: int):
    """Each document is made of what check takes: `refuse_unbuilt` makes them all."""
    message = 0
    for number in range(group, SLIPS, GROUPS):
        try:
            model = engine(slipped(number))
            refuse_faults(model)
        except InputError as error:
            message += 1
            for line in str(error).splitlines():
                assert re.match(r"к\.book: строка \d+, столбец \d+: .+; .+", line), (number, line)
                assert "складывается" not in line and "печатается" not in line, (number, line)
            continue
        try:
            refuse_unbuilt(model, whole=number % (3 * GROUPS) == group)
        except InputError as error:
            assert "не набирается" in str(error) or "уже стоит" in str(error), (number, str(error))
    assert 0 < message < SLIPS // GROUPS
