"""Counterweights proposed for the webs: scan of their share, sector, loads before and after."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars
from kshm.chain.solve import solve_batch
from kshm.defaults import OUTER_SHARE, SKIRT_SHARE
from kshm.engine.counterweight import Counterweight
from kshm.engine.crankshaft import EndMass, Throw
from kshm.engine.engine import Engine
from kshm.mechanics import balance
from kshm.mechanics.counterweight import SectorRing
from kshm.mechanics.masses import rotating_mass
from kshm.mechanics.webs import web_thickness
from kshm.results.case import Case

LAST_SHARE, SHARES = 2.0, 41
_PARTS: tuple[tuple[str, Callable[[Array], Array]], ...] = (
    ("mean", lambda load: load[:, :-1].mean(axis=1)), ("max", lambda load: load.max(axis=1)),
)  # fmt: skip
_STATES = ("bare", "now", "new")
_FREE_MOMENT, _FREE_FORCE = 1e-2, 1e-1  # N·m, N: what is less vanishes at every share


def counterweight_results(case: Case) -> Results:
    """Tables ``counterweight_scan``, ``counterweight_turn``, scalars ``cw_…``; SI.

    Empty without [counterweight].
    """
    inputs = case.engine.counterweight
    if inputs is None:
        return {}, {}
    study = _Proposal(case, inputs)
    scan, turn = study.scan, study.turn()
    sector = study.sector()
    return {"counterweight_scan": scan, "counterweight_turn": turn}, sector | study.loads()


def with_counterweights(engine: Engine, share: float) -> Engine:
    """Return engine with alike counterweights opposite the cranks, two on a throw, none elsewhere.

    Each takes half of the share of the throw's rotating mass.
    """
    mass = share * rotating_mass(engine) / 2
    shaft = engine.crankshaft
    throws = tuple(_weighed(throw, mass) for throw in shaft.throws)
    nothing = EndMass()
    other = replace(shaft, throws=throws, nose=nothing, rear=nothing)
    return replace(engine, crankshaft=other, regimes=(), torsion=None, bearings=None,
                   strength=None, counterweight=None, flywheel=None)  # fmt: skip


def _weighed(throw: Throw, mass: float) -> Throw:
    left, right = (
        replace(web, counterweight_mass=mass, counterweight_angle=0.0)
        for web in (throw.left_web, throw.right_web)
    )
    return replace(throw, left_web=left, right_web=right)


@dataclass(frozen=True)
class _Proposal:
    """Proposed counterweights of one engine."""

    case: Case
    inputs: Counterweight

    @cached_property
    def bare_and_full(self) -> tuple[Array, Array]:
        """Reactions of the main bearings [N] at the shares 0 and 1, (journals, angles, 2)."""
        engine = self.case.engine
        raw = solve_batch([with_counterweights(engine, share) for share in (0.0, 1.0)])
        bare, full = raw.journal * engine.geometry.piston_area
        return bare, full

    def reactions(self, share: float) -> Array:
        """Loads of the main journals [N] at a share, (journals, angles): a line of the vectors."""
        bare, full = self.bare_and_full
        length: Array = np.linalg.norm(bare + share * (full - bare), axis=-1)
        return length

    @cached_property
    def scan(self) -> Columns:
        """Root mean square loads of the journals and what is left of the first order."""
        shares = np.linspace(0.0, LAST_SHARE, SHARES)
        means = [np.sqrt((self.reactions(k)[:, :-1] ** 2).mean(axis=1)) for k in shares]
        loads = np.array(means).T
        columns: Columns = {"cw_k": shares}
        columns |= {f"cw_R{j}_kN": load for j, load in enumerate(loads, 1)}
        columns["cw_sum_kN"] = loads.sum(axis=0)
        if balance.is_balanced_by_orders(self.case.engine):
            left = np.array([self._left(k) for k in shares]).T
            columns |= dict(zip(("cw_F_kN", "cw_M_Nm"), left, strict=True))
        return columns

    def _left(self, share: float) -> tuple[float, float]:
        """Greatest force [N] and moment [N·m] of the first order and the rotating masses."""
        engine = with_counterweights(self.case.engine, share)
        upright = balance.reciprocating(engine, balance.cylinders_of(engine), 1)
        turning = balance.rotating(engine, counterweights=True)
        force, moment = (
            balance.ellipse(still + balance.turning(vector)).largest
            for still, vector in zip(upright, turning, strict=True)
        )
        return force, moment

    @property
    def best(self) -> float:
        """The share of the scan that the goal asks for."""
        values = self.scan["cw_sum_kN"]
        if self.inputs.goal == "residue" and "cw_F_kN" in self.scan:
            rows = (("cw_M_Nm", _FREE_MOMENT), ("cw_F_kN", _FREE_FORCE))
            free = [self.scan[key] for key, least in rows if np.ptp(self.scan[key]) > least]
            values = free[0] if free else values
        return float(self.scan["cw_k"][np.argmin(np.round(values, 6))])

    @property
    def share(self) -> float:
        """The share that is taken: the best one that half a ring has room for."""
        if self.inputs.share is not None:
            return self.inputs.share
        return min(self.best, float(np.floor(100 * self.ring.half_moment / self.unit)) / 100)

    @property
    def unit(self) -> float:
        """Half of the rotating masses' first moment of a throw [kg·m]: that of a web."""
        return rotating_mass(self.case.engine) * self.case.engine.geometry.crank_radius / 2

    @property
    def space(self) -> tuple[float, float]:
        """Reach of the piston below its pin and the radius that it leaves free [m]."""
        geometry, given = self.case.engine.geometry, self.inputs
        skirt = SKIRT_SHARE * geometry.bore if given.skirt is None else given.skirt
        return skirt, geometry.rod_length - geometry.crank_radius - skirt - given.play

    @cached_property
    def ring(self) -> SectorRing:
        """Section of the counterweight, usual where the input leaves it open."""
        engine, given = self.case.engine, self.inputs
        free, radius = self.space[1], engine.geometry.crank_radius
        usual = engine.crankshaft.main_diameters[0] / 2, min(free, OUTER_SHARE * radius)
        inner = usual[0] if given.inner is None else given.inner
        outer = usual[1] if given.outer is None else given.outer
        width = float(web_thickness(engine)[0, 0]) if given.width is None else given.width
        return SectorRing(inner, outer, width, given.density)

    def sector(self) -> Scalars:
        """Needed moment of a web and its sector, within what the piston leaves."""
        ring, unit, radius = self.ring, self.unit, self.case.engine.geometry.crank_radius
        skirt, free = self.space
        share = self.share
        moment = share * unit
        sector = ring.sector(moment)
        return {
            "cw_unit": unit, "cw_best": self.best, "cw_taken": share, "cw_half": ring.half_moment,
            "cw_limit": ring.half_moment / unit,
            "cw_moment": moment, "cw_reduced": moment / radius,
            "cw_skirt_mm": skirt, "cw_free_mm": free, "cw_inner_mm": ring.inner,
            "cw_outer_mm": ring.outer, "cw_width_mm": ring.width,
            "cw_sine": min(1.0, sector.fullness), "cw_angle_deg": sector.angle,
            "cw_mass": sector.mass, "cw_centre_mm": sector.centre,
            "cw_best_width_mm": ring.width_for(self.best * unit),
        }  # fmt: skip

    def turn(self) -> Columns:
        """Loads of the journals over the cycle without counterweights and with those proposed."""
        bare, new = self.reactions(0.0), self.reactions(self.share)
        loads: Columns = {"phi_deg": self.case.raw.phi}
        for j, pair in enumerate(zip(bare, new, strict=True), 1):
            loads |= {f"cw_{key}{j}_kN": load
                      for key, load in zip(("bare", "new"), pair, strict=True)}  # fmt: skip
        return loads

    def loads(self) -> Scalars:
        """Mean and greatest loads of every journal: without, with given, with proposed weights."""
        case = self.case
        now = case.raw.journal_load[case.index] * case.engine.geometry.piston_area
        states = zip(_STATES, (self.reactions(0.0), now, self.reactions(self.share)), strict=True)
        scalars = Scalars()
        for key, load in states:
            for part, part_of in _PARTS:
                each = part_of(load)
                scalars |= {f"cw_{key}_{part}{j}_kN": float(one) for j, one in enumerate(each, 1)}
                if part == "mean":
                    scalars[f"cw_{key}_sum_kN"] = float(each.sum())
        return scalars
