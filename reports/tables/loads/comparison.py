"""Comparison of the regimes: forces of figures 23-25 and loads side by side, Gots 2.4.

The last column of each row names the regime that governs: the one with the greatest load.
"""

from __future__ import annotations

from kshm.nomenclature.quantity import quantity
from kshm.results.regimes import regime_key
from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Block, Grid, GridRow, Scalar, ScalarTable
from reports.spec.charts import ChartSpec, Series, over_phi
from reports.spec.extremes import TIE
from reports.spec.parts import Part
from reports.tables.loads.regimes import RegimeModel

SHEET = "Режимы"
MAIN_NAME = "основной режим"
_FORCES = (("Pg_MPa", "Pg"), ("Pj_MPa", "Pj"), ("Ps_MPa", "Ps"))
_CHARTS = (
    ("23a", "Pg_MPa", "Удельная сила давления газов по режимам", "p′г, МПа"),
    ("23b", "Pj_MPa", "Удельная сила инерции по режимам", "p′j, МПа"),
    ("23c", "Ps_MPa", "Удельная суммарная сила по режимам", "p′s, МПа"),
)


def regime_titles(model: InputFile) -> tuple[str, ...]:
    """Names of the regimes, the main one first."""
    return (model.regime.name or MAIN_NAME, *(regime.name for regime in model.regimes))


def comparison(model: InputFile, further: tuple[RegimeModel, ...]) -> Part:
    """Extremes of the forces and the grid of loads; nothing for one regime."""
    if not further:
        return Part()
    numbers = tuple(range(1, len(further) + 2))
    keys = {scalar for block in further[0].blocks_to_copy for scalar in _keys(block)}
    rows = [_row(key, key, numbers, model, low=low) for key, low in _compared(keys)]
    titles, extremes, force_rows = regime_titles(model), [], []
    for column, name in _FORCES:
        for way in ("max", "min"):
            key = f"{name}_{way}"
            extremes += [
                Scalar(
                    _key(key, n), f"col_{way}({_key('P4_1', n)}.{column})", "Гоц, 2.4", of=key,
                    note=f"{quantity(key).title}: {titles[n - 1]}",
                )
                for n in numbers
            ]  # fmt: skip
            force_rows.append(_row(key, key, numbers, model, low=way == "min"))
    labels = (*titles, "определяющий режим")
    listed = ScalarTable("regime_forces", "Крайние значения удельных сил", f"{SHEET}, силы",
                         tuple(extremes))  # fmt: skip
    grid = Grid(
        "regime_loads",
        "Нагрузки по режимам",
        SHEET,
        labels,
        (*force_rows, *rows),
        note=(
            "Определяющий режим — тот, при котором нагрузка наибольшая по величине; для "
            "наименьших сил (растяжение шатуна) — тот, при котором они наименьшие."
        ),
    )
    return Part((grid, listed), _charts(model))


def _keys(block: Block) -> list[str]:
    if isinstance(block, ScalarTable):
        return [scalar.key for scalar in block.scalars]
    return []


def _compared(keys: set[str]) -> list[tuple[str, bool]]:
    """Scalars shown side by side, and whether the least value governs."""
    parts = (
        "omega", "c_m", "p_i_area", "M_mean", "M_e", "N_i_calc", "M_max", "M_min", "Rpin_mean",
        "Rpin_max", "Rpin_max_kN", "q_pin_mean", "q_pin_max",
    )  # fmt: skip
    chosen = [key for key in parts if key in keys]
    for kind in ("Rpin{}_mean", "Rpin{}_max", "Rpin{}_max_kN", "q_pin{}_mean", "q_pin{}_max"):
        chosen += [kind.format(n) for n in range(2, 9) if kind.format(n) in keys]
    for kind in ("Rmain{}_mean", "Rmain{}_max", "Rmain{}_max_kN", "q_main{}_mean", "q_main{}_max",
                 "dM_main{}", "dM_pin{}"):  # fmt: skip
        chosen += [kind.format(n) for n in range(1, 14) if kind.format(n) in keys]
    return [(key, key == "M_min") for key in chosen]


def _key(key: str, number: int) -> str:
    return key if number == 1 else regime_key(key, number)


def _row(key: str, of: str, numbers: tuple[int, ...], model: InputFile, *, low: bool) -> GridRow:
    """One quantity at every regime and the name of the one that governs."""
    cells = [Scalar(f"cmp{n}_{key}", _key(key, n), "Гоц, 2.4", of=of) for n in numbers]
    values = [f"cmp{n}_{key}" for n in numbers]
    way, sign, slack = ("min", "<", "+") if low else ("max", ">", "-")
    top = f"{way}({', '.join(values)})"
    names = [_name(model, n) for n in numbers]
    text = names[-1]
    for value, name in list(zip(values, names, strict=True))[-2::-1]:
        test = f"{value} {sign} {top} {slack} {TIE}"
        text = f"{name} if {test} else ({text})"
    cells.append(Scalar(f"governs_{key}", text, "Гоц, 2.4", of="governs"))
    return GridRow(of, tuple(cells))


def _name(model: InputFile, number: int) -> str:
    if number > 1:
        return regime_key("regime_name", number)
    return "regime_name" if model.regime.name is not None else f'"{MAIN_NAME}"'


def _charts(model: InputFile) -> tuple[ChartSpec, ...]:
    """The forces of all regimes over the crank angle, figures 23-25 laid over each other."""
    tables = [(_key("P4_1", n), name) for n, name in enumerate(regime_titles(model), 1)]
    return tuple(
        over_phi(f"fig{chart}", SHEET, title, y,
                 *(Series(f"{table}.phi_deg", f"{table}.{column}", name) for table, name in tables),
                 figure="23–25")
        for chart, column, title, y in _CHARTS
    )  # fmt: skip
