"""Verdicts, causes and points."""
