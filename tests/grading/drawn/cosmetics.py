"""A ring that looks different: seven rare formulas, three helper cells on a sheet of one's own."""

from __future__ import annotations

import io
import random
import re
from collections.abc import Sequence

from openpyxl import load_workbook
from openpyxl.workbook.defined_name import DefinedName

from reports.grading.judging.work_digest import Work
from tests.grading.drawn import manners
from tests.grading.drawn.classroom import DrawnClass

_P = manners.P
RARE = {
    "P3_1.s1_mm": f"=1000*r_crank*(1-SIN(PI()/2-{_P}))",
    "P3_1.v1_m_s": f"=r_crank*omega*COS(PI()/2-{_P})",
    "P3_1.j1_m_s2": f"=r_crank*omega^2*SIN(PI()/2-{_P})",
    "P4_1.N_MPa": "=F{r}*COS(PI()/2-J{r})",
    "P4_1.S_MPa": "=D{r}/SIN(PI()/2-J{r})",
    "P4_1.M_Nm": "=G{r}*V_h*500",
    "F_piston": "=PI()*(geometry_bore_mm/1000)^2*0.25+0",
}
HELPERS = ("=SIN(RADIANS(3))^3+lam", "=1-lam^3", "=r_crank^2/720")
NAMES = ("k_popr", "q_mnozh", "z_zapas")


def ring(
    class_: DrawnClass, titles: Sequence[str], *, fixed: bool = False, headed: bool = True,
    names: Sequence[str] = (),
) -> list[Work]:  # fmt: skip
    """Works of the first four, alike but for the looks; ``fixed``: every other has ``$`` signs."""
    texts = manners.honest(random.Random(5), 3) | RARE
    works = []
    for number in range(1, 5):
        own = dict(texts)
        if fixed and number % 2:
            own |= {node: re.sub(r"\b([A-Z]\{r\})", r"$\1", text) for node, text in RARE.items()}
        data = _with_sheet(
            class_.book(number, own), titles[number % len(titles)], names, headed=headed
        )
        works.append(class_.work(number, data, {}))
    return works


def _with_sheet(data: bytes, title: str, names: Sequence[str], *, headed: bool) -> bytes:
    book = load_workbook(io.BytesIO(data))
    sheet = book.create_sheet(title)
    for column, text in enumerate(HELPERS, 2):
        sheet.cell(4, column).value = text
        if headed:
            sheet.cell(3, column).value = f"поправка {column}"
    for column, name in enumerate(names, 2):
        position = f"'{title}'!${sheet.cell(4, column).column_letter}$4"
        book.defined_names[name] = DefinedName(name, attr_text=position)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()
