"""The rounded diagram of the input in SI units."""

from __future__ import annotations

from kshm.engine.gas import RoundedGas
from reports.inputs.sections.gas import JOIN_DEG, PEAK_DEG, PEAK_SHARE, RoundedGasSection
from reports.inputs.units import DEG, MPA

BDC_DEG = 540.0
FIRING_TDC_DEG = 360.0


def rounded_gas(gas: RoundedGasSection) -> RoundedGas:
    """Rounded diagram with the usual places where the input gives none."""
    share, peak, join = places(gas)
    return RoundedGas(
        p_ambient=MPA.to_si(gas.ambient_pressure_mpa),
        p_intake=MPA.to_si(gas.intake_pressure_mpa),
        p_residual=MPA.to_si(gas.residual_pressure_mpa),
        p_max=MPA.to_si(gas.max_pressure_mpa),
        n_compression=float(gas.compression_exponent),
        n_expansion=float(gas.expansion_exponent),
        rho=float(gas.preexpansion_ratio),
        combustion_start=DEG.to_si(
            FIRING_TDC_DEG - gas.injection_advance_deg + gas.ignition_delay_deg
        ),
        tdc_rise=float(gas.tdc_rise),
        peak=DEG.to_si(FIRING_TDC_DEG + peak),
        peak_share=share,
        join=DEG.to_si(FIRING_TDC_DEG + join),
        exhaust_open=DEG.to_si(BDC_DEG - gas.exhaust_start_before_bdc_deg),
        exhaust_close=DEG.to_si(BDC_DEG + gas.exhaust_end_after_bdc_deg),
        settle=DEG.to_si(gas.intake_settle_deg),
    )


def places(gas: RoundedGasSection) -> tuple[float, float, float]:
    """Share p_zд/p_z, angles of z_д and of the join after TDC [deg]."""
    share, peak, join = gas.peak_share, gas.peak_after_tdc_deg, gas.expansion_after_tdc_deg
    return (
        PEAK_SHARE[gas.kind] if share is None else float(share),
        PEAK_DEG[gas.kind] if peak is None else float(peak),
        JOIN_DEG[gas.kind] if join is None else float(join),
    )
