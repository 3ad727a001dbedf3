"""Drawings as lists of primitives in millimetres, and from them DXF and SVG."""
