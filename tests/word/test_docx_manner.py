"""What a department's controller sees in the file itself: properties, spacing, branches."""

import io
import re
import zipfile

import pytest
from lxml import etree

from reports.document.page.style import USUAL
from reports.word.write import from_page
from tests.word.docx_samples import W, docx_of


@pytest.fixture(scope="module")
def parts():
    with zipfile.ZipFile(io.BytesIO(docx_of("gots-diesel"))) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_the_file_says_what_wrote_it_and_has_no_picture_of_a_template(parts):
    assert not [name for name in parts if "thumbnail" in name]
    assert b"thumbnail" not in parts["_rels/.rels"]
    assert re.search(rb"<Application>kshm<", parts["docProps/app.xml"])


@pytest.mark.parametrize("author", ["Иванов И. И.", ""])
def test_the_author_of_the_file_is_that_of_the_note(author):
    page = (
        f'<html><head><title>т</title><meta name="author" content="{author}">'
        '<meta name="dcterms.created" content="2026-01-01"></head>'
        '<body><div class="text"><p>а</p></div></body></html>'
    )
    with zipfile.ZipFile(io.BytesIO(from_page(page, USUAL))) as archive:
        about = archive.read("docProps/core.xml").decode()
    assert f"<dc:creator>{author}</dc:creator>" in about and "python-docx" not in about


def test_room_after_tables_comes_from_styles(parts):
    body = etree.fromstring(parts["word/document.xml"]).find(f"{W}body")
    empty = [p for p in body.iterfind(f"{W}p") if not [e for e in p if e.tag != f"{W}pPr"]]
    assert all(p.find(f"{W}pPr/{W}sectPr") is not None for p in empty)  # the end of a section
    assert b"BodyAfterTable" in parts["word/document.xml"]


def test_the_words_signature_and_date_stand_under_their_line(parts):
    """They stood under the name, on a line of their own."""
    body = etree.fromstring(parts["word/document.xml"])
    (table,) = (t for t in body.iter(f"{W}tbl")
                if t.find(f"{W}tblPr/{W}tblStyle").get(f"{W}val") == "SignTable")  # fmt: skip
    rows = [["".join(cell.itertext()) for cell in row.iterfind(f"{W}tc")]
            for row in table.iterfind(f"{W}tr")]  # fmt: skip
    assert [row[0] for row in rows] == ["Выполнил", "Руководитель"]
    assert all(row[2].strip("\u00a0 ") == "подпись, дата" for row in rows)
    last = table.find(f"{W}tr").findall(f"{W}tc")[2]
    assert last.find(f".//{W}br") is not None and last.find(f".//{W}jc").get(f"{W}val") == "center"


def test_the_line_of_admission_begins_where_the_names_do(parts):
    """It began in the middle of the sheet and broke before the year."""
    styles = etree.fromstring(parts["word/styles.xml"])
    indents = {
        style.get(f"{W}styleId"): style.find(f"{W}pPr/{W}ind") for style in styles.iter(f"{W}style")
    }
    assert indents["CoverPeople"] is None and indents["CoverPerson"] is None
    text = parts["word/document.xml"].decode()
    assert re.search(r'"CoverPeople"/></w:pPr><w:r><w:t[^>]*>Допущен к защите', text)


def test_branches_of_a_brace_stand_in_columns(parts):
    text = parts["word/document.xml"].decode()
    assert USUAL.table_continuation
    assert '<m:mcJc m:val="left"/>' in text and "eqArr" not in text
