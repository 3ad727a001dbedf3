"""Page layout of a chapter: figures and small tables float, text goes on.

Of the orders that keep figures and tables each in their own order the one is taken that costs
least: blank feet of pages, figures reduced or far from their text or in the next section, and
the risk that an estimate was wrong.  The search keeps the best few layouts after each block.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, NamedTuple

Kind = Literal["chapter", "heading", "text", "tied", "float", "table", "other"]

_HEADING = re.compile(r"<h[1-3]")
_LINKS, _IDS = re.compile(r'href="#([^"]+)"'), re.compile(r'\bid="([^"]+)"')
WIDTH = re.compile(r'<(?:svg|img) class="fig"[^>]*?style="width:([\d.]+)mm')
_TOGETHER = 3  # rows of a table that stand together at its beginning and at its end
_DIVIDED = 4  # lines of the least paragraph that is divided
_LAYOUTS = 24  # that are followed
# What a layout costs: the square of the share of a page that stays blank, and beside it
_TOO_BLANK = 0.25  # the share from which a page looks like the end of a chapter
_HOLE = 4.0  # for each page's height of the blank beyond it
_FAR = 0.0006  # for each block that a figure lets pass
_NEXT = 0.015  # for each figure that lets a heading pass
_LATE = 1.0  # for each page between a figure and the one after that of its first mention
_LATE_TABLE = 0.3  # the same for a table, which may stand a page farther
_OVERDUE = 2  # pages late, from which a block waits only if nothing else is left
_SMALLER = 0.2  # for the square of the share that a figure loses
_WRONG = 0.1  # the chance that what is left is less by a line than estimated
_PAGE = 0.1  # for each page, where a chapter could end one earlier
_FEW = 0.5  # of a page: the last one of a chapter that has less is worth another search
_SHARED = 2  # blocks after a figure for whose sake it is reduced
_SPARE = 2.0  # px left below a figure that was reduced


class Spot(NamedTuple):
    """Where on a page the last block ends and the margin that it asks for below [px].

    ``page`` counts the pages of the body from one; ``cost`` is that of all before.
    """

    used: float
    margin: float = 0.0
    page: int = 1
    cost: float = 0.0


@dataclass(frozen=True, slots=True)
class Block:
    """A block of the text and its estimated height without margins [px].

    ``tied`` blocks continue what stands before them, a formula or a line of its sentence.
    """

    html: str
    kind: Kind
    height: float
    above: float = 0.0  # margins; the larger of two that meet is kept
    below: float = 0.0
    figure: float = 0.0  # of it the picture, which may be reduced
    least: float = 0.7  # part to which the picture may be reduced to fit the foot of a page
    head: float = 0.0  # of it what a table repeats on each page that it goes on to
    rows: tuple[float, ...] = ()
    line: float = 0.0  # of a paragraph
    tail: float = 0.0  # of what follows and must stand on the same page
    names: tuple[str, ...] = ()  # figures first mentioned here; of a figure its own name


class _Layout(NamedTuple):
    """Blocks placed so far, the last one first, and those that wait."""

    spot: Spot
    waiting: tuple[Block, ...] = ()
    placed: tuple[str, Any] | None = None
    mentions: tuple[tuple[str, int], ...] = ()  # figures to come and the pages that name them

    def then(self, html: str, spot: Spot, waiting: tuple[Block, ...]) -> _Layout:
        return _Layout(spot, waiting, (html, self.placed), self.mentions)

    def late(self, block: Block, page: int) -> float:
        """Cost of a figure beyond the page after its first mention, of a table beyond two."""
        return (_LATE if block.figure else _LATE_TABLE) * self._pages_late(block, page)

    def is_overdue(self) -> bool:
        """Whether a block waits on longer than any blank foot of a page is worth."""
        return any(self._pages_late(block, self.spot.page) >= _OVERDUE for block in self.waiting)

    def _pages_late(self, block: Block, page: int) -> int:
        named = (at for name, at in self.mentions if name in block.names)
        return max(0, page - (1 if block.figure else 2) - min(named, default=page))


def filled(blocks: Sequence[Block], spot: Spot, room: float, line: float) -> tuple[list[str], Spot]:
    """Return the blocks of one chapter in their new order, and where its last page ends.

    Args:
        blocks: They, in the order of the text.
        spot: Where the chapter begins.
        room: Height of a page [px].
        line: Height of a line of the text [px].
    """
    best = _search(blocks, spot, room, line, 0)
    if best.spot.page > spot.page and best.spot.used < _FEW * room:
        # Figures before may be smaller rather than one more page of a figure or a few lines.
        other = _search(blocks, spot, room, line, _SHARED)
        best = min(best, other, key=_cost)
    return _in_order(best), best.spot


def _search(
    blocks: Sequence[Block], spot: Spot, room: float, line: float, together: int
) -> _Layout:
    """Return the cheapest layout; figures may be reduced for so many blocks that follow them."""
    layouts = [_Layout(spot._replace(cost=0.0))]
    headed = True  # between a heading and its text stands no figure
    for block in _with_tails(list(_naming(blocks))):
        if block.kind not in ("tied", "other") and not headed:
            layouts = [way for layout in layouts for way in _ways(layout, room, line, together)]
        layouts = _best([_followed(layout, block, room) for layout in layouts])
        headed = block.kind in ("chapter", "heading") or (
            headed and block.kind in ("float", "table")
        )
    placed = (_all_placed(layout, room, line, together) for layout in layouts)
    return min(placed, key=_cost)


def _naming(blocks: Sequence[Block]) -> Iterator[Block]:
    """Yield the blocks with the figures and tables of the chapter that each is first to name."""
    own = [
        tuple(_IDS.findall(block.html)) if block.kind in ("float", "table") else ()
        for block in blocks
    ]
    coming = {name for names in own for name in names}
    for block, names in zip(blocks, own, strict=True):
        first = tuple(name for name in _LINKS.findall(block.html) if name in coming)
        coming.difference_update(first)
        yield replace(block, names=names or first)


def _with_tails(blocks: Sequence[Block]) -> list[Block]:
    """Return the last lines that lead to a formula stand with it, a heading with what follows."""
    kept: list[Block] = []
    after = Block("", "other", 0.0)
    for block in reversed(blocks):
        tailed = block
        if block.kind in ("heading", "chapter"):
            tailed = replace(block, tail=max(block.below, after.above) + _beginning(after))
        elif _leads(block) and _is_formula(after):
            tailed = replace(block, html=_leading(block.html), tail=after.above + after.height)
        kept.append(tailed)
        after = after if block.kind == "float" else tailed
    return kept[::-1]


def _is_formula(block: Block) -> bool:
    return block.kind == "tied" and not block.line


def _leads(block: Block) -> bool:
    """Return a paragraph: a short one goes over whole, of a longer one its last two lines."""
    return block.html.startswith("<p") and block.line > 0


def _leading(html: str) -> str:
    looks = '<p class="'
    if html.startswith(looks):
        return html.replace(looks, f"{looks}lead ", 1)
    return html.replace("<p", f'{looks}lead"', 1)


def _beginning(block: Block) -> float:
    """Return the least of a block that stands together [px]."""
    if block.kind == "table":
        divides = len(block.rows) >= 2 * _TOGETHER
        return block.height - sum(block.rows[_TOGETHER:] if divides else ())
    whole = block.height < _DIVIDED * block.line or not block.line
    return block.height + block.tail if whole else 2 * block.line


def _ways(layout: _Layout, room: float, line: float, together: int) -> Iterator[_Layout]:
    """Yield some, none or all of the waiting blocks placed here, each series in its order."""
    yield layout
    for number, block in enumerate(layout.waiting):
        if any(bool(block.figure) == bool(other.figure) for other in layout.waiting[:number]):
            continue
        waiting = layout.waiting[:number] + layout.waiting[number + 1 :]
        for html, put in _put(block, waiting[:together], layout.spot, room, line):
            spot = put._replace(cost=put.cost + layout.late(block, put.page))
            yield from _ways(layout.then(html, spot, waiting), room, line, together)


def _put(
    block: Block, others: Sequence[Block], spot: Spot, room: float, line: float
) -> Iterator[tuple[str, Spot]]:
    """A floating block here: as it is, or smaller so that it fits, alone or with the next ones."""
    begin = spot.used + max(spot.margin, block.above)
    spare = room - begin - block.height
    placed = after(block, spot, room)
    is_close = spot.used and block.kind == "float" and 0 <= spare < line
    risk = _WRONG * _blank(spot.used, room) if is_close else 0.0
    yield block.html, placed._replace(cost=placed.cost + risk)
    margin, figures = block.below, block.figure
    for other in (None, *others) if figures else ():
        if other is not None:
            spare -= max(margin, other.above) + other.height
            margin, figures = other.below, figures + other.figure
        lost = (_SPARE - spare) / figures if spot.used or other else 1.0
        if 0 < lost <= 1 - block.least:
            end = begin + block.height - lost * block.figure
            cost = spot.cost + _SMALLER * lost**2
            yield _reduced(block, 1 - lost), Spot(end, block.below, spot.page, cost)


def _followed(layout: _Layout, block: Block, room: float) -> _Layout:
    """Return the next block of the text, waiting if it floats."""
    spot, waiting, *_ = layout
    if block.kind == "float" or (waiting and block.kind == "table"):
        return layout._replace(waiting=(*waiting, block))
    passed = _NEXT if block.kind == "heading" else _FAR
    placed = after(block, spot, room)
    placed = placed._replace(cost=placed.cost + passed * len(waiting))
    then = layout.then(_paged(block, placed.page), placed, waiting)
    # A paragraph over the end of a page may name it in its first lines.
    page = spot.page if block.line and spot.used < room - block.line else placed.page
    return then._replace(mentions=then.mentions + tuple((name, page) for name in block.names))


def _best(layouts: Sequence[_Layout]) -> list[_Layout]:
    """Return the cheapest layouts, one for each place on the page and each set that waits."""
    cheapest: dict[tuple[object, ...], _Layout] = {}
    for layout in sorted(layouts, key=lambda each: (each.is_overdue(), each.spot.cost)):
        spot = layout.spot
        key = (spot.page, round(spot.used), tuple(map(id, layout.waiting)), layout.mentions[-2:])
        cheapest.setdefault(key, layout)
    return list(cheapest.values())[:_LAYOUTS]


def _cost(layout: _Layout) -> float:
    return layout.spot.cost + _PAGE * layout.spot.page


def _all_placed(layout: _Layout, room: float, line: float, together: int) -> _Layout:
    """Return the cheapest way to place all that waits."""
    ways = (way for way in _ways(layout, room, line, together) if not way.waiting)
    return min(ways, key=_cost)


def _in_order(layout: _Layout) -> list[str]:
    out: list[str] = []
    placed = layout.placed
    while placed is not None:
        html, placed = placed
        out.append(html)
    return out[::-1]


def after(block: Block, spot: Spot, room: float) -> Spot:
    """Where a block ends on its last page, and what the pages left behind cost."""
    begin = spot.used + max(spot.margin, block.above)
    total = begin + block.height
    if total + block.tail <= room:
        return Spot(total, block.below, spot.page, spot.cost)
    divides = block.kind in ("text", "table") or block.line > 0
    end, pages, whole = _over(block, begin, room) if divides else (0.0, 1, True)
    if not divides:
        end = min(block.above + block.height, room)
    cost = spot.cost + (_blank(spot.used, room) if whole else 0.0)
    return Spot(end, block.below, spot.page + pages, cost)


def _blank(used: float, room: float) -> float:
    """Cost of a page that ends here."""
    share = 1 - used / room
    return share**2 + _HOLE * max(0.0, share - _TOO_BLANK)


def _over(block: Block, begin: float, room: float) -> tuple[float, int, bool]:
    """Return a block that goes on over the page's end: its height on its last page, further pages.

    Also whether nothing of it stands on the page where it was to begin.
    """
    if block.kind == "table":
        whole = begin + _beginning(block) > room
        end, pages = block.height - sum(block.rows) + (block.above if whole else begin), int(whole)
        for number, row in enumerate(block.rows):
            if end + row > room:
                first = max(0, min(number, len(block.rows) - _TOGETHER))
                end, pages = block.head + sum(block.rows[first:number]), pages + 1
            end += row
        return end, pages, whole
    over, whole = begin + block.height - room, True
    if block.line:  # no line of a paragraph stands alone
        free = int((room - begin) / block.line)
        lines = round(block.height / block.line)
        free = 0 if free < 2 or lines < _DIVIDED else min(free, lines - 2)
        over, whole = (lines - free) * block.line, free == 0
    return over % room, 1 + int(over // room), whole


def _reduced(block: Block, share: float) -> str:
    """Return the figure smaller."""

    def smaller(match: re.Match[str]) -> str:
        width = float(match[1])
        head = match.group()[: match.start(1) - match.start()]
        return f"{head}{width * share:.1f}mm"

    return WIDTH.sub(smaller, block.html, count=1)


def _paged(block: Block, page: int) -> str:
    """Write the estimated page into a heading, for contents not yet updated."""
    heading = block.kind in ("chapter", "heading")
    return (
        _HEADING.sub(rf'\g<0> data-page="{page}"', block.html, count=1) if heading else block.html
    )
