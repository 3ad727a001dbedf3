"""From the input file in user units to the engine in SI."""
