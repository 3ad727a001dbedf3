"""Honest students who are wrong: what is wrong, what must be said of it, and of nothing else."""

from __future__ import annotations

from openpyxl import Workbook

from tests.grading.real.books import Work
from tests.grading.real.desk import Desk
from tests.grading.real.written import COLUMNS, LAM, OMEGA, ROWS, SCALARS, R

_RAD = "A{r}*PI()/180"


def one(name: str, node: str, text: object, verdict: str = "wrong", cause: str = "") -> Work:
    """A student with one cell or column filled in otherwise."""
    item = node
    if "." not in node:
        block = "masses" if node.startswith(("m_", "K_", "P_")) else "geometry"
        item = f"{block}.{node}"
    return Work(name, lambda desk: {node: text}, verdicts={item: verdict},
                causes={item: cause} if cause else {})  # fmt: skip


def _other_rod(desk: Desk) -> dict[str, object]:
    return {"lam": f"=C5/({desk.other.drawn['geometry.rod_length_mm']}/1000)"}


def _typed(node: str) -> object:
    return lambda desk: {node: [round(v, 4) for v in desk.column(node)]}


def _bad_row(node: str, row: int, what: object) -> object:
    def change(desk: Desk) -> dict[str, object]:
        values: list[object] = [COLUMNS[node]] * ROWS
        values[row] = what
        return {node: values}

    return change


def _shifted(node: str) -> object:
    def change(desk: Desk) -> dict[str, object]:
        texts = [COLUMNS[node].replace("{r}", str(6 + max(0, i - 1))) for i in range(ROWS)]
        return {node: texts}

    return change


def _text_number(book: Workbook, desk: Desk) -> None:
    book["Массы"]["C13"] = f"{desk.scalar('omega'):.2f}"
    book["Массы"]["C13"].data_type = "s"


def _several(desk: Desk) -> dict[str, object]:
    return {
        "P3_1.s1_mm": "=-1000*r_crank*(1-COS(RADIANS(A{r})))",
        "P4_1.N_MPa": "=D{r}*SIN(J{r})",
        "c_m": "=S_stroke*regime_speed_rpm/60",
        "P4_2.Msum_Nm": None,
    }


MISTAKES = (
    one("omega is n", "omega", "=regime_speed_rpm", cause="частота вращения n"),
    one("omega with 60", "omega", "=PI()*regime_speed_rpm/60", cause="вдвое меньше"),
    one("omega upside down", "omega", "=30*regime_speed_rpm/PI()"),
    one("pi is 3.14", "omega", "=3.14*regime_speed_rpm/30", cause="3,14"),
    one("lambda upside down", "lam", "=C6/C5"),
    one("stroke for radius", "r_crank", "=2*geometry_crank_radius_mm/1000", cause="ход поршня"),
    one("millimetres left", "r_crank", "=geometry_crank_radius_mm", cause="в 1000 раз"),
    one("pi D squared", "F_piston", "=PI()*(geometry_bore_mm/1000)^2", cause="π·D²"),
    one("area in mm2", "F_piston", "=PI()*geometry_bore_mm^2/4", cause="в 1\u00a0000\u00a0000 раз"),
    one("volume by radius", "V_h", "=C9*C5*1000", cause="радиус кривошипа r вместо хода"),
    one("volume over ratio", "V_c", "=C10/geometry_compression_ratio"),
    one("one cylinder", "V_engine", "=C10", cause="пропущен множитель"),
    one("mean speed", "c_m", "=C8*regime_speed_rpm/60", cause="потеряно число 2"),
    one("sign at bdc", "j_bdc", "=C5*C13^2*(1-C7)", cause="обратный знак"),
    one("radians left", "beta_max_deg", "=ASIN(C7)", cause="в радианах вместо градусов"),
    one("degrees in cos", "P3_1.s1_mm", f"=1000*{R}*(1-COS(A{{r}}))", cause="градусы вместо"),
    one("sign of s2", "P3_1.s2_mm", f"=-1000*{R}*{LAM}/2*SIN({_RAD})^2", cause="обратный знак"),
    one("half for quarter", "P3_1.s2_mm", f"=1000*{R}*{LAM}*SIN({_RAD})^2", cause="вдвое"),
    one("stroke in speed", "P3_1.v1_m_s", f"=S_stroke*{OMEGA}*SIN({_RAD})", cause="ход поршня S"),
    one("lambda forgotten", "P3_1.v2_m_s", f"={R}*{OMEGA}*SIN({_RAD})*COS({_RAD})",
        cause="пропущен множитель λ"),
    one("omega not squared", "P3_1.j1_m_s2", f"={R}*{OMEGA}*COS({_RAD})", cause="в квадрат"),
    one("single angle", "P3_1.j2_m_s2", f"={R}*{OMEGA}^2*{LAM}*COS({_RAD})",
        cause="угол φ вместо 2φ"),
    one("dollar forgotten", "P3_1.v1_m_s",
        [f"=Массы!C{5 + i}*Массы!C{13 + i}*SIN(A{6 + i}*PI()/180)" for i in range(ROWS)],
        cause="$"),
    Work("shifted by a row", _shifted("P3_1.j1_m_s2"), verdicts={"P3_1.j1_m_s2": "wrong"},
         causes={"P3_1.j1_m_s2": "на одну строку"}),
    one("another column", "P3_1.v_m_s", "=D{r}", cause="соседнего столбца"),
    one("atmosphere forgotten", "P4_1.Pg_MPa", "=Газы!E{r}", cause="пропущено слагаемое"),
    one("inertia sign", "P4_1.Pj_MPa", "=m_j*K{r}/F_piston/10^6", cause="обратный знак"),
    one("m2 for mj", "P4_1.Pj_MPa", "=-m_2*K{r}/F_piston/10^6", cause="m2 вместо mj"),
    one("pascals left", "P4_1.Pj_MPa", "=-m_j*K{r}/F_piston", cause="в 1\u00a0000\u00a0000 раз"),
    one("difference for sum", "P4_1.Ps_MPa", "=B{r}-C{r}", cause="знак слагаемого"),
    one("sine for tangent", "P4_1.N_MPa", "=D{r}*SIN(J{r})"),
    one("times for over", "P4_1.S_MPa", "=D{r}*COS(J{r})"),
    one("cosine for sine", "P4_1.T_MPa", "=D{r}*COS(A{r}*PI()/180+J{r})/COS(J{r})",
        cause="sin и cos взяты друг вместо друга"),
    one("radius forgotten", "P4_1.M_Nm", "=G{r}*10^6*F_piston", cause="пропущен множитель r"),
    one("not shifted", "P4_2.M2_Nm", "='П4.1'!I{r}", cause="соседнего столбца"),
    one("shifted back", "P4_2.M2_Nm",
        "=INDEX('П4.1'!I$6:I$30,MATCH(MOD(A{r}+240,720),'П4.1'!A$6:A$30,0))", cause="соседнего"),
    one("third forgotten", "P4_2.Msum_Nm", "=B{r}+C{r}", cause="слагаемое M3"),
    one("not summed", "P4_4.Mmain4_Nm", "=E{r}", cause="пропущено слагаемое"),
    one("without the half", "P4_5.Mpin2_Nm", "='П4.4'!B{r}+C{r}", cause="вместо половины"),
    one("no half at all", "P4_5.Mpin1_Nm", "='П4.2'!B{r}", cause="вместо половины"),
    one("sum for root", "P4_3_1.R_MPa", "=H{r}+I{r}"),
    one("nothing but noughts", "P3_2.beta_rad", "=0*A{r}", "wrong", cause="равны нулю"),
    Work("typed column", _typed("P3_1.v1_m_s"), verdicts={"P3_1.v1_m_s": "typed"}),
    Work("one wrong row", _bad_row("P4_1.N_MPa", 4, 7.5), verdicts={"P4_1.N_MPa": "wrong"}),
    one("empty column", "P4_5.Mpin3_Nm", None, "empty"),
    Work("one empty row", _bad_row("P4_1.S_MPa", 9, None), verdicts={"P4_1.S_MPa": "empty"}),
    one("division by nought", "lam", "=C5/0", "error"),
    one("not available", "lam", "=NA()", "error"),
    Work("a number as a text", edit=_text_number, verdicts={"geometry.omega": "typed"}),
    one("of the wrong rod", "lam", "", cause="не из вашего варианта"),
    one("rounded too far", "P3_1.s_mm", "=ROUND(B{r}+C{r},0)", cause="округл"),
    one("typed omega", "P3_1.v1_m_s", "={r_}", "typed"),
    Work(
        "N by way of a wrong S",
        lambda desk: {"P4_1.S_MPa": "=D{r}*COS(J{r})", "P4_1.N_MPa": "=F{r}*SIN(J{r})"},
        verdicts={"P4_1.S_MPa": "wrong"},
    ),
    Work("several", _several, verdicts={
        "P3_1.s1_mm": "wrong", "P4_1.N_MPa": "wrong", "geometry.c_m": "wrong",
        "P4_2.Msum_Nm": "empty"}),
)  # fmt: skip


def _named(work: Work) -> Work:
    """Those that need numbers of the variant."""
    from dataclasses import replace

    if work.name == "of the wrong rod":
        return replace(work, change=_other_rod)
    if work.name == "typed omega":

        def change(desk: Desk) -> dict[str, object]:
            return {"P3_1.v1_m_s": f"={R}*{desk.scalar('omega')!r}*SIN({_RAD})"}

        return replace(work, change=change)
    return work


MISTAKES = tuple(map(_named, MISTAKES))
assert SCALARS
