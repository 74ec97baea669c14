// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays refracted at a membrane inside the mesh or in front of it, with the kernel alone.
#include "KernelMeshes.h"
#include "KernelSurfaces.h"

#include "Simd/InstructionSets.h"
#include "TestBasics.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Mesh/InvertedCells.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/PlacedVertices.h"
#include "Volume/Refracted/RefractedRayStack.h"
#include "Volume/Refracted/RefractedRayTexels.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

constexpr int Size = 64;

/**
 * A mesh seen along z through a membrane with a slope of 1 / 4, which cuts it in the middle or is
 * nearer by `lift`.
 */
class RefractedPicture
{
public:
  explicit RefractedPicture(const MeshArrays& mesh, double lift = 0.0)
  {
    EXPECT_EQ(this->Mesh.Build(mesh.View()), MeshStatus::Ok);
    this->Tree.Build(this->Mesh);
    for (std::int64_t v = 0; v < this->Mesh.GetNumberOfVertices(); ++v)
    {
      this->Scalars.push_back(static_cast<float>(this->Mesh.GetPosition(v).x));
    }
    std::vector<double> points{ -2, -2, -0.1, 3, -2, -0.1, 3, 3, 1.15, -2, 3, 1.15 };
    for (std::size_t z = 2; z < points.size(); z += 3)
    {
      points[z] -= lift;
    }
    const std::vector<std::int64_t> triangles{ 0, 1, 2, 0, 2, 3 };
    const MembraneInput input{ points.data(), 4, triangles.data(), 2, nullptr, nullptr };
    const TestSurface surface(input);

    const RayFrame frame = FrameAlongZ(this->Mesh, 0.7, Size);
    this->Scene.Rays = FixedPointRays(frame, Size, Size);
    PlaceVertices(this->Mesh, this->Scalars, this->Scene.Rays, SerialLoop, this->Tables.Vertices);
    this->Tables.Intervals = PackIntervals(ConstantFunction(1.5));
    this->Frame = frame;
    this->Sight.Build({ surface.Between(1.0, 1.5) },
      { frame, Size, Size, this->Mesh.GetCenter(), -50.0, BoxOf(this->Tree, frame) });
    this->Frames.Turn(this->GetLegs(), this->Sight.GetMeanDirection(), SerialLoop);
    this->Frames.Place(this->Mesh, this->Scalars, SerialLoop);
    this->Passages = FindPassages(this->Mesh);
    this->Scene.Mesh = &this->Mesh;
    this->Scene.Passages = &this->Passages;
    this->Scene.Boundary = &this->Mesh.GetBoundary();
    this->Scene.Tables = &this->Tables;
    this->Scene.Refracted = { { &this->Sight.GetRays()[0] }, &this->Frames, &this->Tree, false };
  }

  std::vector<float> Cast(bool beginsInside, InstructionSet set, RayStatistics& sums)
  {
    this->Scene.Refracted.BeginsInside = beginsInside;
    this->Scene.Set = set;
    return this->Cast(nullptr, sums);
  }
  /** @param depths of the window. */
  std::vector<float> CastInterpolating(
    bool interpolating, InstructionSet set, const std::vector<float>& depths, RayStatistics& sums)
  {
    this->Scene.Interpolating = interpolating;
    this->Scene.Set = set;
    return this->Cast(depths.data(), sums);
  }

  RayLegs GetLegs() const
  {
    return RayLegs(this->Frame, Size, Size, { &this->Sight.GetRays()[0] });
  }

  TetrahedralMesh Mesh;
  std::vector<CellPassages> Passages;
  RayFrame Frame;
  RefractedRayStack Sight;
  RefractionFrames Frames;

private:
  std::vector<float> Cast(const float* depths, RayStatistics& sums)
  {
    std::vector<float> image(std::size_t{ 4 } * Size * Size, 0.0f);
    const TileCaster caster(this->Scene);
    TileCaster::Workspace workspace;
    sums = RayStatistics();
    for (int tile = 0; tile < caster.GetNumberOfTiles(); ++tile)
    {
      const RayStatistics ofTile = caster.Cast(tile, depths, image.data(), workspace);
      sums.Steps += ofTile.Steps;
      sums.Rays += ofTile.Rays;
      sums.Lost += ofTile.Lost;
      sums.Interpolated += ofTile.Interpolated;
    }
    return image;
  }

  BoundaryTree Tree;
  std::vector<float> Scalars;
  PacketTables Tables;
  TileCaster::Scene Scene;
};

float LargestDifference(const std::vector<float>& a, const std::vector<float>& b)
{
  float largest = 0.0f;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max(largest, std::fabs(a[i] - b[i]));
  }
  return largest;
}

}

TEST(RefractedRays, BeginningInsideOrOnTheBoundaryIsTheSame)
{
  RefractedPicture picture(KuhnGrid(6));
  ASSERT_TRUE(picture.Sight.IsSeen());
  EXPECT_FALSE(HasInvertedCells(picture.Mesh));
  for (const InstructionSet set : GetInstructionSets())
  {
    RayStatistics boundary;
    RayStatistics inside;
    const std::vector<float> a = picture.Cast(false, set, boundary);
    const std::vector<float> b = picture.Cast(true, set, inside);
    EXPECT_LE(LargestDifference(a, b), 1e-6f) << NameOf(set);
    EXPECT_GT(*std::max_element(a.begin(), a.end()), 0.5f);
    EXPECT_EQ(boundary.Lost + inside.Lost, 0);
    EXPECT_EQ(boundary.Rays, inside.Rays);
    EXPECT_LT(inside.Steps, 0.9 * static_cast<double>(boundary.Steps));
  }
}

TEST(RefractedRays, NoneIsLostInAMeshTurnedInsideOut)
{
  MeshArrays mesh = KuhnGrid(5);
  Jitter(mesh, 0.2, 7);
  RefractedPicture picture(mesh);
  EXPECT_TRUE(HasInvertedCells(picture.Mesh));
  for (const bool beginsInside : { false, true })
  {
    // Some rays that begin inside go round for ever; these begin again on the boundary.
    RayStatistics sums;
    picture.Cast(beginsInside, BestInstructionSet(), sums);
    EXPECT_GT(sums.Rays, 1000);
    EXPECT_EQ(sums.Lost, 0) << beginsInside;
  }
}

// In front of the mesh, only the legs behind the membrane meet it. One pixel has an opaque object,
// between rays that are cast.
TEST(RefractedRays, ThoseBehindAMembraneInFrontAreInterpolated)
{
  RefractedPicture picture(KuhnGrid(6), 1.5);
  std::vector<float> depths(std::size_t{ Size } * Size, 1.0f);
  const std::size_t opaque = std::size_t{ 35 } * Size + 37;
  const RayFrame& frame = picture.Frame;
  // Rays along z: depths are affine in window depths.
  const double first = frame.DepthAt(-1.0);
  depths[opaque] = static_cast<float>(-0.5 * first / (frame.DepthAt(0.0) - first));
  for (const InstructionSet set : GetInstructionSets())
  {
    RayStatistics all;
    RayStatistics some;
    const std::vector<float> truth = picture.CastInterpolating(false, set, depths, all);
    const std::vector<float> image = picture.CastInterpolating(true, set, depths, some);
    EXPECT_LT(truth[4 * opaque + 3], 0.8f * truth[4 * opaque - 1]) << NameOf(set);
    EXPECT_EQ(all.Interpolated, 0);
    EXPECT_GT(some.Interpolated, all.Rays / 3) << NameOf(set);
    EXPECT_LT(some.Steps, all.Steps * 2 / 3) << NameOf(set);
    EXPECT_EQ(some.Rays, all.Rays);
    EXPECT_NEAR(image[4 * opaque + 3], truth[4 * opaque + 3], 1e-6f);
    // One of three colours, whose quadratic mean is the bound.
    EXPECT_LE(
      LargestDifference(image, truth), 0.5f * LargestInterpolatedDifference * std::sqrt(3.0f));
    for (std::size_t i = 0; i < image.size(); ++i)
    {
      ASSERT_EQ(image[i] == 0.0f, truth[i] == 0.0f) << i;
    }
  }
}

// Both legs of a ray meet a mesh that the membrane cuts: they are joined, and no ray is left out.
TEST(RefractedRays, ThoseOfAMembraneInTheMeshAreCast)
{
  RefractedPicture picture(KuhnGrid(6));
  const std::vector<float> depths(std::size_t{ Size } * Size, 1.0f);
  RayStatistics all;
  RayStatistics some;
  const InstructionSet set = BestInstructionSet();
  const std::vector<float> truth = picture.CastInterpolating(false, set, depths, all);
  EXPECT_EQ(picture.CastInterpolating(true, set, depths, some), truth);
  EXPECT_EQ(some.Interpolated, 0);
}

TEST(RefractedRays, LinesForShadersAreTheRays)
{
  const RefractedPicture picture(KuhnGrid(6));
  std::vector<RefractedRayLine> lines;
  LayOutRefractedRays(picture.GetLegs(), picture.Frames, SerialLoop, lines);
  ASSERT_EQ(lines.size(), std::size_t{ Size } * Size);
  const RayFrame& frame = picture.Frame;
  constexpr int tileSize = RefractedRayTiles::TileSize;
  int refracted = 0;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    const int column = pixel % Size;
    const int row = pixel / Size;
    const RefractedRayLine& line = lines[static_cast<std::size_t>(pixel)];
    const RefractedRay* tile =
      picture.Sight.GetRays()[0].GetTile(row / tileSize * (Size / tileSize) + column / tileSize);
    const RefractedRay ray =
      tile ? tile[row % tileSize * tileSize + column % tileSize] : RefractedRay();
    if (!ray.MeetsInterface() || !ray.GoesOn())
    {
      EXPECT_EQ(line.PerDepth, 0.0f);
      EXPECT_EQ(line.EndBefore == RefractedRayLine::Nowhere, !ray.MeetsInterface());
      continue;
    }
    ++refracted;
    EXPECT_EQ(line.EndBefore, static_cast<float>(ray.Depth));
    // Offsets are rounded to grid units, and so are depths within the unit of the frame.
    const auto depthOf = [](std::int32_t grid, float depth)
    { return std::abs(depth) < 1.0f ? FixedPointRays::DepthOf(grid) : double{ depth }; };
    const RefractionFrame& turned = picture.Frames.Get(line.GetFrame());
    const double unit = turned.Rays.GetGridUnit();
    const double slopeUnit = unit * PacketVertex::GridPerDepth * FixedPointRays::ShaderSlopeUnit;
    const glm::dmat3 toView = glm::transpose(turned.FromView);
    const glm::dvec3 along =
      toView * glm::dvec3(line.Slope[0] * slopeUnit, line.Slope[1] * slopeUnit, 1.0);
    const glm::dvec3 place =
      toView * glm::dvec3(unit * line.Offset[0], unit * line.Offset[1], 0.0) +
      depthOf(line.GetGridStart(), line.Start) * along;
    const double precision = std::abs(ray.Depth) < 1.0 ? 1e-9 : 1e-7;
    EXPECT_NEAR(depthOf(line.GetGridEndBefore(), line.EndBefore), ray.Depth, precision);
    const glm::dvec2 across = frame.Origin.At(column + 0.5 - 0.5 * Size, row + 0.5 - 0.5 * Size) +
      ray.Depth * frame.Slope.At(column + 0.5 - 0.5 * Size, row + 0.5 - 0.5 * Size);
    EXPECT_LE(glm::length(place - glm::dvec3(across, ray.Depth)), 5.0 * precision) << pixel;
    EXPECT_LE(glm::length(double{ line.PerDepth } * along - ray.Step), 2e-7) << pixel;
  }
  EXPECT_GT(refracted, 1000);
}
