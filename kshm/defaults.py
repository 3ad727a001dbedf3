"""Engineering defaults: estimates that both statements take where a file is silent.

A default is an assumption, not physics: it stands once.
"""

from __future__ import annotations

# Torsional vibration, without a source but for the diesel of Mendes, Meirelles, Zampieri 2008.
PULLEY_SHARE = 0.4  # of a throw's inertia
DAMPING_SHARE = 49200.0  # N·s/m³, of F r²
RING_SHARE = 0.2  # of the inertia of the train brought to its first mass
FLYWHEEL_SHARE = 8.0  # of all throws, where the irregularity of the run gives none
OTHER_FLYWHEEL = 1.5  # times the flywheel
SPEED_RANGE = (0.4, 1.1)  # of the speed of the regime
LAST_ORDER = 12.0
SPEEDS, RAYS, STARS = 63, 12, 6  # points of the forced vibration, rays and stars drawn

# Safety of the journals, without a source.
FILLET_SHARE = 0.06  # of the journal's diameter

# Clearances of the bearings over the root of the diameter [mm over √mm], from memory.
CLEARANCE_SHARES = {"min": 0.007, "max": 0.014}
