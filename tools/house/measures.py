"""Measures of the structure, a row each."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterable

from tools.house.code import Code, circles

VAGUE = ("found", "made", "place", "told", "asked", "apart")  # names that say nothing of a value
VAGUE_TOO = ("what", "own", "given", "about", "known", "wanted", "places", "rest", "near", "kept",
             "shown")  # fmt: skip
SMALL, LONG = 60, 40  # lines of a module, of a function
CHAPTERS = {"torsion": ("torsion", "resonance"), "oil": ("oil", "bearing", "film"),
            "strength": ("strength",)}  # fmt: skip
READER = ("books", "book_text", "chapter_reader", "chapter_source", "sandbox", "contents",
          "context", "contexts")  # fmt: skip
CYRILLIC = re.compile("[А-Яа-яЁё]")
TEXT_METHODS = ("startswith", "endswith", "partition", "rpartition", "split", "removeprefix",
                "removesuffix")  # fmt: skip

Measure = Callable[[Code], str]


def imports(code: Code) -> str:
    """Return imports between files / pairs of rooms that they join."""
    edges = {(a, b) for a, targets in code.imports.items() for b in targets}
    rooms = {(code.room(a), code.room(b)) for a, b in edges if code.room(a) != code.room(b)}
    return f"{len(edges)} / {len(rooms)}"


def _rooms(code: Code) -> set[str]:
    return {code.room(module) for module in code.files}


def chapter_files(code: Code) -> str:
    """Files named after a chapter: torsion, oil film, strength."""
    counts = []
    for words in CHAPTERS.values():
        paths = [
            path
            for folder in ("kshm", "reports", "templates")
            for path in (code.root / folder).rglob("*")
            if path.suffix in (".py", ".book", ".j2") and path.name != "__init__.py"
            and any(w in part for w in words for part in path.relative_to(code.root).parts[1:])
        ]  # fmt: skip
        counts.append(len(paths))
    return " / ".join(map(str, counts))


def quoted_chapters(code: Code) -> str:
    """Files whose code quotes the name of a chapter: torsion, strength."""
    return " / ".join(
        str(sum(any(value == name for value in _strings(tree)) for tree in code.trees.values()))
        for name in ("torsion", "strength")
    )


def _strings(tree: ast.Module) -> Iterable[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value


def _names(trees: Iterable[ast.Module]) -> Counter[str]:
    nodes = (node for tree in trees for node in ast.walk(tree))
    return Counter(
        node.id if isinstance(node, ast.Name) else node.arg
        for node in nodes
        if isinstance(node, ast.Name | ast.arg)
    )


def vague_names(code: Code) -> str:
    """Names of values that say nothing: both lists."""
    names = _names(code.trees.values())
    return " / ".join(str(sum(names[word] for word in words)) for words in (VAGUE, VAGUE_TOO))


def vague_names_of_tests(code: Code) -> str:
    """Return the first list in the tests."""
    names = _names(ast.parse(text) for text in code.tests.values())
    return str(sum(names[word] for word in VAGUE))


def decisions_on_russian(code: Code) -> str:
    """Comparisons with a Russian text and cuts at one, and the files that hold them."""
    hits = {name: sum(map(_decides, ast.walk(tree))) for name, tree in code.trees.items()}
    return f"{sum(hits.values())} in {sum(map(bool, hits.values()))} files"


def _decides(node: ast.AST) -> bool:
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        sides = node.args if node.func.attr in TEXT_METHODS else []
    else:
        return False
    return any(
        isinstance(side, ast.Constant) and isinstance(side.value, str)
        and bool(CYRILLIC.search(side.value))
        for side in sides
    )  # fmt: skip


def reader_of_books(code: Code) -> str:
    """Lines of the files that read a book, wherever they stand."""
    return str(sum(
        text.count("\n") for name, text in code.texts.items()
        if name.split(".")[-1] in READER and name.startswith(("reports.model", "reports.tables"))
    ))  # fmt: skip


def jinja(code: Code) -> str:
    """Share of Jinja in the books, per cent of lines: alone / at all; then two books."""

    def share(texts: Iterable[str]) -> str:
        lines = [line.strip() for text in texts for line in text.splitlines()]
        alone = sum(line.startswith("%") or line.startswith("{%") for line in lines)
        holding = sum(line.startswith("%") or "{%" in line or "{{" in line for line in lines)
        return f"{100 * alone / max(len(lines), 1):.0f} / {100 * holding / max(len(lines), 1):.0f}"

    torsion, throws = (share([code.books.get(name, "")]) for name in ("torsion", "throws"))
    return f"{share(code.books.values())}; {torsion}; {throws}"


def homes_of_a_range(code: Code) -> str:
    """Files that state the usual range of λ: both of its ends as numbers or as text."""
    ends = (re.compile(r"\b0[.,]24\b"), re.compile(r"\b0[.,]31\b"))
    texts = [*code.texts.values(), *code.books.values()]
    return str(sum(all(end.search(text) for end in ends) for text in texts))


def functions(code: Code) -> str:
    """Mean length of a function [lines] / share of the long ones."""
    lengths = [(node.end_lineno or node.lineno) - node.lineno + 1 for node in code.functions()]
    share = sum(length > LONG for length in lengths) / len(lengths)
    return f"{sum(lengths) / len(lengths):.1f} / {100 * share:.1f} %"


def not_imperative(code: Code) -> str:
    """Docstrings not in the imperative, by ruff's D401."""
    printed = subprocess.run(
        [sys.executable, "-m", "ruff", "check", "--isolated", "--select", "D401", "--no-cache",
         "--output-format", "concise", *(str(code.root / name) for name in ("kshm", "reports"))],
        capture_output=True, text=True, check=False,
    ).stdout  # fmt: skip
    docstrings = sum(ast.get_docstring(node) is not None for node in code.functions())
    return f"{printed.count(' D401 ')} of {docstrings}"


def late_constants(code: Code) -> str:
    """Assignments of a module below its first function or class, and the files that hold them."""
    counts = [_late(tree) for tree in code.trees.values()]
    return f"{sum(counts)} in {sum(map(bool, counts))} files"


def _late(tree: ast.Module) -> int:
    kinds = [isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef)
             for node in tree.body]  # fmt: skip
    first = kinds.index(True) if any(kinds) else len(kinds)
    return sum(isinstance(node, ast.Assign | ast.AnnAssign) for node in tree.body[first:])


def circles_of_files(code: Code) -> str:
    """Circles of imports between files."""
    return str(len(circles(code.imports)))


def circles_of_rooms(code: Code) -> str:
    """Circles of imports between folders."""
    rooms: dict[str, set[str]] = {room: set() for room in _rooms(code)}
    for module, targets in code.imports.items():
        rooms[code.room(module)] |= {code.room(target) for target in targets}
    return str(len(circles({room: targets - {room} for room, targets in rooms.items()})))


def for_tests_alone(code: Code) -> str:
    """Public functions of modules that no code of the packages or tools names, but a test does."""
    trees = (*code.trees.values(), *map(ast.parse, code.tools.values()))
    used = Counter(word for tree in trees for node in ast.walk(tree) for word in _uses(node))
    tested = set(re.findall(r"\w+", "\n".join(code.tests.values())))
    templates = " ".join(
        path.read_text(encoding="utf-8") for path in (code.root / "templates").rglob("*.j2")
    )
    return str(sum(
        isinstance(node, ast.FunctionDef) and not node.name.startswith("_")
        and not node.decorator_list and not used[node.name] and node.name in tested
        and not re.search(rf"\b{node.name}\b", templates)
        for tree in code.trees.values() for node in tree.body
    ))  # fmt: skip


def _uses(node: ast.AST) -> Iterable[str]:
    if isinstance(node, ast.Name):
        yield node.id
    elif isinstance(node, ast.Attribute):
        yield node.attr
    elif (
        isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value.isidentifier()
    ):
        yield node.value


def error_classes(code: Code) -> str:
    """Classes of exceptions by their name, and the files that hold them."""
    holders = [
        name
        for name, tree in code.trees.items()
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef) and any(_is_error(base) for base in node.bases)
    ]
    return f"{len(holders)} in {len(set(holders))} files"


def _is_error(base: ast.expr) -> bool:
    name = base.attr if isinstance(base, ast.Attribute) else getattr(base, "id", "")
    return name.endswith(("Error", "Exception"))


def classes_of_one_name(code: Code) -> str:
    """Names that more than one class has."""
    classes = Counter(
        node.name for tree in code.trees.values() for node in tree.body
        if isinstance(node, ast.ClassDef)
    )  # fmt: skip
    return str(sum(count > 1 for count in classes.values()))


def small_modules(code: Code) -> str:
    """Modules under SMALL lines / with one importer."""
    plain = [name for name, path in code.files.items() if not path.stem.startswith("__")]
    importers = Counter(target for targets in code.imports.values() for target in targets)
    small = sum(code.texts[name].count("\n") < SMALL for name in plain)
    return f"{small} / {sum(importers[name] == 1 for name in plain)}"


def lines(code: Code) -> str:
    """Lines: Python + books / tests."""
    python = sum(text.count("\n") for text in code.texts.values())
    books = sum(text.count("\n") for text in code.books.values())
    return f"{python} + {books} / {sum(text.count(chr(10)) for text in code.tests.values())}"


def files(code: Code) -> str:
    """Modules / books."""
    return f"{len(code.files)} / {len(code.books)}"


MEASURES: dict[str, Measure] = {
    "files of Python / books": files,
    "lines, Python + books / tests": lines,
    "imports between files / between rooms": imports,
    "circles of files": circles_of_files,
    "circles of rooms": circles_of_rooms,
    f"modules under {SMALL} lines / with one importer": small_modules,
    "files named after torsion / oil / strength": chapter_files,
    'files that quote "torsion" / "strength"': quoted_chapters,
    "vague names: first list / second list": vague_names,
    "vague names of the first list in tests": vague_names_of_tests,
    "decisions on a Russian text": decisions_on_russian,
    "files that state the usual range of λ": homes_of_a_range,
    "lines of the reader of books": reader_of_books,
    "Jinja in books, % of lines alone / at all; torsion; throws": jinja,
    f"functions: mean lines / over {LONG}": functions,
    "docstrings not in the imperative": not_imperative,
    "constants below the first function": late_constants,
    "classes of errors": error_classes,
    "class names with several meanings": classes_of_one_name,
    "functions that tests alone call": for_tests_alone,
}
