"""The sheet of dynamics: diagrams, schemes and tables of one engine on A1 or A2."""
