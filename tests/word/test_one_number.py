"""Workbook, PDF, Word and sheet say the same: one walk over the key numbers of an engine."""

from __future__ import annotations

import io
import re
import subprocess

import ezdxf
import openpyxl
import pytest
from docx_samples import docx_of, model_of, part, text_of
from ezdxf import recover

from reports.document.report import report_pdf
from reports.document.text.numbers import of_digits
from reports.document.text.terms import Terms
from reports.sheet.write import sheet_files
from reports.workbook.write import workbook_bytes
from tests.cover import chapters, samples_with

# What every note, every sheet and every summary of the workbook tells.
KEYS = ("M_mean", "M_max", "M_min", "Rpin_mean", "Rpin_max_kN")


def shown(text: str) -> set[str]:
    """Numbers of a text as they are printed, without the spaces between thousands."""
    plain = re.sub(r"(?<=\d)[\u00a0\u202f ](?=\d{3}\b)", "", text)
    return set(re.findall(r"−?\d+(?:,\d+)?", plain))


def of_workbook(data: bytes) -> dict[str, float]:
    """Values of the summary by their names."""
    book = openpyxl.load_workbook(io.BytesIO(data), read_only=True, data_only=True)
    values = {}
    for key in KEYS:
        sheet, cell = next(iter(book.defined_names[key].destinations))
        values[key] = book[sheet][cell.replace("$", "")].value
    return values


@pytest.mark.parametrize("name", samples_with(chapters))
def test_the_same_number_everywhere(name, tmp_path):
    model, values = model_of(name)
    terms = Terms(model, values)
    source = tmp_path / f"{name}.toml"
    source.write_text("")
    book = workbook_bytes(model, values)
    (tmp_path / "a.pdf").write_bytes(report_pdf(model, values, source=source, workbook=book))
    files = sheet_files(model, values)
    (tmp_path / "b.pdf").write_bytes(files["-sheet.pdf"])
    document, _ = recover.read(io.BytesIO(files["-sheet.dxf"]))
    texts = [text_of(part(docx_of(name)))]
    for pdf in ("a.pdf", "b.pdf"):
        done = subprocess.run(["pdftotext", "-layout", str(tmp_path / pdf), "-"],
                              capture_output=True, check=True)  # fmt: skip
        texts.append(done.stdout.decode())
    texts.append(" \n".join(t.dxf.text for t in document.modelspace().query("TEXT")))
    told = dict(zip(("Word", "PDF", "sheet PDF", "sheet DXF"), map(shown, texts), strict=True))
    assert isinstance(document, ezdxf.document.Drawing)
    for key, value in of_workbook(book).items():
        number = of_digits(value, terms.quantity(key).digits)
        assert value == pytest.approx(terms.value(key), rel=1e-9)
        for place, numbers in told.items():
            assert number.replace("\u00a0", "") in numbers, (key, number, place)
