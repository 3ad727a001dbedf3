"""The Word file says what the PDF says: number by number, formula by formula."""

from __future__ import annotations

import copy

import pytest

from reports.document.text.texts import FORMULA
from tests.cover import chapters, samples_with
from tests.word.docx_samples import NAME, NUMBER, M, W, docx_of, page_of, part, root_of, text_of

_UNSAID = ("span[@class='hn']", "nav", "*[@class='form2']", "*[@class='form2a']",
           "tr[@class='gap']")  # fmt: skip


def numbers_of_page(page: str) -> list[str]:
    """Numbers of the page as paper shows them, but for headings, contents and title blocks."""
    body = copy.deepcopy(root_of(page).body)
    for path in _UNSAID:
        for element in body.findall(f".//{path}"):
            element.drop_tree()
    for place in body.xpath(".//div[@class='place']"):  # in a footer
        place.drop_tree()
    for image in body.iter("img"):
        image.tail = (image.get("alt") if FORMULA in image.get("alt") else "") + (image.tail or "")
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
    found = []
    for paragraph in body.iter(f"{W}p"):
        words = ""
        for element in paragraph.iter(f"{W}t", f"{M}t", f"{W}br"):
            text = element.text or " "
            run = element.getparent()
            low = run.find(f"{W}rPr/{W}vertAlign") is not None
            words += f" {text} " if low or element.tag == f"{M}t" else text
        found += NUMBER.findall(words)
    return found


@pytest.mark.parametrize("name", samples_with(chapters))
def test_every_number_of_the_pdf_stands_in_word(name):
    """In the order of the text; within a formula an index may stand before a power."""
    page, word = numbers_of_page(page_of(name)), numbers_of_docx(docx_of(name))
    assert len(word) == len(page) > 1500
    assert sorted(word) == sorted(page)
    apart = [i for i, pair in enumerate(zip(word, page, strict=True)) if pair[0] != pair[1]]
    assert len(apart) < 0.02 * len(page)


def test_every_formula_is_an_equation_and_none_a_picture():
    root, document = root_of(page_of(NAME)), part(docx_of(NAME))
    lines = root.xpath("//span[@data-tex]")
    assert len(document.findall(f".//{M}oMathPara")) == len(lines) > 100
    pictures = document.xpath("//*[local-name()='inline']")
    assert len(pictures) == len(root.findall(".//figure"))


def test_tables_are_native_with_a_heading_on_every_sheet():
    root, document = root_of(page_of(NAME)), part(docx_of(NAME))
    sources = root.xpath("//table[contains(@class, 'data')]")
    made = [t for t in document.iter(f"{W}tbl")
            if t.find(f"{W}tblPr/{W}tblStyle").get(f"{W}val") != "FormulaTable"]  # fmt: skip
    assert len(made) == len(sources)
    for table, source in zip(made, sources, strict=True):
        rows = table.findall(f"{W}tr")
        heads = [row for row in rows if row.find(f"{W}trPr/{W}tblHeader") is not None]
        assert heads == rows[: len(heads)] and len(heads) == 2
        assert len(rows) - len(heads) == len(source.findall("tbody/tr"))
        for row in rows:
            assert len(row.findall(f"{W}tc")) == len(source.findall("colgroup/col"))
    assert "Таблица 1 — Исходные данные" in text_of(document).replace("\u00a0", " ")
