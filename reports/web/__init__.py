"""Web pages over the commands; no calculation of their own."""
