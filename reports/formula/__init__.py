"""The expression language in which the textbook's formulas are written once.

An expression is Python syntax restricted to arithmetic, comparisons,
conditional expressions and the functions of ``parse.FUNCTIONS``.  It is parsed
with ``ast`` and never evaluated by Python; three compilers turn it into numpy
values (``numeric``), an Excel formula (``excel``) and TeX (``tex``).
"""
