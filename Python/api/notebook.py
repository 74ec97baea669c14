# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""PyVista's backends for notebooks that can show volumes."""
import importlib.util

# Packages of the interactive backends.
_PACKAGES = ("trame", "trame_vtk", "trame_vuetify", "ipywidgets")
_DRAWN_IN_BROWSER = ("client", "html")


def choose_backend(name):
    """Name of the backend for plotter.show(); None stands for the best that is installed."""
    if name in _DRAWN_IN_BROWSER:
        raise ValueError("The notebook backend '%s' draws in the browser, which has no mapper for "
                         "these volumes; use \"server\" or \"static\"" % name)
    missing = [package for package in _PACKAGES if importlib.util.find_spec(package) is None]
    if name is None:
        return "static" if missing else "server"
    if name in ("trame", "server") and missing:
        raise ImportError("The notebook backend '%s' needs packages that are not installed: "
                          "pip install 'pyvista[jupyter]'" % name)
    return "server" if name == "trame" else name
