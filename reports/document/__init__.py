"""The PDF report: numbers, formulas, figures, templates and rendering.

The modules here know nothing of engines: they are given titles, TeX strings and
arrays.  Heavy libraries (weasyprint, matplotlib) are imported when first needed.
"""
