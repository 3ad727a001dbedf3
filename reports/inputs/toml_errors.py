"""What is wrong with a line that the TOML parser does not read, and how to mend it."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator

from reports.inputs.messages import latin, shown

Words = tuple[str, str]  # what, hint

_KEY_TWICE, _SECTION_TWICE = "ключ задан дважды", "раздел задан дважды"
_PARSER = (
    ("Cannot overwrite a value", _KEY_TWICE),
    ("Cannot declare", _SECTION_TWICE),
    ("Cannot mutate immutable", _SECTION_TWICE),
    ("Cannot redefine namespace", _SECTION_TWICE),
    ("Unterminated string", "строка не закрыта кавычкой"),
    ("Unclosed array", "список не закрыт скобкой «]»"),
    (r"Illegal character '\n'", "строка не закрыта кавычкой"),
    ("Illegal character", "недопустимый символ"),
    ("Unescaped '\\' in a string", "обратная черта «\\» в кавычках"),
    ("Invalid value", "после знака «=» нет допустимого значения"),
    ("Expected '=' after a key", "после ключа нет знака «=»"),
    ("Expected ']'", "заголовок раздела не закрыт скобкой «]»"),
    ("Expected newline or end of document", "лишние символы после значения"),
    ("Invalid statement", "непонятная строка"),
    ("Invalid initial character for a key part", "непонятный ключ"),
)
_STRING = re.compile(r'"(?:[^"\\]|\\.)*"|\'[^\']*\'')
_COMMENT = re.compile(r"""^((?:[^"'#]|"(?:[^"\\]|\\.)*"|'[^']*')*)#.*$""")
_SPACES = {"\u00a0": "неразрывный пробел", "\u202f": "узкий неразрывный пробел"}
_QUOTES = "«»“”„‟‘’‚‹›"
_DECIMAL_COMMA = re.compile(r"(?<![\d.,])([-+]?\d+),(\d+)(?![\d.,]*\d)")
_ITEMS = re.compile(r"[-+]?\d+([.,]\d+)?((\s*;\s*|,\s+)[-+]?\d+([.,]\d+)?)+")
_Rule = Callable[[str], Iterator[Words]]


def toml_error(error: Exception, text: str) -> Words:
    """Return (what, hint) for an error of the TOML parser."""
    message = str(error)
    twice, problem = next(
        (
            (russian is _KEY_TWICE or russian is _SECTION_TWICE, russian)
            for english, russian in _PARSER
            if english in message
        ),
        (False, "ошибка записи TOML"),
    )
    position = re.search(r"\(at line (\d+), column (\d+)\)", message)
    # tomllib counts lines by "\n" only; splitlines() would also cut at other breaks.
    lines = text.replace("\r\n", "\n").split("\n")
    row, column = (int(position[1]), int(position[2])) if position else (0, 0)
    if "end of document" in message or "Unclosed array" in message:
        row = _opened(lines, row) or row
        if not row:
            return "файл обрывается на середине записи", "восстановите его конец"
    if not row:
        return problem, "проверьте запись по примеру из «kshm new»"
    line = lines[row - 1] if row <= len(lines) else ""
    for rule in () if twice else _RULES:
        for exact, hint in rule(line):
            return f"строка {row}: {exact}", hint
    hint = f"строка: {shown(line.strip())}" if line.strip() else ""
    return f"строка {row}, столбец {column}: {problem}", hint


def decimal_commas(text: str) -> Iterator[Words]:
    """Yield lists that are valid TOML and still look like decimal fractions with a comma."""
    for row, line in enumerate(text.splitlines(), start=1):
        pairs = re.search(r"=\s*\[\s*(\d+,\d+(?:,\s+\d+,\d+)+)\s*\]", line)
        if pairs is not None:
            mended = re.sub(r"(\d),(\d)", r"\1.\2", pairs[1])
            problem = f"строка {row}: в списке дроби с запятой"
            yield problem, f"если это дроби, напишите [{mended[:60]}]"


def _opened(lines: list[str], end: int) -> int:
    """Number of the line before ``end`` (0: before the last one) that opens and does not close."""
    filled = [row for row, line in enumerate(lines, start=1) if line.strip()]
    for row in reversed([row for row in filled if row < (end or filled[-1])]):
        line = bare(lines[row - 1])
        if line.count("[") > line.count("]") or {"'", '"'} & set(line.replace('""', "")):
            return row
        if end and "=" in line:
            return 0
    return 0


def _code(line: str) -> str:
    """Return a line without its comment."""
    comment = _COMMENT.match(line)
    return comment[1] if comment else line.partition(" #")[0]


def bare(line: str) -> str:
    """Return a line without its comment and the insides of its strings."""
    return _STRING.sub('""', _code(line))


def _space(line: str) -> Iterator[Words]:
    """Yield a space or an invisible sign that only looks empty."""
    for number, sign in enumerate(line, start=1):
        if sign in "\t " or unicodedata.category(sign) not in ("Zs", "Cf"):
            continue
        if sign in bare(line):
            name = _SPACES.get(sign, f"невидимый знак U+{ord(sign):04X}")
            yield f"{name} в столбце {number}", "замените его обычным пробелом или удалите"
            return


def _letter(line: str) -> Iterator[Words]:
    """Yield a letter of another alphabet in a key or in the name of a section."""
    key = re.match(r"\s*\[{0,2}\s*([^\s=\[\]\"'#]+)", line)
    if key is None:
        return
    strange = [sign for sign in key[1] if not sign.isascii() and sign.isalpha()]
    if not strange:
        return
    mended = latin(key[1])
    alphabet = "русская буква" if "CYRILLIC" in unicodedata.name(strange[0], "") else "буква"
    problem = f"в ключе «{shown(key[1])[1:-1]}» {alphabet} «{strange[0]}»"
    if mended.isascii():
        yield problem, f"напишите латиницей: {mended}"
    else:
        yield problem, "ключи пишутся латиницей, названия — в комментарии после #"


def _value(line: str) -> str:
    return line.partition("=")[2].strip()


def _quotes(line: str) -> Iterator[Words]:
    """Typographic quotation marks around a text."""
    value = _value(_code(line))
    if value[:1] and value[0] in _QUOTES:
        mended = re.sub(f"[{_QUOTES}]", "", value).strip()
        yield f"типографская кавычка {value[0]}", f'нужны прямые: "{mended[:40]}"'


def _backslash(line: str) -> Iterator[Words]:
    """Yield a Windows path in double quotes."""
    text = re.search(r'"([^"]*\\[^"]*)"', line)
    if text is not None:
        mended = text[1].replace("\\", "/")
        yield "обратная черта «\\» в кавычках", f'пишите прямую: "{mended[:60]}"'


def _list(line: str) -> Iterator[Words]:
    """Yield a list without its brackets or with the separators of a Russian Excel."""
    value = _value(bare(line))
    brackets = re.match(r"[\[({](.*?)[\])}]?$", value)
    inside = brackets[1] if brackets else value
    parts = inside.split(";") if ";" in inside else re.split(r",\s+|\s+", inside)
    mended = ", ".join(part.strip().replace(",", ".") for part in parts)[:60]
    if value[:1] in ("(", "{") or _ITEMS.fullmatch(value):
        yield "список без квадратных скобок", f"напишите [{mended}]"
    elif not brackets:
        return
    elif ";" in inside:
        yield "в списке точка с запятой", f"между числами запятая, дробь с точкой: [{mended}]"
    elif "]" not in value:
        yield "список не закрыт скобкой «]»", f"строка: {shown(_code(line).strip())}"
    elif re.search(r"\d\s+[-+]?\d", inside):
        yield "в списке нет запятой между числами", f"напишите [{mended}]"


def _number(line: str) -> Iterator[Words]:
    """Yield a number with a decimal comma, blanks, a unit or a formula."""
    value = _value(bare(line))
    if re.match(r"[-+]?\d+,\d+$", value):
        yield (
            f"дробь с запятой: {value}",
            f"десятичный разделитель — точка: {value.replace(',', '.')}",
        )
    elif re.fullmatch(r"[-+]?\d{1,3}( \d{3})+([.,]\d+)?", value):
        yield f"пробелы в числе {value}", f"напишите {value.replace(' ', '').replace(',', '.')}"
    elif unit := re.fullmatch(r"([-+]?\d+(?:[.,]\d+)?)\s*([^\W\d_][\w·/°%²³.-]*|[°%])", value):
        number = unit[1].replace(",", ".")
        yield f"лишнее после числа: «{unit[2]}»", f"единица стоит в имени ключа, напишите {number}"
    elif re.fullmatch(r"[-+−–]?(\d+[.·]?\d*|\.\d+)[;,.]?", value):
        mended = value.rstrip(";,.").replace("·", ".").replace("−", "-").replace("–", "-")
        yield f"число записано как {value}", f"напишите {float(mended):g}"
    elif re.match(r"[-+]?\d[\d.]*[;,\s]\s*[A-Za-z_]\w*\s*=", value):
        yield "две записи на одной строке", "пишите каждый ключ на своей строке"
    elif letter := re.match(r"[-+]?\d[\d.,]*([^\W\d_a-zA-Z])[\d.,]", value):
        yield f"в числе {value} буква «{letter[1]}»", "пишите число цифрами"
    elif value.startswith("="):
        yield "формула вместо числа", "в файле пишут готовое число, формулы — в книге Excel"


def _text(line: str) -> Iterator[Words]:
    """Yield a text without quotation marks, or with one of them."""
    value = _value(_code(line))
    if not value and "=" in _code(line):
        yield "после знака «=» ничего нет", "впишите значение или удалите строку"
    elif value[:1].isalpha() and value not in ("true", "false", "inf", "nan"):
        if value.lower() in ("да", "нет", "yes", "no", "истина", "ложь"):
            right = "true" if value.lower() in ("да", "yes", "истина") else "false"
            yield f"слово {shown(value)} без кавычек", f"напишите {right}"
        else:
            yield "строка без кавычек", f'напишите "{value.rstrip(chr(34))[:40]}"'
    elif value[:1] in ("'", '"') and value.count(value[0]) == 1:
        yield "строка не закрыта кавычкой", f"напишите {value[:40]}{value[0]}"


def _equals(line: str) -> Iterator[Words]:
    """Another sign in place of that between key and value, or a comment of another language."""
    other = re.match(r"\s*([A-Za-z]\w*)\s*(:=|:|\s)\s*(.+?)\s*$", bare(line))
    if re.match(r"\s*(//|;|--|/\*)", line):
        yield "комментарий начинается не с «#»", "поставьте в начале строки #"
    elif other is not None and "=" not in other[3]:
        value = re.sub(r"^\s*\w+\s*(:=|:)?\s*", "", _code(line)).strip()
        yield "после ключа нет знака «=»", f"напишите {other[1]} = {value[:40]}"


# The first that knows the line speaks.
_RULES: tuple[_Rule, ...] = (
    _space, _letter, _equals, _quotes, _backslash, _list, _number, _text,
)  # fmt: skip
