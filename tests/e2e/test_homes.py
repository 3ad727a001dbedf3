"""Commands of a user without a home, with one that cannot be written, with far temporary files."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.robustness.command import ROOT, small_input

needs_root = pytest.mark.skipif(
    sys.platform == "win32" or os.geteuid() != 0 or not Path("/usr/bin/setpriv").exists(),
    reason="takes the place of another user",
)
NOBODY = 54321  # has neither a name nor a home
BASE, ROSTER = "samples/class/base.toml", "samples/class/group.csv"


def as_nobody(folder: Path, *arguments: object, **home: str) -> subprocess.CompletedProcess[str]:
    folder.chmod(0o777)
    for parent in folder.parents:
        if parent.stat().st_mode & 0o777 == 0o700:  # made by pytest for one user alone
            parent.chmod(0o755)
    user = ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups"]
    environment = {"PATH": "/usr/bin:/bin", "PYTHONPATH": str(ROOT)} | home
    command = [*user, sys.executable, "-m", "reports", *map(str, arguments)]
    if subprocess.run([*user, "test", "-r", str(ROOT / "pyproject.toml")], check=False).returncode:
        pytest.skip("the repository lies where only its owner may read")
    return subprocess.run(
        command, env=environment, cwd=ROOT, capture_output=True, text=True, check=False
    )


@needs_root
def test_a_user_without_a_home_has_a_sheet_and_is_asked_for_the_secret(tmp_path):
    engine = small_input(tmp_path)
    done = as_nobody(tmp_path, "build", engine, "--only", "sheet", "-o", tmp_path / "out")
    assert done.returncode in (0, 1), done.stderr
    assert len(list((tmp_path / "out").glob("*.dxf"))) == 3
    assert "atplotlib" not in done.stderr
    issued = ("issue", BASE, "--roster", ROSTER, "-o", tmp_path / "issued")
    done = as_nobody(tmp_path, *issued)
    assert (done.returncode, done.stderr) == (
        2,
        "нет домашней папки, где хранить секрет; укажите файл для него ключом --secret\n",
    )
    done = as_nobody(tmp_path, *issued, "--secret", tmp_path / "secret.key")
    assert done.returncode == 0, done.stderr


@needs_root
def test_nothing_is_said_of_a_home_that_cannot_be_written(tmp_path):
    engine, home = small_input(tmp_path), tmp_path / "home"
    home.mkdir(mode=0o555)
    done = as_nobody(
        tmp_path, "build", engine, "--only", "sheet", "-o", tmp_path / "out", HOME=str(home)
    )
    assert done.returncode in (0, 1), done.stderr
    assert all(line.startswith("Внимание") for line in done.stderr.splitlines()), done.stderr


@pytest.mark.skipif(sys.platform == "win32", reason="sockets with names")
def test_processes_start_with_temporary_files_far_away(tmp_path):
    far = tmp_path / ("f" * 90)
    far.mkdir()
    vary = ("--vary", "geometry.bore_mm=84:92:9", "--jobs", 2)
    target = tmp_path / "study.csv"
    words = map(str, ("sweep", "samples/gots-diesel.toml", *vary, "-o", target))
    done = subprocess.run(
        [sys.executable, "-m", "reports", *words], cwd=ROOT, capture_output=True, text=True,
        env={**os.environ, "TMPDIR": str(far)}, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert len(target.read_text().splitlines()) == 10
