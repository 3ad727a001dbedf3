"""Charts of the workbook: figures 41-57 of the textbook, p-V and p-φ."""

from __future__ import annotations

from reports.spec.blocks import ChartSpec, Series
from reports.spec.shape import Shape
from reports.tables.motion.offset import offset_charts

PHI = "φ, ° ПКВ"


def _over_phi(
    chart_id: str, figure: str, sheet: str, title: str, y_title: str, *columns: str
) -> ChartSpec:
    table = columns[0].split(".")[0]
    series = tuple(Series(f"{table}.phi_deg", column) for column in columns)
    return ChartSpec(chart_id, sheet, title, "line", series, PHI, y_title, figure)


def _columns(table: str, *keys: str) -> tuple[str, ...]:
    return tuple(f"{table}.{key}" for key in keys)


def charts(shape: Shape) -> tuple[ChartSpec, ...]:
    """All charts of the book's figures for an engine of this shape."""
    throws = shape.throws
    journals = range(1, throws + 2)
    pv = Series("gas.volume_dm3", "gas.p_MPa", "p")
    return (
        ChartSpec("pv", "Газы", "Индикаторная диаграмма p–V", "line", (pv,), "V, дм³", "p, МПа", "22"),
        _over_phi("p_phi", "22", "Газы", "Развёрнутая индикаторная диаграмма", "p, МПа", "gas.p_MPa"),
        _over_phi("fig41", "41", "П3.1", "Перемещение поршня", "s, мм", *_columns("P3_1", "s_mm", "s1_mm", "s2_mm")),
        _over_phi("fig42", "42", "П3.1", "Скорость поршня", "v, м/с", *_columns("P3_1", "v_m_s", "v1_m_s", "v2_m_s")),
        _over_phi("fig43", "43", "П3.1", "Ускорение поршня", "j, м/с²", *_columns("P3_1", "j_m_s2", "j1_m_s2", "j2_m_s2")),
        _over_phi("fig44", "44", "П3.2", "Угловое перемещение шатуна", "β, рад", "P3_2.beta_rad"),
        _over_phi("fig45a", "45", "П3.2", "Угловая скорость качания шатуна", "ω, с⁻¹", *_columns("P3_2", "omega_rod_exact_1_s", "omega_rod_approx_1_s")),
        _over_phi("fig45b", "45", "П3.2", "Угловое ускорение качания шатуна", "ε, с⁻²", *_columns("P3_2", "eps_rod_exact_1_s2", "eps_rod_approx_1_s2")),
        _over_phi("fig46", "46", "П4.1", "Удельные силы p′г, p′j и p′s", "p′, МПа", *_columns("P4_1", "Pg_MPa", "Pj_MPa", "Ps_MPa")),
        _over_phi("fig47", "47", "П4.1", "Удельные силы N и S", "МПа", *_columns("P4_1", "N_MPa", "S_MPa")),
        _over_phi("fig48", "48", "П4.1", "Удельные силы K и T", "МПа", *_columns("P4_1", "K_MPa", "T_MPa")),
        _over_phi("fig49", "49", "П4.2", "Индикаторный крутящий момент двигателя", "M, Н·м", "P4_2.Msum_Nm"),
        *_pins(len(shape.pins)),
        *(_polar(f"fig53_{k}", "53", f"П4.3 ({k})", f"Полярная диаграмма нагрузки на коренную шейку {k}",
                 Series(f"P4_3_{k}.Rx_MPa", f"P4_3_{k}.Ry_MPa", f"R′к.ш{k}"), "R′x, МПа (влево)", "R′y, МПа") for k in journals),
        *(_wear(f"fig54_{k}", "54", f"Износ к.ш ({k})", f"Условная диаграмма износа коренной шейки {k}", f"table_14_main_{k}_sums") for k in journals),
        *(_over_phi(f"fig55_{k}", "55", f"П4.3 ({k})", f"Нагрузка на коренную шейку {k}", "R, МПа", f"P4_3_{k}.R_MPa") for k in journals),
        *(_over_phi(f"fig56_{k}", "56", "П4.4", f"Набегающий момент на коренную шейку {k}", "M, Н·м", f"P4_4.Mmain{k}_Nm") for k in range(2, throws + 2)),
        *(_over_phi(f"fig57_{i}", "57", "П4.5", f"Набегающий момент на шатунную шейку {i}", "M, Н·м", f"P4_5.Mpin{i}_Nm") for i in range(1, throws + 1)),
        *(offset_charts() if shape.offset else ()),
    )  # fmt: skip


def _pins(count: int) -> tuple[ChartSpec, ...]:
    """Figures 50-52 of every crankpin that has loads of its own."""
    found = []
    for n in range(1, count + 1):
        end, words = ("", f" {n}") if n == 1 else (f"_{n}", f" {n}")
        name, table = words if count > 1 else "", f"crankpin{end}"
        sheet = "Шатунная шейка" if n == 1 else f"Шатунная шейка {n}"
        wear = (
            ("Износ ш.ш", "table_14_sums")
            if n == 1
            else (f"Износ ш.ш ({n})", f"table_14_pin_{n}_sums")
        )
        found += [
            _polar(
                f"fig50{end}",
                "50",
                sheet,
                f"Полярная диаграмма нагрузки на шатунную шейку{name}",
                Series(f"{table}.T_MPa", f"{table}.Krod_MPa", "R′ш.ш"),
                "T, МПа",
                "K − Kr ш, МПа (вниз — к оси вала)",
            ),
            _over_phi(
                f"fig51{end}",
                "51",
                sheet,
                f"Нагрузка на шатунную шейку{name}",
                "R, МПа",
                f"{table}.Rpin_MPa",
            ),
            _wear(
                f"fig52{end}",
                "52",
                wear[0],
                f"Условная диаграмма износа шатунной шейки{name}",
                wear[1],
            ),
        ]
    return tuple(found)  # fmt: skip


def _polar(
    chart_id: str, figure: str, sheet: str, title: str, series: Series, x: str, y: str
) -> ChartSpec:
    table = series.x.split(".", maxsplit=1)[0]
    corners = Series(f"{table}_box.box", f"{table}_box.box", "оси")
    return ChartSpec(chart_id, sheet, title, "polar", (series, corners), x, y, figure)


def _wear(chart_id: str, figure: str, sheet: str, title: str, grid: str) -> ChartSpec:
    series = (
        Series(f"{grid}.circle_x", f"{grid}.circle_y", "шейка"),
        Series(f"{grid}.wear_x", f"{grid}.wear_y", "износ"),
    )
    return ChartSpec(chart_id, sheet, title, "path", series, "", "", figure)
