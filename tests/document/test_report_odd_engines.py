"""What the report claims of engines far from the samples, against their numbers."""

import pytest
from bare_pages import bare_page, plain
from test_report_sentences import assert_claims_hold, text_of

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.solved import solved
from tests.conftest import sample

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]


def in_line(order, strokes=4, **sections):
    """Alike throws at equal intervals with the cylinder and the throw of the first sample."""
    raw = to_mapping(sample("gots-diesel"))
    count, shaft = len(order), raw["crankshaft"]
    raw["engine"] |= {"cylinders": count, "strokes": strokes}
    del shaft["firing_offsets_deg"], shaft["throw_angles_deg"]
    shaft |= {
        "firing_order": "-".join(map(str, order)),
        "main_lengths_mm": [30.0] * (count + 1),
        "webs": [dict(shaft["webs"][0]) for _ in range(2 * count)],
        "arms": [dict(shaft["arms"][0]) for _ in range(count)],
    }
    if strokes == 2:
        raw["gas"]["scavenge_start_before_bdc_deg"] = 40.0
    raw["report"]["detail"] = "full"
    for section, keys in sections.items():
        raw[section] = {**raw.get(section, {}), **keys}
    return load_mapping(raw, source="t.toml").model


def test_an_interval_that_is_no_whole_degree_is_told_with_its_decimals():
    model = in_line([1, 7, 2, 5, 4, 3, 6])
    page = bare_page(model)
    assert "чередуются через 102,86°" in plain(page)
    assert "102,86, 102,86" in plain(page)  # so in the table of firing orders
    assert_claims_hold(model, page)


@pytest.mark.parametrize("allowed, needed", [(0.001, True), (0.5, False)])
def test_the_flywheel_is_needed_or_not_in_every_chapter(allowed, needed):
    model = in_line([1, 4, 2, 5, 3], balance={"irregularity": allowed}, torsion={})
    text = text_of(model)
    assert (solved(model).scalars["I_flywheel"] > 0) == needed
    assert ("принят по требуемой неравномерности хода" in text) == needed
    assert ("маховик не нужен" in text) != needed
    assert ("даёт и без него; принят в 8 раз больше" in text) != needed
    assert "но при шаге 1° Iм = 0" not in text.replace("\xa0", " ")
