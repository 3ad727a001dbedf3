"""A class as it comes back: books filled in by hand-written formulas, honest and not."""
