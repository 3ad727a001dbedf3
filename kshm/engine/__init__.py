"""The engine: frozen dataclasses in SI units, no calculation."""
