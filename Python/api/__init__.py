# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""Functions on meshes and arrays, which are attributes of the package meniscus and, those that take
a mesh, methods of mesh.meniscus."""

# Module of each function. They are loaded when they are first used, because some need PyVista.
MODULES = {
    "plot": "volumes",
    "add_to": "volumes",
    "pick": "picking",
    "compare": "comparison",
    "radiograph": "rays",
    "integral": "rays",
    "schlieren": "schlieren",
    "zernike": "schlieren",
    "mirage": "mirages",
    "apparent": "mirages",
    "refracted": "refraction",
    "true_positions": "points",
    "triangulate": "points",
}
# Packages without which a module cannot be loaded.
PACKAGES = {
    "volumes": ("numpy", "pyvista"),
    "picking": ("numpy", "pyvista"),
    "comparison": ("numpy", "pyvista"),
    "refraction": ("numpy", "pyvista"),
    "schlieren": ("numpy",),
    "mirages": ("numpy",),
    "points": ("numpy",),
}
