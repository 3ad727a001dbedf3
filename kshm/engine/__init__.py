"""What an engine is: frozen dataclasses in SI units, no calculation."""
