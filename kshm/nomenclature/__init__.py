"""Key, symbol, unit, title and digits of every physical quantity."""
