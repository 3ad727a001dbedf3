"""Articulated rods, Gots figure 2 в: motion, dead centres and forces from the geometry.

The book names these rods and gives no formulas.  The position of the articulated pin is
written in the frame of its own cylinder, velocities and accelerations follow link by link
(crank, master rod, articulated rod); forces by moments about the crankpin.
"""

from __future__ import annotations

from reports.spec.blocks import Column, Grid, GridRow, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, over_phi
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape

SHEET = "Прицепной шатун"
SUFFIX = "_art"
SOURCE = "геометрия, Гоц, рис. 2 в"
STEPS = 7  # Newton's method for the dead centres
BANK = "rad(crankshaft_bank_angle_deg)"
RHO, _LENGTH = "of_mm(articulated_radius_mm)", "of_mm(articulated_rod_length_mm)"


def _links(shape: Shape, phi: str, prefix: str = "", suffix: str = "") -> dict[str, str]:
    """Quantities of all links at an angle [deg]: key to expression, each from those before.

    Derivatives are by the crank angle; lengths in metres.  ``prefix`` and ``suffix`` make
    the names by which the expressions refer to each other.
    """

    def n(key: str) -> str:
        return f"{prefix}{key}{suffix}"

    alpha = f"(rad({phi}) + {BANK})"
    offset, k = ("e_offset", "k_offset") if shape.offset else ("0", "0")
    sine = f"(sin({alpha}) - {k})"
    root = f"(1 - lam**2*{sine}**2)"
    return {
        "beta_master_rad": f"asin(lam*{sine})",
        # (18) and (19) over ω and ω².
        "turn_1": f"lam*cos({alpha})/sqrt{root}",
        "turn_2": f"lam*(lam**2*cos({alpha})**2*{sine} - {root}*sin({alpha}))/{root}**1.5",
        "chi_rad": f"rad(articulated_angle_deg) - {BANK} - {n('beta_master_rad')}",
        "q_x": f"r_crank*sin(rad({phi})) + {RHO}*sin({n('chi_rad')})",
        "q_y": f"r_crank*cos(rad({phi})) + {RHO}*cos({n('chi_rad')})",
        "q_x1": f"r_crank*cos(rad({phi})) - {n('turn_1')}*{RHO}*cos({n('chi_rad')})",
        "q_y1": f"{n('turn_1')}*{RHO}*sin({n('chi_rad')}) - r_crank*sin(rad({phi}))",
        # Towards the crank axis, along the radius to the crankpin, across it.
        "q_x2": (
            f"-(r_crank*sin(rad({phi}))) - {RHO}*({n('turn_1')}**2*sin({n('chi_rad')})"
            f" + {n('turn_2')}*cos({n('chi_rad')}))"
        ),
        "q_y2": (
            f"-(r_crank*cos(rad({phi}))) - {RHO}*({n('turn_1')}**2*cos({n('chi_rad')})"
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


def hung_ratio(height: str) -> str:
    """V/V_c from the height of the piston pin [m]."""
    return f"1 + (geometry_compression_ratio - 1)*(y_tdc_art - ({height}))/S_art"


def hung_height(shape: Shape, phi: str) -> str:
    """Height of the piston pin over the shaft [m] in one expression."""
    alpha = f"(rad({phi}) + {BANK})"
    offset, k = ("e_offset", "k_offset") if shape.offset else ("0", "0")
    chi = f"(rad(articulated_angle_deg) - {BANK} - asin(lam*(sin({alpha}) - {k})))"
    across = f"(r_crank*sin(rad({phi})) + {RHO}*sin({chi}) - {offset})"
    return f"r_crank*cos(rad({phi})) + {RHO}*cos({chi}) + sqrt({_LENGTH}**2 - {across}**2)"


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


def hung_helpers(shape: Shape, phi: str, left_out: tuple[str, ...] = ()) -> list[Column]:
    """Columns of the linkage that the formulas of a table name."""
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
        *hung_helpers(shape, "phi_deg", tuple(shown)),
    ]
    return TableSpec(
        "articulated",
        "П.ш",
        "Движение прицепного шатуна и его поршня",
        SHEET,
        tuple(columns),
        turn,
        note=(
            "Двучленных формул для прицепного шатуна нет: при любом методе расчёта ускорение "
            "его поршня точное."
        ),
    )


def _charts() -> tuple[ChartSpec, ...]:
    """Motion of the articulated rod's piston, in the report alone."""
    of = "поршня прицепного шатуна"
    return (
        over_phi("articulated_s", "", f"Перемещение {of}", "s, мм", "articulated.x_exact_mm"),
        over_phi("articulated_j", "", f"Ускорение {of}", "j, м/с²", "articulated.j_exact_m_s2"),
    )
