"""A command of kshm in a process of its own: little memory, bounded time, nothing left behind."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from reports.shared.errors import one_line

_LINES = 40  # of what a command said
# The command with little memory, which ends with a server that is killed; who waits for a number
# comes before who waits for a file.
_KSHM = """
import ctypes, os, sys
server = int(sys.argv.pop(1))
if sys.platform == "linux":
    ctypes.CDLL(None).prctl(1, 9)
    if os.getppid() != server:  # it had gone before; in Windows a launcher stands between the two
        sys.exit("server is gone")
from reports.shared.workers import limit_memory
from reports.__main__ import start
limit_memory(3 * 2**30)
getattr(os, "nice", abs)(5)
start()
"""
_SYSTEM = (
    "PATH", "HOME", "LANG", "LC_ALL", "TMPDIR", "PYTHONPATH", "FONTCONFIG_PATH", "FONTCONFIG_FILE",
    "XDG_CACHE_HOME",
    # Windows: where programs, fonts, settings, temporary files and the parts of WeasyPrint are
    "SYSTEMROOT", "WINDIR", "USERPROFILE", "LOCALAPPDATA", "TEMP", "WEASYPRINT_DLL_DIRECTORIES",
)  # fmt: skip


def failed(why: str) -> dict[str, Any]:
    """How a command ended that could not be done."""
    return {"state": "failed", "lines": [why]}


async def run(arguments: Sequence[str], folder: Path, timeout_s: float) -> dict[str, Any]:
    """Run a command of kshm in a folder with limits; its whole group ends with it.

    Returns:
        Whether it is done or failed, and what it said.
    """
    kept = {key: os.environ[key] for key in _SYSTEM if key in os.environ}
    home = [str(Path(__file__).resolve().parents[2]), kept.get("PYTHONPATH", "")]
    kept |= {"PYTHONPATH": os.pathsep.join(filter(None, home)), "PYTHONIOENCODING": "utf-8"}
    kept |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}  # as many jobs as processors
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-c", _KSHM, str(os.getpid()), *arguments, cwd=folder, env=kept,
        start_new_session=True, stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.DEVNULL, stderr=asyncio.subprocess.PIPE,
    )  # fmt: skip
    try:
        _, said = await asyncio.wait_for(process.communicate(), timeout_s)
    except TimeoutError:
        return failed(f"не сделано за {timeout_s:.0f} с: уменьшите расчёт")
    finally:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL) if hasattr(os, "killpg") else process.kill()
        with contextlib.suppress(asyncio.CancelledError):
            await process.wait()
    code = process.returncode or 0
    if code < 0:
        return failed("процесс прерван: повторите")
    lines = said.decode("utf-8", "replace").replace(f"{folder}{os.sep}", "").splitlines()
    return {
        "state": "done" if code in (0, 1) else "failed",
        "lines": [one_line(line, 400) for line in lines if line.strip()][:_LINES],
    }
