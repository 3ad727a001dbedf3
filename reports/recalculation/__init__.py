"""Referees: spreadsheet engines that compute a workbook's formulas anew.

People's books are read into a grid (``read``, ``sheets``), their formulas pass a whitelist
(``formulas``) and are calculated by formualizer (``evaluate``).  Our own books are
recalculated whole, by formualizer and by LibreOffice, as checks of each other.
"""
