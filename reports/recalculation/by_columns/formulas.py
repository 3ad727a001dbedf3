"""What is known of a formula wherever it stands: its tree, and the cells that it names."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from reports.recalculation.by_columns.syntax import (
    Binary,
    Call,
    Name,
    Node,
    Range,
    Ref,
    Token,
    Unary,
    parse,
    pattern,
)


@dataclass(frozen=True, eq=False)
class Formula:
    """A formula with its cells as distances; books of a class share it."""

    pattern: tuple[Token, ...]

    @cached_property
    def tree(self) -> Node:
        """The tree.

        Raises:
            UnknownFormula: no formula of the language.
        """
        return parse(self.pattern)

    @cached_property
    def at_once(self) -> bool:
        """Whether all rows of a run can be taken at once: no range that grows or slides."""
        return _fits(self.tree)

    @cached_property
    def references(self) -> tuple[Ref | Range | Name, ...]:
        """Cells, ranges and names in the formula.

        Raises:
            UnknownFormula: no formula of the language.
        """
        found: list[Ref | Range | Name] = []
        stack: list[Node] = [self.tree]
        while stack:
            node = stack.pop()
            match node:
                case Ref() | Range() | Name():
                    found.append(node)
                case Unary(_, operand):
                    stack.append(operand)
                case Binary(_, left, right):
                    stack += [left, right]
                case Call(_, args):
                    stack += args
                case _:
                    pass
        return tuple(found)


def formula_at(text: str, row: int, column: int) -> Formula:
    """The formula of a cell.

    Raises:
        UnknownFormula: a sign outside the language, or a formula that is too long.
    """
    return _shared(pattern(text, row, column))


@lru_cache(maxsize=20_000)
def _shared(tokens: tuple[Token, ...]) -> Formula:
    return Formula(tokens)


def _fits(node: Node) -> bool:
    match node:
        case Range(first, last):
            return first.row_fixed == last.row_fixed and (first.row_fixed or first.row == last.row)
        case Unary(_, operand):
            return _fits(operand)
        case Binary(_, left, right):
            return _fits(left) and _fits(right)
        case Call(_, args):
            return all(_fits(arg) for arg in args)
    return True
