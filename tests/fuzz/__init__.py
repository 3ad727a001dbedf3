"""Fuzzing of the three doors for files from people: ``./run fuzz DOOR [SECONDS]``."""
