"""A whole model as functions of JavaScript and the order in which they are called."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from reports.formula.javascript import LIBRARY, Script, columns_script, gives_text, value_script
from reports.formula.parse import names
from reports.model.blocks import Column, Model, TableSpec
from reports.model.evaluation import Evaluation, Graph, node_of

CALCULATOR = Path(__file__).parents[1] / "web" / "static" / "calculator.js"
Step = list[Any]  # function, rows (0 of a value), numbers of what it gives, of what it takes


@dataclass(frozen=True)
class LiveProgram:
    """What a page calculates.

    Attributes:
        functions: texts of the functions, each once.
        keys: what values are called; their numbers are the places in this list.
        values: those that stand at the start: inputs, angles, what is calculated at build.
        runs: values that are put side by side, by key.
        steps: calls in their order.
        fixed: keys whose values only the program knows.
    """

    functions: tuple[str, ...]
    keys: tuple[str, ...]
    values: dict[str, Any]
    runs: dict[str, tuple[str, ...]]
    steps: tuple[Step, ...]
    fixed: frozenset[str]

    def script(self) -> str:
        """Return the functions as a module of JavaScript that stands alone."""
        body = ",\n".join(self.functions)
        return f"{LIBRARY.read_text('utf-8')}\nexport const functions = [\n{body}];\n"

    def data(self) -> dict[str, Any]:
        """Return the rest as plain data."""
        number = {key: i for i, key in enumerate(self.keys)}
        return {
            "keys": self.keys, "steps": self.steps,
            "values": [[number[key], value] for key, value in self.values.items()],
            "runs": [[number[key], [number[each] for each in cells]]
                     for key, cells in self.runs.items()],
            "fixed": sorted(number[key] for key in self.fixed if key in number),
        }  # fmt: skip

    @cached_property
    def inputs_read(self) -> frozenset[str]:
        """Values that the steps read and no step gives."""
        cells = {self.keys[i] for step in self.steps for i in step[3]}
        cells |= {each for key in cells & self.runs.keys() for each in self.runs[key]}
        return frozenset(cells & self.values.keys())

    @cached_property
    def size(self) -> int:
        """Letters of the functions and the data."""
        return len(self.script()) + len(json.dumps(self.data(), ensure_ascii=False))


def built_values(model: Model) -> dict[str, Any]:
    """Return by their keys the values that no formula gives."""
    compiler = _Compiler(model)
    value = compiler.evaluation.value
    return {key: np.asarray(value(key)).tolist() for key in compiler.fixed}


def program_of(model: Model, nodes: Iterable[str]) -> LiveProgram:
    """Compile what gives the wanted nodes.

    Raises:
        FormulaError: a formula that has no meaning in JavaScript.
    """
    return _Compiler(model).compiled(nodes)


@dataclass
class _Compiler:
    """One model on its way to a program."""

    model: Model
    functions: dict[str, int] = field(default_factory=dict)
    numbers: dict[str, int] = field(default_factory=dict)
    values: dict[str, Any] = field(default_factory=dict)
    runs: dict[str, tuple[str, ...]] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)

    @cached_property
    def evaluation(self) -> Evaluation:
        return Evaluation(self.model)

    @cached_property
    def fixed(self) -> frozenset[str]:
        """What is calculated at build, and all that follows from it."""
        graph, readers = Graph(self.model), defaultdict[str, list[str]](list)
        for key in self.model.nodes:
            for each in graph.references(key):
                readers[each].append(key)
        waiting = [f"{table.id}.{column.key}" for table in self.model.tables.values()
                   for column in table.columns if table.is_computed(column)]  # fmt: skip
        fixed: set[str] = set()
        while waiting:
            key = waiting.pop()
            if key not in fixed:
                fixed.add(key)
                waiting += readers[key]
        return frozenset(fixed & self.model.nodes.keys())

    def compiled(self, nodes: Iterable[str]) -> LiveProgram:
        """Return the program that gives these nodes."""
        for name in self.model.fields:
            self._start(name, self.evaluation.inputs[name])
        for key in nodes:
            self._need(key)
        return LiveProgram(
            tuple(self.functions), tuple(self.numbers), self.values, self.runs,
            tuple(self.steps), self.fixed,
        )  # fmt: skip

    def _number(self, key: str) -> int:
        return self.numbers.setdefault(key, len(self.numbers))

    def _start(self, key: str, value: Any) -> None:  # noqa: ANN401
        self._number(key)
        self.values[key] = np.asarray(value).tolist()

    def _need(self, key: str) -> None:
        """Append the steps of a node after those of its references, without deep recursion."""
        waiting = [key]
        while waiting:
            top = waiting[-1]
            if top in self.numbers:
                waiting.pop()
                continue
            first = [name for name in self._references(top) if name not in self.numbers]
            if first:
                waiting += first
                continue
            waiting.pop()
            self._take(top)

    def _references(self, key: str) -> Iterator[str]:
        """Yield what must stand before a node."""
        runs = self._run(key)
        if runs is not None:
            yield from runs
        elif key not in self.fixed:
            columns = {f"{key.split('.', 1)[0]}.{column.key}" for column in self._together(key)}
            for each in columns or {key}:
                node = self.model.nodes[each]
                table = each.split(".", 1)[0] if "." in each else ""
                names_read = names(node.expr) if node.expr is not None else ()
                yield from (name for name in (node_of(n, table, self.model) for n in names_read)
                            if name not in columns)  # fmt: skip

    def _run(self, key: str) -> tuple[str, ...] | None:
        return self.model.grid_runs.get(key) or self.model.input_runs.get(key)

    def _together(self, key: str) -> tuple[Column, ...]:
        """Columns of a table calculated row by row as a whole; empty for others."""
        table = self.model.whole_tables.get(key)
        return () if table is None or table.computed is not None else table.columns

    def _take(self, key: str) -> None:
        """Append the step of a node whose references are compiled."""
        cells = self._run(key)
        if cells is not None:
            self._number(key)
            self.runs[key] = cells
        elif key in self.fixed:
            self._start(key, self.evaluation.value(key))
        elif self._together(key):
            self._columns(self.model.whole_tables[key], self._together(key))
        elif "." not in key:
            node = self.model.nodes[key]
            script = value_script(node.expr or "", lambda name: name)
            self._step(script, 0, [key])
        else:
            table = self.model.tables[key.split(".", 1)[0]]
            column = next(each for each in table.columns if f"{table.id}.{each.key}" == key)
            self._columns(table, (column,))

    def _columns(self, table: TableSpec, columns: tuple[Column, ...]) -> None:
        """Columns of a table; those of angles stand at the start."""
        angles = [each for each in columns if each.expr is None]
        for each in angles:
            self._start(f"{table.id}.{each.key}", table.rows)
        calculated = [each for each in columns if each.expr is not None]
        if not calculated:
            return
        keys = [f"{table.id}.{each.key}" for each in calculated]
        script = columns_script(
            [each.expr or "" for each in calculated], keys,
            lambda name: node_of(name, table.id, self.model), self._is_column,
        )  # fmt: skip
        is_text = any(gives_text(each.expr or "") for each in calculated)
        self._step(script, len(table.rows), keys, is_text=is_text)

    def _is_column(self, key: str) -> bool:
        return "." in key and key in self.model.nodes

    def _step(self, script: Script, rows: int, keys: list[str], *, is_text: bool = False) -> None:
        function = self.functions.setdefault(script.text, len(self.functions))
        gives = [self._number(key) for key in keys]
        takes = [self._number(key) for key in script.names]
        self.steps.append([function, -rows if is_text else rows, gives, takes])
