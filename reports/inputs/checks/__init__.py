"""Cross-checks of the input's fields."""
