"""Numbers, symbols and formulas as text."""
