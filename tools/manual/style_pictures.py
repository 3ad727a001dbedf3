"""Pictures of the style files: the title page, the sheet of contents and a sheet of text."""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

from PIL import Image

from reports.document.report import Report
from reports.inputs.load import load_text
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model

SAMPLE = "gots-diesel"
SHEETS = ("Содержание", "Обоснование исходных данных")  # titles that sheets begin with
_DOTS_PER_INCH, _GAP, _GAP_GREY = 36, 8, 200
_STEP_GREY = 17  # between the levels of grey that are stored


def style_files() -> list[Path]:
    """Return the style files that are shipped, by name."""
    return sorted((samples_dir() / "styles").glob("*.toml"))


def write_style_pictures(folder: Path) -> list[Path]:
    """Write a picture of each style file and return the paths."""
    written = []
    for style in style_files():
        path = folder / f"{style.stem}.png"
        picture = style_picture(style).point(lambda grey: round(grey / _STEP_GREY) * _STEP_GREY)
        picture.save(path, optimize=True)
        written.append(path)
    return written


def style_picture(style: Path) -> Image.Image:
    """Return the sheets of a short note in this style, side by side, in grey."""
    source = samples_dir() / f"{SAMPLE}.toml"
    text = source.read_text(encoding="utf-8")
    text = text.replace("[report]\n", '[report]\nchapters = ["rationale"]\n', 1)
    model = build_model(load_text(text, source=source.name).model)
    note = Report.of(model, evaluate_model(model), source, style).pdf(source, b"")
    with tempfile.TemporaryDirectory() as name:
        document = Path(name) / "note.pdf"
        document.write_bytes(note)
        sheets = [_sheet(document, number) for number in _numbers(document)]
    width = sum(sheet.width + _GAP for sheet in sheets) - _GAP
    picture = Image.new("L", (width, sheets[0].height), _GAP_GREY)
    for number, sheet in enumerate(sheets):
        picture.paste(sheet, (number * (sheet.width + _GAP), 0))
    return picture


def _numbers(document: Path) -> list[int]:
    """Return the number of the title page and of the last sheet that begins with each title."""
    command = ["pdftotext", "-layout", str(document), "-"]
    run = subprocess.run(command, check=True, capture_output=True, text=True)
    beginnings = [text.strip().partition("\n")[0].casefold() for text in run.stdout.split("\f")]
    numbers = [1]
    for title in SHEETS:
        numbers.append(max(n for n, line in enumerate(beginnings, 1) if title.casefold() in line))
    return numbers


def _sheet(document: Path, number: int) -> Image.Image:
    stem = document.with_name(f"sheet-{number}")
    pages = ["-f", str(number), "-l", str(number), "-singlefile"]
    command = ["pdftoppm", "-r", str(_DOTS_PER_INCH), "-gray", "-png", *pages]
    subprocess.run([*command, str(document), str(stem)], check=True)
    with Image.open(stem.with_suffix(".png")) as image:
        return image.convert("L")
