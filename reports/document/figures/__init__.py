"""Figures of the report: arrays in, one SVG element as text out.

Every function is pure and gives the same bytes for the same data, so figures are kept by
content.
"""
