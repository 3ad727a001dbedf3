"""Variants for a class and the grading of the workbooks that come back.

A room uses those before it only: issuing, reading, judging, pages, batch.
"""
