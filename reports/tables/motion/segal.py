"""Segal: exact and approximate motion of the piston, the inverse problem."""

from __future__ import annotations

from reports.spec.blocks import Column, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, Series, columns_of, line, over_phi
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope, stepped

SHEET, RESULTS = "Точность формул", "Точность формул, итоги"
ITERATIONS = 9

_BETA = "asin({lam}*sin(rad(alpha_deg)))"
S = "1 - cos(rad(alpha_deg)) + (1 - cos({beta}))/{lam}"
V = "sin(rad(alpha_deg) + {beta})/cos({beta})"
J = "cos(rad(alpha_deg) + {beta})/cos({beta}) + {lam}*cos(rad(alpha_deg))**2/cos({beta})**3"
ALPHA = ("alpha_deg", "φ, °")
TITLES = {"s": "Перемещение", "v": "Скорость", "j": "Ускорение"}
_INDEX = Column("alpha_deg", None)


def filled(text: str, lam: str) -> str:
    """A formula with λ and β of one column put in."""
    return text.format(lam=lam, beta=_BETA.format(lam=lam))


def _errors() -> TableSpec:
    alpha = "rad(alpha_deg)"
    near = {
        "s": (f"1 + lam/4 - (cos({alpha}) + lam/4*cos(2*{alpha}))", "Сегаль (1.8)"),
        "v": (f"sin({alpha}) + lam/2*sin(2*{alpha})", "Сегаль (1.14)"),
        "j": (f"cos({alpha}) + lam*cos(2*{alpha})", "Сегаль (1.14)"),
    }
    exact = {"s": (S, "Сегаль (1.17)"), "v": (V, "Сегаль (1.18)"), "j": (J, "Сегаль (1.19)")}
    columns, helpers = [_INDEX], list[Column]()
    for letter in "svj":
        columns += [
            Column(f"{letter}_exact", filled(exact[letter][0], "lam"), exact[letter][1]),
            Column(f"{letter}_two_term", *near[letter]),
            Column(f"d{letter}", f"{letter}_two_term - {letter}_exact", "погрешность"),
        ]
        reached = f"abs(d{letter}) >= d{letter}_max*0.999999"
        helpers.append(
            *column_list(f"""
                helpers:
                at_{letter}_deg of at_error_deg = alpha_deg if {reached} else col_last(alpha_deg)
                    | вспомогательный
            """)
        )
    return TableSpec(
        "segal_errors",
        "С.п",
        "Точные и приближённые перемещение, скорость и ускорение поршня",
        SHEET,
        (*columns, *helpers),
        stepped(0, 180, 2),
        note="Перемещение отнесено к r, скорость к ωr, ускорение к ω²r; λ — двигателя.",
        step=2.0,
    )


def _inverse() -> TableSpec:
    quadratic = "(sqrt((1 + lam)**2 - 2*lam*s_given) - 1)/lam"
    pin = "(1 + 1/lam - s_given)"
    triangle = f"({pin}**2 + 1 - 1/lam**2)/(2*{pin})"
    return TableSpec(
        "segal_inverse",
        "С.о",
        "Угол поворота кривошипа по положению поршня",
        SHEET,
        column_list(f"""
            s_given
            alpha_quadratic_deg = deg(acos({quadratic})) | Сегаль (1.11)
            alpha_small_deg = deg(sqrt(2*s_given/(1 + lam))) | Сегаль (1.12)
            alpha_exact_deg = deg(acos({triangle})) | теорема косинусов
            dalpha_quadratic_deg = alpha_quadratic_deg - alpha_exact_deg | погрешность
            dalpha_small_deg = alpha_small_deg - alpha_exact_deg | погрешность
        """),
        stepped(0.1, 1.9, 0.1),
        step=0.1,
    )


def _error_scalars() -> ScalarTable:
    table = "segal_errors"
    scalars: list[Scalar] = []
    for letter in "svj":
        scalars += scalar_list(f"""
            d{letter}_max = max(col_max({table}.d{letter}), -col_min({table}.d{letter}))
                | Сегаль, с. 13
            alpha_d{letter}_deg = col_min({table}.at_{letter}_deg) | Сегаль, с. 13
        """)
    root = "sqrt(1 - lam**2)"
    scalars += scalar_list(f"""
        s_error_quarter = ((1 + lam/2)/(1 + (1 - {root})/lam) - 1)*100 | Сегаль, с. 13
        j_error_quarter = ({root} - 1)*100 | Сегаль, с. 13
    """)
    return ScalarTable("segal_error_list", "Погрешности приближений", RESULTS, tuple(scalars))


def _extremes() -> ScalarTable:
    scalars = [
        *scalar_list("""
            j_rel_tdc = 1 + lam | Сегаль, с. 13: φ = 0
            j_rel_bdc = -(1 - lam) | Сегаль, с. 13: φ = 180°, со знаком
            j_rel_quarter = -(lam/sqrt(1 - lam**2)) | Сегаль (1.16), φ = 90°
            alpha_j_two_term_min_deg = deg(acos(max(-1, -1/(4*lam)))) | dj′/dφ = 0
            j_two_term_min = cos(rad(alpha_j_two_term_min_deg))
                + lam*cos(2*rad(alpha_j_two_term_min_deg)) | Сегаль (1.19)
            cos_j_min_0 of cos_j_min = max(-1, -1/(4*lam)) | начальное приближение
        """),
    ]
    for i in range(1, ITERATIONS + 1):
        c = f"cos_j_min_{i - 1}"
        root = f"sqrt(1/lam**2 - 1 + {c}**2)"
        slope = f"(4/{root} - 3*(2*{c}**2 - 1)/{root}**3 - 3*{c}**2*(1 - {c}**2)/{root}**5)"
        scalars.append(
            Scalar(
                f"cos_j_min_{i}", f"max(-1, -0.35*{c} - 1.35/{slope})", f"шаг {i}", of="cos_j_min"
            )
        )
    last = f"cos_j_min_{ITERATIONS}"
    root = f"sqrt(1/lam**2 - 1 + {last}**2)"
    scalars += scalar_list(f"""
        alpha_j_exact_min_deg = deg(acos({last})) | dj/dφ = 0
        j_exact_min = {last} + (2*{last}**2 - 1)/{root} + {last}**2*(1 - {last}**2)/{root}**3
            | Сегаль (1.16)
    """)
    return ScalarTable("segal_extremes", "Крайние значения ускорения", RESULTS, tuple(scalars))


def segal(scope: Scope) -> Part:
    """Errors, inverse problem and extremes."""
    if not scope.shape.by_orders:
        return Part()
    return Part((_errors(), _inverse(), _error_scalars(), _extremes()), _charts())


def _charts() -> tuple[ChartSpec, ...]:
    """Exact curves with the approximate ones, errors and the inverse problem."""
    t = "segal_errors"
    inverse = (
        Series("segal_inverse.s_given", f"segal_inverse.alpha_{way}_deg")
        for way in ("exact", "quadratic", "small")
    )
    return (
        *(
            over_phi(f"segal_{letter}", SHEET, f"{title} поршня: точно и приближённо", letter,
                     f"{t}.{letter}_exact", f"{t}.{letter}_two_term", x=ALPHA)
            for letter, title in TITLES.items()
        ),
        over_phi("segal_errors", SHEET, "Погрешности приближённых формул", "доля r, ωr, ω²r",
                 *columns_of(t, "ds", "dv", "dj"), x=ALPHA),
        line("segal_inverse", SHEET, "Угол кривошипа по положению поршня", ("s/r", "φ, °"),
             *inverse),
    )  # fmt: skip
