// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RefractionPicture.h"

#include "vtkRefractedGeometryFilter.h"
#include "vtkRefractedLightFilter.h"

namespace meniscus::test
{

using Point = std::array<double, 3>;

/** Counts errors and warnings, keeps their text, and suppresses output to the output window. */
class MessageCounter : public vtkCommand
{
public:
  static MessageCounter* New() { return new MessageCounter; }
  void Execute(vtkObject* caller, unsigned long event, void* text) override;

  int Errors = 0;
  int Warnings = 0;
  std::string Text;
};

/** Observes a filter and its executive. */
vtkSmartPointer<MessageCounter> Observe(vtkAlgorithm* filter);

/** Observes a filter, and updates it. */
vtkSmartPointer<MessageCounter> UpdateAndObserve(vtkAlgorithm* filter);

/** Updates a filter, and expects neither errors nor warnings. */
void ExpectQuiet(vtkAlgorithm* filter);

/** Observes the progress of a filter, and aborts at the second report of any if `Aborts` is set. */
class ProgressWatch : public vtkCommand
{
public:
  static ProgressWatch* New() { return new ProgressWatch; }
  void Execute(vtkObject* caller, unsigned long event, void* data) override;

  double Last = 0.0;
  int Calls = 0; ///< reports of more than 0
  bool Falls = false;
  bool Aborts = false;
};

/**
 * Largest difference of the irradiance at points of a horizontal floor from the light of a lamp at
 * `height` above the first surface and the origin, at distances from 5 to 35. Light at the angle a
 * passes the first surface at height tan a, ends at radius(a), and transmittance(a) of it passes.
 */
double FindLargestLampError(vtkRefractedLightFilter* filter, double height,
  const std::function<double(double)>& radius, const std::function<double(double)>& transmittance);

/**
 * Expects that the irradiance of the cells of a square grid of side `size`, as of MakeGrid(), has
 * the truth, in rows along x, up to 0.005 of its root mean square.
 */
void ExpectSameLight(
  vtkRefractedLightFilter* filter, const std::vector<double>& truth, double size);

/** A flat membrane of side 200, with eight cells along a side. */
vtkSmartPointer<vtkPolyData> MakeFlatMembrane();

/** Points without cells. */
vtkSmartPointer<vtkPolyData> MakePoints(const std::vector<Point>& points);

/**
 * A horizontal grid of quads at height `y`, with side `size` and `count` points along a side. Has
 * the point array "Rank" (the point's index) and the cell array "Label" (10 times the cell's
 * index).
 */
vtkSmartPointer<vtkPolyData> MakeGrid(int count, double size, double y);

/**
 * Gives the points of `data` unit normals "Bumps" that differ from point to point, none of them
 * along an axis. The smaller `up`, the more they lean.
 */
void AddBumps(vtkPolyData* data, double up = 1.0, int type = VTK_DOUBLE);

/** A filter with FLAT_FACETS, FIRST_IMAGE and the eye at (20, 300, 10). */
vtkSmartPointer<vtkRefractedGeometryFilter> MakeFilter(
  vtkPolyData* geometry, vtkPolyData* membrane);

/** A filter with CURVED, ALL_IMAGES, points in double precision and the eye at (20, 300, 10). */
vtkSmartPointer<vtkRefractedGeometryFilter> MakeAllImages(
  vtkPolyData* geometry, vtkPolyData* membrane);

/** Adds the true position as a point array `Truth`, so that interpolation can be checked. */
void AddTruth(vtkPolyData* data);

}
