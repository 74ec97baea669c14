// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refraction/Images/ObjectImages.h"

#include "Refraction/Stack/PlaneImages.h"

#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace meniscus
{
namespace
{

// The cost of testing a facet is a third of the cost that is saved for a point.
constexpr std::size_t FacetsPerPoint = 3;

// Mapping cells from the membrane makes about two pieces for each facet that they may be seen
// through, and four for each cell. Each piece costs as much as testing twenty facets; dividing the
// cells costs half of that.
constexpr std::size_t FacetsPerFacetInReach = 20;
constexpr std::size_t FacetsPerCell = 40;

// A triangle is halved this often at most to prove that its points have one image each.
constexpr int MostHalvings = 6;

// Number of points that are tested together; a divisor of the chunk size.
constexpr std::size_t Run = 8;
static_assert(ObjectImages::Chunk % Run == 0, "runs make chunks");

// Number of cells whose sides are tested together: enough for two blocks of lanes.
constexpr std::size_t CellsAtOnce = 8;

}

//------------------------------------------------------------------------------
void ObjectImages::SetPoints(const double* points, std::size_t count, bool mayCross)
{
  this->ResetPoints(points, count);
  this->MayCross = mayCross;
  this->Chunks.assign((count + Chunk - 1) / Chunk, {});
  this->Wanted.clear();
}

//------------------------------------------------------------------------------
ObjectImages::Extent ObjectImages::FindExtent() const
{
  Extent extent;
  for (std::size_t i = 0; i < this->States.size(); ++i)
  {
    const glm::dvec3 point = this->GetPoint(static_cast<std::int64_t>(i));
    const glm::dvec3 local = point - this->Geometry.GetMembrane().GetOrigin();
    if (this->Geometry.IsInReach(local))
    {
      const double height = this->Geometry.GetFrame().GetHeight(point);
      extent.Lowest = std::min(extent.Lowest, height);
      extent.Highest = std::max(extent.Highest, height);
      extent.Low = glm::min(extent.Low, local);
      extent.High = glm::max(extent.High, local);
    }
  }
  return extent;
}

//------------------------------------------------------------------------------
// True if the proof of single images saves more than it costs.
bool ObjectImages::IsProofWorthwhile(
  const Extent& extent, std::size_t wanted, std::size_t cells) const
{
  const std::size_t facets = this->Geometry.GetMembrane().GetFacets().size();
  std::size_t saved = FacetsPerPoint * wanted;
  if (saved < facets && cells > 0 && this->Geometry.HasConvexField())
  {
    saved += FacetsPerCell * cells;
    this->Geometry.VisitFacets(0.5 * (extent.Low + extent.High), 0.5 * (extent.High - extent.Low),
      [&saved](std::int32_t) { saved += FacetsPerFacetInReach; });
  }
  return saved >= facets;
}

//------------------------------------------------------------------------------
void ObjectImages::PrepareUnique(std::size_t wanted, std::size_t cells, const RangeLoop& loop)
{
  if (this->Geometry.IsClosed() || this->Plane)
  {
    return;
  }
  const Extent extent = this->FindExtent();
  if (extent.Lowest <= extent.Highest && this->IsProofWorthwhile(extent, wanted, cells))
  {
    const double origin =
      this->Geometry.GetFrame().GetHeight(this->Geometry.GetMembrane().GetOrigin());
    this->Unique = &this->Geometry.PrepareGrid(extent.Lowest - origin, loop);
  }
}

//------------------------------------------------------------------------------
// True if no point of the points' bounding box has several images.
bool ObjectImages::IsUnique(const std::int64_t* ids, std::size_t count) const
{
  if (!this->Unique)
  {
    return this->Plane != nullptr;
  }
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 point = this->GetPoint(ids[i]);
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const glm::dvec3& origin = this->Geometry.GetMembrane().GetOrigin();
  return this->Unique->HoldsAtMostOne(low - origin, high - origin);
}

//------------------------------------------------------------------------------
// True if no point of the triangle has several images. Halves of a triangle whose bounding box is
// too large for the proof may have smaller ones.
bool ObjectImages::IsUniqueTriangle(const std::array<glm::dvec3, 3>& corners, int halvings) const
{
  const glm::dvec3& origin = this->Geometry.GetMembrane().GetOrigin();
  if (this->Unique->HoldsAtMostOne(glm::min(glm::min(corners[0], corners[1]), corners[2]) - origin,
        glm::max(glm::max(corners[0], corners[1]), corners[2]) - origin))
  {
    return true;
  }
  if (halvings == 0)
  {
    return false;
  }
  const auto squared = [&corners](std::size_t k)
  {
    const glm::dvec3 side = corners[(k + 2) % 3] - corners[(k + 1) % 3];
    return glm::dot(side, side);
  };
  const std::size_t k =
    squared(1) > squared(0) ? (squared(2) > squared(1) ? 2 : 1) : (squared(2) > squared(0) ? 2 : 0);
  const glm::dvec3& first = corners[(k + 1) % 3];
  const glm::dvec3& last = corners[(k + 2) % 3];
  const glm::dvec3 middle = 0.5 * (first + last);
  return this->IsUniqueTriangle({ corners[k], first, middle }, halvings - 1) &&
    this->IsUniqueTriangle({ corners[k], middle, last }, halvings - 1);
}

//------------------------------------------------------------------------------
bool ObjectImages::MayBeDivided(
  const std::int64_t* ids, const std::vector<std::int64_t>& triangles) const
{
  if (this->Plane)
  {
    return true;
  }
  bool isUnique = this->Geometry.HasConvexField() && this->Unique;
  for (std::size_t k = 0; k + 2 < triangles.size() && isUnique; k += 3)
  {
    isUnique = this->IsUniqueTriangle(
      { this->GetPoint(ids[triangles[k]]), this->GetPoint(ids[triangles[k + 1]]),
        this->GetPoint(ids[triangles[k + 2]]) },
      MostHalvings);
  }
  return isUnique;
}

//------------------------------------------------------------------------------
void ObjectImages::SolvePoints(std::size_t begin, std::size_t end)
{
  static_assert(Chunk == CurvedMembraneSolver::Chain, "a chunk is a chain");
  constexpr std::size_t most = Chunk * CurvedMembraneSolver::ChainsAtOnce;
  for (std::size_t first = begin; first < end; first += most)
  {
    this->SolveChunks(first, std::min(first + most, end));
  }
}

//------------------------------------------------------------------------------
// In most objects consecutive points are near each other, so one test covers several of them.
void ObjectImages::ChooseWays(std::size_t begin, std::size_t end, Way* ways) const
{
  if (!this->IsWanted(begin) || this->States[begin] != ImageState::NotAsked)
  {
    std::fill_n(ways, end - begin, Way::None);
    return;
  }
  std::array<std::int64_t, Run> ids;
  std::iota(ids.begin(), ids.end(), static_cast<std::int64_t>(begin));
  const bool areUnique = this->IsUnique(ids.data(), end - begin);
  const bool maySeeInFront = this->MayCross && !this->Geometry.GetMedia().Reflects;
  for (std::size_t i = begin; i < end; ++i)
  {
    const glm::dvec3 local =
      this->GetPoint(ids[i - begin]) - this->Geometry.GetMembrane().GetOrigin();
    if (maySeeInFront && this->Geometry.IsInReach(local) && !this->Geometry.IsBehindAll(local) &&
      this->Geometry.IsInFront(local))
    {
      ways[i - begin] = Way::Straight;
    }
    else
    {
      const bool isUnique = areUnique || this->IsUnique(&ids[i - begin], 1);
      ways[i - begin] = isUnique ? Way::Unique : Way::Search;
    }
  }
}

//------------------------------------------------------------------------------
// Solves chunks side by side.
void ObjectImages::SolveChunks(std::size_t begin, std::size_t end)
{
  const std::size_t count = end - begin;
  std::vector<Way> ways(count);
  for (std::size_t i = 0; i < count; i += Run)
  {
    this->ChooseWays(begin + i, std::min(begin + i + Run, end), &ways[i]);
  }
  std::vector<unsigned char> isUnique(count);
  std::transform(
    ways.begin(), ways.end(), isUnique.begin(), [](Way way) { return way == Way::Unique ? 1 : 0; });
  std::vector<VirtualVertex> unique(count);
  const double* points = this->Points + 3 * begin;
  if (!this->Plane || SolveAtPlane(*this->Plane, points, 0, count, unique.data(), isUnique.data()))
  {
    this->Geometry.Solve(points, 0, count, unique.data(), isUnique.data());
  }
  std::vector<VirtualVertex> images;
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 point = this->GetPoint(static_cast<std::int64_t>(begin + i));
    ImageState state = ImageState::Found;
    switch (ways[i])
    {
      case Way::None:
        continue;
      case Way::Straight:
        images.assign(
          1, this->Geometry.PassThrough(point - this->Geometry.GetMembrane().GetOrigin()));
        images.front().Position = point;
        images.front().SightPoint = point;
        break;
      case Way::Unique:
        state = unique[i].State;
        images.assign(state == ImageState::Found ? 1 : 0, unique[i]);
        break;
      case Way::Search:
        state = this->Geometry.FindImages(point, images);
        break;
    }
    std::vector<VirtualVertex>& chunk = this->Chunks[(begin + i) / Chunk];
    chunk.insert(chunk.end(), images.begin(), images.end());
    this->States[begin + i] = state;
    this->Counts[begin + i] = static_cast<std::uint32_t>(images.size());
  }
}

//------------------------------------------------------------------------------
void ObjectImages::FinishPoints()
{
  this->Nearest = std::numeric_limits<double>::max();
  this->Farthest = 0.0;
  this->InFront.assign(this->States.size(), false);
  this->First.assign(this->States.size() + 1, 0);
  this->Images.clear();
  for (std::size_t i = 0, inChunk = 0; i < this->States.size(); ++i)
  {
    inChunk = i % Chunk == 0 ? 0 : inChunk;
    const std::size_t count = this->IsWanted(i) ? this->Counts[i] : 0;
    this->First[i + 1] = this->First[i] + count;
    const VirtualVertex* images = this->Chunks[i / Chunk].data() + inChunk;
    inChunk += count;
    for (std::size_t k = 0; k < count; ++k)
    {
      ImagePoint image;
      image.Vertex = images[k];
      image.Source[0] = static_cast<std::int64_t>(i);
      this->Images.push_back(image);
      this->Nearest = std::min(this->Nearest, images[k].Depth);
      this->Farthest = std::max(this->Farthest, images[k].Depth);
    }
    this->InFront[i] = count == 1 && images[0].Facet == CurvedPatches::NoFacet;
  }
  if (this->Wanted.empty())
  {
    this->Chunks.clear(); // all points are solved, so no chunk can be requested later
  }
  this->Nearest = std::min(this->Nearest, this->Farthest);
  this->ForgetNodes();
}

//------------------------------------------------------------------------------
void ObjectImages::ForgetNodes()
{
  const Membrane& membrane = this->Geometry.GetMembrane();
  this->Nodes =
    std::make_unique<SharedNodes>(membrane.GetPositions().size(), membrane.GetFacets().size());
}

//------------------------------------------------------------------------------
ObjectImages::Side ObjectImages::FindSide(const std::int64_t* ids, std::size_t count) const
{
  const auto inFront = static_cast<std::size_t>(std::count_if(ids, ids + count,
    [this](std::int64_t id) { return this->InFront[static_cast<std::size_t>(id)]; }));
  return inFront == 0 ? Side::Behind : (inFront == count ? Side::InFront : Side::Both);
}

//------------------------------------------------------------------------------
ImagedPoint ObjectImages::GetImagedPoint(std::int64_t id) const
{
  return { id, this->GetPoint(id), &this->GetFirstImage(id).Vertex };
}

//------------------------------------------------------------------------------
// True if each of the points has one image, all with the same orientation.
bool ObjectImages::HaveOneImage(const std::int64_t* ids, std::size_t count) const
{
  return std::all_of(ids, ids + count,
    [this, ids](std::int64_t id)
    {
      return this->GetNumberOfImages(static_cast<std::size_t>(id)) == 1 &&
        this->GetImagedPoint(id).Image->Orientation ==
        this->GetImagedPoint(ids[0]).Image->Orientation;
    });
}

//------------------------------------------------------------------------------
// True if a cell with straight sides, whose points have one image each, can keep its points.
bool ObjectImages::HasSimpleMiddle(const std::int64_t* ids, std::size_t count) const
{
  // Between sight points in one facet the membrane is smooth; between different facets the edges
  // are tested.
  const VirtualVertex& first = *this->GetImagedPoint(ids[0]).Image;
  if (std::all_of(ids, ids + count,
        [this, &first](std::int64_t id)
        { return this->GetImagedPoint(id).Image->Facet == first.Facet; }))
  {
    return true;
  }
  glm::dvec3 middle(0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    middle += this->GetPoint(ids[i]) / static_cast<double>(count);
  }
  if (this->IsUnique(ids, count))
  {
    return this->Geometry.SolveNear(middle, first).State == ImageState::Found;
  }
  std::vector<VirtualVertex> images;
  return this->Geometry.FindImages(middle, images) == ImageState::Found && images.size() == 1;
}

//------------------------------------------------------------------------------
// Sets `areStraight` to true for cells behind the membrane that have one image, and straight sides,
// unless it is known that they keep their points.
void ObjectImages::FindStraight(const ObjectCells& cells, std::size_t begin, std::size_t end,
  bool areClosed, const std::vector<bool>::const_iterator& keepsPoints, EdgeSubdivision& division,
  std::vector<bool>& areStraight) const
{
  std::vector<std::array<ImagedPoint, 2>> sides;
  std::vector<std::size_t> cellOfSide;
  sides.reserve(4 * (end - begin)); // those of quadrangles
  areStraight.assign(end - begin, false);
  for (std::size_t i = begin; i < end; ++i)
  {
    const auto [ids, count] = cells.GetCell(i);
    areStraight[i - begin] = !keepsPoints[static_cast<std::ptrdiff_t>(i - begin)] &&
      this->HaveOneRefractedImage(ids, count);
    for (std::size_t k = areClosed ? 0 : 1; k < count && areStraight[i - begin]; ++k)
    {
      const std::size_t last = k > 0 ? k - 1 : count - 1;
      sides.push_back({ this->GetImagedPoint(ids[last]), this->GetImagedPoint(ids[k]) });
      cellOfSide.push_back(i - begin);
    }
  }
  const std::vector<bool> straight = division.AreStraight(sides);
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    areStraight[cellOfSide[k]] = areStraight[cellOfSide[k]] && straight[k];
  }
}

//------------------------------------------------------------------------------
// Finds cells that keep their points at the cost of a few sight rays in lanes.
std::vector<bool> ObjectImages::FindWhole(
  const ObjectCells& cells, std::size_t begin, std::size_t end) const
{
  return this->Plane ? this->FindWholeBehind(*this->Plane, cells, begin, end)
                     : std::vector<bool>(end - begin, false);
}

//------------------------------------------------------------------------------
/**
 * Keeps the cells whose images are those of their points, and calls `mapCell`, with the cell and
 * the means to map it, for the others. It returns true if it has divided the cell.
 */
template <typename MapCell>
CellReport ObjectImages::MapCells(const ObjectCells& cells, const std::int64_t* names,
  std::size_t begin, std::size_t end, bool arePolygons, ImageMesh& pieces, ImageMesh& whole,
  const MapCell& mapCell) const
{
  const PrimitiveMapper mapping(
    this->Geometry, this->Tolerance, this->Nearest, this->Farthest, *this->Nodes);
  EdgeSubdivision division(this->Geometry, this->Tolerance);
  const std::vector<bool> keepsPoints = this->FindWhole(cells, begin, end);
  CellReport report;
  std::vector<bool> areStraight;
  for (std::size_t i = begin; i < end; ++i)
  {
    if ((i - begin) % CellsAtOnce == 0)
    {
      this->FindStraight(cells, i, std::min(i + CellsAtOnce, end), arePolygons,
        keepsPoints.begin() + static_cast<std::ptrdiff_t>(i - begin), division, areStraight);
    }
    const auto [ids, count] = cells.GetCell(i);
    const Side side = this->FindSide(ids, count);
    const bool isOne = side == Side::Behind && this->HaveOneImage(ids, count);
    if (arePolygons && !this->AreInRange(ids, count))
    {
      ++report.Without;
      continue;
    }
    if (keepsPoints[i - begin] || side == Side::InFront ||
      (areStraight[(i - begin) % CellsAtOnce] && this->HasSimpleMiddle(ids, count)))
    {
      this->AddWhole(ids, count, names[i], whole);
      ++report.Whole;
      continue;
    }
    const std::size_t before = pieces.GetNumberOfCells();
    const bool isDivided =
      mapCell(CellToMap{ i, ids, count, names[i], side, isOne }, mapping, division);
    report.Count(isDivided, pieces.GetNumberOfCells() > before);
  }
  report.Coarse = static_cast<std::size_t>(division.GetNumberOfCoarse());
  return report;
}

//------------------------------------------------------------------------------
CellReport ObjectImages::MapLines(const ObjectCells& cells, const std::int64_t* names,
  std::size_t begin, std::size_t end, ImageMesh& pieces, ImageMesh& whole) const
{
  const auto mapLine = [this, &pieces](const CellToMap& cell, const PrimitiveMapper& mapping,
                         EdgeSubdivision& division)
  {
    bool isDivided = cell.IsOne;
    for (std::size_t k = 0; k + 1 < cell.Count; ++k)
    {
      const std::int64_t* const ids = cell.Ids + k;
      if (cell.IsOne && this->MayLineBeDivided(ids) &&
        division.AddLine(
          this->GetImagedPoint(ids[0]), this->GetImagedPoint(ids[1]), cell.Name, pieces))
      {
        continue;
      }
      isDivided = false;
      if (this->AreInRange(ids, 2))
      {
        mapping.MapLine(this->MakeTriangle({ ids[0], ids[1], ids[0] }), cell.Name,
          this->MayCrossMembrane(cell.At), pieces);
      }
    }
    return isDivided;
  };
  return this->MapCells(cells, names, begin, end, false, pieces, whole, mapLine);
}

//------------------------------------------------------------------------------
CellReport ObjectImages::MapPolygons(const ObjectCells& cells, const std::int64_t* names,
  std::size_t begin, std::size_t end, const Triangulate& triangulate, ImageMesh& pieces,
  ImageMesh& whole, unsigned char* isMapped) const
{
  std::fill(isMapped + begin, isMapped + end, static_cast<unsigned char>(0));
  std::vector<std::int64_t> triangles;
  const auto mapPolygon =
    [&](const CellToMap& cell, const PrimitiveMapper& mapping, EdgeSubdivision& division)
  {
    triangles = { 0, 1, 2 };
    if (cell.Count != 3)
    {
      triangulate(cell.Ids, cell.Count, triangles);
    }
    const bool isDivided = cell.IsOne && this->MayBeDivided(cell.Ids, triangles) &&
      this->DividePolygon(cell.Ids, triangles, cell.Name, division, pieces);
    for (std::size_t k = 0; k + 2 < triangles.size() && !isDivided; k += 3)
    {
      mapping.MapTriangle(this->MakeTriangle({ cell.Ids[triangles[k]], cell.Ids[triangles[k + 1]],
                            cell.Ids[triangles[k + 2]] }),
        cell.Name, this->MayCrossMembrane(cell.At), pieces);
    }
    isMapped[cell.Index] = isDivided ? 0 : 1;
    return isDivided;
  };
  return this->MapCells(cells, names, begin, end, true, pieces, whole, mapPolygon);
}

//------------------------------------------------------------------------------
CellImages::MoveOntoSide ObjectImages::MakeMove() const
{
  auto division = std::make_shared<EdgeSubdivision>(this->Geometry, this->Tolerance);
  return [this, division](std::int64_t low, std::int64_t high, double place, ImagePoint& point)
  {
    if (this->HaveOneImage(point.Source.data(), 2) &&
      this->FindSide(point.Source.data(), 2) == Side::Behind)
    {
      division->MoveOntoEdge(
        this->GetImagedPoint(low), this->GetImagedPoint(high), place, point.Vertex);
    }
  };
}

//------------------------------------------------------------------------------
glm::dvec3 ObjectImages::GetEye() const
{
  return this->Geometry.GetMedia().Eye + this->Geometry.GetMembrane().GetOrigin();
}

//------------------------------------------------------------------------------
bool ObjectImages::DividePolygon(const std::int64_t* ids,
  const std::vector<std::int64_t>& triangles, std::int64_t cell, EdgeSubdivision& division,
  ImageMesh& pieces) const
{
  const ImageMesh::Mark before = pieces.GetMark();
  for (std::size_t k = 0; k + 2 < triangles.size(); k += 3)
  {
    if (!division.AddTriangle(
          { this->GetImagedPoint(ids[triangles[k]]), this->GetImagedPoint(ids[triangles[k + 1]]),
            this->GetImagedPoint(ids[triangles[k + 2]]) },
          cell, pieces))
    {
      pieces.ReturnTo(before);
      return false;
    }
  }
  return true;
}

}
