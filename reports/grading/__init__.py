"""Variants for a class and the grading of the workbooks that come back."""
