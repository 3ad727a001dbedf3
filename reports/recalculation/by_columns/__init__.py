"""The quick referee: whole columns of equal formulas at once in numpy.

A person fills a formula down, so that a column of seventy cells is one formula.
This referee reads the sheets of a workbook once, finds those runs and evaluates
each with one pass over arrays.  It knows a whitelist of functions; a workbook
with anything else is handed to formualizer by the caller.
"""

from reports.recalculation.by_columns.engine import Engine
from reports.recalculation.by_columns.grid import BadBook, Grid
from reports.recalculation.by_columns.reading import read_grid
from reports.recalculation.by_columns.syntax import UnknownFormula

__all__ = ["BadBook", "Engine", "Grid", "UnknownFormula", "read_grid"]
