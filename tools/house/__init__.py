"""Measures of the structure: how many rooms a thought passes through."""
