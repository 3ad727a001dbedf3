"""One name, symbol, unit and title for every physical quantity.

Sheet headers, legends of figures, messages and documentation come from here.
``quantity(key)`` finds the quantity of a table column or a scalar; a key with
numbers (``M2_Nm``) is an instance of a family (``M#_Nm``).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import lru_cache

from kshm.nomenclature.chapters import CHAPTER_ROWS, CHAPTER_UNITS
from kshm.nomenclature.companions import COMPANION_ROWS, COMPANION_UNITS
from kshm.nomenclature.cycle import ROWS as CYCLE_ROWS
from kshm.nomenclature.cycle import UNITS as CYCLE_UNITS
from kshm.nomenclature.layouts import LAYOUT_ROWS


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of the tables: Russian label and its size in SI."""

    label: str
    si: float = 1.0


UNITS: dict[str, Unit] = {
    "": Unit(""),
    "deg": Unit("°", 0.017453292519943295),
    "rad": Unit("рад"),
    "m": Unit("м"),
    "mm": Unit("мм", 1e-3),
    "m2": Unit("м²"),
    "cm2": Unit("см²", 1e-4),
    "dm3": Unit("дм³", 1e-3),
    "m_s": Unit("м/с"),
    "m_s2": Unit("м/с²"),
    "1_s": Unit("с⁻¹"),
    "1_s2": Unit("с⁻²"),
    "rad_s": Unit("рад/с"),
    "rpm": Unit("мин⁻¹", 0.10471975511965977),
    "MPa": Unit("МПа", 1e6),
    "N": Unit("Н"),
    "kN": Unit("кН", 1e3),
    "Nm": Unit("Н·м"),
    "J": Unit("Дж"),
    "kW": Unit("кВт", 1e3),
    "kg": Unit("кг"),
    "percent": Unit("%", 0.01),
    **{key: Unit(*row) for key, row in CYCLE_UNITS.items()},
    **{key: Unit(label, si) for key, label, si in (*COMPANION_UNITS, *CHAPTER_UNITS)},
}


@dataclass(frozen=True, slots=True)
class Quantity:
    """A physical quantity as people see it.

    ``symbol`` is plain text, ``tex`` the formula symbol, ``unit`` a key of
    ``UNITS``, ``title`` the Russian name, ``fmt`` the number format of the sheets.
    """

    key: str
    symbol: str
    tex: str
    unit: str
    title: str
    fmt: str = "0.000"

    @property
    def unit_label(self) -> str:
        """Unit as printed, empty for a pure number."""
        return UNITS[self.unit].label

    @property
    def si(self) -> float:
        """SI value of one unit of the tables."""
        return UNITS[self.unit].si

    @property
    def header(self) -> str:
        """Column header: symbol with unit."""
        return f"{self.symbol}, {self.unit_label}" if self.unit_label else self.symbol


_ROWS: tuple[tuple[str, str, str, str, str, str], ...] = (
    # key, symbol, tex, unit, title, format
    ("phi_deg", "φ", r"\varphi", "deg", "угол поворота коленчатого вала", "0"),
    ("phase_deg", "φц", r"\varphi_{\mathrm{ц}}", "deg", "угол в цикле цилиндра", "0"),
    ("phase#_deg", "φц#", r"\varphi_{\mathrm{ц}#}", "deg", "угол в цикле цилиндра #", "0"),
    ("s1_mm", "sп1", r"s_{\mathrm{п}1}", "mm", "перемещение поршня первого порядка", "0.000"),
    ("s2_mm", "sп2", r"s_{\mathrm{п}2}", "mm", "перемещение поршня второго порядка", "0.000"),
    ("s_mm", "sп", r"s_{\mathrm{п}}", "mm", "перемещение поршня", "0.000"),
    ("v1_m_s", "vп1", r"v_{\mathrm{п}1}", "m_s", "скорость поршня первого порядка", "0.00"),
    ("v2_m_s", "vп2", r"v_{\mathrm{п}2}", "m_s", "скорость поршня второго порядка", "0.00"),
    ("v_m_s", "vп", r"v_{\mathrm{п}}", "m_s", "скорость поршня", "0.00"),
    ("j1_m_s2", "jп1", r"j_{\mathrm{п}1}", "m_s2", "ускорение поршня первого порядка", "0"),
    ("j2_m_s2", "jп2", r"j_{\mathrm{п}2}", "m_s2", "ускорение поршня второго порядка", "0"),
    ("j_m_s2", "jп", r"j_{\mathrm{п}}", "m_s2", "ускорение поршня", "0"),
    ("beta_rad", "β", r"\beta", "rad", "угол отклонения шатуна", "0.0000"),
    ("omega_rod_exact_1_s", "ωш (точно)", r"\omega_{\mathrm{ш}}", "1_s",
     "угловая скорость шатуна, точно", "0.00"),
    ("omega_rod_approx_1_s", "ωш (приближённо)", r"\omega'_{\mathrm{ш}}", "1_s",
     "угловая скорость шатуна, приближённо", "0.00"),
    ("eps_rod_exact_1_s2", "εш (точно)", r"\varepsilon_{\mathrm{ш}}", "1_s2",
     "угловое ускорение шатуна, точно", "0"),
    ("eps_rod_approx_1_s2", "εш (приближённо)", r"\varepsilon'_{\mathrm{ш}}", "1_s2",
     "угловое ускорение шатуна, приближённо", "0"),
    ("x_exact_mm", "s точное", r"s", "mm", "перемещение поршня по точной формуле", "0.000"),
    ("volume_ratio", "V/Vc", r"V/V_c", "", "объём цилиндра, отнесённый к объёму камеры", "0.0000"),
    ("volume_dm3", "V", r"V", "dm3", "объём цилиндра", "0.0000"),
    ("p_MPa", "pг", r"p_{\mathrm{г}}", "MPa", "абсолютное давление газов", "0.0000"),
    ("Pg_MPa", "p′г", r"p'_{\mathrm{г}}", "MPa", "удельная сила давления газов", "0.000"),
    ("Pj_MPa", "p′j", r"p'_{j}", "MPa", "удельная сила инерции", "0.000"),
    ("Ps_MPa", "p′s", r"p'_{s}", "MPa", "удельная суммарная сила", "0.000"),
    ("N_MPa", "Nуд", r"N_{\mathrm{уд}}", "MPa", "удельная боковая сила", "0.000"),
    ("S_MPa", "Sуд", r"S_{\mathrm{уд}}", "MPa", "удельная сила вдоль шатуна", "0.000"),
    ("T_MPa", "Tуд", r"T_{\mathrm{уд}}", "MPa", "удельная тангенциальная сила", "0.000"),
    ("K_MPa", "Kуд", r"K_{\mathrm{уд}}", "MPa", "удельная нормальная сила", "0.000"),
    ("M_Nm", "Mкр", r"M_{\mathrm{кр}}", "Nm", "крутящий момент цилиндра", "0"),
    ("Mopr_Nm", "Mопр", r"M_{\mathrm{опр}}", "Nm", "опрокидывающий момент цилиндра", "0"),
    ("M#_Nm", "M#ц", r"M_{#\mathrm{ц}}", "Nm", "крутящий момент цилиндра #", "0"),
    ("Msum_Nm", "Mкр = ΣMц", r"M_{\mathrm{кр}}", "Nm", "суммарный крутящий момент", "0"),
    ("Mmain#_Nm", "Mк.ш#", r"M_{\mathrm{к.ш}#}", "Nm",
     "набегающий момент на коренную шейку #", "0"),
    ("Mpin#_Nm", "Mш.ш#", r"M_{\mathrm{ш.ш}#}", "Nm",
     "набегающий момент на шатунную шейку #", "0.0"),
    ("Mpins#_Nm", "Mш.ш# по статике", r"M^{\mathrm{ст}}_{\mathrm{ш.ш}#}", "Nm",
     "момент в сечении шатунной шейки # по статике", "0.0"),
    ("Krod_MPa", "K − Kr ш", r"K'_{\mathrm{ш}}", "MPa",
     "нормальная сила с центробежной силой шатуна", "0.000"),
    ("Rpin_MPa", "R′ш.ш", r"R'_{\mathrm{ш.ш}}", "MPa", "удельная нагрузка на шатунную шейку", "0.000"),
    ("psi_deg", "ψ", r"\psi", "deg", "угол вектора нагрузки от плоскости колена", "0.0"),
    ("Ksum_MPa", "KΣ", r"K_{\Sigma}", "MPa", "нормальная сила с центробежными силами колена", "0.000"),
    ("Rthrow_MPa", "R′к", r"R'_{\mathrm{к}}", "MPa", "удельная сила, действующая на колено", "0.000"),
    ("aT_MPa", "AT(i)", r"A_{T}", "MPa", "реакция правой опоры колена i поперёк плоскости колена", "0.000"),
    ("aTcos_MPa", "AT·cosγ(i)", r"A_{T}\cos\gamma", "MPa", "её проекция на ось x", "0.000"),
    ("aTsin_MPa", "AT·sinγ(i)", r"A_{T}\sin\gamma", "MPa", "её проекция на ось y", "0.000"),
    ("aK_MPa", "AK(i)", r"A_{K}", "MPa", "реакция правой опоры колена i в плоскости колена", "0.000"),
    ("aKcos_MPa", "AK·cosγ(i)", r"A_{K}\cos\gamma", "MPa", "её проекция на ось y", "0.000"),
    ("aKsin_MPa", "AK·sinγ(i)", r"A_{K}\sin\gamma", "MPa", "её проекция на ось x с обратным знаком", "0.000"),
    ("bT_MPa", "AT(i+1)", r"B_{T}", "MPa", "реакция левой опоры колена i + 1 поперёк плоскости колена", "0.000"),
    ("bTcos_MPa", "AT·cosγ(i+1)", r"B_{T}\cos\gamma", "MPa", "её проекция на ось x", "0.000"),
    ("bTsin_MPa", "AT·sinγ(i+1)", r"B_{T}\sin\gamma", "MPa", "её проекция на ось y", "0.000"),
    ("bK_MPa", "AK(i+1)", r"B_{K}", "MPa", "реакция левой опоры колена i + 1 в плоскости колена", "0.000"),
    ("bKcos_MPa", "AK·cosγ(i+1)", r"B_{K}\cos\gamma", "MPa", "её проекция на ось y", "0.000"),
    ("bKsin_MPa", "AK·sinγ(i+1)", r"B_{K}\sin\gamma", "MPa", "её проекция на ось x с обратным знаком", "0.000"),
    ("Rx_MPa", "R′x", r"R'_{x}", "MPa", "проекция реакции на ось x", "0.000"),
    ("Ry_MPa", "R′y", r"R'_{y}", "MPa", "проекция реакции на ось y", "0.000"),
    ("R_MPa", "R′к.ш", r"R'_{\mathrm{к.ш}}", "MPa", "удельная реакция коренной опоры", "0.000"),
    ("psiR_deg", "ψR", r"\psi_{R}", "deg", "угол вектора реакции от оси y", "0.0"),
    ("block_x_MPa", "Qx", r"Q_{x}", "MPa", "нагрузка на подшипник в осях блока, влево", "0.000"),
    ("block_y_MPa", "Qy", r"Q_{y}", "MPa", "нагрузка на подшипник в осях блока, вверх", "0.000"),
)  # fmt: skip

_SCALARS: tuple[tuple[str, str, str, str, str, str], ...] = (
    ("r_crank", "r", "r", "m", "радиус кривошипа", "0.0000"),
    ("L_rod", "l", "l", "m", "длина шатуна", "0.0000"),
    ("lam", "λ", r"\lambda", "", "отношение радиуса кривошипа к длине шатуна", "0.00000"),
    ("S_stroke", "S", "S", "m", "ход поршня", "0.0000"),
    ("F_piston", "Fп", r"F_{\mathrm{п}}", "m2", "площадь поршня", "0.000000"),
    ("V_h", "Vh", "V_h", "dm3", "рабочий объём цилиндра", "0.0000"),
    ("V_c", "Vc", "V_c", "dm3", "объём камеры сгорания", "0.00000"),
    ("V_engine", "Vл", r"V_{\mathrm{л}}", "dm3", "рабочий объём двигателя", "0.000"),
    ("omega", "ω", r"\omega", "rad_s", "угловая скорость коленчатого вала", "0.00"),
    ("c_m", "cm", "c_m", "m_s", "средняя скорость поршня", "0.00"),
    ("phi_vmax_deg", "φv max", r"\varphi_{v\,\max}", "deg", "угол наибольшей скорости поршня", "0.00"),
    ("v_max", "vп max", r"v_{\mathrm{п}\,\max}", "m_s", "наибольшая скорость поршня", "0.000"),
    ("v_ratio", "vп max/cm", r"v_{\mathrm{п}\,\max}/c_m", "", "отношение наибольшей скорости к средней", "0.000"),
    ("j_tdc", "jВМТ", r"j_{\mathrm{ВМТ}}", "m_s2", "ускорение поршня в ВМТ", "0"),
    ("j_bdc", "jНМТ", r"j_{\mathrm{НМТ}}", "m_s2", "ускорение поршня в НМТ", "0"),
    ("beta_max_deg", "βmax", r"\beta_{\max}", "deg", "наибольший угол отклонения шатуна", "0.00"),
    ("m_1", "m1", "m_1", "kg", "масса шатуна на оси поршневого пальца", "0.000"),
    ("m_2", "m2", "m_2", "kg", "масса шатуна на оси шатунной шейки", "0.000"),
    ("m_j", "mj", "m_j", "kg", "возвратно-поступательно движущаяся масса", "0.000"),
    ("m_k", "mк", r"m_{\mathrm{к}}", "kg", "неуравновешенная масса колена без противовесов", "0.000"),
    ("m_r", "mr", "m_r", "kg", "вращающаяся масса", "0.000"),
    ("P_unit", "mj·r·ω²/Fп", r"m_j r\omega^2/F_{\mathrm{п}}", "MPa", "амплитуда удельной силы инерции первого порядка", "0.0000"),
    ("K_r", "Kr", "K_r", "kN", "центробежная сила вращающихся масс", "0.00"),
    ("K_r_spec", "Kr уд", r"K_{r\,\mathrm{уд}}", "MPa", "удельная центробежная сила вращающихся масс", "0.000"),
    ("K_r_rod", "K′r ш", r"K'_{r\mathrm{ш}}", "MPa", "удельная центробежная сила массы m2", "0.000"),
    ("K_r_throw", "K′r к", r"K'_{r\mathrm{к}}", "MPa", "удельная центробежная сила массы колена", "0.000"),
    ("phi_c_deg", "φc", r"\varphi_{c}", "deg", "начало видимого сгорания", "0.0"),
    ("phi_open_deg", "φв.о", r"\varphi_{\mathrm{в.о}}", "deg", "начало выпуска", "0.0"),
    ("phi_close_deg", "φв.з", r"\varphi_{\mathrm{в.з}}", "deg", "конец падения давления при выпуске", "0.0"),
    ("x_start", "Vc′/Vc", r"V_{\varphi_c}/V_c", "", "относительный объём в начале сгорания", "0.0000"),
    ("p_start", "pc′", r"p_{\varphi_c}", "MPa", "давление в начале сгорания", "0.0000"),
    ("p_c_end", "pc", "p_c", "MPa", "давление конца чистого сжатия", "0.000"),
    ("x_open", "Vв/Vc", r"V_{\mathrm{в.о}}/V_c", "", "относительный объём в начале выпуска", "0.0000"),
    ("p_open", "pв", r"p_{\mathrm{в.о}}", "MPa", "давление в начале выпуска", "0.0000"),
    ("M_mean", "Mср", r"M_{\mathrm{ср}}", "Nm", "средний индикаторный момент двигателя", "0.0"),
    ("M_max", "Mmax", r"M_{\max}", "Nm", "наибольший суммарный момент", "0"),
    ("phi_M_max_deg", "φ(Mmax)", r"\varphi_{M\max}", "deg", "угол наибольшего суммарного момента", "0"),
    ("M_min", "Mmin", r"M_{\min}", "Nm", "наименьший суммарный момент", "0"),
    ("phi_M_min_deg", "φ(Mmin)", r"\varphi_{M\min}", "deg", "угол наименьшего суммарного момента", "0"),
    ("M_e", "Me", "M_e", "Nm", "средний эффективный момент двигателя", "0.0"),
    ("N_i_calc", "Ni", "N_i", "kW", "индикаторная мощность по динамическому расчёту", "0.00"),
    ("p_i_calc", "pi", "p_i", "MPa", "среднее индикаторное давление по диаграмме", "0.0000"),
    ("T_mean", "Tср", r"T_{\mathrm{ср}}", "MPa", "средняя удельная тангенциальная сила двигателя", "0.0000"),
    ("T_ref", "T′ср", r"T'_{\mathrm{ср}}", "MPa", "она же по индикаторной мощности цикла", "0.0000"),
    ("T_error", "ΔT", r"\Delta T", "percent", "расхождение Tср и T′ср", "0.00"),
    ("Rpin_mean", "R′ш.ш ср", r"R'_{\mathrm{ш.ш\,ср}}", "MPa", "средняя удельная нагрузка на шатунную шейку", "0.000"),
    ("Rpin_max", "R′ш.ш max", r"R'_{\mathrm{ш.ш}\,\max}", "MPa", "наибольшая удельная нагрузка на шатунную шейку", "0.000"),
    ("phi_Rpin_max_deg", "φ(R′ш.ш max)", r"\varphi_{R\max}", "deg", "угол наибольшей нагрузки на шатунную шейку", "0"),
    ("Rpin_min", "R′ш.ш min", r"R'_{\mathrm{ш.ш}\,\min}", "MPa", "наименьшая удельная нагрузка на шатунную шейку", "0.000"),
    ("phi_Rpin_min_deg", "φ(R′ш.ш min)", r"\varphi_{R\min}", "deg", "угол наименьшей нагрузки на шатунную шейку", "0"),
    ("Rpin_max_kN", "Rш.ш max", r"R_{\mathrm{ш.ш}\,\max}", "kN", "наибольшая нагрузка на шатунную шейку", "0.00"),
    ("Rpin_min_kN", "Rш.ш min", r"R_{\mathrm{ш.ш}\,\min}", "kN", "наименьшая нагрузка на шатунную шейку", "0.00"),
    ("q_pin_mean", "qср", r"q_{\mathrm{ср}}", "MPa", "среднее давление на шатунную шейку", "0.00"),
    ("q_pin_max", "qmax", r"q_{\max}", "MPa", "наибольшее давление на шатунную шейку", "0.00"),
    ("Rmain#_mean", "R′к.ш# ср", r"R'_{\mathrm{к.ш}#\,\mathrm{ср}}", "MPa", "средняя удельная нагрузка на коренную шейку #", "0.000"),
    ("Rmain#_max", "R′к.ш# max", r"R'_{\mathrm{к.ш}#\,\max}", "MPa", "наибольшая удельная нагрузка на коренную шейку #", "0.000"),
    ("phi_Rmain#_max_deg", "φ(R′к.ш# max)", r"\varphi_{R\max}", "deg", "угол наибольшей нагрузки на коренную шейку #", "0"),
    ("Rmain#_min", "R′к.ш# min", r"R'_{\mathrm{к.ш}#\,\min}", "MPa", "наименьшая удельная нагрузка на коренную шейку #", "0.000"),
    ("phi_Rmain#_min_deg", "φ(R′к.ш# min)", r"\varphi_{R\min}", "deg", "угол наименьшей нагрузки на коренную шейку #", "0"),
    ("Rmain#_max_kN", "Rк.ш# max", r"R_{\mathrm{к.ш}#\,\max}", "kN", "наибольшая нагрузка на коренную шейку #", "0.00"),
    ("q_main#_mean", "qк# ср", r"q_{\mathrm{к}#\,\mathrm{ср}}", "MPa", "среднее давление на коренную шейку #", "0.00"),
    ("q_main#_max", "qк# max", r"q_{\mathrm{к}#\,\max}", "MPa", "наибольшее давление на коренную шейку #", "0.00"),
    ("dM_main#", "ΔMк.ш#", r"\Delta M_{\mathrm{к.ш}#}", "Nm", "размах набегающего момента на коренную шейку #", "0"),
    ("dM_pin#", "ΔMш.ш#", r"\Delta M_{\mathrm{ш.ш}#}", "Nm", "размах набегающего момента на шатунную шейку #", "0.0"),
    ("worst_main_torque", "№", r"k_{M}", "", "коренная шейка с наибольшим размахом набегающего момента", "0"),
    ("worst_pin_torque", "№", r"k_{M}", "", "шатунная шейка с наибольшим размахом набегающего момента", "0"),
    ("worst_main_load", "№", r"k_{R}", "", "коренная шейка с наибольшей нагрузкой", "0"),
    ("hole_pin_ray", "луч", r"n_{\mathrm{л}}", "", "наименее нагруженный луч шатунной шейки", "0"),
    ("hole_pin_deg", "αм", r"\alpha_{\mathrm{м}}", "deg", "место масляного отверстия шатунной шейки, от колена против вращения", "0"),
    ("hole_main#_ray", "луч", r"n_{\mathrm{л}#}", "", "наименее нагруженный луч коренной шейки #", "0"),
    ("hole_main#_deg", "αм к#", r"\alpha_{\mathrm{м.к}#}", "deg", "наименее нагруженное место коренной шейки #, от оси y против вращения", "0"),
)  # fmt: skip

_THROWS: tuple[tuple[str, str, str, str, str, str], ...] = (
    ("C1", "C1", "C_1", "N", "противовес левой щеки, по оси y", "0"),
    ("C2", "C2", "C_2", "N", "левая щека, по оси y", "0"),
    ("C3", "C3", "C_3", "N", "масса шатуна на шейке", "0"),
    ("C4", "C4", "C_4", "N", "шатунная шейка", "0"),
    ("C6", "C6", "C_6", "N", "правая щека, по оси y", "0"),
    ("C7", "C7", "C_7", "N", "противовес правой щеки, по оси y", "0"),
    ("C8", "C8", "C_8", "N", "противовес левой щеки, по оси x", "0"),
    ("C9", "C9", "C_9", "N", "противовес правой щеки, по оси x", "0"),
    ("C10", "C10", "C_{10}", "N", "внешний противовес на носке, по оси x", "0"),
    ("C11", "C11", "C_{11}", "N", "внешний противовес на носке, по оси y", "0"),
    ("C12", "C12", "C_{12}", "N", "внешний противовес у маховика, по оси x", "0"),
    ("C13", "C13", "C_{13}", "N", "внешний противовес у маховика, по оси y", "0"),
    ("C14", "C14", "C_{14}", "N", "левая щека, по оси x", "0"),
    ("C15", "C15", "C_{15}", "N", "правая щека, по оси x", "0"),
    ("length", "l", "l", "mm", "пролёт между серединами коренных шеек", "0.0"),
    ("share", "aп/l", r"a_{\mathrm{п}}/l", "", "доля нагрузки шатуна на правой опоре", "0.0000"),
    ("RKCP", "RKCП", r"R_{KC\mathrm{П}}", "N", "реакция правой опоры в плоскости колена", "0"),
    ("RTCP", "RTCП", r"R_{TC\mathrm{П}}", "N", "реакция правой опоры поперёк плоскости колена", "0"),
    ("RKCL", "RKCЛ", r"R_{KC\mathrm{Л}}", "N", "реакция левой опоры в плоскости колена", "0"),
    ("RTCL", "RTCЛ", r"R_{TC\mathrm{Л}}", "N", "реакция левой опоры поперёк плоскости колена", "0"),
    ("side", "Cлев", r"C_{\mathrm{лев}}", "N", "силы слева от шейки поперёк колена, против вращения", "0"),
    ("ray", "луч", "i", "", "номер луча", "0"),
    ("ray_deg", "δ", r"\delta", "deg", "угол луча против вращения", "0"),
    ("ray_sum", "ΣR", r"\Sigma R", "MPa", "сумма сил по лучу", "0.00"),
    ("ray_candidate", "№ min", "i_{min}", "", "номер луча с наименьшей суммой", "[>9000]\"\";0"),
    ("wear_x", "x", "x", "", "точка условной диаграммы износа", "0.000"),
    ("wear_y", "y", "y", "", "точка условной диаграммы износа", "0.000"),
    ("circle_x", "x0", "x_0", "", "окружность шейки", "0.000"),
    ("circle_y", "y0", "y_0", "", "окружность шейки", "0.000"),
    ("at_max_deg", "φ max", r"\varphi_{max}", "deg", "угол, если здесь наибольшее значение", "[>9000]\"\";0"),
    ("at_min_deg", "φ min", r"\varphi_{min}", "deg", "угол, если здесь наименьшее значение", "[>9000]\"\";0"),
    ("work_J", "ΔW", r"\Delta W", "J", "работа газов на шаге", "0.00"),
    ("W_cycle", "Wц", r"W_{\mathrm{ц}}", "J", "работа газов цилиндра за цикл", "0.0"),
    ("W_torque", "4πMср/i", r"4\pi M_{\mathrm{ср}}/i", "J", "работа момента цилиндра за цикл", "0.0"),
    ("box", "±R", "R", "MPa", "пределы осей полярной диаграммы", "0.000"),
    ("number", "№", "n", "", "номер", "0"),
    ("check", "итог", "", "", "итог проверки", "@"),
    ("check_value", "значение", "", "", "значение", "0.0000"),
)  # fmt: skip

_ROMAN = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X", "XI", "XII",
          "XIII", "XIV", "XV", "XVI", "XVII", "XVIII")  # fmt: skip

_ALL: dict[str, Quantity] = {
    row[0]: Quantity(*row)
    for row in (
        *_ROWS,
        *_SCALARS,
        *_THROWS,
        *COMPANION_ROWS,
        *CYCLE_ROWS,
        *CHAPTER_ROWS,
        *LAYOUT_ROWS,
    )
}


def roman(number: int) -> str:
    """Roman numeral of a ray, 1 to 18."""
    return _ROMAN[number - 1]


def ray_key(number: int) -> str:
    """Column key of a ray, counted from 1."""
    return f"ray_{roman(number)}_MPa"


@lru_cache(maxsize=1024)
def quantity(key: str) -> Quantity:
    """Quantity of a key.

    Raises:
        KeyError: nobody knows the key.
    """
    if key in _ALL:
        return _ALL[key]
    further = re.fullmatch(r"(\w+)_R(\d+)", key)
    if further is not None:  # the same quantity of a further regime
        found = quantity(further[1])
        return replace(found, key=key, title=f"{found.title}, режим {further[2]}")
    if key.startswith("throw") and "_" in key:
        return replace(_ALL[key.split("_", 1)[1]], key=key)
    if re.match(r"ray_[IVX]+_MPa", key):
        numeral = key.split("_")[1]
        return Quantity(key, numeral, rf"R_{{\mathrm{{{numeral}}}}}", "MPa",
                        f"сила по лучу {numeral}", "0.00;-0.00;")  # fmt: skip
    match = re.search(r"(?<=[a-zA-Z])\d+", key)
    if match is None:
        raise KeyError(key)
    index = match.group()
    family = _ALL[key[: match.start()] + "#" + key[match.end() :]]
    return replace(
        family,
        key=key,
        symbol=family.symbol.replace("#", index),
        tex=family.tex.replace("#", index),
        title=family.title.replace("#", index),
    )
