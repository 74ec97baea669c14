// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RefractedRayStack.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <bitset>
#include <limits>
#include <utility>

namespace meniscus
{
namespace
{

constexpr int TileSize = RefractedRayTiles::TileSize;
constexpr int BlocksOfTile = RefractedRayTiles::SquaresOfTile;
constexpr double Infinity = std::numeric_limits<double>::infinity();
/** Below this number of facets, the bounds of groups of rays cost more than they save. */
constexpr int FewFacets = 192;
/**
 * From this number of facets on, the tree of the boxes serves refracted rays better: their bounds
 * are wide.
 */
constexpr int ManyFacets = 512;

/** First pixel of a block of a tile, from the tile's. */
glm::ivec2 FirstOfBlock(int number)
{
  return { RefractedRayTiles::ColumnOfSquare(number), RefractedRayTiles::RowOfSquare(number) };
}

bool operator==(const AffinePixelMap& a, const AffinePixelMap& b)
{
  return a.Base == b.Base && a.PerColumn == b.PerColumn && a.PerRow == b.PerRow;
}

/** True if a product of a ray's direction and the normal has the sign, or if that is 0. */
bool HasSign(double product, double sign)
{
  return sign == 0.0 || sign * product > 0.0;
}

}

//------------------------------------------------------------------------------
bool RefractedRayStack::View::operator==(const View& o) const
{
  const RayFrame& a = this->Frame;
  const RayFrame& b = o.Frame;
  return a.RowX == b.RowX && a.RowY == b.RowY && a.RowDepth == b.RowDepth && a.Origin == b.Origin &&
    a.Slope == b.Slope && a.ViewToWorld == b.ViewToWorld && this->Width == o.Width &&
    this->Height == o.Height && this->Center == o.Center && this->EyeDepth == o.EyeDepth &&
    this->Mesh == o.Mesh && this->Parts == o.Parts;
}

//------------------------------------------------------------------------------
std::int64_t RefractedRayStack::GetBytes() const
{
  std::int64_t bytes = 0;
  for (const RefractedRayTiles& tiles : this->Rays)
  {
    bytes += tiles.GetBytes();
  }
  return bytes;
}

//------------------------------------------------------------------------------
void RefractedRayStack::Build(
  const std::vector<Interface>& interfaces, const View& view, const RangeLoop& loop)
{
  if (interfaces.size() != this->Interfaces.size())
  {
    this->Blocks.clear(); // they have other numbers of legs
  }
  this->Interfaces = interfaces;
  if (view.Width != this->Of.Width || view.Height != this->Of.Height)
  {
    this->Rays.clear(); // tiles have rays of other pixels
  }
  this->Of = view;
  this->Rays.resize(interfaces.size());
  this->Untraced.clear();
  this->Sums = Counts();
  this->Columns = (view.Width + TileSize - 1) / TileSize;
  const int rows = (view.Height + TileSize - 1) / TileSize;
  this->WorldToFrame = glm::inverse(view.Frame.ViewToWorld);
  this->BoundMesh();

  const auto tiles = static_cast<std::size_t>(this->Columns) * static_cast<std::size_t>(rows);
  for (RefractedRayTiles& rays : this->Rays)
  {
    rays.Resize(tiles);
  }
  this->Untraced.resize(tiles);
  std::vector<TileSum> sums(tiles);
  loop(tiles,
    [&](std::size_t begin, std::size_t end)
    {
      std::unique_ptr<StackBlock> block = this->TakeBlock();
      const StackVisibility sight(this->Interfaces, this->Mesh, this->Of.Center, this->Set);
      for (std::size_t tile = begin; tile < end; ++tile)
      {
        sums[tile] = this->TraceTile(static_cast<int>(tile), sight, *block);
      }
      this->PutBack(std::move(block));
    });
  glm::dvec3 sum(0.0);
  this->StepBounds = AxisBox();
  for (const TileSum& tile : sums)
  {
    sum += tile.Directions;
    this->StepBounds.Add(tile.Steps);
    this->Sums.Add(tile.Rays);
  }
  const double length = glm::length(sum);
  this->MeanDirection = length > 0.0 ? sum / length : glm::dvec3(0.0);
}

//------------------------------------------------------------------------------
void RefractedRayStack::BoundMesh()
{
  const glm::dmat3& toWorld = this->Of.Frame.ViewToWorld;
  const auto halfOf = [&toWorld](const BoundsInFrame& bounds)
  {
    const glm::dmat3 edges = toWorld * bounds.HalfEdges;
    return glm::abs(edges[0]) + glm::abs(edges[1]) + glm::abs(edges[2]);
  };
  const glm::dvec3 half = halfOf(this->Of.Mesh);
  this->Mesh.Center = toWorld * this->Of.Mesh.Center;
  this->Mesh.Half = SightMargin * half;
  this->Mesh.Parts.Clear();
  for (const BoundsInFrame& part : this->Of.Parts)
  {
    const glm::dvec3 center = toWorld * part.Center;
    const glm::dvec3 halfOfPart = halfOf(part) + (this->Mesh.Half - half);
    this->Mesh.Parts.Add(0, { center - halfOfPart, center + halfOfPart });
  }
}

//------------------------------------------------------------------------------
/** Returns a block of an earlier thread, with the patches that it met, or a new one. */
std::unique_ptr<StackBlock> RefractedRayStack::TakeBlock()
{
  const std::lock_guard<std::mutex> lock(this->BlocksMutex);
  if (this->Blocks.empty())
  {
    return std::make_unique<StackBlock>(this->Interfaces.size(), this->Set);
  }
  std::unique_ptr<StackBlock> block = std::move(this->Blocks.back());
  this->Blocks.pop_back();
  return block;
}

//------------------------------------------------------------------------------
void RefractedRayStack::PutBack(std::unique_ptr<StackBlock> block)
{
  const std::lock_guard<std::mutex> lock(this->BlocksMutex);
  this->Blocks.push_back(std::move(block));
}

//------------------------------------------------------------------------------
std::int64_t RefractedRayStack::GetNumberOfUntracedBlocks() const
{
  std::int64_t number = 0;
  for (const TileSquares blocks : this->Untraced)
  {
    number += static_cast<std::int64_t>(std::bitset<BlocksOfTile>(blocks).count());
  }
  return number;
}

//------------------------------------------------------------------------------
RefractedRayStack::Counts RefractedRayStack::GetCounts() const
{
  Counts counts = this->Sums;
  StackBlock block(this->Interfaces.size(), this->Set);
  for (std::size_t tile = 0; tile < this->Untraced.size(); ++tile)
  {
    for (int number = 0; number < BlocksOfTile; ++number)
    {
      if ((this->Untraced[tile] >> number & 1u) != 0)
      {
        this->MeetFirst(this->FirstPixel(static_cast<int>(tile)) + FirstOfBlock(number),
          StackBlock::Side, block, counts);
        this->TraceBlock(nullptr, block, counts);
      }
    }
  }
  return counts;
}

//------------------------------------------------------------------------------
/** Rays at the corners of a square of pixels, from the depth of the eye on. */
CornerRays RefractedRayStack::CornersOf(const glm::ivec2& first, int size) const
{
  const RayFrame& frame = this->Of.Frame;
  const glm::dvec2 toCenter(0.5 - 0.5 * this->Of.Width, 0.5 - 0.5 * this->Of.Height);
  const int last = size - 1;
  const glm::ivec2 corners[4] = { { 0, 0 }, { last, 0 }, { last, last }, { 0, last } };
  CornerRays rays;
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec2 pixel = glm::dvec2(first + corners[i]) + toCenter;
    const glm::dvec3 place(frame.Origin.At(pixel.x, pixel.y), 0.0);
    const glm::dvec3 step(frame.Slope.At(pixel.x, pixel.y), 1.0);
    rays.Starts[i] = frame.ViewToWorld * (place + this->Of.EyeDepth * step);
    rays.Directions[i] = frame.ViewToWorld * step;
  }
  return rays;
}

//------------------------------------------------------------------------------
/** Makes room for the rays of a tile, whose squares have to be stored. */
void RefractedRayStack::PrepareTile(int tile, bool mayShow)
{
  for (std::size_t k = 0; k < this->Rays.size(); ++k)
  {
    std::vector<RefractedRay>& rays = this->Rays[k].ChangeTile(tile);
    // All squares of pixels in the image are stored. Pixels of the tile outside the image keep
    // their initial values.
    rays.resize(k == 0 || mayShow ? RefractedRayTiles::RaysOfTile : 0);
    this->Rays[k].SetSquares(tile, 0, 0);
  }
  this->Untraced[static_cast<std::size_t>(tile)] = 0;
}

//------------------------------------------------------------------------------
/**
 * Leaves out the rays of a tile, none of which shows the mesh behind the first interface.
 * @param farthest as in RefractedRayTiles::SetFarthest().
 * @param untraced the blocks with rays that may meet it.
 */
void RefractedRayStack::ClearTile(int tile, double farthest, TileSquares untraced)
{
  for (RefractedRayTiles& rays : this->Rays)
  {
    rays.ChangeTile(tile) = std::vector<RefractedRay>();
    rays.SetSquares(tile, 0, 0);
    rays.SetFarthest(tile, farthest);
  }
  this->Untraced[static_cast<std::size_t>(tile)] = untraced;
}

//------------------------------------------------------------------------------
/**
 * Leaves out the rays of a block of a tile.
 * @param ray all of them at the first interface.
 */
void RefractedRayStack::HideBlock(int tile, int number, const RefractedRay& ray)
{
  const glm::ivec2 first = FirstOfBlock(number);
  for (std::size_t k = 0; k < this->Rays.size(); ++k)
  {
    std::vector<RefractedRay>& rays = this->Rays[k].ChangeTile(tile);
    for (int row = 0; row < StackBlock::Side && !rays.empty(); ++row)
    {
      std::fill_n(rays.begin() + (first.y + row) * TileSize + first.x, StackBlock::Side,
        k == 0 ? ray : RefractedRay());
    }
  }
  TileSquares& untraced = this->Untraced[static_cast<std::size_t>(tile)];
  untraced = static_cast<TileSquares>(untraced | 1u << number);
}

//------------------------------------------------------------------------------
/**
 * True if rays of a rectangle of pixels show nothing of the mesh: because they do not come to it,
 * or because all of them meet the first interface before.
 * @param first one of the pixels.
 * @param ray is set to all of them at the first interface, to be drawn as if they met it.
 */
bool RefractedRayStack::ShowNothing(const Showing& showing, const glm::ivec2& first,
  const CornerRays& corners, const StackVisibility& sight, StackBlock& block,
  RefractedRay& ray) const
{
  ray = RefractedRay();
  if (!showing.Refracted && !showing.Straight)
  {
    return true;
  }
  FacetBoxes* facets = block.OfTile.Find(0);
  if (showing.Refracted || !facets || !sight.HidesMesh(corners, *facets) ||
    !this->MeetsFirst(first, block))
  {
    return false;
  }
  ray.Depth = this->Of.EyeDepth;
  return true;
}

//------------------------------------------------------------------------------
RefractedRayStack::TileSum RefractedRayStack::TraceTile(
  int tile, const StackVisibility& sight, StackBlock& block)
{
  const glm::ivec2 first = this->FirstPixel(tile);
  const CornerRays corners = this->CornersOf(first, TileSize);
  const bool mayShow = sight.MayShowMesh(corners, block.OfTile);
  const Showing showing{ sight.MayShowMeshUnrefracted(corners), mayShow };
  const FacetBoxes* facets = block.OfTile.Find(0);
  RefractedRay instead;
  if (showing.Straight && facets && facets->Count == 0)
  {
    this->ClearTile(tile, Infinity, 0);
    return TileSum();
  }
  if (this->ShowNothing(showing, first, corners, sight, block, instead))
  {
    this->ClearTile(tile, -Infinity, RefractedRayTiles::AllSquares);
    const bool isHidden = instead.MeetsInterface();
    this->Rays.front().ChangeTile(tile).assign(
      isHidden ? RefractedRayTiles::RaysOfTile : 0, instead);
    return TileSum();
  }
  return this->TraceBlocks(
    tile, showing, showing.Straight && sight.CornersMeetBoundsUnrefracted(corners), sight, block);
}

//------------------------------------------------------------------------------
/**
 * Traces the blocks of a tile.
 * @param areStraight true if rays, on straight ways, mostly reach the bounds of the mesh: blocks
 *   are not asked then.
 */
RefractedRayStack::TileSum RefractedRayStack::TraceBlocks(int tile, const Showing& ofTile,
  bool areStraight, const StackVisibility& sight, StackBlock& block)
{
  TileSum sum;
  this->PrepareTile(tile, ofTile.Refracted);
  double farthest = -Infinity;
  // False if rays of the block before met the first interface and did not show the mesh behind it:
  // bounds may prove that for the next block as well.
  bool hasShown = ofTile.Refracted;
  for (int number = 0; number < BlocksOfTile; ++number)
  {
    const glm::ivec2 first = this->FirstPixel(tile) + FirstOfBlock(number);
    Showing showing = ofTile;
    if (!areStraight || !hasShown)
    {
      const CornerRays corners = this->CornersOf(first, StackBlock::Side);
      showing.Straight &= areStraight || sight.MayShowMeshUnrefracted(corners);
      showing.Refracted &=
        (showing.Straight && hasShown) || sight.MayShowMesh(corners, block.OfTile, block.Facets);
      RefractedRay instead;
      if (this->ShowNothing(showing, first, corners, sight, block, instead))
      {
        this->HideBlock(tile, number, instead);
        continue;
      }
    }
    Counts counts;
    this->MeetFirst(first, StackBlock::Side, block, counts);
    farthest = std::max(farthest, this->FindFarthestSight(sight, block));
    const bool isMet = block.Lanes.IsAnyHit();
    const bool isTraced =
      isMet && showing.Refracted && this->TraceBlock(hasShown ? nullptr : &sight, block, counts);
    hasShown = !isMet || (isTraced && block.EndBeside(this->Mesh.Center, this->Mesh.Half));
    sum.Rays.Add(isTraced || !isMet ? counts : Counts());
    if (isTraced)
    {
      this->StoreBlock(block, tile, number, sum);
    }
    else
    {
      this->StoreSights(block, tile, number);
    }
  }
  for (RefractedRayTiles& tiles : this->Rays)
  {
    tiles.SetFarthest(tile, farthest);
    std::vector<RefractedRay>& rays = tiles.ChangeTile(tile);
    if (std::none_of(
          rays.begin(), rays.end(), [](const RefractedRay& ray) { return ray.MeetsInterface(); }))
    {
      rays = std::vector<RefractedRay>();
    }
  }
  return sum;
}

//------------------------------------------------------------------------------
/** Traces the rays of a square of pixels, a block or a part of it, to the first interface. */
void RefractedRayStack::MeetFirst(
  const glm::ivec2& first, int side, StackBlock& block, Counts& sums) const
{
  block.Start(this->Of.Frame, first, side, this->Of.Width, this->Of.Height);
  this->SetLanes(0, block, sums);
  this->MeetInterface(0, block, sums);
  std::copy_n(block.Lanes.Last, StackBlock::Size, block.Sights);
}

//------------------------------------------------------------------------------
/**
 * Largest depth at which rays of a block, which have met the first interface, meet it; -infinity if
 * none of them comes to the bounds of the mesh before, infinite if one that does passes it.
 */
double RefractedRayStack::FindFarthestSight(
  const StackVisibility& sight, const StackBlock& block) const
{
  if (block.Lanes.Count == 0)
  {
    return -Infinity;
  }
  const double farthest = block.Lanes.GetFarthest();
  TubeBounds tube = block.Tube;
  const glm::dvec3 toSurface = this->ToSurface(0);
  tube.StartLow -= toSurface;
  tube.StartHigh -= toSurface;
  return sight.MeetsBounds(tube, farthest - this->Of.EyeDepth) ? farthest : -Infinity;
}

//------------------------------------------------------------------------------
/** True if the ray of a pixel meets the first interface. */
bool RefractedRayStack::MeetsFirst(const glm::ivec2& pixel, StackBlock& block) const
{
  Counts unused;
  this->MeetFirst(pixel, 1, block, unused);
  return block.Lanes.IsAnyHit();
}

//------------------------------------------------------------------------------
/**
 * Refracts the rays of a block, which have met the first interface, and traces them through the
 * others. Returns false if they show nothing of the mesh there, and ends before the second.
 * @param sight null if all rays are to be traced.
 */
bool RefractedRayStack::TraceBlock(
  const StackVisibility* sight, StackBlock& block, Counts& sums) const
{
  block.Refract(0, this->Interfaces[0]);
  for (std::size_t k = 1; k < this->Interfaces.size(); ++k)
  {
    this->SetLanes(k, block, sums);
    if (k == 1 && sight && !this->MayShowMesh(*sight, block))
    {
      return false;
    }
    this->MeetInterface(k, block, sums);
    block.Refract(k, this->Interfaces[k]);
    const RayBlock& lanes = block.Lanes;
    for (int ray = 0; ray < lanes.Count; ++ray)
    {
      sums.Reflected += block.Lanes.IsHit(ray) && block.Refracted[ray] == 0.0 ? 1 : 0;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/** False if the rays in the lanes, on their way to the second interface, show no mesh. */
bool RefractedRayStack::MayShowMesh(const StackVisibility& sight, StackBlock& block) const
{
  StackLanes& lanes = block.Lanes;
  const double* medium = nullptr;
  for (int ray = 0; ray < block.Count; ++ray)
  {
    const bool isOther = medium && lanes.IsOnWay[ray] != 0 && lanes.Medium[ray] != *medium;
    if (isOther || lanes.IsMismatched[ray] != 0)
    {
      return true; // bounds hold for one medium
    }
    medium = lanes.IsOnWay[ray] != 0 ? lanes.Medium + ray : medium;
  }
  if (!medium)
  {
    return true; // all rays have ended
  }
  TubeBounds tube = FindUnitTube(lanes.First[0], this->Set, lanes);
  const glm::dvec3 toSurface = this->ToSurface(1);
  tube.StartLow -= toSurface;
  tube.StartHigh -= toSurface;
  return sight.MayShowMesh(tube, *medium, block.OfTile, block.Facets);
}

//------------------------------------------------------------------------------
/**
 * Sets the lanes to the rays of a block that may meet interface `number`, and ends those that
 * cannot.
 */
void RefractedRayStack::SetLanes(std::size_t number, StackBlock& block, Counts& sums) const
{
  block.SetLanes(number, this->Interfaces[number], this->ToSurface(number),
    number == 0 ? this->Of.EyeDepth : 0.0);
  for (int ray = 0; ray < block.Count && number > 0; ++ray)
  {
    if (block.Lanes.IsMismatched[ray] != 0)
    {
      block.Legs[number].End(ray);
      ++sums.Missing;
      ++sums.Mismatched;
    }
  }
}

//------------------------------------------------------------------------------
/**
 * Visits facets of interface `number` that rays in the lanes may meet, from near to far.
 * @param meet called with the intersector of the patch and the rays. It returns the largest
 *   parameter of the tube that counts from then on.
 */
template <typename Meet>
void RefractedRayStack::VisitFacets(std::size_t number, StackBlock& block, const Meet& meet) const
{
  const RefractingSurface& surface = *this->Interfaces[number].Surface;
  RayBlock& lanes = block.Lanes;
  const double rayLength = lanes.Length[0];
  const RayRange all{ 0, lanes.Count };
  const auto tracerOf = [&](std::int32_t facet) -> const PatchIntersector&
  { return block.GetTracer(surface, facet, rayLength); };
  const auto request = [&surface](std::int32_t facet)
  { surface.GetPatches().PrefetchPatch(facet); };
  double farthest = Infinity;
  FacetBoxes* facets = block.FindFacets(number);
  if (!facets || (number > 0 && facets->Count > ManyFacets))
  {
    InvertDirections(this->Set, lanes);
    surface.GetTree().Visit(
      block.Tube, farthest,
      [this, &lanes](const AxisBox& box) { return MeetsBox(box, this->Set, lanes); },
      [&](std::int32_t facet, const TubeRange&) { return meet(tracerOf(facet), all); });
  }
  else if (facets->Count < FewFacets)
  {
    VisitBoxesNearFirst(block.Tube, this->Set, *facets, request,
      [&](std::int32_t facet, const TubeRange& range, const AxisBox&)
      {
        const PatchIntersector& tracer = tracerOf(facet);
        farthest = tracer.MayMeet(block.Tube, range) ? meet(tracer, all) : farthest;
        return farthest;
      });
  }
  else
  {
    GroupTubes groups(lanes.First[0], lanes);
    VisitBoxesNearFirst(block.Tube, this->Set, *facets, request,
      [&](std::int32_t facet, const TubeRange&, const AxisBox& box)
      {
        const RayRange rays = groups.FindRays(box, this->Set);
        farthest = rays.First < rays.End ? meet(tracerOf(facet), rays) : farthest;
        return farthest;
      });
  }
}

//------------------------------------------------------------------------------
/** Intersects the lanes with interface `number`, and ends legs that miss it. */
void RefractedRayStack::MeetInterface(std::size_t number, StackBlock& block, Counts& sums) const
{
  RayBlock& lanes = block.Lanes;
  if (lanes.Count == 0)
  {
    return;
  }
  bool isNearer = false;
  const auto keepNearest = [&](std::int32_t index, const MembraneHit& hit)
  {
    const auto lane = static_cast<std::size_t>(index);
    const double facing = glm::dot(lanes.GetDirection(index), hit.Normal);
    if (HasSign(facing, lanes.Facing[lane]) && hit.Depth > lanes.First[lane] &&
      hit.Depth < lanes.Last[lane])
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        block.Normals[axis][lane] = hit.Normal[axis];
      }
      lanes.Last[lane] = hit.Depth;
      isNearer = true;
    }
  };
  double farthest = Infinity;
  this->VisitFacets(number, block,
    [&](const PatchIntersector& tracer, const RayRange& range)
    {
      isNearer = false;
      sums.Undecided -= tracer.GetNumberOfUndecidedRays();
      tracer.Meet(lanes, range, keepNearest);
      sums.Undecided += tracer.GetNumberOfUndecidedRays();
      // Parameters of the tube count from its beginning.
      farthest = isNearer ? lanes.GetFarthest() - lanes.First[0] : farthest;
      return farthest;
    });
  for (int lane = 0; lane < lanes.Count && number > 0; ++lane)
  {
    if (lanes.Last[lane] == Infinity)
    {
      block.Legs[number].End(lane);
      ++sums.Missing;
    }
  }
}

//------------------------------------------------------------------------------
/** @param sum gets the steps of the legs. */
void RefractedRayStack::StoreBlock(const StackBlock& block, int tile, int number, TileSum& sum)
{
  for (std::size_t k = 0; k < this->Rays.size(); ++k)
  {
    std::vector<RefractedRay>& rays = this->Rays[k].ChangeTile(tile);
    const WorldLegs& legs = block.Legs[k + 1];
    double steps[3][StackBlock::Size];
    block.FindFrameSteps(k + 1, this->WorldToFrame, steps);
    bool goesOn = false;
    // The sums stay in registers while rays are stored.
    glm::dvec3 directions = sum.Directions;
    AxisBox bounds = sum.Steps;
    for (int i = 0; i < block.Count; ++i)
    {
      RefractedRay& ray = rays[static_cast<std::size_t>(block.Pixels[static_cast<std::size_t>(i)])];
      if (!block.Legs[k].GoesOn(i))
      {
        ray = RefractedRay();
        continue;
      }
      ray = { legs.Depth[i], { steps[0][i], steps[1][i], steps[2][i] } };
      if (legs.GoesOn(i))
      {
        const glm::dvec3 step(steps[0][i], steps[1][i], steps[2][i]);
        directions += step;
        bounds.Add({ step, step });
        goesOn = true;
      }
    }
    sum.Directions = directions;
    sum.Steps = bounds;
    this->Rays[k].AddSquare(tile, number, goesOn, legs.MayShow);
  }
}

//------------------------------------------------------------------------------
/**
 * Stores the intersections of a block's rays with the first interface, where they end. The block
 * counts as traced if there are none.
 */
void RefractedRayStack::StoreSights(const StackBlock& block, int tile, int number)
{
  TileSquares& untraced = this->Untraced[static_cast<std::size_t>(tile)];
  for (std::size_t k = 0; k < this->Rays.size(); ++k)
  {
    std::vector<RefractedRay>& rays = this->Rays[k].ChangeTile(tile);
    for (int i = 0; i < block.Count && !rays.empty(); ++i)
    {
      const auto pixel = static_cast<std::size_t>(block.Pixels[static_cast<std::size_t>(i)]);
      const bool isHit = k == 0 && block.Sights[i] < Infinity;
      rays[pixel] = RefractedRay();
      if (isHit)
      {
        rays[pixel].Depth = block.Sights[i];
        untraced = static_cast<TileSquares>(untraced | 1u << number);
      }
    }
  }
}

}
