"""Figures of the report: arrays in, one SVG element as text out.

Every function is pure and gives the same bytes for the same data, so figures may be drawn
in several processes and kept by content.
"""

from reports.document.figures.charts import (
    Level,
    Mark,
    Panel,
    Series,
    line_chart,
    pv_diagram,
    stacked_panels,
    twin_chart,
)
from reports.document.figures.overview import engine_scheme
from reports.document.figures.polar import Pole, polar_path
from reports.document.figures.schemes import crank_scheme, mechanism_sketch
from reports.document.figures.wear import roman, wear_diagram

__all__ = [
    "Level",
    "Mark",
    "Panel",
    "Pole",
    "Series",
    "crank_scheme",
    "engine_scheme",
    "line_chart",
    "mechanism_sketch",
    "polar_path",
    "pv_diagram",
    "roman",
    "stacked_panels",
    "twin_chart",
    "wear_diagram",
]
