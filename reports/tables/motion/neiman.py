"""Neiman: Fourier series of the piston motion, the rod on its pin."""

from __future__ import annotations

from reports.spec.blocks import Column, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, columns_of, over_phi
from reports.spec.listing import column_list
from reports.spec.parts import Part, Scope, stepped
from reports.tables.motion.segal import ALPHA, TITLES, J, S, V, filled

SHEET, RESULTS = "Гармоники движения", "Гармоники движения, ряд"
SHOWN = (1, 2, 4, 6)
ORDERS = (2, 4, 6, 8, 10, 12)


def _sign(order: int) -> int:
    """Sign of the harmonic in cos β/λ = 1/λ − k + p₂cos2φ − p₄cos4φ and so on."""
    return 1 if order % 4 == 2 else -1


def _harmonic(letter: str, order: int) -> str:
    alpha = f"{order}*rad(alpha_deg)" if order > 1 else "rad(alpha_deg)"
    size = {"s": 1, "v": order, "j": order**2}[letter]
    turn = "sin" if letter == "v" else "cos"
    minus = (letter == "s") != (order > 1 and _sign(order) < 0)
    factor = "" if order == 1 else f"{size}*neiman_p{order}*" if size > 1 else f"neiman_p{order}*"
    text = f"{factor}{turn}({alpha})"
    return f"-({text})" if minus else text


def _motion() -> TableSpec:
    columns = [Column("alpha_deg", None)]
    sources = {"s": "Нейман (15), (23)", "v": "Нейман (27), (28)", "j": "Нейман (35), (36)"}
    for letter, exact in (("s", S), ("v", V), ("j", J)):
        source = sources[letter]
        columns.append(Column(f"{letter}_exact", filled(exact, "lam"), source))
        columns += [Column(f"{letter}_order{n}", _harmonic(letter, n), source) for n in SHOWN]
        terms = [f"{letter}_order{n}" for n in SHOWN] + [_harmonic(letter, 8)]
        constant = ["1", "neiman_k"] if letter == "s" else []
        text = " + ".join([*constant, *terms])
        columns.append(Column(f"{letter}_series", text, source))
    root = "sqrt(1 - lam**2*sin(rad(alpha_deg))**2)"
    columns += column_list(f"""
        rod_speed_rel = lam*cos(rad(alpha_deg))/{root} | Нейман (7)
        rod_acceleration_rel = -(lam*(1 - lam**2)*sin(rad(alpha_deg))/{root}**3) | Нейман (9)
        rod_on_pin_rel = 1 + rod_speed_rel | Нейман (12)
        helpers:
        root = {root}/lam | Нейман (14)
    """)
    for letter in "svj":
        columns.append(
            *column_list(f"""
                helpers:
                {letter}_gap of {letter}_series_error = abs({letter}_series - {letter}_exact)
                    | погрешность ряда
            """)
        )
    return TableSpec(
        "neiman_motion",
        "Н.р",
        "Гармоники движения поршня и точные кривые",
        SHEET,
        tuple(columns),
        stepped(0, 360, 5),
        note=(
            "Перемещение отнесено к r, скорость к ωr, ускорение к ω²r; λ — двигателя. "
            "Знаки гармоник 4 и 8 в напечатанной формуле (28) пропущены."
        ),
        step=5.0,
    )


def _coefficients() -> ScalarTable:
    table = "neiman_motion"
    scalars = [Scalar("neiman_k", f"1/lam - col_mean({table}.root)", "Нейман (22)")]
    for order in ORDERS:
        text = f"fourier_cos({table}.root, {table}.alpha_deg, {order})"
        text = text if _sign(order) > 0 else f"-{text}"
        scalars.append(Scalar(f"neiman_p{order}", text, "Нейман (22), без обрыва ряда"))
    scalars += [
        Scalar(f"{letter}_series_error", f"col_max({table}.{letter}_gap)", "Нейман (23)–(36)")
        for letter in "svj"
    ]
    return ScalarTable("neiman_list", "Коэффициенты ряда при λ двигателя", RESULTS, tuple(scalars))


def neiman(scope: Scope) -> Part:
    """Harmonics of the engine's motion."""
    return Part((_motion(), _coefficients()), _charts()) if scope.shape.by_orders else Part()


def _charts() -> tuple[ChartSpec, ...]:
    """Figures 2-4, 6, 9 for the engine's λ."""
    t = "neiman_motion"
    return (
        *(
            over_phi(f"neiman_{letter}", SHEET, f"{title} поршня и его гармоники", letter,
                     *columns_of(t, f"{letter}_exact", *(f"{letter}_order{n}" for n in (1, 2, 4))),
                     x=ALPHA)
            for letter, title in TITLES.items()
        ),
        over_phi("neiman_rod", SHEET, "Угловая скорость шатуна на шатунной шейке", "(dΦ/dt)/ω",
                 f"{t}.rod_on_pin_rel", x=ALPHA),
        over_phi("neiman_rod_acceleration", SHEET, "Угловое ускорение шатуна", "Θ/ω²",
                 f"{t}.rod_acceleration_rel", x=ALPHA),
    )  # fmt: skip
