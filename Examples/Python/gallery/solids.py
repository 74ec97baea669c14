# SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
# SPDX-License-Identifier: BSD-3-Clause
"""A closed surface, filled with tetrahedra and drawn as a volume."""
import meniscus
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

from . import common


def get_walls(mesh):
    """The boundary of a mesh as a closed surface with its arrays, wound outwards."""
    boundary = vtkDataSetSurfaceFilter()
    boundary.SetInputData(mesh)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(boundary.GetOutputPort())
    joined = vtkCleanPolyData()
    joined.SetInputConnection(triangles.GetOutputPort())
    joined.ToleranceIsAbsoluteOn()
    joined.SetAbsoluteTolerance(0.0)
    outwards = vtkPolyDataNormals()
    outwards.SetInputConnection(joined.GetOutputPort())
    outwards.ConsistencyOn()
    outwards.AutoOrientNormalsOn()
    outwards.SplittingOff()
    outwards.Update()
    return outwards.GetOutput()


def draw_walls(data, size):
    """The density of the combustor's walls alone, continued into the inside by TetGen's mesh.

    None where TetGen is not built in.
    """
    mesher = meniscus.vtkTetrahedralizeSurface()
    if not mesher.HasTetGen():
        return None
    mesher.SetInputData(get_walls(data.combustor))
    mesher.PreserveSurfaceOn()
    mesher.SetMaximumVolume(0.01)
    mesher.Update()
    mesh = mesher.GetOutput()
    mesh.GetPointData().SetActiveScalars(data.combustor.GetPointData().GetScalars().GetName())
    colors, look = common.make_flames(data.combustor, 0.35)
    renderer = common.make_renderer()
    renderer.AddVolume(common.make_volume(mesh, look))
    common.light_flames(renderer)
    return common.take(renderer, size, common.make_bar(colors, "Density"))
