"""Books of strangers: whatever is in them, the answer is one line in a short time."""

from __future__ import annotations

import re
import time
from pathlib import Path

import pytest

from reports.exports.department_chapters import refuse_faults
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_text
from reports.shared.errors import InputError
from reports.shared.resources import samples_dir
from tests.conftest import sample

HEAD = "place after 700\nsheet Свой in Расчёты кафедры 1: Свой лист\n"
LIST = HEAD + "quantity x_own: величина | x | | 2\nlist own_list: Список\n"
ONE = LIST + "x_own = 1 | -\n"


def formula(text: str) -> str:
    return LIST + f"x_own = {text} | -\n"


def statement(text: str) -> str:
    return LIST + f"{text}\nx_own = 1 | -\n"


HOSTILE = {
    # Python through the sandbox
    "class": statement("% set a = ''.__class__"),
    "subclasses": statement("% set a = [].__class__.__base__.__subclasses__()"),
    "globals of a function": statement("% set a = short.__globals__"),
    "code of a function": statement("% set a = each.__code__"),
    "closure": statement("% set a = val.func.__globals__"),
    "model behind a view": statement('% set a = given.section.parse_file("/etc/passwd")'),
    "schema of a model": statement("% set a = value.section.model_json_schema()"),
    "dump of a model": statement("% set a = value.section.model_dump()"),
    "attr filter": statement('% set a = "" | attr("__class__")'),
    "map attribute": statement('% set a = [""] | map(attribute="__class__") | list'),
    "format of text": statement('% set a = "{0.__class__}".format(engine)'),
    "format_map": statement('% set a = "{x}".format_map(engine)'),
    "import of a module": statement('% import "os" as os'),
    "config": statement("% set a = self.__init__"),
    "lipsum": statement("% set a = lipsum(500)"),
    "cycler": statement("% set a = cycler.__init__.__globals__"),
    "joiner": statement("% set a = joiner()"),
    "namespace": statement("% set a = namespace()"),
    "dict": statement("% set a = dict()"),
    "include of a file": statement('% include "/etc/passwd"'),
    "include of a folder above": statement('% include "../../pyproject.toml"'),
    "extends": '% extends "oil.book"\n' + ONE,
    "block": statement("% block a\n% endblock"),
    "call block": statement("% macro m()\n% endmacro\n% call m()\n% endcall"),
    "debug": statement("% debug"),
    "assignment to the engine": statement("% set engine.strokes = 2"),
    "write to a dict": statement('% set a = {}.update({"a": 1})'),
    "write to a list": statement("% set a = [].append(1)"),
    # No end of work
    "long loop": statement("% for i in range(10**9)\n% endfor"),
    "loops in loops": statement(
        "% for i in range(3000)\n% for j in range(3000)\n% endfor\n% endfor"
    ),
    "endless macro": statement("% macro f(n)\n{{ f(n) }}\n% endmacro\n{{ f(1) }}"),
    "tree of macros": statement(
        "% macro f(n)\n{{ f(n - 1) ~ f(n - 1) if n else 1 }}\n% endmacro\n{{ f(60) }}"
    ),
    "includes itself": statement('% include "hostile.book"'),
    "text of gigabytes": statement('% set a = "a" * 10**9'),
    "list of gigabytes": statement("% set a = [0] * 10**9"),
    "wide format": statement('% set a = "%1000000000d" % 1'),
    "wide center": statement('% set a = "a".center(10**9)'),
    "doubling": statement('% set a = "a"\n' + "% set a = a ~ a\n" * 40),
    "replaced": statement('% set a = ("a" * 9999) | replace("a", "a" * 9999)'),
    "power": statement("% set a = 9 ** 9 ** 9"),
    "much output": statement("% for i in range(40000)\nx_own = 1 | -\n% endfor"),
    "recursive loop": statement("% for i in [[1]] recursive\n% endfor"),
    # Formulas
    "python in a formula": formula('__import__("os").system("true")'),
    "attribute of a number": formula("(1).real"),
    "lambda": formula("(lambda: 1)()"),
    "comprehension": formula("[x for x in (1, 2)]"),
    "f-string": formula('f"{1}"'),
    "walrus": formula("(y_own := 2)"),
    "deep brackets": LIST + "x_own = " + "(" * 400 + "1" + ")" * 400 + " | -\n",
    "deep minus": LIST + "x_own = " + "-" * 900 + "1 | -\n",
    "long sum": LIST + "x_own = 1" + "\n    + 1*1*1*1*1" * 1500 + " | -\n",
    "huge integer": LIST + "x_own = " + "9" * 900 + " | -\n",
    "not a number": formula("0/0"),
    "infinity": formula("10**400.0"),
    "logarithm of nothing": formula("ln(0 - 1)"),
    "circle": LIST + "quantity y_own: y | y | | 1\nx_own = y_own | -\ny_own = x_own | -\n",
    "link to a file": formula("'[c.xls]Лист1'!A1"),
    "function of Excel": formula('WEBSERVICE("http://127.0.0.1")'),
    # Texts that a spreadsheet or a page would take
    "formula for a title": LIST.replace("Список", '=HYPERLINK("http://127.0.0.1")')
    + "x_own = 1 | -\n",
    "tag in a title": LIST.replace("Список", "<script>1</script>") + "x_own = 1 | -\n",
    "tag in a chapter": ONE + "text Глава\n<img src=x onerror=1>\n",
    "tag in a quantity": LIST.replace("величина", "<b>") + "x_own = 1 | -\n",
    "TeX command": LIST.replace("| x |", r"| \input{/etc/passwd} |") + "x_own = 1 | -\n",
    "control character": ONE + "note \x1fhostile:1\x1f\n",
    "sheet of a bad name": ONE.replace("sheet Свой", "sheet А[1]:*?"),
    # Sizes
    "many lines": ONE + "# x\n" * 5000,
    "long line": ONE + "# " + "x" * 5000 + "\n",
    "many rows": HEAD + "quantity x_own: x | x | | 1\ntable t_own Т over 0…1 by 0.000001: Т\n"
    "x_own\n",
    "no step": HEAD + "quantity x_own: x | x | | 1\ntable t_own Т over 0…1 by 0: Т\nx_own\n",
    "many cells": HEAD + "quantity x#: x | x | | 1\n".replace("#", "_own")
    + "table t_own Т over 0…2999 by 1: Т\n"
    + "x_own\n" + "".join(f"x{i}_own of x_own = 1 | -\n" for i in range(150)),
    # Names of others
    "an input of the house": "input geometry.bore_mm: d | D | мм | 1…2 | 1\n" + ONE,
    "a name of the house": LIST.replace("x_own", "r_crank") + "r_crank = 1 | -\n",
    "an address of a cell": LIST.replace("x_own", "AB12") + "AB12 = 1 | -\n",
    "a block of the house": LIST.replace("own_list", "geometry") + "x_own = 1 | -\n",
    "an input twice": "input pump.a: а | a | | 1…2 | 1\n" * 2 + ONE,
    "limits that are none": "input pump.a: а | a | | 2…1 | 1\n" + ONE,
    "infinite limits": "input pump.a: а | a | | 1…inf | 1\n" + ONE,
    "no place": ONE.replace("place after 700\n", ""),
    "no chapter": ONE.replace("Расчёты кафедры", "Чужая глава"),
    "shows nothing": ONE + "text Глава\nshow nobody\n",
    "chart of nothing": ONE + "chart c_own: Д\ncurve a.b c.d\n",
    "chart without curves": ONE + "chart c_own over phi_deg: Д\n",
    "polar of nothing": ONE + "polar c_own: Д\ncurve a.b c.d\n",
    "braces of a condition": LIST + 'check x_own = 1 | value == "{0}" | ч\n',
    "word of a condition": LIST + "check x_own = 1 | value.__class__ | ч\n",
    "number for a condition": LIST + "check x_own = 1 | value | ч\n",
    "verdict of the house": LIST + "check lam = 1 | value <= 2 | ч\n",
    "verdict by its whole name": LIST + "check check_x of y_own = 1 | y_own <= 2 | ч\n",
    "limit that is none": HEAD + "allowed x_own <= nobody_own: П\ny_own = 1 | ч\n",
    "extremes of no table": LIST + "x_own = 1 | -\nextremes phi_deg as M\n",
    "box of python": HEAD + 'box b_own c_own = __import__("os"): Б\n',
    "period of python": LIST + 'x_own every __import__("os") = 1 | -\n',
    "quantity of the house": "quantity omega: х | x | | 1\n" + ONE,
    "two symbols": LIST + "quantity y_own: у | x | | 2\nx_own = 1 | -\n",
    "sheet of the house": ONE.replace("sheet Свой", "sheet Исходные данные"),
    "mark of a text": ONE + "text Глава\n⟦val x_own\n",
    "figure of another": ONE + 'text Глава\n{{ fig("own_list") }}\n',
    "table elsewhere": ONE + 'text Глава\n{{ tab("own_list") }}\n',
    "list twice": ONE + "text Глава\nshow own_list\nshow own_list\n",
    "chapter of nothing": ONE + "text Глава\n",
    "table of no columns": HEAD + "table t_own Т over turn: Т\n",
}  # fmt: skip
SECONDS = 12.0  # of a slow machine that does other work


def told(text: str) -> str:
    """What is said of a book; nothing where it is taken."""
    raw = to_mapping(sample("gots-diesel"))
    raw["report"]["books"], raw["books"] = ["hostile.book"], {"hostile.book": text}
    begin = time.monotonic()
    try:
        refuse_faults(load_mapping(raw, source="x").model)
    except InputError as error:
        assert time.monotonic() - begin < SECONDS
        return str(error)
    return ""


def test_a_tame_book_is_taken():
    assert told(ONE) == ""


def test_at_least_sixty():
    assert len(HOSTILE) >= 60


@pytest.mark.parametrize("case", HOSTILE)
def test_a_hostile_book_is_refused_in_lines(case: str):
    lines = told(HOSTILE[case]).splitlines()
    assert lines
    for line in lines:
        assert len(line) < 700 and "Traceback" not in line and "/reports/" not in line
        assert "root:" not in line
        assert re.search(r"(?:[a-z]{2,} ){2}[a-z]{2,}|[a-z]Error", line) is None, line


@pytest.mark.parametrize(
    ("line", "cause"),
    [
        ("% set a = 1 +", "условие Jinja2 не разобрано"), ("% nix", "непонятно «nix»"),
        ("% set a = 1 | nix", "непонятно «nix»"), ("% set a = nix.more", "нет имени «nix»"),
        ("% set a = 1/0", "деление на ноль"), ("% set a = short()", "не для этих значений"),
    ],
)  # fmt: skip
def test_a_mistake_of_a_statement_is_told_in_russian(line: str, cause: str):
    assert told(statement(line)).startswith("hostile.book: строка 5")
    assert cause in told(statement(line))


@pytest.mark.parametrize(
    "name", ["/etc/passwd", "../x.book", "a/../../x.book", "C:\\x.book", "x.txt", "нет.book"]
)
def test_a_book_lies_beside_its_input(name: str, tmp_path: Path):
    text = (samples_dir() / "gots-p3.toml").read_text(encoding="utf-8")
    text = text.replace("[report]", f"[report]\nbooks = ['{name}']")
    with pytest.raises(InputError) as raised:
        load_text(text, source="x.toml", folder=tmp_path)
    assert len(str(raised.value).splitlines()) == 1


@pytest.mark.parametrize("allowed", [False, True])
def test_a_server_takes_books_of_its_owner_alone(
    allowed: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    (tmp_path / "hostile.book").write_text(ONE, encoding="utf-8")
    monkeypatch.setenv("KSHM_BOOKS", str(tmp_path) if allowed else "")
    raw = to_mapping(sample("gots-diesel"))
    raw["report"]["books"], raw["books"] = ["hostile.book"], {"hostile.book": formula("666")}
    if allowed:
        assert load_mapping(raw, source="").model.books == (("hostile.book", ONE),)
    else:
        with pytest.raises(InputError, match="не разрешил"):
            load_mapping(raw, source="")
