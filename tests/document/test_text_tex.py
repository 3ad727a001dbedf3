import pytest

from reports.document.text.tex import TexError, break_points, tree


def tokens(nodes):
    return [node.token for node in nodes]


def test_a_node_has_its_arguments():
    head, fraction = tree(r"a\dfrac{b+c}d")
    assert head.token == "a" and fraction.command == "dfrac"
    assert [tokens(part) for part in fraction.parts] == [["b", "+", "c"], ["d"]]
    letter, index = tree(r"R_{\mathrm{ш}}")
    assert index.takes_one and tokens(index.parts[0]) == [r"\mathrm"] and letter.parts == ()


@pytest.mark.parametrize("tex", ["{a", "a}", r"\{a}", "x_", r"\dfrac{a}"])
def test_what_does_not_pair_up_is_refused(tex):
    with pytest.raises(TexError):
        tree(tex)


def test_an_escaped_brace_is_a_sign():
    assert tokens(tree(r"\{a")) == [r"\{", "a"]


def test_break_prefers_relations_over_sums_and_never_cuts_groups():
    points = break_points(r"a=b+\dfrac{c=d}{e+f}-\left(g+h\right)")
    assert [point.rank for point in points] == [0, 1, 1, 2.2]
    inside = points[-1]
    assert (inside.closing, inside.carried) == (r"\right.", r"\left.{}+ ")
    assert [point.end for point in break_points("x=-1")] == [2]
    assert break_points(r"a\cdot b")[0].carried == r"{}\times "
