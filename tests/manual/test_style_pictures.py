"""The stored picture of each style file is what the style gives."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from tools.manual.style_pictures import style_files, style_picture

# Mean grey of a square of ``SQUARE`` dots, 5 mm: what is stored is rounded, which changes it by
# less than ``TOLERANCE`` of 255; a moved number of the sheet changes it by more.
SQUARE, TOLERANCE = 7, 10
STYLES = style_files()
CHANGES = {
    "ministry": ("eskd", "ministry = ", 'ministry = "Другое ведомство" # '),
    "kind": ("eskd", "kind = ", 'kind = "Курсовой проект" # '),
    "frame": ("eskd", 'frame = "eskd"', 'frame = "none"'),
    "side columns": ("eskd", "side_columns = true", "side_columns = false"),
    "first framed sheet": ("eskd", "frame_from = 3", "frame_from = 6"),
    "letters": ("eskd", 'frame = "eskd"', 'font_size_pt = 13\nframe = "eskd"'),
    "left margin": ("gost-7-32", "left = 30", "left = 31"),
    "top margin": ("gost-7-32", "top = 20", "top = 21"),
    "number of the sheet": ("gost-7-32", "bottom-center", "bottom-right"),
}
pytestmark = pytest.mark.skipif(shutil.which("pdftoppm") is None, reason="pdftoppm is missing")


def differs(picture: Image.Image, stored: Path) -> bool:
    with Image.open(stored) as image:
        one, other = (_squares(each.convert("L")) for each in (picture, image))
    return one.shape != other.shape or bool(np.abs(one - other).max() > TOLERANCE)


def _squares(image: Image.Image) -> NDArray[np.float64]:
    grey = np.asarray(image, dtype=float)
    rows, columns = (size // SQUARE for size in grey.shape)
    cut = grey[: rows * SQUARE, : columns * SQUARE]
    return cut.reshape(rows, SQUARE, columns, SQUARE).mean(axis=(1, 3))


def _style(name: str) -> Path:
    (style,) = (path for path in STYLES if path.stem == name)
    return style


@pytest.mark.parametrize("style", STYLES, ids=lambda path: path.stem)
def test_style_gives_its_picture(style):
    assert not differs(style_picture(style), style.with_suffix(".png")), (
        "the picture is not what the style gives: ./run docs --pictures"
    )


@pytest.mark.parametrize("change", CHANGES)
def test_changed_style_gives_another_picture(change, tmp_path):
    name, before, after = CHANGES[change]
    style = _style(name)
    text = style.read_text(encoding="utf-8")
    assert before in text
    changed = tmp_path / style.name
    changed.write_text(text.replace(before, after), encoding="utf-8")
    assert differs(style_picture(changed), style.with_suffix(".png"))


def test_moved_title_gives_another_picture(monkeypatch):
    from tools.manual import style_pictures

    style = _style("gost-7-32")
    straight = style_pictures._sheet

    def moved(document: Path, number: int) -> Image.Image:
        sheet = straight(document, number)
        shifted = Image.new("L", sheet.size, 255)
        shifted.paste(sheet, (0, 2))  # 1.4 mm
        return shifted if number == 1 else sheet

    monkeypatch.setattr(style_pictures, "_sheet", moved)
    assert differs(style_pictures.style_picture(style), style.with_suffix(".png"))
