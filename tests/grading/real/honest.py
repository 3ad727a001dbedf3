"""Honest students in more than fifteen manners: every column of theirs is right."""

from __future__ import annotations

import re

from openpyxl import Workbook
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.formula import ArrayFormula

from kshm.nomenclature.quantity import quantity
from tests.grading.forms import insert
from tests.grading.real.books import Cells, Work, rows
from tests.grading.real.desk import Desk
from tests.grading.real.written import COLUMNS, FIRST, LAM, OMEGA, ROWS, SCALARS

LAST = FIRST + ROWS - 1
_RAD = "A{r}*PI()/180"


def _other_algebra(desk: Desk) -> dict[str, Cells]:
    lam, r, w = "lam", "r_crank", "omega"
    return {
        "lam": "=geometry_crank_radius_mm/geometry_rod_length_mm",
        "F_piston": "=0.25*PI()*geometry_bore_mm^2/10^6",
        "omega": "=RADIANS(6*regime_speed_rpm)",
        "c_m": "=2*S_stroke*regime_speed_rpm/60",
        "v_max": "=r_crank*omega*SIN(RADIANS(phi_vmax_deg))*(1+lam*COS(RADIANS(phi_vmax_deg)))",
        "P3_1.s1_mm": f"=2000*{r}*SIN({_RAD}/2)^2",
        "P3_1.s_mm": f"={r}*1000*((1-COS({_RAD}))+{lam}/4*(1-COS(2*{_RAD})))",
        "P3_1.v_m_s": f"={w}*{r}*(SIN({_RAD})+{lam}*SIN(2*{_RAD})/2)",
        "P3_1.j_m_s2": f"={w}^2*{r}*(COS({_RAD})+{lam}*COS(2*{_RAD}))",
        "P4_1.N_MPa": f"=D{{r}}*{lam}*SIN({_RAD})/SQRT(1-({lam}*SIN({_RAD}))^2)",
        "P4_1.S_MPa": "=D{r}*SQRT(1+TAN(J{r})^2)",
        "P4_1.T_MPa": f"=D{{r}}*(SIN({_RAD})+COS({_RAD})*TAN(J{{r}}))",
        "P4_1.K_MPa": f"=D{{r}}*COS({_RAD})-E{{r}}*SIN({_RAD})",
        "P4_1.M_Nm": "=(E{r}*COS(A{r}*PI()/180)+D{r}*SIN(A{r}*PI()/180))*F_piston*r_crank*1000000",
    }


def _rounded(desk: Desk) -> dict[str, Cells]:
    """Every cell rounded as the book prints it."""
    values: dict[str, Cells] = {}
    for node, text in {**SCALARS, **COLUMNS}.items():
        decimals = quantity(node.rsplit(".", maxsplit=1)[-1]).digits.decimals
        values[node] = f"=ROUND({text[1:]},{decimals})"
    return values


def _rounded_inside(desk: Desk) -> dict[str, Cells]:
    sin, cos = f"ROUND(SIN({_RAD}),4)", f"ROUND(COS({_RAD}),4)"
    return {
        "P3_1.v1_m_s": f"=r_crank*omega*{sin}",
        "P3_1.j1_m_s2": f"=r_crank*omega^2*{cos}",
        "P3_1.j2_m_s2": f"=r_crank*omega^2*lam*(2*{cos}^2-1)",
        "P4_1.T_MPa": f"=D{{r}}*({sin}+{cos}*ROUND(TAN(J{{r}}),4))",
    }


def _digits_of_pi(desk: Desk) -> dict[str, Cells]:
    """π, and what turns degrees into radians, by as many digits as one knows by heart."""
    return {
        "omega": "=2*3.1416*regime_speed_rpm/60",
        "K_r": "=C26*C5*(regime_speed_rpm/9.55)^2/1000",
        "P3_2.omega_rod_exact_1_s": f"={OMEGA}*{LAM}*COS(A{{r}}*0.01745)/COS(B{{r}})",
        "P3_2.omega_rod_approx_1_s": f"={OMEGA}*{LAM}*COS(A{{r}}/57.3)",
        "P3_2.eps_rod_exact_1_s2": COLUMNS["P3_2.eps_rod_exact_1_s2"].replace("PI()", "3.1416"),
        "P3_2.eps_rod_approx_1_s2": f"=-({OMEGA}^2)*{LAM}*SIN(A{{r}}/57.296)",
        "P4_3_1.block_x_MPa": "=I{r}*SIN(A{r}/57.3)-H{r}*COS(A{r}/57.3)",
    }


def _digits_in_a_cell(book: Workbook, desk: Desk) -> None:
    book["П3.2"]["N1"] = 57.3
    for row in range(FIRST, 19):
        book["П3.2"].cell(row, 6).value = f"=-({OMEGA}^2)*{LAM}*SIN(A{row}/$N$1)"


def _by_name(desk: Desk) -> dict[str, Cells]:
    places = {"C5": "r_crank", "C6": "L_rod", "C7": "lam", "C8": "S_stroke", "C9": "F_piston",
              "C13": "omega", "C24": "m_j", "C23": "m_2", "C25": "m_k", "C26": "m_r"}  # fmt: skip
    values = {}
    for node, written in {**SCALARS, **COLUMNS}.items():
        text = written
        for address, name in places.items():
            text = text.replace(f"'Массы'!${address[0]}${address[1:]}", name)
            if "." not in node:
                text = re.sub(rf"(?<![\w$]){address}(?!\d)", name, text)
        values[node] = text
    return values


def _look_ups(desk: Desk) -> dict[str, Cells]:
    return {
        "P4_1.Pg_MPa": "=VLOOKUP(A{r},Газы!A:E,5,FALSE)-gas_ambient_pressure_mpa",
        "P4_2.M1_Nm": "=VLOOKUP($A{r},'П4.1'!$A:$I,9,0)",
        "P4_4.Mmain2_Nm": "=INDEX('П4.2'!B:B,MATCH(A{r},'П4.2'!A:A,0))",
        "P4_4.M2_Nm": "=INDEX('П4.2'!$B$6:$D$30,MATCH(A{r},'П4.2'!$A$6:$A$30,0),2)",
        "P4_4.M3_Nm": "=LOOKUP(A{r},'П4.2'!$A$6:$A$30,'П4.2'!$D$6:$D$30)",
        "P4_5.M2_Nm": "=SUMIF('П4.2'!A:A,A{r},'П4.2'!C:C)",
        "P4_5.M3_Nm": "=SUMPRODUCT(('П4.2'!$A$6:$A$30=A{r})*'П4.2'!$D$6:$D$30)",
        "P4_1.j_m_s2": "=VLOOKUP(MOD(A{r},360),'П3.1'!A:J,10,FALSE)",
        "P4_1.beta_rad": "=INDEX('П3.2'!B:B,MATCH(MOD(A{r},360),'П3.2'!A:A,0))",
    }


def _own_shift(desk: Desk) -> dict[str, Cells]:
    return {
        "P4_2.M2_Nm": "=INDEX('П4.1'!$I$6:$I$30,MATCH(MOD(A{r}-240,720),'П4.1'!$A$6:$A$30,0))",
        "P4_2.M3_Nm": "=INDEX('П4.1'!I:I,6+MOD(A{r}-480,720)/30)",
    }


def _row_shift(desk: Desk) -> dict[str, Cells]:
    """The moment of the other cylinders by references to other rows, as one drags them."""

    def shifted(by: int) -> list[str]:
        return [f"='П4.1'!I{FIRST + (i - by) % (ROWS - 1)}" for i in range(ROWS)]

    return {"P4_2.M2_Nm": shifted(8), "P4_2.M3_Nm": shifted(16)}


def _second_turn(desk: Desk) -> dict[str, Cells]:
    """Kinematics repeats itself after a turn: the second one refers to the first."""
    return {
        node: [COLUMNS[node] if i < 13 else f"={letter}{FIRST + i - 12}" for i in range(ROWS)]
        for node, letter in (("P4_1.beta_rad", "J"), ("P4_1.j_m_s2", "K"))
    }


def _zeros(desk: Desk) -> dict[str, Cells]:
    """A nought typed in where the sine is one; at dead centre a spreadsheet shows 1E-16."""
    values: dict[str, Cells] = {}
    for node in ("P3_1.v1_m_s", "P3_1.v_m_s", "P3_2.beta_rad", "P4_1.N_MPa", "P4_1.M_Nm"):
        text = COLUMNS[node]
        values[node] = [0 if i % 6 == 0 else text for i in range(ROWS)]
    return values


def _arrays(desk: Desk) -> dict[str, Cells]:
    def over(letter: str, text: str, last: int = 18) -> ArrayFormula:
        return ArrayFormula(f"{letter}{FIRST}:{letter}{last}", text)

    a = "A6:A18"
    return {
        "P3_1.s1_mm": over("B", f"=1000*r_crank*(1-COS(RADIANS({a})))"),
        "P3_1.s_mm": over("D", "=B6:B18+C6:C18"),
        "P3_1.v1_m_s": over("E", f"=r_crank*omega*SIN({a}*PI()/180)"),
        "P4_1.N_MPa": over("E", f"=D{FIRST}:D{LAST}*TAN(J{FIRST}:J{LAST})", LAST),
        "P4_2.Msum_Nm": over("E", "=B6:B30+C6:C30+D6:D30", LAST),
    }


def _many_terms(desk: Desk) -> dict[str, Cells]:
    part = "(B{r}+C{r}+D{r})/500"
    return {"P4_2.Msum_Nm": "=" + "+".join([part] * 500)}


def _let(desk: Desk) -> dict[str, Cells]:
    return {
        "omega": "=_xlfn.LET(_xlpm.n,regime_speed_rpm,PI()*_xlpm.n/30)",
        "P3_1.v1_m_s": f"=_xlfn.LET(_xlpm.u,r_crank*omega,_xlpm.u*SIN({_RAD}))",
    }


def _functions(desk: Desk) -> dict[str, Cells]:
    return {
        "F_piston": "=PRODUCT(PI(),POWER(geometry_bore_mm/1000,2))/4",
        "P4_2.Msum_Nm": "=SUMPRODUCT(B{r}:D{r})",
        "P4_3_1.R_MPa": "=SQRT(SUMSQ(H{r},I{r}))",
        "P3_1.s2_mm": f"=IF(A{{r}}>=0,r_crank*lam/4*(1-COS(2*{_RAD}))*1000,0)",
        "P4_1.Ps_MPa": "=IFERROR(B{r}+C{r},0)",
        "P4_1.Mopr_Nm": "=I{r}*(-1)",
    }


def _helper_columns(book: Workbook, desk: Desk) -> None:
    sheet = book["П4.1"]
    sheet["N4"] = "рад"
    for row in rows():
        sheet.cell(row, 14).value = f"=RADIANS(A{row})"
        sheet.cell(row, 15).value = f"=SIN(N{row})"
        sheet.cell(row, 16).value = f"=COS(N{row})"
        sheet.cell(row, 10).value = f"=ASIN(Массы!$C$7*O{row})"
        if row <= 18:
            book["П3.1"].cell(row, 5).value = f"=Массы!$C$5*Массы!$C$13*'П4.1'!O{row}"
            book["П3.1"].cell(row, 8).value = f"=Массы!$C$5*Массы!$C$13^2*'П4.1'!P{row}"


def _helper_sheet(book: Workbook, desk: Desk) -> None:
    sheet = book.create_sheet("Черновик")
    sheet["A1"], sheet["B1"] = "перевод градусов", "=PI()/180"
    sheet["A2"], sheet["B2"] = "мм в м", 0.001
    sheet["A3"], sheet["B3"] = "r*w^2", "=r_crank*omega^2"
    for row in rows():
        sheet.cell(row, 1).value = f"='П4.1'!A{row}"
        sheet.cell(row, 2).value = f"=COS(A{row}*$B$1)"
        sheet.cell(row, 3).value = f"=COS(2*A{row}*$B$1)"
        if row <= 18:
            look_up = f"VLOOKUP(A{row},Черновик!A:C,2,FALSE)"
            book["П3.1"].cell(row, 8).value = f"=Черновик!$B$3*{look_up}"
            book["П3.1"].cell(row, 9).value = f"=Черновик!$B$3*Массы!$C$7*Черновик!C{row}"
    book["Массы"]["C5"] = "=geometry_crank_radius_mm*Черновик!B2"


def _own_copy(book: Workbook, desk: Desk) -> None:
    """The input data copied to a sheet of one's own, and everything calculated from there."""
    sheet = book.create_sheet("Мой вариант")
    drawn = desk.issued.drawn
    sheet["A1"], sheet["B1"] = "D, мм", drawn["geometry.bore_mm"]
    sheet["A2"], sheet["B2"] = "l, м", drawn["geometry.rod_length_mm"] / 1000
    sheet["A3"], sheet["B3"] = "n", drawn["regime.speed_rpm"]
    sheet["A4"], sheet["B4"] = "m", drawn["masses.reciprocating_kg"]
    for cell, text in (("C6", "B2"), ("C24", "B4")):
        book["Массы"][cell] = f"='Мой вариант'!{text}"
    book["Массы"]["C9"] = "=PI()*('Мой вариант'!B1/1000)^2/4"
    book["Массы"]["C13"] = "=PI()*'Мой вариант'!B3/30"


def _own_names(book: Workbook, desk: Desk) -> None:
    for name, address in (("радиус", "Массы!$C$5"), ("w", "Массы!$C$13"), ("Fп", "Массы!$C$9")):
        book.defined_names[name] = DefinedName(name, attr_text=address)
    for row in rows():
        if row <= 18:
            book["П3.1"].cell(row, 5).value = f"=радиус*w*SIN(RADIANS(A{row}))"
        book["П4.1"].cell(row, 9).value = f"=G{row}*1000000*Fп*радиус"


def _columns_by_name(book: Workbook, desk: Desk) -> None:
    """A column has a name, and the cell in one's own row is meant."""
    for name, cells in (("фи", "'П3.1'!$A$6:$A$18"), ("Туд", "'П4.1'!$G$6:$G$30")):
        book.defined_names[name] = DefinedName(name, attr_text=cells)
    for row in rows():
        if row <= 18:
            book["П3.1"].cell(row, 5).value = "=r_crank*omega*SIN(RADIANS(фи))"
        book["П4.1"].cell(row, 9).value = "=Туд*10^6*F_piston*r_crank"
        book["П4.1"].cell(row, 12).value = "=-I:I"


def _moved_rows(book: Workbook, desk: Desk) -> None:
    insert(book, "П3.1", row=3)
    insert(book, "П3.1", row=9)
    insert(book, "П3.1", column=3)
    insert(book, "Массы", row=7)
    insert(book, "П4.1", row=2)


def _moved_sheets(book: Workbook, desk: Desk) -> None:
    renamed = {"П3.1": "Кинематика", "Массы": "Мои массы"}
    for old, new in renamed.items():
        book[old].title = new
        quoted = f"'{new}'!"
        for sheet in book.worksheets:
            for line in sheet.iter_rows():
                for cell in line:
                    if isinstance(cell.value, str) and cell.value.startswith("="):
                        cell.value = cell.value.replace(f"'{old}'!", quoted)
        for name in book.defined_names.values():
            name.attr_text = name.attr_text.replace(f"'{old}'!", quoted)
    book.move_sheet("Кинематика", 5)


def _notes(book: Workbook, desk: Desk) -> None:
    """Remarks, checks and colours of one's own beside the tables."""
    sheet = book["П4.1"]
    sheet["P3"] = "проверка: сумма Мкр"
    sheet["P4"] = "=SUM(I6:I30)/24"
    sheet["P5"] = "взял из лекции 7"
    book["П3.1"]["N5"] = '=IF(ABS(D12-S_stroke*1000)<0.01,"сошлось","ошибка")'


def _new_functions(desk: Desk) -> dict[str, Cells]:
    moments = "'П4.1'!$A$6:$A$30,'П4.1'!$I$6:$I$30"
    return {
        "P4_2.M2_Nm": f"=_xlfn.XLOOKUP(MOD(A{{r}}-240,720),{moments})",
        "P4_2.M3_Nm": "=INDEX('П4.1'!I:I,6+MOD(ROW()-6-16,24))",
        "P4_1.T_MPa": f"=_xlfn.LET(_xlpm.a,{_RAD},_xlpm.b,J{{r}},"
        "D{r}*SIN(_xlpm.a+_xlpm.b)/COS(_xlpm.b))",
        "P4_4.Mmain2_Nm": "=SUMPRODUCT(--('П4.2'!$A$6:$A$30=A{r}),'П4.2'!$B$6:$B$30)",
        "P4_5.Mpin1_Nm": "=+'П4.2'!B{r} * 50%",
        "P4_1.beta_rad": "=INDEX('П3.2'!B$6:B$18,_xlfn.XMATCH(MOD(A{r},360),'П3.2'!A$6:A$18))",
        "P3_1.s1_mm": ArrayFormula("B6:B18", "=1000*r_crank*(1-COS(RADIANS(A6:A18)))"),
        "P3_1.s_mm": ArrayFormula("D6:D18", "=_xlfn.ANCHORARRAY(B6)+C6:C18"),
    }


def _names_of_formulas(book: Workbook, desk: Desk) -> None:
    names = {"рад": "PI()/180", "vr": "Массы!$C$5*Массы!$C$13", "половина": "0.5"}
    for name, text in names.items():
        book.defined_names[name] = DefinedName(name, attr_text=text)
    for row in rows():
        if row <= 18:
            book["П3.1"].cell(row, 5).value = f"=vr*SIN(A{row}*рад)"
        book["П4.5"].cell(row, 2).value = f"=половина*'П4.2'!B{row}"


def _untidy(book: Workbook, desk: Desk) -> None:
    """Hidden rows and sheets, merged cells, angles of one's own, sheets in another order."""
    sheet = book["П4.1"]
    sheet.merge_cells("N6:N8")
    sheet["N6"] = "=omega"
    for row in range(8, 20):
        sheet.row_dimensions[row].hidden = True
    for row in range(FIRST, 19):
        book["П3.1"].cell(row, 14).value = f"=N{row - 1}+30" if row > FIRST else 0
        book["П3.1"].cell(row, 5).value = f"=r_crank*'П4.1'!$N$6*SIN(RADIANS(N{row}))"
    book["П3.1"].sheet_state = "hidden"
    book._sheets.reverse()


HONEST = (
    Work("as written"),
    Work("saved by LibreOffice", form="office"),
    Work("saved as Excel does", form="excel"),
    Work("another algebra", _other_algebra),
    Work("names", _by_name, form="excel"),
    Work("few digits of pi", _digits_of_pi),
    Work("few digits of pi in a cell", edit=_digits_in_a_cell),
    Work("helper columns", edit=_helper_columns),
    Work("a helper sheet", edit=_helper_sheet, form="office"),
    Work("look-ups over whole columns", _look_ups),
    Work("look-ups saved by LibreOffice", _look_ups, form="office"),
    Work("the variant copied to an own sheet", edit=_own_copy),
    Work("own names", edit=_own_names, form="excel"),
    Work("columns by name", edit=_columns_by_name, form="office"),
    Work("array formulas", _arrays),
    Work("array formulas saved by LibreOffice", _arrays, form="office"),
    Work("rounded as printed", _rounded),
    Work("rounded as printed, saved by LibreOffice", _rounded, form="office"),
    Work("rounded inside", _rounded_inside),
    Work("rows and columns moved", edit=_moved_rows),
    Work("sheets renamed and moved", edit=_moved_sheets),
    Work("five hundred terms", _many_terms),
    Work("LET", _let),
    Work("own shift for the other cylinders", _own_shift),
    Work("other cylinders by other rows", _row_shift),
    Work("the second turn repeats the first", _second_turn),
    Work("noughts at dead centre", _zeros),
    Work("other functions", _functions),
    Work("own notes and checks", edit=_notes, form="office"),
    Work("new functions", _new_functions),
    Work("names of formulas", edit=_names_of_formulas),
    Work("hidden, merged, in another order", edit=_untidy, form="office"),
)
