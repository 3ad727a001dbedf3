"""Single features of a spreadsheet's formulas, for which LibreOffice is the judge.

A feature is a formula; one that begins with ``{`` is entered as an array formula.
"""

from __future__ import annotations

import re

SHEET = "Данные"
# Cells that the formulas refer to, column by column from the first row.
DATA: dict[str, list[object]] = {
    "A": [3.0, -2.0, 0.5, None, 7.0],
    "B": ["да", "Да", "abc", "12", "ёж"],
    "C": [True, False, True, None, 5.0],
    "D": ["=1/0", "=SQRT(-1)", "=NA()", '="a"+1', "=1/3"],
    "E": [1.0, 2.0, 3.0, 4.0, 5.0],
    "F": [10.0, 20.0, 30.0, 40.0, 50.0],
    "G": ["альфа", "Бета", "гамма", "дельта", "эпсилон"],
    "H": [2.675, -2.675, 1.005, 0.285, 1e15],
}
NAMES = {"одна": "$A$1", "много": "$E$1:$E$5"}

_ONE = ("ABS", "ACOS", "ACOSH", "ASIN", "ASINH", "ATAN", "ATANH", "COS", "COSH", "DEGREES", "EVEN",
        "EXP", "FACT", "INT", "ISBLANK", "ISERR", "ISERROR", "ISLOGICAL", "ISNA", "ISNONTEXT",
        "ISNUMBER", "ISTEXT", "LN", "LOG", "LOG10", "N", "NOT", "ODD", "RADIANS", "SIGN", "SIN",
        "SINH", "SQRT", "T", "TAN", "TANH", "TRUNC")  # fmt: skip
_LIFTED = ("ABS", "ACOS", "ASIN", "ATAN", "COS", "DEGREES", "EXP", "INT", "LN", "LOG", "LOG10",
           "NOT", "RADIANS", "SIGN", "SIN", "SQRT", "TAN", "TRUNC")  # fmt: skip
_MANY = ("AVERAGE", "COUNT", "COUNTA", "MAX", "MEDIAN", "MIN", "PRODUCT", "STDEV", "SUM", "SUMSQ",
         "VAR", "VARP", "STDEVP", "AVEDEV", "GEOMEAN", "HARMEAN")  # fmt: skip
_OPERATORS = ("+", "-", "*", "/", "^", "&", "=", "<>", "<", ">", "<=", ">=")

_WRITTEN = """
-A1^2  2^3^2  50%  5%%  -50%  --A1  1E3+1  .5+1  1+2*3-4/2  2*(3+4)^2  0^0  0^-1  (-8)^(1/3)
1/0  A2/A4  1E308*10  TRUE+1  TRUE&1  PI()  TRUE()
"да"="Да"  "a"="A"  "a"<"b"  "a"<"B"  "а"<"Б"  "я"<"А"  "ё"="Ё"  "a"&1.5  "12"+1  B4*2  B3+1
"abc"+1  "1"=1  ""=A4  0=A4  A4=""  A4=0  TRUE=1  "x"<1  EXACT(B1,B2)  LEN(B3)  LEFT(B3,2)
RIGHT(B3,1)  MID(B3,2,1)  CONCATENATE(B1,1)  B1&" "&B3  TRIM(" a ")  UPPER("abc")  LOWER("ABC")
SUM(B4,1)  SUM("12",1)  SUM(B1:B5,1)  MAX("5",7)  -B4  B4%  SQRT(B4)  SIN("1")
ROUND(D1,2)  ROUND(B3,1)  ROUND(A4,1)  MROUND(7,2)  CEILING(2.1,1)  FLOOR(2.9,1)
CEILING(-2.1,-1)  FLOOR(-2.1,-1)  INT(-2.5)  TRUNC(-2.7)  QUOTIENT(7,2)  EVEN(-1.5)
SUMPRODUCT(ROUND(H1:H4,2))  {SUM(ROUND(H1:H4,2))  SUMPRODUCT(POWER(E1:E5,2))
{SUM(POWER(E1:E5,2))  SUMPRODUCT(MOD(F1:F5,3))  {SUM(MOD(F1:F5,3))  {SUM(TRUNC(H1:H4,1))
{SUM(LOG(E1:E5,2))  {SUM(MOD(E1:E5,E1:E5+1))
ATAN2(1,1)  ATAN2(0,0)  ATAN2(-1,0)  MOD(-1,3)  MOD(1,-3)  MOD(5,0)  MOD(5.5,2)  POWER(2,10)
POWER(0,0)  POWER(-8,1/3)  POWER(0,-1)  LOG(8,2)  LOG(8,1)  LOG(0)  LN(-1)  SQRT(-1)  ASIN(2)
ACOSH(0.5)  ATANH(1)  FACT(-1)  FACT(5)  COMBIN(5,2)  GCD(12,18)  LCM(4,6)  EXP(1000)  SIGN(-3)
TAN(PI()/2)
IF(A1>2,1,2)  IF(A1>5,1)  IF(A4,1,2)  IF(D1,1,2)  IF(TRUE,1,D1)  IF(B1="ДА",1,2)
IF(A1=3,"да","нет")  IF(A1>2,,5)  IFERROR(D1,5)  IFERROR(A1,5)  IFERROR(D3,B1)  _xlfn.IFNA(D3,7)
_xlfn.IFNA(D1,7)  _xlfn.IFS(A1>5,1,A1>2,2)  _xlfn.SWITCH(A1,1,10,3,30)  CHOOSE(2,A1,A2,A3)
CHOOSE(9,1,2)  AND(A1>2,A2<0)  AND(C1:C2)  OR(C1:C2)  _xlfn.XOR(TRUE,TRUE)  AND(A4,TRUE)
AND(D1,FALSE)  OR(TRUE,D1)  NOT(D1)  ISERROR(D2)  ISERR(D3)  ISNA(D3)  ISNUMBER(B4)  ISBLANK(A4)
ISEVEN(4)  ISODD(4)  NA()  #N/A  #DIV/0!  D1  D2  D3  D4  D1+D2  D3+D1  SUM(D1:D5)  MAX(D5,D3)
COUNT(D1:D5)  COUNTA(D1:D5)  SUM(A1,D2)  SUMPRODUCT(D1:D5)
SUM(A1:C2)  SUM(A:A)  SUM(1:1)  SUM(E:F)  COUNT(A1:H5)  SUM(A4)  AVERAGE(A4)  MAX(A4)
MIN(C1:C4)  SUM(C1:C5)  MAX(B1:B5)  COUNTBLANK(A1:C5)  ROWS(A1:C5)  COLUMNS(A1:C5)
INDEX(F1:F5,3)  INDEX(E1:F5,2,2)  INDEX(F1:F5,9)  MATCH(3,E1:E5,0)  MATCH(3.5,E1:E5)
MATCH(9,E1:E5,0)  MATCH(2.5,E1:E5,1)  MATCH("ГАММА",G1:G5,0)
INDEX(F1:F5,MATCH(MAX(F1:F5),F1:F5,0))  VLOOKUP(3,E1:F5,2,FALSE)  VLOOKUP(3.5,E1:F5,2)
VLOOKUP(3.5,E1:F5,2,FALSE)  VLOOKUP(3,E:F,2,0)  VLOOKUP(0,E1:F5,2)  HLOOKUP(1,E1:F5,2,0)
LOOKUP(3.5,E1:E5,F1:F5)  LOOKUP(0,E1:E5,F1:F5)  INDEX(E1:E5,MATCH("бета",G1:G5,0))
LARGE(F1:F5,2)  SMALL(F1:F5,2)  LARGE(F1:F5,9)  RANK(30,F1:F5)  SUMIF(E1:E5,">2",F1:F5)
SUMIF(E1:E5,3)  COUNTIF(A1:A5,">0")  COUNTIF(B1:B5,"да")  AVERAGEIF(E1:E5,">2",F1:F5)
AVERAGEIF(E1:E5,">9")  SUMIFS(F1:F5,E1:E5,">1",E1:E5,"<4")  COUNTIFS(E1:E5,">1")
AVERAGEIFS(F1:F5,E1:E5,">1")  _xlfn.MAXIFS(F1:F5,E1:E5,"<4")  _xlfn.MINIFS(F1:F5,E1:E5,">1")
SLOPE(F1:F5,E1:E5)  INTERCEPT(F1:F5,E1:E5)  _xlfn.VAR.S(F1:F5)  _xlfn.STDEV.P(F1:F5)
SUMPRODUCT(E1:E5,F1:F5)  SUMPRODUCT(E1:E5*F1:F5)  SUMPRODUCT((E1:E5>2)*F1:F5)
SUMPRODUCT(E1:E5^2)  SUMPRODUCT(--(E1:E5>2))  SUMPRODUCT(E1:E3,F1:F5)  SUMPRODUCT(A1:A5,E1:E5)
SUMPRODUCT(E1:F5*2)  SUMPRODUCT((G1:G5="БЕТА")*F1:F5)  SUMPRODUCT(B1:B5,E1:E5)
SUMPRODUCT((E2:E5-E1:E4)*(F2:F5+F1:F4)/2)  SUMXMY2(E1:E5,F1:F5)  SUMX2MY2(E1:E5,F1:F5)
SUMX2PY2(E1:E5,F1:F5)  {SUM(E1:E5*F1:F5)  {SUM(IF(E1:E5>2,F1:F5,0))  {MAX(ABS(A1:A3))
{MAX(IF(E1:E5<4,F1:F5))  {SUM((E1:E5>1)*(E1:E5<4))  {AVERAGE(E1:E5*2)  {SUM(SQRT(A1:A3))
{SUM(LN(D1:D5))  {SUM(1/E1:E5)  {INDEX(E1:E5*2,3)  {MATCH(4,E1:E5*2,0)  {SUM({1,2,3})
SUM({1,2;3,4})  {SUM({1,2,3}*2)  {SUM(RADIANS(E1:E5)*F1:F5)  {SUM(SIN(RADIANS(F1:F5)))
{SUM(NOT(E1:E5>2)*1)  {COUNT(1/(E1:E5>2))
одна+1  SUM(много)  ОДНА  INDEX(много,2)  SUMPRODUCT(много*2)  нет_такого
E1:E5  E1:E5*2  INDEX(E1:F5,0,2)  INDIRECT("A1")  OFFSET(A1,1,0)  RAND()  TODAY()  VALUE("1,5")
"1,5"+1  "1.5"+1  TEXT(1.5,"0.00")  _xlfn.LET(_xlpm.x,1,_xlpm.x+1)  _xlfn.XLOOKUP(3,E1:E5,F1:F5)
_xlfn.XMATCH(3,E1:E5)  _xlfn.XMATCH(3.5,E1:E5,-1)  _xlfn.XMATCH(3.5,E1:E5)  SUM(E5:E1)
"""  # a row below each other, two spaces between

FEATURES: tuple[str, ...] = tuple(dict.fromkeys((
    *(f"{name}({arg})" for name in _ONE for arg in ("0.5", "A4", "D1")),
    *(f"SUMPRODUCT({name}(E1:E5/5))" for name in _LIFTED),
    *(f"{{SUM({name}(E1:E5/5))" for name in _LIFTED),
    *(f"{name}(A1:C5)" for name in _MANY),
    *(f"{name}(E1:E5,F5)" for name in _MANY),
    *(f"A1{op}A3" for op in _OPERATORS),
    *(f"B1{op}B2" for op in _OPERATORS[5:]),
    *(f"A1{op}B3" for op in _OPERATORS[6:]),
    *(f"A1{op}C1" for op in _OPERATORS),
    *(f"A4{op}A1" for op in _OPERATORS),
    *(f"A1{op}D{row}" for op in "+=" for row in range(1, 5)),
    *(f"{name}({value},{digits})" for name in ("ROUND", "ROUNDUP", "ROUNDDOWN", "TRUNC")
      for value, digits in (("H1", 2), ("H2", 2), ("H3", 2), ("H4", 2), ("2.5", 0), ("-2.5", 0),
                            ("1234.5", -2), ("-0.5", 0), ("2.345", 2), ("1.45", 1))),
    *re.split(r"\s{2,}|\n", _WRITTEN.strip()),
    "+".join(["1"] * 300),
)))  # fmt: skip

# What differs from LibreOffice on purpose: formula → what we say, and why.  None: unknown.
_LOGICALS = (
    "LibreOffice takes logicals of an .xlsx for numbers; in Excel they are a kind of their own"
)
_EXCEL = (
    "as in Excel; LibreOffice takes an odd root of a negative number, a zero vector, another error"
)
_TEXT = "as in Excel, where a number in quotes counts as an argument of its own"
_NEWER = "LibreOffice 7.4 does not have the function yet; Excel does"
_LISTED = "not on the whitelist: builds an address, changes by itself, or depends on the language"
_FOLDED = "texts are compared without capitals: a function that tells them apart is not calculated"
_WANTED = "a range where one value is wanted: old and new Excel differ"
_DOUBTFUL = "a number written as a text: programs and languages differ"

DIFFERENT: dict[str, tuple[float | str | None, str]] = {
    "AVERAGE(A1:C5)": (2.7, _LOGICALS),
    "COUNT(A1:C5)": (5.0, _LOGICALS),
    "MEDIAN(A1:C5)": (3.0, _LOGICALS),
    "PRODUCT(A1:C5)": (-105.0, _LOGICALS),
    "STDEV(A1:C5)": (3.5637059362410923, _LOGICALS),
    "SUM(A1:C5)": (13.5, _LOGICALS),
    "SUMSQ(A1:C5)": (87.25, _LOGICALS),
    "VAR(A1:C5)": (12.7, _LOGICALS),
    "VARP(A1:C5)": (10.16, _LOGICALS),
    "STDEVP(A1:C5)": (3.1874754901018454, _LOGICALS),
    "AVEDEV(A1:C5)": (2.76, _LOGICALS),
    "SUM(A1:C2)": (1.0, _LOGICALS),
    "COUNT(A1:H5)": (21.0, _LOGICALS),
    "SUM(C1:C5)": (5.0, _LOGICALS),
    "A1&C1": ("3true", _LOGICALS),
    "TRUE&1": ("true1", _LOGICALS),
    "TRUE=1": (0.0, _LOGICALS),
    "A1<C1": (1.0, _LOGICALS),
    "A1>C1": (0.0, _LOGICALS),
    "A1<=C1": (1.0, _LOGICALS),
    "A1>=C1": (0.0, _LOGICALS),
    "(-8)^(1/3)": ("#NUM!", _EXCEL),
    "POWER(-8,1/3)": ("#NUM!", _EXCEL),
    "ATAN2(0,0)": ("#DIV/0!", _EXCEL),
    "LARGE(F1:F5,9)": ("#NUM!", _EXCEL),
    "INDEX(F1:F5,9)": ("#REF!", _EXCEL),
    'SUM("12",1)': (13.0, _TEXT),
    'MAX("5",7)': (7.0, _TEXT),
    "_xlfn.LET(_xlpm.x,1,_xlpm.x+1)": (2.0, _NEWER),
    "_xlfn.XLOOKUP(3,E1:E5,F1:F5)": (30.0, _NEWER),
    "_xlfn.XMATCH(3,E1:E5)": (3.0, _NEWER),
    "_xlfn.XMATCH(3.5,E1:E5,-1)": (3.0, _NEWER),
    "_xlfn.XMATCH(3.5,E1:E5)": ("#N/A", _NEWER),
    **dict.fromkeys(
        ('INDIRECT("A1")', "OFFSET(A1,1,0)", "RAND()", "TODAY()", 'VALUE("1,5")',
         'TEXT(1.5,"0.00")'), (None, _LISTED)),
    **dict.fromkeys(('EXACT(B1,B2)', 'UPPER("abc")', 'LOWER("ABC")'), (None, _FOLDED)),
    **dict.fromkeys(("E1:E5", "E1:E5*2", "INDEX(E1:F5,0,2)"), (None, _WANTED)),
    **dict.fromkeys(('"1,5"+1', '"1.5"+1', "SUMPRODUCT(B1:B5,E1:E5)"), (None, _DOUBTFUL)),
    "нет_такого": (None, "a name that the book does not have"),
    "SUM(E5:E1)": (None, "formualizer reads no range from its end; Excel turns it round itself"),
}  # fmt: skip
