"""An AMR grid for tests."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkAMRBox, vtkOverlappingAMR, vtkUniformGrid

# VTK_XYZ_GRID, whose name depends on the version of VTK.
XYZ_GRID = 8


def make_refined_grid(ranges):
    """A vtkOverlappingAMR with a cubic block per level, whose cell array "level" is 1 in the
    coarsest. ranges: first and last cell of each level along all axes; cells of the coarsest have
    the size 1, those of the next half of it, and so on."""
    grid = vtkOverlappingAMR()
    grid.Initialize(len(ranges), [1] * len(ranges))
    grid.SetOrigin([0.0, 0.0, 0.0])
    grid.SetGridDescription(XYZ_GRID)
    for level, (low, high) in enumerate(ranges):
        spacing, size = 0.5 ** level, high - low + 1
        grid.SetSpacing(level, [spacing] * 3)
        grid.SetAMRBox(level, 0, vtkAMRBox([low] * 3, [high] * 3))
        block = vtkUniformGrid()
        block.SetOrigin([low * spacing] * 3)
        block.SetSpacing([spacing] * 3)
        block.SetDimensions([size + 1] * 3)
        array = numpy_to_vtk(numpy.full(size ** 3, level + 1.0), deep=True)
        array.SetName("level")
        block.GetCellData().AddArray(array)
        grid.SetDataSet(level, 0, block)
        grid.SetRefinementRatio(level, 2)
    return grid
