"""The [strength] section of the input file: sizes, materials and forms of the parts' strength."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from kshm.engine.strength import PartStrength
from kshm.ranges import PART_SHARES
from reports.inputs.meta import USUAL, StrictModel, choice, named, number
from reports.inputs.units import CELSIUS, DEG, KELVIN, KG, MM, MPA, NONE, UM

KINDS = {"petrol": "с искровым зажиганием", "diesel": "дизель"}
PISTONS = {"aluminium": "алюминиевый сплав", "iron": "чугун"}
CROWNS = {"full": "p(r/δ)²", "quarter": "0,25p(d/δ)²"}
PINS = {"minus": "Pz − k|Pj|", "plus": "Pz + kPj со знаком"}
OVALS = {"curved": "(1 + 2α)/α внутри", "program": "(2 + α)/α внутри"}
BOLTS = {"each": "на каждый болт", "all": "на все болты вместе"}


@dataclass(frozen=True, slots=True)
class PartMaterial:
    """Limits [MPa]: tensile, yield, bending and pull, both symmetric; E [MPa]; α [1/K]."""

    label: str
    tensile: float
    yielding: float
    bending: float
    pull: float
    modulus: float
    expansion: float


# From memory of the books in use, without a source that was held against.
PART_MATERIALS = {
    "45": PartMaterial("45", 700.0, 360.0, 300.0, 220.0, 2.2e5, 1.0e-5),
    "45g2": PartMaterial("45Г2", 800.0, 420.0, 340.0, 210.0, 2.2e5, 1.0e-5),
    "40h": PartMaterial("40Х", 980.0, 800.0, 350.0, 300.0, 2.2e5, 1.0e-5),
    "40hn": PartMaterial("40ХН", 1200.0, 1000.0, 500.0, 380.0, 2.2e5, 1.0e-5),
    "18h2n4va": PartMaterial("18Х2Н4ВА", 1100.0, 850.0, 540.0, 380.0, 2.2e5, 1.0e-5),
}
PART_NAMES = {key: material.label for key, material in PART_MATERIALS.items()}


def _size(key: str) -> float | None:
    """Return a size of a part; left out it is its usual share."""
    assert key in PART_SHARES
    return number(*named(f"st_{key}_mm"), MM, 0.05, 3000, None)  # type: ignore[no-any-return]


class StrengthSection(StrictModel, usual=(PartStrength,)):
    """[strength]: a size that is not given is its usual share, which the workbook names."""

    kind: Literal["petrol", "diesel"] = choice("Вид двигателя", KINDS, USUAL, structural=True)
    crown_form: Literal["full", "quarter"] = choice(
        "Формула днища поршня", CROWNS, USUAL, structural=True
    )
    pin_form: Literal["minus", "plus"] = choice("Сила на палец", PINS, USUAL, structural=True)
    oval_form: Literal["curved", "program"] = choice(
        "Овализация пальца", OVALS, USUAL, structural=True
    )
    bolt_form: Literal["each", "all"] = choice("Нагрузка болтов", BOLTS, USUAL, structural=True)
    speed_factor: float = number(
        "Отношение наибольшей частоты вращения к частоте режима", "ω_max/ω", NONE, 1, 1.5, USUAL
    )
    piston_material: Literal["aluminium", "iron"] = choice(
        "Материал поршня", PISTONS, USUAL, structural=True
    )
    piston_kg: float | None = number(*named("st_m_piston"), KG, 0.001, 5000, None)
    crown_mm: float | None = _size("crown")
    height_mm: float | None = _size("height")
    skirt_mm: float | None = _size("skirt")
    head_wall_mm: float | None = _size("head_wall")
    land_mm: float | None = _size("land")
    bosses_mm: float | None = _size("bosses")
    ring_radial_mm: float | None = _size("ring_radial")
    ring_gap_mm: float | None = _size("ring_gap")
    ring_play_mm: float = number("Радиальный зазор кольца в канавке", "Δt", MM, 0.05, 20, USUAL)
    oil_holes: float = number("Число масляных отверстий в канавке", "n_м", NONE, 0, 40, USUAL)
    oil_hole_mm: float = number("Диаметр масляного отверстия в канавке", "d_отв", MM, 0, 30, USUAL)
    head_play: float = number(
        "Отношение зазора головки поршня к диаметру цилиндра", "Δ_г/D", NONE, 0.0005, 0.02, USUAL
    )
    skirt_play: float = number(
        "Отношение зазора юбки поршня к диаметру цилиндра", "Δ_ю/D", NONE, 0.0002, 0.01, USUAL
    )
    cylinder_c: float = number(
        "Температура стенки цилиндра", "t_ц", CELSIUS, 40, 300, USUAL, solver="cylinder_temperature"
    )
    head_c: float = number(
        "Температура головки поршня", "t_гол", CELSIUS, 60, 500, USUAL, solver="head_temperature"
    )
    skirt_c: float = number(
        "Температура юбки поршня", "t_ю", CELSIUS, 40, 350, USUAL, solver="skirt_temperature"
    )
    ring_modulus_mpa: float = number("Модуль упругости кольца", "E_к", MPA, 2e4, 3e5, USUAL)
    pin_mm: float | None = _size("pin")
    pin_bore_mm: float | None = _size("pin_bore")
    pin_length_mm: float | None = _size("pin_length")
    pin_share: float = number("Доля силы инерции поршня на пальце", "k_п", NONE, 0.5, 1, USUAL)
    pin_modulus_mpa: float = number("Модуль упругости пальца", "E_п", MPA, 5e4, 3e5, USUAL)
    eye_length_mm: float | None = _size("eye_length")
    eye_outer_mm: float | None = _size("eye_outer")
    bush_wall_mm: float | None = _size("bush_wall")
    bush_fit_um: float = number("Натяг втулки", "Δ_в", UM, 0, 500, USUAL)
    bush_warming_k: float = number("Нагрев верхней головки", "ΔT_г", KELVIN, 0, 300, USUAL)
    bush_modulus_mpa: float = number("Модуль упругости втулки", "E_в", MPA, 5e4, 3e5, USUAL)
    embedding_deg: float = number("Угол заделки верхней головки", "φ_з", DEG, 90, 130, USUAL)
    rod_material: Literal["45", "45g2", "40h", "40hn", "18h2n4va"] = choice(
        "Материал шатуна", PART_NAMES, "40h"
    )
    bolt_material: Literal["45", "45g2", "40h", "40hn", "18h2n4va"] = choice(
        "Материал болтов", PART_NAMES, "40hn"
    )
    web_material: Literal["45", "45g2", "40h", "40hn", "18h2n4va"] = choice(
        "Материал щёк", PART_NAMES, "45"
    )
    rod_concentration: float = number(
        "Отношение коэффициента концентрации к масштабному: шатун", "k/ε_ш", NONE, 0.5, 6, USUAL
    )
    bolt_concentration: float = number(
        "Отношение коэффициента концентрации к масштабному: болт", "k/ε_б", NONE, 0.5, 8, USUAL
    )
    web_concentration: float = number(
        "Отношение коэффициента концентрации к масштабному: щека", "k/ε_щ", NONE, 0.5, 6, USUAL
    )
    mean_factor: float = number("Приведение асимметричного цикла", "α_σ", NONE, 0, 0.6, USUAL)
    shank_height_mm: float | None = _size("shank_height")
    shank_width_mm: float | None = _size("shank_width")
    shank_web_mm: float | None = _size("shank_web")
    shank_flange_mm: float | None = _size("shank_flange")
    bolts_apart_mm: float | None = _size("bolts_apart")
    cap_length_mm: float | None = _size("cap_length")
    shell_mm: float | None = _size("shell")
    bolts: float = number("Число шатунных болтов", "i_б", NONE, 1, 8, USUAL)
    bolt_mm: float | None = _size("bolt")
    bolt_pitch_mm: float = number("Шаг резьбы болта", "t_р", MM, 0.25, 10, USUAL)
    bolt_preload: float = number("Отношение затяжки к нагрузке болта", "k_з", NONE, 1, 6, USUAL)
    bolt_share: float = number("Доля нагрузки на болт", "χ_б", NONE, 0.05, 0.6, USUAL)
    web_width_mm: float | None = number(*named("web_width_mm"), MM, 2, 5000, None)
    web_thickness_mm: float | None = number(
        "Толщина щеки, где её не задают размеры колена", "h_щ", MM, 1, 2000, None
    )
    safety_allowed: float = number("Допускаемый запас прочности частей", "[n]_д", NONE, 1, 10, 1.5)
