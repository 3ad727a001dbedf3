"""Bands of results for inputs within tolerances, and which input moves a result most.

The sampling is scipy's, an optional package: ``pip install "kshm[optimise]"``.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from kshm.arrays import Array
from kshm.engine.checks import as_scalar, check_kind, refuse
from kshm.engine.engine import Engine
from kshm.engine.revised import find
from kshm.errors import InputError, KshmError, Problem
from kshm.results.study import MAIN, Progress, Row, Solved, Study, in_order

if TYPE_CHECKING:
    import pandas as pd

QUANTILES = (0.025, 0.5, 0.975)
MIN_SAMPLES, MAX_SAMPLES = 20, 1_000_000
_SEED = 1  # the same study gives the same numbers


@dataclass(frozen=True, slots=True)
class ResultBand:
    """A result within its tolerances, in the unit of its quantity.

    Attributes:
        name: the quantity.
        base: at the base.
        low, middle, high: quantiles 2.5 %, 50 % and 97.5 %.
        least, greatest: extremes of the sample.
        ranks: Spearman's rank correlation with each input by name.
    """

    name: str
    base: float
    low: float
    middle: float
    high: float
    least: float
    greatest: float
    ranks: Mapping[str, float]

    @property
    def first(self) -> str:
        """Name of the input that moves the result most, empty where none does."""
        name = max(self.ranks, key=lambda each: abs(self.ranks[each]))
        return name if self.ranks[name] else ""


@dataclass(frozen=True, slots=True)
class Bands:
    """Bands of all results; ``samples`` has every engine of the sample.

    >>> Bands((), {}, None, 0).bands
    ()
    """

    bands: tuple[ResultBand, ...]
    tolerances: Mapping[str, float]
    samples: Any
    failed: int

    @property
    def table(self) -> pd.DataFrame:
        """One row a result: base, quantiles, extremes, the first input and its correlation."""
        import pandas as pd

        return pd.DataFrame(
            [
                [b.base, b.low, b.middle, b.high, b.least, b.greatest, b.first,
                 b.ranks.get(b.first, 0.0)]
                for b in self.bands
            ],
            index=[b.name for b in self.bands],
            columns=["base", "2.5 %", "50 %", "97.5 %", "min", "max", "first", "rank"],
        )  # fmt: skip

    def _repr_html_(self) -> str:
        """Return the table as a notebook shows it."""
        return str(self.table.to_html())


def tolerance(
    engine: Engine,
    tolerances: Mapping[str, float],
    *,
    quantities: Collection[str] = MAIN,
    samples: int = 1000,
    jobs: int = 1,
    progress: bool | Progress = False,
) -> Bands:
    """Return the bands of results of an engine whose inputs scatter within tolerances.

    Args:
        engine: the base.
        tolerances: ± by name of the input, as in ``kshm.sweep``, in its unit: the value is
            anywhere within with the same probability, each by itself; of a key with a star every
            member by itself.
        quantities: as in ``kshm.sweep``.
        samples: engines; they fill the space as a Latin hypercube (scipy's ``qmc``), always the
            same.
        jobs: processes, as in ``kshm.sweep``.
        progress: as in ``kshm.sweep``.

    Returns:
        Quantiles 2.5, 50 and 97.5 %, extremes and Spearman's rank correlations of each result
        with each input.

    Raises:
        InputError: a name or a quantity that there is not, a tolerance that is none, no engine
            that is solved.
        KshmError: scipy is not installed.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> bands = tolerance(engine, {"speed_rpm": 60, "bore_mm": 0.02}, quantities=["c_m", "V_h"])
    >>> bands.table["first"].tolist()  # the speed of the piston, the volume of a cylinder
    ['speed_rpm', 'bore_mm']
    >>> round(bands.bands[0].high - bands.bands[0].base, 3)  # 0.95 · 60 · S/30 [m/s]
    0.152
    """
    qmc = _sampler()
    check_kind("engine", engine, Engine)
    check_kind("tolerances", tolerances, Mapping)
    check_kind("samples", samples, int)
    refuse(
        (not tolerances, "name a tolerance"),
        (not MIN_SAMPLES <= samples <= MAX_SAMPLES,
         f"samples: from {MIN_SAMPLES} to {MAX_SAMPLES}, not {samples}"),
    )  # fmt: skip
    spans = _spans(engine, tolerances)
    study = Study.of(engine, tuple(spans), quantities)
    middle, half = (np.array(each) for each in zip(*spans.values(), strict=True))
    unit = qmc.LatinHypercube(len(spans), rng=_SEED).random(samples)
    rows: list[Row] = [tuple(row) for row in (middle + half * (2 * unit - 1)).tolist()]
    parts = list(in_order(study, rows, jobs, progress=progress))
    base = study.solve([tuple(middle.tolist())])
    return _bands(study, parts, base, {name: t for name, (_, t) in spans.items()})


def _bands(
    study: Study, parts: list[Solved], base: Solved, tolerances: Mapping[str, float]
) -> Bands:
    frame = study.frame(parts)
    good = frame[frame["error"] == ""]
    if not len(good):
        raise InputError(f"no engine within the tolerances is solved: {frame['error'].iloc[0]}")
    inputs = {name: _ranks(good[name].to_numpy(dtype=float)) for name in tolerances}
    bands = []
    for name in study.chosen.names:
        values = good[name].to_numpy(dtype=float)
        low, middle, high = np.quantile(values, QUANTILES)
        ranks = {each: _correlation(_ranks(values), other) for each, other in inputs.items()}
        bands.append(
            ResultBand(
                name, float(base.values[name][0]), float(low), float(middle), float(high),
                float(values.min()), float(values.max()), ranks,
            )
        )  # fmt: skip
    return Bands(tuple(bands), tolerances, frame, len(frame) - len(good))


def _spans(engine: Engine, tolerances: Mapping[str, float]) -> dict[str, tuple[float, float]]:
    """Return the base value and the tolerance of each input by name."""
    source = engine.source
    if source is not None and not source.has_made(engine):
        source = None
    spans: dict[str, tuple[float, float]] = {}
    for name, half in tolerances.items():
        number = float(half) if isinstance(as_scalar(half), Real) else math.nan
        if not (math.isfinite(number) and number > 0):
            problem = f"the tolerance must be a positive number, not {half!r}"
            raise InputError(Problem(str(name), problem, "e.g. 0.02", (0.0, None), half))
        key = source.find(name) if source is not None else ""
        if source is not None and key:
            spans |= {each: (value, number) for each, value in source.values(key).items()}
        else:
            spans[name] = (float(find(engine, name).value_in(engine)), number)
    return spans


def _ranks(values: Array) -> Array:
    """Return the ranks of values, shape (values,); equal ones share the mean of theirs."""
    _, inverse, counts = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(counts)
    ranks: Array = (last - (counts - 1) / 2)[inverse]
    return ranks


def _correlation(one: Array, other: Array) -> float:
    a, b = one - one.mean(), other - other.mean()
    size = math.sqrt(float(a @ a) * float(b @ b))
    return float(a @ b) / size if size else 0.0


def _sampler() -> Any:  # noqa: ANN401
    try:
        from scipy.stats import qmc
    except ImportError:
        raise KshmError('this needs scipy: pip install "kshm[optimise]"') from None
    return qmc
