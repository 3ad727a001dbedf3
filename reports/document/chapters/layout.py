"""What the layout adds to the report: scheme, offset, articulated rods, two rods on a throw."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.plots import PHI, over_phi, phi, series
from reports.document.figures import engine_scheme, mechanism_sketch, twin_chart
from reports.document.figures.charts import Panel
from reports.document.page.writer import Figure
from reports.inputs.sections.input_file import LAYOUTS
from reports.spec.shape import rods_table


def scheme_text(chapter: Chapter) -> Markup:
    """Scheme of the engine drawn from the input, with the order of the power strokes."""
    from reports.document.chapters.torque import firing_order

    shape, shaft = chapter.shape, chapter.input.crankshaft
    numbers = range(1, shape.cylinders + 1)
    bank = shaft.bank_angle_deg or 0.0
    draw = partial(
        engine_scheme,
        tuple(bank if shape.is_right(i) else 0.0 for i in numbers),
        tuple(shape.throw_of(i) for i in numbers),
        tuple(shaft.throw_angles_deg),
        tuple(shaft.firing_offsets_deg),
        float(shape.period),
    )
    figure = Figure(draw, "Схема двигателя с носка вала и рабочие ходы цилиндров")
    return chapter.page(
        "layout.html.j2",
        scheme=figure,
        layout=LAYOUTS[chapter.input.engine.layout],
        order=firing_order(chapter),
    )


def offset_kinematics(chapter: Chapter, at: float) -> Markup:
    """Kinematics of an offset mechanism, Gots 1.4."""
    terms = chapter.terms
    lam = min(max(terms.value("lam"), 0.1), 0.6)
    k = min(max(terms.value("k_offset"), -0.6), 0.6)
    figures = {
        "sketch": Figure(
            partial(mechanism_sketch, lam, k=k),
            "Схема дезаксиального кривошипно-шатунного механизма: а\u00a0— размеры и углы; "
            "б\u00a0— силы",
        ),
        "s": over_phi(terms, "Перемещение поршня", "$s$, мм", "P3_1.s_mm", "P3_1.sk_mm"),
        "v": over_phi(terms, "Скорость поршня", "$v$, м/с", "P3_1.v_m_s", "P3_1.vk_m_s"),
        "j": over_phi(
            terms, "Ускорение поршня дезаксиального и центрального механизмов", "$j$, м/с²",
            "P3_1.j_m_s2", "offset.j_central_m_s2", "P3_1.jk_m_s2",
        ),
        "beta": over_phi(
            terms, "Угол отклонения шатуна", r"$\beta$, рад", "P3_2.beta_rad", height=58.0
        ),
        "rod": Figure(
            partial(
                twin_chart,
                phi(terms, "P3_2"),
                Panel(series(terms, "P3_2.omega_rod_exact_1_s"), r"$\omega_{\mathrm{ш}}$, с⁻¹"),
                Panel(series(terms, "P3_2.eps_rod_exact_1_s2"), r"$\varepsilon_{\mathrm{ш}}$, с⁻²"),
                PHI,
                panel_height=50.0,
            ),
            "Качание шатуна: а\u00a0— угловая скорость; б\u00a0— угловое ускорение",
        ),
    }  # fmt: skip
    return chapter.page("offset.html.j2", figures=figures, at=at)


def articulated_text(chapter: Chapter) -> Markup:
    """Motion of the articulated rods; nothing without them."""
    if not chapter.shape.articulated:
        return Markup("")
    terms = chapter.terms
    figures = {
        "s": over_phi(
            terms, "Перемещение поршня прицепного шатуна", "$s$, мм", "articulated.x_exact_mm"
        ),
        "j": over_phi(
            terms, "Ускорение поршня прицепного шатуна", "$j$, м/с²", "articulated.j_exact_m_s2"
        ),
    }
    return chapter.page("articulated.html.j2", figures=figures)


def rods_text(chapter: Chapter) -> Markup:
    """Sums of the forces of two rods on a throw; nothing where throws carry one."""
    shape, terms = chapter.shape, chapter.terms
    if shape.single_rods:
        return Markup("")
    table = rods_table(1)
    figures = {
        "forces": over_phi(
            terms, "Тангенциальные силы двух шатунов первого колена и их сумма", "$T$, МПа",
            f"{table}.Tleft_MPa", f"{table}.Tright_MPa", f"{table}.T_MPa",
        ),
        "load": over_phi(
            terms, "Удельная сила, действующая на первое колено",
            rf"${terms.tex(f'{table}.Rthrow_MPa')}$, МПа", f"{table}.Rthrow_MPa",
        ),
    }  # fmt: skip
    right = f"cylinder_{shape.cylinders}"
    return chapter.page(
        "rods.html.j2", figures=figures, rods=table, at=chapter.example, group=shape.groups[0],
        hung=right if shape.articulated else "",
    )  # fmt: skip
