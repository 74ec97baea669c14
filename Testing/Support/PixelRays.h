// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ReferenceCellTree.h"

class vtkRenderer;

namespace meniscus::test
{

/**
 * World rays through the pixel centres of a renderer, in double precision and from the camera's
 * parameters alone (not by inverting a matrix). Valid for perspective and parallel cameras with a
 * window centre of 0 and without shear or user transform.
 *
 * With a perspective camera the ray parameter is the depth in front of the camera; with a parallel
 * one it is the distance from the plane through the camera. Rays begin and end at the clipping
 * range.
 */
class PixelRays
{
public:
  explicit PixelRays(vtkRenderer* renderer);

  /** Size of the renderer's viewport and its lower left corner in the window. */
  int GetWidth() const { return this->Size[0]; }
  int GetHeight() const { return this->Size[1]; }
  int GetLeft() const { return this->Lower[0]; }
  int GetBottom() const { return this->Lower[1]; }

  /** Ray through the centre of a pixel, counted from the viewport's lower left corner. */
  reference::Ray GetRay(int x, int y) const { return this->RayAt(x + 0.5, y + 0.5); }
  reference::Ray RayAt(double x, double y) const;

private:
  reference::Vector3 Position;
  reference::Vector3 Right;
  reference::Vector3 Up;
  reference::Vector3 Forward;
  double HalfWidth;
  double HalfHeight;
  double Clipping[2];
  int Size[2];
  int Lower[2];
  bool Parallel;
};

} // namespace meniscus::test
