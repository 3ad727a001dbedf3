"""Jinja2 for books of strangers: few words, few calls, and an end of work and of output.

Limits: steps of loops, calls, length of a text, time.  Nothing of Python's own objects is seen
but what a book's conditions need (`context`).
"""

from __future__ import annotations

import re
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, is_dataclass
from typing import Any, cast

import jinja2
from jinja2 import nodes
from jinja2.exceptions import SecurityError
from jinja2.runtime import LoopContext, Macro
from jinja2.sandbox import ImmutableSandboxedEnvironment

MAX_STEPS = 50_000
MAX_CALLS = 20_000
MAX_TEXT = 20_000
MAX_OUTPUT = 1_000_000
SECONDS = 5.0
_FILTERS = ("abs", "attr", "batch", "first", "int", "join", "last", "length", "list", "lower",
            "map", "max", "min", "reject", "rejectattr", "reverse", "round", "select",
            "selectattr", "string", "sum", "unique", "upper")  # fmt: skip
_TESTS = ("defined", "divisibleby", "even", "in", "none", "number", "odd", "string", "undefined",
          "eq", "ge", "gt", "le", "lt", "ne")  # fmt: skip
_OF_TEXT = ("replace", "startswith", "endswith", "split", "lower", "upper", "strip",
            "removeprefix", "removesuffix")  # fmt: skip
_WIDE = re.compile(r"%[-+ #0]*\d{3}|%[^a-zA-Z%]*\*|%[^a-zA-Z%]*\.\d{3}")
_STEP, _JOIN = "_step", "_join"


@dataclass
class Budget:
    """Work that a book may still do."""

    steps: int = MAX_STEPS
    calls: int = MAX_CALLS
    until: float = field(default_factory=lambda: time.process_time() + SECONDS)

    def step(self) -> None:
        """One step of a loop."""
        self.steps -= 1
        if self.steps < 0:
            raise SecurityError(f"шагов циклов больше {MAX_STEPS}")
        self.in_time()

    def call(self) -> None:
        """One call."""
        self.calls -= 1
        if self.calls < 0:
            raise SecurityError(f"вызовов больше {MAX_CALLS}")
        self.in_time()

    def in_time(self) -> None:
        """Refuse work beyond the time."""
        if time.process_time() > self.until:
            raise SecurityError(f"счёт дольше {SECONDS:g} с")


def bounded(text: str) -> str:
    """Return a text within its length."""
    if len(text) > MAX_TEXT:
        raise SecurityError(f"текст длиннее {MAX_TEXT} знаков")
    return text


class StrictEnvironment(ImmutableSandboxedEnvironment):
    """The environment of books that are not the house's."""

    intercepted_binops = frozenset({"*", "**", "%", "+"})

    def __init__(self, **options: Any) -> None:  # noqa: ANN401
        super().__init__(**options)
        self.budget = Budget()
        self.globals = {"range": self._range, _STEP: self._stepped, _JOIN: self._joined}
        self.filters = {name: self.filters[name] for name in _FILTERS}
        self.filters["replace"] = self._replaced
        self.tests = {name: self.tests[name] for name in _TESTS}

    # --- what Jinja2 asks --------------------------------------------------------------

    def compile(self, source: Any, *args: Any, **options: Any) -> Any:  # noqa: ANN401
        """Compile with a count of the steps of loops and of the length of joined texts."""
        if isinstance(source, str):
            name = args[0] if args else options.get("name")
            file = args[1] if len(args) > 1 else options.get("filename")
            source = _counted(self.parse(source, name, file)).set_environment(self)
        return super().compile(source, *args, **options)

    def is_safe_attribute(self, obj: Any, attr: str, value: Any) -> bool:  # noqa: ANN401
        """Whether a book may read an attribute: of what it is told of, and a few of texts."""
        if attr.startswith("_") or isinstance(value, type):
            return False
        if isinstance(obj, str):
            return attr in _OF_TEXT
        if isinstance(obj, LoopContext):
            return attr in ("index", "index0", "first", "last", "length", "previtem", "nextitem")
        if isinstance(obj, dict):
            return attr in ("items", "keys", "values", "get")
        if isinstance(obj, jinja2.runtime.TemplateReference) or type(obj).__name__ in (
            "Namespace", "TemplateModule",
        ):  # fmt: skip
            return True
        return is_dataclass(obj)

    def unsafe_undefined(self, obj: Any, attribute: str) -> Any:  # noqa: ANN401
        """Refuse at once, whatever would be made of the attribute."""
        raise SecurityError(f"«{attribute}» книге не видно")

    def call(self, context: Any, obj: Any, *args: Any, **named: Any) -> Any:  # noqa: ANN401
        """Call a function of the context, a macro or a method of a text."""
        self.budget.call()
        if isinstance(obj, type) or not callable(obj):
            raise SecurityError("вызывать это книге нельзя")
        owner = getattr(obj, "__self__", None)
        from_context = any(obj is each for each in context.parent.values())
        is_known = from_context or isinstance(obj, Macro) or owner is self
        if not (is_known or isinstance(owner, str | dict) or is_dataclass(owner)):
            raise SecurityError("вызывать это книге нельзя")
        if isinstance(owner, str) and obj.__name__ == "replace":
            return self._replaced(owner, *args)
        result = super().call(context, obj, *args, **named)
        return bounded(result) if isinstance(result, str) else result

    def call_binop(self, context: Any, operator: str, left: Any, right: Any) -> Any:  # noqa: ANN401
        """Arithmetic of numbers; texts may be joined and filled in."""
        if operator == "%" and isinstance(left, str):
            if _WIDE.search(left):
                raise SecurityError("ширина в формате больше двух знаков")
            return bounded(super().call_binop(context, operator, left, right))
        if operator == "*" and isinstance(left, str | list | tuple) and isinstance(right, int):
            if len(left) * right > MAX_TEXT:
                raise SecurityError(f"текст длиннее {MAX_TEXT} знаков")
            return super().call_binop(context, operator, left, right)
        if operator == "+" and isinstance(left, str | list | tuple):
            if len(left) + len(right) > MAX_TEXT:
                raise SecurityError(f"текст длиннее {MAX_TEXT} знаков")
            return super().call_binop(context, operator, left, right)
        numbers = isinstance(left, int | float) and isinstance(right, int | float)
        if not numbers or (operator == "**" and (abs(left) > 1e6 or abs(right) > 64)):
            raise SecurityError(f"действие {operator} книге запрещено с такими значениями")
        if max(abs(left), abs(right)) > 1e18:
            raise SecurityError("число больше 10¹⁸")
        return super().call_binop(context, operator, left, right)

    def get_template(self, name: Any, *args: Any, **options: Any) -> Any:  # noqa: ANN401
        """Return a template, whose use counts as a call."""
        self.budget.call()
        return super().get_template(name, *args, **options)

    # --- what counts -------------------------------------------------------------------

    def _stepped(self, values: Iterable[Any]) -> Iterator[Any]:
        for value in list(values):
            self.budget.step()
            yield value

    def _range(self, *bounds: int) -> range:
        numbers = range(*bounds)
        if len(numbers) > MAX_STEPS:
            raise SecurityError(f"шагов циклов больше {MAX_STEPS}")
        return numbers

    def _joined(self, *parts: object) -> str:
        return bounded("".join(map(str, parts)))

    def _replaced(self, text: object, old: object, new: object) -> str:
        whole, old, new = str(text), str(old), str(new)
        if not old:
            raise SecurityError("replace не знает, что заменить")
        if len(whole) + whole.count(old) * len(new) > 10 * MAX_TEXT:
            raise SecurityError(f"текст длиннее {10 * MAX_TEXT} знаков")
        return whole.replace(old, new)


def rendered(name: str, names: Any, environment: jinja2.Environment) -> str:  # noqa: ANN401
    """Return the text of a template; of a strict environment within its limits."""
    if not isinstance(environment, StrictEnvironment):
        return environment.get_template(name).render(names)
    environment.budget = Budget()
    parts, length = [], 0
    for part in environment.get_template(name).generate(names):
        length += len(part)
        if length > MAX_OUTPUT:
            raise SecurityError(f"вывод больше {MAX_OUTPUT // 1000} КБ")
        parts.append(part)
    return "".join(parts)


def _counted(tree: nodes.Template) -> nodes.Template:
    """Return the tree with counted loops and bounded joins; what no book needs is refused."""
    for kind in (nodes.Extends, nodes.Block, nodes.CallBlock, nodes.ScopedEvalContextModifier):
        for node in tree.find_all(kind):
            raise jinja2.TemplateSyntaxError(f"{kind.__name__.lower()} книге не нужно", node.lineno)
    for node in tree.find_all(nodes.For):
        node.iter = _call(_STEP, [cast(nodes.Expr, node.iter)], node.lineno)
        if node.recursive:
            raise jinja2.TemplateSyntaxError("recursive книге не нужно", node.lineno)
    _without_joins(tree)
    return tree


def _without_joins(node: nodes.Node) -> None:
    for name, value in node.iter_fields():
        if isinstance(value, list):
            parts = [_join(item) if isinstance(item, nodes.Concat) else item for item in value]
            setattr(node, name, parts)
        elif isinstance(value, nodes.Concat):
            setattr(node, name, _join(value))
    for child in node.iter_child_nodes():
        _without_joins(child)


def _join(node: nodes.Concat) -> nodes.Call:
    return _call(_JOIN, node.nodes, node.lineno)


def _call(name: str, args: list[nodes.Expr], line: int) -> nodes.Call:
    return nodes.Call(nodes.Name(name, "load", lineno=line), args, [], None, None, lineno=line)
