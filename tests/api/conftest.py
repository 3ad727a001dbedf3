"""Examples of docstrings, run one after another with the names that the first of them make."""

from __future__ import annotations

import doctest

import pytest

import kshm


@pytest.fixture(scope="module")
def example_names() -> dict:
    """Names of the package and those that the example of ``in_line`` makes for the others."""
    names = {name: getattr(kshm, name) for name in kshm.__all__}
    run_text("in_line", kshm.in_line.__doc__ or "", names)
    return names


def run_text(name: str, text: str, names: dict) -> None:
    """Run the examples of a docstring; fail where one says something else."""
    test = doctest.DocTestParser().get_doctest(text, names, name, None, None)
    test.globs = names
    assert test.examples, f"{name} has no example"
    said: list[str] = []
    result = doctest.DocTestRunner().run(test, out=said.append, clear_globs=False)
    assert result.failed == 0, "".join(said)
