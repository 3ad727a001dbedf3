"""The solver's cylinder volume, for checks that judge pressures before there is an engine."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kshm.arrays import Array


def volume_ratio(angle_deg: float, lam: float, ratio: float) -> float:
    """V/V_c at a crank angle of a central mechanism with this λ and compression ratio."""
    return float(volume_ratios(angle_deg, lam, ratio))


def volume_ratios(angles_deg: Array | float, lam: float, ratio: float) -> Array:
    """V/V_c [-] at the crank angles of a central mechanism, elementwise."""
    # Only a file whose pressures are judged pays for the numeric part.
    import numpy as np

    from kshm.mechanics.kinematics import displacement_exact
    from kshm.mechanics.kinematics import volume_ratio as at_displacement

    crank = np.array(1.0)
    displacement = displacement_exact(np.radians(angles_deg), crank, np.array(lam))
    return at_displacement(displacement, 2 * crank, np.array(ratio))
