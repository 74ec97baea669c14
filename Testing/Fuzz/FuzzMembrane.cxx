// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images of points, lines and polygons behind one refracting or reflecting surface.
#include "ByteReader.h"
#include "FuzzSurface.h"
#include "FuzzTarget.h"

#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Flat/FlatMembraneSolver.h"
#include "Refraction/Images/ObjectImages.h"
#include "Refraction/Surface/CurveCrossings.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace meniscus::test
{
namespace
{

struct View
{
  glm::dvec3 Eye;
  double Exterior;
  double Interior;
  bool Reflects;
};

View ReadView(ByteReader& reader)
{
  View view;
  view.Eye = reader.Vector();
  view.Exterior = ReadIndexOfRefraction(reader);
  view.Interior = ReadIndexOfRefraction(reader);
  view.Reflects = reader.Below(4) == 3;
  return view;
}

void CheckFlat(const MembraneInput& input, const View& view, const FuzzObject& object)
{
  FlatMembraneSolver solver;
  const MembraneStatus status = solver.SetMembrane(input);
  CheckSurface(solver.GetMembrane(), input, status);
  if (status != MembraneStatus::Ready || !IsOfSolvableSize(solver.GetMembrane()) ||
    solver.SetEye(view.Eye, view.Exterior, view.Interior) != EyeStatus::Ready)
  {
    return;
  }
  for (std::size_t i = 0; i < object.GetNumberOfPoints(); ++i)
  {
    const VirtualVertex image = solver.SolvePoint(object.GetPoint(i));
    const VirtualVertex expected = solver.SolvePointByBruteForce(object.GetPoint(i));
    CheckImage(image, solver.GetMembrane().GetFacets().size());
    Require(image.State == expected.State && image.Facet == expected.Facet &&
        (image.State != ImageState::Found || image.Position == expected.Position),
      "the tree finds the image of the loop over all facets");
  }
}

/**
 * Requires Snell's law at the sight point of an image, with the normal of the surface where the
 * sight ray meets it. Newton's method leaves an error of 1e-10 of a facet and of the distance to
 * the eye and the point; normals turn by less than a few radians per facet, and the angle between
 * two directions by the error over these distances. The sight point is rounded once to world
 * coordinates.
 */
void CheckSnell(const CurvedMembraneSolver& solver, const View& view, const glm::dvec3& point,
  const VirtualVertex& image)
{
  if (image.State != ImageState::Found || image.Facet < 0)
  {
    return;
  }
  const glm::dvec3 sight = image.SightPoint - view.Eye;
  const glm::dvec3 onward = point - image.SightPoint;
  const double nearest = std::min(glm::length(sight), glm::length(onward));
  const double largest = std::max({ glm::length(view.Eye), glm::length(point),
    glm::length(image.SightPoint), glm::length(solver.GetMembrane().GetOrigin()) });
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * largest / nearest;
  const CurvedPatch patch = solver.GetPatches().GetPatch(image.Facet);
  const glm::dvec3 target = image.SightPoint - solver.GetMembrane().GetOrigin();
  const glm::dvec3& eye = solver.GetMedia().Eye;
  glm::dvec2 b = patch.ProjectToFacet(target);
  double l = 1.0;
  if (!(rounding < 1e-3) || !MeetPatch(patch, { eye, target - eye }, b, l))
  {
    return;
  }
  const glm::dvec3 normal = glm::normalize(patch.Evaluate(b).Normal);
  const glm::dvec3 before = glm::cross(normal, glm::normalize(sight));
  const glm::dvec3 behind = glm::cross(normal, glm::normalize(onward));
  const double exterior = view.Reflects ? 1.0 : view.Exterior;
  const double interior = view.Reflects ? 1.0 : view.Interior;
  const double difference = glm::length(exterior * before - interior * behind);
  Require(difference <= (1e-6 + rounding) * (exterior + interior), "images obey Snell's law");
}

void CheckCurved(CurvedMembraneSolver& solver, const View& view, const FuzzObject& object)
{
  const std::size_t facets = solver.GetMembrane().GetFacets().size();
  CurvedMembraneSolver::Memory memory;
  std::vector<VirtualVertex> images;
  for (std::size_t i = 0; i < object.GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 point = object.GetPoint(i);
    const VirtualVertex one = solver.SolvePoint(point, memory);
    CheckImage(one, facets);
    CheckSnell(solver, view, point, one);
    const ImageState state = solver.FindImages(point, images);
    Require((state == ImageState::Found) == !images.empty(), "the state is that of the images");
    for (const VirtualVertex& image : images)
    {
      CheckImage(image, facets);
      CheckSnell(solver, view, point, image);
    }
  }
}

void MapObject(CurvedMembraneSolver& solver, const FuzzObject& object, ByteReader& reader)
{
  const std::size_t count = object.GetNumberOfPoints();
  const bool mayCross = !solver.AreAllOnRaySide(object.Points.data(), count);
  if (mayCross)
  {
    solver.PrepareSides();
  }
  ObjectImages images(solver);
  images.SetTolerance(0.005 + 0.1 * reader.Share());
  images.SetPoints(object.Points.data(), count, mayCross);
  solver.PrepareField();
  images.PrepareUnique(
    reader.Flag() ? count : std::numeric_limits<std::uint32_t>::max(), 0, SerialLoop);
  images.SolvePoints(0, count);
  images.FinishPoints();
  object.Map(images, reader.Flag());
}

}

//------------------------------------------------------------------------------
void FuzzMembrane(const std::uint8_t* bytes, std::size_t size)
{
  ByteReader reader(bytes, size);
  FuzzSurface surface(reader);
  const FuzzObject object(reader);
  const View view = ReadView(reader);
  CheckFlat(surface.GetInput(), view, object);
  CurvedMembraneSolver solver;
  // A second time with other points: topology and trees are kept.
  for (int shape = 1 + reader.Below(2); shape > 0; --shape)
  {
    const MembraneStatus status = solver.SetMembrane(surface.GetInput());
    CheckSurface(solver.GetMembrane(), surface.GetInput(), status);
    if (status == MembraneStatus::Ready && IsOfSolvableSize(solver.GetMembrane()) &&
      solver.SetEye(view.Eye, view.Exterior, view.Interior, SerialLoop, view.Reflects) ==
        EyeStatus::Ready)
    {
      CheckCurved(solver, view, object);
      MapObject(solver, object, reader);
    }
    surface.ReadPoints(reader);
  }
}

}
