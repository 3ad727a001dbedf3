"""Several inputs built after one another here, or side by side on a Dask cluster."""

from __future__ import annotations

import gc
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from reports.exports.build import ENDINGS, Built, Further, Kind, build, kinds_of
from reports.inputs.load import Loaded
from reports.shared.errors import KshmError, SystemPartMissing
from reports.shared.files import make_dir, refuse_own, write_bytes
from reports.shared.ordered import in_order

Input = tuple[Path, Loaded]
Chapters = Callable[[Path, Loaded], Further]


def _no_chapters(_path: Path, _loaded: Loaded) -> Further:
    return ()


@dataclass(frozen=True, slots=True)
class Order:
    """A checked input with all that building it elsewhere needs."""

    name: str
    data: bytes
    loaded: Loaded
    kinds: tuple[Kind, ...]
    further: Further = ()


@dataclass(frozen=True, slots=True)
class Delivery:
    """Files by name, what the other machine lacked, failed checks and explained ones."""

    files: list[tuple[str, bytes]]
    missing: tuple[str, str, str] | None = None
    failed: tuple[str, ...] = ()
    accepted: tuple[str, ...] = ()


def build_each(
    inputs: Sequence[Input],
    folder: Path,
    only: tuple[Kind, ...] = (),
    dask: str | None = None,
    chapters: Chapters = _no_chapters,
    style: Path | None = None,
) -> Iterator[Built]:
    """What was built for each input, in order; the files are the same wherever it is done.

    ``only`` are the kinds of documents in place of those that an input asks for.
    ``chapters`` gives the further chapters of an input's report.

    Raises:
        KshmError: results would fall on each other or on an input, or the cluster fails.
    """
    _refuse_overlap([path for path, _ in inputs])
    endings = [ending for kind in ENDINGS.values() for ending in kind]
    results = [folder / f"{path.stem}{ending}" for path, _ in inputs for ending in endings]
    refuse_own(results, [file for path, loaded in inputs for file in (path, *loaded.beside)])
    if dask is None:
        for number, (path, loaded) in enumerate(inputs):
            if number:
                gc.collect()  # see reports/__main__.py
            kinds = kinds_of(loaded, only)
            yield build(path, loaded, folder, kinds, chapters(path, loaded), style)
        return
    make_dir(folder)
    orders = (
        _order(path, loaded, kinds_of(loaded, only), chapters(path, loaded), style)
        for path, loaded in inputs
    )
    for delivery in in_order(delivered, orders, dask=dask):
        for name, data in delivery.files:
            write_bytes(folder / name, data)
        missing = None
        if delivery.missing:
            part, command, purpose = delivery.missing
            missing = SystemPartMissing(part, command, purpose=purpose)
        files = tuple(folder / name for name, _ in delivery.files)
        yield Built(files, missing, delivery.failed, delivery.accepted)


def delivered(order: Order) -> Delivery:
    """Build an order in a folder of its own."""
    with tempfile.TemporaryDirectory(prefix="kshm-build-") as name:
        source, out = Path(name) / order.name, Path(name) / "out"
        source.write_bytes(order.data)
        built = build(source, order.loaded, out, order.kinds, order.further)
        files = [(path.name, path.read_bytes()) for path in built.files]
        lacks = built.missing
        missing = (lacks.part, lacks.command, lacks.purpose) if lacks else None
        return Delivery(files, missing, built.failed, built.accepted)


def _order(
    path: Path, loaded: Loaded, kinds: tuple[Kind, ...], further: Further, style: Path | None
) -> Order:
    if style is not None or loaded.model.report.style:
        msg = f"{path}: файл оформления (report.style) есть только на этом компьютере; без --dask"
        raise KshmError(msg)
    if loaded.model.report.templates:
        msg = f"{path}: свои шаблоны (report.templates) есть только на этом компьютере; без --dask"
        raise KshmError(msg)
    return Order(path.name, path.read_bytes(), loaded, kinds, further)


def _refuse_overlap(paths: Sequence[Path]) -> None:
    stem, count = Counter(path.stem for path in paths).most_common(1)[0]
    if count > 1:
        msg = f"{stem}: два файла с этим именем дали бы один результат; стройте их в разные папки"
        raise KshmError(msg)
