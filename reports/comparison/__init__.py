"""Engines side by side: what differs in their data, their results, their curves."""
