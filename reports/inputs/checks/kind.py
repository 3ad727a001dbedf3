"""What kind of engine a file states: in a key, in the engine's name, by its diagram."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile

# Combustion at a constant pressure; what is usual of spark ignition stays below.
DIESEL_RHO = 1.2
_WORDS = {
    "diesel": ("дизел", "diesel"),
    "petrol": ("бензин", "искров", "карбюратор", "petrol", "gasoline"),
}


def stated_kind(model: InputFile) -> str:
    """Diesel or petrol, as far as the file says it; else empty."""
    if model.cycle is not None:
        return model.cycle.kind
    stated = getattr(model.gas, "kind", None) or model.masses.estimate_fuel
    if stated:
        return str(stated)
    name = model.engine.name.lower()
    named = [kind for kind, words in _WORDS.items() if any(word in name for word in words)]
    return named[0] if len(named) == 1 else ""


def burns_as_diesel(model: InputFile) -> bool:
    """Whether only the diagram's ρ says that this is a diesel."""
    rho = getattr(model.gas, "preexpansion_ratio", None)
    return not stated_kind(model) and rho is not None and float(rho) >= DIESEL_RHO
