"""Chapters of the report, one module a subject; the prose stands in the templates."""
