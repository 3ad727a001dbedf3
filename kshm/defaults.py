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
SENSITIVITY, SIZE_FACTOR = 0.7, 0.75

# Clearances of the bearings over the root of the diameter [mm over √mm], from memory.
CLEARANCE_SHARES = {"min": 0.007, "max": 0.014}

# Usual sizes of the parts, from memory of A. I. Kolchin and V. P. Demidov (2008): what a size is
# measured by, its share for petrol engines and for diesels (least, greatest); the middle is taken.
Span = tuple[float, float]
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
PISTON_SHARE = 0.65  # of the reciprocating mass, without a source
CAP_SHARE = 0.22  # of the rod's big end, without a source
GROOVE_SHARE = 0.5  # of the piston group above the section of the oil ring's groove
EYE_SHARE = 0.3  # of the rod's mass at the pin, above the section I-I of its eye, without a source
TURN_SHARE = 0.6  # of the endurance in torsion to that in bending, without a source
# Expansion [1/K] of cylinder, pistons and bush; temperature of the sizes [°C].
IRON_EXPANSION, ALUMINIUM_EXPANSION, BUSH_EXPANSION = 11e-6, 22e-6, 18e-6
SIZES_C = 20.0
