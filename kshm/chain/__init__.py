"""The chain of forces: engines by cylinders by crank angles in one numpy pass."""
