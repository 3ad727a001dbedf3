"""Torque of the engine and running-on torques, Gots 2.8."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def running_on_main(torque: Array) -> Array:
    """Torque running on to each main journal [N·m], Gots 2.8, tables 12 and П4.4.

    Args:
        torque: torque of each throw, shape (engines, throws, angles).

    Returns:
        Shape (engines, throws + 1, angles): zero on the first journal, the whole
        engine torque on the last.
    """
    engines, throws, angles = torque.shape
    running = np.zeros((engines, throws + 1, angles))
    np.cumsum(torque, axis=1, out=running[:, 1:])
    return running


def running_on_pin(before: Array, torque: Array) -> Array:
    """Torque running on to each crankpin [N·m] by the book's rule, Gots table 13.

    The torque on the main journal before plus half of the throw's own.

    Args:
        before: running-on torque on the main journal before the throw [N·m].
        torque: torque of each throw [N·m], shape (engines, throws, angles).
    """
    return before + torque / 2


def running_on_pin_statics(before: Array, tangential: Array, r: Array) -> Array:
    """Torque in the section through each crankpin [N·m] by statics.

    Args:
        before: running-on torque on the main journal before the throw [N·m].
        tangential: tangential force that the left support's reaction and the
            centrifugal forces left of the pin put on the left half of the throw [N].
        r: crank radius [m].
    """
    return before + r * tangential
