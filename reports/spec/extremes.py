"""Extremes of a column with the first angle at which they are reached."""

from __future__ import annotations

from reports.spec.blocks import Column, Scalar

# Equal extremes may differ in the last bit between spreadsheet programs.
TIE = "0.000001"


def extreme_columns(column: str, name: str) -> tuple[Column, ...]:
    """Helper columns: the angle where the value is the extreme, the last angle elsewhere."""
    high, low = f"{name}_max", f"{name}_min"
    return (
        Column(
            "at_max_deg",
            f"phi_deg if {column} > {high} - {TIE} else col_last(phi_deg)",
            "вспомогательный",
            helper=True,
        ),
        Column(
            "at_min_deg",
            f"phi_deg if {column} < {low} + {TIE} else col_last(phi_deg)",
            "вспомогательный",
            helper=True,
        ),
    )


def extreme_scalars(table: str, column: str, name: str, source: str) -> tuple[Scalar, ...]:
    """Largest and smallest value of a column and their angles."""
    return (
        Scalar(f"{name}_max", f"col_max({table}.{column})", source),
        Scalar(f"phi_{name}_max_deg", f"col_min({table}.at_max_deg)", source),
        Scalar(f"{name}_min", f"col_min({table}.{column})", source),
        Scalar(f"phi_{name}_min_deg", f"col_min({table}.at_min_deg)", source),
    )
