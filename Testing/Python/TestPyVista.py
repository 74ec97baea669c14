# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""meniscus.pyvista compared with images of the same scene made by other means; skipped without
PyVista.

The exit status is then 125, which CTest counts as skipped.
"""
import itertools
import sys
import unittest

try:
    import pyvista
except ImportError:
    print("skipped: no pyvista")
    sys.exit(125)

import numpy
from meniscus import vtkTetrahedraRayCastMapper
from meniscus.pyvista import add_volume
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction, vtkVolume

SIZE = 150
CELLS = 12
LIMITS = (3.0, 8.0)
# Entries of a table as PyVista keeps them, in bytes, so that results are not rounded.
OPACITIES = (numpy.arange(256) // 3).astype(numpy.uint8)
ENTRIES = numpy.linspace(0.0, 1.0, 256)


def make_image():
    image = pyvista.ImageData(dimensions=(CELLS + 1,) * 3)
    image["height"] = image.points[:, 2].astype(float)
    return image


def picture_of(fill):
    """The image, as integers, of a plotter to which fill(plotter) adds a volume."""
    plotter = pyvista.Plotter(off_screen=True, window_size=(SIZE, SIZE))
    plotter.set_background("black")
    fill(plotter)
    plotter.camera_position = [(40.0, 25.0, 20.0), (6.0, 6.0, 6.0), (0.0, 0.0, 1.0)]
    picture = plotter.screenshot(return_img=True)
    plotter.close()
    return picture[:, :, :3].astype(int)


def add_explicitly(plotter, mesh, cmap):
    """The same volume with a mapper and functions created here."""
    colors = vtkColorTransferFunction()
    opacity = vtkPiecewiseFunction()
    for entry, alpha in zip(ENTRIES, OPACITIES):
        scalar = LIMITS[0] + (LIMITS[1] - LIMITS[0]) * entry
        colors.AddRGBPoint(scalar, *pyvista.get_cmap_safe(cmap)(entry)[:3])
        opacity.AddPoint(scalar, alpha / 255)
    mapper = vtkTetrahedraRayCastMapper()
    mapper.SetInputData(mesh)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectScalarArray("height")
    volume = vtkVolume()
    volume.SetMapper(mapper)
    look = volume.GetProperty()
    look.SetColor(colors)
    look.SetScalarOpacity(opacity)
    look.SetScalarOpacityUnitDistance(1.0)
    plotter.add_actor(volume)


class TestPyVista(unittest.TestCase):
    def test_functions_lie_on_the_limits(self):
        mesh = make_image().to_tetrahedra()
        for cmap in ("coolwarm", "viridis"):
            helper = picture_of(lambda plotter: add_volume(
                plotter, mesh, "height", cmap=cmap, clim=LIMITS, opacity=OPACITIES,
                opacity_unit_distance=1.0, show_scalar_bar=False))
            explicit = picture_of(lambda plotter: add_explicitly(plotter, mesh, cmap))
            self.assertGreater((explicit.max(axis=2) > 30).sum(), 0.1 * SIZE * SIZE)
            # Colours are truncated to bytes in PyVista's table, and those of the image are rounded:
            # 1 each.
            self.assertLessEqual(abs(helper - explicit).max(), 2, cmap)

    def test_looks_as_a_volume_of_pyvista(self):
        image = make_image()
        for mesh, limits in itertools.product((image, image.to_tetrahedra()), (None, LIMITS)):
            # PyVista's unit differs between versions unless it is given explicitly.
            options = dict(cmap="coolwarm", clim=limits, opacity="linear", show_scalar_bar=False,
                           opacity_unit_distance=4.0)
            own = picture_of(lambda plotter: plotter.add_volume(
                mesh, scalars="height", shade=False, **options))
            helper = picture_of(lambda plotter: add_volume(plotter, mesh, "height", **options))
            self.assertGreater((own.max(axis=2) > 30).sum(), 0.1 * SIZE * SIZE)
            # Inside the picture both integrate the same functions of the same linear field;
            # PyVista's mapper takes two samples per cell and looks opacities up in a table, its
            # silhouette is that of the voxels' centres. Functions on another range differ by 40 in
            # the mean, and by more than 100 in one of ten values; the other meaning of opacities by
            # 6 in the mean, and by 20 in one of ten values.
            difference = abs(helper - own)
            self.assertLess(difference.mean(), 2.0, (type(mesh), limits))
            self.assertLessEqual(numpy.percentile(difference, 90), 4, (type(mesh), limits))

    def test_rules_of_the_limits(self):
        image = make_image()
        image["bytes"] = image["height"].astype(numpy.uint8)
        mesh = image.to_tetrahedra()
        mesh["bytes"] = mesh["height"].astype(numpy.uint8)
        of_bytes = (0.0, 255.0) if pyvista.version_info < (0, 45) else (0.0, CELLS)
        for scalars, clim, expected in (("height", None, (0.0, CELLS)), ("height", 5, (-5.0, 5.0)),
                                        ("height", numpy.array([1.0, 2.0]), (1.0, 2.0)),
                                        ("bytes", None, of_bytes)):
            plotter = pyvista.Plotter(off_screen=True)
            limits = tuple(clim) if isinstance(clim, numpy.ndarray) else clim
            own = plotter.add_volume(image, scalars=scalars, clim=limits)
            self.assertEqual(tuple(own.mapper.scalar_range), expected, (scalars, clim))
            plotter.clear()
            look = add_volume(plotter, mesh, scalars, clim=clim).GetProperty()
            for function in (look.GetRGBTransferFunction(), look.GetScalarOpacity()):
                self.assertEqual(function.GetRange(), expected, (scalars, clim))
            plotter.close()

    def test_a_bar_shows_the_limits(self):
        mesh = make_image().to_tetrahedra()
        plotter = pyvista.Plotter(off_screen=True)
        add_volume(plotter, mesh, "height", clim=(3.0, 8.0))
        self.assertEqual(plotter.scalar_bars["height"].GetLookupTable().GetRange(), (3.0, 8.0))
        plotter.close()


if __name__ == "__main__":
    unittest.main()
