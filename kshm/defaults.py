"""Engineering defaults: estimates that both statements take where a file is silent.

A default is an assumption, not physics: it stands once.
"""

from __future__ import annotations

STEEL = 7800.0  # density [kg/m³]

FINE_STEP = 1  # of the crank angle that extremes are held against [deg]

# Balancing and flywheel, without a source.
COUNTERWEIGHT_SHARE = 0.5  # of the inertia forces of the first order
SUPPRESSION = 0.5  # of the second-order rolling moment
IRREGULARITY = 0.015  # of the run

# Rod and webs: the small end as in Gots 2.9, the rest without a source.
SMALL_END_SHARE = 0.275  # of the rod's mass
WEB_WIDTH_SHARE, WEB_THICKNESS_SHARE = 1.125, 0.175  # of the bore

# Torsional vibration, without a source but for the diesel of Mendes, Meirelles, Zampieri 2008.
PULLEY_SHARE = 0.4  # of a throw's inertia
DAMPING_SHARE = 49200.0  # N·s/m³, of F r²
RING_SHARE = 0.2  # of the inertia of the train brought to its first mass
FLYWHEEL_SHARE = 8.0  # of all throws, where the irregularity of the run gives none
OTHER_FLYWHEEL = 1.5  # times the flywheel
LOSS_FACTOR = 0.035  # of the shafts
SPEED_RANGE = (0.4, 1.1)  # of the speed of the regime
LAST_ORDER = 12.0
SPEEDS, RAYS, STARS = 63, 12, 6  # points of the forced vibration, rays and stars drawn

# Safety of the journals, without a source.
FILLET_SHARE = 0.06  # of the journal's diameter
MEAN_BENDING, MEAN_TORSION = 0.15, 0.08  # sensitivity to the mean stress
FILLET_BENDING, FILLET_TORSION = 2.0, 1.5  # theoretical concentration
HOLE_BENDING, HOLE_TORSION = 2.2, 1.8
CLASS_RATIO = 1.15  # IACS UR M53: of the fatigue limit to the equivalent amplitude, at least
SENSITIVITY, SIZE_FACTOR = 0.7, 0.75

# Clearances of the bearings over the root of the diameter [mm over √mm], from memory.
CLEARANCE_SHARES = {"min": 0.007, "max": 0.014}

# Parts, of which strength is calculated.
PISTON_SHARE = 0.5  # of the reciprocating mass at least, without a source
CAP_SHARE = 0.22  # of the rod's big end, without a source
GROOVE_SHARE = 0.5  # of the piston group above the section of the oil ring's groove
EYE_SHARE = 0.3  # of the rod's mass at the pin, above the section I-I of its eye, without a source
TURN_SHARE = 0.6  # of the endurance in torsion to that in bending, without a source
# Expansion [1/K] of cylinder, pistons and bush; temperature of the sizes [°C].
IRON_EXPANSION, ALUMINIUM_EXPANSION, BUSH_EXPANSION = 11e-6, 22e-6, 18e-6
SIZES_C = 20.0

# Counterweights of the webs, without a source.
STEEL_DENSITY = 7850.0  # kg/m³
SKIRT_SHARE = 0.25  # of the bore: the piston below its pin, cut out for counterweights
SKIRT_PLAY = 2e-3  # between piston and counterweight [m]
OUTER_SHARE = 1.9  # of the crank radius: outer radius of the sector

# Flywheel, without a source.
IRON_DENSITY = 7200.0  # kg/m³
FLYWHEEL_STROKES = 2.8  # outer diameter over the stroke
FLYWHEEL_DISC_SHARE = 0.05  # thickness of the disc over the outer diameter
