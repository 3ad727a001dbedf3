"""People's books: read into a grid (``read``, ``sheets``) and calculated anew.

Formulas pass a whitelist (``formulas``); what passes is written as a plain book
(``minimal_xlsx``) and calculated by formualizer (``evaluate``, ``array_functions``).
"""
