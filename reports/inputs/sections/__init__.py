"""The sections of the input file as strict pydantic models."""
