"""Variants out: rubric, assignment, roster, work-books, register."""
