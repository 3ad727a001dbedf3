"""Every bad input is refused with one Russian line per error, asserted in full."""

import pytest

GONE = object()
BORE = "допустимо от 10 до 1500 мм"
MASS_ADVICE = (
    "задайте либо reciprocating_kg и rod_big_end_kg, "
    "либо piston_group_kg, rod_kg и одно из rod_centre_mm, rod_small_end_share"
)
MORE_WAYS = "; ещё способы: взвешивание, качания, оценка estimate_fuel"
TABLE = [[0, 0.1], [180, 0.1], [360, 8], [720, 0.1]]


def put(data, path, value):
    *parents, last = path.split(".")
    for part in parents:
        data = data[int(part) if part.isdecimal() else part]
    last = int(last) if last.isdecimal() else last
    if value is GONE:
        del data[last]
    else:
        data[last] = value


CASES = {
    "text for number": (
        {"geometry.bore_mm": "88,0 мм"},
        "geometry.bore_mm: нужно число, а задано: строка «88,0 мм»; напишите одно число: 88.0",
    ),
    "bool for number": (
        {"geometry.bore_mm": True},
        f"geometry.bore_mm: нужно число, а задано: логическое значение true; {BORE}",
    ),
    "list for number": (
        {"geometry.bore_mm": [88]},
        f"geometry.bore_mm: нужно число, а задано: список; {BORE}",
    ),
    "number for text": (
        {"report.variant": 7},
        "report.variant: нужна строка в кавычках, а задано: число 7",
    ),
    "number for section": (
        {"regime": 5},
        "regime: нужен раздел [regime], а задано: число",
    ),
    "half a cylinder": (
        {"engine.cylinders": 3.5},
        "engine.cylinders: нужно целое число, а задано: число 3,5; допустимо от 1 до 24",
    ),
    "no cylinder": (
        {"engine.cylinders": 0},
        "engine.cylinders: значение 0 вне допустимых пределов; допустимо от 1 до 24",
    ),
    "negative length": (
        {"geometry.bore_mm": -88},
        f"geometry.bore_mm: значение −88 вне допустимых пределов; {BORE}",
    ),
    "zero length": (
        {"geometry.rod_length_mm": 0},
        "geometry.rod_length_mm: значение 0 вне допустимых пределов; допустимо от 10 до 6000 мм",
    ),
    "nan": (
        {"regime.speed_rpm": float("nan")},
        "regime.speed_rpm: нужно конечное число, а не inf или nan; допустимо от 10 до 60000 мин⁻¹",
    ),
    "inf": (
        {"geometry.bore_mm": float("inf")},
        f"geometry.bore_mm: нужно конечное число, а не inf или nan; {BORE}",
    ),
    "integer beyond float": (
        {"geometry.bore_mm": 10**400},
        f"geometry.bore_mm: нужно число, а задано: слишком большое целое число; {BORE}",
    ),
    "missing section": (
        {"regime": GONE},
        "regime: нет раздела; добавьте раздел [regime], ключи его покажет «kshm new»",
    ),
    "missing key": (
        {"geometry.bore_mm": GONE},
        f"geometry.bore_mm: обязательный ключ не задан (Диаметр цилиндра); {BORE}",
    ),
    "misspelt section": (
        {"geometri": {}, "geometry": GONE},
        "geometri: неизвестный раздел или ключ; возможно, имелся в виду [geometry]",
    ),
    "misspelt key": (
        {"geometry.bore_mm": GONE, "geometry.bore_m": 88},
        "geometry.bore_m: неизвестный ключ; возможно, имелся в виду bore_mm",
    ),
    "misspelt optional key": (
        {"geometry.crank_radius_mm": GONE, "geometry.crank_radus_mm": 47},
        "geometry.crank_radus_mm: неизвестный ключ; возможно, имелся в виду crank_radius_mm",
    ),
    "misspelt key of a web": (
        {"crankshaft.webs.2.mass_kg": GONE, "crankshaft.webs.2.mas_kg": 1},
        "crankshaft.webs[3].mas_kg: неизвестный ключ; возможно, имелся в виду mass_kg",
    ),
    "key of another section": (
        {"geometry.speed_rpm": 4400},
        "geometry.speed_rpm: неизвестный ключ; такой ключ есть в разделе [regime]",
    ),
    "key of the other source": (
        {"gas.points": []},
        "gas.points: неизвестный ключ; такой ключ есть при другом source",
    ),
    "python's name of lambda": (
        {"geometry.lambda_": 0.3},
        "geometry.lambda_: неизвестный ключ; возможно, имелся в виду lambda",
    ),
    "true for one": (
        {"calculation.step_deg": True},
        "calculation.step_deg: недопустимое значение true; допустимо: 1, 2, 3, 5, 10, 15, 30",
    ),
    "unknown key": ({"geometry.zzz": 1}, "geometry.zzz: неизвестный ключ; удалите его"),
    "key with line break": (
        {"geometry.a\nb": 1},
        "geometry.a b: неизвестный ключ; удалите его",
    ),
    "rod shorter than crank": (
        {"geometry.rod_length_mm": 40},
        "geometry.rod_length_mm: λ = r/L = 1,175: шатун не длиннее кривошипа, "
        "механизм не провернётся; допустимо λ от 0,01 до 0,99",
    ),
    "lambda above one": (
        {"geometry.rod_length_mm": GONE, "geometry.lambda": 1.2},
        "geometry.lambda: значение 1,2 вне допустимых пределов; допустимо от 0,01 до 0,99",
    ),
    "three that disagree": (
        {"geometry.lambda": 0.32},
        "geometry.lambda: λ = 0,32 не согласуется с r/L = 0,317568; оставьте любые два из r, L, λ",
    ),
    "stroke that disagrees": (
        {"geometry.stroke_mm": 95},
        "geometry.stroke_mm: ход 95 мм не равен 2r = 94 мм; оставьте один из двух ключей",
    ),
    "one of three": (
        {"geometry.rod_length_mm": GONE},
        "geometry: размеров недостаточно: нужны любые два из crank_radius_mm "
        "(или stroke_mm), rod_length_mm, lambda; добавьте недостающий ключ",
    ),
    "offsets not one per cylinder": (
        {"crankshaft.firing_offsets_deg": [0, 240]},
        "crankshaft.firing_offsets_deg: записей 2, а нужно 3; по одному на цилиндр, цилиндров 3",
    ),
    "first offset not zero": (
        {"crankshaft.firing_offsets_deg.0": 10},
        "crankshaft.firing_offsets_deg[1]: первое значение 10°, а нужно 0; "
        "углы отсчитываются от первого цилиндра",
    ),
    "throw against offset": (
        {"crankshaft.throw_angles_deg.1": 121},
        "crankshaft.throw_angles_deg[2]: угол колена 121° не соответствует началу "
        "рабочего хода 240° (firing_offsets_deg[2]); по γ = −θ (mod 360) нужно 120°",
    ),
    "too few arms": (
        {"crankshaft.arms.2": GONE},
        "crankshaft.arms: записей 2, а нужно 3; по одной записи на колено, цилиндров 3",
    ),
    "too few webs": (
        {"crankshaft.webs.5": GONE},
        "crankshaft.webs: записей 5, а нужно 6; по две щеки на колено, цилиндров 3",
    ),
    "too few journals": (
        {"crankshaft.main_lengths_mm.3": GONE},
        "crankshaft.main_lengths_mm: записей 3, а нужно 4; "
        "на одну шейку больше, чем колен, цилиндров 3",
    ),
    "force offsets of wrong count": (
        {"crankshaft.force_offsets_deg": [0]},
        "crankshaft.force_offsets_deg: записей 1, а нужно 3; по одному на колено, цилиндров 3",
    ),
    "throw without length": (
        {"crankshaft.arms.1.l1_mm": 0, "crankshaft.arms.1.l2_mm": 0},
        "crankshaft.arms[2]: длина колена с одной стороны шатуна равна нулю (сумма плеч 64); "
        "задайте l1, l2 и l5, l6 больше нуля",
    ),
    "web is text": (
        {"crankshaft.webs.2": "a"},
        "crankshaft.webs[3]: нужна таблица ключей, а задано: строка «a»",
    ),
    "p_z below compression": (
        {"gas.max_pressure_mpa": 8.0},
        "gas.max_pressure_mpa: p_z = 8 МПа ниже давления конца сжатия 8,427 МПа (при 357°); "
        "увеличьте p_z или уменьшите p_a, ε, n_1",
    ),
    "rho below one": (
        {"gas.preexpansion_ratio": 0.9},
        "gas.preexpansion_ratio: значение 0,9 вне допустимых пределов; допустимо от 1 до 6",
    ),
    "rho above compression ratio": (
        {"geometry.compression_ratio": 2, "gas.preexpansion_ratio": 3},
        "gas.preexpansion_ratio: ρ = 3 не меньше степени сжатия 2; уменьшите ρ",
    ),
    "combustion after TDC": (
        {"gas.combustion_start_deg": GONE, "gas.ignition_delay_deg": 20},
        "gas.ignition_delay_deg: сгорание начинается при 365°, после ВМТ; "
        "допустимо не позже 360°: уменьшите задержку",
    ),
    "combustion before injection": (
        {"gas.combustion_start_deg": 300},
        "gas.combustion_start_deg: сгорание начинается при 300°, раньше впрыска; "
        "допустимо от 345 до 360°",
    ),
    "no exhaust": (
        {"gas.exhaust_start_before_bdc_deg": 0, "gas.exhaust_end_after_bdc_deg": 0},
        "gas.exhaust_end_after_bdc_deg: начало и конец выпуска совпадают; "
        "сумма углов до и после НМТ должна быть больше 0",
    ),
    "exhaust before firing": (
        {"gas.exhaust_start_before_bdc_deg": 190},
        "gas.exhaust_start_before_bdc_deg: значение 190 вне допустимых пределов; "
        "допустимо от 0 до 150°",
    ),
    "unknown source": (
        {"gas.source": "x"},
        "gas.source: недопустимое значение «x»; допустимо: polytropic, table, cycle, rounded, file",
    ),
    "no source": (
        {"gas.source": GONE},
        "gas.source: обязательный ключ не задан; "
        "допустимо: polytropic, table, cycle, rounded, file",
    ),
    "masses mixed": (
        {"masses.rod_kg": 1.7},
        f"masses: смешаны два способа задания масс; {MASS_ADVICE}",
    ),
    "masses incomplete": (
        {"masses.rod_big_end_kg": GONE},
        f"masses: масс недостаточно; {MASS_ADVICE}{MORE_WAYS}",
    ),
    "centre given twice": (
        {
            "masses": {
                "piston_group_kg": 1.5,
                "rod_kg": 1.7,
                "rod_centre_mm": 100,
                "rod_small_end_share": 0.3,
            }
        },
        f"masses: заданы и rod_centre_mm, и rod_small_end_share; {MASS_ADVICE}",
    ),
    "centre outside the rod": (
        {"masses": {"piston_group_kg": 1.5, "rod_kg": 1.7, "rod_centre_mm": 150}},
        "masses.rod_centre_mm: центр масс 150 мм лежит не между головками шатуна; "
        "длина шатуна 148 мм",
    ),
    "other layout": (
        {"engine.layout": "W"},
        "engine.layout: недопустимое значение «W»; допустимо: inline, v, opposed",
    ),
    "three strokes": (
        {"engine.strokes": 3},
        "engine.strokes: недопустимое значение 3; допустимо: 4, 2",
    ),
    "odd step": (
        {"calculation.step_deg": 7},
        "calculation.step_deg: недопустимое значение 7; допустимо: 1, 2, 3, 5, 10, 15, 30",
    ),
    "name of two lines": (
        {"engine.name": "a\nb"},
        "engine.name: в строке есть управляющие символы; оставьте одну строку обычного текста",
    ),
    "endless name": (
        {"engine.name": "a" * 400},
        "engine.name: слишком длинная строка, 400 знаков; допустимо до 300",
    ),
}
TABLES = {
    "falling": (
        [[0, 0.1], [180, 0.1], [170, 8], [720, 0.1]],
        "gas.points[3]: угол 170° не больше предыдущего 180°; углы должны строго возрастать",
    ),
    "repeated": (
        [[0, 0.1], [180, 0.1], [180, 8], [720, 0.1]],
        "gas.points[3]: угол 180° не больше предыдущего 180°; углы должны строго возрастать",
    ),
    "short": (
        [[0, 0.1], [180, 0.1], [700, 0.1]],
        "gas.points: точки не покрывают цикл: от 0 до 700°, а нужно от 0 до 720°; "
        "добавьте крайние точки",
    ),
    "late": (
        [[5, 0.1], [180, 0.1], [720, 0.1]],
        "gas.points: точки не покрывают цикл: от 5 до 720°, а нужно от 0 до 720°; "
        "добавьте крайние точки",
    ),
    "open": (
        [[0, 0.1], [180, 0.1], [720, 0.2]],
        "gas.points[3]: давление при 720° 0,2 МПа не равно давлению при 0° 0,1 МПа; "
        "цикл должен замыкаться",
    ),
    "two points": (
        [[0, 0.1], [720, 0.1]],
        "gas.points: точек 2, а нужно не меньше 3; добавьте точки",
    ),
    "one number": (
        [[0, 0.1], [5], [720, 0.1]],
        "gas.points[2][2]: обязательный ключ не задан (Точка 2: давление); "
        "допустимо от 0,001 до 60 МПа",
    ),
    "three numbers": (
        [[0, 0.1], [5, 1, 2], [720, 0.1]],
        "gas.points[2]: нужна пара чисел [угол, давление]; например [360.0, 8.4]",
    ),
    "text": (
        [[0, 0.1], [5, "x"], [720, 0.1]],
        "gas.points[2][2]: нужно число, а задано: строка «x»; допустимо от 0,001 до 60 МПа",
    ),
    "no list": (5, "gas.points: нужен список, а задано: число 5; запишите в квадратных скобках"),
}


@pytest.mark.parametrize("case", CASES)
def test_refused_with_one_line(case, raw, refused):
    changes, message = CASES[case]
    for path, value in changes.items():
        put(raw, path, value)
    assert refused(raw) == [f"f.toml: {message}"]


@pytest.mark.parametrize("case", TABLES)
def test_pressure_table_refused(case, raw, refused):
    points, message = TABLES[case]
    raw["gas"] = {"source": "table", "points": points}
    assert refused(raw) == [f"f.toml: {message}"]


def test_all_errors_at_once(raw, refused):
    for path, value in {
        "geometry.bore_mm": -1,
        "geometry.lambda": 0.4,
        "geometry.compression_ratio": GONE,
        "engine.nane": "x",
        "masses": GONE,
        "crankshaft.webs.0.mass_kg": -1,
        "crankshaft.webs.5": GONE,
        "crankshaft.throw_angles_deg": [0, 240, 120],
        "gas.max_pressure_mpa": 0.1,
    }.items():
        put(raw, path, value)
    keys = [line.split(": ")[1] for line in refused(raw)]
    assert sorted(keys) == sorted(
        [
            "geometry.bore_mm",
            "geometry.lambda",
            "geometry.compression_ratio",
            "engine.nane",
            "masses",
            "crankshaft.webs[1].mass_kg",
            "crankshaft.webs",
            "crankshaft.throw_angles_deg[2]",
            "crankshaft.throw_angles_deg[3]",
            "gas.max_pressure_mpa",
        ]
    )


def test_many_errors_are_capped(raw, refused):
    raw["geometry"] |= {f"zz{i}": 1 for i in range(1000)}
    raw |= {f"zz{i}": 1 for i in range(1000)}
    lines = refused(raw)
    assert len(lines) == 201
    assert lines[-1] == "f.toml: и ещё ошибок: 1800"


def test_an_order_is_blamed_by_its_own_key(raw, refused):
    """The file has no firing_offsets_deg: they follow from its order."""
    shaft = raw["crankshaft"]
    shaft.pop("firing_offsets_deg", None)
    shaft["firing_order"] = "1-2-3"
    shaft["throw_angles_deg"] = [0, 120, 200]
    lines = refused(raw)
    assert lines and all("firing_offsets_deg" not in line for line in lines)
    assert "(firing_order)" in lines[0]
