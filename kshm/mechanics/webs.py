"""Sizes of the webs that the drawing, inertia, strength and torsion share."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array
from kshm.engine.engine import Engine
from kshm.engine.torsion import Torsion


def web_thickness(engine: Engine, torsion: Torsion | None = None) -> Array:
    """Thickness of the left and the right web of every throw [m], shape (throws, 2), by statics.

    That between the arms of Gots figure 35; where the arms reach the middle of the web the
    common one of the torsional data, else a share of the bore.
    """
    data, choice = torsion or engine.torsion, engine.balancing
    common = data.web_thickness if data is not None else None
    usual = common or choice.web_thickness_share * engine.geometry.bore
    throws = engine.crankshaft.throws
    drawn = np.array([(t.left_web_thickness, t.right_web_thickness) for t in throws])
    return np.where(drawn > 0, drawn, usual)


def web_width(engine: Engine, torsion: Torsion | None = None) -> float:
    """Width of the webs [m]: that of the torsional data, else a share of the bore; by statics."""
    data = torsion or engine.torsion
    common = data.web_width if data is not None else None
    return common or engine.balancing.web_width_share * engine.geometry.bore
