"""Checks of the fields against each other."""
