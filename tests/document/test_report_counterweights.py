"""What a note says of the proposed counterweights follows from the table of loads."""

from __future__ import annotations

import re

import pytest

from reports.document.text.terms import Terms
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.document.bare_pages import bare_page, plain
from tests.document.test_report_parts import NEW, SAMPLES, with_every_part

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


@pytest.mark.parametrize("goal", ["loads", "residue"])
@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_worse_counterweights_are_not_recommended(name: str, goal: str):
    """The conclusion offered counterweights with which the journals were loaded more."""
    raw = to_mapping(with_every_part(name)) | {"counterweight": {"goal": goal}}
    raw["calculation"]["step_deg"] = 30
    model = load_mapping(raw, source="").model
    built = build_model(model)
    terms, page = Terms(built, evaluate_model(built)), plain(bare_page(model))
    value = terms.value
    more = value("cw_new_sum_kN") / value("cw_now_sum_kN") - 1
    keeps = goal == "loads" and more > 0.005
    assert page.count("исходные противовесы следует оставить") == keeps
    assert page.count("исходные следует оставить") == keeps
    for state, words in (("now", "с исходными"), ("bare", "без противовесов")):
        said = re.search(
            rf"Наибольшая нагрузка ше[а-я]+ ([\d, и]+) с предложенными больше, чем {words}", page
        )
        worse = [
            f"{number}"
            for number in range(1, 20)
            if terms.has(f"cw_new_max{number}_kN")
            and value(f"cw_new_max{number}_kN") > 1.0005 * value(f"cw_{state}_max{number}_kN")
        ]
        assert re.findall(r"\d+", said[1] if said else "") == worse
