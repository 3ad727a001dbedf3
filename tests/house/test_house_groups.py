"""Tests that share costly things run in one process."""

from __future__ import annotations

from pytest import Config, FixtureRequest


def test_groups_hold(request: FixtureRequest, pytestconfig: Config) -> None:
    """Where the tests run in several processes, xdist must see a file's name as its group."""
    several = hasattr(pytestconfig, "workerinput") and pytestconfig.getoption("loadgroup")
    assert not several or request.node.nodeid.endswith("@tests/house/test_house_groups.py")
