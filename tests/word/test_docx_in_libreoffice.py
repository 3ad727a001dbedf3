"""LibreOffice opens the Word file whole and renews its numbers after a chapter is put in."""

from __future__ import annotations

import copy
import io
import json
import re
import shutil
import subprocess
from pathlib import Path

import docx
import pytest
from docx.oxml.ns import qn

from tests.conftest import missing
from tests.document.report_samples import shipped_pdf
from tests.word.docx_samples import NAME, M, W, docx_of, page_of, part, root_of

PYTHON = "/usr/bin/python3"
pytestmark = pytest.mark.xdist_group(NAME)  # the process that makes the file
WRITER = Path("/usr/lib/libreoffice/program/libswlo.so")


@pytest.fixture(scope="module", autouse=True)
def _writer() -> None:
    if not (WRITER.exists() and shutil.which("soffice") and shutil.which("pdftotext")):
        missing("LibreOffice Writer", "libreoffice-writer-nogui libreoffice-math-nogui")


def with_chapter(data: bytes) -> bytes:
    """The file with a chapter before the fourth, which has a figure, a table and a formula."""
    document = docx.Document(io.BytesIO(data))
    chapters = [p for p in document.paragraphs if p.style.name == "Heading 1"]
    chapters[3].add_run(" (исправлено)")
    styles = ("Название рисунка", "Название таблицы")
    samples = [next(p for p in document.paragraphs if p.style.name == name) for name in styles]
    chapters[3].insert_paragraph_before("Глава студента", style="Heading 1")
    for sample, words in zip(samples, (" — Свой рисунок", " — Своя таблица"), strict=True):
        clone = copy.deepcopy(sample._p)
        for mark in (*clone.iter(qn("w:bookmarkStart")), *clone.iter(qn("w:bookmarkEnd"))):
            mark.getparent().remove(mark)
        list(clone.iter(qn("w:t")))[-1].text = words
        chapters[3]._p.addprevious(clone)
    stream = io.BytesIO()
    document.save(stream)
    return stream.getvalue()


@pytest.fixture(scope="module")
def renewed(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, int], Path]:
    """Counts and the PDF of LibreOffice, of the file with a chapter put in."""
    folder = tmp_path_factory.mktemp("word")
    source, built = folder / "put_in.docx", folder / "put_in.pdf"
    source.write_bytes(with_chapter(docx_of(NAME)))
    script = Path(__file__).with_name("renewed.py")
    done = subprocess.run(
        [PYTHON, str(script), str(folder / "profile"), str(source), str(built)],
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout.splitlines()[-1]), built


def pages(pdf: Path) -> int:
    message = subprocess.run(["pdfinfo", str(pdf)], capture_output=True, text=True, check=True)
    return int(re.search(r"Pages:\s+(\d+)", message.stdout)[1])


def text_of(pdf: Path) -> str:
    message = subprocess.run(
        ["pdftotext", "-layout", str(pdf), "-"], capture_output=True, check=True
    )  # fmt: skip
    return re.sub(r"[ \u00a0]+", " ", message.stdout.decode())


def test_nothing_is_lost(tmp_path, renewed):
    counts, built = renewed
    document = part(docx_of(NAME))
    assert counts["formulas"] == len(document.findall(f".//{M}oMath"))
    assert counts["tables"] == len(document.findall(f".//{W}tbl"))
    assert counts["pictures"] == len(root_of(page_of(NAME)).findall(".//figure"))
    usual = tmp_path / "usual.pdf"
    usual.write_bytes(shipped_pdf(NAME))
    assert abs(pages(built) - 1 - pages(usual)) <= 0.1 * pages(usual)  # one with the chapter


def file_text(data: bytes) -> str:
    """Paragraphs as the file has them, with the numbers that its fields were made with."""
    said = ("".join(t.text for t in p.iter(f"{W}t")) for p in part(data).iter(f"{W}p"))
    return re.sub(r"[ \u00a0]+", " ", "\n".join(said))


def numbers_of(text: str, words: str) -> list[int]:
    return [int(n) for n in re.findall(rf"{words} (\d+) —", text)]


def test_a_chapter_put_in_renumbers_what_follows(renewed):
    old, new = file_text(docx_of(NAME)), text_of(renewed[1])
    figures, tables = (numbers_of(new, words) for words in ("Рисунок", "Таблица"))
    assert figures == list(range(1, len(numbers_of(old, "Рисунок")) + 2))
    assert tables == list(range(1, len(numbers_of(old, "Таблица")) + 2))
    assert "4 Глава студента" in new
    assert "5 Динамика кривошипно-шатунного механизма (исправлено)" in new
    contents = new[new.index("СОДЕРЖАНИЕ") : new.index("ВВЕДЕНИЕ")]
    assert re.search(r"4 Глава студента\.+ ?\d+", contents)
    for title in re.findall(r"Рисунок \d+ — (Индикаторный крутящий[^\n]*)", old):
        was = int(re.search(rf"Рисунок (\d+) — {re.escape(title)}", old)[1])
        assert f"Рисунок {was + 1} — {title}" in new
        requested = r"рисунк\w+\s+{}\b"
        assert re.search(requested.format(was), old) and re.search(requested.format(was + 1), new)
