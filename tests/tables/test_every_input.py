"""Every number that an open workbook lets one change is what some of its formulas follow."""

from __future__ import annotations

from reports.inputs.fields import Field, to_mapping
from reports.inputs.load import load_mapping
from reports.model.blocks import Model
from reports.model.evaluation import graph_of
from reports.tables.registry import build_model
from tests.conftest import sample, sample_names
from tests.cover import model_of
from tests.inputs.test_plausibility import FURTHER

# Of a regime without a power of its own nothing is compared with it.
_IDLE = {"regimes.fullness"}


def _key(field: Field) -> str:
    return ".".join(part for part in field.path if isinstance(part, str))


def _followed(model: Model) -> set[str]:
    """Names of inputs that a formula or a line across a chart follows, or that rebuild the book."""
    graph = graph_of(model)
    item = frozenset().union(*(graph.references(node) for node in model.nodes))
    item |= {name for run in item & model.input_runs.keys() for name in model.input_runs[run]}
    item |= {name for chart in model.charts for name in chart.levels}
    return item | {field.name for field in model.inputs if field.structural}


def test_no_number_of_the_input_sheet_is_idle() -> None:
    """What is allowed of films, journals and shafts was: only the report looked at it."""
    shaft = to_mapping(sample("d-240-bearings"))
    for section, keys in FURTHER.items():
        shaft[section] = shaft.get(section, {}) | keys
    further = build_model(load_mapping(shaft, source="файл").model)
    given: set[str] = set()
    followed: set[str] = set()
    for model in (further, *map(model_of, sample_names())):
        names = _followed(model)
        for field in model.inputs:
            if isinstance(field.value, int | float) and field.path[0] not in ("report", "sheet"):
                (followed if field.name in names else given).add(_key(field))
    assert given - followed == _IDLE
