"""Expressions of motion that tables in Python name: acceleration, articulated rod, rod's share."""

from __future__ import annotations

from kshm.engine.usual import SMALL_END_SHARE
from reports.inputs.sections.input_file import METHODS, InputFile
from reports.inputs.units import number_text
from reports.spec.blocks import Column
from reports.spec.shape import Shape

SUFFIX = "_art"
SOURCE = "геометрия, Гоц, рис. 2 в"
BANK = "rad(crankshaft_bank_angle_deg)"
RHO, _LENGTH = "of_mm(articulated_radius_mm)", "of_mm(articulated_rod_length_mm)"
USUAL_SHARE = f"доля массы шатуна на поршневом пальце {'…'.join(map(number_text, SMALL_END_SHARE))}"


def is_usual_share(name: str) -> str:
    """Expression that tells whether the share of that name is usual, its ends included."""
    low, high = SMALL_END_SHARE
    return f"round({name}, 6) >= {low:g} and round({name}, 6) <= {high:g}"


def acceleration(model: InputFile, phi: str, beta: str) -> str:
    """Piston acceleration by the chosen method; the choice stays live in the workbook."""
    own = f" + lam*k_offset*sin(rad({phi}))" if Shape.of(model).offset else ""
    two_term = f"r_crank*omega**2*(cos(rad({phi})) + lam*cos(2*rad({phi})){own})"
    exact = (
        f"r_crank*omega**2*(cos(rad({phi}) + {beta})/cos({beta})"
        f" + lam*cos(rad({phi}))**2/cos({beta})**3)"
    )
    return f'({exact}) if calculation_method == "{METHODS["exact"]}" else ({two_term})'


def hung_ratio(height: str) -> str:
    """V/V_c from the height of the piston pin [m]."""
    return f"1 + (geometry_compression_ratio - 1)*(y_tdc_art - ({height}))/S_art"


def hung_height(shape: Shape, phi: str) -> str:
    """Height of the piston pin over the shaft [m] in one expression."""
    alpha = f"(rad({phi}) + {BANK})"
    offset, k = ("e_offset", "k_offset") if shape.offset else ("0", "0")
    chi = f"(rad(articulated_angle_deg) - {BANK} - asin(lam*(sin({alpha}) - {k})))"
    across = f"(r_crank*sin(rad({phi})) + {RHO}*sin({chi}) - {offset})"
    return f"r_crank*cos(rad({phi})) + {RHO}*cos({chi}) + sqrt({_LENGTH}**2 - {across}**2)"


def hung_helpers(shape: Shape, phi: str) -> list[Column]:
    """Columns of the linkage at an angle [deg] that the formulas of a table name.

    Derivatives are by the crank angle; lengths in metres.
    """
    alpha = f"(rad({phi}) + {BANK})"
    offset, k = ("e_offset", "k_offset") if shape.offset else ("0", "0")
    sine = f"(sin({alpha}) - {k})"
    root = f"(1 - lam**2*{sine}**2)"
    links = {
        "beta_master_rad": f"asin(lam*{sine})",
        # (18) and (19) over ω and ω².
        "turn_1": f"lam*cos({alpha})/sqrt{root}",
        "turn_2": f"lam*(lam**2*cos({alpha})**2*{sine} - {root}*sin({alpha}))/{root}**1.5",
        "chi_rad": f"rad(articulated_angle_deg) - {BANK} - beta_master_rad",
        "q_x": f"r_crank*sin(rad({phi})) + {RHO}*sin(chi_rad)",
        "q_y": f"r_crank*cos(rad({phi})) + {RHO}*cos(chi_rad)",
        "q_x1": f"r_crank*cos(rad({phi})) - turn_1*{RHO}*cos(chi_rad)",
        "q_y1": f"turn_1*{RHO}*sin(chi_rad) - r_crank*sin(rad({phi}))",
        # Towards the crank axis, along the radius to the crankpin, across it.
        "q_x2": f"-(r_crank*sin(rad({phi}))) - {RHO}*(turn_1**2*sin(chi_rad)"
                " + turn_2*cos(chi_rad))",
        "q_y2": f"-(r_crank*cos(rad({phi}))) - {RHO}*(turn_1**2*cos(chi_rad)"
                " - turn_2*sin(chi_rad))",
        "beta_rad": f"asin((q_x - {offset})/{_LENGTH})",
        "own_1": f"q_x1/({_LENGTH}*cos(beta_rad))",
        "own_2": f"(q_x2/{_LENGTH} + sin(beta_rad)*own_1**2)/cos(beta_rad)",
        "y": f"q_y + {_LENGTH}*cos(beta_rad)",
        "y_1": f"q_y1 - {_LENGTH}*sin(beta_rad)*own_1",
        "y_2": f"q_y2 - {_LENGTH}*(cos(beta_rad)*own_1**2 + sin(beta_rad)*own_2)",
    }  # fmt: skip
    return [
        Column(key, text, SOURCE, helper=True, of=key if key.endswith("rad") else f"hung_{key}")
        for key, text in links.items()
    ]
