"""Balance of one engine by orders and over a turn, firing orders; harmonics of the torque."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars
from kshm.chain import firing_orders
from kshm.engine.arrangement import throws
from kshm.engine.engine import Engine
from kshm.engine.gas import TabulatedGas
from kshm.mechanics import balance, harmonics
from kshm.mechanics.harmonics import acceleration_amplitude
from kshm.mechanics.kinematics import Position
from kshm.mechanics.masses import point_masses, rotating_mass
from kshm.results.case import Case, has_single_rods

ORDERS = tuple(range(1, 9))
# Letter of forces and moments with the unit that ends their keys.
_KINDS = (("F", "kN"), ("L", "Nm"))
LAST_ORDER = 8.0
SECOND = np.array([2.0])
_ZERO_SUM = 1e-6  # of a vector sum of unit vectors
# Results for an engine whose torque has a second order.
_OF_SHAFTS = frozenset(
    ("n_zone1", "n_zone2", "zone", "psi_best_nominal", "h_shafts", "h_shafts_best", "P_shafts")
)


def balance_results(case: Case) -> Results:
    """Tables ``balance``, ``balance_orders``, ``firing_orders`` and the balance shafts; SI."""
    engine = case.engine
    tables = {"balance": _over_a_turn(case), "balance_orders": _orders(case)}
    if engine.strokes == 4 and engine.cylinders <= firing_orders.MAX_CYLINDERS:
        tables["firing_orders"] = _firing_orders(engine)
    return tables, _scalars(case)


def _phase(amplitude: complex, order: int, unit: float) -> float:
    """Shaft angle of the greatest value [rad]; zero where there is nothing."""
    if abs(amplitude) < 1e-9 * unit:
        return 0.0
    # Rounding noise of a zero sine would turn 180° into −180°.
    sine = 0.0 if abs(amplitude.imag) < 1e-9 * unit else -amplitude.imag
    return float(np.arctan2(sine, amplitude.real)) / order


def _left(engine: Engine, order: int) -> float:
    """Share of an order that the balance shafts leave."""
    taken = {1: engine.balancing.first_shafts_share, 2: engine.balancing.second_shafts_share}
    return 1 - taken.get(order, 0.0)


def _orders(case: Case) -> Columns:
    cylinders = balance.cylinders_of(case.engine)
    rows = [_order(case, cylinders, order) for order in ORDERS]
    return {key: np.array([row[key] for row in rows]) for key in rows[0]}


def _order(case: Case, cylinders: balance.Cylinders, order: int) -> Scalars:
    engine = case.engine
    row = {
        "order": float(order),
        "order_amplitude": acceleration_amplitude(engine.geometry.lam, order),
    }
    size = abs(row["order_amplitude"]) * case.inertia_unit
    length = float(np.abs(cylinders.position).max()) + 1e-30
    kinds = (
        ("F", "kN", "order", "", None, 1.0),
        ("M", "Nm", "arm", "_mm", cylinders.position, length),
    )
    for letter, unit, name, end, weights, scale in kinds:
        vector = balance.order_phasors(cylinders, order, weights)
        up, right = (complex(part) for part in vector)
        row[f"{name}_cos{end}"], row[f"{name}_sin{end}"] = up.real, -up.imag
        if engine.is_in_line:
            row[f"{letter}_order_{unit}"] = abs(up) * size
            row[f"{letter}_order_deg"] = _phase(up, order, scale)
            continue
        shape = balance.ellipse(vector, 1e-9 * scale)
        row |= {
            f"{name}_right_cos{end}": right.real,
            f"{name}_right_sin{end}": -right.imag,
            f"{letter}_order_{unit}": shape.largest * size,
            f"{letter}_order_min_{unit}": shape.smallest * size,
            f"{letter}_order_dir_deg": shape.direction,
        }
    row["F_left_kN"] = row["F_order_kN"] * _left(engine, order)
    row["M_left_Nm"] = row["M_order_Nm"] * _left(engine, order)
    return row


def _over_a_turn(case: Case) -> Columns:
    engine, phi = case.engine, case.turn
    cylinders = balance.cylinders_of(engine)
    columns: Columns = {"phi_deg": phi}
    shaft = balance.rotating(engine, counterweights=True)
    weights = balance.ideal_counterweights(engine)
    turned = np.exp(1j * phi)
    for which, (letter, unit) in enumerate(_KINDS):
        waves: dict[int, Array] = {}  # up + i·right
        for order in (1, 2, 4):
            up, right = balance.reciprocating(engine, cylinders, order)[which]
            wave = np.exp(1j * order * phi)
            waves[order] = np.real(up * wave) + 1j * np.real(right * wave)
            columns[f"{letter}{order}_{unit}"] = waves[order].real
            if not engine.is_in_line:
                columns[f"{letter}{order}_right_{unit}"] = waves[order].imag
        rotating = shaft[which] * turned
        added = engine.balancing.counterweight_share * weights[which] * turned
        before = np.sum(list(waves.values()), axis=0) + rotating
        after = sum(_left(engine, order) * part for order, part in waves.items()) + rotating + added
        columns[f"{letter}rot_up_{unit}"] = rotating.real
        columns[f"{letter}rot_right_{unit}"] = rotating.imag
        columns[f"{letter}up_{unit}"] = before.real
        if not engine.is_in_line:
            columns[f"{letter}right_{unit}"] = before.imag
        columns[f"{letter}up_after_{unit}"] = after.real
        columns[f"{letter}right_after_{unit}"] = after.imag
    return columns


def _firing_orders(engine: Engine) -> Columns:
    table = firing_orders.offsets_table(firing_orders.dead_centres(engine))
    codes = [int("".join(map(str, firing_orders.sequence(row)))) for row in table]
    gaps = firing_orders.intervals(table)
    columns = {
        "variant": np.arange(1.0, len(table) + 1),
        **{f"theta{i + 1}_deg": table[:, i] for i in range(table.shape[1])},
        "order_code": np.array(codes, dtype=float),
        "gap_max_deg": gaps.max(axis=1),
        "gap_min_deg": gaps.min(axis=1),
        "unevenness": firing_orders.unevenness(table),
        "half_order_sum": firing_orders.order_sum(table, 0.5),
        "first_order_sum": firing_orders.order_sum(table, 1.0),
    }
    if has_single_rods(engine) and engine.force_offsets is None:
        columns["Rorder_max_kN"] = firing_orders.journal_loads(engine, table)
    return columns


def _scalars(case: Case) -> Scalars:
    engine, choice = case.engine, case.engine.balancing
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    rods = len(throws(engine.arrangement)[0])
    needed = rotating_mass(engine) + choice.counterweight_share * rods * m_j
    scalars = {
        "Pj_unit_kN": case.inertia_unit,
        "counterweight_needed": needed,
        "counterweight_web": needed / 2,
    }
    names = ("",) if engine.is_in_line else ("", "_back")
    for number, moments in enumerate(balance.shaft_moments(engine), 1):
        for name, moment in zip(names, moments, strict=False):
            scalars[f"shaft{number}{name}_moment"] = moment
            scalars[f"shaft{number}{name}_mass"] = moment / choice.shaft_radius
    return scalars | _first_order(case)


def _first_order(case: Case) -> Scalars:
    """Rotating and first-order vectors before and after balancing."""
    engine, choice = case.engine, case.engine.balancing
    cylinders = balance.cylinders_of(engine)
    bare = balance.rotating(engine, counterweights=False)
    shaft = balance.rotating(engine, counterweights=True)
    more = balance.ideal_counterweights(engine)
    upright = balance.reciprocating(engine, cylinders, 1)
    half_length = -float(balance.throw_starts(engine)[0])
    scalars: Scalars = {}
    for which, (letter, _) in enumerate(_KINDS):
        noise = 1e-9 * case.inertia_unit * (half_length if which else 1)
        scalars[f"{letter}rot_bare"] = abs(bare[which])
        scalars[f"{letter}rot"] = abs(shaft[which])
        weights = shaft[which] + choice.counterweight_share * more[which]
        vectors = {
            "before": upright[which] + balance.turning(shaft[which]),
            "after": upright[which] * _left(engine, 1) + balance.turning(weights),
        }
        for name, vector in vectors.items():
            shape = balance.ellipse(vector, noise)
            scalars[f"{letter}1_{name}_max"] = shape.largest
            scalars[f"{letter}1_{name}_min"] = shape.smallest
            scalars[f"{letter}1_{name}_deg"] = shape.direction
    return scalars


def torque_order_results(case: Case) -> Results:
    """Tangential forces, their orders and, of four-stroke engines, what shafts suppress; SI.

    Shafts are for engines whose torque has a second order: four cylinders have, three not.

    Chudakov's zones compare with a cycle of compression alone, which ports do not give, and
    with the inertia forces of a central mechanism.
    """
    curves = _tangential(case)
    tables = {
        "tangential": {"phi_deg": case.raw.phi, **curves},
        "torque_orders": _torque_orders(case, curves),
    }
    if not _has_motored(case):
        return tables, {}
    scalars = _coefficients(case, curves)
    if not _has_second_order(case):
        return tables, {key: value for key, value in scalars.items() if key not in _OF_SHAFTS}
    return tables | {"suppression": _suppression(case, scalars)}, scalars


def _has_motored(case: Case) -> bool:
    """Whether a cycle of compression alone is compared with."""
    return case.engine.strokes == 4 and case.engine.geometry.offset == 0


def _has_second_order(case: Case) -> bool:
    """Whether the torque of the engine has a second order that shafts could take away."""
    together = np.exp(-2j * np.array(case.engine.firing_offsets)).sum()
    return bool(np.abs(together) > _ZERO_SUM)


def _tangential(case: Case) -> Columns:
    """Specific tangential force of cylinder 1 from gas, inertia and the motored cycle [Pa]."""
    raw, first = case.raw, (case.index, 0)
    at = Position.at(raw.local_phi[first], *case.sizes[1:])
    shape = at.sin + at.sin_beta / at.cos_beta * at.cos
    curves = {"t_gas_MPa": raw.p_gas[first] * shape, "t_inertia_MPa": raw.p_inertia[first] * shape}
    if _has_motored(case):
        curves["t_motored_MPa"] = (_motored(case) - case.engine.gas.p_ambient) * shape
    return curves


def _motored(case: Case) -> Array:
    """Gas pressure without combustion [Pa]: the compression, mirrored about TDC."""
    raw, first, gas = case.raw, (case.index, 0), case.engine.gas
    phi, pressure = raw.local_phi[first], raw.p[first]
    between = (phi > np.pi + 1e-9) & (phi < 3 * np.pi - 1e-9)
    if isinstance(gas, TabulatedGas):
        row = np.arange(len(phi))
        mirrored = pressure[np.minimum(row, row[::-1])]
    else:
        eps = case.engine.geometry.compression_ratio
        mirrored = gas.p_intake * (eps / raw.volume_ratio[first]) ** gas.n_compression
    cold: Array = np.where(between, mirrored, pressure)
    return cold


def _torque_orders(case: Case, curves: Columns) -> Columns:
    """Orders 1/2, 1, … 8 of a four-stroke engine, 1 … 8 of a two-stroke one, up to the grid's."""
    engine = case.engine
    orders = case.orders(LAST_ORDER)
    gas, inertia = (
        harmonics.analyse(curves[key], engine.period, orders)
        for key in ("t_gas_MPa", "t_inertia_MPa")
    )
    total = harmonics.Harmonics(orders, gas.cosine + inertia.cosine, gas.sine + inertia.sine)
    together = np.abs(np.exp(-1j * orders[:, None] * np.array(engine.firing_offsets)).sum(axis=1))
    lever = engine.geometry.piston_area * engine.geometry.crank_radius
    table: Columns = {"order": orders}
    for name, part in (("gas", gas), ("inertia", inertia), ("total", total)):
        table |= {
            f"{name}_cos_MPa": part.cosine,
            f"{name}_sin_MPa": part.sine,
            f"{name}_amplitude_MPa": part.amplitude,
            f"{name}_phase_deg": part.phase,
        }
    table["cylinders_sum"] = together
    table["M_engine_order_Nm"] = total.amplitude * lever * together
    return table


def _coefficients(case: Case, curves: Columns) -> Scalars:
    """Second-order coefficients of gas and inertia, zones of speed, shafts; Chudakov (5)-(8)."""
    engine, geometry, lam = case.engine, case.engine.geometry, case.engine.geometry.lam
    second = {key: harmonics.analyse(curve, engine.period, SECOND) for key, curve in curves.items()}
    amplitude = {key: float(each.amplitude[0]) for key, each in second.items()}
    gas, cold = amplitude["t_gas_MPa"], amplitude["t_motored_MPa"]
    # Between the motored and the working cycle the harmonic is taken linear in p_i; at idle
    # all of p_i goes into friction.
    idle = cold + (gas - cold) * (1 - engine.mechanical_efficiency)
    unit = case.inertia_unit / geometry.piston_area
    m_j, _ = point_masses(engine.masses, geometry.rod_length)
    d_j = harmonics.specific_imbalance(m_j, geometry.crank_radius, geometry.piston_area)
    t_j = float(harmonics.inertia_second(d_j, case.omega))
    bounds = sorted(harmonics.speed_of(t_gas, d_j) for t_gas in (idle, gas))
    best = float(harmonics.best_suppression(np.array(gas), np.array(t_j)))
    psi, rod = engine.balancing.suppression, geometry.rod_length
    scalars = {
        **{f"t_j_order{n}": value * unit
           for n, value in enumerate(harmonics.inertia_coefficients(lam), 1)},
        "d_j": d_j,
        "d_j_technical": d_j,
        "t_gas2": gas,
        "gamma_gas2_deg": float(second["t_gas_MPa"].phase[0]),
        "t_inertia2": amplitude["t_inertia_MPa"],
        "gamma_inertia2_deg": float(second["t_inertia_MPa"].phase[0]) % (2 * np.pi),
        "t_j2": t_j,
        "t_motored2": cold,
        "t_gas2_idle": idle,
        "n_zone1": bounds[0],
        "n_zone2": bounds[1],
        "zone": 1.0 + (engine.omega > bounds[0]) + (engine.omega > bounds[1]),
        "psi_best_nominal": best,
        "h_shafts": harmonics.shaft_offset(psi, rod),
        "h_shafts_best": harmonics.shaft_offset(best, rod),
    }  # fmt: skip
    if engine.is_in_line:
        scalars["P_shafts"] = 0.5 * lam * unit * geometry.piston_area * engine.cylinders
    return scalars


def _suppression(case: Case, scalars: Scalars) -> Columns:
    """Second order left by balance shafts over the speed, Chudakov (6)."""
    engine = case.engine
    ratio = np.linspace(0.3, 1.2, 10)
    omega: Array = ratio * engine.omega
    t_j = harmonics.inertia_second(scalars["d_j"], omega)
    nominal, idle = np.array(scalars["t_gas2"]), np.array(scalars["t_gas2_idle"])
    psi = engine.balancing.suppression
    best = harmonics.best_suppression(nominal, t_j)
    return {
        "speed_share": ratio,
        "n_rpm": omega,
        "t_j2_MPa": t_j,
        "residual_bare_MPa": harmonics.residual(nominal, t_j, 0.0),
        "residual_psi_MPa": harmonics.residual(nominal, t_j, psi),
        "residual_vector_MPa": harmonics.residual_vector(
            nominal, scalars["gamma_gas2_deg"], t_j, psi
        ),
        "psi_best": best,
        "psi_best_idle": harmonics.best_suppression(idle, t_j),
        "h_best_mm": best * engine.geometry.rod_length,
    }
