"""Deliberate breaks of the product and the tests that must see them: ``./run breaks``."""
