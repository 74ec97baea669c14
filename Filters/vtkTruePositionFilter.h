// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTruePositionFilter
 * @brief   true positions of points that are seen through a refracting surface
 *
 * The inverse of vtkRefractedGeometryFilter, for measurements that are made through water or glass:
 * points from photographs, laser scans or depth images lie where they are seen, and the filter
 * moves them to where they are. Port 0 is any vtkPointSet, port 1 the membrane. Port 1 is
 * repeatable; see SetInterfaces() for several surfaces. The normals of a surface point to the
 * medium of the index ExteriorIndexOfRefraction; an eye on the other side is in the medium of the
 * index InteriorIndexOfRefraction.
 *
 * The sight ray from the eye to a point is refracted by Snell's law where it first meets the
 * membrane, a curved surface through the vertices with their normals (CURVED of
 * vtkRefractedGeometryFilter). The point is moved onto the refracted ray; SetDepth() chooses its
 * distance behind the sight point. The default is n2 / n1 times the distance at which it is seen
 * behind the sight point, so that vtkRefractedGeometryFilter moves it back (Eq. 2.4 of the thesis
 * "Refraction by geometric transforms"). Laser scans need SetDepthToOptical(). Points that were
 * triangulated along straight rays have no depth of any of these kinds: use
 * vtkTriangulatedPositionFilter.
 *
 * The output has the structure and the arrays of the input, and the point arrays
 *
 * | name         | type          | components | meaning                                           |
 * |--------------|---------------|------------|---------------------------------------------------|
 * | SeenState    | unsigned char | 1          | one of SeenStates                                 |
 * | SightPoint   | double        | 3          | place where the sight ray meets the membrane; NaN |
 * |              |               |            | if the point is not refracted                     |
 * | OpticalPath  | double        | 1          | length of the path from the eye to the point      |
 * |              |               |            | times the indices of refraction along it          |
 *
 * @sa vtkRefractedGeometryFilter vtkRefractionErrorVolume
 */
#ifndef vtkTruePositionFilter_h
#define vtkTruePositionFilter_h

#include "vtkMeniscusModule.h" // For export macro
#include "vtkSightRayAlgorithm.h"

#include <memory> // For std::unique_ptr

class VTKMENISCUS_EXPORT vtkTruePositionFilter : public vtkSightRayAlgorithm
{
public:
  static vtkTruePositionFilter* New();
  vtkTypeMacro(vtkTruePositionFilter, vtkSightRayAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Values of the array SeenState. */
  enum SeenStates
  {
    UNREFRACTED = 0,       ///< no membrane in front of the point, which is not moved
    REFRACTED = 1,         ///< behind the membrane: the point is moved
    TOTALLY_REFLECTED = 2, ///< beyond the critical angle; the point is not moved
    NOT_FINITE = 3,        ///< not finite, at the eye, or its own eye cannot be used; not moved
    MISSED = 4             ///< the ray misses one of several surfaces; the point is not moved
  };

  /**
   * Meanings of the distance at which a point is seen, with the length a of the sight ray up to the
   * first surface, in a medium of the index n1, and a length b behind it, in a medium of the index
   * n2. In several media there is a term of b for each.
   */
  enum
  {
    APPARENT = 0, ///< a + b n1 / n2: points of vtkRefractedGeometryFilter
    OPTICAL = 1,  ///< a + b n2 / n1: laser scans, which measure the time of light
    GEOMETRIC = 2 ///< a + b: lengths along the refracted path
  };

  /** @{ */
  /** Set/Get the meaning of the distance of the points from the eye. Default is APPARENT. */
  virtual void SetDepth(int depth);
  vtkGetMacro(Depth, int);
  void SetDepthToApparent() { this->SetDepth(APPARENT); }
  void SetDepthToOptical() { this->SetDepth(OPTICAL); }
  void SetDepthToGeometric() { this->SetDepth(GEOMETRIC); }
  /** @} */

  /** Number of points of the last run that have no true position: TOTALLY_REFLECTED. */
  vtkTypeInt64 GetNumberOfTotallyReflectedPoints() const;
  /** Number of points of the last run whose rays miss one of several surfaces: MISSED. */
  vtkTypeInt64 GetNumberOfMissedPoints() const;
  /** Number of times that EyePosition was set up: once per change of eye, indices or surfaces. */
  vtkTypeInt64 GetNumberOfEyeUpdates() const;

protected:
  vtkTruePositionFilter();
  ~vtkTruePositionFilter() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTruePositionFilter(const vtkTruePositionFilter&) = delete;
  void operator=(const vtkTruePositionFilter&) = delete;

  bool MovePoints(vtkPointSet* input, const meniscus::PointEyes& eyes, vtkPointSet* output);

  int Depth = APPARENT;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
