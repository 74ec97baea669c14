# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the opacity unit distance and the opacity function do to a volume."""
from meniscus.viewer.sample import make_sample

from . import common

PAPER = ((1.0, 1.0, 1.0), (1.0, 1.0, 1.0))
# Shares of the mesh's diagonal; the ball's diameter is 0.58 of it.
DISTANCES = ((1.0, "the whole diagonal"), (0.1, "a tenth of it"),
             (0.01, "a hundredth of it"))
FUNCTIONS = ((((0.0, 1.0), (1.0, 1.0)), "opacity 1 everywhere"),
             (((0.0, 0.0), (1.0, 1.0)), "a ramp"),
             (((0.0, 0.0), (0.35, 0.0), (0.45, 1.0), (0.55, 0.0), (0.85, 0.0), (1.0, 1.0)),
              "two ranges of values"))


def _make_panel(mesh, points, distance, label, size):
    low, high = common.get_range(mesh)
    colors = common.make_colors(common.VIRIDIS, low, high)
    opacity = common.make_opacity((low + (high - low) * share, value) for share, value in points)
    look = common.make_look(colors, opacity, distance * mesh.GetLength())
    renderer = common.make_renderer(PAPER)
    renderer.AddVolume(common.make_volume(mesh, look))
    common.look_from(renderer, (2.6, 1.6, 3.0), (0.0, 0.05, 0.0), (0, 1, 0), 34.0)
    renderer.ResetCameraClippingRange()
    common.add_label(renderer, label, size[1], (0.12, 0.14, 0.18))
    return renderer


def _make_plume():
    mesh = make_sample()
    mesh.GetPointData().SetActiveScalars("plume")
    return mesh


def draw_distances(_, size):
    """One ramp of opacity over three unit distances."""
    panel = (2 * size[0] // 3, size[1])
    ramp = FUNCTIONS[1][0]
    mesh = _make_plume()
    return common.take_beside(
        [_make_panel(mesh, ramp, distance, label, panel) for distance, label in DISTANCES], panel)


def draw_functions(_, size):
    """Three functions over a tenth of the diagonal."""
    panel = (2 * size[0] // 3, size[1])
    mesh = _make_plume()
    return common.take_beside(
        [_make_panel(mesh, points, 0.1, label, panel) for points, label in FUNCTIONS], panel)
