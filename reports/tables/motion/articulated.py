"""Articulated rods, Gots figure 2 в: motion, dead centres and forces from the geometry.

The book names these rods and gives no formulas.  The position of the articulated pin is
written in the frame of its own cylinder, velocities and accelerations follow link by link
(crank, master rod, articulated rod); forces by moments about the crankpin.
"""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Column, Grid, GridRow, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, over_phi
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import TIMING, Shape
from reports.tables.gas.pressure import WORK, Corners, pressure

SHEET = "Прицепной шатун"
SUFFIX = "_art"
SOURCE = "геометрия, Гоц, рис. 2 в"
STEPS = 7  # Newton's method for the dead centres
_BANK = "rad(crankshaft_bank_angle_deg)"
_RHO, _LENGTH = "of_mm(articulated_radius_mm)", "of_mm(articulated_rod_length_mm)"


def _links(shape: Shape, phi: str, prefix: str = "", suffix: str = "") -> dict[str, str]:
    """Quantities of all links at an angle [deg]: key to expression, each from those before.

    Derivatives are by the crank angle; lengths in metres.  ``prefix`` and ``suffix`` make
    the names by which the expressions refer to each other.
    """

    def n(key: str) -> str:
        return f"{prefix}{key}{suffix}"

    alpha = f"(rad({phi}) + {_BANK})"
    offset, k = ("e_offset", "k_offset") if shape.offset else ("0", "0")
    sine = f"(sin({alpha}) - {k})"
    root = f"(1 - lam**2*{sine}**2)"
    return {
        "beta_master_rad": f"asin(lam*{sine})",
        # (18) and (19) over ω and ω².
        "turn_1": f"lam*cos({alpha})/sqrt{root}",
        "turn_2": f"lam*(lam**2*cos({alpha})**2*{sine} - {root}*sin({alpha}))/{root}**1.5",
        "chi_rad": f"rad(articulated_angle_deg) - {_BANK} - {n('beta_master_rad')}",
        "q_x": f"r_crank*sin(rad({phi})) + {_RHO}*sin({n('chi_rad')})",
        "q_y": f"r_crank*cos(rad({phi})) + {_RHO}*cos({n('chi_rad')})",
        "q_x1": f"r_crank*cos(rad({phi})) - {n('turn_1')}*{_RHO}*cos({n('chi_rad')})",
        "q_y1": f"{n('turn_1')}*{_RHO}*sin({n('chi_rad')}) - r_crank*sin(rad({phi}))",
        # Towards the crank axis, along the radius to the crankpin, across it.
        "q_x2": (
            f"-(r_crank*sin(rad({phi}))) - {_RHO}*({n('turn_1')}**2*sin({n('chi_rad')})"
            f" + {n('turn_2')}*cos({n('chi_rad')}))"
        ),
        "q_y2": (
            f"-(r_crank*cos(rad({phi}))) - {_RHO}*({n('turn_1')}**2*cos({n('chi_rad')})"
            f" - {n('turn_2')}*sin({n('chi_rad')}))"
        ),
        "beta_rad": f"asin(({n('q_x')} - {offset})/{_LENGTH})",
        "own_1": f"{n('q_x1')}/({_LENGTH}*cos({n('beta_rad')}))",
        "own_2": (
            f"({n('q_x2')}/{_LENGTH} + sin({n('beta_rad')})*{n('own_1')}**2)/cos({n('beta_rad')})"
        ),
        "y": f"{n('q_y')} + {_LENGTH}*cos({n('beta_rad')})",
        "y_1": f"{n('q_y1')} - {_LENGTH}*sin({n('beta_rad')})*{n('own_1')}",
        "y_2": (
            f"{n('q_y2')} - {_LENGTH}*(cos({n('beta_rad')})*{n('own_1')}**2"
            f" + sin({n('beta_rad')})*{n('own_2')})"
        ),
    }


def hung_corners(shape: Shape) -> Corners:
    """Volume and dead centres of the cylinders with articulated rods."""
    return Corners(
        shape, lambda phi: _ratio(_height(shape, phi)),
        "phi_tdc_art_deg", "phi_bdc_art_deg", SUFFIX,
    )  # fmt: skip


def _ratio(height: str) -> str:
    return f"1 + (geometry_compression_ratio - 1)*(y_tdc_art - ({height}))/S_art"


def _height(shape: Shape, phi: str) -> str:
    """Height of the piston pin over the shaft [m] in one expression."""
    alpha = f"(rad({phi}) + {_BANK})"
    offset, k = ("e_offset", "k_offset") if shape.offset else ("0", "0")
    chi = f"(rad(articulated_angle_deg) - {_BANK} - asin(lam*(sin({alpha}) - {k})))"
    across = f"(r_crank*sin(rad({phi})) + {_RHO}*sin({chi}) - {offset})"
    return f"r_crank*cos(rad({phi})) + {_RHO}*cos({chi}) + sqrt({_LENGTH}**2 - {across}**2)"


def articulated(scope: Scope) -> Part:
    """Dead centres, volumes and motion of the articulated rod."""
    shape = scope.shape
    if not shape.articulated:
        return Part()
    return Part((_centres(shape), _sizes(), _motion(shape, scope.turn)), _charts())


def _centres(shape: Shape) -> Grid:
    """TDC and BDC by Newton's method from 0 and 180°: where the piston's speed vanishes."""
    rows: dict[str, list[Scalar]] = {}
    ends = (("tdc", "0"), ("bdc", "180"))
    for end, start in ends:
        for step in range(STEPS):
            prefix, last = f"hung_{end}_", f"_{step}"
            before = f"_{step - 1}"
            angle = (
                f"{prefix}phi{before} - deg({prefix}y_1{before}/{prefix}y_2{before})"
                if step
                else start
            )
            values = {"phi": angle, **_links(shape, f"{prefix}phi{last}", prefix, last)}
            for key, text in values.items():
                cell = Scalar(f"{prefix}{key}{last}", text, SOURCE, of=f"hung_{key}")
                rows.setdefault(key, []).append(cell)
    labels = tuple(f"{word} {step}" for word in ("ВМТ", "НМТ") for step in range(STEPS))
    return Grid(
        "hung_centres",
        "Мёртвые точки поршня с прицепным шатуном: приближения по методу Ньютона",
        SHEET,
        labels,
        tuple(GridRow(f"hung_{key}", tuple(cells)) for key, cells in rows.items()),
        note=(
            "Углы φ отсчитаны от положения кривошипа вдоль оси правого цилиндра; штрихи — "
            "производные по углу поворота вала, длины в метрах."
        ),
    )


def _sizes() -> ScalarTable:
    last = STEPS - 1
    return ScalarTable(
        "articulated_sizes",
        "Ход и объёмы цилиндра с прицепным шатуном",
        "Массы",
        scalar_list(f"""
            phi_tdc_art_deg = hung_tdc_phi_{last} | {SOURCE}
            phi_bdc_art_deg = hung_bdc_phi_{last} | {SOURCE}
            y_tdc_art = hung_tdc_y_{last} | {SOURCE}
            S_art = y_tdc_art - hung_bdc_y_{last} | {SOURCE}
            V_h_art = to_dm3(F_piston*S_art) | Гоц, введение
            V_c_art = V_h_art/(geometry_compression_ratio - 1) | Гоц, введение
        """),
    )


def _helpers(shape: Shape, phi: str, left_out: tuple[str, ...] = ()) -> list[Column]:
    return [
        Column(key, text, SOURCE, helper=True, of=key if key.endswith("rad") else f"hung_{key}")
        for key, text in _links(shape, phi).items()
        if key not in left_out
    ]


def _motion(shape: Shape, turn: tuple[float, ...]) -> TableSpec:
    shown = {"beta_master_rad", "beta_rad"}
    links = _links(shape, "phi_deg")
    columns = [
        *column_list(f"""
            phi_deg
            beta_master_rad = {links["beta_master_rad"]} | Гоц (13), (17)
            across_mm = to_mm(q_x) | {SOURCE}
            along_mm = to_mm(q_y) | {SOURCE}
            beta_rad = {links["beta_rad"]} | {SOURCE}
            x_exact_mm = to_mm(y_tdc_art - y) | {SOURCE}
            v_exact_m_s = -(omega*y_1) | {SOURCE}
            j_exact_m_s2 = -(omega**2*y_2) | {SOURCE}
        """),
        *_helpers(shape, "phi_deg", tuple(shown)),
    ]
    return TableSpec(
        "articulated",
        "П.ш",
        "Движение прицепного шатуна и его поршня",
        SHEET,
        tuple(columns),
        turn,
        note=(
            "Двучленных формул для прицепного шатуна нет: при любом методе расчета ускорение "
            "его поршня точное."
        ),
    )


def hung_table(model: InputFile, rows: tuple[float, ...], number: int) -> TableSpec:
    """Forces of a cylinder whose rod hangs on the master rod."""
    shape = Shape.of(model)
    corners = hung_corners(shape)
    period = shape.period
    timing = f"mod(phase_deg - phi_tdc_art_deg, {period}) + phi_tdc_art_deg"
    unit = "articulated_big_end_kg*omega**2"
    phi = "rad(phase_deg)"
    columns = [
        *column_list(f"""
            phi_deg
            phase_deg of phase{number}_deg = mod(phi_deg - firing_offset_{number}_deg, {period})
                | угол в цикле
            volume_ratio = {_ratio('y')} | {SOURCE}
            p_MPa = {pressure(model, TIMING, 'volume_ratio', corners)} | Гоц, 2.4
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
        *_helpers(shape, "phase_deg"),
        Column(TIMING, timing, "угол от ВМТ", helper=True, of="phase_deg"),
        _force("push_x", f"N_MPa - to_MPa({unit}*q_x2/F_piston)"),
        _force("push_y", f"-Ps_MPa - to_MPa({unit}*q_y2/F_piston)"),
        *column_list(f"""
            helpers:
            bend of hung_bend = {_RHO}*(push_y*sin(chi_rad) - push_x*cos(chi_rad))
                | момент относительно шейки
        """),
        # The master piston's wall answers across the master cylinder, turned by the bank angle.
        _force("to_x", f"push_x + Nadd_MPa*cos({_BANK})"),
        _force("to_y", f"push_y + Nadd_MPa*sin({_BANK})"),
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


def _charts() -> tuple[ChartSpec, ...]:
    """Motion of the articulated rod's piston, in the report alone."""
    of = "поршня прицепного шатуна"
    return (
        over_phi("articulated_s", "", f"Перемещение {of}", "s, мм", "articulated.x_exact_mm"),
        over_phi("articulated_j", "", f"Ускорение {of}", "j, м/с²", "articulated.j_exact_m_s2"),
    )
