"""From templates to HTML and from HTML to PDF, cut off from network and file system."""

from __future__ import annotations

import functools
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import pydyf
from markupsafe import Markup

from reports.document.page import fitting
from reports.document.page.fitting import DIVIDED
from reports.document.page.style import FRAME_MM, SIDE_MM, USUAL, Style
from reports.document.text import texts
from reports.document.text.mathsvg import complaints, formula_lines
from reports.document.text.symbols import inline_html
from reports.document.text.texts import FORMULA
from reports.draw import fonts
from reports.shared.doctor import need_pango
from reports.shared.errors import RenderError
from reports.shared.font_coverage import boxed
from reports.shared.gc_pause import uncollected
from reports.shared.russian import NBSP, joined

if TYPE_CHECKING:
    import weasyprint
    from jinja2 import Environment
    from weasyprint.urls import URLFetcher, URLFetcherResponse

_TYPES = {".toml": "application/toml"}  # that Python's list of media types lacks
_EPOCH = datetime(2000, 1, 1, tzinfo=UTC)
_DATA_TYPES = ("data:image/png", "data:image/svg+xml", "data:image/jpeg")


def finish(pdf: Any) -> None:  # noqa: ANN401
    """Formulas and headings of columns tagged as such; attachments named once, with their types.

    Then each object is written: pydyf asks for its bytes twice, in the end for a hash.
    """
    for item in pdf.objects:
        if isinstance(item, dict) and item.get("Type") == "/StructElem":
            _tagged(item)
        elif isinstance(item, dict) and item.get("Type") == "/Filespec":
            _typed(pdf, item)
    if "AF" in pdf.catalog:
        pdf.catalog["AF"][:] = dict.fromkeys(pdf.catalog["AF"])
    for number, item in enumerate(pdf.objects[1:], 1):  # one by one: each takes room
        pdf.objects[number] = (_Stream if isinstance(item, pydyf.Stream) else _Object)(item)


class _Written:
    """A PDF object with its bytes."""

    data = b""

    def __init__(self, source: pydyf.Object) -> None:
        super().__init__()
        self.number, self.generation, self.free = source.number, source.generation, source.free
        self.data = source.data


class _Object(_Written, pydyf.Object):  # type: ignore[misc]
    """A PDF object other than a stream."""


class _Stream(_Written, pydyf.Stream):  # type: ignore[misc]
    """A PDF stream."""


def _tagged(element: dict[str, Any]) -> None:
    words = element.get("Alt")
    if words is not None and words.string.startswith(FORMULA):
        words.string = words.string.removeprefix(FORMULA)
        element["S"] = "/Formula"
    elif element.get("S") == "/TH":
        element["A"]["Scope"] = "/Column"


def _typed(pdf: Any, file: dict[str, Any]) -> None:  # noqa: ANN401
    for ending, media in _TYPES.items():
        if file["UF"].string.endswith(ending):
            stream = pdf.objects[int(file["EF"]["F"].split()[0])]
            stream.extra["Subtype"] = f"/{media.replace('/', '#2f')}"


@dataclass(frozen=True, slots=True)
class AttachedFile:
    """A file to put into the PDF: name, contents, what it is, relationship of PDF/A-3."""

    name: str
    data: bytes
    description: str = ""
    relationship: str = "Source"


@dataclass(frozen=True, slots=True)
class Rendered:
    """A finished PDF with its page count and what WeasyPrint complained about."""

    pdf: bytes
    pages: int
    warnings: tuple[str, ...]


def render_pdf(
    html: str,
    *,
    attachments: Iterable[AttachedFile] = (),
    variant: str | None = "pdf/a-3b",
    identifier: bytes | None = None,
) -> bytes:
    """Render a whole HTML page to PDF; the same text gives the same bytes.

    Args:
        html: The page with its CSS inside.
        attachments: Files put into the PDF with a fixed date.
        variant: PDF variant of WeasyPrint or ``None`` for a plain PDF.
        identifier: File identifier; by default made from the page itself.

    Raises:
        RenderError: WeasyPrint logged a warning; the message holds all of them.
        SystemPartMissing: pango is not on this machine.
    """
    result = render(boxed(html), attachments=attachments, variant=variant, identifier=identifier)
    if result.warnings:
        msg = "Вёрстка отчёта с замечаниями: " + "; ".join(result.warnings)
        raise RenderError(msg)
    return result.pdf


def render(
    html: str,
    *,
    attachments: Iterable[AttachedFile] = (),
    variant: str | None = "pdf/a-3b",
    identifier: bytes | None = None,
) -> Rendered:
    """Render like :func:`render_pdf`, handing the warnings back instead of raising."""
    need_pango()
    with uncollected(), complaints("weasyprint") as warnings:
        # In a function of its own: what it made is gone before garbage is looked for again.
        pdf, pages = _rendered(html, attachments, variant, identifier)
    return Rendered(pdf, pages, tuple(warnings))


def _rendered(
    html: str,
    attachments: Iterable[AttachedFile],
    variant: str | None,
    identifier: bytes | None,
) -> tuple[bytes, int]:
    """Return the file and the number of its pages."""
    with _libraries_by_name():
        import weasyprint

    with _fonts() as faces:
        page = weasyprint.HTML(string=html, base_url=None, url_fetcher=_fetcher())
        # The same configuration for parsing and layout, or @font-face is dropped silently.
        document = page.render(font_config=faces, pdf_variant=variant, pdf_tags=True)
        pdf = document.write_pdf(
            pdf_variant=variant,
            pdf_tags=True,  # alternative texts stand in the tags
            pdf_identifier=identifier or _identifier(html),
            attachments=[_attachment(item) for item in attachments],
            finisher=lambda _, written: finish(written),
        )
    return pdf, len(document.pages)


@contextmanager
def _fonts() -> Iterator[Any]:
    """Fonts of one document; their copies in the temporary folder go with it."""
    from weasyprint.text.fonts import FontConfiguration

    faces = FontConfiguration()
    try:
        yield faces
    finally:
        faces.__del__()  # by itself it waits to be collected, which a build never does


def environment(
    overrides: Path | None = None,
    *,
    media: Literal["print", "screen"] = "print",
    style: Style = USUAL,
) -> Environment:
    """Jinja environment of the templates: autoescape on, unknown names refused.

    Every text put in is cleaned first (no control characters, no sign but letters that STIX
    cannot show) and «мин⁻¹» gets a superscript; ``Markup`` passes as it is.  Texts inside of
    attributes take the filter ``plain``.

    Args:
        overrides: A folder whose files replace templates of the same name; they may build
            on the ones they replace, ``{% extends "kshm/report/cover.html.j2" %}``, and run
            in Jinja's sandbox.
        media: "print" writes long tables the way that is fast on paper and names the fonts by
            ``kshm-font:``; "screen" writes plain tables and embeds the fonts.
        style: What a department's style file asks for.
    """
    if overrides is None:  # our own templates do not change: one environment compiles them
        return _own_environment(media, style)
    return _environment(overrides, media, style)


@functools.lru_cache(maxsize=4)
def _own_environment(media: str, style: Style) -> Environment:
    return _environment(None, media, style)


def _environment(overrides: Path | None, media: str, style: Style) -> Environment:
    import jinja2
    from jinja2.sandbox import ImmutableSandboxedEnvironment

    from reports.shared import resources

    loader = jinja2.FileSystemLoader(resources.templates_dir())
    loaders: list[jinja2.BaseLoader] = [loader]
    if overrides is not None:
        replaced = {"report": jinja2.FileSystemLoader(overrides), "kshm": loader}
        loaders.insert(0, jinja2.PrefixLoader(replaced))
    kind = jinja2.Environment if overrides is None else ImmutableSandboxedEnvironment
    result = kind(
        loader=jinja2.ChoiceLoader(loaders),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        finalize=_finalize,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=False,
    )
    result.globals |= {
        "media": media,
        "fonts_css": lambda embedded=False: Markup(fonts.fonts_css(embedded=embedded)),
        "font_stack": Markup(fonts.STACK),
        "font_family": fonts.FAMILY,
        "frame_mm": FRAME_MM,
        "side_mm": SIDE_MM,
        "formula_lines": formula_lines,
        "nbsp": NBSP,
        "divided": DIVIDED,
        "style": style
        if style.tagged_tables is not None
        else style.model_copy(update={"tagged_tables": False}),
    }
    result.filters |= {
        "joined": joined,
        "plain": texts.plain,
        "sym": inline_html,
        "titled": texts.titled,
        "pictured": texts.pictured,
        "least_width": fitting.least_width,
        "fitted": lambda block, size: (
            fitting.fitted(block, size, style) if media == "print" else ([block], size)
        ),
    }
    return result


def _finalize(value: object) -> object:
    """Return what Jinja does to each value put in: foreign text is cleaned, markup is trusted."""
    if isinstance(value, str) and not isinstance(value, Markup):
        return texts.rich(value)
    return value


def _attachment(item: AttachedFile) -> weasyprint.Attachment:
    import weasyprint

    return weasyprint.Attachment(
        string=item.data,
        name=item.name,
        description=item.description or item.name,
        created=_EPOCH,
        modified=_EPOCH,
        relationship=item.relationship,
    )


def _identifier(html: str) -> bytes:
    import hashlib

    return hashlib.sha256(html.encode("utf-8", "replace")).hexdigest()[:32].encode("ascii")


@functools.cache
def _fetcher() -> URLFetcher:
    """Fetcher that knows our fonts and ``data:`` images and nothing else."""
    from weasyprint.urls import URLFetcher, URLFetcherResponse

    class PackageFetcher(URLFetcher):  # type: ignore[misc]
        """Serves package resources; every other address is refused."""

        def fetch(self, url: str, headers: dict[str, str] | None = None) -> URLFetcherResponse:
            scheme, _, tail = url.partition(":")
            if scheme == fonts.SCHEME:
                return URLFetcherResponse(url, fonts.font_bytes(tail), {"Content-Type": "font/ttf"})
            if url.startswith(_DATA_TYPES):
                return super().fetch(url, headers)
            msg = f"Адрес вне отчёта не открывается: {url[:80]}"
            raise ValueError(msg)

    return PackageFetcher(allowed_protocols=[fonts.SCHEME, "data"], allow_redirects=False)


@contextmanager
def _libraries_by_name() -> Iterator[None]:
    """Let libraries be found by their file names alone while WeasyPrint is imported.

    Otherwise a compiler and a linker are started for each name that is tried: half a second.
    """
    import ctypes.util

    before = ctypes.util.find_library
    if sys.platform == "linux":
        ctypes.util.find_library = lambda name: None
    try:
        yield
    finally:
        ctypes.util.find_library = before
