"""Gas pressure and forces of each cylinder: the gas sheet, П4.1 and its shifted copies."""

from __future__ import annotations

from reports.inputs.model import InputFile, TableGasSection
from reports.inputs.model_gas import RoundedGasSection
from reports.tables.cycle_names import from_cycle
from reports.tables.diagram import diagram_blocks, is_smooth, rounded_pressure, smooth_pressure
from reports.tables.mechanism import acceleration
from reports.tables.spec import Block, Column, Scalar, ScalarTable, TableSpec

EDGE = "0.0000001"  # degrees: the angles come from whole degrees and sums of them


def gas_scalars(model: InputFile) -> tuple[ScalarTable, ...]:
    """Corner points of the polytropic diagram; none for a table of points."""
    if isinstance(model.gas, TableGasSection | RoundedGasSection):
        return ()
    start = (
        "gas_combustion_start_deg"
        if model.gas.combustion_start_deg is not None
        else "360 - gas_injection_advance_deg + gas_ignition_delay_deg"
    )
    return (
        ScalarTable(
            "gas_points",
            "Характерные точки индикаторной диаграммы",
            "Газы",
            (
                Scalar("phi_c_deg", start, "Dinn: 360° − УОВ + УЗВ"),
                Scalar("phi_open_deg", "540 - gas_exhaust_start_before_bdc_deg", "Dinn"),
                Scalar("phi_close_deg", "540 + gas_exhaust_end_after_bdc_deg", "Dinn"),
                Scalar("x_start", volume_ratio("phi_c_deg"), "Гоц (1)"),
                Scalar(
                    "p_start",
                    from_cycle(
                        model,
                        "gas_intake_pressure_mpa"
                        "*(geometry_compression_ratio/x_start)**gas_compression_exponent",
                    ),
                    "политропа сжатия",
                ),
                Scalar(
                    "p_c_end",
                    from_cycle(
                        model,
                        "gas_intake_pressure_mpa"
                        "*geometry_compression_ratio**gas_compression_exponent",
                    ),
                    "политропа сжатия",
                ),
                Scalar("x_open", volume_ratio("phi_open_deg"), "Гоц (1)"),
                Scalar(
                    "p_open",
                    from_cycle(
                        model,
                        "gas_max_pressure_mpa"
                        "*min(1, (gas_preexpansion_ratio/x_open)**gas_expansion_exponent)",
                    ),
                    "политропа расширения",
                ),
            ),
        ),
    )


def volume_ratio(phi: str) -> str:
    """V/V_c from the exact displacement, Gots (1)."""
    return (
        f"1 + (geometry_compression_ratio - 1)/2*((1 - cos(rad({phi})))"
        f" + (1 - sqrt(1 - lam**2*sin(rad({phi}))**2))/lam)"
    )


def pressure(model: InputFile, phi: str, ratio: str) -> str:
    """Absolute gas pressure [MPa] at the angle and volume ratio of the named columns."""
    if isinstance(model.gas, RoundedGasSection):
        return rounded_pressure(phi, ratio)
    if is_smooth(model):
        return smooth_pressure(phi)
    if isinstance(model.gas, TableGasSection):
        return f"interpolate({phi}, gas_points_deg, gas_points_mpa)"
    eps, rho = "geometry_compression_ratio", "gas_preexpansion_ratio"
    p_z, p_r = "gas_max_pressure_mpa", "gas_residual_pressure_mpa"
    compression = f"gas_intake_pressure_mpa*({eps}/{ratio})**gas_compression_exponent"
    rise = f"min({p_z}, p_start + ({p_z} - p_start)*({phi} - phi_c_deg)/gas_injection_advance_deg)"
    expansion = f"{p_z}*min(1, ({rho}/{ratio})**gas_expansion_exponent)"
    release = f"p_open + ({p_r} - p_open)*({phi} - phi_open_deg)/(phi_close_deg - phi_open_deg)"
    steps = [
        ("0", p_r),
        ("180", "gas_intake_pressure_mpa"),
        ("phi_c_deg", compression),
        ("360", rise),
        ("phi_open_deg", expansion),
        ("phi_close_deg", release),
    ]
    text = p_r
    for limit, value in reversed(steps):
        text = f"({value}) if {phi} <= {limit} + {EDGE} else ({text})"
    return from_cycle(model, text)


def gas_table(model: InputFile, rows: tuple[float, ...]) -> TableSpec:
    """The indicator diagram of cylinder 1 over φ and over the volume."""
    displacement = (
        "to_mm(r_crank*((1 - cos(rad(phi_deg))) + (1 - sqrt(1 - lam**2*sin(rad(phi_deg))**2))/lam))"
    )
    work = "(p_MPa + following(p_MPa))/2*(following(volume_dm3) - volume_dm3)*1000"
    return TableSpec(
        "gas",
        "Г",
        "Индикаторная диаграмма",
        "Газы",
        (
            Column("phi_deg", None),
            Column("x_exact_mm", displacement, "Гоц (1)"),
            Column("volume_ratio", volume_ratio("phi_deg"), "Гоц (1)"),
            Column("volume_dm3", "V_c*volume_ratio", "Гоц, 1.1"),
            Column("p_MPa", pressure(model, "phi_deg", "volume_ratio"), "Гоц, 2.4"),
            Column("work_J", work, "∫p dV", helper=True),
        ),
        rows,
    )


def forces_table(model: InputFile, rows: tuple[float, ...]) -> TableSpec:
    """Table П4.1: specific forces and torque of cylinder 1."""
    return TableSpec(
        "P4_1",
        "П4.1",
        "Удельные силы и крутящий момент, действующие в КШМ одного цилиндра",
        "П4.1",
        (
            Column("phi_deg", None),
            Column("Pg_MPa", "gas.p_MPa - gas_ambient_pressure_mpa", "Гоц (33)"),
            *_chain("phi_deg"),
            Column("beta_rad", "asin(lam*sin(rad(phi_deg)))", "Гоц (7)", helper=True),
            Column(
                "j_m_s2",
                acceleration(model, "phi_deg", "beta_rad"),
                "Гоц (6) или точно",
                helper=True,
            ),
            Column("Mopr_Nm", "-M_Nm", "Гоц (39)", helper=True),
        ),
        rows,
    )


def shifted_table(
    model: InputFile, rows: tuple[float, ...], number: int, *, forced: bool = False
) -> TableSpec:
    """Forces of cylinder ``number`` at its own angle in the cycle, over the angle of the shaft.

    ``forced`` takes the phases that reproduce the printed П4.3.
    """
    offset = f"force_offset_{number}_deg" if forced else f"firing_offset_{number}_deg"
    return TableSpec(
        f"forced_{number}" if forced else f"cylinder_{number}",
        f"Ц{number}",
        f"Силы в цилиндре {number}" + (" в заданных фазах" if forced else ""),
        "Фазы П4.3" if forced else "Цилиндры",
        (
            Column("phi_deg", None),
            Column(
                "phase_deg",
                f"mod(phi_deg - {offset}, 720)",
                "угол в цикле",
                of=f"phase{number}_deg",
            ),
            Column("volume_ratio", volume_ratio("phase_deg"), "Гоц (1)"),
            Column("p_MPa", pressure(model, "phase_deg", "volume_ratio"), "Гоц, 2.4"),
            Column("Pg_MPa", "p_MPa - gas_ambient_pressure_mpa", "Гоц (33)"),
            *_chain("phase_deg"),
            Column("beta_rad", "asin(lam*sin(rad(phase_deg)))", "Гоц (7)", helper=True),
            Column(
                "j_m_s2",
                acceleration(model, "phase_deg", "beta_rad"),
                "Гоц (6) или точно",
                helper=True,
            ),
        ),
        rows,
        helper=forced,
    )


def _chain(phi: str) -> tuple[Column, ...]:
    return (
        Column("Pj_MPa", "to_MPa(-(m_j*j_m_s2)/F_piston)", "Гоц (30)"),
        Column("Ps_MPa", "Pg_MPa + Pj_MPa", "Гоц, 2.4"),
        Column("N_MPa", "Ps_MPa*tan(beta_rad)", "Гоц (34)"),
        Column("S_MPa", "Ps_MPa/cos(beta_rad)", "Гоц (35)"),
        Column("T_MPa", f"Ps_MPa*sin(rad({phi}) + beta_rad)/cos(beta_rad)", "Гоц (37)"),
        Column("K_MPa", f"Ps_MPa*cos(rad({phi}) + beta_rad)/cos(beta_rad)", "Гоц (36)"),
        Column("M_Nm", "of_MPa(T_MPa)*F_piston*r_crank", "Гоц, 2.5"),
    )


def cylinder_table_id(number: int) -> str:
    """Id of the table with the forces of a cylinder."""
    return "P4_1" if number == 1 else f"cylinder_{number}"


def cylinder_blocks(model: InputFile, rows: tuple[float, ...]) -> tuple[Block, ...]:
    """Gas, П4.1 and the forces of all other cylinders."""
    count = model.engine.cylinders
    blocks: list[Block] = [
        *gas_scalars(model),
        *diagram_blocks(model),
        gas_table(model, rows),
        forces_table(model, rows),
    ]
    blocks += [shifted_table(model, rows, i) for i in range(2, count + 1)]
    if model.crankshaft.force_offsets_deg is not None:
        blocks += [shifted_table(model, rows, i, forced=True) for i in range(1, count + 1)]
    return tuple(blocks)
