"""The sheet «Механизм»: its points at every angle of the list are the solver's."""

from __future__ import annotations

import io
import zipfile
from functools import lru_cache

import formualizer
import numpy as np
import openpyxl
import pytest
from lxml import etree

from kshm import solve
from kshm.mechanics.kinematics import displacement_exact
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from reports.workbook.caches import sheet_parts
from reports.workbook.motion import SHEET
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.workbook.lint import MAIN
from tests.workbook.made import book, coarse_book, model
from tools.referees.by_libreoffice import LibreOffice
from tools.referees.cells import stripped

TITLES = 1  # column
TOLERANCE = 1e-9
ANGLES = range(0, 720, 10)
_R = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_T = "application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml"


def test_a_model_engine_shows_its_volume() -> None:
    """A cylinder of 2.5 cm³ has no volume of «0,000 dm³»."""
    raw = to_mapping(sample("two-stroke"))
    raw["geometry"] |= {"bore_mm": 15.0, "stroke_mm": 14.0, "rod_length_mm": 26.0}
    small = build_model(load_mapping(raw, source="t.toml").model)
    data = workbook_bytes(small, evaluate_model(small))
    sheet = openpyxl.load_workbook(io.BytesIO(data), data_only=True)[SHEET]
    (at,) = (row for row in range(4, 32) if sheet.cell(row, TITLES).value == "Объём V")
    cell = sheet.cell(at, 2)
    decimals = len(cell.number_format.partition(".")[2])
    assert cell.value * 10**decimals > 100


@pytest.mark.parametrize(("name", "turn"), [("gots-diesel", 720), ("two-stroke", 360)])
def test_angles_end_with_the_cycle(name: str, turn: float) -> None:
    charts = openpyxl.load_workbook(io.BytesIO(coarse_book(name)))[SHEET]._charts
    ends = [chart.x_axis.scaling.max for chart in charts]
    assert [end for end in ends if end and end > 2] == [turn, turn]


@lru_cache
def opened(name: str) -> formualizer.Workbook:
    return formualizer.load_workbook_bytes(stripped(book(name))[0])


def rows(engine: formualizer.Workbook) -> dict[str, int]:
    """Row of each value beside the charts and below them."""
    titles = {row: engine.get_value(SHEET, row, TITLES) for row in (*range(4, 32), *range(54, 110))}
    return {title: row for row, title in reversed(titles.items()) if title}


@pytest.mark.parametrize(("name", "cylinder"), [("gots-diesel", 1), ("gots-diesel", 3),
                                                ("ecoboost-10", 2), ("yamz-236", 5)])  # fmt: skip
def test_points_and_forces_at_72_angles(name: str, cylinder: int) -> None:
    engine, at = opened(name), rows(opened(name))
    data, _ = engine_and_cycle(model(name).input)
    solution = solve(data, _)
    table = "P4_1" if cylinder == 1 else f"cylinder_{cylinder}"
    geometry = data.geometry
    r, rod = float(geometry.crank_radius), float(geometry.rod_length)
    offset = float(solution.scalars.get("e_offset", 0.0))
    theta = next(f.value for f in model(name).inputs if f.name == f"firing_offset_{cylinder}_deg")
    engine.set_value(SHEET, at["Цилиндр"], 2, cylinder)
    top = np.sqrt((r + rod) ** 2 - offset**2)
    for step, angle in enumerate(ANGLES):
        engine.set_value(SHEET, at["Угол поворота вала φ"], 2, angle)
        engine.evaluate_all()
        psi = np.radians((angle - theta) % 720)

        def shown(title: str) -> float:
            return float(engine.get_value(SHEET, at[title], 2))

        crank = shown("Шатунная шейка: x"), shown("Шатунная шейка: y")
        pin = shown("Поршневой палец: x"), shown("Поршневой палец: y")
        assert crank == pytest.approx((1e3 * r * np.sin(psi), 1e3 * r * np.cos(psi)), abs=1e-9)
        down = displacement_exact(psi, np.array(r), np.array(r / rod), np.array(offset / r))
        assert pin == pytest.approx((1e3 * offset, 1e3 * (top - float(down))), abs=1e-9 * 1e3 * rod)
        for force in "PNSTK":
            key = {"P": "Ps_MPa"}.get(force, f"{force}_MPa")
            expected = solution.columns[table][key]
            scale = max(1.0, float(np.abs(expected).max()))
            assert abs(shown(f"Сила {force}") - expected[step]) <= TOLERANCE * scale
        total = solution.columns["P4_2"]["Msum_Nm"]
        actual = shown("Суммарный момент ΣM")
        assert abs(actual - total[step]) <= TOLERANCE * np.abs(total).max()


def at_all_angles(data: bytes, cylinder: int) -> bytes:
    """The book with a sheet of the mechanism for each of 72 angles: «М0», «М10» …"""
    built = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as given, zipfile.ZipFile(built, "w") as book:
        part = sheet_parts(given)[SHEET]
        root = etree.fromstring(given.read(part))
        for name in ("drawing", "legacyDrawing"):
            for element in root.findall(f"{MAIN}{name}"):
                root.remove(element)
        root.find(f".//{MAIN}c[@r='B5']/{MAIN}v").text = str(cylinder)
        sheets, relations, types = [], [], []
        for angle in ANGLES:
            root.find(f".//{MAIN}c[@r='B4']/{MAIN}v").text = str(angle)
            book.writestr(f"xl/worksheets/angle{angle}.xml", etree.tostring(root))
            about = f'name="М{angle}" sheetId="{9000 + angle}" r:id="angle{angle}"'
            sheets.append(f'<sheet xmlns:r="{_R}" {about}/>')
            relations.append(
                f'<Relationship Id="angle{angle}" Type="{_R}/worksheet"'
                f' Target="worksheets/angle{angle}.xml"/>'
            )
            override = f'PartName="/xl/worksheets/angle{angle}.xml" ContentType="{_T}"'
            types.append(f"<Override {override}/>")
        added = {
            "xl/workbook.xml": ("</sheets>", sheets),
            "xl/_rels/workbook.xml.rels": ("</Relationships>", relations),
            "[Content_Types].xml": ("</Types>", types),
        }
        for name in given.namelist():
            text = given.read(name)
            if name in added:
                end, lines = added[name]
                said = text.decode().replace(end, "".join(lines) + end)
                text = said.encode()
            book.writestr(name, text)
    return built.getvalue()


def test_libreoffice_draws_the_same_at_72_angles(libreoffice: LibreOffice) -> None:
    """Every cell of the sheet as formualizer has it, whose points are held to the solver above."""
    engine = opened("gots-diesel")
    at = rows(engine)
    (actual,) = libreoffice.recalculate([at_all_angles(book(), 3)])
    engine.set_value(SHEET, at["Цилиндр"], 2, 3)
    letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
    for angle in ANGLES:
        engine.set_value(SHEET, at["Угол поворота вала φ"], 2, angle)
        engine.evaluate_all()
        cells = actual[f"М{angle}"]
        assert len(cells) > 100
        for cell, value in cells.items():
            if len(cell.rstrip("0123456789")) > 1:
                continue
            row, column = int(cell[1:]), letters.index(cell[0]) + 1
            ours = engine.get_value(SHEET, row, column)
            assert value == pytest.approx(ours, abs=1e-9, rel=1e-12), (angle, cell)
