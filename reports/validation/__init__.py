"""The validation book: every printed number of the sources beside ours.

``data`` holds the printed numbers and the known misprints, ``registry`` says for each table
what computes it; no mechanics stand here.
"""
