// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSightRayFilter
 * @brief   sight rays through refracting surfaces as lines
 *
 * Ray diagrams: for each point of port 0 the sight ray from its eye to the place where the point is
 * seen, refracted at every surface of port 1, down to the place where the point is (see
 * vtkTruePositionFilter). Each leg of a ray is one line; consecutive legs share a point. A ray
 * that is totally reflected ends at that surface. A ray that misses a later surface ends at the
 * surface before it.
 *
 * Arrays of the output:
 *
 * | name              | of     | type          | meaning                                          |
 * |-------------------|--------|---------------|--------------------------------------------------|
 * | OpticalPath       | points | double        | length of the path from the eye, times the       |
 * |                   |        |               | indices of refraction along it                   |
 * | PointId           | cells  | vtkIdType     | number of the point of the input                 |
 * | Leg               | cells  | int           | 0 from the eye to the first surface, and so on   |
 * | IndexOfRefraction | cells  | double        | index of the leg's medium                        |
 * | SeenState         | cells  | unsigned char | one of vtkTruePositionFilter::SeenStates         |
 *
 * Points of the state NOT_FINITE have no line.
 *
 * @sa vtkTruePositionFilter vtkTriangulatedPositionFilter
 */
#ifndef vtkSightRayFilter_h
#define vtkSightRayFilter_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkSightRayAlgorithm.h"

class VTKMENISCUS_EXPORT vtkSightRayFilter : public vtkSightRayAlgorithm
{
public:
  static vtkSightRayFilter* New();
  vtkTypeMacro(vtkSightRayFilter, vtkSightRayAlgorithm);

  /** The output, which is a vtkPolyData whatever the input is. */
  vtkPolyData* GetOutput() { return this->GetPolyDataOutput(); }

protected:
  vtkSightRayFilter() = default;
  ~vtkSightRayFilter() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSightRayFilter(const vtkSightRayFilter&) = delete;
  void operator=(const vtkSightRayFilter&) = delete;
};

#endif
