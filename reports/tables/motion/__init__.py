"""Tables of geometry, masses and motion: Gots chapters 1 and 2.2."""
