"""Mistakes in the statements of books, in the words of books: Jinja2 tells them in its own."""

from __future__ import annotations

import re
from collections.abc import Iterator

import jinja2

_STATEMENT = re.compile(r"\s*%-?\s*(\w+)(.*)")
_CLOSED = ("if", "for", "macro", "filter", "with", "call", "block", "raw", "autoescape")
_WITHIN = {"else": ("if", "for"), "elif": ("if",)}
# What Jinja2 says: pattern, and the same in Russian; groups are its tokens.
_SAID = (
    (r"unknown tag '(.+?)'", "непонятно «{}»"),
    (r"[Nn]o (?:filter|test) named '(.+?)'", "непонятно «{}»"),
    (r"expected token '(.+?)', got '(.+?)'", "нужно {}, а стоит {}"),
    (r"[Ee]xpected an expression, got '(.+?)'", "нужно значение, а стоит {}"),
    (r"unexpected char (?:'|\")(.+?)(?:'|\") at", "лишний знак «{}»"),
    (r"unexpected '(.+?)', expected '(.+?)'", "стоит «{}», а нужно «{}»"),
    (r"unexpected '(.+?)'", "лишнее {}"),
    (r"can't assign to '(.+?)'", "имени «{}» не присвоить"),
    (r"[Cc]annot assign", "сюда не присвоить"),
    (r"'(.+?)' (?:is undefined|has no attribute '.+?')$", "нет имени «{}»"),
)  # fmt: skip
_TOKENS = {
    "end of statement block": "конец строки", "end of print statement": "}}",
    "begin of statement block": "начало условия", "end of template": "конец книги",
    "name": "имя", "string": "текст", "integer": "целое число", "float": "число",
    "lstring": "текст", "block_end": "конец строки", "end of comment": "конец примечания",
}  # fmt: skip


def said_of(error: jinja2.TemplateError) -> str:
    """Return what Jinja2 says of a mistake, in Russian; nothing where it names nothing."""
    text = str(error.message)
    missing = re.search(r"has no attribute '(.+?)'", text)
    if missing is not None:
        return f"нет имени «{missing[1]}»"
    for pattern, words in _SAID:
        match = re.search(pattern, text)
        if match is not None:
            quoted = "{}" in words.replace("«{}»", "")
            return words.format(*(_token(part, quoted=quoted) for part in match.groups()))
    return ""


def _token(word: str, *, quoted: bool) -> str:
    return _TOKENS.get(word) or (f"«{word}»" if quoted else word)


def unpaired(text: str) -> Iterator[tuple[int, str, str]]:
    """Statements of a text that lack their other half: line, what is wrong, how to mend it."""
    waiting: list[tuple[int, str]] = []
    for number, line in enumerate(text.splitlines(), 1):
        statement = _STATEMENT.fullmatch(line)
        if statement is None:
            continue
        word, tail = statement[1], statement[2]
        if word in _CLOSED or (word == "set" and "=" not in tail):
            waiting.append((number, word))
        elif word.startswith("end"):
            if not waiting or waiting[-1][1] != word[3:]:
                above = f"; открыт % {waiting[-1][1]} на строке {waiting[-1][0]}" if waiting else ""
                yield number, f"% {word} без % {word[3:]}{above}", "уберите лишнее или допишите"
                return
            waiting.pop()
        elif word in _WITHIN and not (waiting and waiting[-1][1] in _WITHIN[word]):
            yield number, f"% {word} стоит вне % if", "допишите % if выше"
            return
    for number, word in waiting:
        yield number, f"% {word} не закрыт", f"допишите % end{word}"
