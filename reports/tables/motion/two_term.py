"""Sheet on the error of the two-term formulas: by the angle and at its greatest."""

from __future__ import annotations

from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Column, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, only, over_phi
from reports.spec.listing import scalar_list
from reports.spec.parts import Part, Scope
from reports.tables.motion.mechanism import offset_sum

SHEET = "Погрешность"
_PHI = "rad(phi_deg)"
_NEARLY = "0.999999"  # equal extremes differ in their last digits
_ERRORS = (
    ("s", "mm", "перемещение"), ("v", "m_s", "скорость"), ("j", "m_s2", "ускорение"),
    ("Pj", "MPa", ""), ("N", "MPa", ""), ("T", "MPa", ""), ("M", "Nm", ""),
)  # fmt: skip


def two_term(scope: Scope) -> Part:
    """Table over a turn and the list of the greatest errors."""
    return Part((_table(scope.turn), _list(scope.input)), _charts())


def _table(rows: tuple[float, ...]) -> TableSpec:
    k, beta = "k_two_term", "beta_two"
    unit = "r_crank*omega**2"
    top = f"sqrt((1 + 1/lam)**2 - {k}**2)"
    s_two = (
        f"(1 - cos({_PHI})) + lam/4*(1 - cos(2*{_PHI})) - lam*{k}*sin({_PHI})"
        f" + {top} - (1 + 1/lam) + lam*{k}**2/2"
    )
    specs = [
        ("es_exact_mm", f"to_mm(r_crank*({top} - cos({_PHI}) - cos({beta})/lam))", "Гоц (1), (12)"),
        ("es_two_mm", f"to_mm(r_crank*({s_two}))", "Гоц (3), (14)"),
        ("es_mm", "es_two_mm - es_exact_mm", "погрешность"),
        ("ev_exact_m_s", f"r_crank*omega*sin({_PHI} + {beta})/cos({beta})", "Гоц, 1.2"),
        ("ev_two_m_s",
         f"r_crank*omega*(sin({_PHI}) + lam/2*sin(2*{_PHI}) - lam*{k}*cos({_PHI}))",
         "Гоц (4), (15)"),
        ("ev_m_s", "ev_two_m_s - ev_exact_m_s", "погрешность"),
        ("ej_exact_m_s2",
         f"{unit}*(cos({_PHI} + {beta})/cos({beta}) + lam*cos({_PHI})**2/cos({beta})**3)",
         "вторая производная (1)"),
        ("ej_two_m_s2", f"{unit}*(cos({_PHI}) + lam*cos(2*{_PHI}) + lam*{k}*sin({_PHI}))",
         "Гоц (6), (16)"),
        ("ej_m_s2", "ej_two_m_s2 - ej_exact_m_s2", "погрешность"),
        ("ePj_exact_MPa", "to_MPa(-(m_j*ej_exact_m_s2)/F_piston)", "Гоц (30)"),
        ("ePj_two_MPa", "to_MPa(-(m_j*ej_two_m_s2)/F_piston)", "Гоц (30)"),
        ("ePj_MPa", "ePj_two_MPa - ePj_exact_MPa", "погрешность"),
        ("eN_MPa", f"ePj_MPa*tan({beta})", "Гоц (34)"),
        ("eT_MPa", f"ePj_MPa*sin({_PHI} + {beta})/cos({beta})", "Гоц (37)"),
        ("eM_Nm", "of_MPa(eT_MPa)*F_piston*r_crank", "Гоц, 2.5"),
    ]  # fmt: skip
    columns = [Column("phi_deg", None), *(Column(*spec) for spec in specs)]
    columns.append(
        Column(beta, f"asin(lam*(sin({_PHI}) - {k}))", "Гоц (7), (17)", helper=True, of="beta_rad")
    )
    for name, suffix, _ in _ERRORS:
        value, most = f"abs(e{name}_{suffix})", f"e{name}_max"
        test = f"{value} >= {most}*{_NEARLY}"
        columns.append(
            Column(f"at_e{name}", f"phi_deg if {test} else col_last(phi_deg)", "вспомогательный",
                   helper=True, of="at_max_deg")
        )  # fmt: skip
    return TableSpec(
        "two_term",
        "Пд",
        "Погрешность двучленных формул",
        SHEET,
        tuple(columns),
        rows,
        note=(
            "Погрешность — приближённое значение минус точное. Силы инерции взяты по одному и "
            "другому ускорению; угол шатуна в силах N и T точный при обоих методах. Метод расчёта "
            "выбирает ячейка исходных данных: по учебнику или точное ускорение."
        ),
    )


def _list(model: InputFile) -> ScalarTable:
    offset = offset_sum(model.geometry)
    scalars = [Scalar("k_two_term", f"({offset})/r_crank" if offset else "0", "Гоц, 1.4")]
    for name, suffix, whole in _ERRORS:
        column = f"two_term.e{name}_{suffix}"
        top = f"max(col_max({column}), -col_min({column}))"
        scalars += scalar_list(f"""
            e{name}_max = {top} | погрешность
            phi_e{name}_deg = col_min(two_term.at_e{name}) | погрешность
        """)
        if whole or name == "Pj":
            exact = f"two_term.e{name}_exact_{suffix}"
            scalars.append(
                Scalar(f"e{name}_rel", f"e{name}_max/max(col_max({exact}), -col_min({exact}))*100",
                       "доля наибольшего точного значения")
            )  # fmt: skip
    title = "Наибольшие погрешности двучленных формул"
    return ScalarTable("two_term_list", title, f"{SHEET}, итоги", tuple(scalars))


def _charts() -> tuple[ChartSpec, ...]:
    """Errors of motion and of the forces over the angle."""
    t = "two_term"
    return (
        over_phi("two_term_s", SHEET, "Погрешность перемещения поршня", "Δs, мм", f"{t}.es_mm"),
        over_phi("two_term_v", SHEET, "Погрешность скорости поршня", "Δv, м/с", f"{t}.ev_m_s"),
        over_phi("two_term_j", SHEET, "Погрешность ускорения поршня", "Δj, м/с²", f"{t}.ej_m_s2"),
        over_phi("two_term_P", SHEET, "Погрешность удельных сил", "МПа", f"{t}.ePj_MPa",
                 *only("workbook", f"{t}.eN_MPa"), f"{t}.eT_MPa"),
    )  # fmt: skip
