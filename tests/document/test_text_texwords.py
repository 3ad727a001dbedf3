from reports.document.text.texwords import for_mathtext


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
