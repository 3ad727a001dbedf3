"""Fourier coefficients and running sums of a column in the expression language."""

from __future__ import annotations

import numpy as np
import pytest

from reports.formula.excel import compile_formula
from reports.formula.numeric import evaluate
from reports.model.shape import FIRING
from reports.workbook.layout import Layout, RowReferences, at_row
from tests.workbook.made import model

DEGREES = np.arange(0.0, 721.0, 10.0)
NAMES = {"wave": 3 + 2 * np.cos(np.radians(DEGREES)) - 0.5 * np.sin(np.radians(2.5 * DEGREES)),
         "phi_deg": DEGREES, "order": np.array([0.5, 1.0, 2.5])}  # fmt: skip


def value(text: str) -> object:
    return evaluate(text, NAMES.__getitem__)


def test_coefficients_of_a_known_wave() -> None:
    assert value("fourier_cos(wave, phi_deg, order)") == pytest.approx([0, 2, 0], abs=1e-14)
    assert value("fourier_sin(wave, phi_deg, order)") == pytest.approx([0, 0, -0.5], abs=1e-14)
    assert value("fourier_sin(wave, phi_deg, 2.5)") == pytest.approx(-0.5)


def test_a_running_sum_takes_the_rows_down_to_its_own() -> None:
    assert np.asarray(value("running_sum(phi_deg)"))[:4] == pytest.approx([0, 10, 30, 60])


def test_formulas_leave_the_repeated_last_row_out() -> None:
    made = model()
    references = RowReferences(Layout.of(made), made.tables["torque_orders"])
    text = compile_formula("fourier_cos(tangential.t_gas_MPa, tangential.phi_deg, 1.5)", references)
    waves = "'Синусы и косинусы'!$D$6:$D$77"
    assert text == f"=2*SUMPRODUCT($B$6:$B$77,{waves})/COUNT($B$6:$B$77)"
    running = compile_formula("running_sum(tangential.t_gas_MPa)", references)
    assert at_row(running, 9) == "=SUM($B$6:B9)"


def test_each_row_sums_over_the_waves_of_its_order() -> None:
    made = model()
    references = RowReferences(Layout.of(made), made.tables["torque_orders"])
    sines = "fourier_sin(tangential.t_gas_MPa, tangential.phi_deg, order)"
    text = compile_formula(sines, references)
    assert "'Синусы и косинусы'!$R$6:$R$77)" in at_row(text, 6)
    assert "'Синусы и косинусы'!$AG$6:$AG$77)" in at_row(text, 21)


def test_sums_over_cylinders_take_the_waves_of_each_order() -> None:
    made = model()
    references = RowReferences(Layout.of(made), made.tables["torque_orders"])
    text = compile_formula(f"wave_sin({FIRING}, order)", references)
    first, second = at_row(text, 6), at_row(text, 7)
    assert first.startswith("=SUM('Синусы и косинусы'!$B$") and first != second
