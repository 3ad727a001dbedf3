"""What an engine's main data are held against: usual values, with what follows, and a prototype.

Comments of `new`, the note's chapter on the data and its conclusion take them from here; the
spans stand in `kshm.ranges`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from kshm.ranges import MASSES_BORES, RANGES, Ranges, Span
from reports.inputs.sections.input_file import InputFile
from reports.shared.errors import InputError, Problem
from reports.shared.russian import short

_BORE = "(2000*sqrt(F_piston/pi))"  # mm
FILM_REQUIRED = "bearings_reserve_allowed*oil_hcr_um"  # least film that carries [µm]
RODS = "rods_on_pin"  # a number beside the model's nodes
_MIN_BORE_MM = 1000 * MASSES_BORES["petrol"][0]  # of table 4
_SIMILAR = (
    f"таблица 4 пособия составлена для диаметров от {short(_MIN_BORE_MM)} мм, у подобных "
    "двигателей удельная масса пропорциональна диаметру"
)
_HEAVY = "растут силы инерции и нагрузки на подшипники"
_LIGHT = "сечения тоньше обычных, их прочность следует проверить отдельно"
_SHAFT = "растут трение в подшипниках и масса вала", "снижаются жёсткость и прочность вала"
# Keys of the file whose comments tell the span of a reason.
_COMMENTED = {
    "geometry.stroke_mm": "stroke_bore", "geometry.rod_length_mm": "lam",
    "geometry.lambda": "lam", "geometry.compression_ratio": "compression",
    "regime.speed_rpm": "piston_speed", "regime.mechanical_efficiency": "efficiency",
    "gas.max_pressure_mpa": "peak", "masses.rod_small_end_share": "rod_share",
    "crankshaft.pin_diameter_mm": "pin", "crankshaft.main_diameter_mm": "main",
}  # fmt: skip
PROTOTYPE_KEY = "prototype.file"


@dataclass(frozen=True, slots=True)
class Reason:
    """A ratio of the data: its formula over the model's nodes and its usual span.

    Attributes:
        key: its name.
        title: Russian title.
        tex: symbol.
        value: formulas, the first whose nodes the model has is taken.
        ranges: its usual range.
        unit: unit of the span.
        digits: decimals in print.
        above: what follows above the span.
        below: what follows below it.
        by_size: the span grows with the bore as that of table 4.
        one_rod: the span is that of a throw with one rod.
        required: formulas of what the calculation allows at least, if it does.
        least: formulas of the limit within it, and what follows between the two.
    """

    key: str
    title: str
    tex: str
    value: tuple[str, ...]
    ranges: Ranges
    unit: str
    digits: int
    above: str
    below: str
    by_size: bool = False
    one_rod: bool = False
    required: tuple[str, ...] = ()
    least: tuple[str, ...] = ()
    between: str = ""

    @property
    def place(self) -> str:
        """Section of the textbook that prints the span; empty where it is accepted."""
        return self.ranges.source.replace("Gots table", "табл.").replace("Gots", "п.")

    def below_at(self, bore_mm: float) -> str:
        """What follows below the span; a bore below those of the table is light by similarity."""
        small = self.by_size and bore_mm < _MIN_BORE_MM
        return _SIMILAR if small else self.below

    def span(self, kind: str, heavier: float = 1.0) -> Span:
        """Usual span of a kind of engine; of an unknown one that of both."""
        low, high = self.ranges.of(kind)
        return (low * heavier, high * heavier) if self.by_size else (low, high)

    def words(self, kind: str) -> str:
        """Return the span as a comment has it."""
        low, high = self.span(kind)
        return f"пределы {short(low)}…{short(high)}{f' {self.unit}' if self.unit else ''}"


REASONS: tuple[Reason, ...] = (
    Reason("stroke_bore", "Отношение хода поршня к диаметру цилиндра", "S/D",
           (f"1000*S_stroke/{_BORE}",), RANGES["stroke_bore"], "", 2,
           "растут скорость поршня и высота двигателя",
           "камера сгорания становится плоской, растут потери теплоты"),
    Reason("lam", "Отношение радиуса кривошипа к длине шатуна", r"\lambda",
           ("lam",), RANGES["lam"], "", 3,
           "растут боковая сила и силы инерции второго порядка",
           "растут высота и масса двигателя"),
    Reason("piston_speed", "Средняя скорость поршня", "c_m",
           ("c_m",), RANGES["piston_speed"], "м/с", 2,
           "растут силы инерции, тепловая напряжённость и износ",
           "двигатель тихоходный, масса на единицу мощности велика"),
    Reason("compression", "Степень сжатия", r"\varepsilon",
           ("geometry_compression_ratio",), RANGES["compression_ratio"], "", 1,
           "растут давление сгорания и нагрузки на детали", "снижается экономичность"),
    Reason("peak", "Наибольшее давление цикла", "p_z",
           ("cyc_p_z", "gas_max_pressure_mpa"), RANGES["combustion.p_z"], "МПа", 2,
           "растут нагрузки на шатун, шейки и подшипники",
           "диаграмма соответствует малой нагрузке"),
    Reason("efficiency", "Механический КПД", r"\eta_{\mathrm{м}}",
           ("cyc_eta_m", "regime_mechanical_efficiency"), RANGES["effective.eta_m"], "", 2,
           "потери на трение приняты малыми", "потери на трение приняты большими"),
    Reason("piston_mass", "Удельная масса поршневой группы",
           r"m_{\mathrm{п}}/F_{\mathrm{п}}", ("masses_piston_group_kg/F_piston",),
           RANGES["piston_mass"], "кг/м²", 1,
           _HEAVY, _LIGHT, by_size=True),
    Reason("rod_mass", "Удельная масса шатуна", r"m_{\mathrm{ш}}/F_{\mathrm{п}}",
           ("masses_rod_kg/F_piston",), RANGES["rod_mass"], "кг/м²", 1,
           _HEAVY, _LIGHT, by_size=True),
    Reason("throw_mass", "Удельная масса колена", r"m_{\mathrm{к}}/F_{\mathrm{п}}",
           ("m_k/F_piston",), RANGES["throw_mass"], "кг/м²", 1,
           "растёт центробежная сила, нужны тяжёлые противовесы",
           "колено легче обычного, его прочность следует проверить отдельно", by_size=True,
           one_rod=True),
    Reason("rod_share", "Доля массы шатуна у пальца", r"m_1/m_{\mathrm{ш}}",
           ("m_1/masses_rod_kg",), RANGES["rod_share"], "", 3,
           "растут возвратно-поступательно движущиеся массы", "растут вращающиеся массы"),
    Reason("pin", "Отношение диаметра шатунной шейки к диаметру цилиндра", r"d_{\mathrm{ш.ш}}/D",
           (f"crankshaft_pin_diameter_mm/{_BORE}",), RANGES["pin"], "", 2, *_SHAFT),
    Reason("main", "Отношение диаметра коренной шейки к диаметру цилиндра", r"d_{\mathrm{к.ш}}/D",
           (f"crankshaft_main_diameter_mm/{_BORE}",), RANGES["main"], "", 2, *_SHAFT),
    Reason("pin_length", "Отношение длины шейки под шатуном к её диаметру",
           r"l_{\mathrm{ш.ш}}/d_{\mathrm{ш.ш}}",
           (f"crankshaft_pin_length_mm/{RODS}/crankshaft_pin_diameter_mm",),
           RANGES["pin_length"], "", 2,
           "растут длина вала и его прогиб", "растёт давление на подшипник, плёнка тоньше"),
    Reason("pin_pressure", "Среднее давление на шатунный подшипник", r"q_{\mathrm{ср}}",
           ("q_pin_mean",), RANGES["pin_pressure"], "МПа", 2,
           "нужен более прочный слой вкладыша или большая шейка", "подшипник нагружен слабо"),
    Reason("pin_peak", "Наибольшее давление на шатунный подшипник", r"q_{\max}",
           ("q_pin_max",), RANGES["pin_peak"], "МПа", 2,
           "нужен более прочный слой вкладыша или большая шейка", "подшипник нагружен слабо"),
    Reason("film", "Наименьшая за цикл толщина масляной плёнки", r"h_{\mathrm{ц}}",
           ("value_oil_orbit*oil_hcr_um",), RANGES["film"], "мкм", 2,
           "подшипник нагружен слабо", "возможно касание неровностей шейки и вкладыша",
           required=(FILM_REQUIRED,), least=("oil_hcr_um",),
           between="неровности шейки и вкладыша не касаются, но запас до касания мал"),
)  # fmt: skip
_BY_KEY = {reason.key: reason for reason in REASONS}


def reason_of(key: str) -> Reason:
    """Return the reason of that name."""
    return _BY_KEY[key]


def usual_span(key: str, kind: str) -> Span:
    """Usual span of a reason for a kind of engine."""
    return _BY_KEY[key].span(kind)


def with_spans(notes: Mapping[str, str], kind: str) -> dict[str, str]:
    """Return notes on keys of a file, «section.key», with the usual spans of a kind of engine."""
    return {
        key: "; ".join(filter(None, (words, _BY_KEY[_COMMENTED[key]].words(kind))))
        if key in _COMMENTED
        else words
        for key, words in notes.items()
    }


def prototype_file(model: InputFile, beside: Path) -> Path | None:
    """Return the file of the prototype that an input names, if it names one.

    Raises:
        InputError: There is no such file, or it is no TOML.
    """
    name = "" if model.prototype is None else model.prototype.file.strip()
    if not name:
        return None
    path = beside / name
    if path.suffix.lower() != ".toml":
        problem, hint = f"{name} — не файл .toml", "укажите файл исходных данных"
        raise InputError(Problem(PROTOTYPE_KEY, problem, hint))
    if not path.is_file():
        problem, hint = f"нет файла {path}", "укажите файл от файла исходных данных"
        raise InputError(Problem(PROTOTYPE_KEY, problem, hint))
    return path
