"""The language of expressions holds what formulas need and nothing else."""

import re
from pathlib import Path

from reports import tables
from reports.formula.parse import AGGREGATES, FUNCTIONS, SCALES, SHIFTS
from reports.shared.resources import templates_dir

_CALL = re.compile(r"\b([a-z]\w*?)(_\{\w+\})?\(")  # sin(…), fourier_{part}(…)


def test_every_function_is_called_by_a_formula():
    """What nobody calls no comparison would see when it is wrong."""
    paths = [*Path(tables.__path__[0]).rglob("*.py"), *(templates_dir() / "tables").glob("*.book")]
    texts = "".join(path.read_text(encoding="utf-8") for path in paths)
    calls = {(name, bool(ending)) for name, ending in _CALL.findall(texts)}
    called = {name for name, _ in calls}
    families = tuple(f"{name}_" for name, has_ending in calls if has_ending)
    assert not {f for f in FUNCTIONS if f not in called and not f.startswith(families)}
    assert called >= AGGREGATES | SHIFTS
    assert {unit for unit in SCALES if {f"to_{unit}", f"of_{unit}"}.isdisjoint(called)} == set()
