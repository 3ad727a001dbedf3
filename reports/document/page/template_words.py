"""Russian for what Jinja says of a person's own templates."""

from __future__ import annotations

import re

import jinja2

_NAME = r"'([^']*)'"
# Of the parser, then of a template that is written; what is quoted goes over as it is.
_WORDS = tuple(
    (re.compile(pattern), russian)
    for pattern, russian in (
        (r"Unexpected end of template\. Jinja was looking for the following tags: (.*?)\. .*?"
         r"innermost block that needs to be closed is '(\w+)'", "блок {1} не закрыт: нет {0}"),
        (r"Unexpected end of template", "шаблон обрывается"),
        (r"Encountered unknown tag '(\w+)'\. .*?following tags: (.*?)\.",
         "здесь не может стоять {0}: ожидается {1}"),
        (r"Encountered unknown tag '(end\w+|else|elif)'", "{} без начала блока"),
        (rf"Encountered unknown tag {_NAME}", "нет команды {}"),
        (rf"expected token {_NAME}, got {_NAME}", "ожидается «{}», а стоит «{}»"),
        (rf"unexpected end of template, expected {_NAME}", "шаблон обрывается, ожидается «{}»"),
        (r"unexpected char ['\"](.*)['\"] at", "лишний знак «{}»"),
        (rf"unexpected {_NAME}, expected {_NAME}", "лишнее «{}», ожидается «{}»"),
        (rf"unexpected {_NAME}", "лишнее «{}»"),
        (rf"Expected an expression, got {_NAME}", "ожидается выражение, а стоит «{}»"),
        (r"Missing end of (raw directive|comment tag)", "не закрыт комментарий или блок raw"),
        (rf"No filter named {_NAME}", "нет фильтра {}"),
        (rf"No test named {_NAME}", "нет проверки {}"),
        (rf"block {_NAME} defined twice", "блок {} объявлен дважды"),
        (rf"can't assign to {_NAME}", "сюда нельзя присваивать"),
        (r"tag name expected", "после знака процента нужна команда"),
        (r"expected name or number", "после точки нужно имя или число"),
        (r"^'([\w.\[\]]+)' is undefined", "нет имени {}"),
        (rf"has no (?:attribute|element) {_NAME}", "нет свойства {}"),
        (r"has no element (\S+)", "нет элемента {}"),
        (r"'?(\w[\w. ]*?)'? object is not callable", "{} — не функция"),
        (rf"unexpected keyword argument {_NAME}", "лишний аргумент {}"),
        (r"missing \d+ required (?:positional|keyword-only) arguments?: (.*)",
         "не задан аргумент {}"),
        (r"macro '(.*?)' takes not more than", "лишние аргументы у {}"),
        (r"access to attribute '(.*?)'", "обращаться к {} нельзя"),
        (r"cannot be interpreted as an integer", "нужно целое число"),
        (r"takes .* positional arguments? but", "лишние аргументы"),
        (r"division by zero", "деление на нуль"),
        (r"unsupported operand type|can only concatenate|must be str, not",
         "действие над значениями разных видов"),
        (r"object is not iterable", "это не перечень: по нему нельзя пройти"),
        (r"^no (?:angle|formula) for(?: the column)? (\S+)", "у величины {} нет числа или формулы"),
    )
)  # fmt: skip
_TOKENS = {
    "end of statement block": "%}", "begin of statement block": "{%",
    "end of print statement": "}}", "begin of print statement": "{{",
    "end of template": "конец шаблона", "template data / text": "текст", "name": "имя",
    "integer": "число", "float": "число", "string": "текст в кавычках",
}  # fmt: skip


def in_russian(error: Exception) -> str:
    """What is wrong with a template; a bare key or name is what was not found."""
    key = error.args[0] if isinstance(error, KeyError) and error.args else None
    message = str(getattr(error, "message", None) or key or error)
    if isinstance(error, jinja2.TemplateNotFound):
        return f"нет шаблона {message}"
    for pattern, russian in _WORDS:
        found = pattern.search(message)
        if found is not None:
            return russian.format(*(_quoted(group) for group in found.groups()))
    if key is not None:
        return f"нет величины {key}"
    if re.search("[А-Яа-я]", message):
        return message  # said by the program itself
    return f"выражение не вычисляется ({type(error).__name__}: {message})"


def _quoted(text: str) -> str:
    """A name of the template as it is, a name of Jinja's in Russian."""
    text = _TOKENS.get(text, text)
    *most, last = re.split(" or | and ", re.sub("'([^']+)'", r"\1", text))
    return f"{', '.join(most)} или {last}" if most else last
