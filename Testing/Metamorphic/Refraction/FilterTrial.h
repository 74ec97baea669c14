// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "FilterScene.h"

class vtkDataSetAttributes;

namespace meniscus::test
{

/**
 * Compares outputs of vtkRefractedGeometryFilter for a scene and for a changed one.
 *
 * Pictures (ALL_IMAGES): with the tolerance t, an output draws the image of a place within t of its
 * true direction, within 2 t where a side was moved onto its neighbour's, and so does the other
 * output. The place that one output shows in a direction is therefore shown by the other within
 * 4 t. Rays at 2 t and 4 t around the direction sample that disc so densely that one of them shows
 * a place no farther away than the place moves on the piece when the direction moves by 4 t.
 *
 * Points (FIRST_IMAGE, FLAT_FACETS): an image may differ by the errors that RefractionTrial
 * derives, times the image's sensitivity, which is measured by moving the points.
 *
 * A place is ill-conditioned, and not compared, if the number of its images changes when it moves
 * by these errors: at caustics, borders, the waterline and the critical angle.
 */
class FilterTrial
{
public:
  explicit FilterTrial(const FilterScene& scene);

  const FilterScene& GetScene() const { return this->Scene; }
  RelationTally& GetTally() { return this->Tally; }
  bool IsReady() const { return this->Solver != nullptr; }
  void Fail(const std::string& words);

  /** Output for the scene as it is. */
  vtkPolyData* GetBase();

  /** By pictures or by points, depending on the mode. `motion` leads from the scene to the change.
   */
  void Compare(vtkPolyData* changed, const Motion& motion, RandomNumbers& random,
    const std::function<bool(const glm::dvec3& direction)>& isInView = nullptr);
  /** Every point, cell and array must be equal bit by bit. */
  void CompareBits(vtkPolyData* first, vtkPolyData* second);
  /** Every array must be equal bit by bit. */
  void CompareArrays(vtkDataSetAttributes* first, vtkDataSetAttributes* second);
  /** Number of images of a place; the largest number stands for a place in front. */
  std::size_t CountImages(const glm::dvec3& place) const;
  /** Largest error of a point of the scene. */
  double GetLargestError() const;
  /** Arrays of ones and positions at all points of the base, and images of these positions. */
  void CheckArrays();

private:
  /** A place that an output shows, and how far the shown place moves within the tolerance. */
  struct Hit
  {
    glm::dvec3 Place;
    double Reach;
  };
  struct Sheet;

  double GetError(double magnitude, double depth, std::int32_t facet) const;
  void ComparePoints(vtkPolyData* changed, const Motion& motion);
  void ComparePictures(const Sheet& shown, const Sheet& other, RandomNumbers& random,
    const std::function<bool(const glm::dvec3& direction)>& isInView);
  double FindNearest(const Sheet& other, const glm::dvec3& direction, const Hit& hit) const;
  void CheckImage(const glm::dvec3& place, const glm::dvec3& sight, const glm::dvec3& drawn,
    double tolerance, double error);
  double GetAngle(const glm::dvec3& a, const glm::dvec3& b) const;
  bool IsWellConditioned(const glm::dvec3& place, double error) const;
  std::vector<double> MeasureSensitivity(const std::vector<double>& moves) const;
  std::vector<glm::dvec3> FindFirst(vtkPolyData* output, const Motion& motion) const;

  FilterScene Scene;
  std::unique_ptr<CurvedMembraneSolver> Solver;
  RefractionTrial Errors; ///< derives the errors of points
  std::int32_t Worst = 0; ///< facet whose points have the largest error
  RelationTally Tally;
  vtkSmartPointer<vtkPolyData> Base;
};

} // namespace meniscus::test
