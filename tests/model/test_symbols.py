"""Symbols in plain text: an eye tells them apart."""

import importlib
import pkgutil

import kshm.nomenclature as room

_LOOK_ALIKE = str.maketrans("АВЕКМНОРСТХасеорху", "ABEKMHOPCTXaceopxy")


def test_no_two_symbols_differ_by_letters_that_look_alike():
    modules = [importlib.import_module(m.name)
               for m in pkgutil.iter_modules(room.__path__, f"{room.__name__}.")]  # fmt: skip
    symbols = {row[1] for module in modules for row in getattr(module, "ROWS", ())}
    assert len(symbols) > 500
    assert len({symbol.translate(_LOOK_ALIKE) for symbol in symbols}) == len(symbols)
