"""Shared fixtures: samples solved once, referees, the rule for missing LibreOffice."""

from __future__ import annotations

import os
import tempfile
from functools import lru_cache
from pathlib import Path

import pytest
from hypothesis import settings

from reports.inputs.load import load_toml
from reports.inputs.sections.input_file import InputFile
from reports.shared.resources import samples_dir
from tools.referees.by_libreoffice import LibreOffice, find_soffice

# Random engines are slow to solve on a loaded machine: no deadline, the same examples in CI.
settings.register_profile("kshm", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("kshm")


def pytest_configure(config: pytest.Config) -> None:
    """Formulas and figures are kept for this run only, shared by its processes."""
    if not hasattr(config, "workerinput"):
        folder = tempfile.TemporaryDirectory(prefix="kshm-tests-", ignore_cleanup_errors=True)
        os.environ["KSHM_CACHE"] = folder.name
        config.add_cleanup(folder.cleanup)


@lru_cache(maxsize=32)
def sample(name: str) -> InputFile:
    """A sample's checked input."""
    return load_toml(samples_dir() / f"{name}.toml").model


def sample_names() -> list[str]:
    """All samples that are shipped."""
    return sorted(path.stem for path in samples_dir().glob("*.toml"))


@pytest.fixture(scope="session")
def libreoffice() -> LibreOffice:
    """The slow referee; without LibreOffice a skip, in CI a failure."""
    if find_soffice() is None:
        if os.environ.get("CI") == "true":
            pytest.fail("LibreOffice is missing: ./run test installs it")
        pytest.skip("LibreOffice не установлен: sudo apt-get install libreoffice-calc-nogui")
    return LibreOffice()


@pytest.fixture
def samples() -> Path:
    """Folder of the samples."""
    return samples_dir()
