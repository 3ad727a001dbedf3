"""Classes of other engines and chapters, filled in by hand-written formulas: what must be said.

The names in braces are the cells of a value in the row of the formula; ``<`` before the name
is the row above, ``^`` the first row, ``|`` the whole column; ``{row}`` is the row itself,
``{n}`` the speed of the variant.  Everything else is the solved book's.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import pytest
import tomlkit
from openpyxl import Workbook
from openpyxl.utils import get_column_letter

from reports.grading.issuing import handout
from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.issue import assignment_for, issue
from reports.grading.issuing.register import Register
from reports.grading.judging.marking import Marker
from reports.grading.reading.submissions import Submission
from reports.inputs.fields import to_mapping
from reports.model.evaluation import evaluate_model
from reports.workbook.layout import Layout
from tests.conftest import sample
from tests.grading.classroom import roster_text
from tests.grading.fill import Formula, filled_book

_NAME = re.compile(r"\{([<^|]?)([\w.]+)\}")


@dataclass(frozen=True)
class Base:
    """A class of one on an engine: honest formulas, mistakes, cheats."""

    sample: str
    variants: Mapping[str, object]
    fill: tuple[str, ...]
    honest: Mapping[str, str]
    mistakes: Mapping[str, tuple[str, str | None]]  # words of the cause, None for none
    cheats: Mapping[str, str] = field(default_factory=dict)  # ``{v}`` is the right number
    pasted: Mapping[str, str] = field(default_factory=dict)  # ``{p}`` its cell on another sheet

    @cached_property
    def _issued(self) -> tuple[Register, Path, Marker]:
        raw = to_mapping(sample(self.sample))
        raw["calculation"]["step_deg"] = 30
        raw["variants"] = self.variants
        folder = Path(mkdtemp(prefix="kshm-base-"))
        (folder / "base.toml").write_text(tomlkit.dumps(raw), encoding="utf-8")
        (folder / "group.csv").write_text(roster_text(1), encoding="utf-8")
        rubric = tomlkit.dumps({"work": {"fill": list(self.fill)}})
        (folder / "rubric.toml").write_text(rubric, encoding="utf-8")
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(handout, "_charts", lambda assignment: ())  # most of the time
            built = issue(folder / "base.toml", folder / "group.csv", folder / "issued", seed=3,
                         rubric_file=folder / "rubric.toml",
                         secret_file=folder / "key")  # fmt: skip
        return built.register, folder, Marker(built.register)

    @cached_property
    def assignment(self) -> Assignment:
        """What the first student is asked."""
        register = self._issued[0]
        return assignment_for(register.books[0], register.rubric)

    @cached_property
    def _layout(self) -> Layout:
        return Layout.of(self.assignment.model)

    def marks(
        self, texts: Mapping[str, str], pasted: Mapping[str, str] | None = None
    ) -> dict[str, dict[str, Any]]:
        """Lines of the feedback by node where some nodes are filled in otherwise."""
        values = evaluate_model(self.assignment.model)

        def numbers(node: str) -> list[float | str]:
            table, _, key = node.partition(".")
            actual = values.columns[table][key] if key else [values.scalars[node]]
            return [v if isinstance(v, str) else float(v) for v in actual]

        changes: dict[str, list[Formula]] = {}
        for node, text in texts.items():
            right = numbers(node)
            changes[node] = [self._placed(text, node, i).replace("{v}", repr(right[i]))
                             for i in range(len(right))]  # fmt: skip
        copied = dict(pasted or {})
        for node, text in copied.items():
            letter = "ABCDEFG"[list(copied).index(node)]
            changes[node] = [
                self._placed(text, node, i).replace("{p}", f"Числа!{letter}{i + 1}")
                for i in range(len(numbers(node)))
            ]

        def edit(opened: Workbook, _: Layout) -> None:
            sheet = opened.create_sheet("Числа")
            for column, node in enumerate(copied, 1):
                for row, value in enumerate(numbers(node), 1):
                    sheet.cell(row, column).value = value

        return self.marked(changes, edit if copied else None)

    def marked(
        self,
        changes: Mapping[str, list[Formula]],
        edit: Callable[[Workbook, Layout], None] | None = None,
    ) -> dict[str, dict[str, Any]]:
        """Lines of the feedback by node where some nodes have these cells."""
        register, folder, marker = self._issued
        book = register.books[0]
        empty = (folder / "issued" / book.folder / book.file).read_bytes()
        data = filled_book(empty, self.assignment, changes, edit)
        result = marker.mark(Submission("р.xlsx", Path("р.xlsx"), None, None), data)
        assert result["status"] == "graded", result
        items = {node: item.id for item in self.assignment.items for node in item.nodes}
        lines = {line["id"]: line for line in result["items"]}
        return {node: lines[id_] for node, id_ in items.items()}

    def _placed(self, text: str, node: str, index: int) -> str:
        sheet = self._at(node, index)[0]

        def address(match: re.Match[str]) -> str:
            way, name = match.groups()
            if name in ("v", "p"):
                return match[0]
            if name == "row":
                return str(self._at(node, index)[2])
            if name == "n":
                return str(self._issued[0].books[0].drawn["regime.speed_rpm"])
            title, letters, row = self._at(name, index - (way == "<"))
            prefix = "" if title == sheet else f"'{title}'!"
            if way in ("|", "^"):
                rows = self._layout.rows_of(self._layout.columns[name][0])
                last = f":${letters}${rows[-1]}" if way == "|" else ""
                return f"{prefix}${letters}${rows[0]}{last}"
            return f"{prefix}{letters}{row}"

        return _NAME.sub(address, text)

    def _at(self, name: str, index: int) -> tuple[str, str, int]:
        layout = self._layout
        if name in layout.columns:
            table, column = layout.columns[name]
            rows = layout.rows_of(table)
            row = rows[index] if 0 <= index < len(rows) else rows[0] - 1
            return table.sheet, get_column_letter(column), row
        cell = layout.cells[name]
        match = re.fullmatch(r"([A-Z]+)(\d+)", cell.coordinate)
        assert match is not None
        return cell.sheet, f"${match[1]}$", int(match[2])
