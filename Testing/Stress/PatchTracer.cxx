// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PatchTracer.h"

namespace meniscus::test
{

namespace
{

// Newton's method converges quadratically: below this step, in facets, the error is rounding.
constexpr double LastStep = 1e-9;

// Rounding of a barycentric coordinate at a common edge; two patches may both have the crossing.
constexpr double EdgeRounding = 1e-9;

double GetInside(const glm::dvec2& b)
{
  return std::min({ b.x, b.y, 1.0 - b.x - b.y });
}

// Solves patch(b) = origin + scale l direction; returns false if it does not converge near the
// facet.
bool Meet(const CurvedPatch& patch, const glm::dvec3& origin, const glm::dvec3& ray, glm::dvec2& b,
  double& l)
{
  for (int i = 0; i < 30; ++i)
  {
    PatchJet jet;
    patch.Evaluate(b, jet);
    const glm::dvec3 rest = origin + l * ray - jet.Position;
    // Cramer's rule for x by0 + y by1 - z ray = rest.
    const double determinant = -glm::dot(jet.PositionBy[0], glm::cross(jet.PositionBy[1], ray));
    const double x = -glm::dot(rest, glm::cross(jet.PositionBy[1], ray)) / determinant;
    const double y = -glm::dot(jet.PositionBy[0], glm::cross(rest, ray)) / determinant;
    const double z = glm::dot(jet.PositionBy[0], glm::cross(jet.PositionBy[1], rest)) / determinant;
    b += glm::dvec2(x, y);
    l += z;
    // Written so that a NaN fails.
    if (!(std::fabs(b.x) < 3.0 && std::fabs(b.y) < 3.0))
    {
      return false;
    }
    if (std::max({ std::fabs(x), std::fabs(y), std::fabs(z) }) < LastStep)
    {
      return true;
    }
  }
  return false;
}

/** Normal of the patch's shape, on the side of the interpolated one. */
glm::dvec3 GetShapeNormal(const CurvedPatch& patch, const PatchHit& hit)
{
  PatchJet jet;
  patch.Evaluate(hit.B, jet);
  const glm::dvec3 normal = glm::cross(jet.PositionBy[0], jet.PositionBy[1]);
  return glm::dot(normal, hit.Normal) < 0.0 ? -normal : normal;
}

} // anonymous namespace

//------------------------------------------------------------------------------
PatchTracer::PatchTracer(const CurvedPatches& patches, std::size_t facets)
  : Patches(patches)
{
  constexpr int parts = 6;
  for (std::size_t f = 0; f < facets; ++f)
  {
    const CurvedPatch patch = patches.GetPatch(static_cast<std::int32_t>(f));
    const glm::dvec3 centre = patch.Evaluate(glm::dvec2(1.0 / 3.0)).Position;
    double radius = 0.0;
    for (int i = 0; i <= parts; ++i)
    {
      for (int j = 0; i + j <= parts; ++j)
      {
        const glm::dvec3 at = patch.Evaluate(glm::dvec2(i, j) / double(parts)).Position;
        radius = std::max(radius, glm::length(at - centre));
      }
    }
    this->Spheres.push_back({ centre, 1.2 * radius });
  }
}

//------------------------------------------------------------------------------
std::vector<PatchHit> PatchTracer::FindCrossings(const glm::dvec3& origin,
  const glm::dvec3& direction, bool fromFront, double least, Sides sides) const
{
  std::vector<PatchHit> hits;
  for (std::size_t f = 0; f < this->Spheres.size(); ++f)
  {
    const Sphere& sphere = this->Spheres[f];
    const glm::dvec3 away = sphere.Centre - origin;
    const double along = glm::dot(away, direction);
    const glm::dvec3 across = away - along * direction;
    if (along < least - sphere.Radius || glm::dot(across, across) > sphere.Radius * sphere.Radius)
    {
      continue;
    }
    const auto facet = static_cast<std::int32_t>(f);
    const CurvedPatch patch = this->Patches.GetPatch(facet);
    const double scale = std::max(patch.GetSize(), std::fabs(along));
    const std::size_t known = hits.size();
    for (const glm::dvec2& start : { glm::dvec2(1.0 / 3.0), glm::dvec2(0.05, 0.05),
           glm::dvec2(0.9, 0.05), glm::dvec2(0.05, 0.9) })
    {
      glm::dvec2 b = start;
      double l = along / scale;
      if (!Meet(patch, origin, scale * direction, b, l) || GetInside(b) < -EdgeRounding ||
        !(l * scale > least))
      {
        continue;
      }
      PatchHit hit = this->Evaluate(facet, b, fromFront);
      hit.Distance = l * scale;
      const bool isKnown = std::any_of(hits.begin() + static_cast<std::ptrdiff_t>(known),
        hits.end(), [&b](const PatchHit& other) { return glm::length(other.B - b) < 1e-6; });
      const glm::dvec3 normal = sides == Sides::ByShape ? GetShapeNormal(patch, hit) : hit.Normal;
      if (!isKnown && glm::dot(normal, direction) < 0.0)
      {
        hits.push_back(hit);
      }
    }
  }
  std::sort(hits.begin(), hits.end(),
    [](const PatchHit& a, const PatchHit& b) { return a.Distance < b.Distance; });
  return hits;
}

//------------------------------------------------------------------------------
PatchHit PatchTracer::FindFoot(std::int32_t facet, const glm::dvec3& position, bool fromFront) const
{
  const CurvedPatch patch = this->Patches.GetPatch(facet);
  glm::dvec2 b = patch.ProjectToFacet(position);
  // Patches are nearly flat: each step leaves a fraction of the error.
  constexpr int steps = 60;
  for (int i = 0; i < steps; ++i)
  {
    const glm::dvec3 rest = position - patch.Evaluate(b).Position;
    b = patch.ProjectToFacet(patch.GetFlatPoint(b) + rest);
  }
  return this->Evaluate(facet, b, fromFront);
}

//------------------------------------------------------------------------------
PatchHit PatchTracer::Evaluate(std::int32_t facet, const glm::dvec2& b, bool fromFront) const
{
  const PatchPoint at = this->Patches.GetPatch(facet).Evaluate(b);
  const glm::dvec3 normal = glm::normalize(at.Normal);
  return { facet, b, 0.0, at.Position, fromFront ? normal : -normal, GetInside(b) };
}

//------------------------------------------------------------------------------
bool PatchTracer::IsAtBorder(std::int32_t facet, const glm::dvec2& b, double width) const
{
  const double distance[3] = { 1.0 - b.x - b.y, b.x, b.y };
  for (int corner = 0; corner < 3; ++corner)
  {
    if (distance[corner] < width &&
      this->Patches.GetNeighbour(facet, corner) == CurvedPatches::NoFacet)
    {
      return true;
    }
  }
  return false;
}

} // namespace meniscus::test
