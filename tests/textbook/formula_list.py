"""Where every numbered formula of the book stands; writes ``docs/formulas.md``.

``python -m tests.textbook.formula_list > docs/formulas.md`` renews the list.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
LAST = 60
LONGEST = 20
_RANGE = re.compile(r"\((\d+)[аa]?\)\s*[-–]\s*\((\d+)[аa]?\)")
_SOURCE = re.compile(r"(?:\A|\| )(Гоц[^\n]*)")
_ONE = re.compile(r"\((\d+)[аa]?\)")
_COMMENT = re.compile(r"^#[^\n]*", re.MULTILINE)
_NAMED = re.compile(r"(?:Gots|Гоц)[^\n]*")

# What each formula is; the reading where the print is wrong or doubtful.
FORMULAS: dict[int, str] = {
    1: "перемещение поршня, точно",
    2: "связь углов β и φ",
    3: "перемещение по двум гармоникам",
    4: "скорость поршня по двум гармоникам",
    5: "угол наибольшей скорости",
    6: "ускорение поршня по двум гармоникам",
    7: "угол отклонения шатуна",
    8: "угловая скорость шатуна",
    9: "дезаксиальный механизм: угол ВМТ",
    10: "дезаксиальный механизм: угол НМТ",
    11: "ход поршня дезаксиального механизма",
    12: "перемещение дезаксиального механизма, точно",
    13: "угол шатуна дезаксиального механизма",
    14: "перемещение дезаксиального механизма; точный член ВМТ оставлен, как в книге",
    15: "скорость дезаксиального механизма",
    16: "ускорение дезаксиального механизма",
    17: "угол шатуна дезаксиального механизма в движении",
    18: "угловая скорость шатуна; при 270° в скобке (1 + k)²",
    19: "угловое ускорение шатуна; в (19а) пропущен минус",
    20: "замена шатуна двумя массами",
    21: "момент инерции двух масс",
    22: "масса шатуна как сумма двух",
    23: "центр масс взвешиванием",
    24: "период качаний",
    25: "моменты инерции относительно осей качаний",
    26: "момент инерции относительно центра масс",
    27: "центр масс по качаниям",
    28: "неуравновешенная масса колена",
    29: "вращающаяся масса; у V-образного двигателя 2m₂",
    30: "сила инерции возвратно движущихся масс",
    31: "её гармоники",
    32: "центробежная сила; номер напечатан дважды",
    33: "сила давления газов",
    34: "боковая сила",
    35: "сила вдоль шатуна",
    36: "нормальная сила",
    37: "тангенциальная сила",
    38: "крутящий момент; в книге T напечатано вместо P_s",
    39: "опрокидывающий момент; с дезаксажем блок чувствует −M + e·P_j",
    40: "нагрузка на шатунную шейку; под корнем (K − K_r)² + T²",
    41: "она же через силу S",
    42: "сила, действующая на колено",
    43: "реакция симметричного колена: половина нагрузки",
    44: "реакция правой опоры от центробежных сил, в плоскости колена",
    45: "то же поперёк плоскости",
    46: "реакция левой опоры от центробежных сил, в плоскости колена",
    47: "то же поперёк плоскости",
    48: "внешний противовес на носке; знаки при C₁₁ по статике",
    49: "внешний противовес у маховика; знаки при C₁₃ по статике",
    50: "реакция правой опоры от сил K",
    51: "реакция правой опоры от сил T",
    52: "реакция левой опоры от сил K",
    53: "реакция левой опоры от сил T",
    54: "поправки от опорных моментов; последний индекс читается как П",
    55: "сумма реакций опоры",
    56: "проекция реакции на ось x",
    57: "проекция реакции на ось y",
    58: "они же для симметричного колена",
    59: "полная реакция; номер напечатан дважды, второй раз — эффективный момент",
    60: "угол реакции",
}

# Formulas that stand nowhere by themselves, and why.
REASONS: dict[int, str] = {
    38: "M = T·r с T по (37): столбец M П4.1 и `torque`; в печати (38) T стоит вместо P_s",
    43: "частный случай (50)–(53) для симметричного колена; считается общими формулами",
}


def numbers(text: str) -> set[int]:
    """Numbers of the book's formulas that a text names after the author."""
    collected: set[int] = set()
    for match in _NAMED.finditer(text):
        part = match.group()
        for first, last in _RANGE.findall(part):
            if int(last) - int(first) < LONGEST:  # «(1)-(60)» names the book, not a formula
                collected |= set(range(int(first), int(last) + 1))
            else:
                part = part.replace(f"({first})", "").replace(f"({last})", "")
        collected |= {int(number) for number in _ONE.findall(part)}
    return {number for number in collected if 1 <= number <= LAST}


def _docstrings(tree: ast.Module) -> Iterator[tuple[str, str]]:
    """Names and docstrings of a module's classes and functions."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            text = ast.get_docstring(node)
            if text:
                yield node.name, text


def _sources(tree: ast.Module) -> Iterator[str]:
    """Sources that begin with the author's name: texts of their own or at the ends of lines."""
    for node in ast.walk(tree):
        text = node.value if isinstance(node, ast.Constant) else None
        if isinstance(text, str):
            yield from _SOURCE.findall(text)


@cache
def places() -> dict[int, tuple[list[str], list[str]]]:
    """Number → functions of the solver, modules and books of the tables that name it."""
    collected: dict[int, tuple[list[str], list[str]]] = {n: ([], []) for n in range(1, LAST + 1)}
    for path in sorted((ROOT / "kshm").rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for name, text in _docstrings(tree):
            for number in numbers(text.replace("\n", " ")):
                collected[number][0].append(f"{path.stem}.{name}")
    for path in sorted((ROOT / "reports" / "tables").rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for number in {n for text in _sources(tree) for n in numbers(text)}:
            collected[number][1].append(path.stem)
    for path in sorted((ROOT / "templates" / "tables").glob("*.book")):
        for number in numbers(_COMMENT.sub("", path.read_text(encoding="utf-8"))):
            collected[number][1].append(path.stem)
    return collected


def render() -> str:
    """The list as Markdown."""
    lines = [
        "# Формулы (1)–(60)",
        "",
        "> In English: where each numbered formula of the textbook stands in the solver and in the",
        "> tables. Generated from docstrings and sources of columns.",
        "",
        "А. Н. Гоц. Кинематика и динамика кривошипно-шатунного механизма поршневых двигателей,",
        "2006. Где каждая формула стоит: в решателе (`kshm/`) и в книгах таблиц",
        "(`templates/tables/`). Список составлен по строкам документации и источникам столбцов,",
        "тест следит за его полнотой. Чтение спорных мест — в [прочтениях](readings.md).",
        "",
        "| № | Что это | Решатель | Таблицы |",
        "|---|---|---|---|",
    ]
    for number, (solver, tables) in places().items():
        shown = [", ".join(f"`{name}`" for name in dict.fromkeys(names)) or "—"
                 for names in (solver, tables)]  # fmt: skip
        what = FORMULAS[number]
        if not solver and not tables:
            what += f". {REASONS.get(number, '')}"
        lines.append(f"| {number} | {what} | {shown[0]} | {shown[1]} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.stdout.write(render())
