"""Centrifugal force of a throw, as formulas name it."""

from __future__ import annotations


def throw_pull(throw: int) -> str:
    """Specific centrifugal force of a throw's own mass, that of its counterweights left out."""
    if throw == 1:
        return "K_r_throw"
    webs = f"web_{2 * throw - 1}_mass_kg + web_{2 * throw}_mass_kg"
    return f"to_MPa((crankshaft_pin_mass_kg + {webs})*r_crank*omega**2/F_piston)"
