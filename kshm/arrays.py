"""Kinds of values that every room of numbers shares."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Columns = dict[str, Array]  # by the key of the quantity
Tables = dict[str, Columns]  # by the id of the table
Scalars = dict[str, float]
Results = tuple[Tables, Scalars]
