"""Folder of an institution's own templates: search, checks, errors by line."""

from __future__ import annotations

import re
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import jinja2

from reports.shared import resources
from reports.shared.errors import InputError, Problem

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
KEY = "report.templates"
MAX_NESTED = 100  # blocks of Jinja or elements of the page: the report's own have nine
_OPENING = re.compile(
    r"(?P<kind>\{%-?\s*|<)(?P<end>end|/)?"
    r"(?:if|for|block|macro|call|filter|with|div|span|section|table|ul|ol|b|i|em|strong|figure"
    r"|article|main|a|sub|sup)\b"
)
SUFFIX = ".j2"


def in_russian(error: Exception) -> str:
    """Error of a template in Russian; a bare key is an unknown name."""
    key = error.args[0] if isinstance(error, KeyError) and error.args else None
    message = str(getattr(error, "message", None) or key or error)
    if isinstance(error, jinja2.TemplateNotFound):
        return f"нет шаблона {message}"
    for pattern, russian in _WORDS:
        match = pattern.search(message)
        if match is not None:
            return russian.format(*(_quoted(group) for group in match.groups()))
    if key is not None:
        return f"нет величины {key}"
    if re.search("[А-Яа-я]", message):
        return message  # said by the program itself
    return f"выражение не вычисляется ({type(error).__name__}: {message})"


def _quoted(text: str) -> str:
    """Return a name of the template as it is, a name of Jinja's in Russian."""
    text = _TOKENS.get(text, text)
    *most, last = re.split(" or | and ", re.sub("'([^']+)'", r"\1", text))
    return f"{', '.join(most)} или {last}" if most else last


def find(given: str, beside: Path) -> Path | None:
    """Return the folder named in the input, relative to the input file; ``None`` if none is named.

    Raises:
        InputError: no such folder, or nothing in it replaces a template.
    """
    if not given.strip():
        return None
    folder = (beside / given).resolve()
    try:
        names = sorted(path.name for path in folder.iterdir() if path.is_file())
    except OSError:
        problem = f"нет папки {folder}"
        raise InputError(Problem(KEY, problem, "укажите папку от файла исходных данных")) from None
    known = {path.name for path in (resources.templates_dir() / "report").glob(f"*{SUFFIX}")}
    given_names = [name for name in names if name.endswith(SUFFIX)]
    unknown = [name for name in given_names if name not in known]
    if unknown or not given_names:
        problem = f"{folder}: {unknown[0]} ничего не заменяет" if unknown else f"{folder}: пусто"
        hint = "имена шаблонов: " + ", ".join(sorted(known))
        raise InputError(Problem(KEY, problem, hint))
    _refuse_links(folder)
    for name in given_names:
        _refuse_nesting(folder / name)
    return folder


def _refuse_links(folder: Path) -> None:
    """Refuse links out of the folder: a template is what lies in it."""
    for path in folder.rglob("*"):
        if path.is_symlink() and not path.resolve().is_relative_to(folder):
            problem = f"{path.name} — ссылка из папки шаблонов наружу"
            raise InputError(Problem(KEY, problem, "положите в папку сам файл"))


def _refuse_nesting(path: Path) -> None:
    """Refuse blocks and elements so deep that parser and layout would give up."""
    depth = {"{%": 0, "<": 0}
    for word in _OPENING.finditer(path.read_text(encoding="utf-8", errors="replace")):
        kind = word["kind"][:2].strip()
        depth[kind] = max(0, depth[kind] + (-1 if word["end"] else 1))
        if depth[kind] > MAX_NESTED:
            problem = f"{path}: блоки вложены глубже {MAX_NESTED}"
            raise InputError(Problem(KEY, problem, "исправьте шаблон или уберите его из папки"))


@contextmanager
def template_errors(folder: Path | None) -> Iterator[None]:
    """Turn errors of own templates into one line: file, line, error.

    Raises:
        InputError: the error lies in the folder's templates.
    """
    import jinja2

    try:
        yield
    except jinja2.TemplateSyntaxError as error:
        file = error.filename or error.name  # of a comment without end only the latter is known
        if folder is None or not _inside(file, folder):
            raise
        raise _problem(Path(str(file)), error.lineno, in_russian(error)) from error
    except Exception as error:
        where = _place(error, folder) if folder is not None else None
        if where is None:
            raise
        raise _problem(*where, in_russian(error)) from error


def style_error(folder: Path, warnings: str) -> InputError:
    """Refuse a style sheet or a markup of the folder's templates that is not understood."""
    return InputError(Problem(str(folder), warnings, "исправьте шаблон или уберите его из папки"))


def _inside(name: str | None, folder: Path) -> bool:
    return name is not None and Path(name).resolve().is_relative_to(folder)


def _place(error: Exception, folder: Path) -> tuple[Path, int] | None:
    """Innermost template line of a traceback."""
    if isinstance(error, UnicodeDecodeError):
        return _unreadable(folder)
    frames = traceback.extract_tb(error.__traceback__)
    hits = [frame for frame in frames if _inside(frame.filename, folder)]
    return (Path(hits[-1].filename), hits[-1].lineno or 0) if hits else None


def _unreadable(folder: Path) -> tuple[Path, int] | None:
    for path in sorted(folder.glob(f"*{SUFFIX}")):
        data = path.read_bytes()
        try:
            data.decode("utf-8")
        except UnicodeDecodeError as error:
            return path, data.count(b"\n", 0, error.start) + 1
    return None


def _problem(path: Path, line: int, message: str) -> InputError:
    where = f"{path}, строка {line}"
    return InputError(Problem(where, message, "исправьте шаблон или уберите его из папки"))
