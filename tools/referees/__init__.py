"""Two spreadsheet engines that recalculate our own workbooks whole, as checks of each other."""
