"""The ruler of the structure measures a small tree whose figures are counted by hand."""

from __future__ import annotations

import pytest

from tools.house.code import Code
from tools.house.measures import MEASURES

FILES = {
    "kshm/__init__.py": "from kshm import defaults\n",
    "kshm/defaults.py": "import kshm\nLEAST, MOST = 0.24, 0.31\n",
    "kshm/solver.py": '''"""Solver."""
from kshm.defaults import LEAST

def solve(found):
    """Returns the speeds."""
    return found

STEP = 1
''',
    "reports/torsion.py": '''from kshm import solver
class TorsionError(ValueError): pass
def words(line):
    """Say whether a line warns."""
    return line.startswith("Внимание") or line == "НЕТ" or solver.solve("torsion")
def only_tests(): pass
''',
    "templates/tables/torsion.book": "% if given.torsion\nlist a: А\nk = {{ c }}\n% endif\n",
    "templates/tables/lam.book": "check lam = lam | обычно 0,24…0,31\n",
    "tests/test_words.py": "from reports.torsion import only_tests\nmade = only_tests()\n",
}
COUNTED = {
    "files of Python / books": "4 / 2",
    "lines, Python + books / tests": "17 + 5 / 2",
    "imports between files / between rooms": "5 / 1",
    "circles of files": "1",
    "circles of rooms": "0",
    "files named after torsion / oil / strength": "2 / 0 / 0",
    'files that quote "torsion" / "strength"': "1 / 0",
    "vague names: first list / second list": "2 / 0",
    "vague names of the first list in tests": "1",
    "decisions on a Russian text": "2 in 1 files",
    "files that state the usual range of λ": "2",
    "Jinja in books, % of lines alone / at all; torsion; throws": "40 / 60; 50 / 75; 0 / 0",
    "functions: mean lines / over 40": "2.3 / 0.0 %",
    "docstrings not in the imperative": "1 of 2",
    "constants below the first function": "1 in 1 files",
    "classes of errors": "1 in 1 files",
    "functions that tests alone call": "1",
}


@pytest.fixture(scope="module")
def code(tmp_path_factory: pytest.TempPathFactory) -> Code:
    root = tmp_path_factory.mktemp("tree")
    for name, text in FILES.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")
    return Code(root)


@pytest.mark.parametrize(("title", "value"), COUNTED.items())
def test_a_row_is_counted_as_by_hand(code: Code, title: str, value: str):
    assert MEASURES[title](code) == value
