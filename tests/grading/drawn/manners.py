"""Honest manners of writing, usual mistakes and cheats of a class on any base, by chance.

``{r}`` is the row of the cell; names are those of the book.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence

# The same value in other algebra: the first is the textbook's own, the others are people's.
P = "RADIANS(A{r})"
FORMS: dict[str, tuple[str, ...]] = {
    "omega": ("=PI()*regime_speed_rpm/30", "=2*PI()*regime_speed_rpm/60",
              "=RADIANS(6*regime_speed_rpm)"),
    "S_stroke": ("=2*r_crank", "=geometry_stroke_mm/1000", "=2*lam*L_rod"),
    "F_piston": ("=PI()*(geometry_bore_mm/1000)^2/4", "=PI()*(geometry_bore_mm/2000)^2",
                 "=0.25*PI()*POWER(geometry_bore_mm,2)/10^6"),
    "V_h": ("=F_piston*S_stroke*1000", "=F_piston*2*r_crank*1000",
            "=PI()*(geometry_bore_mm/1000)^2/4*S_stroke*1000"),
    "V_c": ("=V_h/(geometry_compression_ratio-1)",
            "=F_piston*S_stroke*1000/(geometry_compression_ratio-1)"),
    "c_m": ("=2*r_crank*omega/PI()", "=S_stroke*regime_speed_rpm/30", "=S_stroke*omega/PI()"),
    "v_max": ("=r_crank*omega*(SIN(RADIANS(phi_vmax_deg))+lam/2*SIN(2*RADIANS(phi_vmax_deg)))",
              "=r_crank*omega*SIN(RADIANS(phi_vmax_deg))*(1+lam*COS(RADIANS(phi_vmax_deg)))"),
    "j_tdc": ("=r_crank*omega^2*(1+lam)", "=S_stroke/2*omega^2*(1+lam)",
              "=omega^2*(r_crank+r_crank*lam)"),
    "P3_1.s1_mm": (f"=r_crank*(1-COS({P}))*1000", f"=2000*r_crank*SIN({P}/2)^2",
                   f"=1000*(r_crank-r_crank*COS({P}))", f"=500*S_stroke*(1-COS({P}))"),
    "P3_1.s2_mm": (f"=r_crank*lam/4*(1-COS(2*{P}))*1000", f"=500*r_crank*lam*SIN({P})^2",
                   f"=250*r_crank*lam*(1-(2*COS({P})^2-1))", f"=125*S_stroke*lam*(1-COS(2*{P}))"),
    "P3_1.s_mm": ("=B{r}+C{r}", f"=1000*r_crank*((1-COS({P}))+lam/4*(1-COS(2*{P})))"),
    "P3_1.v1_m_s": (f"=r_crank*omega*SIN({P})", f"=S_stroke/2*omega*SIN({P})",
                    f"=PI()*c_m/2*SIN({P})"),
    "P3_1.v2_m_s": (f"=r_crank*omega*lam/2*SIN(2*{P})", f"=r_crank*omega*lam*SIN({P})*COS({P})",
                    f"=E{{r}}*lam*COS({P})"),
    "P3_1.v_m_s": ("=E{r}+F{r}", f"=r_crank*omega*(SIN({P})+lam/2*SIN(2*{P}))",
                   f"=r_crank*omega*SIN({P})*(1+lam*COS({P}))"),
    "P3_1.j1_m_s2": (f"=r_crank*omega^2*COS({P})", f"=j_tdc/(1+lam)*COS({P})"),
    "P3_1.j2_m_s2": (f"=lam*r_crank*omega^2*COS(2*{P})", f"=lam*r_crank*omega^2*(2*COS({P})^2-1)",
                     f"=lam*r_crank*omega^2*(COS({P})^2-SIN({P})^2)",
                     f"=lam*r_crank*omega^2*(1-2*SIN({P})^2)"),
    "P3_1.j_m_s2": ("=H{r}+I{r}", f"=r_crank*omega^2*(COS({P})+lam*COS(2*{P}))"),
    "P3_2.beta_rad": (f"=ASIN(lam*SIN({P}))", f"=ATAN(lam*SIN({P})/SQRT(1-lam^2*SIN({P})^2))",
                      f"=ASIN(r_crank/L_rod*SIN({P}))"),
    "P3_2.omega_rod_exact_1_s": (f"=omega*lam*COS({P})/SQRT(1-lam^2*SIN({P})^2)",
                                 f"=omega*lam*COS({P})/COS(B{{r}})"),
    "P4_1.Ps_MPa": ("=B{r}+C{r}", "=-m_j*K{r}/F_piston/10^6+B{r}"),
    "P4_1.N_MPa": ("=D{r}*TAN(J{r})", "=D{r}*SIN(J{r})/COS(J{r})", "=F{r}*SIN(J{r})"),
    "P4_1.S_MPa": ("=D{r}/COS(J{r})", "=D{r}*SQRT(1+TAN(J{r})^2)"),
    "P4_1.T_MPa": (f"=D{{r}}*SIN({P}+J{{r}})/COS(J{{r}})", f"=F{{r}}*SIN({P}+J{{r}})",
                   f"=D{{r}}*(SIN({P})+COS({P})*TAN(J{{r}}))", f"=D{{r}}*SIN({P})+E{{r}}*COS({P})"),
    "P4_1.K_MPa": (f"=D{{r}}*COS({P}+J{{r}})/COS(J{{r}})", f"=F{{r}}*COS({P}+J{{r}})",
                   f"=D{{r}}*(COS({P})-SIN({P})*TAN(J{{r}}))", f"=D{{r}}*COS({P})-E{{r}}*SIN({P})"),
    "P4_1.M_Nm": ("=G{r}*1000000*F_piston*r_crank", "=G{r}*10^6*F_piston*S_stroke/2",
                  "=G{r}*1000*V_h/2"),
    "st_groove_mm": ("=geometry_bore_mm-2*(st_ring_radial_mm+strength_ring_play_mm)",
                     "=geometry_bore_mm-2*st_ring_radial_mm-2*strength_ring_play_mm"),
    "st_land_MPa": ("=SQRT(st_land_bend_MPa^2+4*st_land_shear_MPa^2)",
                    "=(st_land_bend_MPa^2+(2*st_land_shear_MPa)^2)^0.5"),
    "st_q1_MPa": ("=st_N_max_N/(st_skirt_mm*geometry_bore_mm)",
                  "=st_N_max_N/st_skirt_mm/geometry_bore_mm"),
    "st_alpha": ("=st_pin_bore_mm/st_pin_mm", "=1/(st_pin_mm/st_pin_bore_mm)"),
    "power_fan": ("=fan_flow_share*M_e*omega/1000",
                  "=fan_flow_share*M_e*PI()*regime_speed_rpm/30000"),
    "tip_fan": ("=omega*1.2*fan_blade_mm/2000", "=PI()*fan_blade_mm/1000*1.2*regime_speed_rpm/60"),
}  # fmt: skip

Manner = Callable[[str], str]


def _called(name: str, to: str) -> Manner:
    return lambda text: text.replace(name, to)


def _wrapped(before: str, after: str) -> Manner:
    return lambda text: f"={before}{text[1:]}{after}" if text.startswith("=") else text


def _swapped(text: str) -> str:
    """The two sides of a plain sum or product the other way round."""
    match = re.fullmatch(r"=([^-+*/^()]+)([+*])([^-+*/^()]+)", text)
    return f"={match[3]}{match[2]}{match[1]}" if match else text


def _power(text: str) -> str:
    return re.sub(r"\b(\w+)\^2", r"POWER(\1,2)", text)


def _square(text: str) -> str:
    return re.sub(r"\b(omega|lam)\^2", r"\1*\1", text) if "/" not in text else text


# Forty manners: eight ways with angles times five ways of writing the rest.
ANGLES: tuple[Manner, ...] = (
    lambda text: text,
    lambda text: text.replace(P, "(A{r}*PI()/180)"),
    lambda text: text.replace(P, "(A{r}/57.29577951)"),
    lambda text: text.replace(P, "(A{r}*3.14159265/180)"),
    lambda text: text.replace(P, "(PI()/180*A{r})"),
    lambda text: text.replace(P, 'CONVERT(A{r},"deg","rad")'),
    lambda text: text.replace(P, "(A{r}/180*PI())"),
    lambda text: text.replace(P, "RADIANS($A{r})"),
)
REST: tuple[Manner, ...] = (
    lambda text: text,
    lambda text: _power(text).replace("*", " * "),
    lambda text: _wrapped("ROUND(", ",9)")(_square(text)),
    lambda text: _wrapped("IFERROR(", ',"")')(_swapped(text)),
    lambda text: _swapped(text).replace("=", "=+", 1),
)
MANNERS = tuple((angle, rest) for angle in ANGLES for rest in REST)

# Mistakes that people make: node, what is written, words of the cause ("" where none is wanted).
MISTAKES: tuple[tuple[str, str, str], ...] = (
    ("omega", "=regime_speed_rpm", "частота вращения n"),
    ("omega", "=PI()*regime_speed_rpm/60", "вдвое меньше"),
    ("omega", "=3.14*regime_speed_rpm/30", "3,14"),
    ("omega", "=3*regime_speed_rpm/30", "π взято как 3"),
    ("omega", "=2*PI()*regime_speed_rpm", "больше"),
    ("lam", "=L_rod/r_crank", "обратная"),
    ("r_crank", "=geometry_stroke_mm/1000", "потеряно число 2"),
    ("F_piston", "=PI()*(geometry_bore_mm/1000)^2", "π·D²"),
    ("F_piston", "=PI()*geometry_bore_mm^2/4", "раз"),
    ("F_piston", "=3*(geometry_bore_mm/1000)^2/4", "π взято как 3"),
    ("V_h", "=F_piston*r_crank*1000", "радиус кривошипа r вместо хода"),
    ("V_c", "=V_h/geometry_compression_ratio", ""),
    ("c_m", "=r_crank*omega/PI()", "потеряно число 2"),
    ("j_tdc", "=r_crank*omega*(1+lam)", "в квадрат"),
    ("j_tdc", "=r_crank*omega^2*(1-lam)", "знак"),
    ("j_tdc", "=r_crank*omega^2", "пропущен множитель (1 + λ)"),
    ("m_2", "=masses_rod_kg", "масса шатуна"),
    ("beta_max_deg", "=ASIN(lam)", "радиан"),
    ("v_max", "=r_crank*omega*SIN(RADIANS(phi_vmax_deg))", "пропущено слагаемое"),
    ("P3_1.s1_mm", "=r_crank*(1-COS(A{r}))*1000", "градусы вместо"),
    ("P3_1.s1_mm", f"=r_crank*(1-SIN({P}))*1000", "sin и cos"),
    ("P3_1.s1_mm", f"=r_crank*(1+COS({P}))*1000", "знак"),
    ("P3_1.s1_mm", f"=r_crank*(1-COS({P}))", "в 1000 раз"),
    ("P3_1.s2_mm", f"=r_crank*lam^2/4*(1-COS(2*{P}))*1000", "λ в квадрате"),
    ("P3_1.s2_mm", f"=r_crank*lam/2*(1-COS(2*{P}))*1000", "вдвое"),
    ("P3_1.v1_m_s", f"=S_stroke*omega*SIN({P})", "ход поршня"),
    ("P3_1.v1_m_s", f"=r_crank*omega*COS({P})", "sin и cos"),
    ("P3_1.v2_m_s", f"=r_crank*omega*SIN(2*{P})/2", "пропущен множитель λ"),
    ("P3_1.v2_m_s", f"=r_crank*omega*lam^2/2*SIN(2*{P})", "λ в квадрате"),
    ("P3_1.j1_m_s2", f"=r_crank*omega*COS({P})", "в квадрат"),
    ("P3_1.j1_m_s2", f"=r_crank*omega^2*COS({P})^2", "в квадрате"),
    ("P3_1.j2_m_s2", f"=lam*r_crank*omega^2*COS({P})", "угол φ вместо 2φ"),
    ("P3_1.j_m_s2", "=H{r}-I{r}", "знак слагаемого"),
    ("P3_2.beta_rad", f"=ASIN(lam^2*SIN({P}))", "λ в квадрате"),
    ("P3_2.omega_rod_exact_1_s", f"=omega*lam*COS({P})/(1-lam^2*SIN({P})^2)", "корень"),
    ("P3_2.eps_rod_exact_1_s2", f"=-(omega^2)*lam*SIN({P})/SQRT(1-lam^2*SIN({P})^2)^3", "(1 − λ²)"),
    ("P4_1.Pj_MPa", "=m_j*K{r}/F_piston/1000000", "обратный знак"),
    ("P4_1.Pj_MPa", "=-m_2*K{r}/F_piston/1000000", "m2 вместо mj"),
    ("P4_1.Ps_MPa", "=B{r}-C{r}", "знак слагаемого"),
    ("P4_1.M_Nm", "=G{r}*1000000*F_piston", "пропущен множитель r"),
    ("j_tdc", "=r_crank*(omega*(1+lam))^2", "(1 + λ) в квадрате"),
    ("beta_max_deg", "=DEGREES(ATAN(lam))", "ATAN вместо ASIN"),
    ("F_piston", "=PI()*(geometry_bore_mm/1000)/4", "не возведено в квадрат: диаметр цилиндра"),
    ("P3_1.s1_mm", f"=r_crank*1-COS({P})*1000", "нет скобок"),
    ("P3_1.s1_mm", f"=1000*r_crank*1-COS({P})", "нет скобок"),
    ("c_m", "=S_stroke*omega/30", "угловая скорость ω вместо частоты вращения n"),
    ("omega", "=regime_speed_rpm^2*PI()/30", ""),
    ("P3_1.s1_mm", "=r_crank*(1-COS(A{r}*PI()/360))*1000", "угол φ/2 вместо φ"),
    ("P3_1.s2_mm", f"=r_crank*lam/4*(1-COS({P}))*1000", "угол φ вместо 2φ"),
    ("P3_1.s_mm", "=B{r}-C{r}", "знак слагаемого sп2"),
    ("P3_1.j_m_s2", "=H{r}*I{r}", "умножение вместо сложения"),
    ("P3_2.beta_rad", f"=ATAN(lam*SIN({P}))", "ATAN вместо ASIN"),
    ("P4_1.Pj_MPa", "=-m_r*K{r}/F_piston/1000000", "масса mr вместо mj"),
    ("P4_1.T_MPa", f"=D{{r}}*SIN({P}-J{{r}})/COS(J{{r}})", "знак слагаемого β"),
    ("st_groove_mm", "=geometry_bore_mm-st_ring_radial_mm-strength_ring_play_mm", "число 2"),
    ("st_press_MPa", "=st_Pz_N/st_groove_cm2", "в 100 раз"),
    ("st_land_MPa", "=SQRT(st_land_bend_MPa^2+st_land_shear_MPa^2)", "число 4"),
    ("st_land_MPa", "=st_land_bend_MPa^2+4*st_land_shear_MPa^2", "корень"),
    ("st_land_bend_MPa", "=0.0045*st_pz_MPa*geometry_bore_mm/st_land_mm", "не возведена в степень"),
    ("st_land_shear_MPa", "=0.0314*st_pz_MPa*st_land_mm/geometry_bore_mm", "переставлены"),
    ("st_q1_MPa", "=st_N_max_N/(st_height_mm*geometry_bore_mm)", "значение величины q2"),
    ("st_alpha", "=st_pin_mm/st_pin_bore_mm", "обратн"),
    ("st_pin_shear_MPa", "=0.85*st_pin_N*(1-st_alpha+st_alpha^2)/((1-st_alpha^4)*st_pin_mm^2)",
     "знак"),
    ("st_pin_shear_MPa", "=0.85*st_pin_N*(1+st_alpha+st_alpha^2)/((1-st_alpha^4)*st_pin_mm)",
     "в квадрат"),
    ("st_pin_shear_MPa", "=st_pin_N*(1+st_alpha+st_alpha^2)/((1-st_alpha^4)*st_pin_mm^2)", "0,85"),
    ("st_pin_eye_MPa", "=st_pin_N/(st_pin_mm*st_pin_length_mm)", "вместо"),
    ("st_pin_eye_MPa", "=st_pin_N/st_pin_mm*st_eye_length_mm", ""),
    ("power_fan", "=fan_flow_share*M_e*omega", "в 1000 раз"),
    ("power_fan", "=M_e*omega/1000", "пропущен множитель"),
    ("power_fan", "=fan_flow_share*M_e*regime_speed_rpm/1000", "вместо"),
    ("tip_fan", "=omega*fan_blade_mm/2000", "1,2"),
    ("tip_fan", "=omega*1.2*fan_blade_mm/1000", "вдвое больше"),
)  # fmt: skip

_OF_PARTS = ("st_", "power_fan", "tip_fan")  # which other bases have not
_EVERYWHERE = tuple(mistake for mistake in MISTAKES if not mistake[0].startswith(_OF_PARTS))

# Ten cheats in four columns: ``{v}`` is the right number of the row.
CHEATS: tuple[str, ...] = (
    "{v}", "={v}", "={v}+0*A{r}", "={v}*1", "={v}*omega/omega", "=SUM({v},0)",
    "=IF(A{r}<9999,{v},0)",
    "=N({v})", '=VALUE("{v}")', "=CHOOSE(1,{v},0)",
)  # fmt: skip
CHEATED = ("P3_1.v1_m_s", "P3_1.j1_m_s2", "P4_1.T_MPa", "P4_1.N_MPa")

# What nobody else is likely to write: of a ring's source.
SLIPS: tuple[tuple[str, str], ...] = (
    ("P3_1.j_m_s2", "=H{r}+0.5*I{r}"), ("P3_1.s_mm", "=B{r}+C{r}/3"),
    ("P4_1.S_MPa", "=D{r}/COS(2*J{r})"), ("P3_2.beta_rad", f"=ASIN(lam*SIN({P}))*1.1"),
    ("V_c", "=V_h/(geometry_compression_ratio-2)"), ("P4_1.K_MPa", f"=D{{r}}*COS({P}-3*J{{r}})"),
    ("c_m", "=3*r_crank*omega/PI()"), ("P3_1.v_m_s", "=E{r}+F{r}*1.5"),
    ("j_tdc", "=r_crank*omega^2*(1+lam/3)"), ("P4_1.N_MPa", "=D{r}*TAN(J{r}+0.01)"),
)  # fmt: skip
HELPERS: tuple[str, ...] = (
    f"=SIN({P})^3+lam", f"=1-lam^3*COS({P})", "=A{r}^2/720", f"=SQRT(2+COS({P}))", "=MOD(A{r},97)",
)  # fmt: skip

Formulas = dict[str, str]


def honest(chance: random.Random, manner: int) -> Formulas:
    """Formulas of one honest student: a manner throughout, an algebra of his own in places."""
    angle, rest = MANNERS[manner % len(MANNERS)]
    texts = {}
    for node, forms in FORMS.items():
        weights = [6, *([4 / (len(forms) - 1)] * (len(forms) - 1))]
        texts[node] = rest(angle(chance.choices(forms, weights)[0]))
    for node, text, _ in chance.sample(_EVERYWHERE, chance.choice((0, 0, 1, 1, 2, 3))):
        texts[node] = rest(angle(text))
    return texts


def source(chance: random.Random) -> tuple[Formulas, list[str]]:
    """Formulas of the one whom a ring copies, with rare slips, and helper columns."""
    texts = honest(chance, chance.randrange(len(MANNERS)))
    texts |= dict(chance.sample(SLIPS, 4))
    return texts, chance.sample(HELPERS, 2)


def copied(chance: random.Random, texts: Formulas) -> Formulas:
    """What a copier hands in: the source's formulas, a few written anew in the textbook's form."""
    own = chance.sample(sorted(FORMS), 3)
    return texts | {node: FORMS[node][0] for node in own}


def rows_of(text: str, rows: Sequence[int]) -> list[str]:
    """A template in each row."""
    return [text.replace("{r}", str(row)) for row in rows]
