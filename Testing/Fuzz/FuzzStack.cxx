// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images of points, lines and polygons behind several refracting surfaces.
#include "ByteReader.h"
#include "FuzzSurface.h"
#include "FuzzTarget.h"

#include "Refraction/Stack/StackSolver.h"
#include "Refraction/StackImages/StackImages.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

namespace meniscus::test
{
namespace
{

constexpr int MostInterfaces = 3;

std::vector<Interface> ReadList(ByteReader& reader)
{
  std::vector<Interface> list;
  for (int i = 1 + reader.Below(MostInterfaces); i > 0; --i)
  {
    Interface next;
    if (!list.empty() && reader.Below(4) == 3)
    {
      next.Surface = list.back().Surface;
      next.Media = { list.back().Media.Exterior, list.back().Media.Interior };
    }
    else
    {
      const FuzzSurface arrays(reader);
      auto surface = std::make_shared<RefractingSurface>();
      const MembraneStatus status =
        surface->SetMembrane(arrays.GetInput(), SurfaceParts::Crossings);
      CheckSurface(surface->GetMembrane(), arrays.GetInput(), status);
      if (status != MembraneStatus::Ready || !IsOfSolvableSize(surface->GetMembrane()))
      {
        return {};
      }
      next.Surface = surface;
      // The medium of the interface before it, so that most lists match.
      next.Media.Exterior = list.empty() || reader.Below(8) == 7 ? ReadIndexOfRefraction(reader)
                                                                 : list.back().Media.Interior;
      next.Media.Interior = ReadIndexOfRefraction(reader);
    }
    list.push_back(next);
  }
  return list;
}

/**
 * Requires that the last ray of a path goes to the point. Newton's method leaves an error of
 * LargestError = 1e-10 of a facet (StackShot.cxx), which is no longer than the largest distance;
 * the angle that it makes at the point is that over the length of the last leg. 1e-6 leaves room
 * for the magnification of the later surfaces, whose footprints are a few facets.
 */
void CheckPath(const StackSolver& solver, const glm::dvec3& point, const StackPath& path)
{
  const RefractionStack& stack = solver.GetStack();
  Require(path.Count <= stack.GetLinks().size(), "a path passes existing interfaces");
  if (path.Count == 0)
  {
    return;
  }
  for (std::size_t i = 0; i < path.Count; ++i)
  {
    Require(path.Points[i].Cosine > 0.0 && path.Points[i].Cosine <= 1.0 + 1e-12,
      "interfaces face the rays that pass them");
  }
  const glm::dvec3 local = point - stack.GetOrigin();
  const RayJet& ray = path.GetLast();
  double largest = glm::length(local) + glm::length(stack.GetEye());
  for (std::size_t i = 0; i < path.Count; ++i)
  {
    largest = std::max(largest, glm::length(path.Points[i].Ray.Origin));
  }
  const glm::dvec3 away = local - ray.Origin;
  const double miss = glm::length(away - glm::dot(away, ray.Direction) * ray.Direction);
  Require(miss <= 1e-6 * largest, "the last ray of a path goes to the point");
}

void CheckPoints(const StackSolver& solver, const FuzzObject& object)
{
  const std::size_t points = object.GetNumberOfPoints();
  const std::size_t interfaces = solver.GetStack().GetNumberOfInterfaces();
  std::vector<VirtualVertex> vertices(points);
  std::vector<StackDetail> details(points);
  std::vector<double> legs(points * interfaces + 1);
  solver.Solve(object.Points.data(), 0, points, vertices.data(), details.data(), legs.data());
  std::vector<StackPath> images;
  for (std::size_t i = 0; i < points; ++i)
  {
    CheckImage(vertices[i], std::numeric_limits<std::int32_t>::max());
    Require(details[i].Transmittance >= 0.0 && details[i].Transmittance <= 1.0,
      "transmittances are shares");
    const ImageState state = solver.FindImages(object.GetPoint(i), images);
    Require((state == ImageState::Found) == !images.empty(), "the state is that of the images");
    for (const StackPath& path : images)
    {
      CheckPath(solver, object.GetPoint(i), path);
      CheckImage(
        solver.MakeVertex(object.GetPoint(i), path), std::numeric_limits<std::int32_t>::max());
    }
  }
  for (const double leg : legs)
  {
    Require(leg >= 0.0, "legs have lengths");
  }
}

}

//------------------------------------------------------------------------------
void FuzzStack(const std::uint8_t* bytes, std::size_t size)
{
  ByteReader reader(bytes, size);
  const std::vector<Interface> list = ReadList(reader);
  const FuzzObject object(reader);
  StackSolver solver;
  if (list.empty() || solver.SetInterfaces(list).Fault != MediaFault::None ||
    solver.SetEye(reader.Vector()) != EyeStatus::Ready)
  {
    return;
  }
  CheckPoints(solver, object);
  const std::size_t count = object.GetNumberOfPoints();
  StackImages images(solver);
  images.SetPoints(object.Points.data(), count);
  images.SolvePoints(0, count);
  images.FinishPoints();
  images.SetTolerance(0.005 + 0.1 * reader.Share());
  object.Map(images, reader.Flag());
}

}
