"""Reactions of the continuous shaft beside those of the split scheme, Gots (54)."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars
from kshm.engine.engine import Engine
from kshm.mechanics import continuous_beam, journals
from kshm.results.case import Case
from kshm.results.extremes import UNLOADED


def _applies(engine: Engine) -> bool:
    """Whether the shaft has inner supports and rods that pull at undivided pins."""
    whole = all(c.pin_angle == 0 and c.master is None for c in engine.arrangement)
    return len(engine.crankshaft.throws) > 1 and whole and engine.force_offsets is None


def continuous_results(case: Case) -> Results:
    """Moments and reactions over the cycle, their means and extremes against the split scheme's.

    SI units; nothing where the scheme does not apply.
    """
    engine, raw, index = case.engine, case.raw, case.index
    if not _applies(engine):
        return {}, {}
    shaft, area = engine.crankshaft, engine.geometry.piston_area
    moments, reactions = _reactions(case)
    table: Columns = {"phi_deg": raw.phi}
    for k in range(1, len(moments) - 1):
        table |= {f"Ms{axis}{k + 1}_Nm": moments[k, :, i] for i, axis in enumerate("xy")}
    scalars: Scalars = {}
    for k, (x, y) in enumerate(np.moveaxis(reactions, -1, 1), 1):
        load, split = np.hypot(x, y), raw.journal_load[index, k - 1]
        table |= {f"Rcx{k}_MPa": x, f"Rcy{k}_MPa": y, f"Rc{k}_MPa": load}
        mean, most = float(load[:-1].mean()), float(load.max())
        projected = shaft.main_diameters[k - 1] * shaft.main_lengths[k - 1]
        scalars |= {
            f"Rc{k}_mean": mean,
            f"Rc{k}_max": most,
            f"dRc{k}_mean": _over(mean, float(split[:-1].mean())),
            f"dRc{k}_max": _over(most, float(split.max())),
            f"qc{k}_max": most * area / projected,
        }
    return {"continuous": table}, scalars


def _over(load: float, split: float) -> float:
    """How much a load is over that of the split scheme [-]; none over a journal without load."""
    return load / split - 1 if split > UNLOADED else 0.0


def _reactions(case: Case) -> tuple[Array, Array]:
    """Moments [N·m] and specific reactions [Pa] of all supports, (journals, angles, 2)."""
    engine, raw, at = case.engine, case.raw, slice(case.index, case.index + 1)
    batch, area = raw.batch, engine.geometry.piston_area
    unit, throws = batch.r[:, :, 0] * batch.omega[:, :, 0] ** 2, batch.throws
    count, angles = throws.angle.shape[1], len(raw.phi)
    gamma, length = throws.angle[at, :, None], throws.places.length[at, :, None]
    ones = np.ones_like(throws.angle)
    loads = [
        journals.Load(*(part[at, :, None] for part in load))
        for load in journals.own_loads(throws, unit, ones, 0 * ones)
    ]
    spin = batch.pin_mass[at] * unit[at, :, None]
    for place in sorted(set(batch.rods.place)):
        # The rods that stand there, each on its throw.
        here = (np.array(batch.rods.place) == place)[:, None]
        left, up = (
            batch.rods.summed(force * here, count)
            for force in (-raw.T[at] * area, spin - raw.K[at] * area)
        )
        loads.append(journals.Load(throws.places.rod_at(place)[at, :, None], left, up))
    terms = continuous_beam.load_terms(loads, length, (1, count, angles))
    right, left = (
        np.stack(journals.to_shaft_axes(term[..., 0], term[..., 1], gamma), axis=-1)[0]
        for term in terms
    )
    ends = np.stack(
        [
            np.stack(journals.to_shaft_axes(load.left, load.up, throws.angle), axis=-1)[
                case.index, throw
            ] * -arm
            for load, arm, throw in zip(
                journals.end_loads(throws, unit), throws.end_arm[case.index], (0, -1), strict=True
            )
        ]
    )  # fmt: skip
    spans = throws.places.length[case.index]
    moments = continuous_beam.support_moments(
        spans, right, left, np.broadcast_to(ends[:, None], (2, angles, 2))
    )
    return moments, raw.journal[case.index] + continuous_beam.corrections(spans, moments) / area
