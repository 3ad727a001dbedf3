"""What programs that read the page aloud rely on, by the rules of PDF/UA that tags can tell."""

import itertools
import re
import zlib

from tests.document.pdftools import poppler
from tests.document.report_samples import pdf

STREAM = re.compile(rb"stream\r?\n(.*?)\r?\nendstream", re.DOTALL)
MAY_HOLD = {
    "Table": {"TR", "THead", "TBody", "TFoot", "Caption"},
    "THead": {"TR"},
    "TBody": {"TR"},
    "TR": {"TH", "TD"},
    "L": {"LI", "Caption"},
    "LI": {"Lbl", "LBody"},
}


def tree(text: str) -> list[tuple[int, str]]:
    """Depth and name of each tag, in order."""
    found = re.findall(r"(?m)^( *)([A-Z][A-Za-z0-9]*)(?:\s\((?:block|inline)\)|:)?$", text)
    return [(len(blanks) // 2, name) for blanks, name in found]


def misplaced(tags: list[tuple[int, str]]) -> list[tuple[str, str]]:
    """Tags within a table or a list that may not stand there."""
    wrong, above = [], []
    for depth, name in tags:
        above[depth:] = [name]
        parent = above[depth - 1] if depth else ""
        if parent in MAY_HOLD and name not in MAY_HOLD[parent]:
            wrong.append((parent, name))
    return wrong


def skipped(tags: list[tuple[int, str]]) -> list[int]:
    """Levels of headings that follow one more than a level above."""
    levels = [0, *(int(name[1]) for _, name in tags if re.fullmatch(r"H[1-6]", name))]
    return [new for old, new in itertools.pairwise(levels) if new > old + 1]


def objects(pdf: bytes) -> bytes:
    """The file with its object streams laid open."""
    packed = [STREAM.search(part) for part in re.split(rb"endobj", pdf) if b"/ObjStm" in part]
    return pdf + b"\n".join(zlib.decompress(found[1]) for found in packed if found)


def test_tags_follow_the_rules_of_pdf_ua(tmp_path):
    path = tmp_path / "r.pdf"
    path.write_bytes(pdf("one"))
    tags = tree(poppler("pdfinfo", "-struct", str(path)))
    names = [name for _, name in tags]
    assert misplaced(tags) == [] and skipped(tags) == []
    tables, figures, formulas = (names.count(name) for name in ("Table", "Figure", "Formula"))
    assert names[0] == "Document" and tables > 10 and figures > 10 and formulas > 50
    said = objects(path.read_bytes())
    assert said.count(b"/Alt ") == figures + formulas
    assert b"/Lang (ru" in said and b"/DisplayDocTitle true" in said
    about = poppler("pdfinfo", str(path))
    assert re.search(r"Title: +\S", about) and re.search(r"Tagged: +yes", about)


def test_a_wrong_tag_is_noticed():
    assert misplaced([(0, "Table"), (1, "P"), (1, "TR"), (2, "TD"), (3, "P")]) == [("Table", "P")]
    assert skipped([(0, "H1"), (0, "H3"), (0, "H1"), (0, "H2")]) == [3]
