"""The tables of the textbook as specifications: one formula per column or scalar."""
