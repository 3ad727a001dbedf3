"""A notebook's way through the public names, typed: a test runs it and checks its types.

From Tab to a result: what ``docs/api.md`` shows, with the kinds of everything said aloud.
"""

from __future__ import annotations

import copy
import pickle
import tempfile
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd

import kshm
import reports

folder = Path(tempfile.mkdtemp())
same: kshm.Engine = reports.load("gots-diesel")
reports.dump(same, folder / "engine.toml")
engine: kshm.Engine = reports.load(folder / "engine.toml")
also: kshm.Engine = reports.load((folder / "engine.toml").read_bytes())
names: tuple[str, ...] = reports.samples()
text: str = reports.dump(engine)
solution: kshm.Solution = kshm.solve(engine)
peak = solution.loads.crankpin_max
title: str = peak.title
value: float = peak
said: str = f"{peak.title}: {peak.symbol} = {peak:.1f} {peak.unit}"
most: float = max(solution.loads.journal_max)
each: list[float] = [float(x) for x in solution.loads.journal_max]
again: list[object] = [copy.copy(peak), copy.deepcopy(solution)]
again.append(pickle.loads(pickle.dumps(solution)))
frame: pd.DataFrame = solution.tables["P4_1"]
unit: str = frame.attrs["units"]["N_MPa"]
array: np.ndarray[tuple[int, ...], np.dtype[np.float64]] = solution.columns["P4_1"]["N_MPa"]
svg: str = solution.plot.torque().svg
polar: str = reports.plot(solution).polar(2).svg
files: tuple[Path, ...] = reports.build(engine, folder / "out", only=["xlsx", "html"])
study: pd.DataFrame = kshm.sweep(
    engine,
    {"speed_rpm": range(1000, 4400, 1700), "bore_mm": np.linspace(84, 92, 3)},
    quantities=["torque.mean", "P4_1.N_MPa"],
)
pairs: pd.DataFrame = kshm.sweep(
    engine, {"crankshaft.webs.*.counterweight_kg": (0.8, 0.9), "regime.speed_rpm": [2000, 3000]},
    pairwise=True,
)  # fmt: skip
slow: kshm.Engine = replace(engine, omega=200.0)
wide: kshm.Engine = engine.with_(bore_mm=90)
for chunk in kshm.solve_chunks([slow, engine]):
    torque = chunk.torque_sum.max(axis=-1)
gas = kshm.polytropic(
    intake_mpa=0.165, residual_mpa=0.182, max_mpa=10.5, compression_exponent=1.368,
    expansion_exponent=1.288, combustion_start_deg=357, injection_advance_deg=15,
    exhaust_open_deg=498, exhaust_close_deg=565,
)  # fmt: skip
crank = kshm.throw(
    arms_mm=np.array([32, 32, 0, 0, 32, 32]), web_kg=0.245, counterweight_kg=0.9, pin_kg=0.425
)
numbers: kshm.Engine = kshm.in_line(
    bore_mm=np.float64(88), crank_radius_mm=47, rod_length_mm=148, compression_ratio=18,
    speed_rpm=4400, gas=gas, reciprocating_kg=2.0, rod_big_end_kg=1.269,
    firing_offsets_deg=np.arange(3) * 240, throws=crank, pin_diameter_mm=56, pin_length_mm=28,
    main_diameter_mm=64, main_lengths_mm=np.full(4, 32.0),
)  # fmt: skip
layouts: list[kshm.Engine] = []
sizes: kshm.EngineNumbers = {
    "bore_mm": 88, "crank_radius_mm": 47, "rod_length_mm": 178, "compression_ratio": 18,
    "speed_rpm": 2200, "gas": gas, "reciprocating_kg": 2.0, "rod_big_end_kg": 1.269,
    "throws": crank, "pin_diameter_mm": 56, "pin_length_mm": 28, "main_diameter_mm": 64,
    "main_lengths_mm": 32, "nose": kshm.end_mass(0.426, 210, 130),
}  # fmt: skip
layouts.append(kshm.assemble(kshm.opposed(2), firing_offsets_deg=[0, 360], **sizes))
pair = [kshm.place(0), kshm.place(0, axis_deg=90, rod_place=1)]
layouts.append(kshm.assemble(pair, firing_offsets_deg=[0, 450], **sizes))
hung = kshm.articulated_rod(
    rod_length_mm=133, radius_mm=45, angle_deg=90, reciprocating_kg=1.9, big_end_kg=0.6
)
star = kshm.banks(1, [0, 90], articulated=True)
layouts.append(kshm.assemble(star, firing_offsets_deg=[0, 450], articulated=[hung], **sizes))
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    by_points = kshm.points(np.array([0, 360, 720]), [0.1, 10.0, 0.1], smooth=True)
    sizes["gas"] = by_points
    layouts.append(kshm.in_line(firing_offsets_deg=[0, 360], **sizes))
root: kshm.Optimum = kshm.solve_for(
    engine, "balance.irregularity", "flywheel.irregularity", 0.02, between=(0.005, 0.05)
)
least: kshm.Optimum = kshm.optimise(
    engine, {"crankshaft.webs.*.counterweight_kg": (0.2, 3)}, "Rmain2_mean"
)
lighter: dict[str, float] = least.values
bands: kshm.Bands = kshm.tolerance(engine, {"bore_mm": 0.02}, samples=20)
table: pd.DataFrame = bands.table
about: kshm.Quantity = kshm.quantity("Rpin_max")
interrupted: type[kshm.StudyInterrupted] = kshm.StudyInterrupted
unknown: type[kshm.UnknownNameError] = kshm.UnknownNameError
every: type[kshm.KshmError] = kshm.KshmError
si: float = kshm.quantity("N_MPa").si
try:
    kshm.quantity("N_MP")
except kshm.InputError as error:
    problems: tuple[kshm.Problem, ...] = error.problems
    hint: str = problems[0].hint
