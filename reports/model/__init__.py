"""What a table is, and how its expressions are evaluated."""
