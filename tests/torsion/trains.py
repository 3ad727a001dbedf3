"""Trains of the tests: printed ones and random ones."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from kshm.mechanics.torsion import Train

# openTorsion's tests; the frequency 176.1 is printed, the further digits follow by hand.
TWO_DISCS = Train(np.array([211.4, 8.3]), np.array([9.775e6]))
# Mendes, Meirelles, Zampieri 2008 by openTorsion's examples/ICE_example.py.
MWM = Train(
    np.array([0.0170, 0.0090, 0.0467, 0.0327, 0.0467, 0.0467, 0.0327, 0.0487, 2.0750]),
    np.array([1.106, 1.631, 1.253, 1.253, 1.678, 1.253, 1.253, 1.976]) * 1e6,
)
MWM_HZ = (216.5836, 592.7405, 984.923, 1171.0174, 1415.995, 1660.0439, 1794.3876, 2993.4736)
MWM_FORM = (1, 0.97154, 0.94231, 0.83922, 0.69557, 0.55246, 0.32268, 0.0773, -0.08183)

_inertia = st.floats(0.01, 10)
_stiffness = st.floats(1e4, 1e7)


@st.composite
def trains(draw: st.DrawFn, *, free: bool = False, most: int = 20) -> Train:
    """A train of 2 to 20 masses, its ends free or grounded."""
    count = draw(st.integers(2, most))
    inertias = draw(st.lists(_inertia, min_size=count, max_size=count))
    springs = draw(st.lists(_stiffness, min_size=count - 1, max_size=count - 1))
    ends = (0.0, 0.0) if free else draw(st.tuples(*(st.just(0.0) | _stiffness,) * 2))
    moduli = np.full(count - 1, 1e-4)
    return Train(np.array(inertias), np.array(springs), *ends, moduli)


def stiffness_matrix(train: Train) -> np.ndarray:
    """K of a train [N·m/rad], put together spring by spring."""
    count = len(train.inertias)
    matrix = np.zeros((count, count))
    for k, spring in enumerate(train.stiffnesses):
        matrix[k : k + 2, k : k + 2] += spring * np.array([[1, -1], [-1, 1]])
    matrix[0, 0] += train.left
    matrix[-1, -1] += train.right
    return matrix
