// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTriangulatedPositionFilter
 * @brief   true positions of points that several eyes see through refracting surfaces
 *
 * Each point of port 0 is an observation: any place on the sight ray on which an eye sees an object
 * point, such as a pixel's place on the image plane; its distance from the eye does not matter. The
 * point array EyeArrayName has the eye of each observation, the point array PointIdArrayName the
 * number of the object point that it sees, a whole number of any type. vtkAppendPolyData joins the
 * observations of several cameras.
 *
 * The rays are refracted at all surfaces of port 1. The result is the point with the least sum of
 * squared distances from its rays, in the medium in which the rays come closest to each other. Eyes
 * may be on different sides of a surface, such as above the water and in it.
 *
 * The output has one vertex per number, in their order, and the point arrays
 *
 * | name               | type          | meaning                                                |
 * |--------------------|---------------|--------------------------------------------------------|
 * | PointId            | vtkIdType     | number of the object point                             |
 * | NumberOfRays       | int           | rays that were used. An observation has no ray if it   |
 * |                    |               | or its eye is not finite, if its eye is on a surface,  |
 * |                    |               | or if no ray from its eye passes the list of surfaces  |
 * | Residual           | double        | root of the mean square distance of the rays           |
 * | RayAngle           | double        | largest angle between two rays at the point, in        |
 * |                    |               | degrees: small angles have large errors of distance    |
 * | TriangulationState | unsigned char | one of TriangulationStates                             |
 *
 * Points of other states than FOUND have NaN coordinates.
 *
 * @sa vtkTruePositionFilter vtkSightRayFilter
 */
#ifndef vtkTriangulatedPositionFilter_h
#define vtkTriangulatedPositionFilter_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkSightRayAlgorithm.h"

#include <string> // For std::string

class VTKMENISCUS_EXPORT vtkTriangulatedPositionFilter : public vtkSightRayAlgorithm
{
public:
  static vtkTriangulatedPositionFilter* New();
  vtkTypeMacro(vtkTriangulatedPositionFilter, vtkSightRayAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The output, which is a vtkPolyData whatever the input is. */
  vtkPolyData* GetOutput() { return this->GetPolyDataOutput(); }

  /** Values of the array TriangulationState. */
  enum TriangulationStates
  {
    FOUND = 0,
    TOO_FEW_RAYS = 1, ///< fewer than two rays
    PARALLEL = 2,     ///< the rays are parallel within rounding
    NO_MEDIUM = 3     ///< no medium is reached by all rays
  };

  /** @{ */
  /**
   * Set/Get the name of the array with the number of the object point. A missing array, several
   * components and values that are not whole numbers are errors when the filter runs. Default is
   * "PointId".
   */
  virtual void SetPointIdArrayName(const std::string& name);
  virtual std::string GetPointIdArrayName();
  /** @} */

  /** Number of points of the last run that have no position: other states than FOUND. */
  vtkTypeInt64 GetNumberOfPointsWithoutPosition() const { return this->WithoutPosition; }

protected:
  vtkTriangulatedPositionFilter();
  ~vtkTriangulatedPositionFilter() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTriangulatedPositionFilter(const vtkTriangulatedPositionFilter&) = delete;
  void operator=(const vtkTriangulatedPositionFilter&) = delete;

  std::string PointIdArrayName = "PointId";
  vtkTypeInt64 WithoutPosition = 0;
};

#endif
