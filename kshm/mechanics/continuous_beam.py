"""Main-bearing reactions of the continuous shaft by the equation of three moments, Gots (54).

The shaft is a straight beam of one bending stiffness in both planes on rigid point
supports in a line, so that the stiffness itself falls out; the throws are as stiff as the
journals between them.  Moments are those that a load along the axis would make in a simple
beam, axes are those of the shaft (x left, y up along crank 1, turning with it).  In (54)
the second subscript of the last moment is read as the right support.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.arrangement import throws as throws_of
from kshm.mechanics import journals

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution
    from kshm.engine.engine import Engine

Array = NDArray[np.float64]
Columns = dict[str, Array]


def applies(engine: Engine) -> bool:
    """Whether the shaft has inner supports and rods that pull at undivided pins."""
    whole = all(c.pin_angle == 0 and c.master is None for c in engine.arrangement)
    return len(engine.crankshaft.throws) > 1 and whole and engine.force_offsets is None


def support_moments(spans: Array, right: Array, left: Array, ends: Array) -> Array:
    """Bending moments at all supports by Clapeyron's equation [N·m].

    Args:
        spans: lengths of the spans [m], shape (n,).
        right: Σ P a(l² − a²)/l of each span [N·m²], shape (n, …).
        left: Σ P b(l² − b²)/l of each span [N·m²], same shape.
        ends: moments at the first and the last support from the overhangs, shape (2, …).

    Returns:
        Shape (n + 1, …).
    """
    count = len(spans)
    moments = np.zeros((count + 1, *right.shape[1:]))
    moments[0], moments[-1] = ends[0], ends[1]
    if count == 1:
        return moments
    matrix = np.diag(2 * (spans[:-1] + spans[1:]))
    matrix += np.diag(spans[1:-1], 1) + np.diag(spans[1:-1], -1)
    known = -(right[:-1] + left[1:])
    known[0] -= spans[0] * ends[0]
    known[-1] -= spans[-1] * ends[1]
    flat = known.reshape(count - 1, -1)
    moments[1:-1] = np.linalg.solve(matrix, flat).reshape(known.shape)
    return moments


def corrections(spans: Array, moments: Array) -> Array:
    """What inner support moments add to the split scheme's reactions [N], Gots (54).

    The overhangs are in the split scheme already, so the end moments add nothing here.
    """
    inner = moments.copy()
    inner[0] = inner[-1] = 0
    steps = np.diff(inner, axis=0) / spans.reshape(-1, *([1] * (inner.ndim - 1)))
    added = np.zeros_like(inner)
    added[:-1] -= steps
    added[1:] += steps
    return added


def reactions(engine: Engine, raw: BatchSolution, index: int) -> tuple[Array, Array]:
    """Moments [N·m] and specific reactions [Pa] of all supports, (journals, angles, 2)."""
    throws, area = raw.batch.throws, engine.geometry.piston_area
    place = journals.positions(throws)
    spans = place.length[index]
    right, left = _load_terms(engine, raw, index)
    gamma = throws.angle[index][:, None]
    right, left = journals.to_shaft_axes(right, gamma), journals.to_shaft_axes(left, gamma)
    moments = support_moments(spans, right, left, _ends(engine, raw, index))
    added = corrections(spans, moments)
    return moments, raw.journal[index] + added / area


def _load_terms(engine: Engine, raw: BatchSolution, index: int) -> tuple[Array, Array]:
    """Load terms of every span in its throw's frame [N·m²], (throws, angles, 2)."""
    shaft, r = engine.crankshaft, engine.geometry.crank_radius
    unit = r * engine.omega**2
    area = engine.geometry.piston_area
    m_2 = raw.batch.pin_mass[index, :, 0]
    found = []
    for number, group in enumerate(throws_of(engine.arrangement)):
        throw = shaft.throws[number]
        l1, l2, l3, l4, _, l6 = throw.arms
        h_left, h_right = throw.left_web_thickness, throw.right_web_thickness
        length = throw.length
        still = np.zeros_like(raw.phi)
        loads: list[tuple[float, Array, Array]] = []
        rod_places = (l1 + h_left + l2, l1 + h_left + l2 + l3 + l4)
        for cylinder in group:
            at = rod_places[engine.arrangement[cylinder].rod_place]
            spin = m_2[cylinder] * unit
            K, T = raw.K[index, cylinder] * area, raw.T[index, cylinder] * area
            loads.append((at, -T, spin - K))
        loads.append((rod_places[0] + l3, still, still + throw.pin_mass * unit))
        for at, web in (
            (l1 + h_left / 2, throw.left_web),
            (length - l6 - h_right / 2, throw.right_web),
        ):
            turn, weight = web.angle, web.counterweight_angle
            side = web.mass * np.sin(turn) + web.counterweight_mass * np.sin(weight)
            up = web.mass * np.cos(turn) - web.counterweight_mass * np.cos(weight)
            loads.append((at, still + side * unit, still + up * unit))
        right, left = np.zeros((len(still), 2)), np.zeros((len(still), 2))
        for at, side_force, up_force in loads:
            force = np.stack([side_force, up_force], axis=-1)
            rest = length - at
            right += force * at * (length**2 - at**2) / length
            left += force * rest * (length**2 - rest**2) / length
        found.append((right, left))
    return np.stack([a for a, _ in found]), np.stack([b for _, b in found])


def _ends(engine: Engine, raw: BatchSolution, index: int) -> Array:
    """Moments of the overhung counterweights at the end supports in shaft axes, (2, angles, 2)."""
    shaft = engine.crankshaft
    unit = engine.geometry.crank_radius * engine.omega**2
    found = []
    for mass, throw, way in (
        (shaft.nose, shaft.throws[0], -1.0),
        (shaft.rear, shaft.throws[-1], 1.0),
    ):
        # The nose angle runs with rotation, hence away from "left".
        vector = mass.mass * unit * np.array([way * np.sin(mass.angle), np.cos(mass.angle)])
        turned = journals.to_shaft_axes(-vector * mass.arm, np.array(throw.angle))
        found.append(np.broadcast_to(turned, (len(raw.phi), 2)))
    return np.stack(found)


def columns(engine: Engine, raw: BatchSolution, index: int) -> dict[str, Columns]:
    """Table of the continuous shaft in SI units; none where the scheme does not apply."""
    if not applies(engine):
        return {}
    moments, specific = reactions(engine, raw, index)
    table: Columns = {"phi_deg": raw.phi}
    for k in range(1, len(moments) - 1):
        for axis in (0, 1):
            table[f"Ms{'xy'[axis]}{k + 1}_Nm"] = moments[k, :, axis]
    for k in range(len(moments)):
        x, y = specific[k, :, 0], specific[k, :, 1]
        table |= {f"Rcx{k + 1}_MPa": x, f"Rcy{k + 1}_MPa": y, f"Rc{k + 1}_MPa": np.hypot(x, y)}
    return {"continuous": table}


def scalars(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    """Mean and greatest reactions of both schemes compared, SI units."""
    found = columns(engine, raw, index)
    if not found:
        return {}
    table, shaft = found["continuous"], engine.crankshaft
    area = engine.geometry.piston_area
    split = raw.journal_load[index]
    values: dict[str, float] = {}
    for k in range(1, len(shaft.throws) + 2):
        load = table[f"Rc{k}_MPa"]
        projected = shaft.main_diameter * shaft.main_lengths[k - 1]
        mean, most = float(load[:-1].mean()), float(load.max())
        values |= {
            f"Rc{k}_mean": mean,
            f"Rc{k}_max": most,
            f"dRc{k}_mean": mean / float(split[k - 1][:-1].mean()) - 1,
            f"dRc{k}_max": most / float(split[k - 1].max()) - 1,
            f"qc{k}_max": most * area / projected,
        }
    return values
