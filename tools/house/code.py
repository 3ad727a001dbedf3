"""The code of one tree, read once: files, syntax, imports, books."""

from __future__ import annotations

import ast
from collections.abc import Iterator, KeysView
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

PACKAGES = ("kshm", "reports")


@dataclass(frozen=True)
class Code:
    """Packages, tests and books below a root."""

    root: Path

    @cached_property
    def files(self) -> dict[str, Path]:
        """Modules of both packages by name; a package goes by its own name."""
        paths = [path for name in PACKAGES for path in sorted((self.root / name).rglob("*.py"))]
        return {_module(path.relative_to(self.root)): path for path in paths}

    @cached_property
    def texts(self) -> dict[str, str]:
        """Text of each module."""
        return {name: path.read_text(encoding="utf-8") for name, path in self.files.items()}

    @cached_property
    def trees(self) -> dict[str, ast.Module]:
        """Syntax of each module."""
        return {name: ast.parse(text) for name, text in self.texts.items()}

    @cached_property
    def tests(self) -> dict[Path, str]:
        """Text of each file of the tests."""
        return _texts(self.root / "tests", "*.py")

    @cached_property
    def tools(self) -> dict[Path, str]:
        """Text of each file of the tools."""
        return _texts(self.root / "tools", "*.py")

    @cached_property
    def books(self) -> dict[str, str]:
        """Text of each book by its name."""
        actual = _texts(self.root / "templates", "*.book")
        return {path.stem: text for path, text in actual.items() if path.parent.name != "templates"}

    @cached_property
    def imports(self) -> dict[str, set[str]]:
        """Modules of the packages that each module imports."""
        return {
            name: {target for target in _targets(tree, self.files.keys()) if target != name}
            for name, tree in self.trees.items()
        }

    def room(self, module: str) -> str:
        """Folder of a module."""
        return str(self.files[module].parent.relative_to(self.root))

    def functions(self) -> Iterator[ast.FunctionDef | ast.AsyncFunctionDef]:
        """Functions and methods of the packages."""
        for tree in self.trees.values():
            for node in ast.walk(tree):
                if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                    yield node


def _module(path: Path) -> str:
    return ".".join(path.with_suffix("").parts).removesuffix(".__init__")


def _texts(folder: Path, pattern: str) -> dict[Path, str]:
    return {path: path.read_text(encoding="utf-8") for path in sorted(folder.rglob(pattern))}


def _targets(tree: ast.Module, names: KeysView[str]) -> Iterator[str]:
    """Modules that a module names: ``from a import b`` is a, and a.b where that is a module."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                whole = f"{node.module}.{alias.name}"
                yield from (name for name in (whole, node.module) if name in names)


def circles(graph: dict[str, set[str]]) -> list[set[str]]:
    """Return sets of nodes that reach each other: strongly connected, more than one."""
    order: list[str] = []
    seen: set[str] = set()
    for start in graph:
        _visit(start, graph, seen, order)
    reverse: dict[str, set[str]] = {node: set() for node in graph}
    for node, targets in graph.items():
        for target in targets:
            reverse[target].add(node)
    seen.clear()
    sets = []
    for start in reversed(order):
        members: list[str] = []
        _visit(start, reverse, seen, members)
        if len(members) > 1:
            sets.append(set(members))
    return sets


def _visit(start: str, graph: dict[str, set[str]], seen: set[str], order: list[str]) -> None:
    """Append the nodes reached from a start in the order in which they are left."""
    if start in seen:
        return
    seen.add(start)
    stack = [(start, iter(graph[start]))]
    while stack:
        node, targets = stack[-1]
        following = next((target for target in targets if target not in seen), None)
        if following is None:
            order.append(node)
            stack.pop()
        else:
            seen.add(following)
            stack.append((following, iter(graph[following])))
