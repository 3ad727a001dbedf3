"""The prototype of a new engine: the sample that is nearest to it in kind and sizes."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from reports.inputs.checks.bands import stated_kind
from reports.inputs.firing import order_text
from reports.inputs.load import load_toml
from reports.inputs.sections.input_file import LAYOUTS, InputFile
from reports.inputs.units import number_text
from reports.model.shape import Shape
from reports.shared.resources import samples_dir
from reports.shared.russian import cylindered

_NEAR = math.log(1.15)  # of the logarithms of D and S: farther off, it is another engine
_DIESEL_RATIO = 14.0
_OF_SECTIONS = {
    "geometry": ("rod_length_mm", "compression_ratio"),
    "regime": ("speed_rpm", "mechanical_efficiency"),
    "gas": ("max_pressure_mpa",),
    "masses": ("piston_group_kg", "rod_kg"),
    "crankshaft": ("pin_diameter_mm", "main_diameter_mm"),
}


def prototype_for(model: InputFile, kind: str) -> tuple[dict[str, Any], str] | None:
    """Section [prototype] by the nearest sample and the name of that; None if none is near."""
    geometry = model.geometry
    bore, stroke = getattr(geometry, "bore_mm", None), _stroke(geometry.model_dump())
    if not bore or not stroke:
        return None
    engine, near = model.engine, list[tuple[float, str]]()
    for name, like, sizes in _samples():
        away = [abs(math.log(a / b)) for a, b in zip((bore, stroke), sizes, strict=True)]
        if like == (engine.cylinders, engine.layout, engine.strokes, kind) and max(away) <= _NEAR:
            near.append((sum(away), name))
    return _section(min(near)[1]) if near else None


@lru_cache(maxsize=1)
def _samples() -> tuple[tuple[str, tuple[int, str, int, str], tuple[float, float]], ...]:
    """Name, what kind of engine it is, bore and stroke [mm] of the samples."""
    return tuple(_found(samples_dir()))


def _found(folder: Path) -> Iterator[tuple[str, tuple[int, str, int, str], tuple[float, float]]]:
    for path in sorted(folder.glob("*.toml")):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        engine, geometry = data["engine"], data["geometry"]
        stroke, bore = _stroke(geometry), geometry.get("bore_mm")
        if bore and stroke:
            burnt = "diesel" if geometry["compression_ratio"] >= _DIESEL_RATIO else "petrol"
            like = (engine["cylinders"], engine.get("layout", "inline"),
                    engine.get("strokes", 4), burnt)  # fmt: skip
            yield path.stem, like, (bore, stroke)


def _stroke(geometry: Mapping[str, Any]) -> float | None:
    radius = geometry.get("crank_radius_mm")
    return geometry.get("stroke_mm") or (2 * radius if radius else None)


@lru_cache(maxsize=8)
def _section(name: str) -> tuple[dict[str, Any], str]:
    """Main values of a sample and the description of its design."""
    sample = load_toml(samples_dir() / f"{name}.toml").model
    section: dict[str, Any] = {
        "name": sample.engine.name,
        "description": f"{described(sample)} Данные — по образцу {name}.",
        "cylinders": sample.engine.cylinders,
        "bore_mm": getattr(sample.geometry, "bore_mm", None),
        "stroke_mm": _stroke(sample.geometry.model_dump()),
    }
    for part, keys in _OF_SECTIONS.items():
        section |= {key: getattr(getattr(sample, part), key, None) for key in keys}
    return {key: value for key, value in section.items() if value is not None}, name


def described(model: InputFile) -> str:
    """Return the design of an engine in a sentence or two."""
    engine, shape, shaft = model.engine, Shape.of(model), model.crankshaft
    row = "" if engine.cylinders == 1 else f"{LAYOUTS[engine.layout]} "
    strokes = "двухтактный" if engine.strokes == 2 else "четырёхтактный"
    nouns = {"diesel": "дизель", "petrol": "двигатель с искровым зажиганием"}
    noun = nouns.get(stated_kind(model) or "", "двигатель")
    words = [f"{row}{strokes} {cylindered(engine.cylinders)} {noun}"]
    if engine.layout == "v" and shaft.bank_angle_deg is not None:
        words.append(f"угол развала {number_text(shaft.bank_angle_deg)}°")
    journals = f"колен {shape.throws}, коренных шеек {shape.throws + 1}"
    sizes = [f"диаметр шатунных {number_text(shaft.pin_diameter_mm)} мм"
             if shaft.pin_diameter_mm else "",
             f"коренных {number_text(shaft.main_diameter_mm)} мм"
             if shaft.main_diameter_mm else ""]  # fmt: skip
    order = order_text(shaft.firing_offsets_deg, shape.period) if engine.cylinders > 1 else ""
    weights = any(web.counterweight_kg for web in shaft.webs)
    more = [f"порядок работы {order}" if order else "",
            "противовесы на щеках" if weights else "щёки без противовесов"]  # fmt: skip
    first = ", ".join(filter(None, words))
    return f"{first}. Вал: {', '.join(filter(None, [journals, *sizes, *more]))}."
