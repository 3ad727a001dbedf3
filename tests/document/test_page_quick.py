"""What is done quickly gives the same file; it is done for the library that is installed."""

from contextlib import nullcontext
from unittest import mock

import pydyf
import pytest
import weasyprint

from reports.document.page import quick, render
from reports.document.text.mathsvg import formula
from reports.document.text.texts import pictured
from tests.document.figure_samples import FIGURES

PAGE = "".join(
    [
        "<html lang='ru'><style>{{fonts}} img.fig { width: 150mm } p::before { content: '§ ' }"
        "</style><body>",
        *(str(pictured(FIGURES[name](), name)) for name in ("line", "polar", "wear", "cranks")),
        str(pictured(formula(r"\dfrac{a_1}{b} = \sqrt{x}\,\mathrm{м}").svg, "дробь")),
        str(pictured('<svg class="fig" viewBox="0 0 90 90"><path d="M1 2l3 4h5A2 2 0 0 1 9 9"/>'
                     '<path d="M0 0L5.125 5" marker-end="url(#x)"/><text x="5" dx="2">a<tspan>b'
                     '</tspan></text><text x="9" y="9" text-anchor="end" font-weight="bold" '
                     'letter-spacing="2">abc</text><text x="9em" y="20">d e</text></svg>', "")),
        "<p>Текст <a href='#x'>со ссылкой</a></p><ul><li id='x'>раз<li>два</ul>",
        "<table><tr><td>1<td>2</table></body></html>",
    ]
)  # fmt: skip


def page(extra: str = "") -> str:
    from reports.document.text.fonts import fonts_css

    return PAGE.replace("{{fonts}}", fonts_css() + extra)


def both(html: str) -> tuple[render.Rendered, render.Rendered]:
    with mock.patch.object(quick, "setting", lambda html: nullcontext()):
        usual = render.render(html)
    return usual, render.render(html)


def test_the_same_bytes():
    usual, ours = both(page())
    assert ours == usual
    assert (not ours.warnings and ours.pdf.count(b"/Type/Page/")) or ours.pages


def test_footnotes_stay():
    html = page("a { float: footnote }")
    usual, ours = both(html)
    assert ours == usual
    with (
        mock.patch.object(quick, "_NOTES", mock.Mock(search=lambda html: None)),
        pytest.raises(TypeError),  # without their styles they could not be set
    ):
        render.render(html)


@pytest.mark.parametrize("tag", ["p", "li"])
def test_lists_of_other_elements_keep_their_markers(tag):
    usual, ours = both(page(f"{tag} {{ display: list-item; list-style: disc inside }}"))
    assert ours == usual


def test_the_versions_installed_are_those_looked_at():
    """Look at the functions that are replaced, then write the new versions down."""
    assert (weasyprint.__version__, pydyf.VERSION) == quick.VERSIONS


def test_another_version_is_left_alone():
    before = weasyprint.svg.text
    with mock.patch.object(quick, "VERSIONS", ("1", "2")), quick.setting(""):
        assert weasyprint.svg.text is before
    with quick.setting(""):
        assert weasyprint.svg.text is not before
    assert weasyprint.svg.text is before
