"""How a student fills the textbook's diesel in: written by hand, cell by cell.

Nothing here comes from the formulas of the program: another algebra, addresses instead of
names, other factors.  ``{r}`` is the row of the cell.
"""

from __future__ import annotations

RUBRIC = """
[work]
fill = ["geometry", "masses", "P3_1", "P3_2", "P4_1", "P4_2", "P4_4", "P4_5", "P4_3_1"]
"""
FIRST, ROWS = 6, 25  # the tables have a row every 30°

_PHI = "A{r}*PI()/180"
R, LAM, OMEGA, F = "'Массы'!$C$5", "'Массы'!$C$7", "'Массы'!$C$13", "'Массы'!$C$9"

SCALARS = {
    "r_crank": "=geometry_crank_radius_mm/1000",
    "L_rod": "=geometry_rod_length_mm/1000",
    "lam": "=C5/C6",
    "S_stroke": "=C5*2",
    "F_piston": "=PI()*(geometry_bore_mm/1000)^2/4",
    "V_h": "=C9*C8*1000",
    "V_c": "=C10/(geometry_compression_ratio-1)",
    "V_engine": "=engine_cylinders*C10",
    "omega": "=2*PI()*regime_speed_rpm/60",
    "c_m": "=C8*regime_speed_rpm/30",
    "phi_vmax_deg": "=DEGREES(ACOS((SQRT(1+8*C7^2)-1)/(4*C7)))",
    "v_max": "=C13*C5*(SIN(C15*PI()/180)+C7*SIN(2*C15*PI()/180)/2)",
    "v_ratio": "=C16/C14",
    "j_tdc": "=C5*C13^2*(1+C7)",
    "j_bdc": "=C5*C13^2*(C7-1)",
    "beta_max_deg": "=ASIN(C7)*180/PI()",
    "m_2": "=masses_rod_big_end_kg",
    "m_j": "=masses_reciprocating_kg",
    "m_k": "=crankshaft_pin_mass_kg+web_1_mass_kg+web_2_mass_kg",
    "m_r": "=C23+C25",
    "P_unit": "=C24*C5*C13^2/C9/1000000",
    "K_r": "=C26*C5*C13^2/1000",
    "K_r_spec": "=C28/C9/1000",
    "K_r_rod": "=C23*C5*C13^2/C9/10^6",
    "K_r_throw": "=C25*C5*C13^2/C9/10^6",
}
COLUMNS = {
    "P3_1.s1_mm": f"=1000*{R}*(1-COS({_PHI}))",
    "P3_1.s2_mm": f"=1000*{R}*{LAM}/2*SIN({_PHI})^2",
    "P3_1.s_mm": "=B{r}+C{r}",
    "P3_1.v1_m_s": f"={R}*{OMEGA}*SIN({_PHI})",
    "P3_1.v2_m_s": f"={R}*{OMEGA}*{LAM}*SIN({_PHI})*COS({_PHI})",
    "P3_1.v_m_s": "=E{r}+F{r}",
    "P3_1.j1_m_s2": f"={R}*{OMEGA}^2*COS({_PHI})",
    "P3_1.j2_m_s2": f"={R}*{OMEGA}^2*{LAM}*(2*COS({_PHI})^2-1)",
    "P3_1.j_m_s2": "=H{r}+I{r}",
    "P3_2.beta_rad": f"=ASIN({LAM}*SIN({_PHI}))",
    "P3_2.omega_rod_exact_1_s": f"={OMEGA}*{LAM}*COS({_PHI})/COS(B{{r}})",
    "P3_2.omega_rod_approx_1_s": f"={OMEGA}*{LAM}*COS({_PHI})",
    "P3_2.eps_rod_exact_1_s2": f"=-({OMEGA}^2)*{LAM}*(1-{LAM}^2)*SIN({_PHI})/COS(B{{r}})^3",
    "P3_2.eps_rod_approx_1_s2": f"=-({OMEGA}^2)*{LAM}*SIN({_PHI})",
    "P4_1.Pg_MPa": "='Газы'!E{r}-gas_ambient_pressure_mpa",
    "P4_1.Pj_MPa": f"=-'Массы'!$C$24*K{{r}}/{F}/10^6",
    "P4_1.Ps_MPa": "=B{r}+C{r}",
    "P4_1.N_MPa": "=D{r}*TAN(J{r})",
    "P4_1.S_MPa": "=D{r}/COS(J{r})",
    "P4_1.T_MPa": f"=D{{r}}*SIN({_PHI}+J{{r}})/COS(J{{r}})",
    "P4_1.K_MPa": f"=D{{r}}*COS({_PHI}+J{{r}})/COS(J{{r}})",
    "P4_1.M_Nm": f"=G{{r}}*10^6*{F}*{R}",
    "P4_1.beta_rad": f"=ASIN({LAM}*SIN({_PHI}))",
    "P4_1.j_m_s2": f"={R}*{OMEGA}^2*(COS({_PHI})+{LAM}*COS(2*{_PHI}))",
    "P4_1.Mopr_Nm": "=-I{r}",
    "P4_2.M1_Nm": "='П4.1'!I{r}",
    "P4_2.M2_Nm": "='Цилиндры'!L{r}",
    "P4_2.M3_Nm": "='Цилиндры'!AD{r}",
    "P4_2.Msum_Nm": "=SUM(B{r}:D{r})",
    "P4_4.Mmain2_Nm": "='П4.2'!B{r}",
    "P4_4.M2_Nm": "='П4.2'!C{r}",
    "P4_4.Mmain3_Nm": "=B{r}+C{r}",
    "P4_4.M3_Nm": "='П4.2'!D{r}",
    "P4_4.Mmain4_Nm": "=D{r}+E{r}",
    "P4_5.Mpin1_Nm": "='П4.2'!B{r}/2",
    "P4_5.M2_Nm": "='П4.2'!C{r}",
    "P4_5.Mpin2_Nm": "='П4.4'!B{r}+C{r}/2",
    "P4_5.M3_Nm": "='П4.2'!D{r}",
    "P4_5.Mpin3_Nm": "='П4.4'!D{r}+E{r}/2",
    "P4_3_1.bT_MPa": f"=(1-{{throw1_share}})*'П4.1'!G{{r}}+{{throw1_RTCL}}/{F}/10^6",
    "P4_3_1.bTcos_MPa": "=B{r}*COS(throw_angle_1_deg*PI()/180)",
    "P4_3_1.bTsin_MPa": "=B{r}*SIN(throw_angle_1_deg*PI()/180)",
    "P4_3_1.bK_MPa": f"=(1-{{throw1_share}})*'П4.1'!H{{r}}+{{throw1_RKCL}}/{F}/10^6",
    "P4_3_1.bKcos_MPa": "=E{r}*COS(throw_angle_1_deg*PI()/180)",
    "P4_3_1.bKsin_MPa": "=E{r}*SIN(throw_angle_1_deg*PI()/180)",
    "P4_3_1.Rx_MPa": "=C{r}-G{r}",
    "P4_3_1.Ry_MPa": "=D{r}+F{r}",
    "P4_3_1.R_MPa": "=SQRT(H{r}^2+I{r}^2)",
    "P4_3_1.psiR_deg": "=IF(ABS(H{r})<1E-9,IF(I{r}>=0,0,180),DEGREES(ATAN2(I{r},H{r})))",
    "P4_3_1.block_x_MPa": f"=I{{r}}*SIN({_PHI})-H{{r}}*COS({_PHI})",
    "P4_3_1.block_y_MPa": f"=-H{{r}}*SIN({_PHI})-I{{r}}*COS({_PHI})",
}
WRITTEN = {**SCALARS, **COLUMNS}
