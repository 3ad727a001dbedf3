"""Start of the command: ``kshm --help`` beside a Python that does nothing."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Iterator
from pathlib import Path

from reports.shared.resources import samples_dir
from tests.bench._figure import Figure
from tests.bench._process import kshm, median

ROOT = Path(__file__).parents[2]


def figures() -> Iterator[Figure]:
    """Figures."""
    bare = median([sys.executable, "-c", ""], times=9)
    help_text = median(kshm("--help"), times=9)
    yield Figure("kshm --help", help_text.wall, "с", "цель 0,2 на свободной машине")
    yield Figure("kshm --help: процессор", help_text.cpu, "с")
    yield Figure("пустой Python", bare.wall, "с")
    yield Figure("kshm --help: память", help_text.memory, "МБ")
    yield from _uncompiled()
    yield from _pythons()


def _uncompiled() -> Iterator[Figure]:
    """What ``./run`` saves each start by keeping compiled modules."""
    python, *rest = kshm("check", str(samples_dir() / "gots-diesel.toml"))
    check = [python, "-P", *rest]  # the copy is meant, not the folder in which this is called
    with tempfile.TemporaryDirectory() as name:
        for room in ("kshm", "reports", "templates"):
            bare = shutil.ignore_patterns("__pycache__")
            shutil.copytree(ROOT / room, Path(name) / room, ignore=bare)
        for wording, never in (("без готовых .pyc", "1"), ("с готовыми .pyc", "")):
            env = {"PYTHONPATH": name, "PYTHONDONTWRITEBYTECODE": never}
            median(check, times=1, env=env)  # where they are kept, they are made here
            cost = median(check, times=5, env=env)
            yield Figure(f"kshm check {wording}: процессор", cost.cpu, "с")


def _pythons() -> Iterator[Figure]:
    """What ``./run`` gains by the system's Python, where another of the same version is there."""
    paths = os.pathsep.join((str(ROOT), sysconfig.get_path("purelib")))
    env = {"PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": ""}
    check = kshm("check", str(samples_dir() / "gots-diesel.toml"))[1:]
    for python in sorted(_same_version()):
        median([python, *check], times=1, env=env)  # its modules are compiled
        cost = median([python, *check], times=7, env=env)
        yield Figure(f"kshm check, {python}: процессор", cost.cpu, "с")


def _same_version() -> set[str]:
    """The Pythons of this one's version, those of environments aside."""
    requested = (
        "import os, sys; print(os.path.realpath(sys.executable), sys.prefix == sys.base_prefix)"
    )
    folders = ("/usr/bin", *os.environ["PATH"].split(os.pathsep))
    collected = set()
    for program in {Path(folder, f"python3.{sys.version_info.minor}") for folder in folders}:
        if program.is_file():
            done = subprocess.run(
                [program, "-c", requested], capture_output=True, text=True, check=False
            )
            collected |= {done.stdout.split()[0]} if done.stdout.endswith("True\n") else set()
    return collected
