"""Workbooks: written with live formulas, caches and charts; read back after editing."""
