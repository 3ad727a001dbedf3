"""Checks of the rounded diagram: its points in their order, its pressures as well."""

from __future__ import annotations

from collections.abc import Iterator

from reports.inputs.checks.volume import volume_ratio
from reports.inputs.findings import Finding, Path, Values, radius_and_rod
from reports.inputs.sections.gas import JOIN_DEG, PEAK_DEG, PEAK_SHARE
from reports.inputs.units import MPA, number_text

_TDC, _BDC = 360.0, 540.0


def check_rounded(values: Values) -> Iterator[Finding]:
    """Yield what keeps the points of figure 22 from being joined."""
    strokes = values.get("engine", "strokes")
    if strokes is not None and int(strokes) != 4:
        what = "скруглённая диаграмма построена только для четырёхтактного двигателя"
        yield Finding(("gas", "source"), what, "задайте точки или политропы")
        return
    kind = values.get("gas", "kind")
    if kind is None:
        return
    wrong = list(_angles(values, kind))
    yield from wrong
    if not wrong:
        yield from _pressures(values, kind)


def _angles(values: Values, kind: str) -> Iterator[Finding]:
    start = _start(values)
    if start is not None and not 181 < start < _TDC:
        what = f"сгорание начинается при {number_text(start)}°"
        hint = "точка c' должна лежать до ВМТ: уменьшите задержку воспламенения"
        yield Finding(("gas", "ignition_delay_deg"), what, hint)
    peak, join = (
        _place(values, "peak_after_tdc_deg", PEAK_DEG[kind]),
        _place(values, "expansion_after_tdc_deg", JOIN_DEG[kind]),
    )
    if join <= peak:
        what = f"выход на линию расширения при {number_text(join)}° не позже точки z_д"
        hint = f"задайте больше {number_text(peak)}°"
        yield Finding(("gas", "expansion_after_tdc_deg"), what, hint)
    before = values.get("gas", "exhaust_start_before_bdc_deg")
    if before is not None and _BDC - before <= _TDC + join:
        what = "выпуск начинается раньше линии расширения"
        yield Finding(("gas", "exhaust_start_before_bdc_deg"), what, "уменьшите угол")


def _pressures(values: Values, kind: str) -> Iterator[Finding]:
    names = ("intake_pressure_mpa", "residual_pressure_mpa", "max_pressure_mpa",
             "compression_exponent", "expansion_exponent", "preexpansion_ratio", "tdc_rise",
             "exhaust_start_before_bdc_deg")  # fmt: skip
    found = [values.get("gas", name) for name in names]
    ratio, pair, start = values.get("geometry", "compression_ratio"), radius_and_rod(values), None
    if None in found or ratio is None or pair is None or pair[0] >= pair[1]:
        return
    start = _start(values)
    if start is None:
        return
    p_a, p_r, p_z, n_1, n_2, rho, rise, before = found
    lam = pair[0] / pair[1]
    share = values.get("gas", "peak_share")
    top = p_z * (PEAK_SHARE[kind] if share is None else share)
    at_start = p_a * (ratio / volume_ratio(start, lam, ratio)) ** n_1
    at_tdc = rise * p_a * ratio**n_1

    def expanded(angle: float) -> float:
        return float(p_z * (rho / volume_ratio(angle, lam, ratio)) ** n_2)

    join = expanded(_TDC + _place(values, "expansion_after_tdc_deg", JOIN_DEG[kind]))
    opening, bottom = expanded(_BDC - before), (expanded(_BDC) + p_r) / 2
    chain: tuple[tuple[str, Path, float, float, str], ...] = (
        ("давление в c'' не выше давления в c'", ("gas", "tdc_rise"), at_start, at_tdc,
         "увеличьте tdc_rise"),
        ("p_zд не выше давления в c''", ("gas", "max_pressure_mpa"), at_tdc, top,
         "увеличьте p_z или уменьшите tdc_rise"),
        ("линия расширения в точке выхода не ниже p_zд", ("gas", "expansion_after_tdc_deg"),
         join, top, "увеличьте угол"),
        ("давление в b'' не ниже давления в b'", ("gas", "residual_pressure_mpa"), bottom,
         opening, "уменьшите p_r"),
        ("p_r не ниже давления в b''", ("gas", "residual_pressure_mpa"), p_r, bottom,
         "уменьшите p_r"),
    )  # fmt: skip
    for what, path, low, high, hint in chain:
        if not low < high:
            numbers = f" ({MPA.text(round(low, 3))} и {MPA.text(round(high, 3))})"
            yield Finding(path, what + numbers, hint)
            return


def _start(values: Values) -> float | None:
    advance = values.get("gas", "injection_advance_deg")
    delay = values.get("gas", "ignition_delay_deg")
    return None if advance is None or delay is None else _TDC - advance + delay


def _place(values: Values, key: str, usual: float) -> float:
    found = values.get("gas", key)
    return usual if found is None else float(found)
