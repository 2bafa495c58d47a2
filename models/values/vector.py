"""The array type of every signature."""

from typing import Any, TypeAlias

import numpy as np

Vector: TypeAlias = np.ndarray[Any, np.dtype[np.float64]]
"""An array of floats of any shape. The shape parameter is open because pydrake's stubs
put the element type there, so that an NDArray would never match them."""
