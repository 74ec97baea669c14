# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Types of arguments, for type checkers."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Union

import numpy
import numpy.typing
import pyvista

Array = numpy.typing.NDArray[Any]
Floats = numpy.typing.NDArray[numpy.float64]
# What numpy.asarray() makes an array of numbers of.
ArrayLike = numpy.typing.ArrayLike
Mesh = Union[pyvista.DataSet, pyvista.MultiBlock]
# A surface: a dataset, or (points, triangles) of the shapes (n, 3) and (m, 3).
Surface = Union[pyvista.DataSet, pyvista.MultiBlock, "tuple[ArrayLike, ArrayLike]"]
Surfaces = Union[Surface, "list[Surface]"]
# Index behind each surface; or indices of all media, the eye's first; or pairs, one per surface.
Indices = Union[float, Sequence[float], Sequence["tuple[float, float]"]]
