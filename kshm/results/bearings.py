"""Oil film of one engine's bearings under the mean load and over the cycle; safety of journals."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from kshm.arrays import Array, Columns, Results, Scalars, Tables
from kshm.defaults import CLEARANCE_SHARES
from kshm.engine.arrangement import hung, rods_beside
from kshm.engine.bearings import Bearings
from kshm.mechanics import oil_film
from kshm.mechanics.kinematics import Position
from kshm.mechanics.oil_balance import Balance, BearingArrays, balance
from kshm.mechanics.oil_orbit import Complex, FilmError, Orbits, orbits
from kshm.mechanics.pin_bearing import rod_bearing
from kshm.nomenclature.quantity import UNITS
from kshm.results.case import Case
from kshm.results.extremes import least_loaded
from kshm.results.safety import safety_results

Number = TypeVar("Number", np.float64, np.complex128)
CLEARANCES = 2  # the least and the largest
_PLACES = 72  # angles of the oil hole that are tried


def bearing_results(case: Case) -> Results:
    """Tables ``oil_…`` and scalars ``oil_…``, ``safe_…``; SI units.  Nothing if not asked for."""
    asked = case.engine.bearings
    if asked is None:
        return {}, {}
    study = Study(case, asked)
    tables, safe = safety_results(case, asked)
    scalars = study.steady_scalars() | study.hole_scalars() | safe
    return study.tables(scalars) | tables, scalars


@dataclass(frozen=True)
class Study:
    """The bearings of one engine with both clearances, one after another.

    Bearing 0 is the big end of cylinder 1, bearing k main bearing k; there is no big end with
    articulated rods.
    """

    case: Case
    asked: Bearings

    @cached_property
    def numbers(self) -> tuple[int, ...]:
        """Numbers of the bearings."""
        first = 1 if hung(self.case.engine.arrangement) else 0
        return tuple(range(first, len(self.case.engine.crankshaft.throws) + 2))

    @property
    def cases(self) -> list[int]:
        """Numbers of the bearings with their clearances, from 1."""
        return [CLEARANCES * k + which for k in self.numbers for which in (1, 2)]

    @cached_property
    def arrays(self) -> BearingArrays:
        """Bearings with both clearances, shape (cases,)."""
        engine, asked = self.case.engine, self.asked
        shaft = engine.crankshaft
        rows = []
        for k in self.numbers:
            if k == 0:
                throw, rods = engine.arrangement[0].throw, rods_beside(engine.arrangement, 0)
                d, width = shaft.pin_diameters[throw], shaft.pin_lengths[throw] / rods
                given, groove, clearances = (
                    asked.pin_width, asked.pin_groove, asked.pin_clearances,
                )  # fmt: skip
            else:
                d, width = shaft.main_diameters[k - 1], shaft.main_lengths[k - 1]
                given, groove, clearances = (
                    asked.main_width, asked.main_groove, asked.main_clearances,
                )  # fmt: skip
            lands = 2 if groove else 1
            land = ((given or width) - groove) / lands
            for rule, clearance in zip(tuple(CLEARANCE_SHARES.values()), clearances, strict=True):
                gap = clearance or rule * np.sqrt(1000 * d) / 1000
                rows.append((d, land, lands, gap, engine.omega, asked.hole))
        return BearingArrays(*np.array(rows, dtype=float).T)

    @cached_property
    def at(self) -> Position:
        """Position of the rod of cylinder 1."""
        return Position.at(self.case.raw.local_phi[self.case.index, 0], *self.case.sizes[1:])

    @cached_property
    def swing(self) -> Array:
        """dβ/dφ of the rod of cylinder 1 [-], shape (angles,): it turns against the shaft."""
        rate: Array = self.case.sizes[1] * self.at.cos / self.at.cos_beta
        return rate

    @cached_property
    def turn(self) -> Array:
        """Shaft's angle ahead of the bearing's axes [rad], shape (bearings, angles)."""
        phi = self.case.raw.phi
        rod = self.case.raw.local_phi[self.case.index, 0] + np.arcsin(self.at.sin_beta)
        return np.array([phi if k else rod for k in self.numbers])

    @cached_property
    def loads(self) -> Complex:
        """Load on each bearing along y + i·ahead [N], in its own axes, (bearings, angles).

        y points up or along the rod to the piston, ahead in the direction of rotation.
        """
        raw, engine, index = self.case.raw, self.case.engine, self.case.index
        area = engine.geometry.piston_area
        found = []
        for k in self.numbers:
            if k == 0:
                spin = raw.batch.pin_mass[index, 0][0] * engine.geometry.crank_radius
                inward = raw.K[index, 0] - spin * engine.omega**2 / area
                across, along = rod_bearing(inward, raw.T[index, 0], self.at)
                found.append(area * (along + 1j * across))
            else:
                on_shaft = raw.journal[index, k - 1]
                turned = (on_shaft[:, 1] - 1j * on_shaft[:, 0]) * np.exp(1j * raw.phi)
                found.append(-area * turned)
        return np.array(found)

    def each(self, values: NDArray[Number]) -> NDArray[Number]:
        """Values of the bearings for both clearances."""
        twice: NDArray[Number] = np.repeat(values, CLEARANCES, axis=0)
        return twice

    @property
    def ahead(self) -> Array:
        """Shaft's speed over the bearing's in its axes, over ω [-], (cases, angles)."""
        rates = [np.ones_like(self.swing) if k else 1 + self.swing for k in self.numbers]
        return self.each(np.array(rates))

    @cached_property
    def mean(self) -> Array:
        """Mean load [N], shape (cases,)."""
        mean: Array = np.abs(self.each(self.loads))[:, :-1].mean(axis=1)
        return mean

    @cached_property
    def steady(self) -> Balance:
        """Every case under its mean load."""
        oil = self.asked.oil
        return balance(
            self.arrays, self.mean, (oil.at_40, oil.at_100), oil.density * oil.heat,
            (oil.supply, oil.pressure), oil.temperature,
        )  # fmt: skip

    @cached_property
    def orbits(self) -> Orbits:
        """Orbits of every case over the cycle.

        Raises:
            FilmError: a load that the film does not carry; ``bearing`` is a main bearing's number,
                0 of the big end.
        """
        unit = self.arrays.load_number(np.ones(len(self.mean)), self.steady.viscosity)
        load = self.each(self.loads) * unit[:, None]
        try:
            return orbits(self.case.raw.phi, load, self.ahead / 2, self.arrays.width)
        except FilmError as error:
            raise FilmError(self.numbers[error.bearing // CLEARANCES]) from None

    def steady_scalars(self) -> Scalars:
        """What course works ask for, SI, by the names of the cases."""
        arrays, steady = self.arrays, self.steady
        gap = oil_film.gap(steady.eccentricity, arrays.clearance)
        area = self.arrays.area
        columns = {
            "oil_F{}_N": self.mean,
            "oil_k{}_MPa": self.mean / area,
            "oil_kmax{}_MPa": np.abs(self.each(self.loads)).max(axis=1) / area,
            "oil_chi{}": steady.eccentricity,
            "oil_temp{}_C": steady.temperature,
            "oil_visc{}_mPas": steady.viscosity,
            "oil_hmin{}_um": gap,
            "oil_K{}": gap / self.asked.least_gap,
            "oil_friction{}_W": steady.friction,
            "oil_through{}_l_min": steady.flow,
            "oil_hot{}_C": steady.heated,
        }
        found = {
            key.format(case): float(value)
            for key, values in columns.items()
            for case, value in zip(self.cases, values, strict=True)
        }
        return found | {"oil_hcr_um": self.asked.least_gap}

    def hole_scalars(self) -> Scalars:
        """Angles of the crankpin's oil hole by the load and by the wear [rad]."""
        if self.numbers[0]:
            return {}
        raw, index = self.case.raw, self.case.index
        ahead, up = (each[index, 0, :-1].mean() for each in (raw.pin_side, raw.pin_up))
        return {
            "oil_load_deg": float(np.mod(np.arctan2(-ahead, up), 2 * np.pi)),
            "oil_wear_deg": float(least_loaded(raw.pin_wear[index, 0])[1]),
        }

    def tables(self, scalars: Scalars) -> Tables:
        """``oil_orbits`` with a row a case, and the orbit of every bearing, SI."""
        found = {"oil_orbits": self._summary(scalars)}
        e, delta = np.abs(self.orbits.centre), np.mod(np.angle(self.orbits.centre), 2 * np.pi)
        x, y = self.orbits.centre.imag, self.orbits.centre.real
        gap = oil_film.gap(e, self.arrays.clearance[:, None])
        for place, k in enumerate(self.numbers):
            load = self.loads[place] / np.abs(self.loads[place]).max()
            table: Columns = {"phi_deg": self.case.raw.phi}
            for key, values in (
                ("eps{}", e), ("delta{}_deg", delta), ("h{}_um", gap), ("x{}", x), ("y{}", y),
            ):  # fmt: skip
                for which in (1, 2):
                    table[f"oil_{key.format(which)}"] = values[CLEARANCES * place + which - 1]
            table |= {"oil_load_x": load.imag, "oil_load_y": load.real}
            found[f"oil_orbit_{k}"] = table
        return found

    def _summary(self, scalars: Scalars) -> Columns:
        raw, arrays, centre = self.case.raw, self.arrays, self.orbits.centre
        e = np.abs(centre)
        gap = oil_film.gap(e, arrays.clearance[:, None])[:, :-1]
        at = gap.argmin(axis=1)
        rows = np.arange(len(at))
        shell = np.mod(np.angle(centre), 2 * np.pi)
        journal = np.mod(self.each(self.turn) - shell, 2 * np.pi)
        load = self.each(self.loads)
        across = np.abs((load * np.conj(centre)).imag) / np.maximum(e, 1e-9)
        slip, oil = self.case.engine.omega * np.abs(self.ahead), self.steady.viscosity
        power = arrays.friction(e.T, across.T, oil, slip.T).T[:, :-1]
        flow = arrays.flow(e.T, oil, self.asked.oil.pressure).T[:, :-1]
        places = 2 * np.pi / _PLACES * np.arange(_PLACES)
        thick = 1 - e[:, None, :-1] * np.cos(places[:, None] - journal[:, None, :-1])
        best = places[thick.min(axis=2).argmax(axis=1)]
        mark = [
            scalars[f"oil_F{n}_N"] + scalars[f"oil_kmax{n}_MPa"] / UNITS["MPa"].si
            + 100 * scalars[f"oil_chi{n}"] + 1000 * scalars[f"oil_visc{n}_mPas"]
            for n in self.cases
        ]  # fmt: skip
        return {
            "oil_case": np.array(self.cases, dtype=float),
            "oil_eps_max": e.max(axis=1),
            "oil_orb_h_um": gap[rows, at],
            "oil_orb_phi_deg": raw.phi[at],
            "oil_shell_deg": shell[rows, at],
            "oil_journal_deg": journal[rows, at],
            "oil_under": (gap < self.asked.least_gap).mean(axis=1),
            "oil_orb_W": power.mean(axis=1),
            "oil_orb_l_min": flow.mean(axis=1),
            "oil_hole_deg": best,
            "oil_open": self.orbits.opening,
            "oil_mark": np.array(mark),
        }
