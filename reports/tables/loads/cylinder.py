"""Forces of each cylinder: П4.1 and its shifted copies."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Column, TableSpec
from reports.spec.charts import ChartSpec, columns_of, over_phi
from reports.spec.listing import column_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape
from reports.tables.gas.indicator import displaced, own_pressure, timing
from reports.tables.loads.hung import hung_table
from reports.tables.motion.expressions import acceleration


def _forces(model: InputFile, rows: tuple[float, ...]) -> TableSpec:
    """Table П4.1: specific forces and torque of cylinder 1."""
    shape = Shape.of(model)
    # With an offset the block also feels the inertia force on that arm (readings, 11).
    overturning = "e_offset*of_MPa(Pj_MPa)*F_piston - M_Nm" if shape.offset else "-M_Nm"
    return TableSpec(
        "P4_1",
        "П4.1",
        "Удельные силы и крутящий момент, действующие в КШМ одного цилиндра",
        "П4.1",
        (
            *column_list("""
                phi_deg
                Pg_MPa = gas.p_MPa - gas_ambient_pressure_mpa | Гоц (33)
            """),
            *_chain(model, shape, "phi_deg"),
            Column("Mopr_Nm", overturning, "Гоц (39)", helper=True),
        ),
        rows,
    )


def _shifted(
    model: InputFile, rows: tuple[float, ...], number: int, *, forced: bool = False
) -> TableSpec:
    """Forces of cylinder ``number`` at its own angle in the cycle, over the angle of the shaft.

    ``forced`` takes the phases that reproduce the printed П4.3.
    """
    shape = Shape.of(model)
    if shape.is_hung(number):
        return hung_table(model, rows, number)
    offset = f"force_offset_{number}_deg" if forced else f"firing_offset_{number}_deg"
    text, helpers = own_pressure(model, shape, "phase_deg")
    return TableSpec(
        f"forced_{number}" if forced else f"cylinder_{number}",
        f"Ц{number}",
        f"Силы в цилиндре {number}" + (" в заданных фазах" if forced else ""),
        "Фазы П4.3" if forced else "Цилиндры",
        (
            *column_list(f"""
                phi_deg
                phase_deg of phase{number}_deg every {shape.period}
                    = round(mod(phi_deg - {offset}, {shape.period}), 9) | угол в цикле
                volume_ratio = {shape.volume_ratio("phase_deg")} | {displaced(shape)}
                p_MPa = {text} | Гоц, 2.4
                Pg_MPa = p_MPa - gas_ambient_pressure_mpa | Гоц (33)
            """),
            *_chain(model, shape, "phase_deg"),
            *timing(model, shape, "phase_deg"),
            *helpers,
        ),
        rows,
        helper=forced,
    )


def _chain(model: InputFile, shape: Shape, phi: str) -> tuple[Column, ...]:
    return column_list(f"""
        Pj_MPa = to_MPa(-(m_j*j_m_s2)/F_piston) | Гоц (30)
        Ps_MPa = Pg_MPa + Pj_MPa | Гоц, 2.4
        N_MPa = Ps_MPa*tan(beta_rad) | Гоц (34)
        S_MPa = Ps_MPa/cos(beta_rad) | Гоц (35)
        T_MPa = Ps_MPa*sin(rad({phi}) + beta_rad)/cos(beta_rad) | Гоц (37)
        K_MPa = Ps_MPa*cos(rad({phi}) + beta_rad)/cos(beta_rad) | Гоц (36)
        M_Nm = of_MPa(T_MPa)*F_piston*r_crank | Гоц, 2.5
        helpers:
        beta_rad = {shape.beta(phi)} | Гоц (7), (17)
        j_m_s2 = {acceleration(model, phi, "beta_rad")} | Гоц (6) или точно
    """)


def cylinders(scope: Scope) -> Part:
    """П4.1 and the forces of all other cylinders, figures 46-48."""
    model, rows, count = scope.input, scope.cycle, scope.shape.cylinders
    blocks = [_forces(model, rows)]
    blocks += [_shifted(model, rows, i) for i in range(2, count + 1)]
    if scope.forced:
        blocks += [_shifted(model, rows, i, forced=True) for i in range(1, count + 1)]
    return Part(tuple(blocks), _charts())


def _charts() -> tuple[ChartSpec, ...]:
    return (
        over_phi("fig46", "П4.1", "Удельные силы p′г, p′j и p′s", "p′, МПа",
                 *columns_of("P4_1", "Pg_MPa", "Pj_MPa", "Ps_MPa"), figure="46",
                 caption="Удельные силы давления газов, инерции и их сумма"),
        over_phi("fig47", "П4.1", "Удельные силы N и S", "МПа",
                 *columns_of("P4_1", "N_MPa", "S_MPa"), figure="47",
                 caption="Удельные силы на стенку цилиндра и вдоль шатуна"),
        over_phi("fig48", "П4.1", "Удельные силы K и T", "МПа",
                 *columns_of("P4_1", "K_MPa", "T_MPa"), figure="48",
                 caption="Удельные нормальная и тангенциальная силы на кривошипе"),
    )  # fmt: skip
