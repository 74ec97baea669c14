// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedralizeSurface
 * @brief   tetrahedra of bounded quality inside of a closed surface
 *
 * The input is a closed surface, e.g. an STL file or an isosurface; the output has tetrahedra that
 * fill it. Polygons and strips are taken as triangles, points of equal coordinates as one point.
 * Triangles must be counterclockwise as seen from outside; cavities are surfaces of their own,
 * wound the other way round. A surface that is empty, open, not a manifold, inside out or wound
 * inconsistently, that crosses itself or has a point that is not finite is an error, and the output
 * is empty.
 *
 * TETGEN runs TetGen as a program of its own, meniscus_tetgen, which is built with the CMake option
 * MENISCUS_WITH_TETGEN. TetGen adds points until the ratio of circumscribed radius to shortest edge
 * is below MaximumRadiusEdgeRatio, except for some cells: there is no such mesh next to triangles
 * of the surface that have angles, or meet at angles, below about 60 degrees. Elsewhere TetGen
 * leaves about one cell in a hundred. GetNumberOfCellsAboveRatio() counts them.
 *
 * DELAUNAY uses vtkDelaunay3D. It adds no points, so that there is no bound of quality, and the
 * surface must have triangles that are small against its curvature and its thickness: each must be
 * a face of a Delaunay cell, or the filter reports an error.
 *
 * The cells of both meshers are checked before they are returned: each has a positive volume, and
 * their sum equals the volume inside of the surface.
 *
 * Numerical point arrays are passed on. At points that were added on the surface, they are
 * interpolated in the triangle; inside they are continued harmonically, so that a linear field
 * stays linear. Global and pedigree ids are left out. An array that cannot be continued, because
 * some of its values are not finite, is NaN inside (integers: 0), with a warning.
 *
 * The observers of ProgressEvent are called while TetGen runs; SetAbortExecute(1) ends it.
 *
 * @sa vtkTetrahedraRayCastMapper vtkDelaunay3D
 */
#ifndef vtkTetrahedralizeSurface_h
#define vtkTetrahedralizeSurface_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // For std::string

class vtkPolyData;

namespace meniscus
{
struct TetrahedronCells;
struct TriangleSurface;
}

class VTKMENISCUS_EXPORT vtkTetrahedralizeSurface : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTetrahedralizeSurface* New();
  vtkTypeMacro(vtkTetrahedralizeSurface, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Programs and classes that make the tetrahedra. */
  enum
  {
    AUTOMATIC = 0, ///< TETGEN if its program is there, else DELAUNAY
    TETGEN = 1,    ///< TetGen in a process of its own
    DELAUNAY = 2   ///< vtkDelaunay3D
  };

  /** @{ */
  /** Set/Get the mesher. Default is AUTOMATIC. */
  virtual void SetMesher(int mesher);
  vtkGetMacro(Mesher, int);
  void SetMesherToAutomatic() { this->SetMesher(AUTOMATIC); }
  void SetMesherToTetGen() { this->SetMesher(TETGEN); }
  void SetMesherToDelaunay() { this->SetMesher(DELAUNAY); }
  /** @} */

  /** @{ */
  /**
   * Set/Get the bound of the ratio of circumscribed radius to shortest edge of a cell, for TETGEN.
   * At least 1; TetGen reaches 2 in theory and about 1.2 in practice; smaller bounds take more
   * cells. A regular tetrahedron has 0.61. Default is 2.
   */
  vtkSetMacro(MaximumRadiusEdgeRatio, double);
  vtkGetMacro(MaximumRadiusEdgeRatio, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the largest volume of a cell, in the cube of the input's unit of length, for TETGEN. 0,
   * the default, stands for no limit; negative numbers are an error.
   */
  vtkSetMacro(MaximumVolume, double);
  vtkGetMacro(MaximumVolume, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get whether TETGEN adds no points on the surface, so that the boundary of the cells has the
   * surface's triangles. Cells next to the surface may then exceed the bound of quality. Default is
   * off: triangles of the surface may be divided.
   */
  vtkSetMacro(PreserveSurface, bool);
  vtkGetMacro(PreserveSurface, bool);
  vtkBooleanMacro(PreserveSurface, bool);
  /** @} */

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

  /** True if there is a program for TETGEN: MesherProgram, or the library's own. */
  bool HasTetGen();

  /** Mesher of the last run: TETGEN or DELAUNAY. */
  vtkGetMacro(UsedMesher, int);
  /** Number of points of the last run's output that are not points of the surface. */
  vtkGetMacro(NumberOfAddedPoints, vtkIdType);
  /** Largest ratio of circumscribed radius to shortest edge in the last run's output. */
  vtkGetMacro(LargestRadiusEdgeRatio, double);
  /** Number of cells of the last run's output above MaximumRadiusEdgeRatio. */
  vtkGetMacro(NumberOfCellsAboveRatio, vtkIdType);

protected:
  vtkTetrahedralizeSurface();
  ~vtkTetrahedralizeSurface() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTetrahedralizeSurface(const vtkTetrahedralizeSurface&) = delete;
  void operator=(const vtkTetrahedralizeSurface&) = delete;

  bool HasValidSettings();
  bool MakeCells(const meniscus::TriangleSurface& surface, meniscus::TetrahedronCells& cells);
  bool RunTetGen(const meniscus::TriangleSurface& surface, meniscus::TetrahedronCells& cells);
  bool RunDelaunay(const meniscus::TriangleSurface& surface, meniscus::TetrahedronCells& cells);
  std::string GetProgram() const;

  int Mesher = AUTOMATIC;
  double MaximumRadiusEdgeRatio = 2.0;
  double MaximumVolume = 0.0;
  bool PreserveSurface = false;
  double TimeLimit = 300.0;
  char* MesherProgram = nullptr;

  int UsedMesher = AUTOMATIC;
  vtkIdType NumberOfAddedPoints = 0;
  double LargestRadiusEdgeRatio = 0.0;
  vtkIdType NumberOfCellsAboveRatio = 0;
};

#endif
