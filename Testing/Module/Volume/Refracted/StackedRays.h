// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/** Surfaces in sequence, views of them, and the rays of a pixel behind each. */
#pragma once

#include "KernelSurfaces.h"

#include "TestBasics.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractedRayStack.h"

namespace meniscus::test
{

/** Width and height of the images, in pixels. */
constexpr int Size = 96;
constexpr int TileSize = RefractedRayTiles::TileSize;
constexpr int Columns = (Size + TileSize - 1) / TileSize;

/** Bounds of a mesh that all rays meet. */
inline const WorldBox Everywhere{ glm::dvec3(0.0), glm::dvec3(1e3) };

/** Heights of a plane, a cap of a sphere, and waves. */
inline const std::function<double(double, double)> Shapes[] = { [](double, double) { return 0.0; },
  [](double x, double y) { return std::sqrt(4.0 - x * x - y * y) - 1.7; },
  [](double x, double y) { return 0.05 * std::sin(5.0 * x + 1.0) * std::sin(4.0 * y); } };

/** View whose rays are traced wherever they go. */
inline RefractedRayStack::View LookAtAll(
  const glm::dvec3& eye, const glm::dvec3& target, double width, bool isParallel)
{
  RefractedRayStack::View view = LookAt(eye, target, width, isParallel, Size);
  SetMesh(view, Everywhere);
  return view;
}

inline RayLegs LegsOf(const RefractedRayStack& stack, const RefractedRayStack::View& view)
{
  std::vector<const RefractedRayTiles*> list;
  for (const RefractedRayTiles& rays : stack.GetRays())
  {
    list.push_back(&rays);
  }
  return RayLegs(view.Frame, Size, Size, list);
}

/** A ray in world coordinates; a direction of 0 stands for none. */
struct WorldRay
{
  glm::dvec3 Start{ 0.0 };
  glm::dvec3 Direction{ 0.0 };
};

/** Leg of a pixel's ray in world coordinates; none if there is no such leg. */
inline WorldRay LegOf(
  const RayLegs& legs, const RefractedRayStack::View& view, int column, int row, int number)
{
  RayLeg leg;
  const int tile = row / TileSize * Columns + column / TileSize;
  const int pixel = row % TileSize * TileSize + column % TileSize;
  if (!legs.Find(tile, pixel, number, leg))
  {
    return {};
  }
  const glm::dmat3& toWorld = view.Frame.ViewToWorld;
  return { view.Center + toWorld * leg.Begin, toWorld * leg.Step };
}

inline RefractedRay RayOf(const RefractedRayTiles& rays, int column, int row)
{
  const RefractedRay* tile = rays.GetTile(row / TileSize * Columns + column / TileSize);
  return tile ? tile[row % TileSize * TileSize + column % TileSize] : RefractedRay();
}

}
