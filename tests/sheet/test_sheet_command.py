"""The command, the section of the input, what is refused in one line."""

from __future__ import annotations

import re
import subprocess

import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.draw.canvas import Words
from reports.inputs.sections import report
from reports.shared.doctor import need_packages
from reports.shared.errors import InputError, SystemPartMissing
from reports.shared.resources import samples_dir
from reports.sheet.write import sheet_items
from tests.sheet.sheet_samples import terms

ENDINGS = ("-sheet.pdf", "-sheet.dxf", "-throw.dxf", "-mechanism.dxf")

# Those that every engine has: others stand in chapters of their own.
# What has a section or a chapter of its own is left out.
_ASKED = {"counterweight", "torsion", "strength", "speed", "flywheel"}
ALWAYS = [name for name in report.DIAGRAMS if name not in _ASKED]


def run(*args):
    done = CliRunner().invoke(main, [str(arg) for arg in args])
    return done.exit_code, done.output


def source(folder, section=""):
    text = (samples_dir() / "d-240.toml").read_text(encoding="utf-8")
    path = folder / "own.toml"
    path.write_text(text + section, encoding="utf-8")
    return path


def test_names_of_diagrams_are_stated_once():
    assert report.Diagram.__args__ == tuple(report.DIAGRAMS)
    assert set(report.USUAL) < set(report.DIAGRAMS)


def test_signs_that_the_font_lacks_do_not_stop_the_sheet(tmp_path):
    text = (samples_dir() / "d-240.toml").read_text(encoding="utf-8")
    path = tmp_path / "own.toml"
    path.write_text(text.replace("Дизель Д-240", "Дизель 🚀 <Д> & «240»"), encoding="utf-8")
    code, output = run("build", path, "--only", "sheet", "-o", tmp_path / "out")
    assert code == 1, output  # there is something to look at
    assert "engine.name: в шрифте отчёта нет: 🚀 (U+1F680)" in output
    assert "внутренняя ошибка" not in output
    assert len(list((tmp_path / "out").iterdir())) == len(ENDINGS)


def test_the_command_writes_pdf_and_dxf(tmp_path):
    code, said = run("build", source(tmp_path), "--only", "sheet", "-o", tmp_path / "out")
    assert code == 0, said
    built = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert built == sorted(f"own{ending}" for ending in ENDINGS)
    message = subprocess.run(["pdfinfo", str(tmp_path / "out" / "own-sheet.pdf")],
                          capture_output=True, text=True, check=True).stdout  # fmt: skip
    wide, tall = map(float, re.search(r"Page size:\s+([\d.]+) x ([\d.]+)", message).groups())
    assert (wide / 72 * 25.4, tall / 72 * 25.4) == pytest.approx((841, 594), abs=0.5)
    assert re.search(r"Pages:\s+1\b", message)
    images = subprocess.run(["pdfimages", "-list", str(tmp_path / "out" / "own-sheet.pdf")],
                            capture_output=True, text=True, check=True).stdout  # fmt: skip
    assert len(images.splitlines()) == 2  # the heading alone: lines and letters, no picture


@pytest.mark.parametrize(
    ("section", "words"),
    [
        (f'size = "A2"\ndiagrams = {ALWAYS}', "помещается 14, выбрано 18"),
        ('size = "A4"', "A1"),
        ('diagrams = ["pie"]', "pie"),
        ('diagram = ["pv"]', "diagram"),
    ],
)
def test_what_does_not_fit_is_told_in_one_line(tmp_path, section, words):
    out = tmp_path / "out"
    file = source(tmp_path, f"\n[sheet]\n{section}\n")
    code, said = run("build", file, "--only", "sheet", "-o", out)
    assert code == 2 and words in said
    (line,) = said.strip().splitlines()
    assert "sheet" in line
    assert not out.exists() or not list(out.iterdir())


@pytest.mark.parametrize("way", ["landscape", "portrait"])
@pytest.mark.parametrize("size", ["A1", "A2"])
def test_a_person_picks_what_stands_on_it(size, way):
    picked = '["torque", "pin_polar", "results"]'
    section = f'\n[sheet]\nsize = "{size}"\norientation = "{way}"\ndiagrams = {picked}\n'
    canvas, width, height = sheet_items(terms("d-240", section))
    assert (width > height) == (way == "landscape")
    said = {item.text for item in canvas.items if isinstance(item, Words)}
    assert "Результаты расчёта" in said and "Схема коленчатого вала" not in said


def test_everything_fits_a1():
    every = ", ".join(f'"{name}"' for name in ALWAYS)
    canvas, _, _ = sheet_items(terms("d-240", f"\n[sheet]\ndiagrams = [{every}]\n"))
    assert any("Кривошипно-шатунный механизм" in getattr(i, "text", "") for i in canvas.items)


def test_what_an_engine_has_not_is_refused():
    t = terms("d-240", '\n[sheet]\ndiagrams = ["pv", "torque"]\n')
    t.model.charts_by_id.pop("pv")
    try:
        with pytest.raises(InputError, match="у этого двигателя нет: pv"):
            sheet_items(t)
    finally:
        terms.cache_clear()


def test_a_missing_package_is_named():
    with pytest.raises(SystemPartMissing) as caught:
        need_packages("нужен для чертежей DXF", ezdxf="ezdxf", nothing_such="nothing-such")
    (line,) = caught.value.lines()
    assert "nothing-such" in line and "ezdxf" not in line.partition("(")[0]
    assert "pip install nothing-such" in line and caught.value.exit_code == 3
