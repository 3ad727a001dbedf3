"""A returned workbook in: whose it is, where its cells went, its values."""
