"""Referees: spreadsheet engines that compute a workbook's formulas anew."""
