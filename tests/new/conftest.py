"""Fixtures of the new engines of the parts."""

from tests.document.conftest import nothing_is_drawn

__all__ = ["nothing_is_drawn"]
