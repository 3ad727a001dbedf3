"""The [torsion] section of the input file: train, damping, range of speeds, damper."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Strict

from kshm.engine.torsion import Torsion
from reports.inputs.meta import USUAL, StrictModel, choice, named, number, text
from reports.inputs.units import KG_M2, MM, MPA, NM_RAD, NMS_RAD, NONE, RPM

FORMULAS = {
    "wilson": "Кер-Вильсон",
    "carter": "Картер",
    "zimanenko": "Зиманенко",
}
DAMPERS = {"viscous": "вязкостный", "tuned": "настроенный"}
LEAST, MOST = 1e-6, 1e7  # kg·m²
SOFT, HARD = 1.0, 1e12  # N·m/rad


class MassSection(StrictModel):
    """[[torsion.masses]]: a mass of a train given directly, from the nose."""

    name: str = text("Масса {n}: название", "")
    inertia_kg_m2: float = number("Масса {n}: момент инерции", "J_{n}", KG_M2, LEAST, MOST)
    stiffness_nm_rad: float = number(
        "Масса {n}: жёсткость участка за ней (за последней — до заделки, 0 — конец свободен)",
        "c_{n}", NM_RAD, 0, HARD, 0.0,
    )  # fmt: skip
    diameter_mm: float | None = number("Масса {n}: диаметр вала за ней", "D_{n}", MM, 1, 5000, None)
    throw: float = number(
        "Масса {n}: номер колена, 0 — без шатунов", "k_{n}", NONE, 0, 24, 0.0, structural=True
    )


class PeakSection(StrictModel):
    """[[torsion.peaks]]: the greatest pressure of the cycle at a speed."""

    speed_rpm: float = number("Точка {n}: частота вращения", "n_т{n}", RPM, 10, 60000)
    pressure_mpa: float = number("Точка {n}: наибольшее давление цикла", "p_zт{n}", MPA, 0.2, 100)


class TorsionSection(StrictModel, usual=(Torsion,)):
    """[torsion]: a key that is not given is estimated from the rest of the file."""

    pulley_kg_m2: float | None = number("Момент инерции шкива", "J_шк", KG_M2, LEAST, MOST, None)
    throws_kg_m2: tuple[float, ...] | None = number(
        "Колено {n}: момент инерции", "J_к{n}", KG_M2, LEAST, MOST, None
    )
    flywheel_kg_m2: float | None = number(*named("tor_flywheel"), KG_M2, LEAST, MOST, None)
    driven_kg_m2: float | None = number(
        "Момент инерции за маховиком", "J_пр", KG_M2, LEAST, MOST, None
    )
    nose_nm_rad: float | None = number(
        "Жёсткость от шкива до первого колена", "c_н", NM_RAD, SOFT, HARD, None,
        solver="nose_stiffness",
    )  # fmt: skip
    throws_nm_rad: tuple[float, ...] | None = number(
        "Жёсткость за коленом {n}", "c_к{n}", NM_RAD, SOFT, HARD, None, solver="throw_stiffness"
    )
    rear_nm_rad: float | None = number(
        "Жёсткость от последнего колена до маховика", "c_м", NM_RAD, SOFT, HARD, None,
        solver="rear_stiffness",
    )  # fmt: skip
    driven_nm_rad: float | None = number(
        "Жёсткость за маховиком", "c_пр", NM_RAD, SOFT, HARD, None, solver="driven_stiffness"
    )
    ground_nm_rad: float = number(
        "Жёсткость от первой массы до заделки, 0 — конец свободен", "c_0", NM_RAD, 0, HARD, USUAL
    )
    formula: Literal["wilson", "carter", "zimanenko"] = choice(
        "Формула приведённой длины", FORMULAS, "wilson"
    )
    shear_modulus_mpa: float = number("Модуль сдвига", "G", MPA, 1e4, 2e5, USUAL)
    main_bore_mm: float = number("Диаметр отверстия коренных шеек", "d_о.к", MM, 0, 2000, USUAL)
    pin_bore_mm: float = number("Диаметр отверстия шатунных шеек", "d_о.ш", MM, 0, 2000, USUAL)
    web_width_mm: float | None = number(*named("tor_bw"), MM, 2, 5000, None)
    web_thickness_mm: float | None = number(*named("tor_hw"), MM, 1, 2000, None)
    damping_nms_rad: float | None = number(
        "Сопротивление в каждом цилиндре", "b_ц", NMS_RAD, 0, 1e6, None
    )
    loss_factor: float = number("Коэффициент потерь вала", "η_в", NONE, 0, 0.5, USUAL)
    speed_min_rpm: float | None = number(*named("tor_n_min"), RPM, 10, 60000, None)
    speed_max_rpm: float | None = number(*named("tor_n_max"), RPM, 10, 60000, None)
    stress_allowed_mpa: float = number(
        "Допускаемая амплитуда напряжений кручения", "[τ]", MPA, 1, 500, 30.0
    )
    other_flywheel_kg_m2: float | None = number(
        "Другой маховик для сравнения", "J_м2", KG_M2, LEAST, MOST, None
    )
    damper: Literal["viscous", "tuned"] = choice("Гаситель на первой массе", DAMPERS, "viscous")
    damper_kg_m2: float | None = number(
        *named("tor_ring"), KG_M2, LEAST, MOST, None, solver="damper_inertia"
    )
    damper_nm_rad: float | None = number(
        "Жёсткость настроенного гасителя", "c_г", NM_RAD, SOFT, HARD, None,
        solver="damper_stiffness",
    )  # fmt: skip
    damper_nms_rad: float | None = number(
        *named("tor_damper_b"), NMS_RAD, 0, 1e8, None, solver="damper_damping"
    )
    masses: Annotated[tuple[MassSection, ...], Strict(False)] = ()
    peaks: Annotated[tuple[PeakSection, ...], Strict(False)] = ()
