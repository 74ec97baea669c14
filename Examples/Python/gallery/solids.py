# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A closed surface, filled with tetrahedra and drawn as a volume."""
import meniscus
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPlane
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkPolyDataNormals
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

from . import common

PAINT = ((1.0, 0.80, 0.10), (0.95, 0.36, 0.08))  # of the body and of the bill
BOUNDS = ((-1.5, -1.0, -0.75), (1.5, 1.0, 1.45))
SPACING = 0.05
LAMPS = (((-0.9, 0.9, 0.9), (1.0, 0.97, 0.92), 1.0), ((1.0, -0.2, 0.6), (0.6, 0.72, 1.0), 0.45))


def measure_ellipsoid(points, center, radii):
    """About the distance of points from an ellipsoid, negative inside."""
    scaled = (points - center) / radii
    length = numpy.linalg.norm(scaled, axis=-1)
    slope = numpy.linalg.norm(scaled / radii, axis=-1)
    return length * (length - 1.0) / numpy.maximum(slope, 1e-6)


def unite(first, second, width):
    """The smaller of two distances, with a fillet of that width."""
    share = numpy.clip(0.5 + 0.5 * (second - first) / width, 0.0, 1.0)
    return second + (first - second) * share - width * share * (1.0 - share)


def measure_duck(points):
    """About the distances of points from a duck, negative inside, and from its bill."""
    mirrored = numpy.column_stack([points[:, 0], abs(points[:, 1]), points[:, 2]])
    parts = ((points, (-0.95, 0.0, 0.32), (0.35, 0.30, 0.16), 0.35),
             (mirrored, (-0.12, 0.58, 0.12), (0.50, 0.16, 0.27), 0.08),
             (points, (0.55, 0.0, 0.85), (0.47, 0.45, 0.45), 0.22))
    duck = measure_ellipsoid(points, (0.0, 0.0, 0.0), (1.00, 0.68, 0.55))
    for where, center, radii, width in parts:
        duck = unite(duck, measure_ellipsoid(where, center, radii), width)
    bill = unite(measure_ellipsoid(points, (1.05, 0.0, 0.83), (0.30, 0.24, 0.07)),
                 measure_ellipsoid(points, (0.98, 0.0, 0.74), (0.24, 0.18, 0.05)), 0.04)
    return unite(duck, bill, 0.06), bill


def make_duck():
    """A closed surface of triangles with the array `Paint`: 0 on the body, 1 on the bill."""
    counts = [round((high - low) / SPACING) + 1 for low, high in zip(*BOUNDS)]
    image = vtkImageData()
    image.SetOrigin(*BOUNDS[0])
    image.SetSpacing(SPACING, SPACING, SPACING)
    image.SetDimensions(*counts)
    axes = [low + SPACING * numpy.arange(count) for low, count in zip(BOUNDS[0], counts)]
    z, y, x = numpy.meshgrid(*axes[::-1], indexing="ij")
    points = numpy.column_stack([each.ravel() for each in (x, y, z)])
    # Falling outwards, so that the triangles are counterclockwise as seen from outside.
    image.GetPointData().SetScalars(numpy_to_vtk(-measure_duck(points)[0], deep=True))
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.0)
    contour.ComputeScalarsOff()
    contour.Update()
    surface = contour.GetOutput()
    bill = measure_duck(vtk_to_numpy(surface.GetPoints().GetData()))[1]
    paint = numpy_to_vtk(1.0 - numpy.clip(bill / 0.12, 0.0, 1.0), deep=True)
    paint.SetName("Paint")
    surface.GetPointData().SetScalars(paint)
    return surface


def make_painted(surface, colors, smooth):
    """An actor in the colours of the array, smooth or with its edges."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SetSplitting(not smooth)
    normals.SetComputePointNormals(smooth)
    normals.SetComputeCellNormals(not smooth)
    normals.Update()
    actor = common.make_actor(normals.GetOutput())
    actor.GetMapper().ScalarVisibilityOn()
    actor.GetMapper().SetLookupTable(colors)
    actor.GetMapper().UseLookupTableScalarRangeOn()
    actor.GetMapper().InterpolateScalarsBeforeMappingOn()
    look = actor.GetProperty()
    look.SetAmbient(0.3)
    look.SetDiffuse(0.75)
    look.SetSpecular(0.3 if smooth else 0.0)
    look.SetSpecularPower(40)
    look.SetEdgeVisibility(not smooth)
    look.SetEdgeColor(0.45, 0.25, 0.05)
    return actor


def cut_open(mesh):
    """The surface of the cells behind the plane y = 0, whole."""
    plane = vtkPlane()
    plane.SetNormal(0.0, -1.0, 0.0)
    behind = vtkExtractGeometry()
    behind.SetInputData(mesh)
    behind.SetImplicitFunction(plane)
    behind.ExtractInsideOn()
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputConnection(behind.GetOutputPort())
    surface.Update()
    return surface.GetOutput()


def make_wax(mesh, colors):
    """A volume of a dense medium that shadows itself."""
    look = common.make_look(colors, common.make_opacity(((0.0, 0.9), (1.0, 0.9))), 0.12)
    return common.make_dense(mesh, look, (0.6, 1.3), 0.4, 1.0)


def draw_duck(_data, size):
    """A duck: its surface, the tetrahedra that fill it, cut open, and the volume that they are.

    None where TetGen is not built in.
    """
    mesher = meniscus.vtkTetrahedralizeSurface()
    if not mesher.HasTetGen():
        return None
    mesher.SetInputData(make_duck())
    mesher.PreserveSurfaceOn()
    mesher.SetMaximumVolume(0.0008)
    mesher.Update()
    mesh = mesher.GetOutput()
    mesh.GetPointData().SetActiveScalars("Paint")
    colors = common.make_colors(PAINT, 0.0, 1.0)
    renderers = []
    panel = (size[0] // 3, 2 * size[1] // 5)
    for prop, text in ((make_painted(mesher.GetInput(), colors, True), "A closed surface"),
                       (make_painted(cut_open(mesh), colors, False), "filled with tetrahedra"),
                       (make_wax(mesh, colors), "drawn as a volume")):
        renderer = common.make_renderer(common.PAPER)
        renderer.AddViewProp(prop)
        common.add_lights(renderer, *LAMPS)
        common.look_from(renderer, (3.4, -5.8, 2.7), (0.04, 0.0, 0.36), (0, 0, 1), 20.5)
        renderer.ResetCameraClippingRange()
        common.add_label(renderer, text, 2 * panel[1], common.INK)
        renderers.append(renderer)
    return common.take_beside(renderers, panel, 2)
