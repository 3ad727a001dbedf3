"""The [sheet] section of the input file: what stands on the sheet of dynamics."""

from __future__ import annotations

from typing import Literal

from reports.inputs.meta import Strictly, choice

DIAGRAMS = {
    "pv": "индикаторная диаграмма свёрнутая",
    "p_phi": "индикаторная диаграмма развёрнутая",
    "forces": "удельные силы газов, инерции, суммарная",
    "side": "силы N и S",
    "crank": "силы K и T",
    "torque": "суммарный крутящий момент со средним",
    "pin_polar": "полярная диаграмма шатунной шейки",
    "pin_load": "развёрнутая нагрузка на шатунную шейку",
    "pin_wear": "диаграмма износа шатунной шейки",
    "main_polar": "полярная диаграмма коренной шейки",
    "main_load": "развёрнутая нагрузка на коренную шейку",
    "main_wear": "диаграмма износа коренной шейки",
    "shaft": "схема вала, звезда колен, порядок работы",
    "balance": "схема уравновешивания",
    "running": "таблица набегающих моментов",
    "results": "основные результаты",
    "throw": "колено вала с размерами",
    "mechanism": "механизм с размерами",
}
Diagram = Literal[
    "pv", "p_phi", "forces", "side", "crank", "torque", "pin_polar", "pin_load", "pin_wear",
    "main_polar", "main_load", "main_wear", "shaft", "balance", "running", "results",
    "throw", "mechanism",
]  # fmt: skip
USUAL = ("pv", "p_phi", "forces", "side", "crank", "torque", "pin_polar", "pin_load", "pin_wear",
         "main_wear", "shaft", "balance", "running", "results", "throw")  # fmt: skip
SHEETS = {"A1": "A1, 841 × 594 мм", "A2": "A2, 594 × 420 мм"}
WAYS = {"landscape": "альбомная", "portrait": "книжная"}


class SheetSection(Strictly):
    """[sheet]: size of the sheet and what stands on it."""

    size: Literal["A1", "A2"] = choice("Формат листа", SHEETS, "A1")
    orientation: Literal["landscape", "portrait"] = choice("Ориентация листа", WAYS, "landscape")
    diagrams: tuple[Diagram, ...] | None = choice("Лист: место {n}", DIAGRAMS, None)
