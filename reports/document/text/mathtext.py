r"""matplotlib's mathtext without its parser, which takes nine tenths of its time.

The library reads TeX by trying one rule after the other; its boxes are made by the rules'
actions.  Here the same actions are called by a reader that looks at one sign and knows the
rule; a formula with anything it does not know, or that goes wrong, is read by the library.
The actions and boxes are no public interface: ``tests/document/test_text_mathsvg.py`` compares
with the library's own reading, so another version that acts otherwise is noticed.
``./run bench document`` says what it gains.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from matplotlib import _mathtext
from matplotlib.font_manager import FontProperties
from matplotlib.ft2font import LoadFlags
from matplotlib.mathtext import MathTextParser, VectorParse
from pyparsing import ParseResults

from reports.shared.errors import TexError

lib: Any = _mathtext
_COMMAND = re.compile(r"\\(?:[A-Za-z]+|.)")
_SPACE = re.compile(r"\\hspace\s*\{\s*([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))\s*\}")
_GROUP = re.compile(r"\\math([a-z]+)\s*\{")
_SIGN = re.compile(r"[a-zA-Z0-9+\-*/<>=:,.;!?&@()\[\]|\x80-\U0001ffff]")
_ESCAPED = {"\\" + sign for sign in "%{}[]_|"}


def read(text: str, size: float) -> VectorParse:
    """Return a text with formulas between dollars, set in STIX.

    Args:
        text: the text.
        size: of the type [pt]; the result is in points.

    Raises:
        ValueError: the library does not understand a formula.
    """
    font = FontProperties(family="STIXGeneral", size=size, math_fontfamily="stix")
    try:
        fonts = lib.StixFonts(font, LoadFlags.NO_HINTING)
        placed = lib.ship(_GlyphReader(text, font, fonts).boxes())
        drawn: VectorParse = placed.to_vector()
        for kept_by_itself in (fonts, placed):  # and all boxes with them
            vars(kept_by_itself).clear()
    except Exception:  # the library says what is wrong, or sets it
        return MathTextParser("path").parse(text, dpi=72, prop=font)
    return drawn


class _GlyphReader(lib.Parser):  # type: ignore[misc]
    """The library's parser with another reading: one look at the next sign."""

    def __init__(self, text: str, font: FontProperties, fonts: Any) -> None:  # noqa: ANN401
        # Not the library's, which builds its grammar.
        self._state_stack = [lib.ParserState(fonts, "default", "rm", font.get_size(), 72)]
        self._em_width_cache: dict[Any, float] = {}
        self._needs_space_after_subsuper = False
        self._text = text
        self._s, self._at = "", 0

    def boxes(self) -> Any:  # noqa: ANN401
        """Return the whole text."""
        parts = self._text.split("$")
        if len(parts) % 2 == 0 or "\\$" in self._text or "'" in self._text:
            raise TexError
        boxes = []
        for number, part in enumerate(parts):
            if number % 2 == 0:
                boxes += self.non_math([part])
                continue
            self._s, self._at = part, 0
            nodes = self._tokens()
            if self._at < len(part) or not nodes:
                raise TexError
            boxes.append(lib.Hlist(nodes))
            self.pop_state()
        return lib.Hlist(boxes)

    def _next(self) -> str:
        """Return the next command or sign that is no space; empty at the end."""
        s = self._s
        while self._at < len(s) and s[self._at] == " ":
            self._at += 1
        if self._at == len(s):
            return ""
        if s[self._at] != "\\":
            return s[self._at]
        match = _COMMAND.match(s, self._at)
        if match is None:
            raise TexError
        return match.group()

    def _take(self, token: str) -> None:
        if self._next() != token:
            raise TexError
        self._at += len(token)

    def _tokens(self) -> list[Any]:
        """Nodes up to what closes them."""
        nodes: list[Any] = []
        while (token := self._next()) not in ("", "}", r"\right"):
            nodes.append(self._token(token))
        return nodes

    def _token(self, token: str) -> Any:  # noqa: ANN401
        """Return a space, or something with its indices."""
        if token in self._space_widths:
            self._at += len(token)
            return _one(self.space({"space": token}))
        if token == r"\hspace":
            match = _SPACE.match(self._s, self._at)
            if match is None:
                raise TexError
            self._at = match.end()
            return _one(self.customspace({"space": float(match[1])}))
        begin = self._at
        parts: dict[str, Any] = {} if token in "_^" else {"nucleus": self._placeable(token)}
        indices: list[Any] = []
        while (sign := self._next()) in ("_", "^"):
            self._at += 1
            if self._s[self._at : self._at + 1] == " ":  # the library would set the space
                raise TexError
            indices += [sign, self._placeable(self._next())]
        if indices:
            parts["subsuper"] = indices
        return _one(self.subsuper(self._s, begin, parts))

    def _placeable(self, token: str) -> Any:  # noqa: ANN401
        """Return a nucleus that may carry indices."""
        begin = self._at
        rule = _RULES.get(token)
        if rule is not None:
            self._at += len(token)
            return _one(rule(self, begin))
        if group := _GROUP.match(self._s, begin):
            if group[1] not in self._fontnames:
                raise TexError
            self._at = group.end()
            return self._group(group[1])
        if token[1:] in self._accent_map:
            self._at += len(token)
            placed = self._placeable(self._next())
            return _one(self.accent({"accent": token[1:], "sym": placed}))
        if _SIGN.fullmatch(token) or token in _ESCAPED or token[1:] in lib.tex2uni:
            self._at += len(token)
            return _one(self.symbol(self._s, begin, {"sym": token}))
        if token[1:] in self._function_names:
            self._at += len(token)
            return _one(self.function(self._s, begin, {"name": token[1:]}))
        raise TexError

    def _group(self, font: str = "") -> Any:  # noqa: ANN401
        self.push_state()
        if font:
            self.get_state().font = font
        nodes = self._tokens()
        self._take("}")
        self.pop_state()
        return lib.Hlist(nodes)

    def _part(self) -> Any:  # noqa: ANN401
        """Return an argument between braces, which may not be empty."""
        self._take("{")
        nodes = self._tokens()
        self._take("}")
        if not nodes:
            raise TexError
        return lib.Hlist(nodes)

    def _named(self, begin: int) -> Any:  # noqa: ANN401
        self._take("{")
        nodes = self._tokens()
        self._take("}")
        return self.operatorname(self._s, begin, {"name": ParseResults(nodes)})

    def _sized(self) -> Any:  # noqa: ANN401
        left = self._delimiter()
        nodes = self._tokens()
        self._take(r"\right")
        return self._auto_sized_delimiter(left, nodes, self._delimiter())

    def _delimiter(self) -> str:
        token = self._next()
        if token not in self._delims:
            raise TexError
        self._at += len(token)
        return token

    def _root(self) -> Any:  # noqa: ANN401
        return self.sqrt({"value": self._part()})


def _one(node: Any) -> Any:  # noqa: ANN401
    """Unwrap a list of one."""
    return node[0] if isinstance(node, list) else node


def _fraction(reader: Any, of: str) -> Any:  # noqa: ANN401
    parts = {"num": reader._part(), "den": reader._part()}
    return getattr(reader, of)(parts)


_RULES: dict[str, Callable[[Any, int], Any]] = {
    "{": lambda reader, _: reader._group(),
    r"\frac": lambda reader, _: _fraction(reader, "frac"),
    r"\dfrac": lambda reader, _: _fraction(reader, "dfrac"),
    r"\sqrt": lambda reader, _: reader._root(),
    r"\overline": lambda reader, _: reader.overline({"body": reader._part()}),
    r"\operatorname": lambda reader, begin: reader._named(begin),
    r"\left": lambda reader, _: reader._sized(),
}
