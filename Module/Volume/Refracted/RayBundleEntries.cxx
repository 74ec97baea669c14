// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Volume/Refracted/RayBundleEntries.h"

#include "Common/Prefetch.h"
#include "Simd/InstructionSets.h"
#include "Simd/LaneLoop.h"
#include "Volume/Mesh/CellFaces.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Packet/Kernels/PacketKernels.h"
#include "Volume/Rays/ExactEdgeTest.h"
#include "Volume/Rays/ProjectedFaces.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meniscus
{
namespace
{

/**
 * Distance, in grid units, by which a line may miss a face and enter by it nevertheless: half a
 * unit of rounding of a vertex across the ray and half along it, and FixedPointRays::RoundingOfRay
 * for the ray.
 */
constexpr double GridMargin = 324.0;
static_assert(
  0.5 + 0.5 + FixedPointRays::RoundingOfRay < GridMargin, "rounding of vertices and rays");

/** Smallest depth from which on entries of the lines of some blocks are collected. */
// Several extremes, which do not wait for each other.
double FindFirst(const LineBlock* blocks, std::size_t count)
{
  constexpr int width = 4;
  double first[width];
  std::fill_n(first, width, std::numeric_limits<double>::infinity());
  for (const LineBlock* lines = blocks; lines != blocks + count; ++lines)
  {
    int line = 0;
    for (; line + width <= lines->Count; line += width)
    {
      for (int lane = 0; lane < width; ++lane)
      {
        first[lane] = std::min(first[lane], lines->From[line + lane]);
      }
    }
    for (; line < lines->Count; ++line)
    {
      first[0] = std::min(first[0], lines->From[line]);
    }
  }
  return std::min(std::min(first[0], first[1]), std::min(first[2], first[3]));
}

}

//------------------------------------------------------------------------------
BoundsInFrame BoxOf(const BoundaryTree& tree, const RayFrame& view)
{
  const std::vector<BoundsInFrame> whole = PartsOf(tree, view, 1);
  return whole.empty() ? BoundsInFrame() : whole.front();
}

//------------------------------------------------------------------------------
std::vector<BoundsInFrame> PartsOf(const BoundaryTree& tree, const RayFrame& view, std::size_t most)
{
  const std::vector<BoundaryTree::Node>& nodes = tree.GetNodes();
  std::vector<std::size_t> parts(nodes.empty() ? 0 : 1, 0);
  // Sum of the half extents of nodes that can be divided.
  const auto sizeOf = [&nodes](std::size_t part)
  {
    const BoundaryTree::Node& node = nodes[part];
    return node.Face < 0 ? node.Half.x + node.Half.y + node.Half.z : -1.0f;
  };
  while (!parts.empty() && parts.size() < most)
  {
    const auto largest = std::max_element(parts.begin(), parts.end(),
      [&sizeOf](std::size_t a, std::size_t b) { return sizeOf(a) < sizeOf(b); });
    if (sizeOf(*largest) < 0.0f)
    {
      break;
    }
    ++*largest; // its first child follows a node
    parts.push_back(static_cast<std::size_t>(nodes[*largest].Skip));
  }
  const glm::dmat3 toFrame = glm::transpose(glm::dmat3(view.RowX, view.RowY, view.RowDepth));
  std::vector<BoundsInFrame> boxes;
  for (const std::size_t part : parts)
  {
    const BoundaryTree::Node& node = nodes[part];
    const glm::dmat3 half(node.Half.x, 0.0, 0.0, 0.0, node.Half.y, 0.0, 0.0, 0.0, node.Half.z);
    boxes.push_back({ toFrame * glm::dvec3(node.Center), toFrame * half });
  }
  return boxes;
}

/**
 * Lines between two depths. At both depths, and therefore between them, they are within a
 * rectangle.
 */
struct RayBundleEntries::Bundle
{
  double First;
  double Last;
  glm::dvec2 Lower[2];
  glm::dvec2 Upper[2];
  glm::dvec2 LeastSlope;
  glm::dvec2 MostSlope;

  /** Shares of the bundle's depths per unit of depth; 0 if they are equal. */
  double PerDepth;

  double ShareAt(double depth) const { return (depth - this->First) * this->PerDepth; }
  /** Loop body for one face. */
  void operator()(FaceBlock& faces, int i) const
  {
    const double near = faces.Nearest[i];
    const double far = faces.Farthest[i];
    bool meets = true;
    for (int axis = 0; axis < 2; ++axis)
    {
      const double low = this->Lower[0][axis];
      const double lowRate = this->Lower[1][axis] - low;
      const double high = this->Upper[0][axis];
      const double highRate = this->Upper[1][axis] - high;
      meets &= faces.High[axis][i] >= std::min(low + near * lowRate, low + far * lowRate);
      meets &= faces.Low[axis][i] <= std::max(high + near * highRate, high + far * highRate);
    }
    faces.Meets[i] = meets ? 1 : 0;
  }
};

//------------------------------------------------------------------------------
RayBundleEntries::RayBundleEntries(const TetrahedralMesh& mesh, const BoundaryTree& tree,
  const RefractionFrame& frame, InstructionSet set)
  : Mesh(mesh)
  , Tree(tree)
  , Frame(frame)
  , Set(set)
{
  const RayFrame& rows = frame.Rays.GetFrame();
  this->ToFrame = glm::transpose(glm::dmat3(rows.RowX, rows.RowY, rows.RowDepth));
  this->Reach =
    glm::dmat3(glm::abs(this->ToFrame[0]), glm::abs(this->ToFrame[1]), glm::abs(this->ToFrame[2]));
}

//------------------------------------------------------------------------------
/**
 * False if the orientation of the face shows that no line of the bundle enters by it. Twice its
 * projected area about a line is affine in the slopes; rounding of vertices and rays moves its
 * corners by GridMargin.
 */
bool RayBundleEntries::MayFace(const PacketFace& face, const Bundle& bundle) const
{
  const auto placeOf = [this, &face](int k)
  {
    const auto& place = this->Frame.Vertices[static_cast<std::size_t>(face.Vertices[k])].Place;
    return glm::dvec3(place[0], place[1], place[2]);
  };
  const glm::dvec3 corner = placeOf(0);
  // Unit of depth over unit of the grid across.
  const glm::dvec3 scale(
    1.0, 1.0, 1.0 / PacketVertex::GridPerDepth / this->Frame.Rays.GetGridUnit());
  const glm::dvec3 first = scale * (placeOf(1) - corner);
  const glm::dvec3 second = scale * (placeOf(2) - corner);
  const glm::dvec3 normal = glm::cross(first, second);
  const glm::dvec2 across(normal);
  // Slopes differ from the mean by at most the spread.
  const glm::dvec2 mean = 0.5 * (bundle.LeastSlope + bundle.MostSlope);
  const double area = normal.z + glm::dot(across, mean);
  const double spread = 0.5 * glm::dot(glm::abs(across), bundle.MostSlope - bundle.LeastSlope);
  if (area + spread > 0.0)
  {
    return true;
  }
  // Both ends of an edge have an error of GridMargin, in all sqrt(2) times 2 of it. About a line
  // with slopes within 1, an edge is at most sqrt(3) times as long.
  constexpr double offset = 2.83 * GridMargin;
  const double edges = 1.74 * (glm::length(first) + glm::length(second));
  return area + spread > -offset * (edges + offset);
}

//------------------------------------------------------------------------------
/** Bounds of the lines of some blocks between two depths. */
// The extremes of every second number first: these loops run on two lanes at a time in any set.
RayBundleEntries::Bundle RayBundleEntries::Bound(
  const LineBlock* blocks, std::size_t count, double first, double last) const
{
  constexpr int width = 2;
  Bundle bundle;
  bundle.First = first;
  bundle.Last = last;
  bundle.PerDepth = last > first ? 1.0 / (last - first) : 0.0;
  for (int axis = 0; axis < 2; ++axis)
  {
    double low[3][width];
    double high[3][width];
    std::fill_n(low[0], 3 * width, 1e30);
    std::fill_n(high[0], 3 * width, -1e30);
    const auto add = [&](const LineBlock& lines, int line, int lane)
    {
      const double slope = lines.Slope[axis][line];
      const double values[3] = { lines.Origin[axis][line] + first * slope,
        lines.Origin[axis][line] + last * slope, slope };
      for (int k = 0; k < 3; ++k)
      {
        low[k][lane] = std::min(low[k][lane], values[k]);
        high[k][lane] = std::max(high[k][lane], values[k]);
      }
    };
    for (const LineBlock* lines = blocks; lines != blocks + count; ++lines)
    {
      int line = 0;
      for (; line + width <= lines->Count; line += width)
      {
        for (int lane = 0; lane < width; ++lane)
        {
          add(*lines, line + lane, lane);
        }
      }
      for (; line < lines->Count; ++line)
      {
        add(*lines, line, 0);
      }
    }
    for (int end = 0; end < 2; ++end)
    {
      bundle.Lower[end][axis] = std::min(low[end][0], low[end][1]);
      bundle.Upper[end][axis] = std::max(high[end][0], high[end][1]);
    }
    bundle.LeastSlope[axis] = std::min(low[2][0], low[2][1]);
    bundle.MostSlope[axis] = std::max(high[2][0], high[2][1]);
  }
  return bundle;
}

//------------------------------------------------------------------------------
/**
 * The planes around a bundle: the sides of its rectangles, which are linear in the depth, and its
 * first and last depth. In normalised model coordinates and single precision.
 */
class RayBundleEntries::BundlePlanes
{
public:
  /**
   * @param toFrame map from normalised model coordinates to the frame.
   * @param margin distance in the frame by which lines of the bundle may be outside.
   */
  BundlePlanes(const Bundle& bundle, const glm::dmat3& toFrame, double margin)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      glm::dvec3 across(0.0);
      across[axis] = 1.0;
      const double lower = bundle.PerDepth * (bundle.Lower[1][axis] - bundle.Lower[0][axis]);
      const double upper = bundle.PerDepth * (bundle.Upper[1][axis] - bundle.Upper[0][axis]);
      this->Add(-across + glm::dvec3(0.0, 0.0, lower), lower * bundle.First - bundle.Lower[0][axis],
        toFrame, margin);
      this->Add(across - glm::dvec3(0.0, 0.0, upper), bundle.Upper[0][axis] - upper * bundle.First,
        toFrame, margin);
    }
    this->Add({ 0.0, 0.0, 1.0 }, bundle.Last, toFrame, margin);
    this->Add({ 0.0, 0.0, -1.0 }, -bundle.First, toFrame, margin);
  }

  /** False if the box of a node is beyond a plane. */
  bool MayMeet(const BoundaryTree::Node& node) const
  {
    const glm::vec3 center = node.Center;
    const glm::vec3 half = node.Half;
    // Apart from the comparisons, which the compiler does not vectorise.
    float beyond[Size];
    for (int k = 0; k < Size; ++k)
    {
      beyond[k] = this->Normal[0][k] * center.x + this->Normal[1][k] * center.y +
        this->Normal[2][k] * center.z - this->Reach[0][k] * half.x - this->Reach[1][k] * half.y -
        this->Reach[2][k] * half.z - this->Most[k];
    }
    float farthest[Size / 2];
    for (int k = 0; k < Size / 2; ++k)
    {
      farthest[k] = std::max(beyond[k], beyond[k + Size / 2]);
    }
    return !(
      std::max(std::max(farthest[0], farthest[1]), std::max(farthest[2], farthest[3])) > 0.0f);
  }

private:
  /** Room for whole registers; the last ones hold nothing back. */
  static constexpr int Size = 8;

  /**
   * Adds the half-space in which the product with `normal`, a vector of the frame, is at most
   * `most`.
   */
  void Add(const glm::dvec3& normal, double most, const glm::dmat3& toFrame, double margin)
  {
    // Six products and their sums of numbers within 1 times the normal's components, each of which
    // is rounded: less than ten roundings.
    constexpr double rounding = 10.0 * 2.0 * std::numeric_limits<float>::epsilon();
    const glm::dvec3 model = normal * toFrame;
    double size = std::fabs(most);
    double moved = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Normal[axis][this->Count] = static_cast<float>(model[axis]);
      this->Reach[axis][this->Count] = static_cast<float>(std::fabs(model[axis]));
      size += std::fabs(model[axis]);
      moved += std::fabs(normal[axis]) * margin;
    }
    this->Most[this->Count++] = static_cast<float>(most + moved + rounding * size);
  }

  int Count = 0;
  float Normal[3][Size] = {};
  float Reach[3][Size] = {};
  float Most[Size] = {};
};

//------------------------------------------------------------------------------
/**
 * Faces by which lines of the bundle may enter, in the order of the tree. Nodes, faces and vertices
 * are far apart in memory: they are requested before their use.
 */
void RayBundleEntries::FindFaces(const Bundle& bundle, Workspace& workspace) const
{
  workspace.Leaves.clear();
  workspace.Found.clear();
  const double margin = GridMargin * this->Frame.Rays.GetGridUnit();
  const BundlePlanes planes(bundle, this->ToFrame, margin);
  const std::vector<BoundaryTree::Node>& nodes = this->Tree.GetNodes();
  const std::vector<BoundaryFace>& faces = this->Tree.GetFaces();
  std::size_t at = 0;
  while (at < nodes.size())
  {
    const BoundaryTree::Node& node = nodes[at];
    const auto next = static_cast<std::size_t>(node.Skip);
    Prefetch(nodes.data() + next);
    const bool meets = planes.MayMeet(node);
    if (meets && node.Face >= 0)
    {
      Prefetch(&faces[static_cast<std::size_t>(node.Face)]);
      workspace.Leaves.push_back(static_cast<std::int32_t>(at));
    }
    at = meets ? at + 1 : next;
  }
  const auto faceOf = [&](std::size_t leaf) -> const BoundaryFace&
  {
    const BoundaryTree::Node& node = nodes[static_cast<std::size_t>(workspace.Leaves[leaf])];
    return faces[static_cast<std::size_t>(node.Face)];
  };
  constexpr std::size_t ahead = 8;
  for (std::size_t leaf = 0; leaf < workspace.Leaves.size(); ++leaf)
  {
    for (int k = 0; k < 3 && leaf + ahead < workspace.Leaves.size(); ++k)
    {
      const std::int32_t vertex = faceOf(leaf + ahead).Vertices[static_cast<std::size_t>(k)];
      Prefetch(&this->Frame.Vertices[static_cast<std::size_t>(vertex)]);
    }
    const PacketFace face = EnteredFace(faceOf(leaf), this->Frame.Rays.GetFrame());
    if (this->MayFace(face, bundle))
    {
      const BoundaryTree::Node& node = nodes[static_cast<std::size_t>(workspace.Leaves[leaf])];
      workspace.Found.push_back({ face, this->ToFrame * glm::dvec3(node.Center),
        this->Reach * glm::dvec3(node.Half) + margin });
    }
  }
}

//------------------------------------------------------------------------------
/**
 * Sets Faces and Blocks. Where a line enters many times, entries that come from near to far leave
 * little to sort.
 */
void RayBundleEntries::SortFaces(const Bundle& bundle, Workspace& workspace) const
{
  workspace.Order.clear();
  for (const Workspace::FoundFace& found : workspace.Found)
  {
    workspace.Order.emplace_back(static_cast<float>(found.Center.z - found.Half.z),
      static_cast<std::int32_t>(workspace.Order.size()));
  }
  std::sort(workspace.Order.begin(), workspace.Order.end());
  workspace.Faces.clear();
  workspace.Blocks.clear();
  for (const auto& next : workspace.Order)
  {
    const Workspace::FoundFace& found = workspace.Found[static_cast<std::size_t>(next.second)];
    workspace.Faces.push_back(found.Face);
    if (workspace.Blocks.empty() || workspace.Blocks.back().Count == FaceBlock::Size)
    {
      workspace.Blocks.emplace_back();
    }
    FaceBlock& block = workspace.Blocks.back();
    const int i = block.Count++;
    for (int axis = 0; axis < 2; ++axis)
    {
      block.Low[axis][i] = found.Center[axis] - found.Half[axis];
      block.High[axis][i] = found.Center[axis] + found.Half[axis];
    }
    block.Nearest[i] = bundle.ShareAt(std::max(found.Center.z - found.Half.z, bundle.First));
    block.Farthest[i] = bundle.ShareAt(std::min(found.Center.z + found.Half.z, bundle.Last));
  }
}

//------------------------------------------------------------------------------
/** Adds a span of `lines` lines for each face by which lines of a block may enter. */
void RayBundleEntries::AddSpans(const Bundle& bundle, int lines, Workspace& workspace) const
{
  workspace.Spans.clear();
  std::int32_t number = 0;
  for (FaceBlock& faces : workspace.Blocks)
  {
    RunLanes(bundle, this->Set, faces);
    for (int i = 0; i < faces.Count; ++i, ++number)
    {
      if (faces.Meets[i] != 0)
      {
        workspace.Spans.push_back({ number, 0, lines });
      }
    }
  }
}

//------------------------------------------------------------------------------
/** Adds the entries of a block's lines by the faces of the spans. */
void RayBundleEntries::AddHits(
  const LineBlock& lines, std::int32_t firstRay, Workspace& workspace) const
{
  const std::size_t before = workspace.NumberOfHits;
  workspace.Hits.resize(std::max(workspace.Hits.size(),
    before + workspace.Spans.size() * static_cast<std::size_t>(lines.Count)));
  PacketSpanJob job;
  job.Vertices = this->Frame.Vertices.data();
  job.Faces = workspace.Faces.data();
  job.Spans = workspace.Spans.data();
  job.NumberOfSpans = static_cast<std::int32_t>(workspace.Spans.size());
  for (int axis = 0; axis < 2; ++axis)
  {
    job.Offsets[axis] = lines.Offset[axis];
    job.Slopes[axis] = lines.GridSlope[axis];
    job.Fractions[axis] = lines.Fraction[axis];
    job.SlopeRests[axis] = lines.SlopeRest[axis];
  }
  job.Pivot = this->Frame.Rays.GetPivot();
  job.RaysAreFine = this->Frame.Rays.AreFine();
  job.Hits = workspace.Hits.data() + before;
  FindEntries(job, this->Set);

  std::size_t kept = before;
  for (std::int32_t i = 0; i < job.NumberOfHits; ++i)
  {
    const PacketHit& hit = job.Hits[i];
    if (this->Frame.Rays.ToFrame(hit.Depth) >= lines.From[hit.Ray])
    {
      workspace.Hits[kept++] = { firstRay + hit.Ray, hit.Face, hit.Depth };
    }
  }
  workspace.NumberOfHits = kept;
}

//------------------------------------------------------------------------------
void RayBundleEntries::Workspace::Add(std::int32_t ray, const PacketEntry& entry)
{
  this->Hits.resize(std::max(this->Hits.size(), this->NumberOfHits + 1));
  this->Hits[this->NumberOfHits++] = { ray, static_cast<std::int32_t>(this->Faces.size()),
    entry.Depth };
  this->Faces.push_back(
    { { entry.Vertices[0], entry.Vertices[1], entry.Vertices[2] }, entry.CellFace });
}

//------------------------------------------------------------------------------
void RayBundleEntries::Collect(
  const LineBlock* blocks, std::size_t count, Workspace& workspace, double last) const
{
  last = std::clamp(last, -this->Frame.Extent, this->Frame.Extent);
  const double first = std::min(last, std::max(FindFirst(blocks, count), -this->Frame.Extent));
  workspace.NumberOfHits = 0;
  const Bundle all = this->Bound(blocks, count, first, last);
  this->FindFaces(all, workspace);
  this->SortFaces(all, workspace);
  for (std::size_t block = 0; block < count; ++block)
  {
    const LineBlock& lines = blocks[block];
    this->AddSpans(this->Bound(&lines, 1, first, last), lines.Count, workspace);
    this->AddHits(
      lines, static_cast<std::int32_t>(block) * std::int32_t{ LineBlock::Size }, workspace);
  }
}

//------------------------------------------------------------------------------
/** Tests whether the ray enters by the face and computes the entry. */
bool RayBundleEntries::Enters(
  const PacketFace& face, const PacketRay& ray, PacketEntry& entry) const
{
  using Test = ExactEdgeTest<RayBundleEntries>;
  const auto cornerOf = [&](int k)
  {
    const std::int32_t vertex = face.Vertices[k];
    return Test::AboutRay(this->Frame.Vertices[static_cast<std::size_t>(vertex)], vertex, ray,
      this->Frame.Rays.GetPivot(), this->Frame.Rays.AreFine());
  };
  const auto found = ExactEntry<RayBundleEntries>::Of(cornerOf(0), cornerOf(1), cornerOf(2));
  entry = { { face.Vertices[0], face.Vertices[1], face.Vertices[2] }, face.CellFace, found.Depth };
  return found.Entered;
}

//------------------------------------------------------------------------------
/** A line about the vertices of a cell, in double precision. */
struct RayBundleEntries::NearLine
{
  double Depths[4];
  /** Twice the area that the edge from vertex i to vertex j spans with the line, for i < j. */
  double Areas[4][4];
  /** Bounds of the errors of the areas that decide, which are of floats. */
  double Margins[4][4];
};

//------------------------------------------------------------------------------
auto RayBundleEntries::LineNear(
  const std::array<std::int32_t, 4>& vertices, const PacketRay& ray) const -> NearLine
{
  NearLine line;
  const std::int32_t pivot = this->Frame.Rays.GetPivot();
  double places[4][2];
  for (int k = 0; k < 4; ++k)
  {
    const PacketVertex& vertex = this->Frame.Vertices[static_cast<std::size_t>(vertices[k])];
    line.Depths[k] = static_cast<double>(vertex.Place[2]) - pivot;
    for (int axis = 0; axis < 2; ++axis)
    {
      places[k][axis] = static_cast<double>(vertex.Place[axis]) - ray.Offset[axis] -
        ray.Fraction[axis] - (double{ ray.Slope[axis] } + ray.SlopeRest[axis]) * line.Depths[k];
    }
  }
  // About a line along the depth, a coordinate is rounded at most twice, by 2^-24 of it: where the
  // integer is converted, and where the fraction of a fine ray is subtracted. A product has twice
  // the error, and as much again is left for the rounding of these numbers.
  const bool isParallel = ray.Slope[0] == 0.0f && ray.Slope[1] == 0.0f &&
    ray.SlopeRest[0] == 0.0f && ray.SlopeRest[1] == 0.0f;
  const double relative = isParallel ? 1.0 / (1 << 21) : 0.0;
  const double absolute = isParallel ? 0.0 : double{ FixedPointRays::RoundingOfRay };
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      const double products[2] = { places[i][0] * places[j][1], places[i][1] * places[j][0] };
      const double sum = std::fabs(places[i][0]) + std::fabs(places[i][1]) +
        std::fabs(places[j][0]) + std::fabs(places[j][1]);
      line.Areas[i][j] = products[0] - products[1];
      line.Margins[i][j] = relative * (std::fabs(products[0]) + std::fabs(products[1])) +
        2.0 * absolute * (sum + absolute);
    }
  }
  return line;
}

//------------------------------------------------------------------------------
/** As Enters(), by the double-precision areas where these decide. */
bool RayBundleEntries::EntersFace(std::int64_t cell, int number, const NearLine& line,
  const PacketRay& ray, PacketEntry& entry) const
{
  const bool isTurned = (this->Mesh.IsPositivelyOriented(cell) != (FaceParity(number) > 0)) !=
    (this->Frame.Rays.GetFrame().Handedness < 0);
  const double sign = isTurned ? -1.0 : 1.0;
  const auto at = FaceVertices({ 0, 1, 2, 3 }, number);
  const double areas[3] = { sign * line.Areas[at[0]][at[1]], sign * line.Areas[at[1]][at[2]],
    -sign * line.Areas[at[0]][at[2]] };
  const double margins[3] = { line.Margins[at[0]][at[1]], line.Margins[at[1]][at[2]],
    line.Margins[at[0]][at[2]] };
  bool isCertain = true;
  for (int k = 0; k < 3; ++k)
  {
    if (areas[k] < -margins[k])
    {
      return false;
    }
    isCertain &= areas[k] > margins[k];
  }
  const PacketFace face =
    EnteredFace(this->Mesh.GetFace(cell, number), this->Frame.Rays.GetFrame());
  if (!isCertain)
  {
    return this->Enters(face, ray, entry);
  }
  const double* const depths = line.Depths;
  const double first = depths[at[0]];
  const double across = areas[2] * (depths[at[1]] - first) + areas[0] * (depths[at[2]] - first);
  entry = { { face.Vertices[0], face.Vertices[1], face.Vertices[2] }, face.CellFace,
    static_cast<float>(first + across / (areas[0] + areas[1] + areas[2])) };
  return true;
}

//------------------------------------------------------------------------------
bool RayBundleEntries::EntersCell(
  std::int64_t cell, const PacketRay& ray, double before, PacketEntry& entry) const
{
  const NearLine line =
    this->LineNear(this->Mesh.GetCells()[static_cast<std::size_t>(cell)].Vertices, ray);
  for (int k = 0; k < 4; ++k)
  {
    if (this->EntersFace(cell, k, line, ray, entry) &&
      this->Frame.Rays.ToFrame(entry.Depth) <= before)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool RayBundleEntries::FindEntryNear(
  std::int32_t cellFace, const PacketRay& ray, double before, PacketEntry& entry) const
{
  const std::int64_t behind = cellFace / 4;
  const std::int32_t back =
    this->Mesh.GetCells()[static_cast<std::size_t>(behind)].Links[cellFace % 4];
  const std::int64_t inFront = back / 4;
  if (back >= 0 && this->EntersCell(inFront, ray, before, entry))
  {
    return true;
  }
  if (this->EntersCell(behind, ray, before, entry))
  {
    return true;
  }
  for (int k = 0; back >= 0 && k < 4; ++k)
  {
    const std::int32_t link = this->Mesh.GetCells()[static_cast<std::size_t>(inFront)].Links[k];
    if (link >= 0 && this->EntersCell(link / 4, ray, before, entry))
    {
      return true;
    }
  }
  return false;
}

}
