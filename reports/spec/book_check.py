"""What only the whole model shows of a book: names nobody knows, formulas that need themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from reports.formula.parse import names
from reports.spec.blocks import Model
from reports.spec.book_text import BookError, BookLine, Shelf, at_fragment
from reports.spec.graph import graph_of, node_of


def book_faults(model: Model, places: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """Mistakes in the formulas of books; ``places`` are the lines of their nodes."""
    known = model.nodes.keys() | model.fields.keys() | model.grid_runs.keys()
    known |= model.input_runs.keys()
    for key, line in places.items():
        node = model.nodes.get(key)
        if node is None or node.expr is None:
            continue
        table = key.partition(".")[0] if "." in key else ""
        for name in sorted(names(node.expr)):
            if node_of(name, table, model) not in known:
                hint = "назовите величину книги, исходное или столбец таблицы"
                yield at_fragment(line, shelf, f"имя «{name}» неизвестно", hint, name)
    yield from _circles(model, places, shelf)


def _circles(model: Model, places: Mapping[str, BookLine], shelf: Shelf) -> Iterator[BookError]:
    """Nodes whose formulas lead back to them, but for rows that follow from rows before."""
    graph, whole = graph_of(model), model.whole_tables
    for key, line in places.items():
        if key in model.nodes and key not in whole and key in graph.ancestors(key):
            short = key.rpartition(".")[2]
            yield at_fragment(line, shelf, f"«{short}» считается через себя",
                              "разорвите круг формул", short)  # fmt: skip
