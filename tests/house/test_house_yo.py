"""Words that a user sees are written with ё: the stems that occur here."""

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
ALLOWED |= {f"kshm/mechanics/{name}.py" for name in ("dimensionless", "torque_harmonics")}
WORD = re.compile("[А-Яа-яёЁ]*[Ее][А-Яа-яёЁ]*")
TITLES = re.compile(r"Конструкция и расчет|Несущая способность и расчет|«Расчет авто")


def test_what_a_user_reads_has_its_dots():
    paths = [path for folder, kind in (("kshm", "py"), ("reports", "py"), ("templates", "j2"),
                                       ("samples", "toml"), ("tools", "py"), ("docs", "md"))
             for path in sorted((ROOT / folder).rglob(f"*.{kind}"))
             if path.parent.name != "class"]  # fmt: skip
    wrong = {
        f"{path.relative_to(ROOT)}: {word}"
        for path in paths
        if str(path.relative_to(ROOT)) not in ALLOWED
        for word in set(WORD.findall(TITLES.sub("", path.read_text(encoding="utf-8"))))
        if STEMS.search(word)
    }
    assert wrong == set()


def test_a_word_without_its_dots_is_noticed():
    for word in ("расчета", "Приведенная", "удается", "четырехтактный", "отчет", "ее"):
        assert STEMS.search(word), word
    for word in ("расчёта", "учебник", "отчётливо", "щека", "определен", "четверть"):
        assert not STEMS.search(word), word
