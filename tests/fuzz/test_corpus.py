"""Every kept input of the three doors once more: seeds, and what once broke the program."""

from __future__ import annotations

import random
import subprocess
import sys
from pathlib import Path

import pytest

from tests.fuzz.doors import DOORS
from tests.fuzz.recipes import TOKENS, changed_book

CORPUS = Path(__file__).with_name("corpus")
ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("door", sorted(DOORS))
def test_the_corpus_is_answered(door):
    paths = sorted((CORPUS / door).iterdir())
    assert len(paths) > 5
    for path in paths:
        assert DOORS[door](path.read_bytes()), path.name


@pytest.mark.parametrize(("door", "answer"), [("workbook", "accepted"), ("grading", "graded")])
def test_an_empty_recipe_changes_nothing(door, answer):
    assert DOORS[door](b"") == answer


@pytest.mark.parametrize("door", ["workbook", "grading"])
def test_what_is_no_workbook_is_refused(door):
    assert DOORS[door](b"PK\3\4 and no more") == "refused"


def test_a_recipe_makes_the_same_book_again():
    rng = random.Random(3)
    parts = {"xl/workbook.xml": b'<a b="1">2</a>', "xl/worksheets/sheet1.xml": b"<c><v>5</v></c>"}
    values = set()
    for _ in range(200):
        recipe = rng.randbytes(rng.randrange(40))
        book = changed_book(parts, recipe)
        assert changed_book(parts, recipe) == book
        values.add(book)
    assert len(values) > 100
    assert len(set(TOKENS)) == len(TOKENS)


def test_the_command_tries_inputs_without_atheris():
    done = subprocess.run(
        [sys.executable, "-m", "tests.fuzz", "toml", "1", "--blind"],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "отказов программы: 0" in done.stdout
