"""The input room: TOML or workbook cells in, a checked `InputFile` and the SI engine out."""
