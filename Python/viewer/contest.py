# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A mesh drawn by VTK's volume mappers and by ours, side by side with times and differences."""
from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleUser
from vtkmodules.vtkRenderingCore import (
    vtkActor2D, vtkImageMapper, vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor,
    vtkTextActor)

from ..rivals import Comparison, compare_mappers, join_tetrahedra
from .cells import drawn_leaves_of
from .files import ReadingError
from .levels import values_of
from .pictures import make_window
from .reading import arrays_of

# Columns of the picture.
_COLUMNS = 2
_INK = (1.0, 1.0, 1.0)
TITLE = f"{'mapper':22}{'frame, ms':>12}{'first, ms':>12}{'RMS of 255':>12}"


def format_row(found: Comparison) -> str:
    """A line below TITLE."""
    return (f"{found.name:22}{found.milliseconds:12.1f}{found.first_milliseconds:12.1f}"
            f"{found.rms:12.2f}")


def _make_grid(scene: Any, association: str) -> Any:
    leaves = [leaf for leaf in drawn_leaves_of(scene.get_drawn())
              if _attributes_of(leaf, association).HasArray(scene.array)]
    values = [values_of(_attributes_of(leaf, association).GetArray(scene.array), None)
              for leaf in leaves]
    return join_tetrahedra(leaves, values, association == "points")


def _attributes_of(leaf: Any, association: str) -> Any:
    return leaf.GetPointData() if association == "points" else leaf.GetCellData()


def compare_on(scene: Any, size: Sequence[int]) -> Iterator[tuple[Comparison, Any]]:
    """Draws the volume of a MeshScene from its view with each mapper; yields pairs as
    rivals.compare_mappers(). size: of the picture of all of them.

    What VTK's mappers cannot draw is a ReadingError.
    """
    if scene.blend != "composite" or scene.is_lit() or scene.clip_axis or scene.has_surface():
        raise ReadingError("--compare draws what VTK's mappers can: the blend mode composite, "
                           "without --light, --shadows, --clip and --water")
    association, _ = arrays_of(scene.data)[scene.array]
    width, height = (max(length // _COLUMNS, 1) for length in size)
    renderer = vtkRenderer()
    renderer.AddVolume(scene.volume)
    camera = renderer.GetActiveCamera()
    camera.DeepCopy(scene.renderer.GetActiveCamera())
    scene.fit_camera(camera, width / height)
    renderer.ResetCameraClippingRange()
    window = make_window(renderer, (width, height), offscreen=True)
    yield from compare_mappers(window, renderer, scene.volume,
                               lambda: _make_grid(scene, association), association == "points")
    window.Finalize()


def _make_image(pixels: Any) -> Any:
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    flat = numpy.ascontiguousarray(pixels.reshape(-1, 3))
    image.GetPointData().SetScalars(numpy_to_vtk(flat, deep=True))
    return image


def _make_panel(found: Comparison, pixels: Any) -> Any:
    """A renderer with a picture and its figures."""
    mapper = vtkImageMapper()
    mapper.SetInputData(_make_image(pixels))
    mapper.SetColorWindow(255)
    mapper.SetColorLevel(127.5)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddViewProp(actor)
    # The longest name fits into a picture of 220 pixels at full size.
    scale = min(1.0, pixels.shape[1] / 220)
    lines = (found.name, f"{found.milliseconds:.1f} ms", f"RMS {found.rms:.2f} of 255")
    for index, line in enumerate(lines):
        text = vtkTextActor()
        text.SetInput(line)
        text.SetPosition(12 * scale, pixels.shape[0] - (26 + 20 * index) * scale)
        text.GetTextProperty().SetFontSize(round((18 if index == 0 else 15) * scale))
        text.GetTextProperty().SetBold(index == 0)
        text.GetTextProperty().SetColor(*_INK)
        renderer.AddViewProp(text)
    return renderer


def make_panels(pairs: Sequence[tuple[Comparison, Any]], offscreen: bool) -> Any:
    """A window with the pictures of compare_on() and their figures."""
    rows = (len(pairs) + _COLUMNS - 1) // _COLUMNS
    height, width, _ = pairs[0][1].shape
    window = vtkRenderWindow()
    window.SetOffScreenRendering(offscreen)
    window.SetSize(width * _COLUMNS, height * rows)
    window.SetWindowName("Meniscus")
    for index, (found, pixels) in enumerate(pairs):
        panel = _make_panel(found, pixels)
        left, row = index % _COLUMNS, rows - 1 - index // _COLUMNS
        panel.SetViewport(left / _COLUMNS, row / rows, (left + 1) / _COLUMNS, (row + 1) / rows)
        window.AddRenderer(panel)
    return window


def show_panels(window: Any) -> None:
    """Shows the panels until q is pressed or the window is closed."""
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    interactor.SetInteractorStyle(vtkInteractorStyleUser())

    def press(*_: Any) -> None:
        if interactor.GetKeySym() == "q":
            interactor.TerminateApp()

    interactor.AddObserver("KeyPressEvent", press)
    window.Render()
    interactor.Start()
    window.Finalize()
