# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Threads of vtkSMPTools, which casts rays and runs filters."""
import os
from typing import Callable

from vtkmodules.vtkCommonCore import vtkSMPTools

VARIABLE = "VTK_SMP_BACKEND_IN_USE"


def use_threads() -> None:
    """Selects the backend STDThread in place of Sequential, VTK's default in wheels.

    A backend that the environment names or that was selected before stays, and so does a number of
    threads (vtkSMPTools.Initialize()). Sequential is selected by the environment, or after this.
    """
    if VARIABLE not in os.environ and vtkSMPTools.GetBackend() == "Sequential":
        vtkSMPTools.SetBackend("STDThread")


def run_blocks(body: Callable[[int, int], None], size: int, block: int) -> None:
    """Calls body(first, last) for blocks that cover [0, size), on as many threads as vtkSMPTools
    has. Loops of numpy run outside of Python's lock.
    """
    from concurrent.futures import ThreadPoolExecutor
    firsts = range(0, size, block)
    with ThreadPoolExecutor(vtkSMPTools.GetEstimatedNumberOfThreads()) as pool:
        for _ in pool.map(lambda first: body(first, min(first + block, size)), firsts):
            pass  # raises the exceptions of the calls
