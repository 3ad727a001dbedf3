"""The seeded defects of a generated class, each with the verdicts that it must get."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from openpyxl import Workbook

from reports.grading.issuing.assignment import Assignment
from reports.model.evaluation import Values
from reports.workbook.layout import Layout
from tests.grading.fill import Formula
from tests.grading.forms import insert

Formulas = dict[str, list[Formula]]
Change = Callable[[Formulas, Values, Assignment], Formulas]


@dataclass(frozen=True)
class Defect:
    """A kind of student: what differs from the solved book and what the grading must say.

    ``verdicts`` names the items that are not right; ``carried`` tells that everything that
    depends on them is carried forward, and nothing else differs.
    """

    name: str
    change: Change = lambda formulas, values, assignment: {}
    verdicts: dict[str, str] = field(default_factory=dict)
    causes: dict[str, str] = field(default_factory=dict)
    edit: Callable[[Workbook, Layout], None] | None = None
    after: Callable[[bytes], bytes] | None = None
    note: str = ""
    manual: bool = False
    forms: tuple[str, ...] = ("own", "office", "excel")


def one(item: str, make: Callable[[str], Formula]) -> Change:
    """Change every formula of one node."""
    return lambda formulas, values, assignment: {item: [make(str(f)) for f in formulas[item]]}


def both(*changes: Change) -> Change:
    """Several changes in one book."""

    def change(formulas: Formulas, values: Values, assignment: Assignment) -> Formulas:
        collected: Formulas = {}
        for part in changes:
            collected |= part(formulas, values, assignment)
        return collected

    return change


def typed(table: str, key: str, rows: slice = slice(None)) -> Change:
    """Right numbers typed over the formulas."""

    def change(formulas: Formulas, values: Values, assignment: Assignment) -> Formulas:
        node = f"{table}.{key}"
        items = list(formulas[node])
        items[rows] = [round(float(v), 4) for v in values.columns[table][key][rows]]
        return {node: items}

    return change


def blank(node: str, rows: slice = slice(None)) -> Change:
    """Cells left empty."""

    def change(formulas: Formulas, values: Values, assignment: Assignment) -> Formulas:
        items = list(formulas[node])
        items[rows] = [None] * len(items[rows])
        return {node: items}

    return change


def shifted(node: str) -> Change:
    """Each row takes the formula of the row above."""
    return lambda f, v, a: {node: [f[node][0], *f[node][:-1]]}


def neighbour(node: str, other: str) -> Change:
    """The formulas of another column."""
    return lambda f, v, a: {node: list(f[other])}


def _rename(book: Workbook, layout: Layout) -> None:
    sheet = book["П3.1"]
    sheet.title = "Моя кинематика"
    for other in book.worksheets:
        for line in other.iter_rows():
            for cell in line:
                if isinstance(cell.value, str) and cell.value.startswith("="):
                    cell.value = cell.value.replace("'П3.1'!", "'Моя кинематика'!")
    for name in book.defined_names.values():
        name.attr_text = name.attr_text.replace("'П3.1'!", "'Моя кинематика'!")
    book.move_sheet(sheet, 5)


def _insert(book: Workbook, layout: Layout) -> None:
    insert(book, "П3.1", row=3)
    insert(book, "П3.1", row=9)
    insert(book, "П3.1", column=3)
    insert(book, "Массы", row=7)


def _without_names(book: Workbook, layout: Layout) -> None:
    """Our own names are gone; the names that formulas use must stay."""
    for name in list(book.defined_names):
        if name.startswith(("col_", "cell_")):
            del book.defined_names[name]


def _helper(book: Workbook, layout: Layout) -> None:
    """Angles in radians in an own column, used by the answers."""
    sheet = book["П3.1"]
    for row in range(6, 19):
        sheet.cell(row, 14).value = f"=RADIANS(A{row})"
        sheet.cell(row, 5).value = f"=r_crank*omega*SIN(N{row})"


def _changed_input(book: Workbook, layout: Layout) -> None:
    cell = layout.cells["regime_speed_rpm"]
    book[cell.sheet].cell(cell.row, cell.column).value = 5000


def _inlined(f: str) -> str:
    return f.replace("r_crank", "(geometry_crank_radius_mm/1000)").replace(
        "omega", "(PI()*regime_speed_rpm/30)"
    )


V1, S1, S2, S, J, V = (
    f"P3_1.{key}" for key in ("v1_m_s", "s1_mm", "s2_mm", "s_mm", "j_m_s2", "v_m_s")
)
BETA, M = "P3_2.beta_rad", "P4_1.M_Nm"

DEFECTS = (
    Defect("right"),
    Defect("omega", one("omega", lambda f: "=regime_speed_rpm*PI()/60"),
           {"geometry.omega": "wrong"}),
    Defect("degrees", one(V1, lambda f: f.replace("RADIANS", "")), {V1: "wrong"},
           {V1: "градусы вместо радиан"}),
    Defect("sign", one(S1, lambda f: f"=-({f[1:]})"), {S1: "wrong"}, {S1: "обратный знак"}),
    Defect("thousand", one(S2, lambda f: f"=({f[1:]})/1000"), {S2: "wrong"}, {S2: "в 1000 раз"}),
    Defect("ten", one("F_piston", lambda f: f"=10*({f[1:]})"), {"geometry.F_piston": "wrong"},
           {"geometry.F_piston": "в 10 раз"}),
    Defect("stroke", one(V1, lambda f: f.replace("r_crank", "S_stroke")), {V1: "wrong"},
           {V1: "ход поршня S вместо радиуса"}),
    Defect("lambda", one("lam", lambda f: "=47/{other_rod}"), {"geometry.lam": "wrong"},
           {"geometry.lam": "варианта"}),
    Defect("speed", one("omega", lambda f: "=PI()*{other_speed}/30"), {"geometry.omega": "wrong"},
           {"geometry.omega": "варианта"}),
    Defect("neighbour", neighbour(V, S), {V: "wrong"}, {V: "соседнего столбца"}),
    Defect("shifted", shifted("P3_1.j1_m_s2"), {"P3_1.j1_m_s2": "wrong"},
           {"P3_1.j1_m_s2": "на одну строку"}),
    Defect("exact", one(S, lambda f: "=1000*r_crank*((1-COS(RADIANS({a})))"
                                     "+(1-SQRT(1-lam^2*SIN(RADIANS({a}))^2))/lam)"), {S: "wrong"},
           {S: "точн"}),
    Defect("typed", typed("P3_1", "v1_m_s"), {V1: "typed"}),
    Defect("typed rows", typed("P4_1", "M_Nm", slice(3, 6)), {M: "typed"}),
    Defect("constants", one("V_h", lambda f: "={value}"), {"geometry.V_h": "typed"}),
    Defect("empty", blank("P4_2.Msum_Nm"), {"P4_2.Msum_Nm": "empty"}),
    Defect("empty rows", blank(V, slice(-2, None)), {V: "empty"}),
    Defect("error", one("P3_2.omega_rod_exact_1_s", lambda f: f"=({f[1:]})/0"),
           {"P3_2.omega_rod_exact_1_s": "error"}),
    Defect("text", one("P3_2.eps_rod_approx_1_s2", lambda f: "не знаю"),
           {"P3_2.eps_rod_approx_1_s2": "wrong"}),
    Defect("circle", one("P3_2.omega_rod_approx_1_s", lambda f: f + "+0*{self}"),
           {"P3_2.omega_rod_approx_1_s": "error"}, forms=("own", "excel")),
    Defect("copied", both(one("omega", lambda f: "=regime_speed_rpm*PI()/60"),
                          typed("P3_1", "v1_m_s"), one("P3_1.v2_m_s", lambda f: "={own_wrong}")),
           {"geometry.omega": "wrong", V1: "typed", "P3_1.v2_m_s": "wrong"}),
    Defect("changed input", edit=_changed_input, note="изменены исходные"),
    Defect("renamed", edit=_rename, note="теперь «Моя кинематика»"),
    Defect("inserted", edit=_insert, note="строки сдвинуты"),
    # Filled with the program's own formulas: without the issued names that is a solved book.
    Defect("names lost", edit=_without_names, note="найдены по заголовкам", manual=True),
    Defect("own helper", edit=_helper),
    Defect("inlined", one(V1, _inlined)),
    Defect("lookup", one("r_crank", lambda f: "=VLOOKUP(geometry_crank_radius_mm,"
                                              "{radius}:{radius},1,FALSE)/1000")),
    Defect("indirect", one("V_c", lambda f: '=INDIRECT("V_h")/(geometry_compression_ratio-1)'),
           {"geometry.V_c": "unknown"}, manual=True),
    Defect("several", both(one(S1, lambda f: f"=-({f[1:]})"), typed("P3_2", "beta_rad"),
                           blank("P4_1.S_MPa"), one("c_m", lambda f: f"=1000*({f[1:]})")),
           {S1: "wrong", BETA: "typed", "P4_1.S_MPa": "empty", "geometry.c_m": "wrong"},
           {S1: "обратный знак", "geometry.c_m": "в 1000 раз"}),
)  # fmt: skip
