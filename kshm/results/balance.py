"""Balance of one engine as named columns and scalars."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kshm.chain import firing_orders
from kshm.engine.engine import Engine
from kshm.mechanics import balance
from kshm.mechanics.harmonics import acceleration_amplitude
from kshm.mechanics.masses import point_masses, rotating_mass

Array = NDArray[np.float64]
Columns = dict[str, Array]

ORDERS = tuple(range(1, 9))


def columns(engine: Engine) -> dict[str, Columns]:
    """Tables ``balance``, ``balance_orders`` and ``firing_orders`` in SI units."""
    tables = {"balance": _over_a_turn(engine), "balance_orders": _orders(engine)}
    if engine.strokes == 4 and engine.cylinders <= firing_orders.MAX_CYLINDERS:
        tables["firing_orders"] = _firing_orders(engine)
    return tables


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


def _orders(engine: Engine) -> Columns:
    cylinders = balance.cylinders_of(engine)
    lam = engine.geometry.lam
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    m_unit = m_j * engine.geometry.crank_radius * engine.omega**2
    rows: dict[str, list[float]] = {}
    length = float(np.abs(cylinders.place).max()) + 1e-30
    for order in ORDERS:
        sums = balance.order_phasors(cylinders, order)
        arms = balance.order_phasors(cylinders, order, cylinders.place)
        values = {"order": float(order), "order_amplitude": acceleration_amplitude(lam, order)}
        size = abs(values["order_amplitude"]) * m_unit
        kinds = (("F", "kN", "order", "", sums, 1.0), ("M", "Nm", "arm", "_mm", arms, length))
        for letter, unit, name, end, vector, scale in kinds:
            values[f"{name}_cos{end}"] = vector.up.real
            values[f"{name}_sin{end}"] = -vector.up.imag
            if engine.is_in_line:
                values[f"{letter}_order_{unit}"] = abs(vector.up) * size
                values[f"{letter}_order_deg"] = _phase(vector.up, order, scale)
                continue
            shape = balance.ellipse(vector, 1e-9 * scale)
            values |= {
                f"{name}_right_cos{end}": vector.right.real,
                f"{name}_right_sin{end}": -vector.right.imag,
                f"{letter}_order_{unit}": shape.largest * size,
                f"{letter}_order_min_{unit}": shape.smallest * size,
                f"{letter}_order_dir_deg": shape.direction,
            }
        values["F_left_kN"] = values["F_order_kN"] * _left(engine, order)
        values["M_left_Nm"] = values["M_order_Nm"] * _left(engine, order)
        for key, value in values.items():
            rows.setdefault(key, []).append(value)
    return {key: np.array(values) for key, values in rows.items()}


def _over_a_turn(engine: Engine) -> Columns:
    phi = np.radians(np.arange(0.0, 360.0 + engine.step_deg, engine.step_deg))
    cylinders = balance.cylinders_of(engine)
    found: Columns = {"phi_deg": phi}
    force, moment = balance.rotating(engine, counterweights=True)
    more = balance.ideal_counterweights(engine)
    share = engine.balancing.counterweight_share
    parts = {"F": (force, more[0], 0), "L": (moment, more[1], 1)}
    units = {"F": "kN", "L": "Nm"}
    for letter, (turning, weights, which) in parts.items():
        unit = units[letter]
        waves: dict[int, Array] = {}  # up + i·right
        for order in (1, 2, 4):
            phasors = balance.reciprocating(engine, cylinders, order)[which]
            wave = np.exp(1j * order * phi)
            waves[order] = np.real(phasors.up * wave) + 1j * np.real(phasors.right * wave)
            found[f"{letter}{order}_{unit}"] = waves[order].real
            if not engine.is_in_line:
                found[f"{letter}{order}_right_{unit}"] = waves[order].imag
        shaft = turning * np.exp(1j * phi)
        added = share * weights * np.exp(1j * phi)
        found[f"{letter}rot_up_{unit}"] = shaft.real
        found[f"{letter}rot_right_{unit}"] = shaft.imag
        before = np.sum(list(waves.values()), axis=0) + shaft
        after = sum(_left(engine, order) * part for order, part in waves.items()) + shaft + added
        found[f"{letter}up_{unit}"] = before.real
        if not engine.is_in_line:
            found[f"{letter}right_{unit}"] = before.imag
        found[f"{letter}up_after_{unit}"] = after.real
        found[f"{letter}right_after_{unit}"] = after.imag
    return found


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
    rods = [place.throw for place in engine.arrangement]
    if len(set(rods)) == len(rods) and engine.force_offsets is None:
        columns["Rorder_max_kN"] = firing_orders.journal_loads(engine, table)
    return columns


def scalars(engine: Engine) -> dict[str, float]:
    """Scalars of the balance in SI units."""
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    choice, cylinders = engine.balancing, balance.cylinders_of(engine)
    bare = balance.rotating(engine, counterweights=False)
    shaft = balance.rotating(engine, counterweights=True)
    more = balance.ideal_counterweights(engine)
    (first, first_back), (second, second_back) = balance.shaft_moments(engine)
    rods = sum(place.throw == 0 for place in engine.arrangement)
    needed = rotating_mass(engine) + choice.counterweight_share * rods * m_j
    values = {
        "Pj_unit_kN": m_j * engine.geometry.crank_radius * engine.omega**2,
        "counterweight_needed": needed,
        "counterweight_web": needed / 2,
        "shaft1_moment": first,
        "shaft1_mass": first / choice.shaft_radius,
        "shaft2_moment": second,
        "shaft2_mass": second / choice.shaft_radius,
    }
    if not engine.is_in_line:
        values |= {
            "shaft1_back_moment": first_back,
            "shaft1_back_mass": first_back / choice.shaft_radius,
            "shaft2_back_moment": second_back,
            "shaft2_back_mass": second_back / choice.shaft_radius,
        }
    half_length = -float(balance.throw_starts(engine)[0])
    for which, letter in enumerate("FL"):
        noise = 1e-9 * values["Pj_unit_kN"] * (half_length if which else 1)
        values[f"{letter}rot_bare"] = abs(bare[which])
        values[f"{letter}rot"] = abs(shaft[which])
        upright = balance.reciprocating(engine, cylinders, 1)[which]
        before = balance.added(upright, balance.turning(shaft[which]))
        weights = shaft[which] + choice.counterweight_share * more[which]
        rest = balance.scaled(upright, 1 - choice.first_shafts_share)
        after = balance.added(rest, balance.turning(weights))
        for name, vector in (("before", before), ("after", after)):
            shape = balance.ellipse(vector, noise)
            values[f"{letter}1_{name}_max"] = shape.largest
            values[f"{letter}1_{name}_min"] = shape.smallest
            values[f"{letter}1_{name}_deg"] = shape.direction
    return values
