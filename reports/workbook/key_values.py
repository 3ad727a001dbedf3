"""Values that the first sheets tell: title, symbol, formula, value, number format.

Of several crankpins the most loaded one's stand for all.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf, isfinite

from kshm.nomenclature.quantity import Quantity
from reports.inputs.fields import Field
from reports.model.blocks import Model
from reports.model.shape import WORST_PIN, Shape, most_loaded_pin, pin_name
from reports.shared.russian import capital
from reports.workbook import styles
from reports.workbook.inputs import shown
from reports.workbook.sheets import BlockWriter

RESULTS = (
    "cyc_N_e", "N_e_calc", "M_mean", "M_e", "N_i_calc", "p_i_calc", "M_max", "phi_M_max_deg",
    "M_min", "c_m", "j_tdc",
    "worst_pin_load", "Rpin_mean", "Rpin_max", "q_pin_max", "hole_pin_deg", "worst_main_load",
    "worst_main_torque", "delta_work", "I_flywheel",
)  # fmt: skip
# Of the crankpins: where there are several, the most loaded one's.
_OF_PINS = {
    "Rpin_mean": "Rpin{}_mean", "Rpin_max": "Rpin{}_max", "q_pin_max": "q_pin{}_max",
    "hole_pin_deg": "hole_pin{}_deg",
}  # fmt: skip
NOUGHT = {"I_flywheel": "не нужен"}  # what a zero says, in words
_WORST_PIN = (
    ("шатунную шейку", "наиболее нагруженную"), ("шатунной шейки", "наиболее нагруженной"),
)  # fmt: skip


def results_of(model: Model) -> tuple[str, ...]:
    """Keys of what came out; the oil hole is where the film puts it, as the report says."""
    if "oil_film1_deg" not in model.scalars:
        return RESULTS
    key = "crankshaft_oil_hole_deg"
    hole = (key,) if key in model.fields else ("oil_film1_deg", "oil_film2_deg")
    at = RESULTS.index("hole_pin_deg")
    return (*RESULTS[:at], *hole, *RESULTS[at + 1 :])


def key_values(
    writer: BlockWriter, keys: Sequence[str]
) -> Iterator[tuple[str, Field | Quantity, str, float | str, str, str]]:
    """Title, whose symbol, formula, value, unit and number format of what the book has."""
    model, values = writer.layout.model, writer.values.scalars
    known_keys = [key for key in keys if key in model.scalars and _finite(values.get(key, inf))]
    typed = [model.fields[key].value for key in keys if key in model.fields]
    decimals = styles.decimals_of([*typed, *(model.scalars[key].quantity for key in known_keys)])
    for key in keys:
        if key in model.fields:
            field = model.fields[key]
            yield (
                field.title,
                field,
                f"={key}",
                shown(field),
                field.unit,
                styles.typed_format(field.value, decimals),
            )
        elif key in known_keys:
            quantity = model.scalars[key].quantity
            look = styles.excel_format(quantity, decimals)
            formula, value = _of_worst_pin(writer, key)
            title = capital(quantity.title)
            if formula != f"={key}":
                for words, more in _WORST_PIN:
                    title = title.replace(words, f"{more} {words}")
            yield title, quantity, formula, value, quantity.unit_label, look


def nought_words(key: str) -> str:
    """Return the rest of a number format: minus and words for a zero of a value that has them."""
    return f';General;"{NOUGHT[key]}"' if key in NOUGHT else ""


def _of_worst_pin(writer: BlockWriter, key: str) -> tuple[str, float | str]:
    """Return the formula and value of a scalar, of the most loaded pin where each has its own."""
    values = writer.values.scalars
    if key not in _OF_PINS or WORST_PIN not in values:
        return f"={key}", values[key]
    count = len(Shape.of(writer.layout.model.input).pins)
    keys = [_OF_PINS[key].format(pin_name(number)) for number in range(1, count + 1)]
    return f"=CHOOSE({WORST_PIN},{','.join(keys)})", values[keys[worst_pin(writer) - 1]]


def worst_pin(writer: BlockWriter) -> int:
    """Return the number of the most loaded pin; the first where a student is to find it."""
    return most_loaded_pin(writer.values.scalars)


def _finite(value: float | str) -> bool:
    return isinstance(value, str) or isfinite(value)
