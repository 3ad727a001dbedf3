"""Variants out: roster, work-books, register."""
