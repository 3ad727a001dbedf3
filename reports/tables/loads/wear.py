"""The oil hole of a journal by its wear diagram."""

from __future__ import annotations

from reports.spec.blocks import Scalar
from reports.spec.listing import scalar_list
from reports.spec.shape import rays_table


def hole_scalars(name: str) -> tuple[Scalar, ...]:
    """Least loaded ray, of equal ones the middle of the widest arc, and the oil hole opposite."""
    key, number = f"hole_{name}", name.removeprefix("pin")
    table = rays_table(int(number)) if number.isdigit() else "table_14"
    if name.startswith("main"):
        table = f"table_14_main_{name.removeprefix('main')}"
    arcs = f"{table}_sums.ray_arc"
    middle = f"first_largest({arcs}) - floor(col_max({arcs})/2)"
    return scalar_list(f"""
        {key}_ray = mod({middle} - 1, calculation_wear_rays) + 1 | Гоц, рис. 33
        {key}_deg = mod(({key}_ray - 1)*360/calculation_wear_rays + 180, 360) | Гоц, 2.6
    """)
