"""Prints the measures of the structure: ``python -m tools.house [FOLDER]``.

Counted are the files of ``kshm``, ``reports`` and the books of ``templates/tables``.
"""

from __future__ import annotations

import ast
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path

VAGUE = ("found", "made", "place", "told", "asked", "apart")  # names that say nothing of a value
SMALL = 60  # lines


def modules(root: Path) -> dict[str, Path]:
    """Modules of both packages by name."""
    files = [f for package in ("kshm", "reports") for f in sorted((root / package).rglob("*.py"))]
    return {".".join(f.relative_to(root).with_suffix("").parts): f for f in files}


def imported(tree: ast.Module) -> Iterator[str]:
    """Names that a module imports: modules, and what it takes from them."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def measures(root: Path) -> dict[str, int | str]:
    """Measure by its title."""
    files = modules(root)
    texts = {name: path.read_text(encoding="utf-8") for name, path in files.items()}
    trees = {name: ast.parse(text) for name, text in texts.items()}
    importers: defaultdict[str, set[str]] = defaultdict(set)
    for name, tree in trees.items():
        for target in set(imported(tree)) & files.keys() - {name}:
            importers[target].add(name)
    plain = [name for name in files if not name.endswith(("__init__", "__main__"))]
    classes = Counter(
        node.name for tree in trees.values() for node in tree.body if isinstance(node, ast.ClassDef)
    )
    words = Counter(
        node.id if isinstance(node, ast.Name) else node.arg
        for tree in trees.values()
        for node in ast.walk(tree)
        if isinstance(node, ast.Name | ast.arg)
    )
    books = sorted((root / "templates" / "tables").glob("*.book"))
    lines = sum(text.count("\n") for text in texts.values())
    of_books = sum(path.read_text(encoding="utf-8").count("\n") for path in books)
    return {
        "files of Python": len(files),
        "books": len(books),
        "lines of Python": lines,
        "lines of books": of_books,
        "modules with one importer": sum(len(importers[name]) == 1 for name in plain),
        f"modules under {SMALL} lines": sum(texts[name].count("\n") < SMALL for name in plain),
        "class names with several meanings": sum(count > 1 for count in classes.values()),
        "vague names of values": sum(words[word] for word in VAGUE),
        **{f"files of {chapter}": chapter_files(root, chapter) for chapter in ("torsion", "oil")},
    }


def chapter_files(root: Path, chapter: str) -> str:
    """Files, folders and lines of a chapter: those that are named after it."""
    names = {"torsion": ("torsion", "resonance"), "oil": ("oil", "bearing", "film")}[chapter]
    paths = [
        path
        for folder in ("kshm", "reports", "templates")
        for path in (root / folder).rglob("*")
        if path.suffix in (".py", ".book", ".j2")
        and any(name in part for name in names for part in path.relative_to(root).parts[1:])
        and path.name != "__init__.py"
    ]
    lines = sum(path.read_text(encoding="utf-8").count("\n") for path in paths)
    return f"{len(paths)} in {len({path.parent for path in paths})} folders, {lines} lines"


if __name__ == "__main__":
    for title, value in measures(Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()).items():
        print(f"{title:36} {value}")
