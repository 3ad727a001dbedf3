"""Mechanics as pure functions on arrays in SI units."""
