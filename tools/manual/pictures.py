"""The pictures of ``docs/``: printed sheets, pages of the report, the page in a browser."""

from __future__ import annotations

import io
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from reports.shared.errors import SystemPartMissing
from reports.shared.resources import samples_dir

if TYPE_CHECKING:
    from PIL import Image
    from playwright.sync_api import Page

SAMPLE, _LIVE_SAMPLE = "gots-diesel", "yamz-238"
_SETTLE_MS = 1000  # until charts and fonts stand
_CYCLE_DEG, _CLIP_STEP_DEG, _CLIP_MS, _CLIP_WIDTH = 720, 10, 60, 800  # of the moving picture
_COLOURS = 64
_BEGINNING = 30  # words of a page: its header, the title of the sheet and of the table
_BROWSERS, _PORT = ("chromium-headless-shell", "chromium", "chromium-browser"), "8399"
_MARGIN = 12  # white pixels kept around what is printed


@dataclass(frozen=True, slots=True)
class Picture:
    """A page of a document, found by the first line that stands on it."""

    name: str
    document: str
    text: str
    dots_per_inch: int = 80
    part: tuple[float, float, float, float] = (0, 0, 1, 1)  # left, top, right, bottom


PICTURES = (
    Picture(
        "inputs", "xlsx", "Исходные данные ← Содержание", dots_per_inch=150, part=(0, 0, 1, 0.5)
    ),
    Picture("forces", "xlsx", "Удельные силы и крутящий момент"),
    Picture("forces-chart", "xlsx", "Удельные силы p′г", 150, (0.578, 0.092, 0.919, 0.243)),
    Picture("report-title", "pdf", "курсовому проекту"),
    Picture("report-torque", "pdf", "Крутящий момент двигателя"),
)


def write_pictures(folder: Path) -> list[Path]:
    """Build the sample's workbook and report and write its pictures as PNG files.

    Raises:
        SystemPartMissing: LibreOffice or poppler is not installed.
    """
    from reports.exports.build import build, load_input

    if shutil.which("pdftoppm") is None:
        msg = "для рисунков нужен pdftoppm; выполните: sudo apt-get install -y poppler-utils"
        raise SystemPartMissing(msg)
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        temporary = Path(name)
        source = samples_dir() / f"{SAMPLE}.toml"
        build(source, load_input(source), temporary, ("xlsx", "pdf"))
        documents = {"pdf": temporary / f"{SAMPLE}.pdf", "xlsx": temporary / "book.pdf"}
        documents["xlsx"].write_bytes(_printed(temporary / f"{SAMPLE}.xlsx"))
        written = [_write(picture, documents, folder) for picture in PICTURES]
    return [*written, _web_page(folder / "page.png"), *_live_page(folder)]


def _web_page(target: Path) -> Path:
    """Return the page of an engine as a browser shows it, at an angle with large forces."""
    from PIL import Image
    from playwright.sync_api import sync_playwright

    shell = next(filter(None, map(shutil.which, _BROWSERS)), None)
    with tempfile.TemporaryDirectory() as data, sync_playwright() as driver:
        command = [sys.executable, "-m", "reports", "serve", "--port", _PORT, "--data", data]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        try:
            assert server.stdout is not None
            address = server.stdout.readline().partition(": ")[2].strip()
            browser = driver.chromium.launch(executable_path=shell, args=["--no-sandbox"])
            size = {"width": 1280, "height": 760}
            page = browser.new_page(viewport=size, reduced_motion="reduce")  # type: ignore[arg-type]
            page.goto(address)
            page.wait_for_selector("#checks table")
            page.evaluate("document.getElementById('new').open = false")
            page.evaluate("turn(390)")
            page.screenshot(path=target)
            browser.close()
        finally:
            server.terminate()
            server.wait()
    _save(Image.open(target), target)
    return target


def _save(image: Image.Image, target: Path) -> None:
    """Save a picture of a page; colours of little area are kept."""
    from PIL import Image

    colours = image.convert("RGB").quantize(256, method=Image.Quantize.MAXCOVERAGE)
    colours.save(target, optimize=True)


def _live_page(folder: Path) -> list[Path]:
    """Return the live page of a V8 from its file: as it opens, its card, it in motion."""
    from PIL import Image
    from playwright.sync_api import sync_playwright

    from reports.exports.build import build, load_input

    shell = next(filter(None, map(shutil.which, _BROWSERS)), None)
    opened, card, clip = (folder / name for name in ("live.png", "card.png", "v8.webp"))
    with tempfile.TemporaryDirectory() as name, sync_playwright() as driver:
        source = samples_dir() / f"{_LIVE_SAMPLE}.toml"
        (file,) = build(source, load_input(source), Path(name), ("live",)).files
        browser = driver.chromium.launch(executable_path=shell, args=["--no-sandbox"])
        size = {"width": 1366, "height": 1000}
        page = browser.new_page(viewport=size, reduced_motion="reduce")  # type: ignore[arg-type]
        page.goto(file.as_uri())
        page.wait_for_selector("#charts canvas")
        page.evaluate("turn(377)")
        page.wait_for_timeout(_SETTLE_MS)
        page.screenshot(path=opened)
        with page.expect_download() as coming:
            page.click("#card")
        coming.value.save_as(card)
        _write_clip(page, clip)
        browser.close()
    image = Image.open(opened).convert("RGB")
    _save(image.resize((image.width * 4 // 5, image.height * 4 // 5)), opened)
    _save(Image.open(card), card)
    return [opened, card, clip]


def _write_clip(page: Page, target: Path) -> None:
    """Write one cycle of the engine as a moving picture, frame by frame."""
    from PIL import Image

    stage, frames = page.locator("#scene"), []
    for phi in range(0, _CYCLE_DEG, _CLIP_STEP_DEG):
        page.evaluate(f"turn({phi})")
        image = Image.open(io.BytesIO(stage.screenshot())).convert("RGB")
        frames.append(image.resize((_CLIP_WIDTH, round(image.height * _CLIP_WIDTH / image.width))))
    frames[0].save(target, save_all=True, append_images=frames[1:], duration=_CLIP_MS, loop=0,
                   quality=70, method=6)  # fmt: skip


def _printed(workbook: Path) -> bytes:
    from tools.referees.by_libreoffice import LibreOffice

    return LibreOffice().converted([workbook.read_bytes()], "pdf")[0]


def _write(picture: Picture, documents: dict[str, Path], folder: Path) -> Path:
    from PIL import Image, ImageChops

    document = documents[picture.document]
    pages = [(n, " ".join(text.split())) for n, text in _pages(document)]
    beginnings = [(n, " ".join(text.split(" ")[:_BEGINNING])) for n, text in pages]
    page = next(n for n, text in (*beginnings, *pages) if picture.text in text)
    stem = document.with_suffix("")
    command = ["pdftoppm", "-r", str(picture.dots_per_inch), "-png", "-singlefile"]
    subprocess.run([*command, "-f", str(page), "-l", str(page), document, stem], check=True)
    image = Image.open(stem.with_suffix(".png")).convert("RGB")
    box = ImageChops.difference(image, Image.new("RGB", image.size, "white")).getbbox()
    left, top, right, bottom = box or (0, 0, *image.size)
    ends = [left, top, left, top]
    sizes = (right - left, bottom - top) * 2
    left, top, right, bottom = (
        round(end + size * share)
        for end, size, share in zip(ends, sizes, picture.part, strict=True)
    )
    cut = image.crop((left - _MARGIN, top - _MARGIN, right + _MARGIN, bottom + _MARGIN))
    path = folder / f"{picture.name}.png"
    cut.quantize(_COLOURS).save(path, optimize=True)
    return path


def _pages(document: Path) -> Iterator[tuple[int, str]]:
    run = subprocess.run(
        ["pdftotext", "-layout", str(document), "-"], check=True, capture_output=True
    )
    yield from enumerate(run.stdout.decode("utf-8").split("\f"), 1)
