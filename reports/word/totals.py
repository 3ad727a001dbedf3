"""How many figures, tables and sources there are, as fields that count them.

The last number of a sequence gets a bookmark; the count is a reference to it, or the sum of
several where tables of the appendices have sequences of their own.
"""

from __future__ import annotations

from copy import deepcopy

from reports.word.markup import SEQUENCES, Bookmarks, Element, W, field

MARK = "{kshm}count"  # on a run that shows how many there are: their kind
_INSTRUCTION = f"{{{W}}}instrText"
_KIND = f"{{{W}}}fldCharType"


def count(body: Element, bookmarks: Bookmarks) -> None:
    """Put fields in place of the marked runs; one that would count wrongly stays a number."""
    last: dict[str, tuple[str, Element, Element]] = {}  # name: number shown, first and last run
    for words in body.iter(_INSTRUCTION):
        parts = (words.text or "").split()
        if parts[0] == "SEQ":
            runs = _runs(words)
            shown = "".join(map(_text, runs))
            last[parts[1]] = (shown, runs[0], runs[-1])
    for run in [run for run in body.iter(f"{{{W}}}r") if run.get(MARK)]:
        short, shown = run.attrib.pop(MARK), _text(run)
        kind = SEQUENCES[short]
        found = [name for name in last if name == kind or name.startswith(f"{kind}_")]
        if not found or sum(int(last[name][0]) for name in found) != int(shown):
            continue
        names = [f"last_{short}{index}" for index in range(len(found))]
        for mark, name in zip(names, found, strict=True):
            _, first, end = last[name]
            start, stop = bookmarks.around(mark, [])
            first.addprevious(start)
            end.addnext(stop)
        # A formula takes the numbers in bookmarks by their names.
        counted = f"REF {names[0]} \\h" if len(names) == 1 else f"= {' + '.join(names)}"
        begin, words, separate, _, stop = field(counted, "")
        for element in (begin, words, separate, deepcopy(run), stop):
            run.addprevious(element)
        run.getparent().remove(run)


def _text(run: Element) -> str:
    return "".join(text.text or "" for text in run.iter(f"{{{W}}}t"))


def _runs(words: Element) -> list[Element]:
    """The runs of a field from its beginning to its end."""
    parent = words.getparent()
    begin = parent.getprevious()
    runs = [begin]
    while not any(c.get(_KIND) == "end" for c in runs[-1]):
        runs.append(runs[-1].getnext())
    return runs
