"""Files of numbers and the way from an input to all files."""
