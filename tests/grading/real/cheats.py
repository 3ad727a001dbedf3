"""Cheats: numbers that look like formulas, circles, blanks, foreign books.  None is paid."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

from openpyxl import Workbook
from openpyxl.worksheet.formula import ArrayFormula
from openpyxl.worksheet.worksheet import Worksheet

from reports.grading.issuing.handout import TICKET_NAME
from reports.tables.registry import build_model
from reports.workbook.write import workbook_bytes
from tests.grading.real.books import Work, literals, rows, saved
from tests.grading.real.desk import Desk, desk
from tests.grading.real.written import COLUMNS, WRITTEN

M, T, S1, V1, J1, N = (
    "P4_1.M_Nm", "P4_1.T_MPa", "P3_1.s1_mm", "P3_1.v1_m_s", "P3_1.j1_m_s2", "P4_1.N_MPa",
)  # fmt: skip
PS, S = "P4_1.Ps_MPa", "P4_1.S_MPa"
_FROM_M = "=I{r}/F_piston/r_crank/10^6"


def disguised(name: str, node: str, template: str, **more: object) -> Work:
    """Right numbers in formulas that do not calculate them; ``{v}`` is the number."""
    return Work(
        name, lambda here: {node: literals(template, here.column(node))}, unpaid=(node,), **more
    )  # type: ignore[arg-type]


def _pasted(formula: str, node: str) -> Callable[[Workbook, Desk], None]:
    """A look-up on a sheet of pasted numbers."""

    def edit(book: Workbook, here: Desk) -> None:
        sheet = own_sheet(book)
        sheet.sheet_state = "veryHidden"
        for row, value in zip(rows(), here.column(node), strict=False):
            sheet.cell(row, 1).value = f"='П4.1'!A{row}"
            sheet.cell(row, 2).value = value
            position = here.layout.columns[node]
            text = formula.replace("{r}", str(row)).replace("Расчёт", sheet.title)
            book[position[0].sheet].cell(row, position[1]).value = text

    return edit


def own_sheet(book: Workbook) -> Worksheet:
    """One more sheet of numbers: a book may hold several cheats."""
    return book.create_sheet(f"Числа_{len(book.sheetnames)}_")


def _scaled(by: str, key: str) -> Callable[[Desk], dict[str, object]]:
    def change(here: Desk) -> dict[str, object]:
        base = here.scalar(key) if key in here.values.scalars else float(here.issued.drawn[key])
        return {J1: literals(f"={{v}}*({by}/{base!r})^2", here.column(J1))}

    return change


def _times(
    text: str, node: str, *, friend: bool = False, digits: int = 15
) -> Callable[[Workbook, Desk], None]:
    """A column pasted on a sheet of its own, scaled by the input data as the right one is."""

    def edit(book: Workbook, here: Desk) -> None:
        owner = desk(here.other.number) if friend else here
        speed = owner.issued.drawn["regime.speed_rpm"]
        sheet, position = own_sheet(book), here.layout.columns[node]
        for row, value in zip(rows(), owner.column(node), strict=False):
            sheet.cell(row, 1).value = text.replace("{v}", repr(round(value, digits)))
            if "=" not in text:
                sheet.cell(row, 1).value = round(value, digits)
            power = 1 if node == V1 else 2
            formula = f"={sheet.title}!A{row}*(regime_speed_rpm/{speed})^{power}"
            book[position[0].sheet].cell(row, position[1]).value = formula

    return edit


def _hidden(cell: str, formula: str) -> Callable[[Workbook, Desk], None]:
    """A column pasted on a sheet of its own as no number, scaled as the right one is.

    ``{v}`` is the value in millionths, ``~`` stands for so many signs as it has hundredths, ``{c}``
    for the cell, ``{d}`` for the value by the digits in ten other cells.
    """

    def edit(book: Workbook, here: Desk) -> None:
        sheet, position = own_sheet(book), here.layout.columns[V1]
        for digit in range(10):
            sheet.cell(digit + 1, 3).value = digit
        for row, value in zip(rows(), here.column(V1), strict=False):
            whole, sign = f"{round(abs(value) * 1e6)}", "-" if value < 0 else ""
            sheet.cell(row, 1).value = cell.replace("{v}", whole).replace(
                "~", "x" * round(abs(value) * 100)
            )
            digits = "+".join(f"{sheet.title}!$C${int(d) + 1}*10^{len(whole) - 1 - i}"
                              for i, d in enumerate(whole))  # fmt: skip
            text = formula.replace("{c}", f"{sheet.title}!A{row}").replace("{d}", f"({digits})")
            text = text.replace("{r}", f"{max(1, round(abs(value) * 1000))}")
            text = f"={sign}{text}*regime_speed_rpm/{here.issued.drawn['regime.speed_rpm']}"
            book[position[0].sheet].cell(row, position[1]).value = text

    return edit


def _picked(text: str) -> Callable[[Desk], dict[str, object]]:
    """A short list of numbers in one formula, scaled by the input data as the right one is.

    The numbers of a half turn stand in ``@``, by cases in ``#``, as digits of a text in ``~``.
    """

    def change(here: Desk) -> dict[str, object]:
        numbers = [round(v, 2) for v in here.column(J1)]
        speed = here.issued.drawn["regime.speed_rpm"]
        plain, cases = (
            ",".join(map(repr, numbers)),
            "+".join(f"(A{{r}}={30 * i})*{v}" for i, v in enumerate(numbers)),
        )
        digits = "".join(f"{v:+010.2f}" for v in numbers)
        whole = text.replace("@", plain).replace("#", cases).replace("~", digits)
        rows_ = [whole.replace("{r}", str(row)) for row in rows()[: len(numbers)]]
        return {J1: [f"=({one})*(regime_speed_rpm/{speed})^2" for one in rows_]}

    return change


def _only_mine(here: Desk) -> dict[str, object]:
    speed = here.issued.drawn["regime.speed_rpm"]
    return {S1: literals(f"=IF(regime_speed_rpm={speed},{{v}},D{{r}})", here.column(S1))}


def _back(here: Desk) -> dict[str, object]:
    return {M: here.column(M), T: _FROM_M}


def _back_but_one(column: str) -> Callable[[Desk], dict[str, object]]:
    """Backwards from typed numbers; one cell of ``column`` is another number."""

    def change(here: Desk) -> dict[str, object]:
        values = {M: here.column(M), T: [_FROM_M.replace("{r}", str(row)) for row in rows()]}
        values[column][3] = 1.5
        return values  # type: ignore[return-value]

    return change


def _circle_elsewhere(here: Desk) -> dict[str, object]:
    """A circle that closes for every engine but one's own."""
    bore = here.issued.drawn["geometry.bore_mm"]
    text = f"=IF(geometry_bore_mm={bore},{{v}},F{{r}}*COS(J{{r}}))"
    return {PS: literals(text, here.column(PS)), S: "=D{r}/COS(J{r})"}


def _choose(here: Desk) -> dict[str, object]:
    numbers = ",".join(repr(v) for v in here.column(S1))
    return {S1: f"=CHOOSE(A{{r}}/30+1,{numbers})"}


def _list(here: Desk) -> dict[str, object]:
    angles = ",".join(str(30 * i) for i in range(13))
    numbers = ",".join(repr(v) for v in here.column(S1))
    text = f"LOOKUP(A@,{{{angles}}},{{{numbers}}})"
    return {S1: ["=" + text.replace("@", str(row)) for row in rows()]}


def _array_list(here: Desk) -> dict[str, object]:
    numbers = ";".join(repr(v) for v in here.column(S1))
    return {S1: ArrayFormula("B6:B18", f"={{{numbers}}}+0*A6:A18")}


def _ratio(here: Desk) -> dict[str, object]:
    s2 = here.column("P3_1.s2_mm")
    texts = [f"=C{row}*{a / b!r}" if b else "=0*A6"
             for row, a, b in zip(rows(), here.column(S1), s2, strict=False)]  # fmt: skip
    return {S1: texts}


def _blank(*keys: str) -> Callable[[Desk], dict[str, object]]:
    return lambda here: dict.fromkeys(keys)


def _name_constant(book: Workbook, here: Desk) -> None:
    from openpyxl.workbook.defined_name import DefinedName

    for row, value in zip(rows(), here.column(S1), strict=False):
        book.defined_names[f"k_{row}"] = DefinedName(f"k_{row}", attr_text=repr(value))
        book["П3.1"].cell(row, 2).value = f"=k_{row}"


def _given_replaced(book: Workbook, here: Desk) -> None:
    for row, value in zip(rows(), here.column("P4_2.M2_Nm"), strict=True):
        book["Цилиндры"].cell(row, 12).value = value


def _own_name_in_the_ticket(data: bytes, here: Desk) -> bytes:
    return data


def _foreign(where: str) -> Callable[[bytes, Desk], bytes]:
    """A friend's filled book: his numbers, his formulas; the identifier as ``where`` says."""

    def after(data: bytes, here: Desk) -> bytes:
        friend = desk(here.other.number)
        mine = {"own": here.issued.ticket, "altered": here.issued.ticket[:-2] + "AA",
                "none": "", "friend": friend.issued.ticket}[where]  # fmt: skip
        return reticketed(_written(friend.issued.number), friend.issued.ticket, mine)

    return after


@lru_cache(maxsize=1)
def _written(number: int) -> bytes:
    """The book of a student as written."""
    return saved(desk(number), WRITTEN)


def reticketed(data: bytes, old: str, new: str) -> bytes:
    """A book with another identifier in all places."""
    stream = io.BytesIO()
    with (zipfile.ZipFile(io.BytesIO(data)) as source,
          zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target):  # fmt: skip
        for name in source.namelist():
            target.writestr(name, source.read(name).replace(old.encode(), new.encode() or b"-"))
    return stream.getvalue()


def _solved(data: bytes, here: Desk) -> bytes:
    """The program's own solved book of the variant; charts, half of the time, tell nothing."""
    return workbook_bytes(replace(build_model(here.assignment.model.input), charts=()))


def _solved_with_ticket(book: Workbook, here: Desk) -> None:
    """The solved book's numbers pasted as a sheet, all answers read from there."""
    sheet = book.create_sheet("Готово")
    for column, node in enumerate(COLUMNS, 1):
        for row, value in zip(rows(), here.column(node), strict=False):
            sheet.cell(row, column).value = value
        table, at = here.layout.columns[node]
        letter = sheet.cell(1, column).column_letter
        for row in here.layout.rows_of(table):
            book[table.sheet].cell(row, at).value = f"=Готово!{letter}{row}+0*$A{row}"


def _friends_inputs(book: Workbook, here: Desk) -> None:
    """The friend's input data typed over one's own."""
    names = {"geometry.bore_mm": "geometry_bore_mm", "regime.speed_rpm": "regime_speed_rpm",
             "geometry.rod_length_mm": "geometry_rod_length_mm",
             "masses.reciprocating_kg": "masses_reciprocating_kg"}  # fmt: skip
    for key, name in names.items():
        cell = here.layout.cells[name]
        book[cell.sheet].cell(cell.row, cell.column).value = here.other.drawn[key]


ODD = {
    "P3_1.s1_mm": "=r_crank*1000-1000*r_crank*COS(A{r}*PI()/180)+0*(A{r}-A{r})",
    "P3_1.v1_m_s": "=omega*SIN(A{r}/57.29577951308232)*r_crank*1/1",
    "P4_1.T_MPa": "=(D{r}*SIN(A{r}/57.29577951308232+J{r}))/(COS(J{r})*1+0)",
    "P4_1.M_Nm": "=G{r}*1000*1000*(F_piston*r_crank)+0",
    "P4_2.Msum_Nm": "=D{r}+(C{r}+(B{r}+0))",
    "P3_1.v2_m_s": "=0.5*omega*r_crank*lam*SIN(2*A{r}/57.29577951308232)*1",
}  # fmt: skip

_CIRCLE = {"P3_1.s1_mm": "=D{r}-C{r}", "P3_1.s_mm": "=B{r}+C{r}"}
_RING = {"P3_1.v1_m_s": "=G{r}-F{r}", "P3_1.v2_m_s": "=G{r}-E{r}", "P3_1.v_m_s": "=E{r}+F{r}"}
_OF_OMEGA = ("P3_1.v1_m_s", "P3_1.j1_m_s2", "P3_2.omega_rod_approx_1_s", "P4_1.j_m_s2",
             "P3_1.v_m_s", "P4_1.Pj_MPa", "P4_1.T_MPa", "P4_2.Msum_Nm")  # fmt: skip

CHEATS = (
    disguised("plus A minus A", S1, "={v}+A{r}-A{r}"),
    disguised("plus nought times", S1, "={v}+0*H{r}*TAN(A{r})"),
    disguised("never the else", S1, "=IF(A{r}<0,H{r},{v})"),
    disguised("always the error", S1, "=IFERROR(H{r}/0,{v})"),
    disguised("is a number", V1, "=IF(ISNUMBER(H{r}),{v},0)"),
    disguised("times one", V1, "={v}*(H{r}+1)^0"),
    disguised("times omega over omega", V1, "={v}*omega/omega"),
    disguised("the greater", S1, "=MAX({v},-A{r})"),
    disguised("sum with nought", M, "=SUM({v},0*G{r})"),
    disguised("rounded away", M, "=ROUND({v}+G{r}/10^15,6)"),
    disguised("nought to the power", N, "={v}+D{r}*0^9"),
    disguised("sign", N, "={v}*SIGN(A{r}+1)"),
    disguised("switch", S1, "=SWITCH(A{r},-1,H{r},{v})"),
    disguised("numbers of the helper", "P4_1.beta_rad", "={v}+A{r}-A{r}"),
    disguised("numbers of the last sum", "P4_2.Msum_Nm", "={v}+0*B{r}"),
    disguised("numbers of R", "P4_3_1.R_MPa", "={v}+0*(H{r}+I{r})"),
    disguised("numbers in a text", S1, '=LEN("")*A{r}+{v}'),
    disguised("numbers by a count", S1, "=COUNT(A{r})*{v}"),
    disguised("a scalar and the rest", "P3_2.eps_rod_exact_1_s2", "={v}+(r_crank-r_crank)"),
    Work(
        "omega plus nought",
        lambda here: {"omega": f"={here.scalar('omega')!r}+C5-C5"},
        unpaid=("geometry.omega",),
    ),
    Work(
        "area by if",
        lambda here: {"F_piston": f"=IF(C5>0,{here.scalar('F_piston')!r},C6)"},
        unpaid=("geometry.F_piston",),
    ),
    Work(
        "mass of no variant",
        lambda here: {"m_k": f"={here.scalar('m_k')!r}+0*m_2"},
        unpaid=("masses.m_k",),
    ),
    Work("choose", _choose, unpaid=(S1,)),
    Work("a list of numbers", _list, unpaid=(S1,)),
    Work("choose, scaled", _picked("CHOOSE(A{r}/30+1,@)"), unpaid=(J1,)),
    Work("an array, scaled", _picked("INDEX({@},A{r}/30+1)"), unpaid=(J1,)),
    Work("cases, scaled", _picked("#"), unpaid=(J1,)),
    Work("digits of a text, scaled", _picked('MID("~",A{r}/3+1,10)'), unpaid=(J1,)),
    Work("an array of numbers", _array_list, unpaid=(S1,)),
    Work("scaled by omega", _scaled("omega", "omega"), unpaid=(J1,)),
    Work("scaled by n", _scaled("regime_speed_rpm", "regime.speed_rpm"), unpaid=(J1,)),
    Work("by the neighbour", _ratio, unpaid=(S1,)),
    Work("only for my variant", _only_mine, unpaid=(S1,)),
    Work(
        "look-up of pasted numbers", edit=_pasted("=VLOOKUP(A{r},Расчёт!A:B,2,0)", S1), unpaid=(S1,)
    ),
    Work("reading pasted numbers", edit=_pasted("=Расчёт!B{r}", M), unpaid=(M,)),
    Work(
        "pasted numbers by INDEX",
        edit=_pasted("=INDEX(Расчёт!B:B,ROWS(A$1:A{r}))", V1),
        unpaid=(V1,),
    ),
    Work("pasted and scaled", edit=_times("{v}", J1, digits=1), unpaid=(J1,)),
    Work("a friend's column scaled", edit=_times("{v}", V1, friend=True), unpaid=(V1,)),
    Work("texts of digits, scaled", edit=_hidden("{v}", "{c}/10^6"), unpaid=(V1,)),
    Work("digits within texts, scaled", edit=_hidden("x{v}", "MID({c},2,9)/10^6"), unpaid=(V1,)),
    Work("formulas of texts, scaled", edit=_hidden('="{v}"', "{c}/10^6"), unpaid=(V1,)),
    Work("lengths of texts, scaled", edit=_hidden("~", "LEN({c})/100"), unpaid=(V1,)),
    Work("rows of blank cells, scaled", edit=_hidden("x", "(ROW(Z{r})-1)/1000"), unpaid=(V1,)),
    Work("digits of other cells, scaled", edit=_hidden("x", "{d}/10^6"), unpaid=(V1,)),
    Work("formulas of numbers, scaled", edit=_times("={v}*1", J1), unpaid=(J1,)),
    Work("names of numbers", edit=_name_constant, unpaid=(S1,)),
    Work("everything pasted", edit=_solved_with_ticket, unpaid=tuple(COLUMNS)),
    Work("a circle", lambda here: _CIRCLE, unpaid=tuple(_CIRCLE)),
    Work("a ring of three", lambda here: _RING, unpaid=tuple(_RING)),
    Work("itself", lambda here: {S1: "=B{r}"}, unpaid=(S1, "P3_1.s_mm")),
    Work("blank omega", _blank("omega"), unpaid=("geometry.omega", *_OF_OMEGA)),
    Work(
        "blank lambda, omega, r",
        _blank("omega", "lam", "r_crank"),
        unpaid=("geometry.omega", "geometry.lam", "geometry.r_crank", *_OF_OMEGA),
    ),
    Work(
        "blank first columns",
        _blank("P4_1.beta_rad", "P4_1.j_m_s2"),
        unpaid=("P4_1.beta_rad", "P4_1.j_m_s2", "P4_1.N_MPa", "P4_1.Pj_MPa", "P4_1.T_MPa"),
    ),
    Work(
        "helpers of noughts",
        lambda here: {"P4_1.beta_rad": 0, "P4_1.j_m_s2": 0},
        unpaid=("P4_1.beta_rad", "P4_1.j_m_s2"),
    ),
    Work(
        "read from the given table",
        lambda here: {
            M: "=INDEX(Цилиндры!L$6:L$30,MATCH(MOD(A{r}+240,720),Цилиндры!A$6:A$30,0))",
            T: "=INDEX(Цилиндры!J$6:J$30,MATCH(MOD(A{r}+240,720),Цилиндры!A$6:A$30,0))",
        },
        unpaid=(M, T),
    ),
    Work("backwards from typed numbers", _back, unpaid=(T,), verdicts={M: "typed"}),
    Work("backwards, one number wrong", _back_but_one(M), unpaid=(T,), verdicts={M: "wrong"}),
    Work("backwards, one cell typed", _back_but_one(T), unpaid=(T,), verdicts={M: "typed"}),
    Work(
        "backwards from nothing",
        lambda here: {M: "=2*A{r}", T: _FROM_M},
        unpaid=(T,),
        verdicts={M: "wrong"},
    ),
    Work("a circle for all other engines", _circle_elsewhere, unpaid=(PS, S)),
    Work("the given table overwritten", edit=_given_replaced),
    Work(
        "an indirect address", lambda here: {"V_c": '=INDIRECT("C10")/17'}, unpaid=("geometry.V_c",)
    ),
    Work("the solved book", after=_solved, held="идентификатор"),
    Work("a friend's book", after=_foreign("none"), held="идентификатор"),
    Work("a friend's book, altered identifier", after=_foreign("altered"), held="идентификатор"),
    Work("a friend's book, own identifier", after=_foreign("own"), held="вариант"),
    Work("a friend's book as it is", after=_foreign("friend"), held="идентификатор"),
    Work("a friend's input data", edit=_friends_inputs, held="вариант"),
    Work("odd formulas", lambda here: ODD, held="формул"),
    Work("the same odd formulas", lambda here: ODD, held="формул"),
)
assert TICKET_NAME
