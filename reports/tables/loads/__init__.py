"""Tables of forces, torques and loads on pins and journals, Gots 2.5-2.8."""
