import pytest

from reports.document.text.tex import break_points, for_mathtext, tree
from reports.shared.errors import TexError


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


def test_space_before_functions_and_round_fractions():
    assert for_mathtext(r"\lambda\cos\varphi") == r"\lambda\,\cos\varphi"
    assert for_mathtext(r"\left(\cos\varphi\right)") == r"\left(\cos\varphi\right)"
    assert for_mathtext(r"2\cdot\cos x") == r"2\cdot\cos x"
    assert for_mathtext(r"r\dfrac{a}{b}c") == r"r\,\dfrac{a}{b}\,c"
    assert for_mathtext(r"\sum_{i=1}^{3}M_i") == r"\sum_{i=1}^{3}\,M_{i}"
    assert for_mathtext(r"\tg\psi") == r"\operatorname{tg}\psi"
    assert for_mathtext(r"30^{\circ}") == "30°"
    assert for_mathtext(r"R''_x") == r"R^{\prime\prime}_{x}"
    assert for_mathtext("p'_s", level_primes=True) == r"p{\prime}_{s}"
