// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Flat/FlatMembraneSolver.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace meniscus
{

//------------------------------------------------------------------------------
MembraneStatus FlatMembraneSolver::SetMembrane(const MembraneInput& input)
{
  this->Own = this->Own ? this->Own : std::make_shared<RefractingSurface>();
  const MembraneStatus status = this->Own->SetMembrane(input, SurfaceParts::Facets);
  this->SetSurface(this->Own);
  return status;
}

//------------------------------------------------------------------------------
void FlatMembraneSolver::SetSurface(const std::shared_ptr<const RefractingSurface>& surface)
{
  this->Surface = surface;
  const std::vector<glm::dvec3> centroids = this->GetMembrane().ComputeCentroids();
  this->Tree.Build(centroids, centroids.empty() ? 1.0 : this->GetMembrane().GetRadius());
}

//------------------------------------------------------------------------------
EyeStatus FlatMembraneSolver::SetEye(
  const glm::dvec3& eye, double exterior, double interior, const RangeLoop& loop)
{
  this->Exterior = exterior;
  this->Interior = interior;
  const EyeStatus status = this->Cells.Update(
    this->GetMembrane(), eye - this->GetMembrane().GetOrigin(), exterior, interior, loop);
  if (status == EyeStatus::Ready)
  {
    this->Tree.Refit([this](std::int32_t facet) { return this->Cells.GetBounds(facet); }, loop);
  }
  return status;
}

//------------------------------------------------------------------------------
void FlatMembraneSolver::Solve(
  const double* points, std::size_t begin, std::size_t end, VirtualVertex* vertices) const
{
  for (std::size_t i = begin; i < end; ++i)
  {
    const double* p = points + 3 * i;
    vertices[i] = this->SolvePoint(glm::dvec3(p[0], p[1], p[2]));
  }
}

//------------------------------------------------------------------------------
// Image in the first of the facets that `visit(local, test)` tests; a test returns the number from
// which facets need no test.
template <typename Visit>
VirtualVertex FlatMembraneSolver::SolveAmong(const glm::dvec3& point, const Visit& visit) const
{
  VirtualVertex vertex;
  vertex.Position = point;
  const glm::dvec3 local = point - this->GetMembrane().GetOrigin();
  if (!this->IsInReach(local))
  {
    vertex.State = ImageState::NotFinite;
    return vertex;
  }
  std::int32_t first = std::numeric_limits<std::int32_t>::max();
  CellHit firstHit{};
  visit(local,
    [this, &local, &first, &firstHit](std::int32_t facet)
    {
      CellHit hit;
      if (this->Cells.Contains(facet, local, hit))
      {
        first = facet;
        firstHit = hit;
      }
      return first;
    });
  return first < std::numeric_limits<std::int32_t>::max() ? this->MakeVertex(local, first, firstHit)
                                                          : vertex;
}

//------------------------------------------------------------------------------
VirtualVertex FlatMembraneSolver::SolvePoint(const glm::dvec3& point) const
{
  return this->SolveAmong(point,
    [this](const glm::dvec3& local, const auto& test)
    { this->Tree.Visit(local, glm::dvec3(0.0), test); });
}

//------------------------------------------------------------------------------
VirtualVertex FlatMembraneSolver::SolvePointByBruteForce(const glm::dvec3& point) const
{
  const auto count = static_cast<std::int32_t>(this->GetMembrane().GetFacets().size());
  return this->SolveAmong(point,
    [count](const glm::dvec3&, const auto& test)
    {
      for (std::int32_t facet = 0; facet < count && test(facet) > facet; ++facet)
      {
      }
    });
}

//------------------------------------------------------------------------------
bool FlatMembraneSolver::MayShow(
  const glm::dvec3& point, double padding, const std::vector<bool>& chosen) const
{
  const glm::dvec3 local = point - this->GetMembrane().GetOrigin();
  return !this->IsInReach(local) || this->Tree.HasAny(local, glm::dvec3(padding), chosen);
}

//------------------------------------------------------------------------------
bool FlatMembraneSolver::HasOneCell(const glm::dvec3& point, double wall) const
{
  const glm::dvec3 local = point - this->GetMembrane().GetOrigin();
  if (!this->IsInReach(local))
  {
    return false;
  }
  // A point that is outside by `wall` in each coordinate is at most 2 `wall` edge lengths away from
  // the cell.
  const double edge = 2.0 * RefractionCells::GetLargestStretch() *
    (glm::length(local) + std::sqrt(3.0) * this->GetMembrane().GetRadius());
  int count = 0;
  this->Tree.Visit(local, glm::dvec3(2.0 * wall * edge),
    [this, &local, wall, &count](std::int32_t facet)
    {
      CellHit hit;
      count += this->Cells.Contains(facet, local, wall, hit);
      return count < 2 ? std::numeric_limits<std::int32_t>::max() : 0;
    });
  return count == 1;
}

//------------------------------------------------------------------------------
VirtualVertex FlatMembraneSolver::MakeVertex(
  const glm::dvec3& local, std::int32_t facet, const CellHit& hit) const
{
  const Membrane& membrane = this->GetMembrane();
  const Membrane::Facet& ids = membrane.GetFacets()[static_cast<std::size_t>(facet)];
  glm::dvec3 sightPoint(0.0);
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double weight = hit.Weights[static_cast<int>(i)];
    sightPoint += weight * membrane.GetPositions()[static_cast<std::size_t>(ids[i])];
    normal += weight * membrane.GetNormals()[static_cast<std::size_t>(ids[i])];
  }
  const glm::dvec3 sight = glm::normalize(sightPoint - this->Cells.GetEye());
  const double bent = glm::length(normal);

  VirtualVertex vertex;
  vertex.Depth = glm::length(local - sightPoint);
  vertex.SightPoint = sightPoint + membrane.GetOrigin();
  // Eq. 2.4.
  vertex.Position =
    sightPoint + sight * (vertex.Depth * this->Exterior / this->Interior) + membrane.GetOrigin();
  // Where the corner normals cancel out, or face away from the eye (Eq. 3.1), the ray is taken to
  // be at grazing incidence.
  vertex.Cosine = bent > 0.0 ? std::max(-glm::dot(sight, normal) / bent, 0.0) : 0.0;
  vertex.Reflectance = FresnelReflectance(vertex.Cosine, this->Exterior, this->Interior);
  vertex.Facet = facet;
  vertex.State = ImageState::Found;
  vertex.Orientation = static_cast<signed char>(hit.Orientation);
  return vertex;
}

}
