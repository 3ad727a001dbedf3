"""Torsional vibration of the shaft."""
