"""Geometry, masses and the kinematic tables П3.1 and П3.2, Gots 1.2, 1.3, 2.2, 2.3."""

from __future__ import annotations

from reports.inputs.sections.input_file import DesignGeometrySection, GeometrySection, InputFile
from reports.spec.blocks import Column, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, only, over_phi
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape

TWO_TERM = "r_crank*omega**2*(cos(rad({phi})) + lam*cos(2*rad({phi})))"
OFFSET_TWO_TERM = (
    "r_crank*omega**2*(cos(rad({phi})) + lam*cos(2*rad({phi})) + lam*k_offset*sin(rad({phi})))"
)
EXACT = (
    "r_crank*omega**2*(cos(rad({phi}) + {beta})/cos({beta})"
    " + lam*cos(rad({phi}))**2/cos({beta})**3)"
)


def size_stand_ins(model: InputFile) -> dict[str, str]:
    """Sizes of a single journal where the input gives one size for all."""
    shaft, throws = model.crankshaft, len(model.crankshaft.throw_angles_deg)
    sizes = (
        ("pin_diameter", shaft.pin_diameters_mm, throws),
        ("pin_length", shaft.pin_lengths_mm, throws),
        ("main_diameter", shaft.main_diameters_mm, throws + 1),
    )
    return {
        f"{name}_{number}_mm": f"crankshaft_{name}_mm"
        for name, each, count in sizes
        if each is None
        for number in range(1, count + 1)
    }


def dimensions(scope: Scope) -> Part:
    """Dimensions, masses and constant forces."""
    return Part((_sizes(scope.input), _masses(scope.input)))


def _sizes(model: InputFile) -> ScalarTable:
    """Derived geometry and kinematic scalars."""
    given, shape = model.geometry, Shape.of(model)
    bore = "of_mm(geometry_bore_mm)"
    if isinstance(given, DesignGeometrySection):
        return _geometry(shape, "of_mm(cyc_S)/2", "r_crank/geometry_lambda", "of_mm(cyc_D)")
    if given.crank_radius_mm is not None:
        radius = "of_mm(geometry_crank_radius_mm)"
    elif given.stroke_mm is not None:
        radius = "of_mm(geometry_stroke_mm)/2"
    else:
        radius = "of_mm(geometry_rod_length_mm)*geometry_lambda"
    if given.rod_length_mm is not None:
        length = "of_mm(geometry_rod_length_mm)"
    else:
        length = "r_crank/geometry_lambda"
    return _geometry(shape, radius, length, bore, offset_sum(given))


def offset_sum(given: GeometrySection | DesignGeometrySection) -> str:
    """Offset of the cylinder's axis and of the pin [m], empty for a central mechanism."""
    if isinstance(given, DesignGeometrySection):
        return ""
    keys = ("crank_offset_mm", "pin_offset_mm")
    return " + ".join(f"of_mm(geometry_{key})" for key in keys if getattr(given, key) is not None)


def _geometry(shape: Shape, radius: str, length: str, bore: str, offset: str = "") -> ScalarTable:
    mean = "S_stroke*omega/pi" if shape.offset else "2*r_crank*omega/pi"
    engine = "(V_h + V_h_art)*engine_cylinders/2" if shape.articulated else "V_h*engine_cylinders"
    return ScalarTable(
        "geometry",
        "Размеры и кинематика механизма",
        "Массы",
        (
            *scalar_list(f"""
                r_crank = {radius} | Гоц, 1.1
                L_rod = {length} | Гоц, 1.1
                lam = r_crank/L_rod | Гоц, 1.1
            """),
            *(_dead_centres(offset) if shape.offset else ()),
            Scalar("S_stroke", *_stroke(offset=shape.offset)),
            *scalar_list(f"""
                F_piston = pi*({bore})**2/4 | Гоц, введение
                V_h = to_dm3(F_piston*S_stroke) | Гоц, введение
                V_c = V_h/(geometry_compression_ratio - 1) | Гоц, введение
                V_engine = {engine} | Гоц, введение
                omega = pi*regime_speed_rpm/30 | Гоц, 1.1
                c_m = {mean} | Гоц, 1.2
            """),
            *(_offset_extremes() if shape.offset else _central_extremes()),
        ),
        note=(
            "Рабочий объём и объём камеры сгорания найдены по ходу дезаксиального механизма (11), "
            "а не по 2r. Положительное смещение — в сторону, куда идёт кривошип от ВМТ."
            if shape.offset
            else ""
        ),
    )


def _stroke(*, offset: bool) -> tuple[str, str]:
    if not offset:
        return "2*r_crank", "Гоц, 1.1"
    upper, lower = (f"sqrt((1/lam {sign} 1)**2 - k_offset**2)" for sign in "+-")
    return f"r_crank*({upper} - {lower})", "Гоц (11)"


def _dead_centres(offset: str) -> tuple[Scalar, ...]:
    return scalar_list(f"""
        e_offset = {offset} | Гоц, 1.4
        k_offset = e_offset/r_crank | Гоц, 1.4
        phi_tdc_deg = deg(asin(lam*k_offset/(1 + lam))) | Гоц (9)
        phi_bdc_deg = 180 + deg(asin(lam*k_offset/(1 - lam))) | Гоц (10)
        phi_down_deg = phi_bdc_deg - phi_tdc_deg | Гоц, 1.4
        phi_up_deg = 360 - phi_down_deg | Гоц, 1.4
    """)


def _offset_extremes() -> tuple[Scalar, ...]:
    return scalar_list(f"""
        S_ratio = S_stroke/r_crank | Гоц, 1.4
        c_down = S_stroke*omega/rad(phi_down_deg) | Гоц, 1.4
        c_up = S_stroke*omega/rad(phi_up_deg) | Гоц, 1.4
        j_tdc = {OFFSET_TWO_TERM.format(phi="phi_tdc_deg")} | Гоц (16) в ВМТ
        j_bdc = {OFFSET_TWO_TERM.format(phi="phi_bdc_deg")} | Гоц (16) в НМТ
        beta_90_deg = deg(asin(lam - k_offset*lam)) | Гоц (17), φ = 90°
        beta_270_deg = deg(asin(-lam - k_offset*lam)) | Гоц (17), φ = 270°
        beta_max_deg = max(abs(beta_90_deg), abs(beta_270_deg)) | Гоц (17)
    """)


def _central_extremes() -> tuple[Scalar, ...]:
    return scalar_list("""
        phi_vmax_deg = deg(acos(sqrt((1/(4*lam))**2 + 1/2) - 1/(4*lam))) | Гоц (5)
        v_max = r_crank*omega*(sin(rad(phi_vmax_deg)) + lam/2*sin(2*rad(phi_vmax_deg)))
            | Гоц (4), (5)
        v_ratio = v_max/c_m | Гоц, рис. 6
        j_tdc = r_crank*omega**2*(1 + lam) | Гоц (6), φ = 0
        j_bdc = -(r_crank*omega**2*(1 - lam)) | Гоц (6), φ = 180°
        beta_max_deg = deg(asin(lam)) | Гоц (7)
    """)


def _masses(model: InputFile) -> ScalarTable:
    """Masses and constant inertia forces."""
    given = model.masses
    scalars: list[Scalar] = []
    if given.reciprocating_kg is not None:
        m_2, m_j = "masses_rod_big_end_kg", "masses_reciprocating_kg"
    else:
        if given.rod_centre_mm is not None:
            m_1 = "masses_rod_kg*(L_rod - of_mm(masses_rod_centre_mm))/L_rod"
        else:
            m_1 = "masses_rod_kg*masses_rod_small_end_share"
        scalars.append(Scalar("m_1", m_1, "Гоц (20)"))
        m_2, m_j = "masses_rod_kg - m_1", "masses_piston_group_kg + m_1"
    unit = "r_crank*omega**2"
    scalars += scalar_list(f"""
        m_2 = {m_2} | Гоц (20), (22)
        m_j = {m_j} | Гоц, 2.2
        m_k = crankshaft_pin_mass_kg + web_1_mass_kg + web_2_mass_kg | Гоц (28)
        m_r = {_rotating(Shape.of(model))} | Гоц (29)
        P_unit = to_MPa(m_j*{unit}/F_piston) | Гоц (31)
        K_r = to_kN(m_r*{unit}) | Гоц (32)
        K_r_spec = to_MPa(m_r*{unit}/F_piston) | Гоц, 2.9
        K_r_rod = to_MPa(m_2*{unit}/F_piston) | Гоц, 2.6
        K_r_throw = to_MPa(m_k*{unit}/F_piston) | Гоц (42)
    """)
    return ScalarTable("masses", "Приведённые массы", "Массы", tuple(scalars))


def _rotating(shape: Shape) -> str:
    rods = sum(not shape.is_hung(cylinder) for cylinder in shape.groups[0])
    return "m_k + m_2" if rods == 1 else f"m_k + {rods}*m_2"


def kinematics(scope: Scope) -> Part:
    """Tables П3.1 and П3.2 over one turn and figures 41-45; not with an offset."""
    if scope.shape.offset:
        return Part()
    rows = scope.turn
    phi = "rad(phi_deg)"
    index = Column("phi_deg", None)
    piston = TableSpec(
        "P3_1",
        "П3.1",
        "Перемещение, скорость и ускорение поршня",
        "П3.1",
        (
            index,
            *column_list(f"""
                s1_mm = to_mm(r_crank*(1 - cos({phi}))) | Гоц (3)
                s2_mm = to_mm(r_crank*lam/4*(1 - cos(2*{phi}))) | Гоц (3)
                s_mm = s1_mm + s2_mm | Гоц (3)
                v1_m_s = r_crank*omega*sin({phi}) | Гоц (4)
                v2_m_s = r_crank*omega*lam/2*sin(2*{phi}) | Гоц (4)
                v_m_s = v1_m_s + v2_m_s | Гоц (4)
                j1_m_s2 = r_crank*omega**2*cos({phi}) | Гоц (6)
                j2_m_s2 = lam*r_crank*omega**2*cos(2*{phi}) | Гоц (6)
                j_m_s2 = j1_m_s2 + j2_m_s2 | Гоц (6)
            """),
        ),
        rows,
    )
    root = f"sqrt(1 - lam**2*sin({phi})**2)"
    rod = TableSpec(
        "P3_2",
        "П3.2",
        "Угловое перемещение, скорость и ускорение шатуна",
        "П3.2",
        (
            index,
            *column_list(f"""
                beta_rad = asin(lam*sin({phi})) | Гоц (7)
                omega_rod_exact_1_s = omega*lam*cos({phi})/{root} | Гоц (8)
                omega_rod_approx_1_s = omega*lam*cos({phi}) | Гоц (8), приближённо
                eps_rod_exact_1_s2 = -(omega**2*lam*(1 - lam**2)*sin({phi})/{root}**3) | Гоц, 1.3
                eps_rod_approx_1_s2 = -(omega**2*lam*sin({phi})) | Гоц, 1.3, приближённо
            """),
        ),
        rows,
        note=(
            "В учебнике столбцы углового ускорения подписаны наоборот: первый столбец "
            "напечатан по приближённой формуле, второй — по точной."
        ),
    )
    return Part((piston, rod), kinematic_charts(scope.shape))


def acceleration(model: InputFile, phi: str, beta: str) -> str:
    """Piston acceleration by the chosen method; the choice stays live in the workbook."""
    from reports.inputs.sections.input_file import METHODS

    two_term, exact = TWO_TERM.format(phi=phi), EXACT.format(phi=phi, beta=beta)
    if Shape.of(model).offset:
        two_term = OFFSET_TWO_TERM.format(phi=phi)
    return f'({exact}) if calculation_method == "{METHODS["exact"]}" else ({two_term})'


NEARLY = " (со штрихом\u00a0— по приближённым формулам)"


def kinematic_charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """Figures 41-45; the report shows the offset's own terms in place of the harmonics."""
    captions = ("Перемещение поршня и его гармоники", "Скорость поршня и её гармоники",
                "Ускорение поршня и его гармоники")  # fmt: skip
    further: tuple[tuple[str, ...], ...] = ((), (), ())
    if shape.offset:
        captions = ("", "", "Ускорение поршня дезаксиального и центрального механизмов")
        further = (("P3_1.sk_mm",), ("P3_1.vk_m_s",), ("offset.j_central_m_s2", "P3_1.jk_m_s2"))
    motion = (
        ("fig41", "Перемещение поршня", "s, мм", ("s_mm", "s1_mm", "s2_mm")),
        ("fig42", "Скорость поршня", "v, м/с", ("v_m_s", "v1_m_s", "v2_m_s")),
        ("fig43", "Ускорение поршня", "j, м/с²", ("j_m_s2", "j1_m_s2", "j2_m_s2")),
    )
    made = []
    for (chart, title, y, keys), caption, own in zip(motion, captions, further, strict=True):
        whole, *parts = (f"P3_1.{key}" for key in keys)
        orders = only("workbook", *parts) if shape.offset else parts
        made.append(
            over_phi(chart, "П3.1", title, y, whole, *orders, *only("report", *own),
                     figure=chart[3:], caption=caption)
        )  # fmt: skip
    made.append(
        over_phi("fig44", "П3.2", "Угловое перемещение шатуна", "β, рад", "P3_2.beta_rad",
                 figure="44", caption="Угол отклонения шатуна")
    )  # fmt: skip
    swing = (
        ("a", "omega_rod_{}_1_s", "Угловая скорость", "ω, с⁻¹", r"\omega"),
        ("b", "eps_rod_{}_1_s2", "Угловое ускорение", "ε, с⁻²", r"\varepsilon"),
    )
    for letter, kind, title, y, tex in swing:
        exact, near = (f"P3_2.{kind.format(way)}" for way in ("exact", "approx"))
        approximate = only("workbook", near) if shape.offset else (near,)
        dashed = letter == "b" and not shape.offset
        made.append(
            over_phi(f"fig45{letter}", "П3.2", f"{title} качания шатуна", y, exact, *approximate,
                     figure="45", y_tex=rf"${tex}_{{\mathrm{{ш}}}}$, {y[3:]}",
                     group="Качание шатуна",
                 panel=title.lower() + (NEARLY if dashed else ""))
        )  # fmt: skip
    return tuple(made)
