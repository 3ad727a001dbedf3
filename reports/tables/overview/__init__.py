"""Summary, checks, scheme of the engine."""
