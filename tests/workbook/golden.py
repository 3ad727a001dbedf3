"""A workbook as text, part by part, to be compared with a stored one.

``python -m tests.workbook.golden`` prints what differs from the stored texts,
``python -m tests.workbook.golden --renew`` stores the present ones.

A part is written as one line for each attribute and each text: path and value.  Cells stand as
runs down a column, with row numbers of formulas relative to the cell, so that a column of one
formula is one line.
"""

from __future__ import annotations

import difflib
import hashlib
import io
import lzma
import posixpath
import re
import sys
import zipfile
from collections import Counter
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from lxml import etree

from reports.tables.registry import build_model
from reports.workbook.caches import sheet_parts
from reports.workbook.write import workbook_bytes
from tests.layouts import layout_input

FOLDER = Path(__file__).parent / "golden"
# Small layouts on the coarsest grid that between them have every kind of sheet and chart.
BOOKS = {"basic": {}, "offset_articulated": {"method": "exact"}}
STEP = 30

# What does not matter or is held elsewhere.
IGNORED_PARTS = {"docProps/app.xml"}  # application and its version
IGNORED_PATHS = (
    re.compile(r"coreProperties/(created|modified)\b"),
    re.compile(r"workbook/calcPr@calcId\b"),
    # Cached values: the referees hold them, the last digits are nobody's.
    re.compile(r"/(num|str)Cache/pt(\[\d+\])?(@idx|/v)\b"),
)
BY_DIGEST = {"xl/theme/theme1.xml"}  # the writer's own, long and constant

_CELL = re.compile(r"(?<![A-Za-z0-9_.])(\$?[A-Z]{1,3})(\$?)(\d+)(?![\d(A-Za-z_.])")
_HEADING = "## "
_TYPES = "[Content_Types].xml"
_LIMIT, _PARTS = 40, 12  # lines of a difference and parts that are shown


@lru_cache(maxsize=4)
def book(name: str) -> bytes:
    """A workbook on the coarse grid."""
    return workbook_bytes(build_model(layout_input(name, step_deg=STEP, **BOOKS[name])))


def describe(data: bytes) -> dict[str, list[str]]:
    """Part, by the title of its sheet and its kind → its lines."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        names = _names(archive)
        return {
            names.get(part, part): _links(archive.read(part), part, names)
            if part.endswith((".rels", _TYPES)) else lines_of(part, archive.read(part))
            for part in sorted(archive.namelist(), key=_natural)
            if part not in IGNORED_PARTS
        }  # fmt: skip


def _names(archive: zipfile.ZipFile) -> dict[str, str]:
    """Part → sheet title and kind: a sheet more does not rename those behind it."""
    names: dict[str, str] = {}

    def name(part: str, whole: str) -> None:
        if part in names or part not in archive.NameToInfo:
            return
        names[part] = whole
        rels = _rels_of(part)
        if rels in archive.NameToInfo:
            names[rels] = f"{whole} rels"
            kinds: Counter[str] = Counter()
            for target in _targets(archive.read(rels), part):
                kind = posixpath.basename(posixpath.dirname(target))
                kinds[kind] += 1
                name(target, f"{whole} {kind} {kinds[kind]}")

    for title, part in sheet_parts(archive).items():
        name(part, f"«{title}»")
    return names


def _rels_of(part: str) -> str:
    folder, file = posixpath.split(part)
    return f"{folder}/_rels/{file}.rels"


def _targets(rels: bytes, part: str) -> Iterator[str]:
    """Parts that the relations of a part name, in their order."""
    for relation in etree.fromstring(rels):
        if relation.get("TargetMode") != "External":
            yield _resolved(relation.get("Target"), posixpath.dirname(part))


def _resolved(target: str, folder: str) -> str:
    return posixpath.normpath(posixpath.join("/", folder, target)).removeprefix("/")


def _links(content: bytes, part: str, names: dict[str, str]) -> list[str]:
    """Relations or types of parts, a line each, parts by their names."""
    folder = posixpath.dirname(posixpath.dirname(part))
    lines = []
    for node in etree.fromstring(content):
        target = node.get("Target") or node.get("PartName") or node.get("Extension")
        where = _resolved(target, folder) if node.get("TargetMode") != "External" else target
        kind = node.get("Type") or node.get("ContentType")
        lines.append(f"{names.get(where, where)} {posixpath.basename(kind)}")
    return sorted(lines)


def lines_of(part: str, content: bytes) -> list[str]:
    """The lines of one part."""
    if part in BY_DIGEST or not part.endswith((".xml", ".rels")):
        return [f"sha256 {hashlib.sha256(content).hexdigest()}"]
    root = etree.fromstring(content, etree.XMLParser(resolve_entities=False))
    lines = [line for line in _flat(root) if not any(path.search(line) for path in IGNORED_PATHS)]
    return lines + list(_cells(root)) if _is_sheet(root) else lines


def _is_sheet(root: etree._Element) -> bool:
    return etree.QName(root).localname == "worksheet"


def _flat(root: etree._Element, path: str = "") -> Iterator[str]:
    """Attributes and texts by path; rows of cells are left to ``_cells``."""
    name = etree.QName(root).localname
    path = f"{path}/{name}" if path else name
    for key, value in sorted(root.attrib.items()):
        yield f"{path}@{etree.QName(key).localname} = {value}"
    if name == "sheetData":
        return
    if root.text and root.text.strip():
        yield f"{path} = {root.text!r}"
    elif not len(root) and not root.attrib:
        yield path
    names = Counter(etree.QName(child).localname for child in root)
    seen: Counter[str] = Counter()
    for child in root:
        local = etree.QName(child).localname
        index = f"[{seen[local]}]" if names[local] > 1 else ""
        seen[local] += 1
        for line in _flat(child):
            yield path + "/" + line.replace(local, local + index, 1)


def _cells(root: etree._Element) -> Iterator[str]:
    """Runs of cells down a column that are alike."""
    ns = root.nsmap[None]
    columns: dict[str, list[tuple[int, str]]] = {}
    shared: dict[str, str] = {}
    for cell in root.iter(f"{{{ns}}}c"):
        match = re.fullmatch(r"([A-Z]+)(\d+)", cell.get("r"))
        text = _content(cell, ns, int(match[2]), shared)
        columns.setdefault(match[1], []).append((int(match[2]), text))
    for column, cells in columns.items():
        start = before = 0
        last = ""
        for row, text in [*sorted(cells), (0, "")]:
            if text == last and row == before + 1:
                before = row
                continue
            if start:
                yield f"{column}{start}{f':{before}' if before > start else ''} {last}"
            start = before = row
            last = text


def _content(cell: etree._Element, ns: str, row: int, shared: dict[str, str]) -> str:
    style = f"s{cell.get('s')}"
    formula = cell.find(f"{{{ns}}}f")
    if formula is not None:
        key, text = formula.get("si"), relative(formula.text or "", row)
        if key is not None:  # the others have the formula of the first
            text = shared.setdefault(key, text)
        return f"{style} {cell.get('t')} ={text}"
    text = "".join(piece.text or "" for piece in cell.iter(f"{{{ns}}}t"))
    value = cell.findtext(f"{{{ns}}}v")
    return f"{style} {text!r}" if value is None else f"{style} {value}"


def relative(formula: str, row: int) -> str:
    """A formula with its rows counted from the cell's own: ``B7`` in row 6 is ``B{+1}``."""
    pieces = re.split(r'("[^"]*")', formula)

    def shifted(match: re.Match[str]) -> str:
        if match[2]:
            return match[0]
        return f"{match[1]}{{{int(match[3]) - row:+d}}}"

    return "".join(
        piece if index % 2 else _CELL.sub(shifted, piece) for index, piece in enumerate(pieces)
    )


def _natural(name: str) -> list[tuple[int, int, str]]:
    return [
        (1, int(piece), "") if piece.isdigit() else (0, 0, piece)
        for piece in re.split(r"(\d+)", name)
    ]


def stored(name: str) -> dict[str, list[str]]:
    """The stored lines of a workbook by part."""
    parts: dict[str, list[str]] = {}
    for line in lzma.decompress((FOLDER / f"{name}.txt.xz").read_bytes()).decode().splitlines():
        if line.startswith(_HEADING):
            parts[line.removeprefix(_HEADING)] = []
        else:
            parts[next(reversed(parts))].append(line)
    return parts


def store(name: str) -> None:
    """Store the present lines; the same lines give the same file."""
    FOLDER.mkdir(exist_ok=True)
    text = "".join(
        f"{_HEADING}{part}\n" + "".join(f"{line}\n" for line in lines)
        for part, lines in describe(book(name)).items()
    )
    (FOLDER / f"{name}.txt.xz").write_bytes(lzma.compress(text.encode(), preset=9))


def differences(old: dict[str, list[str]], new: dict[str, list[str]]) -> dict[str, list[str]]:
    """Part → what changed in it, as a unified difference."""
    collected = {}
    for part in dict.fromkeys([*old, *new]):
        before, after = old.get(part), new.get(part)
        if before is None or after is None:
            collected[part] = ["the part is new" if before is None else "the part has gone"]
        elif before != after:
            listed = list(difflib.unified_diff(before, after, "stored", "now", lineterm="", n=1))
            more = len(listed) - _LIMIT
            collected[part] = listed[:_LIMIT] + ([f"… and {more} lines more"] if more > 0 else [])
    return collected


def report(collected: dict[str, list[str]]) -> str:
    """Differences to be read by a person, and the command that accepts them."""
    shown = [f"== {part}\n" + "\n".join(lines) for part, lines in list(collected.items())[:_PARTS]]
    if len(collected) > _PARTS:
        shown.append(
            f"… and {len(collected) - _PARTS} parts more: {', '.join(list(collected)[_PARTS:])}"
        )
    return "\n".join([*shown, "to accept: python -m tests.workbook.golden --renew"])


def main() -> None:
    """Print differences, or store the present texts."""
    for name in BOOKS:
        if "--renew" in sys.argv[1:]:
            store(name)
        elif actual := differences(stored(name), describe(book(name))):
            print(f"{name}: {report(actual)}")


if __name__ == "__main__":
    main()
