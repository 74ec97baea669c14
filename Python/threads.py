# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Threads of vtkSMPTools, which casts rays and runs filters."""
import os

from vtkmodules.vtkCommonCore import vtkSMPTools

VARIABLE = "VTK_SMP_BACKEND_IN_USE"


def use_threads() -> None:
    """Selects the backend STDThread in place of Sequential, VTK's default in wheels.

    A backend that the environment names or that was selected before stays, and so does a number of
    threads (vtkSMPTools.Initialize()). Sequential is selected by the environment, or after this.
    """
    if VARIABLE not in os.environ and vtkSMPTools.GetBackend() == "Sequential":
        vtkSMPTools.SetBackend("STDThread")
