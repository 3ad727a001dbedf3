"""Gas pressure and forces of each cylinder: the gas sheet, П4.1 and its shifted copies."""

from __future__ import annotations

from reports.inputs.sections.gas import RoundedGasSection
from reports.inputs.sections.input_file import InputFile, TableGasSection
from reports.spec.blocks import Block, Column, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, columns_of, line, over_phi
from reports.spec.shape import TIMING, Shape
from reports.tables.gas.diagram import diagram_blocks
from reports.tables.gas.pressure import WORK, Corners, corner_points, pressure
from reports.tables.motion.articulated import hung_blocks, hung_corners, hung_table
from reports.tables.motion.mechanism import acceleration


def gas_scalars(model: InputFile) -> tuple[ScalarTable, ...]:
    """Corner points of the polytropic diagram; none for a table of points."""
    if isinstance(model.gas, TableGasSection | RoundedGasSection):
        return ()
    shape = Shape.of(model)
    own = Corners(shape, shape.volume_ratio, shape.tdc, shape.bdc)
    tables = [corner_points(model, own)]
    if shape.articulated:
        tables.append(corner_points(model, hung_corners(shape)))
    return tuple(tables)


def gas_table(model: InputFile, rows: tuple[float, ...]) -> TableSpec:
    """The indicator diagram of cylinder 1 over φ and over the volume."""
    shape = Shape.of(model)
    columns = [
        Column("phi_deg", None),
        Column("x_exact_mm", f"to_mm(r_crank*{shape.displacement('phi_deg')})", displaced(shape)),
        Column("volume_ratio", shape.volume_ratio("phi_deg"), displaced(shape)),
        Column("volume_dm3", "V_c*volume_ratio", "Гоц, 1.1"),
        Column("p_MPa", _own_pressure(model, shape, "phi_deg"), "Гоц, 2.4"),
        Column("work_J", WORK, "∫p dV", helper=True),
        *_timing(model, shape, "phi_deg"),
    ]
    return TableSpec("gas", "Г", "Индикаторная диаграмма", "Газы", tuple(columns), rows)


def displaced(shape: Shape) -> str:
    """Source of the exact displacement."""
    return "Гоц (12)" if shape.offset else "Гоц (1)"


def _timing(model: InputFile, shape: Shape, phi: str) -> tuple[Column, ...]:
    """With an offset the angle from the piston's own TDC decides what the gas does."""
    if not _is_timed(model, shape):
        return ()
    angle = f"mod({phi} - phi_tdc_deg, {shape.period}) + phi_tdc_deg"
    return (Column(TIMING, angle, "угол от действительной ВМТ", helper=True, of="phase_deg"),)


def _is_timed(model: InputFile, shape: Shape) -> bool:
    return shape.offset and not isinstance(model.gas, TableGasSection)


def _own_pressure(model: InputFile, shape: Shape, phi: str) -> str:
    corners = Corners(shape, shape.volume_ratio, shape.tdc, shape.bdc)
    return pressure(model, TIMING if _is_timed(model, shape) else phi, "volume_ratio", corners)


def forces_table(model: InputFile, rows: tuple[float, ...]) -> TableSpec:
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
            Column("phi_deg", None),
            Column("Pg_MPa", "gas.p_MPa - gas_ambient_pressure_mpa", "Гоц (33)"),
            *_chain("phi_deg"),
            Column("beta_rad", shape.beta("phi_deg"), "Гоц (7), (17)", helper=True),
            Column(
                "j_m_s2",
                acceleration(model, "phi_deg", "beta_rad"),
                "Гоц (6) или точно",
                helper=True,
            ),
            Column("Mopr_Nm", overturning, "Гоц (39)", helper=True),
        ),
        rows,
    )


def shifted_table(
    model: InputFile, rows: tuple[float, ...], number: int, *, forced: bool = False
) -> TableSpec:
    """Forces of cylinder ``number`` at its own angle in the cycle, over the angle of the shaft.

    ``forced`` takes the phases that reproduce the printed П4.3.
    """
    shape = Shape.of(model)
    if shape.is_hung(number):
        return hung_table(model, rows, number)
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
                f"mod(phi_deg - {offset}, {shape.period})",
                "угол в цикле",
                of=f"phase{number}_deg",
            ),
            Column("volume_ratio", shape.volume_ratio("phase_deg"), displaced(shape)),
            Column("p_MPa", _own_pressure(model, shape, "phase_deg"), "Гоц, 2.4"),
            Column("Pg_MPa", "p_MPa - gas_ambient_pressure_mpa", "Гоц (33)"),
            *_chain("phase_deg"),
            Column("beta_rad", shape.beta("phase_deg"), "Гоц (7), (17)", helper=True),
            Column(
                "j_m_s2",
                acceleration(model, "phase_deg", "beta_rad"),
                "Гоц (6) или точно",
                helper=True,
            ),
            *_timing(model, shape, "phase_deg"),
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
        *(hung_blocks(model, rows) if Shape.of(model).articulated else ()),
        *gas_scalars(model),
        *diagram_blocks(model),
        gas_table(model, rows),
        forces_table(model, rows),
    ]
    blocks += [shifted_table(model, rows, i) for i in range(2, count + 1)]
    if model.crankshaft.force_offsets_deg is not None:
        blocks += [shifted_table(model, rows, i, forced=True) for i in range(1, count + 1)]
    return tuple(blocks)


def cylinder_charts() -> tuple[ChartSpec, ...]:
    """Indicator diagram, figure 22, and forces of a cylinder, figures 46-48."""
    ambient = ("gas_ambient_pressure_mpa",)
    return (
        line("pv", "Газы", "Индикаторная диаграмма p–V", ("V, дм³", "p, МПа"),
             Series("gas.volume_dm3", "gas.p_MPa", "p"), figure="22", levels=ambient,
             caption="Индикаторная диаграмма в координатах p–V"),
        over_phi("p_phi", "Газы", "Развёрнутая индикаторная диаграмма", "p, МПа", "gas.p_MPa",
                 figure="22", levels=ambient,
                 caption="Индикаторная диаграмма, развёрнутая по углу поворота вала"),
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
