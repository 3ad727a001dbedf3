"""Verdicts, causes and points of one workbook; signals over all of them."""
