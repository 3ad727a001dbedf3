"""Check of the [counterweight] section: a sector needs room between its radii."""

from __future__ import annotations

from collections.abc import Iterator

from kshm.defaults import SKIRT_SHARE
from reports.inputs.findings import Finding
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.masses import Sizes
from reports.inputs.units import number_text


def check_counterweight(model: InputFile, sizes: Sizes) -> Iterator[Finding]:
    """Yield an error where the outer radius, stated or left by the piston, is no larger."""
    section, shaft = model.counterweight, model.crankshaft
    if section is None:
        return
    main = shaft.main_diameter_mm or (shaft.main_diameters_mm or (0.0,))[0]
    inner = section.inner_mm or main / 2
    skirt = section.skirt_mm or SKIRT_SHARE * sizes.bore
    outer = section.outer_mm or sizes.rod - sizes.radius - skirt - section.play_mm
    if outer > inner:
        return
    stated = section.outer_mm is not None
    key = "outer_mm" if stated else "inner_mm" if section.inner_mm is not None else "skirt_mm"
    radii = f"{number_text(round(outer, 2))} мм не больше внутреннего {number_text(inner)} мм"
    left = "наружный радиус противовеса" if stated else "радиус, свободный под поршнем,"
    hint = "увеличьте его" if stated else "удлините шатун или уменьшите внутренний радиус"
    yield Finding(("counterweight", key), f"{left} {radii}", hint)
