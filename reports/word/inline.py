"""Inline content: letters, indices, references, fields."""

from __future__ import annotations

import re
from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from reports.shared.russian import NBSP
from reports.word import omml
from reports.word.markup import SEQUENCES, Bookmarks, Element, W, bookmark_name, run
from reports.word.markup import field as word_field

if TYPE_CHECKING:
    from lxml.html import HtmlElement

COUNT_MARK = "{kshm}count"  # on a run that shows how many there are: their kind
_INSTRUCTION = f"{{{W}}}instrText"
_KIND = f"{{{W}}}fldCharType"
Looks = frozenset[str]
_TEXTS = (f"{{{W}}}t", f"{{{omml.NAMESPACE}}}t")
_BLANKS = re.compile("[ \t\r\n\f]+")
_FACES = {"i": "i", "em": "i", "b": "b", "strong": "b", "sub": "sub", "sup": "sup", "u": "u"}
# No-break spaces on a line to write on.
_INK = {"ink": 30, "ink wide": 70, "ink day": 6, "ink month": 18}
_NUMBER = re.compile(r"(?:([А-Я]|\d+)\.)?(\d+)")


def count_totals(body: Element, bookmarks: Bookmarks) -> None:
    """Replace marked runs by counting fields where the field gives the same number."""
    last: dict[str, tuple[str, Element, Element]] = {}  # name: number shown, first and last run
    for words in body.iter(_INSTRUCTION):
        parts = (words.text or "").split()
        if parts[0] == "SEQ":
            runs = _runs(words)
            text = "".join(map(_text, runs))
            last[parts[1]] = (text, runs[0], runs[-1])
    for mark in [mark for mark in body.iter(f"{{{W}}}r") if mark.get(COUNT_MARK)]:
        short, text = mark.attrib.pop(COUNT_MARK), _text(mark)
        kind = SEQUENCES[short]
        sequences = [name for name in last if name == kind or name.startswith(f"{kind}_")]
        if not sequences or sum(int(last[name][0]) for name in sequences) != int(text):
            continue
        names = [f"last_{short}{index}" for index in range(len(sequences))]
        for bookmark, name in zip(names, sequences, strict=True):
            _, first, end = last[name]
            start, stop = bookmarks.around(bookmark, [])
            first.addprevious(start)
            end.addnext(stop)
        # A formula takes the numbers in bookmarks by their names.
        counted = f"REF {names[0]} \\h" if len(names) == 1 else f"= {' + '.join(names)}"
        begin, words, separate, _, stop = word_field(counted, "")
        for element in (begin, words, separate, deepcopy(mark), stop):
            mark.addprevious(element)
        mark.getparent().remove(mark)


def _text(run: Element) -> str:
    return "".join(text.text or "" for text in run.iter(f"{{{W}}}t"))


def _runs(words: Element) -> list[Element]:
    """Return the runs of a field from its beginning to its end."""
    parent = words.getparent()
    begin = parent.getprevious()
    runs = [begin]
    while not any(c.get(_KIND) == "end" for c in runs[-1]):
        runs.append(runs[-1].getnext())
    return runs


@dataclass
class Lines:
    """Turns the content of a page's element into runs of one document."""

    bookmarks: Bookmarks = field(default_factory=Bookmarks)
    letters: set[str] = field(default_factory=set)  # of appendices, each a bookmark
    pages: int = 0  # of the whole file as estimated

    def runs(self, element: HtmlElement, looks: Looks = frozenset()) -> list[Element]:
        """Return the content of an element as runs, without blanks at its ends."""
        pieces = self._inside(element, looks)
        texts = [part for piece in pieces for part in piece.iter(*_TEXTS)]
        if texts:
            texts[0].text = (texts[0].text or "").lstrip(" ")
            texts[-1].text = (texts[-1].text or "").rstrip(" ")
        return pieces

    def _inside(self, element: HtmlElement, looks: Looks) -> list[Element]:
        pieces = self._text(element.text, looks)
        for child in element:
            pieces += self._child(child, looks)
            pieces += self._text(child.tail, looks)
        return pieces

    @staticmethod
    def _text(text: str | None, looks: Looks) -> list[Element]:
        words = _BLANKS.sub(" ", text or "")
        return [run(words, looks)] if words else []

    def _child(self, child: HtmlElement, looks: Looks) -> list[Element]:
        if not isinstance(child.tag, str):  # a comment
            return []
        name = child.get("class", "")
        target = child.get("href", "")
        if child.tag == "br":
            return [run("\n")]
        if child.tag == "a" and target == "#report-end":
            return word_field("NUMPAGES", str(self.pages or ""), looks)
        if child.tag == "a" and target.startswith("#"):
            words = "".join(child.itertext())
            text = words.lstrip(f" {NBSP}")  # the page moves a blank before a link into it
            lead = self._text(words[: len(words) - len(text)], looks)
            return [*lead, *word_field(f"REF {bookmark_name(target[1:])} \\h", text, looks)]
        if child.tag == "img":
            return []
        if child.get("data-tex"):
            return [omml.omath(child.get("data-tex", ""))]
        if child.tag in _FACES:
            face = _FACES[child.tag]
            lower = looks - {"sub", "sup"} if face in ("sub", "sup") else looks
            return self._inside(child, lower | {face})
        return self._span(child, name, looks)

    def _span(self, child: HtmlElement, name: str, looks: Looks) -> list[Element]:
        if name in _INK:
            return [run(NBSP * _INK[name], looks | {"u"})]
        if name == "num":
            return self.number(child, looks)
        if name == "sheet-no":
            return word_field("PAGE", "1", looks)
        if name == "sheets":
            return word_field("NUMPAGES", str(self.pages or 1), looks)
        if name == "count":
            pieces = self._inside(child, looks)
            pieces[0].set(COUNT_MARK, child.get("data-kind", ""))
            return pieces
        if name == "bar":
            return [omml.barred("".join(child.itertext()))]
        if name == "g":
            return [*self._inside(child, looks), run("\t")]
        return self._inside(child, looks | {"u"} if name == "said" else looks)

    def number(self, element: HtmlElement, looks: Looks) -> list[Element]:
        """Return the number of a thing as a field, within the bookmark that references show."""
        anchor = next((a.get("id") for a in element.iterancestors() if a.get("id")), "")
        number_text = (element.text or "").strip()
        kind = SEQUENCES.get(anchor.partition("-")[0])
        match = _NUMBER.fullmatch(number_text)
        if kind is None or match is None:
            return [run(number_text, looks)]
        return self.bookmarks.around(bookmark_name(anchor), self._counted(kind, match, looks))

    def _counted(self, kind: str, match: re.Match[str], looks: Looks) -> Sequence[Element]:
        """Return a number within the report, a chapter or an appendix."""
        first, last = match[1], match[2]
        if first is None:
            return word_field(f"SEQ {kind} \\* ARABIC", last, looks)
        if first in self.letters:
            lead = word_field(f"REF {letter_name(first)} \\h", first, looks)
            sequence = f"SEQ {kind}_{first} \\* ARABIC"
        else:
            lead = word_field("STYLEREF 1 \\s", first, looks)
            sequence = f"SEQ {kind} \\* ARABIC \\s 1"
        return [*lead, run(".", looks), *word_field(sequence, last, looks)]


def letter_name(letter: str) -> str:
    """Name of the bookmark around an appendix's letter."""
    return f"app_{ord(letter):x}"
