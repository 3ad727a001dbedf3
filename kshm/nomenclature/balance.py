"""Quantities of balancing: forces and moments by orders, shafts, firing orders."""

from __future__ import annotations

from kshm.nomenclature.digits import Row

_ORDERS = "порядки 1, 2, 4 и вращающиеся массы"
_SIDES = (("F", "kN", "силы", "F", 3), ("L", "Nm", "момента", "M", 1))

ROWS: tuple[Row, ...] = (
    ("order", "k", "k", "", "порядок", 1),
    ("order_amplitude", "ak", "a_k", "", "амплитуда гармоники ускорения, доля ω²R", 5),
    ("order_cos", "Σcos kθ", "C_k", "", "сумма косинусов фаз цилиндров", 4),
    ("order_sin", "Σsin kθ", "S_k", "", "сумма синусов фаз цилиндров", 4),
    ("order_right_cos", "Σcos kθ·sin δ", "C'_k", "", "то же по составляющим вправо, косинусы", 4),
    ("order_right_sin", "Σsin kθ·sin δ", "S'_k", "", "то же по составляющим вправо, синусы", 4),
    ("order_along", "Ak+", "A_{k+}", "", "половина суммы векторов цилиндров, вращающихся с валом", 4),
    ("order_against", "Ak−", "A_{k-}", "", "половина суммы векторов цилиндров, вращающихся против вала", 4),
    ("arm_along_mm", "Azk+", "A_{zk+}", "mm", "то же с плечами, по вращению", 2),
    ("arm_against_mm", "Azk−", "A_{zk-}", "mm", "то же с плечами, против вращения", 2),
    ("F_order_min_kN", "Fk min", r"F_{k\,\min}", "kN", "свободная сила порядка k, наименьшая величина", 4),
    ("F_order_dir_deg", "γ(Fk)", r"\gamma_{Fk}", "deg", "направление наибольшей силы от вертикали по вращению", 1),
    ("arm_right_cos_mm", "Σz cos kθ·sin δ", "C'_{zk}", "mm", "сумма плеч по составляющим вправо, косинусы", 2),
    ("arm_right_sin_mm", "Σz sin kθ·sin δ", "S'_{zk}", "mm", "сумма плеч по составляющим вправо, синусы", 2),
    ("M_order_min_Nm", "Mk min", r"M_{k\,\min}", "Nm", "свободный момент порядка k, наименьшая величина", 2),
    ("M_order_dir_deg", "γ(Mk)", r"\gamma_{Mk}", "deg", "направление наибольшего момента от вертикали по вращению", 1),
    ("F_order_kN", "Fk", "F_k", "kN", "свободная сила инерции порядка k, амплитуда", 4),
    ("F_order_deg", "φ(Fk)", r"\varphi_{Fk}", "deg", "угол вала при наибольшей силе вверх", 1),
    ("arm_cos_mm", "Σz cos kθ", r"C_{zk}", "mm", "сумма плеч цилиндров с косинусами фаз", 2),
    ("arm_sin_mm", "Σz sin kθ", r"S_{zk}", "mm", "сумма плеч цилиндров с синусами фаз", 2),
    ("M_order_Nm", "Mk", "M_k", "Nm", "свободный продольный момент порядка k, амплитуда", 2),
    ("M_order_deg", "φ(Mk)", r"\varphi_{Mk}", "deg", "угол вала при наибольшем моменте", 1),
    ("F_left_kN", "Fk ост", r"F_{k\,\mathrm{ост}}", "kN", "сила порядка k после балансирных валов", 4),
    ("M_left_Nm", "Mk ост", r"M_{k\,\mathrm{ост}}", "Nm", "момент порядка k после балансирных валов", 2),
    *(row for key, unit, what, sign, fmt in _SIDES for row in (
        *((f"{key}{n}_{unit}", f"{sign}{n}", f"{sign}_{n}", unit, f"{n}-й порядок свободной {what}".replace("свободной мом", "свободного мом"), fmt) for n in (1, 2, 4)),
        *((f"{key}{n}_right_{unit}", f"{sign}{n} вправо", rf"{sign}_{{{n}\,x}}", unit, f"{n}-й порядок {what} вправо", fmt) for n in (1, 2, 4)),
        (f"{key}right_{unit}", f"Σ{sign} вправо", rf"\Sigma {sign}_x", unit, f"горизонтальная составляющая {what}: {_ORDERS}", fmt),
        (f"{key}rot_up_{unit}", f"{sign}r верх", rf"{sign}_{{r\,y}}", unit, f"вертикальная составляющая {what} вращающихся масс", fmt),
        (f"{key}rot_right_{unit}", f"{sign}r вправо", rf"{sign}_{{r\,x}}", unit, f"горизонтальная составляющая {what} вращающихся масс", fmt),
        (f"{key}up_{unit}", f"Σ{sign} верх", rf"\Sigma {sign}_y", unit, f"вертикальная составляющая {what}: {_ORDERS}", fmt),
        (f"{key}up_after_{unit}", f"Σ{sign} верх ост", rf"\Sigma {sign}'_y", unit, f"вертикальная составляющая {what} после уравновешивания: {_ORDERS}", fmt),
        (f"{key}right_after_{unit}", f"Σ{sign} вправо ост", rf"\Sigma {sign}'_x", unit, f"горизонтальная составляющая {what} после уравновешивания: {_ORDERS}", fmt),
        (f"{key}rot_bare", f"{sign}r без противовесов", rf"{sign}_{{r0}}", unit, f"величина {what} вращающихся масс без противовесов", fmt),
        (f"{key}rot", f"{sign}r", f"{sign}_r", unit, f"величина {what} вращающихся масс с противовесами", fmt),
        *(row for name, when in (("before", "до уравновешивания"), ("after", "после уравновешивания")) for row in (
            (f"{key}1_{name}_max", f"{sign}1 max", rf"{sign}_{{1\,\max}}", unit, f"наибольшая величина {what} 1-го порядка и вращающихся масс {when}", fmt),
            (f"{key}1_{name}_min", f"{sign}1 min", rf"{sign}_{{1\,\min}}", unit, f"наименьшая величина {what} 1-го порядка и вращающихся масс {when}", fmt),
            (f"{key}1_{name}_deg", f"γ({sign}1)", rf"\gamma_{{{sign}1}}", "deg", f"направление наибольшей величины {what} от вертикали по вращению {when}", 1),
            (f"{key}1_{name}_along", f"{sign}1 по вращению", rf"{sign}_{{1+}}", unit, f"вектор {what} 1-го порядка, вращающийся с валом, {when}", fmt),
            (f"{key}1_{name}_against", f"{sign}1 против вращения", rf"{sign}_{{1-}}", unit, f"вектор {what} 1-го порядка, вращающийся против вала, {when}", fmt),
            (f"{key}1_{name}_re", f"Re {sign}1", rf"\mathrm{{Re}}\,{sign}_{{1+}}", unit, f"его составляющая вдоль колена 1 при φ = 0 {when}", fmt),
            (f"{key}1_{name}_im", f"Im {sign}1", rf"\mathrm{{Im}}\,{sign}_{{1+}}", unit, f"его составляющая поперёк колена 1 при φ = 0 {when}", fmt),
        )),
        (f"{key}rot_re", f"{sign}r вдоль", rf"{sign}_{{r\parallel}}", unit, f"составляющая {what} вращающихся масс вдоль колена 1", fmt),
        (f"{key}rot_im", f"{sign}r поперёк", rf"{sign}_{{r\perp}}", unit, f"составляющая {what} вращающихся масс поперёк колена 1 по вращению", fmt),
        (f"{key}cw_re", f"{sign}п вдоль", rf"{sign}_{{\mathrm{{п}}\parallel}}", unit, f"составляющая {what} масс mj против всех колен вдоль колена 1", fmt),
        (f"{key}cw_im", f"{sign}п поперёк", rf"{sign}_{{\mathrm{{п}}\perp}}", unit, f"составляющая {what} масс mj против всех колен поперёк колена 1", fmt),
    )),
    ("z_left", "zл", r"z_{\mathrm{л}}", "mm", "левая опора колена от середины вала", 1),
    ("z_rod", "zш", r"z_{\mathrm{ш}}", "mm", "ось цилиндра от середины вала", 1),
    ("z_rod2", "zш2", r"z_{\mathrm{ш}2}", "mm", "ось второго цилиндра колена от середины вала", 1),
    *((f"{key}_{part}{bare}", f"{sign}{symbol}{short}", rf"{sign}_{{{tex}}}", unit, f"{title} вращающихся масс колена {words}{long}", fmt)
      for key, unit, title, sign, fmt in (("F", "N", "сила", "F", 0), ("L", "Nm", "момент", "M", 2))
      for part, symbol, tex, words in (("up", " вдоль", r"\parallel", "вдоль колена"), ("side", " поперёк", r"\perp", "поперёк колена против вращения"))
      for bare, short, long in (("", "", " с противовесами"), ("_bare", " без пр.", " без противовесов"))),
    ("Pj_unit_kN", "mj·r·ω²", r"m_j r\omega^2", "kN", "амплитуда силы инерции первого порядка цилиндра", 3),
    ("counterweight_needed", "mпр", r"m_{\mathrm{пр}}", "kg", "масса противовесов колена на радиусе кривошипа для выбранной доли", 3),
    ("counterweight_web", "mпр щ", r"m_{\mathrm{пр.щ}}", "kg", "то же на одну щёку", 3),
    *((f"shaft{n}_moment", f"mбe{n}", rf"m_{{\mathrm{{б}}{n}}}e", "kgm", f"произведение массы на эксцентриситет груза каждого вала пары {n}-го порядка", 5) for n in (1, 2)),
    *((f"shaft{n}_mass", f"mб{n}", rf"m_{{\mathrm{{б}}{n}}}", "kg", f"масса груза каждого вала пары {n}-го порядка", 3) for n in (1, 2)),
    *((f"shaft{n}_back_moment", f"mбe{n}−", rf"m_{{\mathrm{{б}}{n}-}}e", "kgm", f"то же вала {n}-го порядка, вращающегося против вала двигателя", 5) for n in (1, 2)),
    *((f"shaft{n}_back_mass", f"mб{n}−", rf"m_{{\mathrm{{б}}{n}-}}", "kg", f"масса груза вала {n}-го порядка, вращающегося против вала двигателя", 3) for n in (1, 2)),
    ("variant", "№", "n", "", "порядок работы", 0),
    ("theta#_deg", "θ#", r"\theta_{#}", "deg", "начало рабочего хода цилиндра #", 0),
    ("order_code", "порядок", "n", "", "порядок работы, номера цилиндров подряд", 0),
    ("gap_max_deg", "Δθ max", r"\Delta\theta_{\max}", "deg", "наибольший промежуток между рабочими ходами", 0),
    ("gap_min_deg", "Δθ min", r"\Delta\theta_{\min}", "deg", "наименьший промежуток между рабочими ходами", 0),
    ("unevenness", "(Δmax − Δmin)/Δср", r"\Delta", "", "неравномерность чередования рабочих ходов", 3),
    ("half_order_sum", "Σ(0,5)", r"\Sigma_{0{,}5}", "", "векторная сумма моментов порядка 0,5", 3),
    ("Rorder_max_kN", "Rк.ш max", r"R_{\mathrm{к.ш}\,\max}", "kN", "наибольшая нагрузка коренных шеек", 2),
    ("after_x#_MPa", "Bx#", r"B_{x#}", "MPa", "реакция от колена за шейкой #, вдоль x", 3),
    ("after_y#_MPa", "By#", r"B_{y#}", "MPa", "реакция от колена за шейкой #, вдоль y", 3),
    ("Rturned#_MPa", "R′#", r"R'_{#}", "MPa", "нагрузка шейки #, если колено за ней работает оборотом позже", 3),
    ("first_order_sum", "Σ(1)", r"\Sigma_1", "", "векторная сумма моментов порядка 1", 3),
)  # fmt: skip

UNITS = (("kgm", "кг·м", 1.0),)
