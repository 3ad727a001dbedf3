"""The Word file says what the PDF says: number by number, formula by formula."""

from __future__ import annotations

import copy
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.document.text.texts import FORMULA
from reports.shared.errors import TexError
from reports.word.omml import displayed, omath
from tests.cover import chapters, samples_with, sparse
from tests.word.docx_samples import NAME, NUMBER, M, W, docx_of, page_of, part, root_of, text_of

_UNSAID = ("span[@class='hn']", "nav", "*[@class='form2']", "*[@class='form2a']",
           "tr[@class='gap']")  # fmt: skip

_POWERS = {"в квадрате": " 2 ", "в кубе": " 3 "}  # as formulas are read aloud


def numbers_of_page(page: str) -> list[str]:
    """Numbers of the page as paper shows them, but for headings, contents and title blocks."""
    body = copy.deepcopy(root_of(page).body)
    for path in _UNSAID:
        for element in body.findall(f".//{path}"):
            element.drop_tree()
    for position in body.xpath(".//div[@class='place']"):  # in a footer
        position.drop_tree()
    for image in body.iter("img"):
        words = image.get("alt") if FORMULA in image.get("alt") else ""
        for spoken, power in _POWERS.items():
            words = words.replace(spoken, power)
        image.tail = words + (image.tail or "")
    for end in body.iter("p", "td", "th", "li", "div", "br", "figcaption", "h1", "h2", "h3"):
        end.tail = " " + (end.tail or "")
    for index in body.iter("sub", "sup"):
        index.text, index.tail = " " + (index.text or ""), " " + (index.tail or "")
    return NUMBER.findall(body.text_content())


def numbers_of_docx(data: bytes) -> list[str]:
    body = part(data).find(f"{W}body")
    for entry in body.xpath("./*[local-name()='p'][.//*[local-name()='pStyle'"
                            " and starts-with(@*, 'TOC')]]"):  # fmt: skip
        body.remove(entry)
    for words in body.iter(f"{W}instrText"):  # a count that the PDF's page leaves to the layout
        if "NUMPAGES" in words.text:
            shown = words.getparent().getnext().getnext()
            shown.getparent().remove(shown)
    collected = []
    for paragraph in body.iter(f"{W}p"):
        words = ""
        for element in paragraph.iter(f"{W}t", f"{M}t", f"{W}br"):
            text = element.text or " "
            run = element.getparent()
            low = run.find(f"{W}rPr/{W}vertAlign") is not None
            words += f" {text} " if low or element.tag == f"{M}t" else text
        collected += NUMBER.findall(words)
    return collected


@pytest.mark.parametrize("name", sparse(samples_with(chapters)))
def test_every_number_of_the_pdf_stands_in_word(name):
    """In the order of the text; within a formula an index may stand before a power."""
    page, word = numbers_of_page(page_of(name)), numbers_of_docx(docx_of(name))
    assert len(word) == len(page) > 1500
    assert sorted(word) == sorted(page)
    separate = [i for i, pair in enumerate(zip(word, page, strict=True)) if pair[0] != pair[1]]
    assert len(separate) < 0.02 * len(page)


def test_every_formula_is_an_equation_and_none_a_picture():
    root, document = root_of(page_of(NAME)), part(docx_of(NAME))
    lines = root.xpath("//span[@data-tex]")
    assert len(document.findall(f".//{M}oMathPara")) == len(lines) > 100
    pictures = document.xpath("//*[local-name()='inline']")
    assert len(pictures) == len(root.findall(".//figure"))


def test_tables_are_native_with_a_heading_on_every_sheet():
    root, document = root_of(page_of(NAME)), part(docx_of(NAME))
    sources = root.xpath("//table[contains(@class, 'data')]")
    bare = ("FormulaTable", "SignTable")
    values = [t for t in document.iter(f"{W}tbl")
              if t.find(f"{W}tblPr/{W}tblStyle").get(f"{W}val") not in bare]  # fmt: skip
    assert len(values) == len(sources)
    for table, source in zip(values, sources, strict=True):
        rows = table.findall(f"{W}tr")
        heads = [row for row in rows if row.find(f"{W}trPr/{W}tblHeader") is not None]
        assert heads == rows[: len(heads)] and len(heads) == 2
        assert len(rows) - len(heads) == len(source.findall("tbody/tr"))
        for row in rows:
            assert len(row.findall(f"{W}tc")) == len(source.findall("colgroup/col"))
    assert "Таблица 1 — Исходные данные" in text_of(document).replace("\u00a0", " ")


def words(tex: str) -> str:
    return "".join(omath(tex).itertext())


def tags(tex: str) -> list[str]:
    return [element.tag.removeprefix(M) for element in omath(tex).iter()]


@pytest.mark.parametrize(
    ("tex", "text", "holds"),
    [
        (r"\dfrac{a}{2{,}5}", "a2,5", {"f", "num", "den"}),
        (r"\sqrt{x + 1}", "x+1", {"rad", "radPr", "deg"}),
        (r"R_{\mathrm{ш.ш}}", "Rш.ш", {"sSub"}),
        (r"K'_x", "Kx′", {"sSubSup"}),
        (r"\left(S'_k\right)^{2}", "Sk′2", {"d", "sSup"}),
        (r"\sin\left(2 \cdot 30\right)", "sin(2·30)", {"r"}),  # nothing in it is high
        (r"\sum_{j=1}^{m} M", "j=1mM", {"nary"}),
        (r"\bar{p}", "p", {"bar"}),
        (r"7{,}809^{\circ}", "7,809°", {"r"}),
        (r"-0{,}5 \cdot 10^{-6}\;\mathrm{МПа}", "−0,5·10−6\u2005МПа", {"sSup"}),
    ],
)
def test_what_stands_in_formulas(tex, text, holds):
    assert words(tex) == text
    assert holds <= set(tags(tex))


def test_brackets_round_what_is_low_do_not_grow():
    """LibreOffice drew them as hairs."""
    assert "d" not in tags(r"\left(2 \cdot 30^{\circ}\right)")
    assert "d" in tags(r"\left(\dfrac{1}{2}\right)")


def test_a_power_is_set_to_the_whole_number():
    power = omath(r"1{,}25^{2}").find(f"{M}sSup")
    assert "".join(power.find(f"{M}e").itertext()) == "1,25"


def test_letters_are_slanted_and_words_upright():
    faces = {
        "".join(run.itertext()): [e.tag.removeprefix(M) for e in run.iter()]
        for run in omath(r"x \, \mathrm{кВт} \tg \beta").iter(f"{M}r")
    }
    assert "nor" in faces["кВт"] and "nor" not in faces["x"] and "rPr" not in faces["β"]


def test_a_sign_at_a_broken_end_is_text():
    line = displayed(r"{}= a + b +", ".")
    runs = list(line.iter(f"{M}r"))
    assert "".join(line.itertext()).strip(".") == "=\u2005a+b\u2005+"
    as_text = [run.find(f".//{M}nor") is not None for run in runs]
    assert as_text == [True, False, False, False, True, True]


@pytest.mark.parametrize("tex", [r"\left( a", r"\unheardof", r"{a"])
def test_what_cannot_be_set_is_refused(tex):
    with pytest.raises((TexError, ValueError)):
        omath(tex)


NUMBERS = st.decimals(0, 10**6, places=3).map(lambda d: str(d).replace(".", "{,}"))
EXPRESSIONS = st.recursive(
    NUMBERS | st.sampled_from([r"\varphi", "x", r"R_{\mathrm{ш}}", "K'"]),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map(lambda p: rf"\dfrac{{{p[0]}}}{{{p[1]}}}"),
        st.tuples(inner, inner).map(lambda p: rf"\left({p[0]} + {p[1]}\right)^{{2}}"),
        inner.map(lambda i: rf"\sqrt{{{i}}} \cdot \sin {i}"),
    ),
    max_leaves=8,
)


@given(EXPRESSIONS)
def test_no_digit_is_lost(tex):
    assert re.findall(r"\d", words(tex)) == re.findall(r"\d", tex)
    for element in omath(tex).iter(f"{M}e", f"{M}num", f"{M}den"):
        assert len(element)
