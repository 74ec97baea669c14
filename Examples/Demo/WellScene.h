// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"

#include <array>

class vtkPolyData;
class vtkUnsignedCharArray;

/** Waves of moving water about z = 0: their exact heights and normals. */
class DemoWater
{
public:
  static constexpr double HalfSide = 1.9;
  static constexpr double Highest = 0.07; ///< upper bound of waves of height 1
  static constexpr double Index = 1.333;

  /** `height` scales the waves, from 0 to 2. */
  explicit DemoWater(double time, double height = 1.0, double index = Index)
    : Time(time)
    , WaveHeight(height)
    , RefractiveIndex(index)
  {
  }

  double GetIndex() const { return this->RefractiveIndex; }

  double GetHeight(double x, double y) const;
  std::array<double, 3> GetNormal(double x, double y) const;

  /** `cells` x `cells` x 2 facets with normals. */
  vtkSmartPointer<vtkPolyData> MakeMesh(int cells) const;

  /** Distance at which a ray from above first meets the water; negative if it does not. */
  double Intersect(const double eye[3], const double direction[3]) const;

private:
  double Time;
  double WaveHeight;
  double RefractiveIndex;
};

/**
 * Four walls and a bottom with tiles, a ball, a ring, and a post that rises out of the water. The
 * colours of the cells include the light of a lamp above: no further lighting is needed.
 */
vtkSmartPointer<vtkPolyData> MakeDemoWell();

/**
 * Image of cells with colours by tracing rays through the exact water: one ray through the middle
 * of each of `size` x `size` pixels, refracted once. `camera` holds its eye, focal point, view up
 * and the view angle in degrees.
 */
struct DemoView
{
  double Eye[3];
  double Target[3];
  double Up[3];
  double Angle;
};
vtkSmartPointer<vtkUnsignedCharArray> TraceDemoWell(vtkPolyData* well, const DemoWater& water,
  const DemoView& view, int size, const unsigned char background[3]);
