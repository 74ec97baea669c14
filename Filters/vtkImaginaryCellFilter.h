// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkImaginaryCellFilter
 * @brief   a tetrahedral mesh with hidden cells up to its convex hull
 *
 * Adds the imaginary cells of Weiler et al. (2003): tetrahedra that fill the space between the
 * mesh and its convex hull, cavities included, so that a ray enters the mesh once and leaves it
 * once. They are marked with vtkDataSetAttributes::HIDDENCELL in the cell array vtkGhostType, which
 * VTK's mappers and filters and vtkTetrahedraRayCastMapper leave out. That mapper needs no such
 * cells: it keeps a list of entries per ray.
 *
 * Input is a vtkUnstructuredGrid of linear tetrahedra (VTK_TETRA); cells of lower dimension are
 * passed on. Output has the points and cells of the input in their order with their arrays, then
 * the points that TetGen added outside of the mesh and the imaginary cells. There, arrays repeat
 * the values of the input's first point or cell, so that their ranges stay as they are. Global and
 * pedigree ids are left out. Imaginary cells share the faces of the mesh; points of equal
 * coordinates count as one, and imaginary cells use the first of them.
 *
 * TetGen runs as a program of its own, meniscus_tetgen, which is built with the CMake option
 * MENISCUS_WITH_TETGEN. Without it, for other cells, and for a mesh whose boundary crosses itself,
 * the filter reports an error and the output is empty. Observers of ProgressEvent are called while
 * TetGen runs; SetAbortExecute(1) ends it.
 *
 * @sa vtkTetrahedralizeSurface vtkTetrahedraRayCastMapper
 */
#ifndef vtkImaginaryCellFilter_h
#define vtkImaginaryCellFilter_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkUnstructuredGridAlgorithm.h"

class VTKMENISCUS_EXPORT vtkImaginaryCellFilter : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkImaginaryCellFilter* New();
  vtkTypeMacro(vtkImaginaryCellFilter, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** @{ */
  /** Set/Get the seconds, > 0, after which TetGen is ended, with an error. Default is 300. */
  vtkSetMacro(TimeLimit, double);
  vtkGetMacro(TimeLimit, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the file name of the program that runs TetGen. Null, the default, and an empty
   * name stand for meniscus_tetgen of the build or the installation of this library.
   */
  vtkSetFilePathMacro(MesherProgram);
  vtkGetFilePathMacro(MesherProgram);
  /** @} */

  /** True if there is a program for TetGen: MesherProgram, or the library's own. */
  bool HasTetGen();

  /** Number of cells that the last run added. */
  vtkGetMacro(NumberOfImaginaryCells, vtkIdType);
  /** Number of points that the last run added. */
  vtkGetMacro(NumberOfAddedPoints, vtkIdType);

protected:
  vtkImaginaryCellFilter();
  ~vtkImaginaryCellFilter() override;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkImaginaryCellFilter(const vtkImaginaryCellFilter&) = delete;
  void operator=(const vtkImaginaryCellFilter&) = delete;

  double TimeLimit = 300.0;
  char* MesherProgram = nullptr;
  vtkIdType NumberOfImaginaryCells = 0;
  vtkIdType NumberOfAddedPoints = 0;
};

#endif
