"""Forces of a cylinder whose rod hangs on the master rod, Gots figure 2 в."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Column, TableSpec
from reports.spec.listing import column_list
from reports.spec.shape import TIMING, Shape
from reports.tables.gas.indicator import hung_corners
from reports.tables.gas.pressure import WORK, pressure
from reports.tables.motion.expressions import BANK, RHO, SOURCE, hung_helpers, hung_ratio


def hung_table(model: InputFile, rows: tuple[float, ...], number: int) -> TableSpec:
    """Forces of a cylinder whose rod hangs on the master rod."""
    shape = Shape.of(model)
    corners = hung_corners(shape)
    period, offset = shape.period, f"firing_offset_{number}_deg"
    timing = f"mod(phase_deg - phi_tdc_art_deg, {period}) + phi_tdc_art_deg"
    unit = "articulated_big_end_kg*omega**2"
    phi = "rad(phase_deg)"
    text, helpers = pressure(model, TIMING, "volume_ratio", corners)
    columns = [
        *column_list(f"""
            phi_deg
            phase_deg of phase{number}_deg every {period}
                = round(mod(phi_deg - {offset}, {period}), 9) | угол в цикле
            volume_ratio = {hung_ratio('y')} | {SOURCE}
            p_MPa = {text} | Гоц, 2.4
            Pg_MPa = p_MPa - gas_ambient_pressure_mpa | Гоц (33)
            Pj_MPa = to_MPa(articulated_reciprocating_kg*omega**2*y_2/F_piston) | Гоц (30)
            Ps_MPa = Pg_MPa + Pj_MPa | Гоц, 2.4
            N_MPa = Ps_MPa*tan(beta_rad) | Гоц (34)
            S_MPa = Ps_MPa/cos(beta_rad) | Гоц (35)
            T_MPa = to_x*cos({phi}) - to_y*sin({phi}) | статика шатунов
            K_MPa = -(to_x*sin({phi})) - to_y*cos({phi}) | статика шатунов
            M_Nm = of_MPa(T_MPa)*F_piston*r_crank | Гоц, 2.5
            Nadd_MPa = bend/(L_rod*cos(beta_master_rad)) | статика главного шатуна
            Mrod_Nm = of_MPa(bend)*F_piston | статика главного шатуна
        """),
        *hung_helpers(shape, "phase_deg"),
        Column(TIMING, timing, "угол от ВМТ", helper=True, of="phase_deg", every=f"{period}"),
        *helpers,
        _force("push_x", f"N_MPa - to_MPa({unit}*q_x2/F_piston)"),
        _force("push_y", f"-Ps_MPa - to_MPa({unit}*q_y2/F_piston)"),
        *column_list(f"""
            helpers:
            bend of hung_bend = {RHO}*(push_y*sin(chi_rad) - push_x*cos(chi_rad))
                | момент относительно шейки
        """),
        # The master piston's wall answers across the master cylinder, turned by the bank angle.
        _force("to_x", f"push_x + Nadd_MPa*cos({BANK})"),
        _force("to_y", f"push_y + Nadd_MPa*sin({BANK})"),
        *column_list(f"""
            helpers:
            volume_dm3 = V_c_art*volume_ratio | Гоц, 1.1
            work_J = {WORK} | ∫p dV
        """),
    ]  # fmt: skip
    return TableSpec(
        f"cylinder_{number}",
        f"Ц{number}",
        f"Силы в цилиндре {number} с прицепным шатуном",
        "Цилиндры",
        tuple(columns),
        rows,
        note=(
            "T и K цилиндра с прицепным шатуном — составляющие на шатунной шейке его силы вместе "
            "с боковой силой ΔN, которую она вызывает у поршня главного шатуна."
        ),
    )


def _force(key: str, text: str) -> Column:
    return Column(key, text, "статика шатунов", helper=True, of=f"hung_{key}")
