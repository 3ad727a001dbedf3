"""Tables of the gas pressure: indicator diagrams and the working cycle."""
