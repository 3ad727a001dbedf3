"""Quantities of dimensionless motion and of its series: Segal, Neiman."""

from __future__ import annotations

from kshm.nomenclature.digits import UNLESS_UNUSED, Row, scientific

_SEGAL: tuple[Row, ...] = (
    ("alpha_deg", r"\varphi", "deg", "угол поворота коленчатого вала", 0),
    ("s_exact", r"\bar s", "", "перемещение поршня, отнесённое к r, точно", 5),
    ("s_two_term", r"\bar s'", "", "перемещение поршня, отнесённое к r, приближённо", 5),
    ("ds", r"\Delta\bar s", "", "погрешность перемещения, доля r", 5),
    ("v_exact", r"\bar v", "", "скорость поршня, отнесённая к ωr, точно", 5),
    ("v_two_term", r"\bar v'", "", "скорость поршня, отнесённая к ωr, приближённо", 5),
    ("dv", r"\Delta\bar v", "", "погрешность скорости, доля ωr", 5),
    ("j_exact", r"\bar j", "", "ускорение поршня, отнесённое к ω²r, точно", 5),
    ("j_two_term", r"\bar j'", "", "ускорение поршня, отнесённое к ω²r, приближённо", 5),
    ("dj", r"\Delta\bar j", "", "погрешность ускорения, доля ω²r", 5),
    ("at_error_deg", r"\varphi_{\max}", "deg", "угол, если здесь наибольшая погрешность", UNLESS_UNUSED),
    ("ds_max", r"\Delta\bar s_{\max}", "", "наибольшая погрешность перемещения, доля r", 5),
    ("alpha_ds_deg", r"\varphi_{\Delta s}", "deg", "угол наибольшей погрешности перемещения", 0),
    ("dv_max", r"\Delta\bar v_{\max}", "", "наибольшая погрешность скорости, доля ωr", 5),
    ("alpha_dv_deg", r"\varphi_{\Delta v}", "deg", "угол наибольшей погрешности скорости", 0),
    ("dj_max", r"\Delta\bar j_{\max}", "", "наибольшая погрешность ускорения, доля ω²r", 5),
    ("alpha_dj_deg", r"\varphi_{\Delta j}", "deg", "угол наибольшей погрешности ускорения", 0),
    ("s_error_quarter", r"\delta_s", "percent", "относительная погрешность перемещения при 90°", 2),
    ("j_error_quarter", r"\delta_j", "percent", "относительная погрешность ускорения при 90°", 2),
    ("s_given", r"\bar s", "", "заданное перемещение поршня, отнесённое к r", 1),
    ("alpha_quadratic_deg", r"\varphi_{\mathrm{кв}}", "deg", "угол по квадратному уравнению", 3),
    ("alpha_small_deg", r"\varphi_{\mathrm{мал}}", "deg", "угол по формуле для малых s", 3),
    ("alpha_exact_deg", r"\varphi_{\mathrm{точн}}", "deg", "угол поворота кривошипа, точно", 3),
    ("dalpha_quadratic_deg", r"\Delta\varphi_{\mathrm{кв}}", "deg", "погрешность квадратного уравнения", 3),
    ("dalpha_small_deg", r"\Delta\varphi_{\mathrm{мал}}", "deg", "погрешность формулы для малых s", 3),
    ("j_rel_tdc", r"\bar j_{\mathrm{ВМТ}}", "", "ускорение в ВМТ, отнесённое к ω²r", 4),
    ("j_rel_bdc", r"\bar j_{\mathrm{НМТ}}", "", "ускорение в НМТ, отнесённое к ω²r", 4),
    ("j_rel_quarter", r"\bar j_{90}", "", "ускорение при 90°, отнесённое к ω²r, точно", 4),
    ("j_two_term_min", r"\bar j'_{\min}", "", "наименьшее приближённое ускорение, отнесённое к ω²r", 4),
    ("alpha_j_two_term_min_deg", r"\varphi_{j'\min}", "deg", "угол наименьшего приближённого ускорения", 2),
    ("j_exact_min", r"\bar j_{\min}", "", "наименьшее точное ускорение, отнесённое к ω²r", 4),
    ("alpha_j_exact_min_deg", r"\varphi_{j\min}", "deg", "угол наименьшего точного ускорения", 2),
    ("cos_j_min", r"\cos\varphi", "", "приближение к корню dj/dφ = 0", 6),
)  # fmt: skip


_NEIMAN: tuple[Row, ...] = (
    ("root", r"\cos\beta/\lambda", "", "проекция шатуна на ось цилиндра, отнесённая к r", 5),
    ("neiman_k", r"k_s", "", "постоянная ряда перемещения при λ двигателя", 6),
    *((f"neiman_p{n}", f"p_{{{n}}}", "", f"коэффициент гармоники {n} при λ двигателя", scientific(4)) for n in range(2, 13, 2)),
    *((f"{letter}_order{n}", f"{letter}_{{({n})}}", "", f"гармоника {n} {title}", 5)
      for letter, title in (("s", "перемещения"), ("v", "скорости"), ("j", "ускорения")) for n in (1, 2, 4, 6)),
    *((f"{letter}_series", rf"\Sigma {letter}", "", f"ряд {title} до восьмого порядка", 5)
      for letter, title in (("s", "перемещения"), ("v", "скорости"), ("j", "ускорения"))),
    *((f"{letter}_series_error", rf"\Delta {letter}_{{\Sigma}}", "",
       f"наибольшая погрешность ряда {title} до восьмого порядка", scientific(1))
      for letter, title in (("s", "перемещения"), ("v", "скорости"), ("j", "ускорения"))),
    ("rod_speed_rel", r"\omega_L/\omega", "", "угловая скорость шатуна, отнесённая к ω", 4),
    ("rod_acceleration_rel", r"\Theta_L/\omega^2", "", "угловое ускорение шатуна, отнесённое к ω²", 4),
    ("rod_on_pin_rel", r"\dot\Phi/\omega", "", "угловая скорость шатуна на шатунной шейке, отнесённая к ω", 4),
)  # fmt: skip


ROWS: tuple[Row, ...] = (*_SEGAL, *_NEIMAN)
