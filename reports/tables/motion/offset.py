"""Offset mechanism: П3.1 and П3.2 by (13)-(19a), exact motion, figures 11 and 12, Gots 1.4."""

from __future__ import annotations

from reports.spec.blocks import Grid, GridRow, Scalar, TableSpec
from reports.spec.charts import ChartSpec, Series, over_phi
from reports.spec.listing import column_list
from reports.spec.parts import Part, Scope
from reports.tables.motion.mechanism import kinematic_charts

SHEET = "Дезаксиал"
_PHI = "rad(phi_deg)"
_ROOT = f"sqrt(1 - lam**2*(sin({_PHI}) - k_offset)**2)"
_SKETCH_DEG = "60"  # position of the crank in the drawing


def offset(scope: Scope) -> Part:
    """П3.1 and П3.2 of an offset mechanism, the exact motion beside them."""
    if not scope.shape.offset:
        return Part()
    rows = scope.turn
    return Part(
        (_piston(rows), _rod(rows), _exact(rows), _sketch()),
        (*kinematic_charts(scope.shape), *_charts()),
    )


def _piston(rows: tuple[float, ...]) -> TableSpec:
    top = "sqrt((1/lam + 1)**2 - k_offset**2)"
    return TableSpec(
        "P3_1",
        "П3.1",
        "Перемещение, скорость и ускорение поршня",
        "П3.1",
        column_list(f"""
            phi_deg
            s1_mm = to_mm(r_crank*(1 - cos({_PHI}))) | Гоц (14)
            s2_mm = to_mm(r_crank*lam/4*(1 - cos(2*{_PHI}))) | Гоц (14)
            sk_mm = to_mm(r_crank*({top} - 1 - 1/lam + lam*k_offset**2/2
                - lam*k_offset*sin({_PHI}))) | Гоц (14)
            s_mm = s1_mm + s2_mm + sk_mm | Гоц (14)
            v1_m_s = r_crank*omega*sin({_PHI}) | Гоц (15)
            v2_m_s = r_crank*omega*lam/2*sin(2*{_PHI}) | Гоц (15)
            vk_m_s = -(r_crank*omega*lam*k_offset*cos({_PHI})) | Гоц (15)
            v_m_s = v1_m_s + v2_m_s + vk_m_s | Гоц (15)
            j1_m_s2 = r_crank*omega**2*cos({_PHI}) | Гоц (16)
            j2_m_s2 = lam*r_crank*omega**2*cos(2*{_PHI}) | Гоц (16)
            jk_m_s2 = r_crank*omega**2*lam*k_offset*sin({_PHI}) | Гоц (16)
            j_m_s2 = j1_m_s2 + j2_m_s2 + jk_m_s2 | Гоц (16)
        """),
        rows,
        note=(
            "В (14) высота ВМТ взята точной, поэтому двучленное перемещение в ВМТ чуть "
            "отличается от нуля."
        ),
    )


def _rod(rows: tuple[float, ...]) -> TableSpec:
    sine = f"(sin({_PHI}) - k_offset)"
    turned = (
        f"lam*omega**2*(lam**2*cos({_PHI})**2*{sine}"
        f" - (1 - lam**2*{sine}**2)*sin({_PHI}))/{_ROOT}**3"
    )
    return TableSpec(
        "P3_2",
        "П3.2",
        "Угловое перемещение, скорость и ускорение шатуна",
        "П3.2",
        column_list(f"""
            phi_deg
            beta_rad = asin(lam*{sine}) | Гоц (13), (17)
            omega_rod_exact_1_s = lam*omega*cos({_PHI})/{_ROOT} | Гоц (18)
            omega_rod_approx_1_s = lam*omega*cos({_PHI}) | Гоц (18а)
            eps_rod_exact_1_s2 = {turned} | Гоц (19)
            eps_rod_approx_1_s2 = -(lam*omega**2*sin({_PHI})) | Гоц (19а)
        """),
        rows,
        note="В учебнике формула (19а) напечатана без знака минус.",
    )


def _exact(rows: tuple[float, ...]) -> TableSpec:
    beta = "P3_2.beta_rad"
    top = "sqrt((1/lam + 1)**2 - k_offset**2)"
    return TableSpec(
        "offset",
        "Д",
        "Точное движение поршня дезаксиального механизма",
        SHEET,
        column_list(f"""
            phi_deg
            x_exact_mm = to_mm(r_crank*({top} - (cos({_PHI}) + cos({beta})/lam))) | Гоц (12)
            v_exact_m_s = r_crank*omega*sin({_PHI} + {beta})/cos({beta}) | Гоц (12), d/dt
            j_exact_m_s2 = r_crank*omega**2*(cos({_PHI} + {beta})/cos({beta})
                + lam*cos({_PHI})**2/cos({beta})**3) | Гоц (12), d²/dt²
            j_central_m_s2 = r_crank*omega**2*(cos({_PHI}) + lam*cos(2*{_PHI})) | Гоц (6)
        """),
        rows,
    )


def _sketch() -> Grid:
    """Figure 11 to the lengths of the input: shaft, crankpin, piston pin, ends of the bore."""
    size = "(r_crank + L_rod)"
    pin_x = f"r_crank*sin(rad({_SKETCH_DEG}))"
    up = f"r_crank*cos(rad({_SKETCH_DEG}))"
    rise = f"({up} + sqrt(L_rod**2 - ({pin_x} - e_offset)**2))"
    points = {
        "axis_x": ("e_offset", "e_offset"),
        "axis_y": ("0", size),
        "rod_x": ("0", pin_x, "e_offset"),
        "rod_y": ("0", up, rise),
    }
    rows = []
    for key, texts in points.items():
        cells = tuple(
            Scalar(f"sketch_{key}{n}", f"({text})/{size}", "Гоц, рис. 11", of="sketch")
            for n, text in enumerate(texts, 1)
        )
        rows.append(GridRow(f"sketch_{key}", (*cells, *[None] * (3 - len(cells)))))
    labels = ("O (ось вала)", "B (шатунная шейка)", "A (поршневой палец)")
    return Grid(
        "offset_sketch",
        "Схема механизма при φ = 60°, в долях r + L",
        SHEET,
        labels,
        tuple(rows),
    )


def _charts() -> tuple[ChartSpec, ...]:
    """Figures 11 and 12."""
    at = "offset_sketch.sketch"
    curves = (
        Series(f"{at}_axis_x", f"{at}_axis_y", "ось цилиндра"),
        Series(f"{at}_rod_x", f"{at}_rod_y", "кривошип и шатун"),
    )
    return (
        ChartSpec("fig11", SHEET, "Схема дезаксиального механизма при φ = 60°", "scheme", curves,
                  figure="11", x_reversed=True),
        over_phi("fig12", SHEET, "Ускорение поршня дезаксиального и центрального механизмов",
                 "j, м/с²",
                 Series("offset.phi_deg", "P3_1.j_m_s2", "jд"),
                 Series("offset.phi_deg", "offset.j_central_m_s2", "jц"),
                 Series("offset.phi_deg", "offset.j_exact_m_s2", "jд точное"), figure="12"),
    )  # fmt: skip
