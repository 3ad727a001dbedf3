"""Ilchenko: reduced inertia, rod and throw models, speed fluctuation, flywheel."""

from __future__ import annotations

from collections.abc import Iterator

from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Column, Scalar, ScalarTable, TableSpec
from reports.spec.charts import ChartSpec, columns_of, over_phi
from reports.spec.listing import column_list, scalar_list
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape
from reports.tables.loads.cylinder import cylinder_table_id

_BOTH = ", точно и приближённо"
SHEET, RESULTS, MODEL_SHEET = "Момент инерции", "Маховик", "Модель шатуна"
_STEEL = "7800"


def _moving(shape: Shape, cylinder: int) -> tuple[str, str]:
    """Reduced inertia of rod and piston at an angle, Ilchenko (6)-(10), (13), (15).

    With an offset the same by the angle β of Gots (17).
    """
    phi, beta, share = f"turn{cylinder}", f"tilt{cylinder}", "(1 - rod_x/L_rod)"
    centre = (
        f"({share}**2*cos({phi})**2/cos({beta})**2 + 1"
        f" - 2*{share}*cos({phi} + {beta})*cos({phi})/cos({beta}))"
    )
    rod = f"rod_mass*r_crank**2*{centre} + I_rod*(lam*cos({phi})/cos({beta}))**2"
    piston = f"piston_mass*r_crank**2*sin({phi})**2*(1 + lam*cos({phi})/cos({beta}))**2"
    if shape.offset:
        piston = f"piston_mass*r_crank**2*(sin({phi}) + cos({phi})*tan({beta}))**2"
    return rod, piston


def _turns(cylinder: int) -> Iterator[Column]:
    """Helper columns: angles of a cylinder's crank and rod [rad]."""
    table = cylinder_table_id(cylinder)
    phi = "phi_deg" if cylinder == 1 else f"{table}.phase_deg"
    yield Column(f"turn{cylinder}", f"rad({phi})", "угол кривошипа", helper=True)
    yield Column(f"tilt{cylinder}", f"{table}.beta_rad", "угол шатуна", helper=True)


def _table(shape: Shape, rows: tuple[float, ...]) -> TableSpec:
    phi, numbers = "rad(phi_deg)", range(1, shape.cylinders + 1)
    rod, piston = _moving(shape, 1)
    share = "((L_rod - rod_x)*cos(rad(phi_deg))**2 - L_rod)"
    near = (
        f"I_crank + lam**2*(rod_mass*{share}**2 + I_rod*cos({phi})**2)"
        f" + piston_mass*r_crank**2*sin({phi})**2*(1 + lam*cos({phi}))**2"
    )
    gas = [
        Column(
            f"Mgas{i}_Nm",
            f"of_MPa({cylinder_table_id(i)}.Pg_MPa)*F_piston*r_crank*sin(turn{i} + tilt{i})"
            f"/cos(tilt{i})",
            "Гоц (37) без сил инерции",
            helper=True,
        )
        for i in numbers
    ]
    moving = [
        Column(f"moving{i}", " + ".join(_moving(shape, i)), "Ильченко (18)", helper=True)
        for i in numbers
    ]
    step = "rad(calculation_step_deg)"

    def excess(name: str, torque: str) -> tuple[Column, Column]:
        mean = f"({torque} + following({torque}))/2 - col_mean({torque})"
        return (
            Column(f"d{name}", f"({mean})*{step}", "формула трапеций", helper=True),
            Column(f"{name}_J", f"running_sum(d{name}) - d{name}", "избыточная работа"),
        )

    d_work, work = excess("W", "Msum")
    d_gas, gas_work = excess("Wgas", "Mgas_Nm")
    return TableSpec(
        "inertia",
        "И",
        "Приведённый момент инерции и ход двигателя за цикл",
        SHEET,
        (
            *column_list(f"""
                phi_deg
                I_rod_kgm2 = {rod} | Ильченко (5)–(10)
                I_piston_kgm2 = {piston} | Ильченко (13), (15)
                I_exact_kgm2 = I_crank + I_rod_kgm2 + I_piston_kgm2 | Ильченко (18)
            """),
            *(
                ()
                if shape.offset
                else column_list(f"""
                I_approx_kgm2 = {near} | Ильченко (19), последняя масса — поршня
                I_error = (I_approx_kgm2/I_exact_kgm2 - 1)*100 | погрешность приближения
            """)
            ),
            Column(
                "I_engine_kgm2",
                f"{_cranks(shape)} + I_counterweights + "
                + " + ".join(f"moving{i}" for i in numbers),
                "сумма по цилиндрам",
            ),
            Column("Mgas_Nm", " + ".join(f"Mgas{i}_Nm" for i in numbers), "сумма по цилиндрам"),
            work,
            gas_work,
            *column_list("""
                omega_1_s = sqrt(2*((I_flywheel + I_engine_mean)*omega**2/2 + Wgas_J
                    - col_mean(Wgas_J))/(I_flywheel + I_engine_kgm2)) | закон кинетической энергии
                helpers:
                Msum of Msum_Nm = P4_2.Msum_Nm | П4.2
            """),
            d_work,
            d_gas,
            *moving,
            *gas,
            *(column for i in numbers for column in _turns(i)),
        ),
        rows,
        note=(
            "x_L отсчитан от поршневого пальца. Угловая скорость найдена по работе одних газовых "
            "сил: силы инерции входят в переменный момент инерции."
        ),
    )


def _cranks(shape: Shape) -> str:
    """Moments of inertia of all throws."""
    if not shape.own_pins:
        return f"{shape.throws}*I_crank"
    return " + ".join(["I_crank", *(f"I_crank_throw{i}" for i in range(2, shape.throws + 1))])


def _main_journals(model: InputFile, count: int) -> tuple[str, str]:
    """Mean diameter of the main journals [m] and the inertia of the mean one [kg·m²]."""
    lengths = [f"main_length_{k}_mm" for k in range(1, count + 1)]
    if model.crankshaft.main_diameters_mm is None:
        d_k, total = "of_mm(crankshaft_main_diameter_mm)", f"total({', '.join(lengths)})"
        return d_k, f"pi*{d_k}**4/32*of_mm({total})/{count}*{_STEEL}"
    sizes = [f"main_diameter_{k}_mm" for k in range(1, count + 1)]
    each = (f"of_mm({d})**4*of_mm({length})" for d, length in zip(sizes, lengths, strict=True))
    return f"(of_mm({' + '.join(sizes)})/{count})", f"pi/32*({' + '.join(each)})/{count}*{_STEEL}"


def _throw(number: int, d_k: str, parts: int) -> list[str]:
    """Lines of a throw: web's height and mass, inertia of its pin, of a web, of itself."""
    d_sh, length = f"of_mm(pin_diameter_{number}_mm)", f"of_mm(pin_length_{number}_mm)"
    end = "" if number == 1 else f"_throw{number}"
    bore = "2*sqrt(F_piston/pi)"
    high, heavy = f"web_height{end}", f"web_weight{end}"
    pins = f"I_pin{end}" if parts == 1 else f"{parts}*I_pin{end}"
    pin = f"pi*{d_sh}**4/32*{length}*{_STEEL} + pi*{d_sh}**2/4*{length}*{_STEEL}*r_crank**2"
    web = f"{heavy}/12*({high}**2 + (balance_web_width_share*{bore})**2) + {heavy}*r_crank**2/4"
    return [
        f"{high} of web_height = r_crank + {d_sh}/2 + {d_k}/2 + 1/100 | Ильченко, под (34)",
        f"{heavy} of web_weight = {high}*balance_web_width_share*balance_web_thickness_share"
        f"*({bore})**2*{_STEEL} | Ильченко, под (34)",
        f"I_pin{end} of I_pin = {pin} | Ильченко (33), d⁴",
        f"I_web{end} of I_web = {web} | Ильченко (34), толщина h",
        f"I_crank{end} of I_crank = I_main + {pins} + 2*I_web{end} | Ильченко (35)",
    ]


def _parts(model: InputFile, shape: Shape) -> ScalarTable:
    masses = model.masses
    share = "balance_rod_small_end_share"
    if masses.reciprocating_kg is not None:
        rod, centre = f"m_2/(1 - {share})", f"(1 - {share})*L_rod"
        piston = f"m_j - {share}*rod_mass"
    else:
        rod, piston = "masses_rod_kg", "masses_piston_group_kg"
        centre = (
            "of_mm(masses_rod_centre_mm)"
            if masses.rod_centre_mm is not None
            else "(1 - masses_rod_small_end_share)*L_rod"
        )
    lengths = len(model.crankshaft.main_lengths_mm)
    d_k, main = _main_journals(model, lengths)
    own = range(2, shape.throws + 1) if shape.own_pins else ()
    throws = [line for i in (1, *own) for line in _throw(i, d_k, shape.parts)]
    webs = " + ".join(f"throw{i}_weights_kg" for i in range(1, lengths))
    return ScalarTable(
        "inertia_parts",
        "Звенья одного цилиндра",
        RESULTS,
        (
            *scalar_list(f"""
                I_main = {main} | Ильченко (32), d⁴
                rod_mass = {rod} | исходные данные или m₂ и доля
                rod_x = {centre} | исходные данные или доля
            """),
            *(scalar for text in throws for scalar in scalar_list(text)),
            _rod_inertia(model),
            *scalar_list(f"""
                piston_mass = {piston} | исходные данные или m_j
                I_counterweights = ({webs} + crankshaft_nose_mass_kg
                    + crankshaft_rear_mass_kg)*r_crank**2 | массы на радиусе R
            """),
        ),
    )


def _rod_inertia(model: InputFile) -> Scalar:
    if model.masses.swing_edges_mm is not None or model.masses.rod_inertia_kg_m2 is not None:
        return Scalar("I_rod", "I_sh", "Гоц (26) или задано")
    text = "balance_rod_mass_factor*rod_mass*rod_x*(L_rod - rod_x)"
    return Scalar("I_rod", text, "две замещающие массы")


def _results(shape: Shape) -> ScalarTable:
    t = "inertia"

    def extremes(name: str, column: str, delta: str, source: str) -> list[Scalar]:
        return [
            *scalar_list(f"""
                {name}_max = col_max({t}.{column}) | {source}
                {name}_min = col_min({t}.{column}) | {source}
                {name}_mean = col_mean({t}.{column}) | {source}
                {delta} = ({name}_max - {name}_min)/({name}_max + {name}_min) | {source}
            """),
        ]

    inertia = "(I_engine_mean + I_flywheel)"
    return ScalarTable(
        "inertia_results",
        "Колебание момента инерции, неравномерность хода и маховик",
        RESULTS,
        (
            *extremes("I", "I_exact_kgm2", "delta_I", "один цилиндр"),
            *(
                ()
                if shape.offset
                else scalar_list(f"""
                I_error_max = max(col_max({t}.I_error), -col_min({t}.I_error)) | приближение
            """)
            ),
            *extremes("I_engine", "I_engine_kgm2", "delta_I_engine", "двигатель без маховика"),
            *scalar_list(f"""
                W_range = col_max({t}.W_J) - col_min({t}.W_J) | избыточная работа
                Wgas_range = col_max({t}.Wgas_J) - col_min({t}.Wgas_J) | избыточная работа
                I_flywheel = max(0, W_range/(balance_irregularity*omega**2) - I_engine_mean)
                    | δх = ΔLизб/(Iω²)
                delta_work = W_range/({inertia}*omega**2) | δх = ΔLизб/(Iω²)
                omega_max = col_max({t}.omega_1_s) | закон кинетической энергии
                omega_min = col_min({t}.omega_1_s) | закон кинетической энергии
                delta_speed = (omega_max - omega_min)/col_mean({t}.omega_1_s)
                    | закон кинетической энергии
            """),
        ),
    )


def _rod_model(rods: int) -> ScalarTable:
    """Rod from the bore: (20)-(31) with the middle of table 1's ranges."""
    area = "({h}*rm_width - (rm_width - rm_wall)*({h} - 2*rm_wall))"
    r, big = "rod_model_small", "rod_model_big"
    wide = "of_mm(pin_length_1_mm)" + (f"/{rods}" if rods > 1 else "")
    scalars = [
        *scalar_list(f"""
            rm_small_bore = 0.25*2*sqrt(F_piston/pi) | табл. 1: (0,22…0,28)D
            rm_small_outer = 1.45*rm_small_bore | табл. 1: (1,25…1,65)dн
            rm_small_length = 0.39*2*sqrt(F_piston/pi) | табл. 1: (0,33…0,45)D
            rm_least = 0.525*rm_small_outer | табл. 1: (0,5…0,55)dг
            rm_middle = 1.3*rm_least | табл. 1: (1,2…1,4)hмин
            rm_width = 0.55*rm_small_length | табл. 1: (0,5…0,6)lш
            rm_wall = min(13/4000, 3*rm_width/10, 3*rm_least/10) | табл. 1: 2,5…4 мм
            rm_cap = 0.55*of_mm(pin_diameter_1_mm) | табл. 1: (0,5…0,6)dш
            {r} = sqrt({area.format(h="rm_least")}/pi) | Ильченко (21): равная площадь
            {big} = sqrt({area.format(h="rm_middle")}/pi) | Ильченко (21): равная площадь
            rm_span = L_rod - rm_cap - rm_small_outer/2 | Ильченко, под (21)
            rm_m_small = {_STEEL}*pi*rm_small_length*((rm_small_outer/2)**2 - (rm_small_bore/2)**2)
                | Ильченко (30), lш и dн
            rm_m_big = {_STEEL}*pi*{wide}*(rm_cap**2
                - (of_mm(pin_diameter_1_mm)/2)**2) | Ильченко (30)
            rm_m_shank = {_STEEL}*pi/3*rm_span*({big}**2 + {r}**2 + {big}*{r}) | Ильченко (30)
            rod_model_mass = rm_m_small + rm_m_big + rm_m_shank | Ильченко (30)
            rm_I_small = {_STEEL}*pi/2*rm_small_length*((rm_small_outer/2)**4
                - (rm_small_bore/2)**4) | Ильченко (20)
            rm_I_big = {_STEEL}*pi/2*{wide}*(rm_cap**4
                - (of_mm(pin_diameter_1_mm)/2)**4) | Ильченко (20)
            rm_I_shank = {_STEEL}*pi/20*({big}**5 - {r}**5)*rm_span/({big} - {r})
                + {_STEEL}*pi*rm_span**3/30*({big}**2 + 6*{r}**2 + 3*{big}*{r}) | Ильченко (28)
            rm_z = rm_span*({big}**2 + 3*{r}**2 + 2*{big}*{r})/(4*({big}**2 + {r}**2 + {big}*{r}))
                | Ильченко (29)
            rod_model_centre = (rm_m_shank*(rm_cap + rm_z) + rm_m_small*L_rod)/rod_model_mass
                | Ильченко (30)
            rod_model_inertia = rm_I_big + rm_m_big*rod_model_centre**2 + rm_I_small
                + rm_m_small*(L_rod - rod_model_centre)**2 + rm_I_shank - rm_m_shank*rm_z**2
                + rm_m_shank*(rm_z + rm_cap - rod_model_centre)**2
                | Ильченко (31), центральный момент стержня и zc + h₁
        """),
    ]
    return ScalarTable(
        "rod_model",
        "Шатун по основным размерам двигателя: середины диапазонов таблицы 1",
        MODEL_SHEET,
        tuple(scalars),
        note=(
            "Стержень — усечённый конус, круги которого равны по площади двутавровым сечениям: "
            "так получены числа напечатанной формулы (21). Исправлены (22), (30), (31)."
        ),
    )


def inertia(scope: Scope) -> Part:
    """Sheets of the reduced inertia; articulated rods would need sums of their own."""
    shape = scope.shape
    if shape.articulated:
        return Part()
    table, parts = _table(shape, scope.cycle), _parts(scope.input, shape)
    return Part((table, _results(shape), parts, _rod_model(shape.rods_beside)), _charts(shape))


def _charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """Reduced inertia exact and, without an offset, approximate; excess work, speed."""
    ways = ("I_exact_kgm2",) if shape.offset else ("I_exact_kgm2", "I_approx_kgm2")
    t, one = "inertia", "Приведённый момент инерции одного цилиндра"
    return (
        over_phi("inertia_one", SHEET, one, "I, кг·м²",
                 *columns_of(t, *ways), caption=one + ("" if shape.offset else _BOTH)),
        over_phi("inertia_engine", SHEET, "Приведённый момент инерции двигателя без маховика",
                 "I, кг·м²", f"{t}.I_engine_kgm2"),
        over_phi("inertia_work", SHEET, "Избыточная работа крутящего момента", "A, Дж",
                 *columns_of(t, "W_J", "Wgas_J"), caption="Избыточная работа"),
        over_phi("inertia_speed", SHEET, "Угловая скорость за цикл", "ω, с⁻¹", f"{t}.omega_1_s",
                 caption="Угловая скорость вала за цикл", from_zero=False, levels=("omega",)),
    )  # fmt: skip
