"""Chapter on the error of the two-term formulas, vectors of inertia forces, reference tables."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.chapters.plots import PHI, over_phi, phi
from reports.document.figures import Series as Curve
from reports.document.figures import line_chart, mechanism_sketch, polar_path
from reports.document.figures.velocity import velocity_sketch
from reports.document.page.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.page.spec_tables import scalar_table
from reports.document.page.writer import Figure, TablePlan
from reports.document.text.terms import Terms
from reports.shared.russian import fixed
from reports.tables.motion.reference import TABLES

_ERRORS = tuple(
    key
    for name in ("s", "v", "j", "Pj", "N", "T", "M")
    for key in (f"e{name}_max", f"phi_e{name}_deg", f"e{name}_rel")
)


def reference(chapter: Chapter) -> Markup:
    """Errors of the approximation, figure 20 and, where asked for, tables 1-8."""
    terms, asked = chapter.terms, chapter.input.reference
    figures = {
        "errors": over_phi(terms, "Погрешность ускорения поршня", r"$\Delta j$, м/с²",
                           "two_term.ej_m_s2", height=62.0),
        "forces": over_phi(terms, "Погрешность удельных сил", "МПа", "two_term.ePj_MPa",
                           "two_term.eT_MPa", height=62.0),
        "first": _vector(terms, "1", "первого"),
        "second": _vector(terms, "2", "второго"),
    }  # fmt: skip
    shown = [key for key in _ERRORS if terms.has(key)]
    tables: list[tuple[str, TablePlan]] = []
    if asked is not None:
        figures |= _reference_figures(terms, asked.angle_deg, len(asked.lambdas))
        tables = [
            (f"ref_{number}", TablePlan(partial(_table, chapter, number), f"Значение выражения "
                                        f"{title}", size="dense"))
            for number, (title, _, _, _) in TABLES.items()
        ]  # fmt: skip
    return chapter.page(
        "reference.html.j2",
        figures=figures,
        errors=TablePlan(
            partial(scalar_table, terms, shown), "Наибольшие погрешности", size="dense"
        ),
        asked=asked is not None,
        tables=tables,
        exact=chapter.input.calculation.method == "exact",
    )


def _vector(terms: Terms, order: str, word: str) -> Figure:
    draw = partial(
        polar_path, terms.column(f"vectors.rose{order}_x_kN"),
        terms.column(f"vectors.rose{order}_y_kN"), phi(terms, "vectors"), "кН", "кН", most=80.0,
    )  # fmt: skip
    return Figure(draw, f"Сила инерции {word} порядка в полярных координатах")


def _reference_figures(terms: Terms, angle: float, count: int) -> dict[str, Figure]:
    def motion(caption: str, y: str, *keys: str) -> Figure:
        return over_phi(terms, caption, y, *(f"ref_motion.{key}" for key in keys), height=62.0)

    lambdas = terms.model.tables["ref_fig6"].rows
    curves = tuple(
        Curve(rf"$\lambda={_lambda(terms, n)}$", terms.column(f"ref_3.ref_lambda{n}"))
        for n in range(1, min(count, 4) + 1)
    )
    lam = terms.value("lam")
    figures = {
        "s": motion("Перемещение поршня и его гармоники", "$s/r$", "s_rel", "s1_rel", "s2_rel"),
        "v": motion("Скорость поршня и её гармоники", r"$v/r\omega$", "v_rel", "v1_rel", "v2_rel"),
        "j": motion("Ускорение поршня и его гармоники", r"$j/r\omega^2$", "j_rel", "j1_rel",
                    "j2_rel"),
        "rod": motion("Угловые скорость и ускорение шатуна", "", "omega_rod_rel", "eps_rod_rel"),
        "lambda": Figure(
            partial(line_chart, phi(terms, "ref_3"), curves, PHI, r"$j/r\omega^2$", height=66.0),
            "Ускорение поршня при разных λ",
        ),
        "fastest": Figure(
            partial(line_chart, lambdas,
                    (Curve(r"$\varphi$", terms.column("ref_fig6.phi_vmax_deg")),), r"$\lambda$",
                    r"$\varphi_{v\,\max}$, °", height=56.0, angle=False, zero=False),
            "Угол наибольшей скорости поршня",
        ),
        "ratio": Figure(
            partial(line_chart, lambdas,
                    (Curve("$v/c_m$", terms.column("ref_fig6.v_ratio")),), r"$\lambda$",
                    r"$v_{\max}/c_m$", height=56.0, angle=False, zero=False),
            "Отношение наибольшей скорости поршня к средней",
        ),
        "velocity": Figure(
            partial(velocity_sketch, lam, angle), "Графическое определение скорости поршня"
        ),
    }  # fmt: skip
    if 0.1 <= lam <= 0.6 and 10 <= angle <= 80:
        figures["sketch"] = Figure(
            partial(mechanism_sketch, lam, angle), "Движение шатуна: схема и силы"
        )
    return figures


def _lambda(terms: Terms, number: int) -> str:
    return f"{terms.value(f'reference_lambda_{number}_value'):.4g}".replace(".", "{,}")


def _table(chapter: Chapter, number: str) -> TableBlock:
    terms = chapter.terms
    asked = chapter.input.reference
    count = 0 if asked is None else len(asked.lambdas)
    rows = []
    for angle in terms.model.tables[f"ref_{number}"].rows:
        values = [
            fixed(terms.value(f"ref_{number}.ref_lambda{n}", angle), 3) for n in range(1, count + 1)
        ]
        rows.append([fixed(angle, 0), *values])
    columns = [Column(symbol_head(r"\varphi", "°"))]
    columns += [
        Column(f"λ = {terms.value(f'reference_lambda_{n}_value'):.4g}".replace(".", ","))
        for n in range(1, count + 1)
    ]
    return table_block(columns, rows)
