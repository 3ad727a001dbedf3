r"""Formulas as equations of Word (OMML), from the tree of the same TeX that the PDF sets.

Two kept converters from MathML were tried on all formulas of all samples and left out: their
roots break the schema, the bar over a letter is no well-formed XML, spaces are lost and every
group becomes a box.  Pandoc's equations are valid, but it is a program of 155 MB that has to be
started, and it takes the decimal comma for punctuation.  The tree is read anyway, see
:mod:`reports.document.text.tex`.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from lxml import etree

from reports.document.text.symbols import SIGNS
from reports.document.text.tex import FRACTIONS, GREEK, TexNode, case_parts, is_cases, tree
from reports.shared.russian import MINUS

NAMESPACE = "http://schemas.openxmlformats.org/officeDocument/2006/math"
Math = list[etree._Element]

_UPRIGHT = {"mathrm", "text", "operatorname"}
_GROUPS = {"mathit", "mathbf"}
_ACCENTS = {"hat": "\u0302", "dot": "\u0307", "ddot": "\u0308", "vec": "\u20d7"}
_BARS = {"bar", "overline"}
_FUNCTIONS = {"sin", "cos", "tan", "tg", "ctg", "arcsin", "arccos", "arctg", "arctan", "exp",
              "ln", "lg", "min", "max", "sh", "ch", "sign"}  # fmt: skip
_BIG = {"sum": "∑", "int": "∫", "prod": "∏", "oint": "∮"}
_SPACES = {",": "\u2009", ";": "\u2005", ":": "\u2005", " ": "\u2005", "quad": "\u2003",
           "qquad": "\u2003\u2003", "!": "", "displaystyle": "", "hspace": ""}  # fmt: skip
_MORE_SIGNS = {"neq": "≠", "ne": "≠", "equiv": "≡", "mp": "∓", "{": "{", "}": "}", "|": "‖",
               "%": "%"}  # fmt: skip
_THIN, _MEDIUM = "\u2009", "\u2005"
_JOINING = "=≈≤≥<>+−·×±≠≡"
_SPACES_SET = "\u2003\u2005\u2009"
_ITALIC, _PLAIN, _TEXT = "", "sty", "nor"  # faces: a variable, a number or a sign, a word


def omath(tex: str) -> etree._Element:
    """Return a line of TeX as ``m:oMath``.

    Raises:
        TexError: the TeX is not well formed.
        ValueError: a command has no equation.
    """
    if not is_cases(tex):
        return _element("oMath", *_sequence(tree(tex)))
    lead, rows = case_parts(tex)
    lines = [
        _element("mr", *(_element("e", *_sequence(tree(part))) for part in row)) for row in rows
    ]
    return _element("oMath", *_sequence(tree(lead)), _braced(lines, max(map(len, rows))))


def _braced(lines: Math, columns: int) -> etree._Element:
    """Branches one above another behind a brace, their conditions in a column."""
    signs = [_element("begChr"), _element("endChr")]
    for sign, char in zip(signs, ("{", ""), strict=True):
        sign.set(f"{{{NAMESPACE}}}val", char)
    manner = _element("mcPr", _element("count", val=str(columns)), _element("mcJc", val="left"))
    properties = _element("mPr", _element("mcs", _element("mc", manner)))
    return _element("d", _element("dPr", *signs), _element("e", _element("m", properties, *lines)))


def displayed(tex: str, end: str = "") -> etree._Element:
    """Return a line of TeX as ``m:oMathPara`` with a comma or a full stop behind it.

    A sign at the end of a broken line, and the same sign at the beginning of the next one, are
    set as text: LibreOffice looks for what they join.
    """
    line = omath(tex)
    for side in (0, -1):
        outer = line[side] if len(line) else None
        if outer is None or not _is_run(outer) or _face_of(outer) != _PLAIN:
            continue
        text = outer[-1].text or ""
        if side and text[-1] in _JOINING:
            line.append(_run(_MEDIUM + text[-1], _TEXT))
            outer[-1].text = text[:-1]
        elif not side and text[0] in _JOINING:
            line.insert(0, _run(text[0] + _MEDIUM, _TEXT))
            outer[-1].text = text[1:]
        if not outer[-1].text:
            line.remove(outer)
    if end:
        line.append(_run(end, _TEXT))
    return _element("oMathPara", line)


@dataclass(slots=True)
class _Atom:
    """A base with its indices."""

    base: Math
    below: Math
    above: Math
    big: str = ""

    def elements(self) -> Math:
        """Return the atom as elements; a text with nothing set to it stays what it is."""
        below, above = _element("sub", *self.below), _element("sup", *self.above)
        base = _element("e", *self.base)
        if self.below and self.above:
            return [_element("sSubSup", base, below, above)]
        if self.below:
            return [_element("sSub", base, below)]
        if self.above:
            return [_element("sSup", base, above)]
        return self.base


def _sequence(nodes: Sequence[TexNode], *, upright: bool = False) -> Math:
    """Nodes side by side."""
    return _merged(_elements([node for node in nodes if not node.token.isspace()], upright))


def _elements(nodes: Sequence[TexNode], upright: bool) -> Math:
    out: Math = []
    start = 0
    while start < len(nodes):
        if nodes[start].command in _FUNCTIONS and out and _takes_room(out[-1]):
            out.append(_run(_THIN, _PLAIN))
        atom, start = _atom(nodes, start, upright)
        if atom.big:
            following: Math = []
            if start < len(nodes):
                inner, start = _atom(nodes, start, upright)
                following = inner.elements()
            out.append(_nary(atom, following))
        else:
            out += atom.elements()
    return out


def _atom(nodes: Sequence[TexNode], start: int, upright: bool) -> tuple[_Atom, int]:
    """Return the atom that begins at a place, and the place behind it."""
    node = nodes[start]
    if node.token == r"\left":
        base, start = _delimited(nodes, start, upright)
    elif node.token.isdigit():
        base, start = _number(nodes, start)
    else:
        # An index without a letter before it belongs to an empty base.
        base = [] if node.token in ("_", "^", "'") else _piece(node, upright)
        start += node.token not in ("_", "^", "'")
    atom = _Atom(base, [], [], _BIG.get(node.command, ""))
    while start < len(nodes) and nodes[start].token in ("_", "^", "'"):
        mark = nodes[start]
        inner = [] if mark.token == "'" else _sequence(mark.parts[0], upright=upright)
        sign = "".join("".join(part.itertext()) for part in inner)
        if mark.token == "^" and sign == "°":
            atom.base = _merged([*atom.base, *inner])
        elif mark.token == "'":
            atom.above = _merged([*atom.above, _run("′", _PLAIN)])
        elif mark.token == "_":
            atom.below = _merged([*atom.below, *inner])
        else:
            atom.above = _merged([*atom.above, *inner])
        start += 1
    if node.command in _FUNCTIONS and start < len(nodes) and nodes[start].token != r"\left":
        return _Atom([*atom.elements(), _run(_THIN, _PLAIN)], [], []), start
    return atom, start


def _number(nodes: Sequence[TexNode], start: int) -> tuple[Math, int]:
    """Return a number with its decimal comma, the whole of which a power is set to."""
    text = ""
    while start < len(nodes):
        node = nodes[start]
        comma = node.token == "{" and [inner.token for inner in node.parts[0]] == [","]
        if not (comma or node.token.isdigit()):
            break
        text += "," if comma else node.token
        start += 1
    return [_run(text, _PLAIN)], start


def _delimited(nodes: Sequence[TexNode], start: int, upright: bool) -> tuple[Math, int]:
    r"""Content between ``\left`` and ``\right`` with growing brackets."""
    opening = _bracket(nodes[start + 1])
    depth, end = 1, start + 2
    while depth and end < len(nodes):
        depth += (nodes[end].token == r"\left") - (nodes[end].token == r"\right")
        end += 1
    if depth:
        msg = r"\left without \right"
        raise ValueError(msg)
    closing = _bracket(nodes[end])
    inner = _merged(_elements(nodes[start + 2 : end - 1], upright))
    if opening and closing and all(map(_is_run, inner)):  # growing ones are thinned in LibreOffice
        return _merged([_run(opening, _PLAIN), *inner, _run(closing, _PLAIN)]), end + 1
    marks = (_element("begChr", val=opening), _element("endChr", val=closing))
    return [_element("d", _element("dPr", *marks), _element("e", *inner))], end + 1


def _takes_room(part: etree._Element) -> bool:
    """Whether a name of a function behind it stands off: not behind a sign or a space."""
    return not _is_run(part) or (part[-1].text or "")[-1] not in _JOINING + _SPACES_SET + "([{"


def _bracket(node: TexNode) -> str:
    return "" if node.token == "." else _MORE_SIGNS.get(node.command, node.token)


def _nary(atom: _Atom, following: Math) -> etree._Element:
    properties = _element(
        "naryPr",
        _element("chr", val=atom.big),
        _element("limLoc", val="undOvr"),
        *([] if atom.below else [_element("subHide", val="1")]),
        *([] if atom.above else [_element("supHide", val="1")]),
    )
    parts = (_element("sub", *atom.below), _element("sup", *atom.above))
    return _element("nary", properties, *parts, _element("e", *following))


def _piece(node: TexNode, upright: bool) -> Math:
    """Return a node without its indices."""
    name, token = node.command, node.token
    if token in FRACTIONS:
        over, under = (_sequence(part, upright=upright) for part in node.parts)
        return [_element("f", _element("num", *over), _element("den", *under))]
    if name == "sqrt":
        hidden = _element("radPr", _element("degHide", val="1"))
        inner = _element("e", *_sequence(node.parts[0], upright=upright))
        return [_element("rad", hidden, _element("deg"), inner)]
    if token == "{" or name in _UPRIGHT | _GROUPS:
        return _sequence(node.parts[0], upright=upright or name in _UPRIGHT)
    if name in _BARS:
        properties = _element("barPr", _element("pos", val="top"))
        inner = _element("e", *_sequence(node.parts[0], upright=upright))
        return [_element("bar", properties, inner)]
    if name in _ACCENTS:
        properties = _element("accPr", _element("chr", val=_ACCENTS[name]))
        return [
            _element("acc", properties, _element("e", *_sequence(node.parts[0], upright=upright)))
        ]
    return list(_text(node, upright))


def _text(node: TexNode, upright: bool) -> Iterator[etree._Element]:
    """Letters, digits, signs, names of functions."""
    name, token = node.command, node.token
    if name in _BIG:
        return
    if name in _SPACES:
        sign = _SPACES[name]
    elif name in _FUNCTIONS:
        sign = name
    elif name in GREEK:
        sign, upright = GREEK[name], upright or GREEK[name].isupper()
    elif name == "prime":
        sign = "′"
    elif name:
        sign_text = SIGNS.get(name) or _MORE_SIGNS.get(name)
        if sign_text is None:
            msg = f"no equation for \\{name}"
            raise ValueError(msg)
        sign = sign_text
    else:
        sign = MINUS if token == "-" else "\u2009" if token == "~" else token
    if sign:
        yield _run(sign, _face(sign, upright=upright))


def _face(sign: str, *, upright: bool) -> str:
    """How a sign is set; LibreOffice takes a lone bracket for half of a pair but in a text."""
    if sign in "()[]{}|‖" or (upright and sign.strip()) or sign in _FUNCTIONS:
        return _TEXT
    letter = len(sign) == 1 and sign.isalpha()
    return _ITALIC if letter and not _is_cyrillic(sign) else _TEXT if letter else _PLAIN


def _is_cyrillic(sign: str) -> bool:
    return unicodedata.name(sign, "").startswith("CYRILLIC")


def _run(text: str, face: str) -> etree._Element:
    run = _element("r")
    if face == _TEXT:
        run.append(_element("rPr", _element("nor")))
    elif face == _PLAIN:
        run.append(_element("rPr", _element("sty", val="p")))
    words = _element("t")
    words.text = text
    if text != text.strip():
        words.set("{http://www.w3.org/XML/1998/namespace}space", "preserve")
    run.append(words)
    return run


def _face_of(run: etree._Element) -> str:
    return _ITALIC if len(run) == 1 else str(etree.QName(run[0][0]).localname)


def _merged(parts: Math) -> Math:
    """Neighbouring runs of one face made one: a number is a number, a word a word."""
    out: Math = []
    for part in parts:
        both = bool(out) and _is_run(part) and _is_run(out[-1])
        if both and _face_of(part) == _face_of(out[-1]):
            text = (out[-1][-1].text or "") + (part[-1].text or "")
            out[-1] = _run(text, _face_of(part))
        else:
            out.append(part)
    return out


def _is_run(part: etree._Element) -> bool:
    return bool(part.tag == f"{{{NAMESPACE}}}r")


def _element(name: str, *children: etree._Element, val: str | None = None) -> etree._Element:
    element = etree.Element(f"{{{NAMESPACE}}}{name}", nsmap={"m": NAMESPACE})
    if val is not None:
        element.set(f"{{{NAMESPACE}}}val", val)
    element.extend(children)
    return element


def barred(text: str) -> etree._Element:
    """Some letters under a bar as ``m:oMath``, for running text: Word's letters have none."""
    properties = _element("barPr", _element("pos", val="top"))
    return _element("oMath", _element("bar", properties, _element("e", _run(text, _ITALIC))))
