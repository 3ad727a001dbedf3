"""People's books: read into a grid (``read``, ``sheets``) and calculated anew.

Formulas pass a whitelist (``language``, ``formulas``); what passes is written as a plain
book (``plain_book``) and calculated by formualizer (``evaluate``, ``lifted``).
"""
