"""Blocks of a book against those of the Python that it replaces, on every sample and layout."""

from __future__ import annotations

import importlib
import sys
import time
from dataclasses import replace
from pathlib import Path

from reports.inputs.load import load_toml
from reports.spec.blocks import Grid, TableSpec
from reports.spec.parts import Scope, joined
from reports.tables import contexts


import ast, functools


@functools.cache
def bare(e):
    return None if e is None else ast.unparse(ast.parse(e.strip(), mode="eval"))


def named(n):
    return None if n is None else replace(n, of=n.of or n.key, expr=bare(n.expr))


def normal(b):
    if isinstance(b, Grid):
        rows = tuple(
            replace(
                r,
                cells=tuple(
                    None if c is None else replace(c, of=r.of, expr=bare(c.expr)) for c in r.cells
                ),
            )
            for r in b.rows
        )
        return replace(b, rows=rows, note=b.note.strip())
    if isinstance(b, TableSpec):
        return replace(
            b,
            columns=tuple(map(named, b.columns)),
            step=None if b.step is None else float(b.step),
            computed=b.computed is not None,
        )
    return replace(b, scalars=tuple(map(named, b.scalars)))


def show(a, b, path=""):
    if a == b:
        return
    if type(a) is not type(b):
        print("   ", path, ":", repr(a)[:300], "->", repr(b)[:300])
        return
    if hasattr(a, "__dataclass_fields__"):
        for f in a.__dataclass_fields__:
            show(getattr(a, f), getattr(b, f), f"{path}.{f}")
    elif isinstance(a, tuple):
        if len(a) != len(b):
            ka = [getattr(x, "key", getattr(x, "id", getattr(x, "of", x))) for x in a]
            kb = [getattr(x, "key", getattr(x, "id", getattr(x, "of", x))) for x in b]
            print(
                "   ",
                path,
                "length",
                len(a),
                len(b),
                [k for k in ka if k not in kb],
                [k for k in kb if k not in ka],
            )
        for i, (x, y) in enumerate(zip(a, b)):
            show(x, y, f"{path}[{getattr(x, 'key', getattr(x, 'id', i))}]")
    else:
        print("   ", path, ":\n      py  ", repr(a)[:400], "\n      book", repr(b)[:400])


def main(book, *functions):
    parts = []
    for f in functions:
        module, _, name = f.rpartition(".")
        parts.append(getattr(importlib.import_module("reports.tables." + module), name))
    root = Path(__file__).resolve().parents[1]
    sys.path.insert(0, str(root))
    from tests import layouts

    files = [
        (p.name, load_toml(p).model)
        for p in [
            *sorted((root / "samples").glob("*.toml")),
            *sorted((root / "samples/class").glob("base.toml")),
            *sorted(Path("/tmp/house-cases").glob("*.toml")),
        ]
    ]
    files += [(name, layouts.made(name)) for name in layouts.MAKERS]
    equal = 0
    spent = 0.0
    for name, model in files:
        scope = Scope(model)
        py = joined(scope, tuple(parts))
        t = time.perf_counter()
        new = contexts.book_part(book, scope)
        spent += time.perf_counter() - t
        a = (tuple(map(normal, py.blocks)), py.charts)
        b = (tuple(map(normal, new.blocks)), new.charts)
        if a == b:
            equal += 1
        else:
            print(name)
            ia = [x.id for x in py.blocks]
            ib = [x.id for x in new.blocks]
            if ia != ib:
                print("   blocks", ia, ib)
            ca = [x.id for x in py.charts]
            cb = [x.id for x in new.charts]
            if ca != cb:
                print("   charts", ca, cb)
            A = {x.id: x for x in a[0]}
            B = {x.id: x for x in b[0]}
            for k in A:
                if k in B:
                    show(A[k], B[k], k)
            A = {x.id: x for x in a[1]}
            B = {x.id: x for x in b[1]}
            for k in A:
                if k in B:
                    show(A[k], B[k], k)
    print(f"{book}: {equal} of {len(files)} equal; {1000 * spent / len(files):.1f} ms each")
    sys.exit(equal != len(files))


main(*sys.argv[1:])
