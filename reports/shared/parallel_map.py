"""Map a function over items in this process, in several or on Dask; results in order.

Whatever the place, the same function gets the same items, so the results are the same
byte for byte.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future
from typing import Any, TypeVar

from reports.shared.background import processors
from reports.shared.errors import Died, KshmError, NeverStarted, SystemPartMissing
from reports.shared.workers import Workers

Item = TypeVar("Item")
Result = TypeVar("Result")

_AHEAD = 3  # items a worker has before it, so that it never waits
_CONNECT_S = 10


def in_order(
    work: Callable[[Item], Result],
    items: Iterable[Item],
    *,
    jobs: int = 1,
    dask: str | None = None,
) -> Iterator[Result]:
    """Results of ``work`` in the order of the items, which are read as they are needed.

    Args:
        work: a function of a module, so that other processes find it.
        items: what it is called with, one at a time.
        jobs: processes on this machine; 1 works in this one.
        dask: address of a Dask scheduler, whose workers have this program installed.

    Raises:
        KshmError: the cluster cannot be reached or lost too many workers.
        SystemPartMissing: the extra package for Dask is not installed.
    """
    if dask is not None:
        yield from _on_cluster(work, items, dask)
    elif jobs > 1:
        yield from _in_processes(work, items, jobs)
    else:
        yield from map(work, items)


def _in_processes(
    work: Callable[[Item], Result], items: Iterable[Item], jobs: int
) -> Iterator[Result]:
    jobs = min(jobs, processors())  # more would only wait for each other
    with Workers(jobs, _same, work, needs=work.__module__, memory=None, most=None) as pool:

        def submit(_: Callable[[Item], Result], item: Item) -> Future[Any]:
            return pool.ask(item, seconds=None)

        try:
            yield from _windowed(submit, work, items, jobs * _AHEAD)
        except (Died, NeverStarted):
            msg = "процесс расчёта прерван; освободите память или уменьшите число процессов"
            raise KshmError(msg) from None


def _same(work: Callable[[Item], Result]) -> Callable[[Item], Result]:
    return work


def _on_cluster(
    work: Callable[[Item], Result], items: Iterable[Item], address: str
) -> Iterator[Result]:
    try:
        from distributed import CancelledError, Client, KilledWorker
    except ImportError:
        raise SystemPartMissing(
            "пакет dask", 'pip install "kshm[dask]"', purpose="для ключа --dask"
        ) from None
    try:
        client: Any = Client(address, timeout=_CONNECT_S, set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError, TimeoutError):
        msg = (
            f"--dask {address}: планировщик не отвечает; проверьте адрес, например tcp://host:8786"
        )
        raise KshmError(msg) from None
    # What it has to say of a lost connection is said in one sentence here.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    with client:
        workers = max(1, sum(client.nthreads().values()))

        def submit(function: Callable[[Item], Result], item: Item) -> Any:  # noqa: ANN401
            return client.submit(function, item, pure=False)

        try:
            yield from _windowed(submit, work, items, workers * _AHEAD)
        except KilledWorker:
            msg = f"--dask {address}: процессы кластера гибнут один за другим; проверьте их память"
            raise KshmError(msg) from None
        except (CancelledError, OSError) as error:
            if client.status == "running":
                raise
            msg = f"--dask {address}: планировщик пропал; запустите его и повторите команду"
            raise KshmError(msg) from error


def _windowed(
    submit: Callable[[Callable[[Item], Result], Item], Any],
    work: Callable[[Item], Result],
    items: Iterable[Item],
    ahead: int,
) -> Iterator[Result]:
    """Yield a bounded number of items under way: neither inputs nor results pile up."""
    waiting: deque[Any] = deque()
    try:
        for item in items:
            waiting.append(submit(work, item))
            if len(waiting) >= ahead:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        for future in waiting:
            future.cancel()
