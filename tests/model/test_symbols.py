"""Symbols in plain text follow from their TeX; an eye tells them apart."""

from __future__ import annotations

import importlib
import pkgutil
from collections import defaultdict

import pytest

import kshm.nomenclature as room
from kshm.nomenclature.quantity import Quantity, quantity
from kshm.nomenclature.symbols import WORDS, plain_symbol
from reports.model.blocks import Block, Grid, ScalarTable
from reports.shared.font_coverage import coverage
from tests.cover import engines_with, model_of, quantities

_LOOK_ALIKE = str.maketrans("АВЕКМНОРСТХасеорху", "ABEKMHOPCTXaceopxy")
NB = "\u00a0"
# The same coordinate in millimetres for people and in metres for the formulas beside it.
_IN_TWO_UNITS = {frozenset({"across_mm", "hung_q_x"}), frozenset({"along_mm", "hung_q_y"})}


def rows() -> dict[str, Quantity]:
    """Every row of the package by its key."""
    modules = [importlib.import_module(m.name)
               for m in pkgutil.iter_modules(room.__path__, f"{room.__name__}.")]  # fmt: skip
    return {row[0]: quantity(row[0]) for m in modules for row in getattr(m, "ROWS", ())}


def test_no_two_symbols_differ_by_letters_that_look_alike():
    symbols = {each.symbol for each in rows().values()}
    assert len(symbols) > 500
    assert len({symbol.translate(_LOOK_ALIKE) for symbol in symbols}) == len(symbols)


@pytest.mark.parametrize(
    ("tex", "text"),
    [
        (r"R'_{\mathrm{ш.ш}\,\max}", f"R′ш.ш{NB}max"),
        (r"\omega'_{\mathrm{ш}}", "ω′ш"),
        ("U''_{c}", "U″c"),
        (r"M_{\max}", "Mmax"),
        (r"v_{1\max}", "v1max"),
        (r"v_{1\,\max}", f"v1{NB}max"),
        (r"\varphi_{j'\min}", f"φj′{NB}min"),
        (r"M^{\mathrm{ст}}_{\mathrm{ш.ш}2}", "Mш.ш2 ст"),
        (r"t_{\mathrm{г}k}^{c}", "tгk c"),
        (r"\Sigma J a_{1}^2", "ΣJa1²"),
        (r"10^{-6}", "10⁻⁶"),
        (r"m_j r\omega^2/F_{\mathrm{п}}", "mj·rω²/Fп"),
        (r"m_{\mathrm{б}1-}e", "mб1−·e"),
        (r"A_{T(i+1)}\cos\gamma_{i+1}", f"AT(i+1) cos{NB}γi+1"),
        (r"\varphi - \varphi_i", "φ − φi"),
        (r"-n_{\mathrm{к}}", "−nк"),
        (r"\sigma_{-1}", "σ−1"),
        (r"\nu = 2{,}5", "ν = 2,5"),
        (r"V_{\varphi_c}/V_c", "Vφc/Vc"),
        (r"M_{\mathrm{CO_2}}", "MCO2"),
        (r"\bar j'_{\min}", "j̄′min"),
        (r"\dot\Phi/\omega", "Φ̇/ω"),
        (r"(m_{\mathrm{щ}})_{r1}", "(mщ)r1"),
        (r"f_{1}(J_{\mathrm{м}2})", "f1(Jм2)"),
        (r"\mathrm{Re}\,F'_{1+}", f"Re{NB}F′1+"),
        (r"F_{\mathrm{к}\perp 0}", "Fк⊥0"),
        (r"\frac{a + b}{c}", "(a + b)/c"),
        (r"\sqrt{\frac{a}{b}}", "√(a/b)"),
        (r"\left|\Delta s\right|_{\max}", "|Δs|max"),
        ("", ""),
    ],
)
def test_a_symbol_follows_from_its_tex(tex, text):
    assert plain_symbol(tex) == text


@pytest.mark.parametrize("tex", [r"\href", r"a\unknown b", r"\int x"])
def test_a_command_that_no_line_can_show_is_refused(tex):
    with pytest.raises(ValueError, match="no plain text"):
        plain_symbol(tex)


def test_the_fonts_of_the_report_have_every_sign():
    shown = {sign for each in rows().values() for sign in each.symbol}
    assert {sign for sign in shown if ord(sign) not in coverage()} == set()


def test_words_stand_where_symbols_cannot():
    assert len(WORDS) <= 40
    about = rows()
    assert WORDS.keys() <= about.keys()
    assert {key for key, each in about.items() if not each.symbol} == {
        "tor_fresh", "oil_fresh", "W_fresh", "st_over",
    }  # fmt: skip
    lines = {"check_value", "oil_open", "governs", "verdict"}
    assert lines <= {key for key in WORDS if not about[key].tex}


def of_block(block: Block) -> list[Quantity]:
    """Quantities that stand beside each other in a block."""
    if isinstance(block, Grid):
        return [row.quantity for row in block.rows]
    nodes = block.scalars if isinstance(block, ScalarTable) else block.columns
    return [node.quantity for node in nodes]


@pytest.mark.parametrize("name", engines_with(quantities))
def test_no_two_quantities_of_a_table_have_one_symbol(name):
    for block in model_of(name).blocks:
        by_symbol = defaultdict(set)
        for each in of_block(block):
            by_symbol[each.symbol].add(each.key)
        shared = {s: keys for s, keys in by_symbol.items() if len(keys) > 1 and s}
        wrong = {s: keys for s, keys in shared.items() if keys not in _IN_TWO_UNITS}
        assert wrong == {}, block.id
