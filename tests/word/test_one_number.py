"""Workbook, PDF, Word and sheet say the same: one walk over the key numbers of an engine."""

from __future__ import annotations

import io
import re
import subprocess
from pathlib import Path

import ezdxf
import openpyxl
import pytest
from ezdxf import recover

from reports.document.text.terms import Terms
from reports.document.text.texts import of_digits
from reports.sheet.write import sheet_files
from tests.cover import ALL, chapters, samples_with, sparse
from tests.document.report_samples import shipped_pdf
from tests.document.test_report_sentences import PROGRAM
from tests.word.docx_samples import docx_of, model_of, page_of, part, root_of, text_of
from tests.workbook.made import book as own_book

# Setting pages takes longest and says the same of the text: an engine in line, a V.
PRINTED = ("gots-p3", "yamz-236")
# What every note, every sheet and every summary of the workbook tells.
KEYS = ("M_mean", "M_max", "M_min", "Rpin_mean", "Rpin_max_kN")


def shown(text: str) -> set[str]:
    """Numbers of a text as they are printed, without the spaces between thousands."""
    plain = re.sub(r"(?<=\d)[\u00a0\u202f ](?=\d{3}\b)", "", text)
    return set(re.findall(r"−?\d+(?:,\d+)?", plain))


def words_of(pdf: bytes, path: Path) -> str:
    path.write_bytes(pdf)
    done = subprocess.run(["pdftotext", "-layout", str(path), "-"], capture_output=True, check=True)
    return done.stdout.decode()


def of_workbook(data: bytes) -> dict[str, float]:
    """Values of the summary by their names."""
    book = openpyxl.load_workbook(io.BytesIO(data), read_only=True, data_only=True)
    values = {}
    for key in KEYS:
        sheet, cell = next(iter(book.defined_names[key].destinations))
        values[key] = book[sheet][cell.replace("$", "")].value
    return values


@pytest.mark.parametrize("name", sorted({*PRINTED, *sparse(samples_with(chapters), 3)}))
def test_the_same_number_everywhere(name, tmp_path):
    model, values = model_of(name)
    terms = Terms(model, values)
    book = own_book(name)
    files = sheet_files(model, values)
    pdfs = {"sheet PDF": files["-sheet.pdf"]}
    if name in PRINTED or ALL:
        pdfs["PDF"] = shipped_pdf(name)
    document, _ = recover.read(io.BytesIO(files["-sheet.dxf"]))
    assert isinstance(document, ezdxf.document.Drawing)
    texts = {path: words_of(pdf, tmp_path / "a.pdf") for path, pdf in pdfs.items()}
    texts["Word"] = text_of(part(docx_of(name)))
    texts["page"] = root_of(page_of(name)).body.text_content()
    texts["sheet DXF"] = " \n".join(t.dxf.text for t in document.modelspace().query("TEXT"))
    for position, text in texts.items():  # nor does a word of the program stand in any of them
        said = [text[m.start() - 40 : m.end() + 40] for m in PROGRAM.finditer(text)]
        assert said == [], position
    lines = {position: shown(text) for position, text in texts.items()}
    for key, value in of_workbook(book).items():
        number = of_digits(value, terms.quantity(key).digits)
        assert value == pytest.approx(terms.value(key), rel=1e-9)
        for position, numbers in lines.items():
            assert number.replace("\u00a0", "") in numbers, (key, number, position)
