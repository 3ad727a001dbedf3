"""Bearings of one engine: oil film under the mean load and over the cycle, fatigue of journals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from kshm.arrays import Array, Columns, Results, Scalars, Tables
from kshm.defaults import CLEARANCE_SHARES, FILLET_SHARE
from kshm.engine.arrangement import hung
from kshm.engine.bearings import Bearings
from kshm.errors import FilmError
from kshm.mechanics import bearings, journals
from kshm.mechanics.bearings import (
    Balance,
    BearingArrays,
    Swing,
    balance,
    class_strength,
    concentration,
    polar_modulus,
    safety,
    together,
)
from kshm.mechanics.journals import rod_bearing, rod_width
from kshm.mechanics.kinematics import Position
from kshm.mechanics.oil_orbit import Complex, Orbits, orbits
from kshm.nomenclature.quantity import UNITS
from kshm.results.case import Case, first_number, least_loaded
from kshm.results.forces import bending_forces, oil_hole

# Scalars of the weakest crankpin and the least of all pins, by the rows that they come from.
_WEAKEST = {
    "safe_n_turn_fillet": "safe_pin_turn_fillet{}", "safe_n_turn_hole": "safe_pin_turn_hole{}",
    "safe_sigma_a_MPa": "safe_pin_bend_a{}_MPa", "safe_sigma_m_MPa": "safe_pin_bend_m{}_MPa",
    "safe_crank_a_MPa": "safe_pin_crank_a{}_MPa", "safe_crank_m_MPa": "safe_pin_crank_m{}_MPa",
    "safe_n_bend_hole": "safe_pin_bend_hole{}", "safe_n_bend_fillet": "safe_pin_bend_fillet{}",
    "safe_n_hole": "safe_pin_hole{}", "safe_n_fillet": "safe_pin_fillet{}",
    "safe_n_pin": "safe_pin_n{}",
}  # fmt: skip
_LEAST_OF = {"safe_class_Q": "safe_Q_fillet{}", "safe_class_Q_hole": "safe_Q_hole{}"}
Number = TypeVar("Number", np.float64, np.complex128)
CLEARANCES = 2  # the least and the largest
_PLACES = 72  # angles of the oil hole that are tried


def safety_results(case: Case, inputs: Bearings) -> Results:
    """Scalars ``safe_…`` of journals and crankpins and the moments that bend the pins, SI."""
    s = inputs.strength
    factors = {
        key: concentration(shape, s.sensitivity) / (s.size * s.surface)
        for key, shape in (
            ("safe_kf_bend", s.fillet_bending), ("safe_kf_turn", s.fillet_torsion),
            ("safe_kh_bend", s.hole_bending), ("safe_kh_turn", s.hole_torsion),
        )
    }  # fmt: skip
    tables: Tables = {}
    if any(cylinder.pin_angle for cylinder in case.engine.arrangement):
        turned = _turned_pins(case, inputs, factors)
        pins = turned.rows | _least(turned.fillet, turned.hole)
    else:
        pins, tables = _bent_pins(case, inputs, factors)
    weakest = first_number(-pins["safe_pin_n{}"])
    weakest_values = {
        key: float(pins[row][int(weakest) - 1]) for key, row in _WEAKEST.items() if row in pins
    }
    least = {key: float(pins[row].min()) for key, row in _LEAST_OF.items() if row in pins}
    scalars = _mains(case, inputs, factors) | _numbered(pins, 1)
    return tables, factors | scalars | weakest_values | least | {"safe_pin_weakest": float(weakest)}


def _numbered(rows: Mapping[str, Array], first: int) -> Scalars:
    return {
        key.format(k): float(value)
        for key, values in rows.items()
        for k, value in enumerate(values, first)
    }


def _least(one: Array, other: Array) -> dict[str, Array]:
    return {"safe_pin_n{}": np.minimum(one, other)}


def _mains(case: Case, inputs: Bearings, factors: Scalars) -> Scalars:
    """Return main journals turned by the running-on torques; the first has none."""
    diameters = np.array(case.engine.crankshaft.main_diameters[1:])
    modulus = polar_modulus(diameters, np.array(inputs.main_bore))
    swing, fillet, hole = _turned(case.raw.running_main[case.index, 1:], modulus, inputs, factors)
    least = np.minimum(fillet, hole)
    rows = {
        "safe_W{}_cm3": modulus,
        "safe_tau_max{}_MPa": swing.mean + swing.amplitude,
        "safe_tau_min{}_MPa": swing.mean - swing.amplitude,
        "safe_tau_a{}_MPa": swing.amplitude,
        "safe_tau_m{}_MPa": swing.mean,
        "safe_fillet{}": fillet,
        "safe_hole{}": hole,
        "safe_n{}": least,
    }
    weakest = {"safe_main_weakest": float(first_number(-least)) + 1}
    return _numbered(rows, 2) | weakest | {"safe_n_main": float(least.min())}


def _turned(
    torques: Array, modulus: Array, inputs: Bearings, factors: Scalars
) -> tuple[Swing, Array, Array]:
    """Swings of stress of all journals, their safety at fillet and oil hole."""
    s, swing = inputs.strength, Swing.of(torques.max(axis=1), torques.min(axis=1), modulus)
    fillet, hole = (
        safety(swing, s.torsion, factors[key], s.mean_torsion)
        for key in ("safe_kf_turn", "safe_kh_turn")
    )
    return swing, fillet, hole


@dataclass(frozen=True, slots=True)
class _Turned:
    """Torsion of every crankpin: its rows, stress and safety at fillet and oil hole."""

    rows: dict[str, Array]
    swing: Swing
    modulus: Array
    fillet: Array
    hole: Array


def _turned_pins(case: Case, inputs: Bearings, factors: Scalars) -> _Turned:
    diameters = np.array(case.engine.crankshaft.pin_diameters)
    modulus = polar_modulus(diameters, np.array(inputs.pin_bore))
    swing, fillet, hole = _turned(
        case.raw.running_pin_statics[case.index], modulus, inputs, factors
    )
    rows = {
        "safe_pin_W{}_cm3": modulus,
        "safe_pin_a{}_MPa": swing.amplitude,
        "safe_pin_m{}_MPa": swing.mean,
        "safe_pin_turn_fillet{}": fillet,
        "safe_pin_turn_hole{}": hole,
    }
    return _Turned(rows, swing, modulus, fillet, hole)


def _bent_pins(case: Case, inputs: Bearings, factors: Scalars) -> tuple[dict[str, Array], Tables]:
    """Every crankpin bent in the planes of its oil hole and of its crank, and turned."""
    s, turned, phi = inputs.strength, _turned_pins(case, inputs, factors), case.raw.phi
    each = [bending_forces(case, k) for k in range(len(turned.modulus))]
    angles = [oil_hole(case, k) for k in range(len(each))]
    moments = {
        "bend": [journals.on_plane(inward, ahead, angle) * lever
                 for (inward, ahead, lever), angle in zip(each, angles, strict=True)],
        "crank": [inward * lever for inward, _, lever in each],
    }  # fmt: skip
    table: Columns = {"phi_deg": phi}
    for k, (bend, crank) in enumerate(zip(*moments.values(), strict=True), 1):
        table |= {f"Mbend{k}_Nm": bend, f"Mcrank{k}_Nm": crank}
    rows = turned.rows
    factors_of = {}
    for name, where, part, torsion in (
        ("bend", "hole", "h", turned.hole), ("crank", "fillet", "f", turned.fillet),
    ):  # fmt: skip
        moment = np.array(moments[name])
        swing = Swing.of(moment.max(axis=1), moment.min(axis=1), turned.modulus / 2)
        bending = safety(swing, s.bending, factors[f"safe_k{part}_bend"], s.mean_bending)
        factors_of[where] = together(bending, torsion)
        rows = rows | {
            f"safe_pin_{name}_a{{}}_MPa": swing.amplitude,
            f"safe_pin_{name}_m{{}}_MPa": swing.mean,
            f"safe_pin_bend_{where}{{}}": bending,
            f"safe_pin_{where}{{}}": factors_of[where],
        }
        rows |= _class_rule(case, inputs, where, swing, turned)
    return rows | _least(factors_of["fillet"], factors_of["hole"]), {"throw_bending": table}


def _class_rule(
    case: Case, inputs: Bearings, where: str, bent: Swing, turned: _Turned
) -> dict[str, Array]:
    """Rule of the classification societies at the fillets or at the oil holes of all pins."""
    s, diameters = inputs.strength, np.array(case.engine.crankshaft.pin_diameters)
    radius = np.full_like(diameters, inputs.hole / 2)
    shapes = s.hole_bending, s.hole_torsion
    sizes: dict[str, Array] = {}
    if where == "fillet":
        radius = np.full_like(diameters, s.fillet) if s.fillet else FILLET_SHARE * diameters
        shapes = s.fillet_bending, s.fillet_torsion
        sizes = {"safe_fillet{}_mm": radius}
    bend, turn = (concentration(shape, s.sensitivity) for shape in shapes)
    strength = class_strength(np.array(s.tensile), diameters, radius, s.making)
    equal = np.hypot(bend * bent.amplitude, np.sqrt(3) * turn * turned.swing.amplitude)
    return sizes | {
        f"safe_class_{where}{{}}_MPa": strength,
        f"safe_equal_{where}{{}}_MPa": equal,
        f"safe_Q_{where}{{}}": strength / equal,
    }


def bearing_results(case: Case) -> Results:
    """Tables ``oil_…`` and scalars ``oil_…``, ``safe_…``; SI units; empty without bearings."""
    inputs = case.engine.bearings
    if inputs is None:
        return {}, {}
    study = BearingStudy(case, inputs)
    tables, safe = safety_results(case, inputs)
    scalars = study.steady_scalars() | study.hole_scalars() | safe
    return study.tables(scalars) | tables, scalars


@dataclass(frozen=True)
class BearingStudy:
    """The bearings of one engine with both clearances, one after another.

    Bearing 0 is the big end of cylinder 1, bearing k main bearing k; there is no big end with
    articulated rods.
    """

    case: Case
    inputs: Bearings

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
        engine, inputs = self.case.engine, self.inputs
        shaft = engine.crankshaft
        rows = []
        for k in self.numbers:
            if k == 0:
                d = shaft.pin_diameters[engine.arrangement[0].throw]
                width, groove = rod_width(engine, 0), inputs.pin_groove
                clearances = inputs.pin_clearances
            else:
                d, groove = shaft.main_diameters[k - 1], inputs.main_groove
                width = (inputs.main_width or shaft.main_lengths[k - 1]) - groove
                clearances = inputs.main_clearances
            lands = 2 if groove else 1
            land = width / lands
            for rule, clearance in zip(tuple(CLEARANCE_SHARES.values()), clearances, strict=True):
                gap = clearance or rule * np.sqrt(1000 * d) / 1000
                rows.append((d, land, lands, gap, engine.omega, inputs.hole))
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
        forces = []
        for k in self.numbers:
            if k == 0:
                spin = raw.batch.pin_mass[index, 0][0] * engine.geometry.crank_radius
                inward = raw.K[index, 0] - spin * engine.omega**2 / area
                across, along = rod_bearing(inward, raw.T[index, 0], self.at)
                forces.append(area * (along + 1j * across))
            else:
                on_shaft = raw.journal[index, k - 1]
                turned = (on_shaft[:, 1] - 1j * on_shaft[:, 0]) * np.exp(1j * raw.phi)
                forces.append(-area * turned)
        return np.array(forces)

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
        oil = self.inputs.oil
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
        """Scalars of the mean load, SI, by the names of the cases."""
        arrays, steady = self.arrays, self.steady
        gap = bearings.gap(steady.eccentricity, arrays.clearance)
        area = self.arrays.area
        columns = {
            "oil_F{}_N": self.mean,
            "oil_k{}_MPa": self.mean / area,
            "oil_kmax{}_MPa": np.abs(self.each(self.loads)).max(axis=1) / area,
            "oil_chi{}": steady.eccentricity,
            "oil_temp{}_C": steady.temperature,
            "oil_visc{}_mPas": steady.viscosity,
            "oil_hmin{}_um": gap,
            "oil_K{}": gap / self.inputs.least_gap,
            "oil_friction{}_W": steady.friction,
            "oil_through{}_l_min": steady.flow,
            "oil_hot{}_C": steady.heated,
        }
        scalars = {
            key.format(case): float(value)
            for key, values in columns.items()
            for case, value in zip(self.cases, values, strict=True)
        }
        return scalars | {"oil_hcr_um": self.inputs.least_gap}

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
        tables = {"oil_orbits": self._summary(scalars)}
        e, delta = np.abs(self.orbits.centre), np.mod(np.angle(self.orbits.centre), 2 * np.pi)
        x, y = self.orbits.centre.imag, self.orbits.centre.real
        gap = bearings.gap(e, self.arrays.clearance[:, None])
        for row, k in enumerate(self.numbers):
            load = self.loads[row] / np.abs(self.loads[row]).max()
            table: Columns = {"phi_deg": self.case.raw.phi}
            for key, values in (
                ("eps{}", e), ("delta{}_deg", delta), ("h{}_um", gap), ("x{}", x), ("y{}", y),
            ):  # fmt: skip
                for which in (1, 2):
                    table[f"oil_{key.format(which)}"] = values[CLEARANCES * row + which - 1]
            table |= {"oil_load_x": load.imag, "oil_load_y": load.real}
            tables[f"oil_orbit_{k}"] = table
        return tables

    def _summary(self, scalars: Scalars) -> Columns:
        raw, arrays, centre = self.case.raw, self.arrays, self.orbits.centre
        e = np.abs(centre)
        gap = bearings.gap(e, arrays.clearance[:, None])[:, :-1]
        at = gap.argmin(axis=1)
        rows = np.arange(len(at))
        shell = np.mod(np.angle(centre), 2 * np.pi)
        journal = np.mod(self.each(self.turn) - shell, 2 * np.pi)
        load = self.each(self.loads)
        across = np.abs((load * np.conj(centre)).imag) / np.maximum(e, 1e-9)
        slip, oil = self.case.engine.omega * np.abs(self.ahead), self.steady.viscosity
        power = arrays.friction(e.T, across.T, oil, slip.T).T[:, :-1]
        flow = arrays.flow(e.T, oil, self.inputs.oil.pressure).T[:, :-1]
        angles = 2 * np.pi / _PLACES * np.arange(_PLACES)
        thick = 1 - e[:, None, :-1] * np.cos(angles[:, None] - journal[:, None, :-1])
        best = angles[thick.min(axis=2).argmax(axis=1)]
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
            "oil_under": (gap < self.inputs.least_gap).mean(axis=1),
            "oil_orb_W": power.mean(axis=1),
            "oil_orb_l_min": flow.mean(axis=1),
            "oil_hole_deg": best,
            "oil_open": self.orbits.opening,
            "oil_mark": np.array(mark),
        }
