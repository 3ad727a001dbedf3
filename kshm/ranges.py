"""Usual and doubtful ranges of quantities of engines: one line a quantity.

A usual range tells what engines have; beyond a doubtful one a slip of a unit, a comma or a key is
likely.  A range without a source is common knowledge that was not checked against a book.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

Span = tuple[float, float]
Spans = Mapping[str, Span]

# Table 4 of Gots: masses over the piston's area [kg/m²] and what they hold for.  The row of the
# rod has lost its numbers in the text at hand: 100…200 and 250…400 are those of Kolchin and
# Demidov, whose table the other rows repeat.
PISTON_MASSES: dict[tuple[str, str], Span] = {
    ("aluminium", "petrol"): (80.0, 100.0),
    ("aluminium", "diesel"): (150.0, 300.0),
    ("iron", "petrol"): (150.0, 200.0),
    ("iron", "diesel"): (250.0, 400.0),
}
ROD_MASSES: dict[str, Span] = {"petrol": (100.0, 200.0), "diesel": (250.0, 400.0)}
THROW_MASSES: dict[tuple[str, str], Span] = {
    ("steel", "petrol"): (150.0, 200.0),
    ("steel", "diesel"): (200.0, 400.0),
    ("iron", "petrol"): (100.0, 200.0),
    ("iron", "diesel"): (150.0, 300.0),
}
MASSES_BORES: dict[str, Span] = {"petrol": (0.06, 0.1), "diesel": (0.08, 0.12)}  # [m]
MASSES_STROKE_BORE: Span = (1.0, 1.2)  # "the smaller values for S/D ≤ 1"
# Usual sizes of the parts, from memory of A. I. Kolchin and V. P. Demidov (2008): what a size is
# measured by, its share for petrol engines and for diesels (least, greatest); the middle is taken.
PART_SHARES: dict[str, tuple[str, Span, Span]] = {
    "crown": ("bore", (0.05, 0.10), (0.12, 0.20)),
    "height": ("bore", (0.8, 1.3), (1.0, 1.7)),
    "skirt": ("bore", (0.6, 0.8), (0.6, 1.1)),
    "head_wall": ("bore", (0.05, 0.10), (0.05, 0.10)),
    "land": ("bore", (0.03, 0.05), (0.04, 0.07)),
    "bosses": ("bore", (0.3, 0.5), (0.3, 0.5)),
    "ring_radial": ("bore", (0.040, 0.045), (0.040, 0.045)),
    "ring_gap": ("ring_radial", (2.5, 4.0), (2.5, 4.0)),
    "pin": ("bore", (0.22, 0.28), (0.30, 0.38)),
    "pin_bore": ("pin", (0.65, 0.75), (0.50, 0.70)),
    "pin_length": ("bore", (0.78, 0.88), (0.80, 0.90)),
    "eye_length": ("bore", (0.33, 0.45), (0.33, 0.45)),
    "eye_outer": ("pin", (1.25, 1.65), (1.3, 1.7)),
    "bush_wall": ("pin", (0.055, 0.085), (0.055, 0.085)),
    "shank_height": ("eye_outer", (0.60, 0.77), (0.60, 0.77)),
    "shank_width": ("eye_length", (0.50, 0.60), (0.55, 0.75)),
    "shank_web": ("bore", (0.030, 0.045), (0.040, 0.070)),
    "shank_flange": ("bore", (0.030, 0.045), (0.040, 0.070)),
    "bolt": ("bore", (0.12, 0.14), (0.13, 0.16)),
    "bolts_apart": ("crankpin", (1.30, 1.75), (1.30, 1.75)),
    "cap_length": ("crankpin", (0.45, 0.95), (0.45, 0.95)),
    "shell": ("crankpin", (0.03, 0.05), (0.03, 0.05)),
}
# What boost changes: boosted petrol engines have no ranges of these.
_BOOST_CHANGES = frozenset({
    "charge.gamma", "charge.t_a", "charge.eta_v", "compression.p_c", "compression.t_c",
    "combustion.p_z", "expansion.p_b", "indicated.p_i",
})  # fmt: skip


def hull(spans: Iterable[Span]) -> Span:
    """Least range that holds all of some ranges."""
    lows, highs = zip(*spans, strict=True)
    return min(lows), max(highs)


def side_of(value: float, span: Span) -> int:
    """1 above a range, -1 below, 0 within; a compression is the greater, the further from zero."""
    if span[0] <= value <= span[1]:
        return 0
    return 1 if abs(value) > max(map(abs, span)) else -1


@dataclass(frozen=True, slots=True)
class Ranges:
    """Ranges of one quantity, ends included, in the unit of its line.

    Attributes:
        usual: by a group of engines (``petrol``, ``diesel``, ``diesel_na``, ``diesel_turbo``) or
            a material; "" of all.
        doubtful: by the kind of engine, "" of all.
        source: place that prints the usual range; empty where none is known.
        sources: places of single groups.
    """

    usual: Spans = field(default_factory=dict)
    doubtful: Spans = field(default_factory=dict)
    source: str = ""
    sources: Mapping[str, str] = field(default_factory=dict)

    def of(self, group: str = "") -> Span:
        """Usual range of a group, of a kind all its groups, of an unknown kind all."""
        spans = [
            span
            for name, span in self.usual.items()
            if group in ("", name) or not name or name.startswith(f"{group}_")
        ]
        return hull(spans or self.usual.values())


def _kinds(petrol: Span, diesel: Span, doubtful: Span | Spans, source: str = "") -> Ranges:
    return Ranges({"petrol": petrol, "diesel": diesel}, _doubtful(doubtful), source)


def _all(usual: Span, doubtful: Span | Spans | None = None, source: str = "") -> Ranges:
    return Ranges({"": usual}, _doubtful(doubtful), source)


def _cycle(
    petrol: Span,
    natural: Span,
    turbo: Span,
    doubtful: Span | Spans | None = None,
    **turbo_from: str,
) -> Ranges:
    usual = {"petrol": petrol, "diesel_na": natural, "diesel_turbo": turbo}
    return Ranges(usual, _doubtful(doubtful), sources=turbo_from)


def _doubtful(spans: Span | Spans | None) -> Spans:
    if spans is None:
        return {}
    return spans if isinstance(spans, Mapping) else {"": spans}


def _of_aluminium_and_iron(aluminium: Span, iron: Span) -> Ranges:
    return Ranges({"aluminium": aluminium, "iron": iron})


# Ratios of an engine's data; those of the working cycle by path in `kshm.cycle.Cycle` (MPa, K);
# stresses, pressures and deformations of parts by key (MPa, mm), from memory of Kolchin and
# Demidov.
RANGES: dict[str, Ranges] = {
    # S/D; crosshead engines are long
    "stroke_bore": _kinds((0.7, 1.1), (0.9, 1.35), {"": (0.6, 1.55), "crosshead": (0.6, 4.5)}),
    "lam": _all((0.24, 0.31), (0.15, 0.45), "Gots 1.1"),
    "offset": _all((0.05, 0.20), (0.026, 0.25), "Gots 1.1"),  # e/r
    "piston_speed": _kinds((9, 16), (5, 16), (2.8, 26.0), "Gots 1.2"),  # mean [m/s]
    "compression_ratio": _kinds(
        (6, 12), (14, 23), {"": (5, 26), "petrol": (5, 15.5), "diesel": (11.5, 26)}
    ),
    # masses over the piston's area [kg/m²]
    "piston_mass": _kinds(
        PISTON_MASSES["aluminium", "petrol"], PISTON_MASSES["aluminium", "diesel"],
        {"": (64, 500), "petrol": (64, 280), "diesel": (110, 500)}, "Gots table 4",
    ),
    "rod_mass": _kinds(
        ROD_MASSES["petrol"], ROD_MASSES["diesel"],
        {"": (64, 500), "petrol": (64, 280), "diesel": (130, 500)}, "Gots table 4",
    ),
    "throw_mass": _kinds(
        THROW_MASSES["steel", "petrol"], THROW_MASSES["steel", "diesel"], (90, 800), "Gots table 4"
    ),
    "reciprocating_mass": Ranges(doubtful={"": (80, 650), "any": (30.0, 2000.0)}),  # any: to ships
    "rod_share": _all((0.2, 0.3), (0.15, 0.4), "Gots 2.2"),  # of the rod's mass at the pin
    # journals: diameters over the bore, length for one rod over the diameter
    "pin": _kinds((0.45, 0.7), (0.55, 0.8), (0.3, 0.95)),
    "main": _kinds((0.5, 0.85), (0.6, 0.95), (0.3, 1.15)),
    "pin_length": _kinds((0.35, 0.65), (0.4, 0.7), (0.25, 1.2)),
    # bearing of a rod: pressures [MPa], least film [µm]
    "pin_pressure": _all((4, 16)),
    "pin_peak": _kinds((7, 30), (10, 50), {}),
    "film": _kinds((1, 6), (1, 10), {}),
    # working cycle: petrol, natural diesel, boosted diesel
    "inputs.excess_air": _cycle(
        (0.85, 1.05), (1.4, 1.8), (1.35, 2.0), {"petrol": (0.75, 1.5), "diesel": (1.15, 4)}
    ),
    "inputs.charge_heating": _cycle((0, 25), (10, 40), (-5, 10), (-15, 45)),
    "inputs.t_residual": _cycle((900, 1100), (600, 900), (600, 900), (600, 1250)),
    "charge.gamma": _cycle((0.04, 0.10), (0.02, 0.05), (0.0, 0.03)),
    "charge.t_a": _cycle((320, 370), (310, 350), (320, 400)),
    "charge.eta_v": _cycle((0.70, 0.95), (0.80, 0.94), (0.80, 0.97)),
    "inputs.recharge": _cycle((1.0, 1.12), (1.0, 1.10), (1.02, 1.10), (1, 1.15)),
    "inputs.scavenging": _cycle((1, 1), (1, 1), (0.6, 1.0), (0.6, 1)),
    "compression.n_1": _cycle((1.34, 1.38), (1.38, 1.42), (1.32, 1.38), (1.2, 1.45)),
    "compression.p_c": _cycle((0.9, 2.1), (3.5, 5.5), (6.0, 8.0)),
    "compression.t_c": _cycle((550, 750), (700, 900), (900, 1000)),
    "inputs.xi_z": _cycle((0.80, 0.95), (0.70, 0.88), (0.70, 0.88), (0.65, 0.97)),
    "inputs.xi_b": _cycle((0.85, 0.95), (0.80, 0.92), (0.82, 0.92), (0.75, 0.97)),
    "combustion.lambda_p": _cycle((3.0, 4.2), (1.2, 2.5), (1.2, 1.8)),
    "combustion.t_z": _cycle((2400, 3100), (1800, 2300), (1800, 2300)),
    "combustion.p_z": _cycle(
        (3.5, 7.5), (5, 12), (6, 15), {"": (1.2, 25.0), "diesel": (4, 25)},
        diesel_turbo="ukrbukva.net 68604",
    ),
    "expansion.n_2": _cycle((1.23, 1.30), (1.18, 1.28), (1.18, 1.28), (1.1, 1.4)),
    "expansion.p_b": _cycle((0.35, 0.6), (0.2, 0.5), (0.3, 0.8)),
    "expansion.t_b": _cycle((1200, 1700), (1000, 1200), (1000, 1300)),
    "inputs.fullness": _cycle((0.94, 0.97), (0.92, 0.95), (0.91, 0.96), (0.88, 0.99)),
    "effective.eta_m": _cycle((0.75, 0.92), (0.70, 0.82), (0.75, 0.90), (0.5, 0.96)),
    "indicated.p_i": _cycle((0.6, 1.4), (0.7, 1.1), (0.0, 2.2)),
    # parts
    "st_crown_MPa": _of_aluminium_and_iron((20, 150), (40, 200)),
    "st_press_MPa": _of_aluminium_and_iron((0, 40), (0, 80)),
    "st_pull_MPa": _of_aluminium_and_iron((0, 10), (0, 20)),
    "st_land_MPa": _of_aluminium_and_iron((0, 40), (0, 80)),
    "st_q1_MPa": _all((0, 1)),
    "st_q2_MPa": _all((0, 0.7)),
    "st_ring_MPa": _all((0.1, 0.4)),
    "st_ring_work_MPa": _all((200, 450)),
    "st_pin_eye_MPa": _all((15, 60)),
    "st_pin_boss_MPa": _all((10, 50)),
    "st_pin_bend_MPa": _all((80, 250)),
    "st_pin_shear_MPa": _all((50, 250)),
    "st_oval_mm": _all((0, 0.05)),
    "st_oval_in0_MPa": _all((-350, 350)),
    "st_bush_in_MPa": _all((0, 150)),
    "st_cap_MPa": _all((0, 300)),
}  # fmt: skip


def cycle_ranges(kind: str, *, boosted: bool) -> Iterator[tuple[str, Span, str]]:
    """Usual ranges of the working cycle: path in `kshm.cycle.Cycle`, span (MPa, K), source."""
    group = "petrol" if kind == "petrol" else "diesel_turbo" if boosted else "diesel_na"
    for path, ranges in RANGES.items():
        changed = group == "petrol" and boosted and path in _BOOST_CHANGES
        if "." in path and not changed:
            yield path, ranges.usual[group], ranges.sources.get(group, ranges.source)
