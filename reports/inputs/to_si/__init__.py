"""Conversion of the input file to the engine in SI."""
