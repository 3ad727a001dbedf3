"""One figure of each kind and what stands in it."""

from xml.etree import ElementTree as ET

import numpy as np

from reports.document.figures.curves import Level, Mark, Panel, PlotCurve, curves_figure
from reports.document.figures.polar import Pole, polar_path, wear_diagram
from reports.document.figures.schemes import (
    crank_scheme,
    engine_scheme,
    mechanism_sketch,
    velocity_sketch,
)

PHI = np.arange(0, 721, 10.0)
RAD = np.radians(PHI)
FORCE = 5 * np.exp(-(((PHI - 375) / 30) ** 2)) - 3 * np.cos(RAD) - np.cos(2 * RAD)
T, K = FORCE * np.sin(RAD), FORCE * np.cos(RAD)

FIGURES = {
    "line": lambda: curves_figure(
        PHI,
        [
            Panel(
                [PlotCurve("$N$", T), PlotCurve(r"$S_{\mathrm{уд}}$", K), PlotCurve(r"$p'_j$",
                                                                                    FORCE)],
                "$p$, МПа",
                [Level("среднее", 0.4)],
                [Mark("max", 370.0, float(FORCE[37]))],
            )
        ],
        r"$\varphi$, °ПКВ",
    ),
    "legend": lambda: curves_figure(
        PHI, [Panel([PlotCurve(f"$a_{n}$", 50 * T * n) for n in range(8)], "y, мин⁻¹")], "x",
        height=40
    ),
    "stacked": lambda: curves_figure(
        PHI, [Panel([PlotCurve("", T * n)], f"$M_{n}$, Н·м") for n in (1, 2, 3)], "φ, °", height=48
    ),
    "pv": lambda: curves_figure(
        1.1 - np.cos(RAD),
        [Panel([PlotCurve("", FORCE + 5)], "p, МПа", marks=[Mark("$z$", 0.1, 9.0)])],
        "$V$, л",
        angle=False,
    ),
    "polar": lambda: polar_path(
        T, K, PHI, ("$T$", "$K$"), reverse=(False, True),
        poles=[Pole("$O$"), Pole("$O_1$", 0, 1.5)],
    ),
    "wear": lambda: wear_diagram(np.arange(1, 13), np.arange(12) * 30.0, 95.0),
    "mechanism": lambda: mechanism_sketch(0.3176),
    "offset": lambda: mechanism_sketch(0.3, k=0.2),
    "velocity": lambda: velocity_sketch(0.3),
    "cranks": lambda: crank_scheme([0, 120, 240]),
    "engine": lambda: engine_scheme([0, 90] * 2, [1, 1, 2, 2], [0, 90], [0, 90, 270, 540], 720.0),
}  # fmt: skip


def texts(svg: str) -> list[str]:
    """Texts of a figure."""
    nodes = [node for node in ET.fromstring(svg).iter() if node.tag.endswith("}text")]
    return ["".join(node.itertext()) for node in nodes]
