// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Curved/CurvedMembraneSolver.h"

#include "Refraction/Curved/PatchRoots.h"
#include "Refraction/Membrane/Optics.h"
#include "Refraction/Surface/PatchCrossings.h"
#include "Refraction/Tubes/RefractedRayBounds.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

// Limits while a line is followed across patches: the number of patches, and of facets to cross on
// the way from one to the next.
constexpr int MostPatches = 8;
constexpr int MostFacets = 64;

// A search from the middle of a patch, where nothing is known: steps of Newton's method, and how
// far its iterates may leave the facet, in facets.
constexpr int FirstSteps = 10;
constexpr double FirstReach = 1.5;

// Images of one point in two patches are the same if their sight points are this close, in units of
// the patch's size: they lie on a common edge and differ by the error of Newton's method only.
constexpr double SamePlace = 1e-6;

// Depth below the membrane's top, in units of its radius, from which on objects share a grid.
constexpr double SmallestDepth = 0x1p-10;

constexpr std::int32_t AllFacets = std::numeric_limits<std::int32_t>::max();

}

//------------------------------------------------------------------------------
MembraneStatus CurvedMembraneSolver::SetMembrane(const MembraneInput& input, const RangeLoop& loop)
{
  this->Own = this->Own ? this->Own : std::make_shared<RefractingSurface>();
  const MembraneStatus status = this->Own->SetMembrane(input, SurfaceParts::Patches, loop);
  this->SetSurface(this->Own);
  return status;
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::SetSurface(const std::shared_ptr<const RefractingSurface>& surface)
{
  this->Surface = surface;
  if (this->TreeOf != surface->GetTopology())
  {
    this->BuildTree();
  }
  else
  {
    this->Tree.SetUnit(this->GetMembrane().GetRadius());
  }
  this->FindAxis();
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::BuildTree()
{
  const std::vector<glm::dvec3> centroids = this->GetMembrane().ComputeCentroids();
  this->Tree.Build(centroids, centroids.empty() ? 1.0 : this->GetMembrane().GetRadius());
  this->TreeOf = this->Surface->GetTopology();
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::FindAxis()
{
  this->SidesReady = false;
  this->SidesAboveReady = false;
  glm::dvec3 sum(0.0);
  for (const Membrane::Facet& facet : this->GetMembrane().GetFacets())
  {
    for (const std::int32_t vertex : facet)
    {
      sum += this->GetMembrane().GetNormals()[static_cast<std::size_t>(vertex)];
    }
  }
  this->FindEnclosure();
  const double length = glm::length(sum);
  // Normals of a closed membrane cancel out, so a fixed direction is taken. No plane whose normal
  // has small integer components contains this direction: the squares of its components are 1, 2
  // and 3 over 6.
  const glm::dvec3 oblique(std::sqrt(1.0 / 6.0), std::sqrt(1.0 / 3.0), std::sqrt(0.5));
  this->Axis = length > 0.0 && !this->Closed ? sum / length : oblique;
  this->Frame = HeightFrame(this->Axis);
  this->RayFrame = this->Frame;
  this->FieldReady = false;
  this->Grids.clear();
  this->ConvexField = false;
  this->LargestBulge = 0.0;
  this->Lowest = std::numeric_limits<double>::max();
  this->Highest = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0; i < this->GetMembrane().GetFacets().size(); ++i)
  {
    const CurvedPatch patch = this->GetPatches().GetPatch(static_cast<std::int32_t>(i));
    const double bulge = BoundBulge(patch);
    this->LargestBulge = std::max(this->LargestBulge, bulge);
    for (const glm::dvec3& corner : patch.Corner)
    {
      const double height = glm::dot(this->Axis, corner);
      this->Lowest = std::min(this->Lowest, height - bulge);
      this->Highest = std::max(this->Highest, height + bulge);
    }
  }
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::PrepareField()
{
  if (!this->FieldReady)
  {
    this->ConvexField =
      !this->Closed && IsConvexField(this->GetMembrane(), this->GetPatches(), this->Frame);
    this->FieldReady = true;
  }
}

//------------------------------------------------------------------------------
const InjectivityGrid& CurvedMembraneSolver::PrepareGrid(double lowest, const RangeLoop& loop)
{
  // The rounding error of a height is a few roundings of its coordinates.
  const double slack = 16.0 * std::numeric_limits<double>::epsilon() *
    (std::fabs(lowest) + glm::length(this->GetMembrane().GetOrigin()) +
      this->GetMembrane().GetRadius());
  const double top = (this->Optics.Reflects ? -this->Lowest : this->Highest) + slack;
  const double radii = (top - (lowest - slack)) / this->GetMembrane().GetRadius();
  int exponent = 0;
  std::frexp(std::max(radii, SmallestDepth), &exponent);
  const auto [place, isNew] = this->Grids.try_emplace(exponent);
  InjectivityGrid& grid = place->second;
  if (isNew)
  {
    grid.Build(this->GetMembrane(), this->GetPatches(), this->RayFrame, this->ConvexField,
      this->LargestBulge, this->Optics, top - std::ldexp(this->GetMembrane().GetRadius(), exponent),
      top, loop);
  }
  return grid;
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::FindEnclosure()
{
  const auto& facets = this->GetMembrane().GetFacets();
  this->Closed = !facets.empty();
  double volume = 0.0; // six times the enclosed volume, by the divergence theorem; positive for
                       // outward normals
  for (std::size_t i = 0; i < facets.size() && this->Closed; ++i)
  {
    const auto at = [this, &facets, i](std::size_t k) -> const glm::dvec3&
    { return this->GetMembrane().GetPositions()[static_cast<std::size_t>(facets[i][k])]; };
    const glm::dvec3 winding = glm::cross(at(1) - at(0), at(2) - at(0));
    glm::dvec3 normal(0.0);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const bool isBorder = this->GetPatches().GetNeighbour(static_cast<std::int32_t>(i),
                              static_cast<int>(k)) == CurvedPatches::NoFacet;
      this->Closed = this->Closed && !isBorder;
      normal += this->GetMembrane().GetNormals()[static_cast<std::size_t>(facets[i][k])];
    }
    volume += std::copysign(1.0, glm::dot(winding, normal)) * glm::dot(at(0), winding);
  }
  this->OutsideIsFront = this->Closed && volume > 0.0;
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::PrepareSides()
{
  if (!this->SidesReady)
  {
    this->Sides.Build(this->GetMembrane(), this->GetPatches(), this->Frame);
    this->SidesReady = true;
  }
  if (this->Optics.Reflects && !this->SidesAboveReady)
  {
    this->SidesAbove.Build(this->GetMembrane(), this->GetPatches(), HeightFrame(-this->Axis));
    this->SidesAboveReady = true;
  }
}

//------------------------------------------------------------------------------
bool CurvedMembraneSolver::IsInFront(const glm::dvec3& local) const
{
  if (this->IsAboveAll(local))
  {
    return true;
  }
  const MembraneSides::Side side = this->Sides.Find(local);
  return side == MembraneSides::Side::Unknown ? this->OutsideIsFront
                                              : side != MembraneSides::Side::Behind;
}

//------------------------------------------------------------------------------
// Side by the nearest patch below the point, else by the nearest patch above it. Beyond the border
// of an open mirror there is neither; such a point may still be reflected, by a dome for instance,
// and its side is unknown.
MembraneSides::Side CurvedMembraneSolver::FindSideOfMirror(const glm::dvec3& local) const
{
  using Side = MembraneSides::Side;
  if (this->IsAboveAll(local))
  {
    return Side::Front;
  }
  const Side below = this->Sides.Find(local);
  if (below != Side::Unknown)
  {
    return below;
  }
  return this->Closed ? (this->OutsideIsFront ? Side::Front : Side::Behind)
                      : this->SidesAbove.Find(local);
}

//------------------------------------------------------------------------------
// Answers for points that a mirror does not reflect: those on it are their own images, those behind
// it have none. Returns false for all others.
bool CurvedMembraneSolver::FindOnMirror(const glm::dvec3& local, VirtualVertex& vertex) const
{
  const MembraneSides::Side side = this->FindSideOfMirror(local);
  if (side == MembraneSides::Side::On)
  {
    vertex = this->PassThrough(local);
  }
  return side == MembraneSides::Side::On || side == MembraneSides::Side::Behind;
}

//------------------------------------------------------------------------------
bool CurvedMembraneSolver::AreAllOnRaySide(const double* points, std::size_t count) const
{
  const glm::dvec3& origin = this->GetMembrane().GetOrigin();
  for (const double* p = points; p != points + 3 * count; p += 3)
  {
    const glm::dvec3 local = glm::dvec3(p[0], p[1], p[2]) - origin;
    if (!(this->Optics.Reflects ? this->IsAboveAll(local) : this->IsBehindAll(local)))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::Clear()
{
  this->Surface = std::make_shared<RefractingSurface>();
  this->Own.reset();
  this->Tree = RayTubeTree();
  this->TreeOf = -1;
  this->Grids.clear();
  this->SidesReady = false;
  this->SidesAboveReady = false;
}

//------------------------------------------------------------------------------
EyeStatus CurvedMembraneSolver::SetEye(
  const glm::dvec3& eye, double exterior, double interior, const RangeLoop& loop, bool reflects)
{
  const EyeStatus status = this->PlaceEye(eye, exterior, interior);
  if (status != EyeStatus::Ready)
  {
    return status;
  }
  if (reflects)
  {
    this->Optics.Reflects = true;
    this->RayFrame = HeightFrame(-this->Axis);
    this->PrepareSides();
  }
  this->PrepareTree(loop);
  return this->Touched ? EyeStatus::OnTheMembrane : EyeStatus::Ready;
}

//------------------------------------------------------------------------------
EyeStatus CurvedMembraneSolver::PlaceEye(const glm::dvec3& eye, double exterior, double interior)
{
  const EyeStatus status = CheckEye(eye, exterior, interior);
  if (status == EyeStatus::Ready)
  {
    this->Optics = { eye - this->GetMembrane().GetOrigin(), exterior, interior, false };
    this->RayFrame = this->Frame;
    this->Grids.clear();
    this->TreeOnce = std::make_unique<std::once_flag>();
  }
  return status;
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::PrepareTree(const RangeLoop& loop) const
{
  std::call_once(*this->TreeOnce,
    [this, &loop]
    {
      this->Touched = false;
      this->Tree.Refit(
        [this](std::int32_t facet)
        {
          const CurvedPatch patch = this->GetPatches().GetPatch(facet);
          if (this->IsEyeOnPatch(patch))
          {
            this->Touched = true;
          }
          return this->Optics.Reflects ? BoundReflectedRays(patch, this->Optics.Eye)
                                       : BoundRefractedRays(patch, this->Optics.Eye,
                                           this->Optics.Exterior / this->Optics.Interior);
        },
        loop);
    });
}

//------------------------------------------------------------------------------
// Heights are sums of three products; the axis is a normalised sum.
bool CurvedMembraneSolver::IsFlat() const
{
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  return !this->Closed &&
    this->Highest - this->Lowest <= rounding * this->GetMembrane().GetRadius();
}

//------------------------------------------------------------------------------
bool CurvedMembraneSolver::IsEyeOnPatch(const CurvedPatch& patch) const
{
  constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  const double slack =
    rounding * std::max(this->GetMembrane().GetRadius(), glm::length(this->Optics.Eye));
  return IsOnPatch(patch, this->Optics.Eye, slack);
}

//------------------------------------------------------------------------------
bool CurvedMembraneSolver::FacesEye() const
{
  return this->GetMembrane().ShowsSide(this->Optics.Eye, 1.0);
}

//------------------------------------------------------------------------------
std::size_t CurvedMembraneSolver::CountVerticesBehindOtherPieces(std::size_t most) const
{
  const SurfacePieces& pieces = this->GetMembrane().GetPieces();
  const auto& facets = this->GetMembrane().GetFacets();
  if (pieces.Count < 2)
  {
    return 0;
  }
  std::size_t count = 0;
  std::vector<VirtualVertex> images;
  const std::size_t step = std::max<std::size_t>(facets.size() / most, 1);
  for (std::size_t i = 0; i < facets.size(); i += step)
  {
    const auto vertex = static_cast<std::size_t>(facets[i][0]);
    const glm::dvec3 point =
      this->GetMembrane().GetPositions()[vertex] + this->GetMembrane().GetOrigin();
    this->FindImages(point, images);
    count += std::any_of(images.begin(), images.end(),
      [this, &pieces, &point, i, vertex](const VirtualVertex& image)
      {
        // Vertices that two pieces share are their own images.
        constexpr double touching = 1e-6;
        return pieces.PieceOf[static_cast<std::size_t>(image.Facet)] != pieces.PieceOf[i] &&
          image.Depth > touching * this->GetMembrane().GetRadius() &&
          glm::dot(point - image.SightPoint, this->GetMembrane().GetNormals()[vertex]) < 0.0;
      });
  }
  return count;
}

//------------------------------------------------------------------------------
bool CurvedMembraneSolver::MayShow(
  const glm::dvec3& low, const glm::dvec3& high, const std::vector<bool>& chosen) const
{
  const glm::dvec3 middle = 0.5 * low + 0.5 * high - this->GetMembrane().GetOrigin();
  const glm::dvec3 half = 0.5 * high - 0.5 * low;
  const glm::dvec3 top(std::copysign(half.x, this->Axis.x), std::copysign(half.y, this->Axis.y),
    std::copysign(half.z, this->Axis.z));
  return !this->IsInReach(middle) || (!this->Optics.Reflects && !this->IsBehindAll(middle + top)) ||
    this->GetTree().HasAny(middle, half, chosen);
}

//------------------------------------------------------------------------------
bool CurvedMembraneSolver::MeetLine(const ObjectLine& line, const glm::dvec3& seenAlong,
  std::int32_t& facet, glm::dvec2& b, double& l) const
{
  for (int i = 0; i < MostPatches; ++i)
  {
    const CurvedPatch patch = this->GetPatches().GetPatch(facet);
    if (!MeetPatch(patch, line, b, l))
    {
      return false;
    }
    if (FindOutside(b).Least >= -PatchCrossings::Border)
    {
      return true;
    }
    const glm::dvec3 target = patch.GetFlatPoint(b);
    const std::int32_t next = this->GetPatches().Walk(facet, target, seenAlong, MostFacets);
    if (next == facet)
    {
      return false; // beyond the border
    }
    facet = next;
    b = this->GetPatches().GetPatch(facet).ProjectToFacet(target);
  }
  return false;
}

//------------------------------------------------------------------------------
bool CurvedMembraneSolver::FindFirst(
  const SightEquation& equation, const glm::dvec3& local, SightPlace& place) const
{
  // The cheap attempt comes first: Newton's method from the middle of each patch that may show the
  // point.
  place.Facet = CurvedPatches::NoFacet;
  this->GetTree().Visit(local, glm::dvec3(0.0),
    [this, &equation, &place](std::int32_t facet)
    {
      const CurvedPatch patch = this->GetPatches().GetPatch(facet);
      const SightRoot root = equation.Solve(patch, glm::dvec2(1.0 / 3.0), FirstSteps, FirstReach);
      if (root.End == SightRoot::End::Converged &&
        FindOutside(root.B).Least >= -PatchCrossings::Border && equation.IsImage(root.At))
      {
        place = { facet, root };
        return std::int32_t(0);
      }
      return AllFacets;
    });
  if (place.Facet == CurvedPatches::NoFacet)
  {
    std::vector<SightPlace> places;
    this->FindPlaces(equation, local, places);
    if (!places.empty())
    {
      place = places.front();
    }
  }
  return place.Facet != CurvedPatches::NoFacet;
}

//------------------------------------------------------------------------------
void CurvedMembraneSolver::FindPlaces(
  const SightEquation& equation, const glm::dvec3& local, std::vector<SightPlace>& places) const
{
  places.clear();
  bool isComplete = true;
  this->GetTree().Visit(local, glm::dvec3(0.0),
    [this, &equation, &places, &isComplete](std::int32_t facet)
    {
      const CurvedPatch patch = this->GetPatches().GetPatch(facet);
      PatchRoots images(equation, patch);
      images.Find();
      isComplete = isComplete && images.IsComplete();
      for (const SightRoot& root : images)
      {
        if (equation.IsImage(root.At))
        {
          places.push_back({ facet, root });
        }
      }
      return AllFacets;
    });
  if (!isComplete)
  {
    ++this->UndecidedSearches;
  }
  std::sort(places.begin(), places.end(),
    [](const SightPlace& a, const SightPlace& b)
    {
      const glm::dvec2& first = a.Root.B;
      const glm::dvec2& second = b.Root.B;
      return a.Facet != b.Facet ? a.Facet < b.Facet
                                : (first.x != second.x ? first.x < second.x : first.y < second.y);
    });
}

//------------------------------------------------------------------------------
ImageState CurvedMembraneSolver::FindImages(
  const glm::dvec3& point, std::vector<VirtualVertex>& images) const
{
  images.clear();
  const glm::dvec3 local = point - this->GetMembrane().GetOrigin();
  if (!this->IsInReach(local))
  {
    return ImageState::NotFinite;
  }
  VirtualVertex own;
  if (this->Optics.Reflects && this->FindOnMirror(local, own))
  {
    images.assign(own.State == ImageState::Found ? 1 : 0, own);
    return own.State;
  }
  const SightEquation equation = this->MakeEquation(local);
  thread_local std::vector<SightPlace> places; // kept between points so that its memory is reused
  this->FindPlaces(equation, local, places);
  for (const SightPlace& place : places)
  {
    const CurvedPatch patch = this->GetPatches().GetPatch(place.Facet);
    const VirtualVertex vertex = this->MakeVertex(local, patch, place);
    const double same = SamePlace * patch.GetSize();
    const bool known = std::any_of(images.begin(), images.end(),
      [&vertex, same](const VirtualVertex& other)
      { return glm::length(other.SightPoint - vertex.SightPoint) < same; });
    if (!known)
    {
      images.push_back(vertex);
    }
  }
  return images.empty() ? ImageState::NoImage : ImageState::Found;
}

//------------------------------------------------------------------------------
VirtualVertex CurvedMembraneSolver::PassThrough(const glm::dvec3& local) const
{
  VirtualVertex vertex;
  vertex.Position = local + this->GetMembrane().GetOrigin();
  vertex.SightPoint = vertex.Position;
  vertex.State = ImageState::Found;
  return vertex;
}

}
