# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""The command `meniscus`: draws meshes from files as volumes, in a window, a page or a picture.

files: data of single files, with all of their arrays.
series: time steps and parts that a file names.
cells: which cells are drawn, and damaged ones.
reading: meshes, time steps and surfaces from files.
levels: isosurface areas of a scalar, and the transfer function that is derived from them.
curves: opacities as points that can be dragged, and the functions of mappers.
furniture: outline, axes and edges.
scene: the volume and its settings; has no window of its own.
pictures: pictures without a window on the screen.
window, web: a desktop window with keys and sliders, and a page served by trame.
chart: the histogram and the curve of opacity in the window.
contest: VTK's mappers and ours side by side.
watching: files that change.
guard: files that crash the library that reads them.
options: options from the command line and from a file.
command: arguments and messages.
"""
