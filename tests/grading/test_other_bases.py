"""Other engines and chapters: the honest are paid, mistakes are told, cheats earn nothing."""

from __future__ import annotations

import pytest

from reports.workbook.layout import WAVES_SHEET, Layout
from tests.grading.fill import solved_formulas
from tests.grading.other_bases import Base

V6 = Base(
    "yamz-236",
    {"geometry.bore_mm": {"min": 126.0, "max": 134.0, "step": 1.0},
     "regime.speed_rpm": {"min": 1900, "max": 2200, "step": 20},
     "masses.rod_kg": {"min": 4.2, "max": 5.0, "step": 0.1}},
    ("scheme", "geometry", "masses", "P4_1", "P4_2", "P4_4", "P4_5", "rods_1", "balance_orders",
     "balance_vectors", "summary_torque"),
    {
        "r_crank": "=geometry_stroke_mm/2000",
        "omega": "=2*PI()*regime_speed_rpm/60",
        "F_piston": "=PI()*(geometry_bore_mm/2000)^2",
        "L_rod": "=IF(engine_cylinders=6,265,260)/1000",  # alike for the class
        "m_1": "=masses_rod_kg-{m_2}",
        "m_2": "=masses_rod_kg*(1-masses_rod_small_end_share)",
        "m_j": "=masses_piston_group_kg+masses_rod_kg*masses_rod_small_end_share",
        "m_r": "=SUM({m_k},{m_2},{m_2})",
        "K_r": "={m_r}*{r_crank}*{omega}^2*0.001",
        "P4_1.T_MPa": "={P4_1.N_MPa}*COS(RADIANS(A{row}))+{P4_1.Ps_MPa}*SIN(RADIANS(A{row}))",
        "P4_1.M_Nm": "={P4_1.T_MPa}*1E6*{F_piston}*{r_crank}",
        "P4_1.beta_rad": "=ASIN(70/265*SIN(RADIANS(A{row})))",  # alike for the class
        "P4_2.M2_Nm": "=INDEX({|P4_1.M_Nm},MATCH({cylinder_2.phase_deg},{|P4_1.phi_deg},0))",
        "P4_2.M4_Nm": "=_xlfn.XLOOKUP({cylinder_4.phase_deg},{|P4_1.phi_deg},{|P4_1.M_Nm})",
        "P4_2.Msum_Nm": "=SUM({P4_2.M1_Nm}:{P4_2.M6_Nm})",
        "P4_4.Mmain2_Nm": "={P4_2.M1_Nm}+{P4_2.M4_Nm}",
        "P4_4.Mmain4_Nm": "=SUM({P4_2.M1_Nm}:{P4_2.M6_Nm})",  # its sheet at both ends
        "cyl_rank2": "=COUNTIF({cyl_theta1}:{cyl_theta6},\"<\"&{cyl_theta2})+1",
        "phi_M_max_deg": "=INDEX({|P4_2.phi_deg},MATCH({M_max},{|P4_2.Msum_Nm},0))",
        "P4_5.Mpin1_Nm": "=({P4_2.M1_Nm}+{P4_2.M4_Nm})*50%",
        "P4_5.Mpin2_Nm": "=AVERAGE({P4_4.Mmain2_Nm},{P4_4.Mmain3_Nm})",
        "rods_1.T_MPa": "={P4_1.T_MPa}+{cylinder_4.T_MPa}",
        "rods_1.Rthrow_MPa": "=SQRT(SUMSQ({rods_1.Ksum_MPa},{rods_1.Tsum_MPa}))",
        "rods_1.Mthrow_Nm": "={rods_1.T_MPa}*10^6*{F_piston}*{r_crank}",
        # An axis has two ends; what goes round evenly has none.
        "L1_before_deg": "=(DEGREES(ATAN2({L1_before_re},{L1_before_im}))+DEGREES(ATAN2(1E-12"
        "+{balance_cos1_arm}-{balance_right_sin1_arm},{balance_sin1_arm}"
        "+{balance_right_cos1_arm})))/2-180",
        "balance_orders.M_order_dir_deg": "=(DEGREES(ATAN2(1E-12+{balance_orders.arm_cos_mm}"
        "+{balance_orders.arm_right_sin_mm},{balance_orders.arm_right_cos_mm}"
        "-{balance_orders.arm_sin_mm}))+DEGREES(ATAN2(1E-12+{balance_orders.arm_cos_mm}"
        "-{balance_orders.arm_right_sin_mm},{balance_orders.arm_sin_mm}"
        "+{balance_orders.arm_right_cos_mm})))/2-180",
    },
    {
        "m_2": ("=masses_rod_kg*masses_rod_small_end_share", ""),
        "cyl_theta2": ("=firing_offset_2_deg+360", ""),  # another stroke
        "m_r": ("={m_k}+{m_2}", ""),  # one rod on a pin that carries two
        "P4_2.M5_Nm": ("={cylinder_4.M_Nm}", ""),
        "P4_2.Msum_Nm": ("=SUM({P4_2.M1_Nm}:{P4_2.M5_Nm})", "слагаемое"),
        "P4_4.Mmain3_Nm": ("={P4_4.Mmain2_Nm}", "слагаемое"),
        "P4_5.Mpin3_Nm": ("={P4_4.Mmain3_Nm}+{rods_2.Mthrow_Nm}+0.5*{rods_3.Mthrow_Nm}", ""),
        "P4_5.Mpin1_Nm": ("={rods_1.Mthrow_Nm}", "половин"),
        "rods_1.Rthrow_MPa": ("=ABS({rods_1.Ksum_MPa})", ""),
        "rods_1.K_MPa": ("={rods_1.Kleft_MPa}-{rods_1.Kright_MPa}", "знак"),
    },
    {
        "m_k": "={v}+0*{m_1}",
        "P4_1.T_MPa": "={v}*{F_piston}/{F_piston}",
        "P4_2.M3_Nm": "=IF({P4_2.M1_Nm}>1E9,1,{v})",
        "rods_1.Rthrow_MPa": "=MAX({v},-{rods_1.T_MPa})",
    },
    {"P4_1.j_m_s2": "={p}*(regime_speed_rpm/{n})^2",
     "P4_2.Msum_Nm": "={p}*{F_piston}/{F_piston}"},
)  # fmt: skip

TORSION = Base(
    "mwm-6",
    {"torsion.speed_max_rpm": {"min": 2200, "max": 2600, "step": 50},
     "torsion.other_flywheel_kg_m2": {"min": 1.0, "max": 2.0, "step": 0.1}},
    ("torsion_train", "torsion_list", "torsion_forms", "torsion_results", "torsion_damper_list",
     "torsion_fresh"),
    {
        "tor_greatest": "=MATCH(MAX({torJ1}:{torJ9}),{torJ1}:{torJ9},0)",
        "tor_flywheel": "=MAX({torJ1}:{torJ9})",
        "torsion_forms.tor_J_kgm2": "=INDEX({torJ1}:{torJ9},A{row})",
        "torsion_forms.tor_theta1": "=IF(A{row}=1,1,{<torsion_forms.tor_theta1}"
        "-{<torsion_forms.tor_moment1_Nm}/{<torsion_forms.tor_c_Nm_rad})",
        "torsion_forms.tor_moment1_Nm": "=(2*PI()*{tor_f1_hz})^2*SUMPRODUCT("
        "{^torsion_forms.tor_J_kgm2}:{torsion_forms.tor_J_kgm2},"
        "{^torsion_forms.tor_theta1}:{torsion_forms.tor_theta1})",
        "torsion_forms.tor_whole2": "=SUMPRODUCT("
        "{^torsion_forms.tor_J_kgm2}:{torsion_forms.tor_J_kgm2},"
        "{^torsion_forms.tor_theta2}:{torsion_forms.tor_theta2}^2)",
        "tor_brought1": "=SUMPRODUCT({|torsion_forms.tor_J_kgm2},{|torsion_forms.tor_theta1}^2)",
        "tor_top_MPa": "=LARGE({|torsion_response.tor_tau_MPa},1)",  # of a table that is given
        "tor_twist1": "=MAX({|torsion_forms.tor_shaft1_MPa})",
        "tor_twist2": "=LARGE({|torsion_forms.tor_shaft2_MPa},1)",
        "tor_f1_change": "=100*({tor_f1_other_hz}-{tor_f1_hz})/{tor_f1_hz}",
        "tor_kappa": "={tor_brought1}/({tor_brought1}+{tor_ring})",
        "tor_zeta_viscous": "=1/SQRT(({tor_mu}+1)*({tor_mu}+2)*2)",
    },
    {
        "tor_twist1": ("=MIN({|torsion_forms.tor_shaft1_MPa})", "получен нуль"),
        "tor_brought1": ("=SUM({|torsion_forms.tor_J_kgm2})", ""),
        "tor_f1_change": ("={tor_f1_other_hz}/{tor_f1_hz}-1", "в 100 раз"),
        "tor_mu": ("={tor_ring}/{tor_flywheel}", ""),
        "tor_kappa": ("=1-{tor_mu}", ""),
        "torsion_forms.tor_theta3": ("=IF(A{row}=1,1,{<torsion_forms.tor_theta3}"
         "+{<torsion_forms.tor_moment3_Nm}/{<torsion_forms.tor_c_Nm_rad})", ""),
        "torsion_forms.tor_shaft2_MPa": ("={<torsion_forms.tor_shaft3_MPa}", ""),
    },
    {
        "torsion_forms.tor_theta2": "={v}+0*{tor_f2_hz}",
        "tor_twist3": "={v}*{tor_f3_hz}/{tor_f3_hz}",
        "tor_f1_change": "=IF({tor_mu}>9,{tor_mu},{v})",
        "tor_rest1": "={v}+0*{tor_f1_hz}",  # nought for every engine, but for the last digits
    },
    {"torsion_forms.tor_whole3": "={p}+0*{torsion_forms.tor_theta3}"},
)  # fmt: skip

BEARINGS = Base(
    "d-240-bearings",
    {"bearings.pin_clearance_max_mm": {"min": 0.11, "max": 0.15, "step": 0.005},
     "regime.speed_rpm": {"min": 2000, "max": 2200, "step": 20},
     "crankshaft.pin_diameter_mm": {"min": 66.0, "max": 70.0, "step": 0.5}},
    ("oil_list", "oil_results", "safety", "safe_main", "safe_pins", "balance_orders", "beam"),
    {
        # Nought in every engine with this shaft.
        "end_x1": "=ROUND({throw1_C10}*crankshaft_nose_arm_mm/1000,1)",
        "end_x2": "=ROUND(-{throw4_C12}*crankshaft_rear_arm_mm/1000,1)",
        "balance_orders.M_order_Nm": "=m_j*r_crank*omega^2/1000*IF(A{row}=1,1,IF(A{row}=2,"
        "4*{neiman_p2},0))*SUM({cylinder_up_mm1}:{cylinder_up_mm4})",
        "balance_orders.F_left_kN": "={balance_orders.F_order_kN}"
        "*IF(A{row}=1,1-0,IF(A{row}=2,1-1,1))",  # shares that are alike for the class
        "oil_hcr_um": "=SUM(bearings_journal_roughness_um,bearings_shell_roughness_um)"
        "+bearings_form_um",
        "oil_vogel": "=LN({oil_eta40}/{oil_eta100})*135*195/60",
        "oil_hmin1_um": "={oil_gap1_mm}*(1-{oil_chi1})*500",
        "oil_K1": "=500*{oil_gap1_mm}*(1-{oil_chi1})/{oil_hcr_um}",
        "safe_pin_W1_cm3": "=PI()*crankshaft_pin_diameter_mm^3/16000",  # solid
        "safe_pin_a1_MPa": "=(MAX({|P4_5s.Mpins1_Nm})-MIN({|P4_5s.Mpins1_Nm}))"
        "/(2*{safe_pin_W1_cm3})",
        "safe_n_hole": "={safe_n_bend_hole}*{safe_n_turn_hole}"
        "/SQRT({safe_n_bend_hole}^2+{safe_n_turn_hole}^2)",
        "safe_n_pin": "=IF({safe_n_hole}<{safe_n_fillet},{safe_n_hole},{safe_n_fillet})",
    },
    {
        "oil_hcr_um": ("=bearings_journal_roughness_um+bearings_shell_roughness_um", "слагаемое"),
        "oil_vogel": ("=LOG10({oil_eta40}/{oil_eta100})/(1/135-1/195)", ""),
        "oil_hmin1_um": ("={oil_gap1_mm}*1000*(1-{oil_chi1})", ""),
        "oil_K1": ("={oil_hcr_um}/{oil_hmin1_um}", ""),
        "oil_hot1_C": ("=60*{oil_friction1_W}/(bearings_density_kg_m3*bearings_heat_j_kg_k"
         "*{oil_through1_l_min})", ""),
        "safe_n_turn_hole": ("={safe_pin_hole1}", ""),
        "safe_pin_a1_MPa": ("=MAX({|P4_5s.Mpins1_Nm})/(2*{safe_pin_W1_cm3})", "слагаемое min(M"),
        "safe_pin_W1_cm3": ("=PI()*crankshaft_pin_diameter_mm^3/32000", ""),
        "safe_n_hole": ("=({safe_n_bend_hole}+{safe_n_turn_hole})/2", ""),
        "safe_n_pin": ("=MAX({safe_n_hole},{safe_n_fillet})", ""),
        "safe_main_weakest": ("={v}-2", None),  # a journal's number: it may come of anything
    },
    {
        "oil_hcr_um": "={v}*{oil_eta40}/{oil_eta40}",
        "safe_n_fillet": "=IF({safe_n_hole}>0,{v},0)",
        "safe_sigma_a_MPa": "=SUM({v},0*{safe_pin_W1_cm3})",
    },
    {"safe_n_bend_hole": "={p}", "safe_n_hole": "={p}*{safe_n_bend_hole}/{safe_n_bend_hole}"},
)  # fmt: skip

CYCLE = Base(
    "cycle-tractor-diesel",
    {"cycle.power_kw": {"min": 55, "max": 65, "step": 1},
     "cycle.excess_air": {"min": 1.4, "max": 1.7, "step": 0.05}},
    ("cycle_charge", "cycle_compression", "cycle_content", "cycle_combustion", "cycle_expansion",
     "cycle_indicated", "cycle_effective", "speed_law", "cycle_diagram", "speed"),
    {
        "cyc_p_c": "={cyc_p_a}*POWER(geometry_compression_ratio,{cyc_n1})",
        "cyc_T_c": "={cyc_T_a}*EXP(({cyc_n1}-1)*LN(geometry_compression_ratio))",
        "cyc_mu": "=1+({cyc_mu0}-1)/(1+{cyc_gamma})",
        "cyc_T_z": "={cyc_t_root}+273",
        "cyc_p_b": "={cyc_p_z}*{cyc_delta}^-{cyc_n2}",
        "cyc_p_e": "={cyc_p_i}*regime_mechanical_efficiency",
        "cyc_g_e": "=3600/({cyc_eta_e}*{cyc_Hu})",
        "cyc_N_e": "={cyc_N_i}*{cyc_eta_m}",
        "cyc_M_e": "=9550*{cyc_N_e}/regime_speed_rpm",
        "spd_Kc": "=cycle_torque_speed_rpm/regime_speed_rpm",
        "spd_K": "=cycle_adaptability",
        "cycle_diagram.cd_V_dm3": "={cycle_diagram.cd_ratio}*{V_c}",
        "cycle_diagram.cd_p_MPa": "=IF(A{row}<360,{cyc_p_c}/{cycle_diagram.cd_ratio}^{cyc_n1},"
        "IF({cycle_diagram.cd_ratio}<={cyc_rho},{cyc_p_z},"
        "{cyc_p_z}*({cyc_rho}/{cycle_diagram.cd_ratio})^{cyc_n2}))",
        "speed.speed_Ne": "={speed.speed_Me}*{speed.speed_n}/9550",
    },
    {
        "cyc_p_b": ("={cyc_p_z}/{cyc_delta}^({cyc_n2}-1)", "степени на единицу меньше"),
        "cyc_g_i": ("=3600*{cyc_eta_v}*{cyc_p_k}/(8.315*{cyc_T_k}*{cyc_M1}*{cyc_p_i})", "1000 раз"),
        "cyc_M_e": ("={cyc_N_e}/(PI()*regime_speed_rpm/30)", "1000 раз"),
        "cyc_N_error": ("={cyc_N_e}/cycle_power_kw-1", "в 100 раз"),
        "cycle_diagram.cd_T_K": ("={cyc_T_c}/{cycle_diagram.cd_ratio}^{cyc_n1}", None),
        "speed.speed_n": ("=regime_speed_rpm*{speed.speed_percent}", "в 100 раз"),
        "speed.speed_Gf": ("={speed.speed_ge}*{speed.speed_Ne}", "1000 раз"),
    },
    {
        "cyc_eta_v": "={v}*{cyc_T_x}/{cyc_T_x}",
        "cycle_diagram.cd_p_MPa": "=IF({cycle_diagram.cd_ratio}>99,1,{v})",
    },
    {"speed.speed_Me": "={p}+0*{speed.speed_n}"},
)  # fmt: skip

# Much is alike for all engines with these throws, and results in words stand beside numbers.
REGIMES = Base(
    "gots-regimes",
    {"geometry.bore_mm": {"min": 86.0, "max": 90.0, "step": 0.5},
     "regime.speed_rpm": {"min": 4200, "max": 4400, "step": 50}},
    ("geometry", "firing_orders", "regime_loads", "balance_orders"),
    {
        # A greatest moment comes again within the turn; no force has no direction.
        "balance_orders.M_order_deg": "=MOD(DEGREES(ATAN2({balance_orders.arm_cos_mm}+1E-12,"
        "{balance_orders.arm_sin_mm})),360)/A{row}-360/A{row}",
        "balance_orders.F_order_deg": "=DEGREES(ATAN2({balance_orders.order_cos}+1E-12,"
        "{balance_orders.order_sin}))/A{row}",
        "firing_orders.theta3_deg": "=MOD(720-throw_angle_3_deg,360)-720"
        "+360*MOD(INT((A{row}-1)/2),2)",
        "firing_orders.first_sin": "=ROUND(SUM(SIN(RADIANS({firing_orders.theta1_deg})),"
        "SIN({firing_orders.theta2_deg}/57.3),SIN({firing_orders.theta3_deg}*3.1416/180)),9)",
        "firing_orders.half_order_sum": "=ROUND(SQRT(SUMSQ({firing_orders.half_cos},"
        "{firing_orders.half_sin})),6)",
        "governs_omega": "=INDEX('Режимы'!$C$4:$E$4,MATCH(MAX({cmp1_omega}:{cmp3_omega}),"
        "{cmp1_omega}:{cmp3_omega},0))",
    },
    {
        "cmp2_omega": ("={cmp3_omega}", ""),
        "governs_M_e": ("=regime_name_R3", ""),
        "balance_orders.M_order_deg": ("=DEGREES(ATAN2({balance_orders.arm_cos_mm}+1E-12,"
         "{balance_orders.arm_sin_mm}))", ""),
        "firing_orders.theta3_deg": ("=MOD(720-throw_angle_3_deg,360)", ""),  # whatever the row
        "firing_orders.unevenness": ("=({firing_orders.gap_max_deg}+{firing_orders.gap_min_deg})"
         "/240", ""),
    },
    {
        "firing_orders.first_cos": "=0+0*{firing_orders.theta1_deg}",
        "firing_orders.gap1_deg": "={v}+{firing_orders.theta1_deg}-{firing_orders.theta1_deg}",
        "firing_orders.place2": "=IFERROR({v}+0*SQRT({firing_orders.theta1_deg}),{v})",
        "firing_orders.order_code": "={v}+0*ACOS({firing_orders.place1}/1000)",
    },
)  # fmt: skip

ONE = Base(
    "two-stroke",
    {"regime.speed_rpm": {"min": 5000, "max": 5600, "step": 50}},
    ("scheme", "torque_orders", "crankpin", "table_14"),
    {"torque_orders.cylinders_sum": "=SIN({torque_orders.order})^2+COS({torque_orders.order})^2",
     "cyl_rank1": "=1+0*{cyl_theta1}"},
    # What a condition picks, many wrong ones pick: no cause is told.
    {"table_14.ray_XI_MPa": ("=IF(ROUND({crankpin.T_MPa}*SIN(RADIANS({pin_deg11}))"
     "-{crankpin.Krod_MPa}*COS(RADIANS({pin_deg11}))-{crankpin.Rpin_MPa}/2,9)>=0,"
     "{crankpin.Rpin_MPa},0)", None)},
    {"cyl_theta1": "=0*firing_offset_1_deg"},
)  # fmt: skip

BASES = {"cycle": CYCLE, "V6": V6, "torsion": TORSION, "bearings": BEARINGS, "regimes": REGIMES,
         "one": ONE}  # fmt: skip


@pytest.fixture(
    scope="module",
    params=[pytest.param(n, marks=pytest.mark.xdist_group(f"base {n}")) for n in BASES],
)
def base(request: pytest.FixtureRequest) -> Base:
    return BASES[request.param]


def test_honest_formulas_are_right(base):
    lines = base.marks(base.honest)
    assert {n: x["verdict"] for n, x in lines.items() if x["verdict"] != "right"} == {}


@pytest.mark.xdist_group("base V6")
def test_sines_of_the_hand_out_are_paid_like_typed_ones():
    """They were numbers that followed no angle of the student: every sum over them was wrong."""
    solved = solved_formulas(V6.assignment, Layout.of(V6.assignment.model), typed=False)
    pointed = {
        node: texts for node, texts in solved.items() if any(WAVES_SHEET in str(t) for t in texts)
    }
    assert len(pointed) > 3
    lines = V6.marked(pointed)
    assert {lines[node]["verdict"] for node in pointed if node in lines} == {"right"}


def test_mistakes_are_told_and_cost_no_other_column(base):
    lines = base.marks({node: text for node, (text, _) in base.mistakes.items()})
    for node, (_, cause) in base.mistakes.items():
        assert lines[node]["verdict"] == "wrong", node
        message = lines[node]["cause"]
        assert message == "" if cause is None else cause in message, (node, message)
    items = {lines[node]["id"] for node in base.mistakes}
    others = {x["id"]: x["verdict"] for x in lines.values() if x["id"] not in items}
    assert set(others.values()) <= {"right", "carried"}, others


def test_cheats_earn_nothing(base):
    lines = base.marks(base.cheats, base.pasted)
    cheated = {*base.cheats, *base.pasted}
    for node in cheated:
        assert lines[node]["points"] == 0, (node, lines[node]["verdict"])
    items = {lines[node]["id"] for node in cheated}
    others = {x["id"]: x["verdict"] for x in lines.values() if x["id"] not in items}
    assert set(others.values()) <= {"right"}, others


def test_a_copy_of_the_throws_may_be_honest():
    """Angles on a sheet of one's own are no less input data for being alike in all variants."""
    line = REGIMES.marks({}, {"firing_orders.theta2_deg": "={p}"})["firing_orders.theta2_deg"]
    assert (line["verdict"], line["points"]) == ("unknown", 0)
    assert "исходные данные или ответ" in line["reason"]
