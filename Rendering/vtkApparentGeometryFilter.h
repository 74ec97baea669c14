// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkApparentGeometryFilter
 * @brief   geometry where it is seen through a medium that bends light
 *
 * Moves each point of port 0, any vtkPointSet, to where an eye sees it through a mesh in which the
 * index of refraction n varies, port 1: along the ray from the eye that meets the point, at the
 * point's own straight distance. The result looks like the object from the eye, if each of its
 * points has one image; vtkRefractedGeometryFilter does the same behind surfaces. Cells and
 * arrays are those of port 0.
 *
 * The mesh is read as vtkBentMediumAlgorithm describes.
 *
 * A point may have several images, as in a mirage, or none, in a shadow of the medium. Images are
 * searched within SearchAngle of the straight direction, from a grid of SearchResolution^2 cells;
 * pairs of images within one cell of the grid may be missed. A point with several images is moved
 * to the one nearest to its straight direction; mirrored images count only if there are no others.
 * A point without an image stays. Point arrays that are added:
 * - `NumberOfImages`, int;
 * - `ImageOrientation`, signed char: 1, -1 for a mirrored image, 0 for none.
 * A warning counts points with several images or none, and GetStatistics() has the numbers. Images
 * that other objects hide are counted, too.
 *
 * **Bad input.** Points that are not finite or at the eye have no image. Errors,
 * besides those of the mesh: an eye that is not finite, a search angle that is not in (0, 89.9)
 * degrees.
 *
 * @sa vtkTetrahedraMirage vtkRefractedGeometryFilter
 */
#ifndef vtkApparentGeometryFilter_h
#define vtkApparentGeometryFilter_h

#include "vtkBentMediumAlgorithm.h"
#include "vtkMeniscusModule.h" // For export macro

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkPointSet;
class vtkTable;

class VTKMENISCUS_EXPORT vtkApparentGeometryFilter : public vtkBentMediumAlgorithm
{
public:
  static vtkApparentGeometryFilter* New();
  vtkTypeMacro(vtkApparentGeometryFilter, vtkBentMediumAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The moved points, of the type of port 0. */
  vtkPointSet* GetOutput();

  /** @{ */
  /** Set the mesh, port 1. */
  void SetMediumConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetMediumData(vtkDataObject* mesh);
  /** @} */

  /** @{ */
  /** Set/Get the eye in world coordinates; it may be in the mesh. Default is (0, 0, 1). */
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  /** @} */

  /** @{ */
  /**
   * Set/Get the largest angle between an image and the straight direction to its point, in degrees,
   * above 0 and below 89.9. Default is 2, which is far more than air bends light.
   */
  vtkSetMacro(SearchAngle, double);
  vtkGetMacro(SearchAngle, double);
  /** @} */

  /** @{ */
  /** Set/Get the number of cells along each axis of the grid of directions, from 1. Default is 64.
   */
  virtual void SetSearchResolution(int cells);
  vtkGetMacro(SearchResolution, int);
  /** @} */

  /** @{ */
  /**
   * Counters by name: a table with one row each and the columns Name, Meaning and Value, which
   * belongs to this object and is filled anew by each call; and the value of one name, such as
   * "NumberOfPointsWithoutImage". An unknown name is an error, and the value is not a number.
   */
  vtkTable* GetStatistics();
  double GetStatistic(const char* name);
  /** @} */

protected:
  vtkApparentGeometryFilter();
  ~vtkApparentGeometryFilter() override;

  int ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkApparentGeometryFilter(const vtkApparentGeometryFilter&) = delete;
  void operator=(const vtkApparentGeometryFilter&) = delete;

  class vtkInternals;

  std::string FindFault() const;
  void MovePoints(vtkPointSet* output);

  double EyePosition[3] = { 0.0, 0.0, 1.0 };
  double SearchAngle = 2.0;
  int SearchResolution = 64;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
