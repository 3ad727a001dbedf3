"""What kind of engine a file states: in a key, in the engine's name, by its diagram."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile

# Combustion at a constant pressure; what is usual of spark ignition stays below.
_DIESEL_RHO = 1.2
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


def diesel_rho(model: InputFile) -> float:
    """The diagram's ρ where it alone says that this is a diesel, else 0."""
    rho = float(getattr(model.gas, "preexpansion_ratio", None) or 0)
    return rho if rho >= _DIESEL_RHO and not stated_kind(model) else 0.0
