"""Many numbers at once: parameter studies, comparison of engines, validation against print."""
