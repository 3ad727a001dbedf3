"""Where another process comes from."""

from __future__ import annotations

import multiprocessing
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from multiprocessing.context import ForkServerContext, SpawnContext


def processes(needs: str) -> ForkServerContext | SpawnContext:
    """Copies of a process that has imported a module; elsewhere than on Linux each imports it."""
    if sys.platform != "linux":
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([needs])  # heard before the first copy
    return context
