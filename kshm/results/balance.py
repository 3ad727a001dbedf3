"""Balance of one engine by orders and over a turn, its firing orders."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars
from kshm.chain import firing_orders
from kshm.engine.arrangement import throws
from kshm.engine.engine import Engine
from kshm.mechanics import balance
from kshm.mechanics.harmonics import acceleration_amplitude
from kshm.mechanics.masses import point_masses, rotating_mass
from kshm.results.case import Case
from kshm.results.layout import has_single_rods

ORDERS = tuple(range(1, 9))
# Letter of forces and moments with the unit that ends their keys.
_KINDS = (("F", "kN"), ("L", "Nm"))


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
    length = float(np.abs(cylinders.place).max()) + 1e-30
    kinds = (
        ("F", "kN", "order", "", None, 1.0),
        ("M", "Nm", "arm", "_mm", cylinders.place, length),
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
