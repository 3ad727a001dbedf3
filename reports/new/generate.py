"""Engines of usual values as commented input files: ``kshm new --cylinders …``.

The rules are data: gas data, sizes and pressures for a power in `sizing`, the crankshaft
over the bore by layout here, the phases in `default_firing`.  The ratios of the crankshaft are
those of Kolchin and Demidov («Расчет автомобильных и тракторных двигателей», sizes of
crankshafts), by memory; the opposed ones are those of the sample vw-1600; masses are table 4
of the textbook.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from typing import Any

import tomlkit

from kshm.engine.masses import Estimate
from kshm.mechanics.masses import area_masses
from kshm.ranges import PISTON_MASSES, ROD_MASSES, THROW_MASSES
from reports.inputs.load import load_mapping
from reports.inputs.meta import StrictModel, hints
from reports.inputs.reasons import with_spans
from reports.inputs.registry import SECTIONS, records
from reports.inputs.sections.input_file import LAYOUTS
from reports.inputs.template import NUMBER_WORDS
from reports.inputs.to_si.masses import PIN_SHARE, ROD_SHARE, Sizes
from reports.inputs.units import number_text, span_text
from reports.new.counterweights import counterweights_for
from reports.new.default_firing import Phases, phases
from reports.new.part_sizes import parts_for
from reports.new.prototypes import prototype_for
from reports.new.sizing import (
    EngineTask,
    main_sizes,
    pin_within,
    pressures_for,
    size_notes,
    usual_for,
)
from reports.new.working_cycle import cycle_for
from reports.shared.russian import cylindered

# Two rods share a pin: its mass over table 4, as of the sample yamz-238.
_SHARED_PIN = 1.4
Notes = dict[str, str]
FIRST = ("engine", "geometry", "regime", "gas", "cycle")  # what is to be given
LINE = "──── дальше — необязательное: подставлены обычные значения ────"


@dataclass(frozen=True, slots=True)
class Ratios:
    """The crankshaft: diameters over the bore, lengths over diameters, web over the bore.

    ``pin_length`` is that under all the rods of a pin; ``counterweights`` is the share of the
    rotating masses that they take.
    """

    pin: float
    pin_length: float
    main: float
    main_length: float
    web: float
    counterweights: float = 1.0


SHAFTS: dict[tuple[str, str], Ratios] = {
    ("inline", "petrol"): Ratios(0.65, 0.6, 0.78, 0.52, 0.21),
    ("inline", "diesel"): Ratios(0.68, 0.58, 0.8, 0.52, 0.245),
    ("v", "petrol"): Ratios(0.6, 0.9, 0.7, 0.5, 0.21, 0.8),
    ("v", "diesel"): Ratios(0.68, 0.9, 0.75, 0.52, 0.245, 0.8),
    ("opposed", "petrol"): Ratios(0.62, 0.4, 0.64, 0.4, 0.14),
    ("opposed", "diesel"): Ratios(0.66, 0.4, 0.7, 0.4, 0.15),
}


@dataclass(frozen=True, slots=True)
class NewEngine:
    """An engine as a mapping of the file, notes to its keys by «section.key», words above it."""

    data: dict[str, Any]
    notes: Notes
    head: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ShaftSizes:
    """Journals and webs [mm]; ``pin_length`` of the whole pin, ``main_lengths`` from the nose."""

    pin: float
    pin_length: float
    main: float
    main_lengths: tuple[float, ...]
    web: float
    notes: Notes = field(default_factory=dict)


def generate_engine(
    cylinders: int,
    *,
    layout: str = "inline",
    strokes: int = 4,
    kind: str = "petrol",
    strength: bool = False,
    cycle: bool = False,
    **values: float | None,
) -> NewEngine:
    """Engine for a task, ``values`` as fields of `EngineTask`; usual values elsewhere.

    ``strength`` adds sizes of piston, pin and rod, usual ones that follow the load; ``cycle``
    gives the working cycle, from which the pressures follow.

    Raises:
        InputError: there is no such engine.
    """
    task, timing = EngineTask(**values), phases(cylinders, layout, strokes)
    usual = usual_for(kind, strokes, task)
    bore, stroke, speed = main_sizes(task, usual, cylinders, strokes)
    swept = math.pi * bore**2 / 4 * stroke * cylinders
    power = usual.effective_mpa * swept * speed / (30 * strokes * 1e6)  # MPa·mm³/s = 1e-3 W
    data = {
        "engine": _engine(cylinders, layout, strokes, _named(kind, layout, cylinders, strokes)),
        "geometry": {
            "bore_mm": bore,
            "stroke_mm": stroke,
            **_rod(task, stroke, usual.lam),
            "compression_ratio": usual.ratio,
        },
        "regime": {"speed_rpm": speed, "mechanical_efficiency": usual.efficiency},
        "gas": {"source": "polytropic", **usual.gas},
    }
    sizes = usual_shaft(layout, kind, bore, throws_of(cylinders, layout))
    masses, throw = table_masses(layout, kind, bore, stroke)
    data["masses"], data["crankshaft"] = masses, shaft(layout, timing, sizes, throw)
    model = load_mapping(data, source="kshm new").model
    notes = size_notes(task, usual, stroke, speed)
    words = f"из обычных значений: около {number_text(round(power, 1))} кВт"
    if task.power_kw is not None:
        words = f"по заданию: {number_text(task.power_kw)} кВт"
    if cycle:
        new_cycle = cycle_for(data, usual, kind, task.power_kw)
        data["gas"], data["cycle"] = new_cycle.gas, new_cycle.cycle
        notes |= new_cycle.notes
        model = load_mapping(data, source="kshm new").model
    elif task.power_kw is not None:
        found_gas = pressures_for(model, task.power_kw, kind)
        data["gas"] |= found_gas.gas
        data["regime"]["indicated_power_kw"] = found_gas.indicated_kw
        notes |= found_gas.notes
        model = load_mapping(data, source="kshm new").model
    if (pin := pin_within(model, kind, bore)) is not None:
        sizes = larger_pin(sizes, *pin)
        data["crankshaft"] = shaft(layout, timing, sizes, throw)
    weights = counterweights_for(data)
    data["crankshaft"]["webs"] = [
        {**web, "counterweight_kg": weights.reduced_kg} for web in data["crankshaft"]["webs"]
    ]
    data["counterweight"] = weights.section
    near = prototype_for(model, kind)
    if near is not None:
        data["prototype"] = near[0]
        notes["prototype.name"] = f"по образцу {near[1]}: ближайший по виду, числу цилиндров, D и S"
    head = (
        f"Двигатель составлен {words} при {number_text(speed)} мин⁻¹, "
        f"рабочий объём {number_text(round(swept / 1e6, 2))} л.",
    )
    if strength:
        whole = load_mapping(data, source="kshm new").model
        data["strength"], parts = parts_for(whole, kind, sizes.pin)
        notes |= parts
    notes = {**notes, **throw.notes, **sizes.notes, **timing_notes(timing), **weights.notes}
    return NewEngine(data, with_spans(notes, kind), head)


def _rod(task: EngineTask, stroke: float, lam: float) -> dict[str, float]:
    if task.lambda_ is not None:
        return {"lambda": task.lambda_}
    return {"rod_length_mm": task.rod_mm or round(stroke / 2 / lam, 1)}


def _engine(cylinders: int, layout: str, strokes: int, name: str) -> dict[str, Any]:
    return {"name": name, "cylinders": cylinders, "layout": layout, "strokes": strokes}


def _named(kind: str, layout: str, cylinders: int, strokes: int) -> str:
    words = "двухтактный" if strokes == 2 else "четырёхтактный"
    # The kind that burns petrol burns gas and ethanol as well: the spark is what they share.
    noun = "Дизель" if kind == "diesel" else "Двигатель с искровым зажиганием"
    row = "" if cylinders == 1 else f"{LAYOUTS[layout]}, "
    return f"{noun}: {row}{words}, {cylindered(cylinders)}"


def rods_of(layout: str) -> int:
    """Rods side by side on a pin: two of a V engine share one."""
    return 2 if layout == "v" else 1


def throws_of(cylinders: int, layout: str) -> int:
    """Return the number of throws."""
    return cylinders // rods_of(layout)


def usual_shaft(layout: str, kind: str, bore: float, throws: int) -> ShaftSizes:
    """Journals and webs over the bore."""
    ratios = SHAFTS[layout, kind]
    pin, main = round(ratios.pin * bore, 1), round(ratios.main * bore, 1)
    length = round(ratios.main_length * main, 1)
    notes = {
        "crankshaft.pin_diameter_mm": f"обычно {number_text(ratios.pin)} D",
        "crankshaft.pin_length_mm": f"обычно {number_text(ratios.pin_length)} d"
        + (" под двумя шатунами" if rods_of(layout) == 2 else ""),
        "crankshaft.main_diameter_mm": f"обычно {number_text(ratios.main)} D",
        "crankshaft.main_lengths_mm": f"обычно {number_text(ratios.main_length)} d",
        "crankshaft.arms.left_web_mm": f"обычно {number_text(ratios.web)} D",
    }
    return ShaftSizes(
        pin, round(ratios.pin_length * pin, 1), main, (length,) * (throws + 1),
        round(ratios.web * bore, 1), notes,
    )  # fmt: skip


def larger_pin(sizes: ShaftSizes, diameter: float, length: float) -> ShaftSizes:
    """Sizes with another crankpin [mm], the main journals as thick at least."""
    words = "по давлению на подшипник шатуна"
    notes = {
        "crankshaft.pin_diameter_mm": words if diameter > sizes.pin else "",
        "crankshaft.pin_length_mm": words,
        "crankshaft.main_diameter_mm": "не тоньше шатунной" if diameter > sizes.main else "",
    }
    remarks = {key: text for key, text in notes.items() if text}
    return replace(sizes, pin=diameter, pin_length=length, main=max(sizes.main, diameter),
                   notes=sizes.notes | remarks)  # fmt: skip


@dataclass(frozen=True, slots=True)
class ThrowMasses:
    """Masses of a throw [kg] by table 4, and of a web's counterweight."""

    pin: float
    web: float
    counterweight: float
    notes: Notes


def table_masses(
    layout: str, kind: str, bore: float, stroke: float, share: float = ROD_SHARE
) -> tuple[dict[str, Any], ThrowMasses]:
    """Section [masses] and the masses of a throw by table 4 of the textbook."""
    size = Sizes(bore, stroke / 2, stroke)
    area = size.piston_area * size.heavier
    estimate = area_masses(Estimate(fuel="diesel" if kind == "diesel" else "petrol"),
                       bore / 1000, stroke / 1000)  # fmt: skip
    rods = rods_of(layout)
    pin = estimate.throw * PIN_SHARE * (_SHARED_PIN if rods == 2 else 1.0)
    web = estimate.throw * (1 - PIN_SHARE) / 2
    rotating = pin + 2 * web + rods * (1 - share) * estimate.rod
    taken = rotating * SHAFTS[layout, kind].counterweights
    larger = f" × {number_text(round(size.heavier, 2))} для такого D" if size.heavier > 1 else ""
    piston, rod, throw = (
        f"таблица 4: {span_text(low, high)} кг/м², принято {value:.0f}{larger}"
        for (low, high), value in (
            (PISTON_MASSES["aluminium", kind], estimate.piston),
            (ROD_MASSES[kind], estimate.rod),
            (THROW_MASSES["steel", kind], estimate.throw),
        )
    )
    notes = {
        "masses.piston_group_kg": piston,
        "masses.rod_kg": rod,
        "masses.rod_small_end_share": "обычная",
        "crankshaft.pin_mass_kg": f"колено: {throw}"
        + ("; шейка длиннее: под двумя шатунами" if rods == 2 else ""),
        "crankshaft.webs.counterweight_kg": "берёт вращающиеся массы колена: "
        f"{SHAFTS[layout, kind].counterweights:.0%}".replace("%", " %"),
    }
    masses = {
        "piston_group_kg": _inside(
            estimate.piston * area, PISTON_MASSES["aluminium", kind], estimate.piston
        ),
        "rod_kg": _inside(estimate.rod * area, ROD_MASSES[kind], estimate.rod),
        "rod_small_end_share": share,
    }
    throw_span = THROW_MASSES["steel", kind]
    return masses, ThrowMasses(
        _inside(pin * area, throw_span, estimate.throw),
        _inside(web * area, throw_span, estimate.throw),
        _grams(taken * area / 2),
        notes,
    )


def _inside(value: float, bounds: tuple[float, float], taken: float) -> float:
    """Return a mass to four digits, rounded away from the nearer bound of the value ``taken``."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 3)
    up = taken < sum(bounds) / 2
    # What has four digits already is noise away from a whole number of units.
    steps = round(value / unit, 6)
    return _grams((math.ceil if up else math.floor)(steps) * unit)


def _grams(value: float) -> float:
    """Return a mass to four significant digits."""
    return float(f"{value:.4g}")


def shaft(layout: str, timing: Phases, sizes: ShaftSizes, masses: ThrowMasses) -> dict[str, Any]:
    """Section [crankshaft]: phases, journals, two webs and the arms of every throw."""
    section: dict[str, Any] = {}
    if timing.bank_deg is not None and layout == "v":
        section["bank_angle_deg"] = timing.bank_deg
    if timing.order:
        section["firing_order"] = timing.order
    else:
        section["firing_offsets_deg"] = list(timing.offsets)
    section |= {
        "throw_angles_deg": list(timing.angles),
        "pin_diameter_mm": sizes.pin,
        "pin_length_mm": sizes.pin_length,
        "main_diameter_mm": sizes.main,
        "main_lengths_mm": list(sizes.main_lengths),
        "pin_mass_kg": masses.pin,
    }
    webs = {"mass_kg": masses.web, "counterweight_kg": masses.counterweight}
    throws = len(timing.angles)
    section["webs"] = [dict(webs) for _ in range(2 * throws)]
    section["arms"] = [_arms(layout, sizes, number) for number in range(throws)]
    return section


def _arms(layout: str, sizes: ShaftSizes, number: int) -> dict[str, float]:
    """Figure 35: half a main journal, half the pin under a rod, and so to the other side."""
    half = round(sizes.pin_length / rods_of(layout) / 2, 6)
    left, right = (round(sizes.main_lengths[number + side] / 2, 6) for side in (0, 1))
    between = {"l3_mm": half, "l4_mm": half} if layout == "v" else {}
    return {
        "l1_mm": left, "l2_mm": half, **between, "l5_mm": half, "l6_mm": right,
        "left_web_mm": sizes.web, "right_web_mm": sizes.web,
    }  # fmt: skip


def timing_notes(timing: Phases) -> Notes:
    """Return notes on the phases."""
    bank = "угол из обычных для такого числа цилиндров; впишите свой вместе с фазами"
    memory = "по памяти: сверьте со своим"
    return {
        "crankshaft.bank_angle_deg": bank,
        "crankshaft.firing_order": f"обычный для такого двигателя, {memory}",
        "crankshaft.firing_offsets_deg": f"порядок работы {timing.sequence}, {memory}",
        "crankshaft.throw_angles_deg": "следуют из порядка работы",
        "crankshaft.arms.l1_mm": "половина коренной шейки",
        "crankshaft.arms.l2_mm": "половина шейки под шатуном",
    }


def file_text(engine: NewEngine) -> str:
    """Return the engine as a commented input file."""
    lines = [f"# {line}" for line in (*engine.head, *NUMBER_WORDS)]
    others = [name for name in SECTIONS if name not in FIRST and name in engine.data]
    for name in (each for each in FIRST if each in engine.data):
        lines += ["", *_section(name, engine.data[name], engine.notes)]
    lines += ["", f"# {LINE}"]
    for name in others:
        lines += ["", *_section(name, engine.data[name], engine.notes)]
    books = dict(engine.data.get("books", ()))
    lines += ["", "[books] # тексты своих книг"] if books else []
    lines += [f"{tomlkit.key(name).as_string()} = {_text(text)}" for name, text in books.items()]
    for name, values in (engine.data.get("own") or {}).items():
        lines += ["", *_keys(f"own.{name}", values, {}, {}, f"[own.{name}]")]
    if "report" not in engine.data:
        lines += ["", "[report] # фамилия, группа и вуз для титульного листа"]
        lines += ['student = ""', 'group = ""', 'institution = ""']
        lines += [f"year = {datetime.now(tz=UTC).year}"]
    for regime in engine.data.get("regimes", ()):
        gas = {"gas": regime["gas"]}
        plain = {key: value for key, value in regime.items() if key != "gas"}
        lines += ["", *_keys("regimes", plain, {}, {}, "[[regimes]]")]
        lines += ["", *_keys("gas", gas["gas"], {}, {}, "[regimes.gas]")]
    return "\n".join(lines) + "\n"


def _text(text: str) -> str:
    """Return a text of many lines as TOML writes it."""
    return tomlkit.string(text, literal="'''" not in text, multiline=True).as_string()


def _section(name: str, values: Mapping[str, Any], notes: Notes) -> Iterator[str]:
    section = SECTIONS[name]
    model = section.sources.get(str(values.get("source")), section.model)
    lists = {key: values[key] for key, _ in records(model) if key in values}
    plain = {key: value for key, value in values.items() if key not in lists}
    yield from _keys(name, plain, notes, _titles(model), f"[{name}] # {section.title.lower()}")
    for key, inner in records(model):
        for number, entry in enumerate(lists.get(key, ())):
            # The entries of a made shaft are alike: the first one is explained.
            titles = _titles(inner) if number == 0 else {}
            comments = notes if number == 0 else {}
            head = f"[[{name}.{key}]] # {number + 1}"
            yield ""
            yield from _keys(f"{name}.{key}", entry, comments, titles, head)


def _titles(model: type[StrictModel]) -> dict[str, str]:
    titles = {}
    for key, spec in hints(model).items():
        for meta in spec.metas[:1]:
            titles[key] = meta.title.rpartition("{n}: ")[2]  # which entry the heading says
            options = meta.choices or {}
            if any(word != label for word, label in options.items()) and len(options) < 5:
                words = ", ".join(f"{word} — {label}" for word, label in options.items())
                titles[key] += f": {words}"
    return titles


def _keys(
    path: str, values: Mapping[str, Any], notes: Notes, titles: Mapping[str, str], head: str
) -> Iterator[str]:
    yield head
    for key, value in values.items():
        words = [titles.get(key, ""), notes.get(f"{path}.{key}", "")]
        comment = ": ".join(word for word in words if word)
        text = tomlkit.item(_plain(value)).as_string()
        yield f"{key} = {text}" + (f" # {comment}" if comment else "")


def _plain(value: Any) -> Any:  # noqa: ANN401
    """Value without needless fractions, tuples as lists."""
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e9:
        return int(value)
    return value
