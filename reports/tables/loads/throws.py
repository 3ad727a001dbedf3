"""Throws: centrifugal forces C1…C15 and constant reactions of the supports, Gots (44)-(49)."""

from __future__ import annotations

from reports.spec.blocks import Grid, GridRow, Scalar
from reports.spec.parts import Part, Scope
from reports.spec.shape import Shape
from reports.tables.loads.crankpins import SPLIT


def throws(scope: Scope) -> Part:
    """The grid of the throws."""
    return Part((_grid(scope.shape),))


def _grid(shape: Shape) -> Grid:
    throws = shape.throws
    columns = [_throw(i, shape) for i in range(1, throws + 1)]
    keys = list(dict.fromkeys(key for column in columns for key in column))
    return Grid(
        "throws",
        "Центробежные силы колен и реакции опор от них",
        "Колена",
        tuple(f"колено {i}" for i in range(1, throws + 1)),
        tuple(GridRow(key, tuple(column.get(key) for column in columns)) for key in keys),
        note=(
            "Ось y — вдоль колена от оси вала, ось x — поперёк него против вращения. Угол щеки "
            "отсчитан от колена против вращения, угол противовеса — от направления, обратного "
            "колену, по вращению; внешний противовес на носке — от первого колена по вращению, "
            "у маховика — от последнего колена против вращения. В (48) и (49) учебника знаки при "
            "C11 и C13 противоположны статике; здесь они исправлены."
        ),
    )


def _throw(i: int, shape: Shape) -> dict[str, Scalar]:
    throws, second = shape.throws, _has_second_rod(shape)
    left, right, t = f"web_{2 * i - 1}", f"web_{2 * i}", f"throw_{i}"
    unit = "r_crank*omega**2"

    def force(mass: str, turn: str) -> str:
        return f"{mass}*{unit}*{turn}"

    def webs(key: str, web: str, part: str, turn: str) -> tuple[str, str]:
        mass, degrees = (
            (f"{web}_counterweight_kg", f"{web}_counterweight_angle_deg")
            if part == "counterweight"
            else (f"{web}_mass_kg", f"{web}_angle_deg")
        )
        return key, force(mass, f"{turn}(rad({degrees}))")

    forces = dict(
        [
            webs("C1", left, "counterweight", "cos"),
            webs("C2", left, "web", "cos"),
            ("C3", f"m_2*{unit}"),
            ("C4", f"crankshaft_pin_mass_kg*{unit}{_split_share(shape)}"),
            webs("C6", right, "web", "cos"),
            webs("C7", right, "counterweight", "cos"),
            webs("C8", left, "counterweight", "sin"),
            webs("C9", right, "counterweight", "sin"),
            webs("C14", left, "web", "sin"),
            webs("C15", right, "web", "sin"),
        ]
    )
    if second:
        forces["C5"] = f"m_2*{unit}" + (f"*cos({SPLIT})" if shape.split else "")
    if shape.split:
        forces["C5x"] = f"-(m_2*{unit}*sin({SPLIT}))"
        forces["C4x"] = f"-(crankshaft_pin_mass_kg*{unit}*sin({SPLIT})/2)"
    if i == 1:
        nose = "rad(crankshaft_nose_angle_deg)"
        forces["C10"] = force("crankshaft_nose_mass_kg", f"sin({nose})")
        forces["C11"] = force("crankshaft_nose_mass_kg", f"cos({nose})")
    if i == throws:
        rear = "rad(crankshaft_rear_angle_deg)"
        forces["C12"] = force("crankshaft_rear_mass_kg", f"sin({rear})")
        forces["C13"] = force("crankshaft_rear_mass_kg", f"cos({rear})")
    h_left, h_right = f"{t}_left_web_mm", f"{t}_right_web_mm"
    rod = f"{t}_l1_mm + {h_left} + {t}_l2_mm"
    rest = f"{t}_l3_mm + {t}_l4_mm + {t}_l5_mm + {h_right} + {t}_l6_mm"
    arms = {
        "arm_left": f"{t}_l1_mm + {h_left}/2",
        "arm_rod": rod,
        "arm_pin": f"throw{i}_arm_rod + {t}_l3_mm",
        "arm_right": f"{t}_l6_mm + {h_right}/2",
    }
    if second:
        arms["arm_rod2"] = f"throw{i}_arm_pin + {t}_l4_mm"
    cells = {
        **{key: Scalar(f"throw{i}_{key}", text, "Гоц, рис. 35") for key, text in arms.items()},
        "length": Scalar(f"throw{i}_length", f"throw{i}_arm_rod + {rest}", "Гоц, рис. 35"),
        "share": Scalar(f"throw{i}_share", f"throw{i}_arm_rod/throw{i}_length", "Гоц (50)"),
        **_second_share(i, second=second),
        **{key: Scalar(f"throw{i}_{key}", text, "Гоц, рис. 35") for key, text in forces.items()},
        **_reactions(i, shape),
    }
    side = f"throw{i}_C14 + throw{i}_C8" + (f" - throw{i}_C10" if i == 1 else "")
    weights = " + ".join(f"{web}_counterweight_kg" for web in (left, right))
    cells["weights_kg"] = Scalar(f"throw{i}_weights_kg", weights, "исходные данные")
    cells["side"] = Scalar(f"throw{i}_side", side, "Гоц, рис. 35")
    return cells


def _has_second_rod(shape: Shape) -> bool:
    """Whether a second rod turns on the pin; an articulated one does not."""
    return not shape.single_rods and not shape.articulated


def _second_share(i: int, *, second: bool) -> dict[str, Scalar]:
    if not second:
        return {}
    share = f"throw{i}_arm_rod2/throw{i}_length"
    return {"share2": Scalar(f"throw{i}_share2", share, "Гоц (50)")}


def _split_share(shape: Shape) -> str:
    """Share of a split pin's force along the throw: half of it stands ahead."""
    return f"*(1 + cos({SPLIT}))/2" if shape.split else ""


def _reactions(i: int, shape: Shape) -> dict[str, Scalar]:
    throws, p = shape.throws, f"throw{i}_"
    length, left, right = f"{p}length", f"{p}arm_left", f"{p}arm_right"
    rod, pin = f"{p}arm_rod", f"{p}arm_pin"
    rkp = (
        f"(({p}C1 - {p}C2)*{left} - {p}C3*{rod} - {p}C4*{pin}"
        f" - ({p}C6 - {p}C7)*({length} - {right}))/{length}"
    )
    rtp = f"-((({p}C8 + {p}C14)*{left} + ({p}C9 + {p}C15)*({length} - {right}))/{length})"
    rkl = (
        f"(({p}C7 - {p}C6)*{right} - {p}C4*({length} - {pin}) - {p}C3*({length} - {rod})"
        f" - ({p}C2 - {p}C1)*({length} - {left}))/{length}"
    )
    rtl = f"-((({p}C9 + {p}C15)*{right} + ({p}C8 + {p}C14)*({length} - {left}))/{length})"
    far = f"{p}arm_rod2"
    if _has_second_rod(shape):
        rkp += f" - {p}C5*{far}/{length}"
        rkl += f" - {p}C5*({length} - {far})/{length}"
    if shape.split:
        rtp += f" - ({p}C5x*{far} + {p}C4x*{pin})/{length}"
        rtl += f" - ({p}C5x*({length} - {far}) + {p}C4x*({length} - {pin}))/{length}"
    sources = {"RKCP": "Гоц (44)", "RTCP": "Гоц (45)", "RKCL": "Гоц (46)", "RTCL": "Гоц (47)"}
    texts = {"RKCP": rkp, "RTCP": rtp, "RKCL": rkl, "RTCL": rtl}
    if i == 1:
        arm = "crankshaft_nose_arm_mm"
        texts["RKCP"] += f" + {p}C11*{arm}/{length}"
        texts["RTCP"] += f" - {p}C10*{arm}/{length}"
        texts["RKCL"] += f" - {p}C11*({arm} + {length})/{length}"
        texts["RTCL"] += f" + {p}C10*({arm} + {length})/{length}"
        sources = {key: f"{source}, (48)" for key, source in sources.items()}
    if i == throws:
        arm = "crankshaft_rear_arm_mm"
        texts["RKCP"] += f" - {p}C13*({arm} + {length})/{length}"
        texts["RTCP"] += f" - {p}C12*({arm} + {length})/{length}"
        texts["RKCL"] += f" + {p}C13*{arm}/{length}"
        texts["RTCL"] += f" + {p}C12*{arm}/{length}"
        sources = {key: f"{source}, (49)" for key, source in sources.items()}
    return {key: Scalar(f"{p}{key}", text, sources[key]) for key, text in texts.items()}
