"""Input files and workbook cells, checked and converted to the SI engine."""
