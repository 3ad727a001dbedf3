"""Further regimes: copies of the regime's tables under names of their own, and the comparison.

The formulas are not written twice: the tables of a regime are those of a model with its
speed and gas, in which every name that depends on them gets the regime's ending.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from kshm.nomenclature.quantity import quantity
from kshm.results.regimes import main_only, regime_key
from reports.formula.parse import names
from reports.inputs.fields import Field, iter_fields
from reports.inputs.sections.input_file import InputFile, Regime
from reports.model.blocks import (
    TIE,
    Block,
    Grid,
    GridRow,
    Scalar,
    ScalarTable,
    TableSpec,
    nodes_in,
    scalars_of,
)
from reports.model.charts import PHI, ChartSpec, Series
from reports.model.rename import copied, copied_chart
from reports.model.shape import Part

_LEFT_OUT = frozenset({"checks"})
_WHOLE = frozenset(
    {"gas_points", "gas_points_art"}
)  # a diagram's points stand together, even usual ones
# Comparison: forces of figures 23-25 and loads side by side, Gots 2.4. The last column of each row
# names the regime that governs, the one with the greatest load.
SHEET = "Режимы"
MAIN_NAME = "основной режим"
_FORCES = (("Pg_MPa", "Pg"), ("Pj_MPa", "Pj"), ("Ps_MPa", "Ps"))
_CHARTS = (
    ("23a", "Pg_MPa", "Удельная сила давления газов по режимам", "p′г, МПа"),
    ("23b", "Pj_MPa", "Удельная сила инерции по режимам", "p′j, МПа"),
    ("23c", "Ps_MPa", "Удельная суммарная сила по режимам", "p′s, МПа"),
)


@dataclass(frozen=True)
class RegimeModel:
    """The regime's part of a model with the regime's speed and gas."""

    number: int
    inputs: tuple[Field, ...]
    blocks: tuple[Block, ...]
    charts: tuple[ChartSpec, ...]
    main: Mapping[str, str]  # formulas of the main regime by name

    @cached_property
    def dependent(self) -> frozenset[str]:
        """Names of scalars and ``table.column`` that follow from speed or gas.

        So does what the main regime lacks or finds by another formula.
        """
        needs: dict[str, frozenset[str]] = {}
        differing: set[str] = set()
        for block in self.blocks:
            local = {c.key for c in block.columns} if isinstance(block, TableSpec) else set()
            for name, expr in _formulas(block).items():
                if self.main.get(name) != expr or block.id in _WHOLE:
                    differing.add(name)
                needs[name] = frozenset(
                    f"{block.id}.{used}" if used in local else used for used in names(expr)
                )
        nodes = (
            {item.name for item in self.inputs if item.path[0] in ("regime", "gas")}
            | {
                "gas_points_deg",
                "gas_points_mpa",
            }
            | differing
        )
        waiting = dict(needs)
        while True:
            reached = {name for name, used in waiting.items() if used & nodes}
            if not reached:
                return frozenset(nodes)
            nodes |= reached
            nodes |= self._runs(nodes)
            for name in reached:
                del waiting[name]

    def _runs(self, nodes: set[str]) -> set[str]:
        """Rows of grids, as formulas name them, with a cell among the names found."""
        return {
            f"{block.id}.{row.of}"
            for block in self.blocks
            if isinstance(block, Grid)
            for row in block.rows
            if any(cell is not None and cell.key in nodes for cell in row.cells)
        }

    @cached_property
    def blocks_to_copy(self) -> tuple[Block, ...]:
        """Blocks to copy: whole tables and grids, of lists only what depends on the regime."""
        copies: list[Block] = []
        for block in self.blocks:
            if block.id in _LEFT_OUT or main_only(block.id):
                continue
            if isinstance(block, ScalarTable):
                scalars = tuple(s for s in block.scalars if s.key in self.dependent)
                if scalars:
                    copies.append(replace(block, scalars=scalars))
            elif any(name in self.dependent for name in _formulas(block)):
                copies.append(block)
        return tuple(copies)

    @cached_property
    def _own(self) -> frozenset[str]:
        """Bare names and ids of tables and grids that get the regime's ending."""
        keys = {scalar.key for block in self.blocks_to_copy for scalar in scalars_of(block)}
        ids = {block.id for block in self.blocks_to_copy}
        inputs = {item.name for item in self.inputs if item.path[0] in ("regime", "gas")}
        return frozenset(keys | ids | inputs | {"gas_points_deg", "gas_points_mpa"})

    def name(self, token: str) -> str:
        """Return a name of the main regime as this one has it."""
        head, dot, column = token.partition(".")
        if head not in self._own:
            return token
        return f"{regime_key(head, self.number)}{dot}{column}"

    def part(self) -> Part:
        """Return copies with names, ids and sheets of their own; charts of copied tables alone."""
        ids = {block.id for block in self.blocks_to_copy}
        charts = (
            self._chart(chart)
            for chart in self.charts
            if {axis.split(".")[0] for s in chart.series for axis in (s.x, s.y)} <= ids
        )
        return Part(tuple(map(self._block, self.blocks_to_copy)), tuple(charts))

    def _block(self, block: Block) -> Block:
        copy = replace(
            copied(block, self.name),
            title=f"{block.title} (режим {self.number})",
            sheet=self.sheet(block.sheet),
        )
        if isinstance(copy, TableSpec):
            return replace(copy, number=f"{copy.number}.р{self.number}")
        return copy

    def sheet(self, title: str) -> str:
        """Title of the regime's sheet."""
        return f"{title} р{self.number}" if title else ""

    def _chart(self, chart: ChartSpec) -> ChartSpec:
        return replace(
            copied_chart(chart, self.name),
            id=regime_key(chart.id, self.number),
            sheet=self.sheet(chart.sheet),
            title=f"{chart.title}, режим {self.number}",
        )


def _formulas(block: Block) -> dict[str, str]:
    """Name and formula of every node of a block."""
    return {key: node.expr for key, node in nodes_in(block) if node.expr is not None}


def regime_models(model: InputFile, chain: Callable[[InputFile], Part]) -> tuple[RegimeModel, ...]:
    """One for each further regime.

    Args:
        model: the input.
        chain: blocks and charts of chapters 1 and 2 for an input without further regimes.
    """
    if not model.regimes:
        return ()
    models = []
    main = {k: v for block in chain(model).blocks for k, v in _formulas(block).items()}
    for number, regime in enumerate(model.regimes, 2):
        values = {key: value for key, value in regime if key not in ("gas", "name")}
        alone = model.model_copy(
            update={
                "regime": Regime.model_construct(**values, name=None),
                "gas": regime.gas,
                "cycle": None,
                "regimes": (),
                "reference": None,
            }
        )
        part = chain(alone)
        inputs = tuple(iter_fields(alone))
        models.append(RegimeModel(number, inputs, part.blocks, part.charts, main))
    return tuple(models)


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
    """Return the forces of all regimes over the crank angle, figures 23-25 laid over each other."""
    tables = [(_key("P4_1", n), name) for n, name in enumerate(regime_titles(model), 1)]
    return tuple(
        ChartSpec(
            f"fig{chart}", SHEET, title, "line",
            tuple(
                Series(f"{table}.phi_deg", f"{table}.{column}", name) for table, name in tables
            ),
            PHI, y, figure="23–25", x_is_angle=True,
        )
        for chart, column, title, y in _CHARTS
    )  # fmt: skip
