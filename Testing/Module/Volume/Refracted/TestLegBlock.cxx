// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Legs and lines of blocks of rays are those of each ray, and their entries those that a test of
// every face of the boundary finds.
#include "KernelMeshes.h"
#include "RefractionTestRandom.h"

#include "Simd/InstructionSets.h"
#include "TestBasics.h"
#include "Volume/Refracted/LegBlock.h"
#include "Volume/Refracted/LegBox.h"
#include "Volume/Refracted/RayBundleEntries.h"
#include "Volume/Refracted/RayLegs.h"
#include "Volume/Refracted/RefractionFrames.h"

using namespace meniscus;
using namespace meniscus::test;
using meniscus::test::Random;

namespace
{

constexpr int Size = 72; // the last tiles are not full
constexpr int TileSize = RefractedRayTiles::TileSize;
constexpr double Infinity = std::numeric_limits<double>::infinity();

/** Rays through a cube with legs behind two interfaces, in many directions. */
class LegScene
{
public:
  LegScene()
  {
    MeshArrays arrays = KuhnGrid(5);
    Jitter(arrays, 0.03, 1);
    this->Mesh.Build(arrays.View());
    this->Tree.Build(this->Mesh);
    this->Frame = FrameAlongZ(this->Mesh, 0.7, Size);
    Random random(17);
    for (RefractedRayTiles& tiles : this->Behind)
    {
      tiles.Resize(9);
      for (const auto& [tile, pixel] : Product(9, RefractedRayTiles::RaysOfTile))
      {
        tiles.ChangeTile(tile).push_back(MakeRay(random));
      }
    }
    this->Frames.Turn(this->GetLegs(), glm::normalize(glm::dvec3(0.2, -0.1, 1.0)), SerialLoop);
    this->Frames.Place(this->Mesh, std::vector<float>(), SerialLoop);
  }

  RayLegs GetLegs() const
  {
    return RayLegs(this->Frame, Size, Size, { &this->Behind[0], &this->Behind[1] });
  }

  TetrahedralMesh Mesh;
  BoundaryTree Tree;
  RayFrame Frame;
  std::array<RefractedRayTiles, 2> Behind;
  RefractionFrames Frames;

private:
  /** One ray in eight does not go on, one in eight does not come to the interface. */
  static RefractedRay MakeRay(Random& random)
  {
    const double depth = random(-0.8, 0.2);
    const double kind = random(0.0, 1.0);
    RefractedRay ray;
    if (kind > 0.125)
    {
      ray.Depth = depth;
    }
    if (kind > 0.25)
    {
      ray.Step = glm::dvec3(0.0, 0.0, 1.0) + random.Point(glm::dvec3(-0.9), glm::dvec3(0.9));
      // A few rays in other frames.
      ray.Step = kind > 0.95 ? glm::dvec3(ray.Step.z, ray.Step.x, ray.Step.y) : ray.Step;
    }
    return ray;
  }
};

/** Calls visit(corner) for each square of a tile. */
template <typename Visit>
void ForSquares(const Visit& visit)
{
  for (int row = 0; row < TileSize; row += LegBlock::Side)
  {
    for (int column = 0; column < TileSize; column += LegBlock::Side)
    {
      visit(row * TileSize + column);
    }
  }
}

/** First legs of a square of the middle tile that are in the first frame. */
LegBlock LegsInFrame(const LegScene& scene, int corner, InstructionSet set)
{
  LegBlock block;
  FindLegs(scene.GetLegs(), 4, corner, 1, set, block);
  FindFrames(scene.Frames, set, block);
  int count = 0;
  for (int i = 0; i < LegBlock::Size; ++i)
  {
    if (block.Exists[i] != 0 && block.Frame[i] == 0)
    {
      block.DrawnFrom[i] = 0.1 * count;
      block.DrawnTo[i] = 0.2 * count;
      block.Copy(count++, block, i);
    }
  }
  block.Count = count;
  return block;
}

/** Depth at which a line enters by a face, in double precision; infinite if it does not. */
double EntryDepth(const LegScene& scene, const BoundaryFace& face, const LineBlock& lines, int line)
{
  const RayFrame& rows = scene.Frames.Get(0).Rays.GetFrame();
  const glm::dmat3 toFrame = glm::transpose(glm::dmat3(rows.RowX, rows.RowY, rows.RowDepth));
  glm::dvec3 corners[3];
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3 place = toFrame * scene.Mesh.GetPosition(face.Vertices[k]);
    corners[k] = place -
      glm::dvec3(lines.Origin[0][line] + place.z * lines.Slope[0][line],
        lines.Origin[1][line] + place.z * lines.Slope[1][line], 0.0);
  }
  double total = 0.0;
  double depth = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3& p = corners[(k + 1) % 3];
    const glm::dvec3& q = corners[(k + 2) % 3];
    const double area = rows.Handedness * (p.x * q.y - p.y * q.x);
    if (!(area > 0.0))
    {
      return Infinity;
    }
    total += area;
    depth += area * corners[k].z;
  }
  return depth / total;
}

}

TEST(LegBlock, LegsAreThoseOfEachRay)
{
  const LegScene scene;
  const RayLegs legs = scene.GetLegs();
  int found = 0;
  const auto compare = [&](int tile, int corner, int number, InstructionSet set)
  {
    LegBlock block;
    FindLegs(legs, tile, corner, number, set, block);
    FindFrames(scene.Frames, set, block);
    ASSERT_EQ(block.Count, LegBlock::Size);
    for (int i = 0; i < block.Count; ++i)
    {
      RayLeg leg;
      const bool exists = legs.Find(tile, block.Pixel[i], number, leg);
      ASSERT_EQ(block.Exists[i] != 0, exists);
      if (exists)
      {
        ++found;
        const RayLeg same = block.Get(i);
        ASSERT_EQ(same.Begin, leg.Begin);
        ASSERT_EQ(same.Step, leg.Step);
        ASSERT_EQ(same.Depth, leg.Depth);
        ASSERT_EQ(same.End, leg.End);
        ASSERT_EQ(block.Frame[i], scene.Frames.IndexOf(leg.Step));
      }
    }
  };
  for (int tile = 0; tile < legs.GetNumberOfTiles(); ++tile)
  {
    for (const InstructionSet set : GetInstructionSets())
    {
      ForSquares([&](int corner) { compare(tile, corner, 1, set); });
      ForSquares([&](int corner) { compare(tile, corner, 2, set); });
    }
  }
  EXPECT_GT(found, 9 * TileSize * TileSize / 2);
}

TEST(LegBlock, LinesAreThoseOfEachLeg)
{
  const LegScene scene;
  const RefractionFrame& frame = scene.Frames.Get(0);
  for (const InstructionSet set : GetInstructionSets())
  {
    LegBlock block = LegsInFrame(scene, 0, set);
    const int count = block.Count;
    ASSERT_GT(count, 20);
    LineBlock lines;
    SetLines(frame, block, true, set, lines);
    ASSERT_EQ(lines.Count, count);
    for (int i = 0; i < count; ++i)
    {
      const glm::dvec3 place = frame.FromView * block.Get(i).Begin;
      const glm::dvec3 step = frame.FromView * block.Get(i).Step;
      const FrameLine line = FrameLine::Through(place, step);
      const PacketRay ray = frame.Rays.RayAlong(line.Origin, line.Slope);
      const PacketRay same = lines.GetRay(i);
      for (int axis = 0; axis < 2; ++axis)
      {
        EXPECT_EQ(lines.Origin[axis][i], line.Origin[axis]);
        EXPECT_EQ(lines.Slope[axis][i], line.Slope[axis]);
        EXPECT_EQ(same.Offset[axis], ray.Offset[axis]);
        EXPECT_EQ(same.Fraction[axis], ray.Fraction[axis]);
        EXPECT_EQ(same.SlopeRest[axis], ray.SlopeRest[axis]);
        EXPECT_EQ(same.Slope[axis], ray.Slope[axis]);
      }
      EXPECT_EQ(same.LengthPerDepth, ray.LengthPerDepth);
      EXPECT_EQ(same.StartDepth, frame.Rays.FromPivot(place.z + 0.1 * i * step.z));
      EXPECT_EQ(same.EndDepth, frame.Rays.FromPivot(place.z + 0.2 * i * step.z));
      EXPECT_LT(lines.From[i], place.z);
      EXPECT_GT(lines.From[i], place.z - 1e-3);
    }
    SetLines(frame, block, false, set, lines);
    EXPECT_EQ(lines.From[0], -frame.Extent);
  }
}

/** No leg that has a point in the box is left out, and few others are kept. */
TEST(LegBlock, BoxKeepsLegsThroughIt)
{
  Random random(23);
  int kept = 0;
  int beside = 0;
  for (int i = 0; i < 20000; ++i)
  {
    BoundsInFrame bounds;
    bounds.Center = random.Point(glm::dvec3(-1.0), glm::dvec3(1.0));
    const glm::dvec3 first = glm::normalize(random.Point(glm::dvec3(-1.0), glm::dvec3(1.0)));
    const glm::dvec3 second =
      glm::normalize(glm::cross(first, random.Point(glm::dvec3(-1.0), glm::dvec3(1.0))));
    const glm::dvec3 half = random.Point(glm::dvec3(0.1), glm::dvec3(0.8));
    bounds.HalfEdges = { half.x * first, half.y * second, half.z * glm::cross(first, second) };
    const LegBox box(bounds);
    // To a corner or a place inside.
    const double edge = i % 2 == 0 ? 1.0 : 0.9;
    const glm::dvec3 inBox(i % 4 < 2 ? edge : random(-1.0, 1.0), random(-1.0, 1.0), -edge);
    RayLeg leg;
    leg.Begin = random.Point(glm::dvec3(-4.0), glm::dvec3(4.0));
    leg.Step = random(0.1, 3.0) * (bounds.Center + bounds.HalfEdges * inBox - leg.Begin);
    EXPECT_TRUE(box.MayMeet(leg));
    EXPECT_FALSE(box.IsBeside(leg));
    leg.Depth = 0.5;
    leg.End = leg.Depth + 1.0 / 0.1;
    EXPECT_FALSE(box.IsBeside(leg));
    // The same leg away from the box, and one that ends in front of it.
    RayLeg away = leg;
    away.Step = -leg.Step;
    const glm::dvec3 local = glm::transpose(glm::dmat3(first, second, glm::cross(first, second))) *
      (leg.Begin - bounds.Center);
    const bool outside = std::fabs(local.x) > half.x + 1e-3 || std::fabs(local.y) > half.y + 1e-3 ||
      std::fabs(local.z) > half.z + 1e-3;
    kept += outside && box.MayMeet(away) ? 1 : 0;
    leg.End = leg.Depth + 1e-6;
    beside += outside && box.IsBeside(leg) ? 1 : 0;
  }
  EXPECT_LT(kept, 4000); // begins within the bounding sphere
  EXPECT_GT(beside, 16000);
}

/** Entries of bundles against a test of every face in double precision. */
TEST(RayBundleEntries, FindsTheFacesOfEachLine)
{
  const LegScene scene;
  const RefractionFrame& frame = scene.Frames.Get(0);
  for (const InstructionSet set : GetInstructionSets())
  {
    std::vector<LineBlock> blocks;
    ForSquares(
      [&](int corner)
      {
        blocks.emplace_back();
        LegBlock legs = LegsInFrame(scene, corner, set);
        SetLines(frame, legs, true, set, blocks.back());
      });
    RayBundleEntries::Workspace workspace;
    const RayBundleEntries entries(scene.Mesh, scene.Tree, frame, set);
    entries.Collect(blocks.data(), blocks.size(), workspace);

    // Depth that was found, for each line and face.
    std::map<std::pair<std::int32_t, std::int32_t>, double> found;
    for (std::size_t h = 0; h < workspace.NumberOfHits; ++h)
    {
      const PacketHit& hit = workspace.Hits[h];
      const PacketFace& face = workspace.Faces[static_cast<std::size_t>(hit.Face)];
      found[{ hit.Ray, face.CellFace }] = frame.Rays.ToFrame(hit.Depth);
    }
    EXPECT_EQ(found.size(), workspace.NumberOfHits);
    std::size_t expected = 0;
    for (std::int32_t ray = 0; ray < static_cast<std::int32_t>(64 * blocks.size()); ++ray)
    {
      const LineBlock& lines = blocks[static_cast<std::size_t>(ray / LineBlock::Size)];
      const int line = ray % LineBlock::Size;
      for (const BoundaryFace& face : scene.Mesh.GetBoundary())
      {
        const double depth = line < lines.Count ? EntryDepth(scene, face, lines, line) : Infinity;
        if (depth >= lines.From[line] && depth < Infinity)
        {
          ++expected;
          // Depths are floats, from areas rounded to 2^-24; faces are met at 2^-6 or steeper.
          const auto same = found.find({ ray, face.CellFace });
          ASSERT_NE(same, found.end());
          EXPECT_NEAR(same->second, depth, 1e-5);
        }
      }
    }
    EXPECT_EQ(workspace.NumberOfHits, expected);
    EXPECT_GT(expected, 100u);
  }
}
