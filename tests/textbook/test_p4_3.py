"""Table П4.3, third main journal; book: see ``book``.

The table belongs to another run than Приложение 1; the sample gots-p43 holds
its data and gives its phases explicitly.
"""

from tests.textbook.book import beyond, checks, recorded, rows_of, solution, tolerance_of

LABELS = [float(row["phi_deg"]) for row in rows_of("P4_3")]


def test_142_of_144_cells_agree_and_the_others_are_the_misprints() -> None:
    assert tolerance_of("P4_3").units == 1.5
    assert len(checks("P4_3")) == 144
    assert beyond("P4_3") == recorded("P4_3") == {("220", "Ry_MPa"), ("610", "Rx_MPa")}


def test_missing_row_and_true_maximum() -> None:
    ours = solution("gots-p43", 3).columns["P4_3_3"]
    angles = list(ours["phi_deg"])
    assert 110.0 not in LABELS
    at = angles.index(111.0)
    assert abs(ours["Rx_MPa"][at] + 1.588) < 0.0015
    assert abs(ours["Ry_MPa"][at] + 1.212) < 0.0015
    at = angles.index(612.0)
    assert ours["R_MPa"].argmax() == at
    assert abs(ours["R_MPa"][at] - 2.766) < 0.0015


def test_consistent_phases_give_another_maximum() -> None:
    """With the phases that fit the shaft the same run peaks at 132° with 3.580 MPa."""
    from dataclasses import replace

    from kshm import solve

    engine = replace(solution("gots-p43", 3).engine, force_offsets=None)
    ours = solve(engine).columns["P4_3_3"]
    at = ours["R_MPa"].argmax()
    assert ours["phi_deg"][at] == 132.0
    assert abs(ours["R_MPa"][at] - 3.580) < 0.0015
