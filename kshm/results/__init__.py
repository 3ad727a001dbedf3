"""From arrays to named quantities in the units of the tables."""
