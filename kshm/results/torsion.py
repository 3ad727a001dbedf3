"""Torsional vibration of one engine's shaft: frequencies, forms, resonances, forced vibration."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars
from kshm.chain.solve import solve_batch
from kshm.defaults import (
    DAMPING_SHARE,
    FLYWHEEL_SHARE,
    LAST_ORDER,
    OTHER_FLYWHEEL,
    RAYS,
    RING_SHARE,
    SPEED_RANGE,
    SPEEDS,
    STARS,
)
from kshm.engine.arrangement import hung
from kshm.engine.torsion import Torsion
from kshm.mechanics import inertia, torsion
from kshm.mechanics.harmonics import Harmonics, analyse
from kshm.mechanics.torsion import Complex, Damper, Modes, Response, Train
from kshm.results.case import Case
from kshm.results.gas import peak_pressure

MAX_MODES = 3
_STILL = 1e-9  # of the speed: gas forces alone
_TIE = 1 - 1e-9
# What is added up to tell whether the forced vibration belongs to the data beside it; SI.
_MARKED = ("tor_f1_hz", "tor_f1_other_hz", "tor_loss1", "tor_damper_b", "tor_worst_order")


def torsion_results(case: Case) -> Results:
    """Tables ``torsion_…`` and scalars ``tor_…``; SI units; empty without [torsion]."""
    inputs = case.engine.torsion
    if inputs is None:
        return {}, {}
    study = TorsionStudy(case, inputs)
    critical, worst = _critical(study)
    scalars = _scalars(study) | worst | _damper_scalars(study)
    mark = float(critical["tor_M1_Nm"][:-1].sum()) + sum(scalars[key] for key in _MARKED)
    forced = forced_columns(study)
    tables = {
        "torsion_forms": _forms(study),
        "torsion_critical": critical,
        "torsion_star": _star(study),
        "torsion_campbell": _campbell(study),
        "torsion_response": forced | {"tor_mark": np.full(len(study.speeds), mark)},
    }
    return tables, scalars | _tops(forced)


@dataclass(frozen=True)
class TorsionStudy:
    """Train and excitation of one engine."""

    case: Case
    inputs: Torsion

    @cached_property
    def flywheel(self) -> float:
        """Inertia of the flywheel [kg·m²]: given, for the irregularity wanted, or a share."""
        engine, inputs = self.case.engine, self.inputs
        if inputs.masses:
            return max(mass.inertia for mass in inputs.masses)
        if inputs.flywheel is not None:
            return inputs.flywheel
        share = FLYWHEEL_SHARE * float(self._throws.sum())
        if hung(engine.arrangement):
            return share
        work = inertia.excess_work(*self.case.fine_torque)
        inertia_of_engine = float(inertia.of_engine(self.case.raw.phi, engine)[:-1].mean())
        irregularity = engine.balancing.irregularity
        return (
            inertia.flywheel_inertia(work, inertia_of_engine, engine.omega, irregularity) or share
        )

    @property
    def _throws(self) -> Array:
        throws = self.inputs.throws
        return torsion.throw_inertias(self.case.engine) if throws is None else np.array(throws)

    @cached_property
    def other_flywheel(self) -> float:
        """A second flywheel to compare with [kg·m²]."""
        return self.inputs.other_flywheel or OTHER_FLYWHEEL * self.flywheel

    @cached_property
    def train(self) -> Train:
        """The train of the calculation."""
        return torsion.train_of(self.case.engine, self.inputs, self.flywheel)

    @cached_property
    def other(self) -> Train:
        """The same with the other flywheel."""
        number = self.train.heaviest
        if not self.inputs.masses:
            number = len(self.case.engine.crankshaft.throws) + 1
        return self.train.with_inertia(number, self.other_flywheel)

    @cached_property
    def modes(self) -> Modes:
        """The first frequencies and forms."""
        modes = torsion.modes_of(self.train)
        return Modes(modes.omega[:MAX_MODES], modes.forms[:MAX_MODES])

    @property
    def numbers(self) -> range:
        """Numbers of the modes from 1."""
        return range(1, len(self.modes.omega) + 1)

    @cached_property
    def damping(self) -> Array:
        """Absolute damping of every mass [N·m·s/rad], shape (masses,)."""
        geometry = self.case.engine.geometry
        share = DAMPING_SHARE * geometry.piston_area * geometry.crank_radius**2
        each = share if self.inputs.damping is None else self.inputs.damping
        counts = np.bincount([cylinder.throw for cylinder in self.case.engine.arrangement])
        return np.array(
            [each * counts[k] if 0 <= k < len(counts) else 0.0 for k in self.train.throws]
        )

    @cached_property
    def orders(self) -> Array:
        """ν up to 12, as far as the grid resolves them."""
        return self.case.orders(LAST_ORDER)

    @cached_property
    def gas(self) -> Array:
        """Torque of the gas forces alone of every cylinder [N·m], shape (cylinders, angles).

        That of the same engine at next to no speed, which serves every layout.
        """
        engine = self.case.engine
        still = replace(engine, omega=_STILL * engine.omega, regimes=(), torsion=None)
        torque: Array = solve_batch([still]).torque[0]
        return torque

    @property
    def inertia(self) -> Array:
        """Torque of the inertia forces of every cylinder [N·m], shape (cylinders, angles)."""
        torque: Array = self.case.raw.torque[self.case.index] - self.gas
        return torque

    def at_speed(self, omega: Array) -> tuple[Array, Array]:
        """Factors of gas and of inertia torques at speeds [rad/s], elementwise."""
        gas = np.ones_like(omega)
        if self.inputs.peaks:
            speeds, pressures = zip(*self.inputs.peaks, strict=True)
            gas = np.interp(omega, speeds, pressures) / peak_pressure(self.case)
        return gas, (omega / self.case.engine.omega) ** 2

    @cached_property
    def range(self) -> tuple[float, float]:
        """Working speeds [rad/s]."""
        low, high = (share * self.case.engine.omega for share in SPEED_RANGE)
        return self.inputs.speed_min or low, self.inputs.speed_max or high

    @cached_property
    def speeds(self) -> Array:
        """Speeds of the forced vibration [rad/s], shape (speeds,)."""
        return np.linspace(*self.range, SPEEDS)

    @cached_property
    def damper(self) -> Damper:
        """The damper given, or the best one of its kind for the first form."""
        inputs, omega = self.inputs, float(self.modes.omega[0])
        brought = float(torsion.brought_inertia(self.train, self.modes)[0])
        ring = inputs.damper_inertia or RING_SHARE * brought
        share = ring / brought
        kappa, zeta = torsion.best_tuning(share)
        tuned = inputs.damper == "tuned"
        spring = (inputs.damper_stiffness or ring * (kappa * omega) ** 2) if tuned else 0.0
        best = 2 * (zeta if tuned else torsion.best_viscous(share)) * ring * omega
        damping = inputs.damper_damping
        return Damper(ring, spring, best if damping is None else damping)

    def excitation(self, speeds: Array) -> Complex:
        """Harmonics of the torques at the masses [N·m], shape (masses, speeds, orders)."""
        period, throws = self.case.engine.period, self.train.throws
        gas, inertia = (self._spectrum(torque, period) for torque in (self.gas, self.inertia))
        gas_factor, inertia_factor = self.at_speed(speeds)
        cylinders = gas[:, None] * gas_factor[:, None] + inertia[:, None] * inertia_factor[:, None]
        torques = np.zeros((len(throws), len(speeds), len(self.orders)), dtype=complex)
        masses = {throw: mass for mass, throw in enumerate(throws) if throw >= 0}
        for cylinder, torque in zip(self.case.engine.arrangement, cylinders, strict=True):
            if cylinder.throw in masses:
                torques[masses[cylinder.throw]] += torque
        return torques

    def _spectrum(self, torque: Array, period: float) -> Complex:
        """T_ν of Re Σ T_ν e^{iνφ} [N·m], shape (cylinders, orders)."""
        body = torque[:, :-1]
        index = np.rint(self.orders * period / (2 * np.pi)).astype(int)
        spectrum: Complex = np.fft.rfft(body, axis=1)[:, index] * 2 / body.shape[1]
        return spectrum

    def response(
        self, speeds: Array, train: Train | None = None, damper: Damper | None = None
    ) -> Response:
        """Steady vibration at speeds [rad/s] under all orders."""
        omega = speeds[:, None] * self.orders
        load, eta = self.excitation(speeds), self.inputs.loss_factor
        return torsion.respond(train or self.train, omega, load, self.damping, eta, damper)


def forced_columns(study: TorsionStudy) -> Columns:
    """Forced vibration over the speeds: stresses summed in time, energy of a cycle; SI units."""
    speeds, strokes = study.speeds, study.case.engine.strokes
    bare = study.response(speeds)
    step, periods = 2 / strokes, study.orders * strokes / 2

    def summed(amplitudes: Complex) -> Array:
        return torsion.sum_in_time(amplitudes, study.orders, step)

    def stress(train: Train, response: Response) -> Array:
        return summed(torsion.stresses(train, response))

    by_order = torsion.stresses(study.train, bare)
    shafts = summed(by_order)
    worst = shafts.argmax(axis=0)
    damped = stress(study.train, study.response(speeds, damper=study.damper))
    other = stress(study.other, study.response(speeds, study.other))
    return {
        "tor_point": np.arange(len(speeds), dtype=float),
        "tor_speed_rpm": speeds,
        "tor_tau_MPa": shafts.max(axis=0),
        "tor_tau_damped_MPa": damped.max(axis=0),
        "tor_tau_other_MPa": other.max(axis=0),
        "tor_shaft_no": worst + 1.0,
        "tor_lead_order": study.orders[abs(by_order[worst, np.arange(len(speeds))]).argmax(axis=1)],
        "tor_moment_Nm": summed(bare.torques).max(axis=0),
        "tor_front_deg": summed(bare.angles[0]),
        "tor_work_J": (bare.work * periods).sum(axis=1),
        "tor_lost_J": (bare.lost * periods).sum(axis=1),
    }


def _tops(forced: Columns) -> Scalars:
    """Return greatest stresses of the forced vibration [Pa] and where the first stands [rad/s]."""
    bare = forced["tor_tau_MPa"]
    return {
        "tor_top_MPa": float(bare.max()),
        "tor_top_rpm": float(forced["tor_speed_rpm"][bare.argmax()]),
        "tor_top_damped_MPa": float(forced["tor_tau_damped_MPa"].max()),
        "tor_top_other_MPa": float(forced["tor_tau_other_MPa"].max()),
    }


def _forms(study: TorsionStudy) -> Columns:
    """Train and forms."""
    train, modes = study.train, study.modes
    count = len(train.inertias)
    nodes = np.nan_to_num(torsion.nodes(modes.forms))
    return {
        "tor_mass": np.arange(1.0, count + 1),
        "tor_J_kgm2": train.inertias,
        "tor_c_Nm_rad": np.append(train.stiffnesses, train.right),
        **{f"tor_theta{m}": modes.forms[m - 1] for m in study.numbers},
        **{f"tor_node{m}": np.append(0.0, nodes[m - 1]) for m in study.numbers},
    }


def _critical(study: TorsionStudy) -> tuple[Columns, Scalars]:
    """Phase sums, critical speeds and resonances by the energy method for each order."""
    engine, train, modes = study.case.engine, study.train, study.modes
    of_throw = {throw: mass for mass, throw in enumerate(train.throws) if throw >= 0}
    # The last column of zeros serves the cylinders that no mass carries.
    forms = np.column_stack([modes.forms, np.zeros(len(modes.omega))])
    cylinders = forms[:, [of_throw.get(cylinder.throw, -1) for cylinder in engine.arrangement]]
    sums = torsion.phase_sums(cylinders, np.array(engine.firing_offsets), study.orders)
    speeds = modes.omega[:, None] / study.orders
    gas, inertial = (
        analyse(torque[0], engine.period, study.orders) for torque in (study.gas, study.inertia)
    )
    torque = _joined(gas, inertial, *study.at_speed(speeds))
    resistance = torsion.energy_resistance(train, modes, study.damping, study.inputs.loss_factor)
    with np.errstate(divide="ignore", invalid="ignore"):
        turned = np.where(resistance[:, None] > 0, torque * sums / resistance[:, None], 0.0)
    stress = turned * torsion.form_stress(train, modes)[:, None]
    low, high = study.range
    inside = np.where((speeds >= low) & (speeds <= high), stress, 0.0)
    table: Columns = {"tor_order": study.orders}
    for key, values in (
        ("sum{}", sums), ("n{}_rpm", speeds), ("M{}_Nm", torque), ("A{}_deg", turned),
        ("tau{}_MPa", stress), ("in{}_MPa", inside),
    ):  # fmt: skip
        table |= {f"tor_{key.format(m)}": values[m - 1] for m in study.numbers}
    return table, _worst(study, inside, speeds)


def _joined(gas: Harmonics, inertial: Harmonics, gas_factor: Array, own_factor: Array) -> Array:
    """Amplitude of the torque of a cylinder [N·m] at the factors of the speed."""
    cosine = gas.cosine * gas_factor + inertial.cosine * own_factor
    sine = gas.sine * gas_factor + inertial.sine * own_factor
    amplitude: Array = np.hypot(cosine, sine)
    return amplitude


def _worst(study: TorsionStudy, inside: Array, speeds: Array) -> Scalars:
    """Return the greatest resonance within the working speeds; zeros where there is none."""
    worst = float(inside.max())
    if worst == 0:
        return dict.fromkeys(
            ("tor_worst", "tor_worst_mode", "tor_worst_order", "tor_worst_rpm"), 0.0
        )
    mode = int(np.argmax(inside.max(axis=1) >= worst * _TIE))
    column = int(np.flatnonzero(inside[mode] >= worst * _TIE)[-1])
    return {
        "tor_worst": worst,
        "tor_worst_mode": mode + 1.0,
        "tor_worst_order": float(study.orders[column]),
        "tor_worst_rpm": float(speeds[mode, column]),
    }


def _star(study: TorsionStudy) -> Columns:
    """Return running sums of the cylinders' vectors a e^{−iνθ} in the first form, by orders."""
    engine, form = study.case.engine, study.modes.forms[0]
    of_throw = {throw: form[mass] for mass, throw in enumerate(study.train.throws) if throw >= 0}
    sizes = np.array([of_throw.get(cylinder.throw, 0.0) for cylinder in engine.arrangement])
    table: Columns = {"tor_cylinder": np.arange(engine.cylinders + 1.0)}
    for k in range(1, min(STARS, engine.cylinders) + 1):
        order = k * 2 / engine.strokes
        path = np.cumsum(sizes * np.exp(-1j * order * np.array(engine.firing_offsets)))
        table[f"tor_star_x{k}"] = np.append(0.0, path.imag)
        table[f"tor_star_y{k}"] = np.append(0.0, path.real)
    return table


def _campbell(study: TorsionStudy) -> Columns:
    """Frequencies of the orders over the speed beside those of the train."""
    speeds = study.range[1] * np.linspace(0, 1.2, 13)
    hertz, half = study.modes.hertz, 2 / study.case.engine.strokes
    orders = np.arange(1, round(RAYS / half) + 1) * half
    return {
        "tor_point": np.arange(13.0),
        "tor_speed_rpm": speeds,
        **{f"tor_level{m}_hz": np.full(13, hertz[m - 1]) for m in study.numbers},
        **{
            f"tor_{'half' if order % 1 else 'ray'}{int(order)}_hz": order * speeds / (2 * np.pi)
            for order in orders.tolist()
        },
    }


def _scalars(study: TorsionStudy) -> Scalars:
    engine, train, modes = study.case.engine, study.train, study.modes
    hertz = modes.hertz
    other = float(torsion.modes_of(study.other).hertz[0])
    low, high = study.range
    scalars = {
        **{f"tor_f{m}_hz": float(hertz[m - 1]) for m in study.numbers},
        **_numbered("tor_brought{}", torsion.brought_inertia(train, modes)),
        **_numbered(
            "tor_loss{}",
            torsion.energy_resistance(train, modes, study.damping, study.inputs.loss_factor),
        ),
        **_numbered("tor_twist{}", torsion.form_stress(train, modes) * np.pi / 180),
        "tor_n_min": low,
        "tor_n_max": high,
        "tor_flywheel": study.flywheel,
        "tor_flywheel_other": study.other_flywheel,
        "tor_f1_other_hz": other,
        "tor_f1_change": other / float(hertz[0]) - 1,
    }
    if study.inputs.masses:
        return scalars
    first = [
        float(torsion.modes_of(torsion.train_of(engine, study.inputs, study.flywheel, f)).hertz[0])
        for f in torsion.FORMULAS
    ]
    scalars |= {f"tor_f1_{f}_hz": value for f, value in zip(torsion.FORMULAS, first, strict=True)}
    return scalars | {"tor_f1_spread": (max(first) - min(first)) / float(hertz[0])}


def _numbered(key: str, values: Array) -> Scalars:
    return {key.format(m): float(value) for m, value in enumerate(values, 1)}


def _damper_scalars(study: TorsionStudy) -> Scalars:
    brought = float(torsion.brought_inertia(study.train, study.modes)[0])
    damper = study.damper
    share = damper.inertia / brought
    kappa, zeta = torsion.best_tuning(share)
    return {
        "tor_ring": damper.inertia,
        "tor_mu": share,
        "tor_kappa": kappa,
        "tor_zeta": zeta,
        "tor_zeta_viscous": torsion.best_viscous(share),
        "tor_damper_c": damper.stiffness,
        "tor_damper_b": damper.damping,
    }
