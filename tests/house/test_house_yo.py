"""Words that a user sees are written with ё: the stems that occur here."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
STEMS = re.compile(
    r"(?i)\b(?:расч|отч|уч)ет(?:\b|[аеуыо])|\bрасчетн|\b(?:не)?четн|\b(?:с|раз)вернут|скругленн"
    r"|\b(?:при|от|про)веденн|отнесенн|теплоемк|\bобъем|(?:четыр|\bтр)ехт?|\b(?:да|бер|ид|вед|зада|уда"
    r"|доста|поверн|проверн)ет(?:ся)?\b|\bеще\b|\bее\b|\bнее\b|\bщек\b(?!а|и|е|у)|\bвсе же\b"
)
# Names of columns that a list may have, words that an input may use, titles as printed.
ALLOWED = {"reports/grading/issuing/roster.py", "reports/inputs/understood.py"}
TITLES = re.compile(r"Конструкция и расчет|Несущая способность и расчет|«Расчет авто")


def literals(path: Path) -> list[str]:
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".py":
        return [text]
    tree = ast.parse(text)
    kinds = ast.Module | ast.ClassDef | ast.FunctionDef
    nodes = [node for node in ast.walk(tree) if isinstance(node, kinds) and node.body]
    docs = {id(node.body[0].value) for node in nodes if isinstance(node.body[0], ast.Expr)}
    return [node.value for node in ast.walk(tree)
            if isinstance(node, ast.Constant) and isinstance(node.value, str)
            and id(node) not in docs]  # fmt: skip


def test_what_a_user_reads_has_its_dots():
    paths = [path for folder, kind in (("kshm", "py"), ("reports", "py"), ("templates", "j2"),
                                       ("samples", "toml"))
             for path in sorted((ROOT / folder).rglob(f"*.{kind}"))
             if path.parent.name != "class"]  # fmt: skip
    wrong = {
        f"{path.relative_to(ROOT)}: {found.group()}"
        for path in paths
        if str(path.relative_to(ROOT)) not in ALLOWED
        for text in literals(path)
        for found in STEMS.finditer(text)
        if not TITLES.search(text[max(0, found.start() - 40) : found.end() + 20])
    }
    assert wrong == set()


def test_a_word_without_its_dots_is_noticed():
    for word in ("расчета", "Приведенная", "удается", "четырехтактный", "отчет", "ее"):
        assert STEMS.search(word), word
    for word in ("расчёта", "учебник", "счетчик", "отчётливо", "щека", "определен", "четверть"):
        assert not STEMS.search(word), word
