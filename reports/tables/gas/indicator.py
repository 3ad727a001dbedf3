"""Indicator diagram: the gas sheet with its corner points, figure 22."""

from __future__ import annotations

from reports.inputs.sections.gas import RoundedGasSection, TableGasSection
from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Column, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, line, over_phi
from reports.spec.listing import column_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import TIMING, Shape
from reports.tables.gas.diagram import diagram_blocks
from reports.tables.gas.pressure import WORK, Corners, corner_points, pressure
from reports.tables.motion.expressions import SUFFIX, hung_height, hung_ratio


def indicator(scope: Scope) -> Part:
    """Pressure of cylinder 1 over angle and volume."""
    model = scope.input
    blocks = *_corner_points(model), *diagram_blocks(model), _table(model, scope.cycle)
    return Part(blocks, _charts())


def _corner_points(model: InputFile) -> tuple[ScalarTable, ...]:
    """Corner points of the polytropic diagram; none for a table of points."""
    if isinstance(model.gas, TableGasSection | RoundedGasSection):
        return ()
    shape = Shape.of(model)
    own = Corners(shape, shape.volume_ratio, shape.tdc, shape.bdc)
    tables = [corner_points(model, own)]
    if shape.articulated:
        tables.append(corner_points(model, hung_corners(shape)))
    return tuple(tables)


def hung_corners(shape: Shape) -> Corners:
    """Volume and dead centres of the cylinders with articulated rods."""
    return Corners(
        shape, lambda phi: hung_ratio(hung_height(shape, phi)),
        "phi_tdc_art_deg", "phi_bdc_art_deg", SUFFIX,
    )  # fmt: skip


def _table(model: InputFile, rows: tuple[float, ...]) -> TableSpec:
    """The indicator diagram of cylinder 1 over φ and over the volume."""
    shape = Shape.of(model)
    text, helpers = own_pressure(model, shape, "phi_deg")
    columns = [
        *column_list(f"""
            phi_deg
            x_exact_mm = to_mm(r_crank*{shape.displacement("phi_deg")}) | {displaced(shape)}
            volume_ratio = {shape.volume_ratio("phi_deg")} | {displaced(shape)}
            volume_dm3 = V_c*volume_ratio | Гоц, 1.1
            p_MPa = {text} | Гоц, 2.4
            helpers:
            work_J = {WORK} | ∫p dV
        """),
        *timing(model, shape, "phi_deg"),
        *helpers,
    ]
    return TableSpec("gas", "Г", "Индикаторная диаграмма", "Газы", tuple(columns), rows)


def displaced(shape: Shape) -> str:
    """Source of the exact displacement."""
    return "Гоц (12)" if shape.offset else "Гоц (1)"


def timing(model: InputFile, shape: Shape, phi: str) -> tuple[Column, ...]:
    """With an offset the angle from the piston's own TDC decides what the gas does."""
    if not _is_timed(model, shape):
        return ()
    angle = f"mod({phi} - phi_tdc_deg, {shape.period}) + phi_tdc_deg"
    return (Column(TIMING, angle, "угол от действительной ВМТ", helper=True, of="phase_deg",
                   every=f"{shape.period}"),)  # fmt: skip


def _is_timed(model: InputFile, shape: Shape) -> bool:
    return shape.offset and not isinstance(model.gas, TableGasSection)


def own_pressure(model: InputFile, shape: Shape, phi: str) -> tuple[str, tuple[Column, ...]]:
    """Pressure [MPa] of a cylinder with a rod of its own at an angle, and its helper columns."""
    corners = Corners(shape, shape.volume_ratio, shape.tdc, shape.bdc)
    return pressure(model, TIMING if _is_timed(model, shape) else phi, "volume_ratio", corners)


def _charts() -> tuple[ChartSpec, ...]:
    ambient = ("gas_ambient_pressure_mpa",)
    return (
        line("pv", "Газы", "Индикаторная диаграмма p–V", ("V, дм³", "p, МПа"),
             Series("gas.volume_dm3", "gas.p_MPa", "p"), figure="22", levels=ambient,
             caption="Индикаторная диаграмма в координатах p–V"),
        over_phi("p_phi", "Газы", "Развёрнутая индикаторная диаграмма", "p, МПа", "gas.p_MPa",
                 figure="22", levels=ambient,
                 caption="Индикаторная диаграмма, развёрнутая по углу поворота вала"),
    )  # fmt: skip
