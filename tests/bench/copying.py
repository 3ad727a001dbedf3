"""A class drawn on two bases that no sample holds: what is paid, told, stopped and named.

Sixty students a base through four programs: forty honest manners, forty mistakes, forty cheats,
rings of 2, 3, 5, 8 and 12, the class drawn in ten seeds, a ring copied over two years.
``KSHM_SEEDS`` is the number of seeds.
"""

from __future__ import annotations

import io
import os
import random
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import xlsxwriter
from openpyxl import load_workbook

from reports.grading.judging.collusion import rings_of
from tests.bench._figure import Figure
from tests.grading.drawn import manners
from tests.grading.drawn.classroom import BASES, DrawnClass
from tools.referees.by_libreoffice import LibreOffice

_PAID = 0.999  # of a column's points, as they are rounded
SEEDS = int(os.environ.get("KSHM_SEEDS", "10"))
RINGS = (2, 3, 5, 8, 12)
COUNT = 60


def figures() -> Iterator[Figure]:
    """Figures."""
    for base in BASES:
        class_ = DrawnClass(base, COUNT)
        yield from _honest(class_)
        yield from _mistakes(class_)
        yield from _cheats(class_)
        yield from _copying(class_)


def _honest(class_: DrawnClass) -> Iterator[Figure]:
    """Forty manners, each in one of four programs: columns paid in full."""
    paid = requested = held = 0
    chance = random.Random(7)
    for number in range(1, 41):
        angle, rest = manners.MANNERS[number - 1]
        texts = {node: rest(angle(chance.choice(forms))) for node, forms in manners.FORMS.items()}
        data = through(number % 4, class_.book(number, texts))
        result = class_.result(number, data)
        lines = [line for line in result["items"] if line["of"]]
        requested += len(lines)
        paid += sum(line["points"] >= _PAID * line["of"] for line in lines)
        held += bool(result["doubts"])
        for line in lines:
            if line["points"] < _PAID * line["of"]:
                print("  не оплачено:", class_.base, number, line["id"], line["verdict"],
                      line["reason"])  # fmt: skip
    note = f"{paid} из {requested}; задержано работ: {held}"
    yield Figure(f"{class_.base}: честных столбцов оплачено", paid / requested, "", note)


def _mistakes(class_: DrawnClass) -> Iterator[Figure]:
    """Mistakes not paid, and causes told."""
    caught = message = wanted = 0
    asked = class_.formulas(1, {})
    mistakes = [mistake for mistake in manners.MISTAKES if mistake[0] in asked]
    for i, (node, text, words) in enumerate(mistakes):
        number = i % COUNT + 1
        lines = class_.result(number, class_.book(number, {node: text}))["items"]
        item = node if "." in node else next(i["id"] for i in lines if i["id"].endswith(f".{node}"))
        line = next(line for line in lines if line["id"] == item)
        caught += line["points"] < _PAID * line["of"]
        wanted += bool(words)
        message += bool(words) and words in line["cause"]
        if words not in line["cause"] or line["points"] >= _PAID * line["of"]:
            print("  причина:", class_.base, node, text, "→", line["verdict"], line["cause"])
    note = f"{caught} из {len(mistakes)}; причина названа: {message} из {wanted}"
    yield Figure(f"{class_.base}: ошибок найдено", caught, "", note)


def _cheats(class_: DrawnClass) -> Iterator[Figure]:
    """Cheats that earn nothing."""
    stopped = count = 0
    for node in manners.CHEATED:
        for number, cheat in enumerate(manners.CHEATS, 1):
            here = class_.desk(number)
            formulas = class_.formulas(number, {})
            rows = here.layout.rows_of(here.layout.columns[node][0])
            formulas[node] = [
                cheat.replace("{v}", repr(value)).replace("{r}", str(row))
                for value, row in zip(here.column(node), rows, strict=True)
            ]
            if cheat == "{v}":
                formulas[node] = list(here.column(node))
            result = class_.result(number, class_.typed(number, formulas))
            line = next(line for line in result["items"] if line["id"] == node)
            stopped += line["points"] == 0
            count += 1
            if line["points"]:
                print("  уловка:", class_.base, node, cheat, line["verdict"])
    yield Figure(f"{class_.base}: уловок остановлено", stopped, "", f"из {count}")


def _copying(class_: DrawnClass) -> Iterator[Figure]:
    """Rings named and honest people named, over the seeds and over two years."""
    whole = members = false_held = false_told = message = 0
    for seed in range(1, SEEDS + 1):
        honest = class_.drawn(100 * seed, ())
        actual = honest.rings()
        false_held += len(honest.named(actual, held=True))
        false_told += len(honest.named(actual, held=False))
        drawn = class_.drawn(seed, RINGS)
        actual = drawn.rings()
        copied = frozenset().union(*drawn.members)
        held, named = (drawn.named(actual, held=word) for word in (True, False))
        whole += sum(
            any(ring.held and ring_of <= {work.number for work in ring.works} for ring in actual)
            for ring_of in drawn.members
        )
        members, message = members + len(held & copied), message + len(named & copied)
        false_held, false_told = false_held + len(held - copied), false_told + len(named - copied)
    count = SEEDS * sum(RINGS)
    name = f"{class_.base}: зёрен {SEEDS}"
    yield Figure(f"{name}, кругов задержано целиком", whole, "", f"из {SEEDS * len(RINGS)}")
    yield Figure(f"{name}, списавших задержано", members, "", f"из {count}; названо {message}")
    yield Figure(f"{name}, честных задержано", false_held, "", f"названо {false_told}")
    past = drawn.as_past("прошлый год")
    texts, helpers = manners.source(random.Random(SEEDS))
    late = [class_.work(n, class_.book(n, manners.copied(random.Random(n), texts), helpers), {})
            for n in (1, 2, 3)]  # fmt: skip
    again = class_.drawn(100 * SEEDS, ()).works[3:]
    actual = rings_of([*late[:1], *again], past)
    caught = sum(ring.held and bool(ring.past) for ring in actual)
    others = {work.number for ring in actual for work in ring.works} - {1}
    name = f"{name}, списавший у прошлого года задержан"
    yield Figure(name, caught, "", f"честных названо: {len(others)}")


# --- programs ------------------------------------------------------------------------------------


def through(program: int, data: bytes) -> bytes:
    """A book as openpyxl, XlsxWriter, LibreOffice or Gnumeric saves it."""
    if program == 1:
        return _by_xlsxwriter(data)
    if program == 2:
        return LibreOffice().converted([data])[0]
    if program == 3 and shutil.which("ssconvert"):
        with tempfile.TemporaryDirectory(prefix="kshm-gnumeric-") as name:
            before, after = Path(name) / "a.xlsx", Path(name) / "b.xlsx"
            before.write_bytes(data)
            command = ["ssconvert", "-T", "Gnumeric_Excel:xlsx2", str(before), str(after)]
            subprocess.run(command, check=True, capture_output=True)
            return after.read_bytes()
    return data


def _by_xlsxwriter(data: bytes) -> bytes:
    """Cells, formulas and names written anew."""
    book, stream = load_workbook(io.BytesIO(data)), io.BytesIO()
    with xlsxwriter.Workbook(stream) as target:
        for sheet in book.worksheets:
            own = target.add_worksheet(sheet.title)
            for line in sheet.iter_rows():
                for cell in line:
                    if cell.value is not None:
                        own.write(cell.row - 1, cell.column - 1, cell.value)
        for name, defined in book.defined_names.items():
            target.define_name(name, f"={defined.attr_text}")
        for prop in book.custom_doc_props:
            target.set_custom_property(prop.name, str(prop.value))
    return stream.getvalue()
