// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Measurements of rays through a block, by each instruction set, compared with closed forms.
#include "KernelMeshes.h"
#include "KernelPicture.h"

#include "Volume/Caster/MeasuredRays.h"
#include "Volume/Caster/PacketTables.h"
#include "Volume/Rays/PlacedVertices.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

constexpr int Size = 48;
constexpr double Extent = 0.6;
constexpr double Tolerance = 1.0e-6;
constexpr double MeasuredFrom = -3.0;

/** Rays along -z through the unit cube, with a linear field. */
class MeasuredRaysTest : public ::testing::TestWithParam<InstructionSet>
{
protected:
  MeasuredRaysTest()
  {
    const MeshArrays arrays = KuhnGrid(3);
    this->Mesh.Build(arrays.View());
    for (const std::int32_t point : this->Mesh.GetSourcePoints())
    {
      this->Points.push_back(arrays.PointAt(point));
    }
    for (const glm::dvec3& p : this->Points)
    {
      this->Scalars.push_back(static_cast<float>(ScalarAt(p.x, p.y, p.z)));
    }
    const FixedPointRays rays(FrameAlongZ(this->Mesh, Extent, Size), Size, Size);
    PlaceVertices(this->Mesh, this->Scalars, rays, SerialLoop, this->Tables.Vertices);
    this->Tables.Intervals = PackIntervals(ConstantFunction(2.0));
    this->Passages = FindPassages(this->Mesh);
    this->Scene.Mesh = &this->Mesh;
    this->Scene.Passages = &this->Passages;
    this->Scene.Boundary = &this->Mesh.GetBoundary();
    this->Scene.Tables = &this->Tables;
    this->Scene.Rays = rays;
    this->Scene.Set = GetParam();
    this->Scene.MeasuredFrom = MeasuredFrom;
  }

  static double ScalarAt(double x, double y, double z) { return 0.4 * x - 0.2 * y + 0.5 * z - 0.1; }

  /** Calls check(x, y, pixel in the tile, measurements) for the rays through the cube. */
  void ForEachRay(
    const std::function<void(double, double, std::size_t, const MeasuredRays&)>& check) const
  {
    const TileCaster caster(this->Scene);
    TileCaster::Workspace workspace;
    int met = 0;
    RayStatistics sums;
    for (int tile = 0; tile < caster.GetNumberOfTiles(); ++tile)
    {
      const RayStatistics ofTile = caster.Measure(tile, workspace);
      sums.Rays += ofTile.Rays;
      sums.Lost += ofTile.Lost;
      const auto box = caster.GetBox(tile);
      for (const auto& [row, column] :
        Product(Numbers<int>(box.Bottom, box.Top), Numbers<int>(box.Left, box.Right)))
      {
        const double x = 0.5 + Extent * (2.0 * (column + 0.5) / Size - 1.0);
        const double y = 0.5 + Extent * (2.0 * (row + 0.5) / Size - 1.0);
        const int inTile = (row - box.Bottom) * RefractedRayTiles::TileSize + column - box.Left;
        if (x > 0.0 && x < 1.0 && y > 0.0 && y < 1.0)
        {
          check(x, y, static_cast<std::size_t>(inTile), workspace.Measured);
          ++met;
        }
      }
    }
    EXPECT_EQ(sums.Rays, met);
    EXPECT_EQ(sums.Lost, 0);
    EXPECT_GT(met, Size * Size / 2);
  }

  TetrahedralMesh Mesh;
  std::vector<CellPassages> Passages;
  std::vector<glm::dvec3> Points;
  std::vector<float> Scalars;
  PacketTables Tables;
  TileCaster::Scene Scene;
};

INSTANTIATE_TEST_SUITE_P(
  Sets, MeasuredRaysTest, ::testing::ValuesIn(GetInstructionSets()), TestNameOf);

}

//------------------------------------------------------------------------------
TEST_P(MeasuredRaysTest, Scalars)
{
  const double radius = this->Mesh.GetRadius();
  for (const RayMeasuring measuring :
    { RayMeasuring::Scalars, RayMeasuring::ScalarsAndOpticalDepth })
  {
    this->Scene.Measuring = measuring;
    const double depth = measuring == RayMeasuring::Scalars ? 0.0 : 2.0;
    this->ForEachRay(
      [&](double x, double y, std::size_t pixel, const MeasuredRays& measured)
      {
        const MeasuredScalar& ray = measured.Scalars[pixel];
        const double first = -0.5 - MeasuredFrom * radius;
        ASSERT_NEAR(ray.Length, 1.0, Tolerance);
        ASSERT_NEAR(ray.Integral, ScalarAt(x, y, 0.5), Tolerance);
        ASSERT_NEAR(ray.OpticalDepth, depth, 2.0 * Tolerance);
        ASSERT_NEAR(ray.First, first, Tolerance);
        ASSERT_NEAR(ray.Last, first + 1.0, Tolerance);
        ASSERT_NEAR(ray.Highest, ScalarAt(x, y, 1.0), Tolerance);
        ASSERT_NEAR(ray.HighestAt, first, Tolerance);
        ASSERT_NEAR(ray.Lowest, ScalarAt(x, y, 0.0), Tolerance);
        ASSERT_NEAR(ray.LowestAt, first + 1.0, Tolerance);
      });
  }
}

//------------------------------------------------------------------------------
TEST_P(MeasuredRaysTest, BinsOfVertices)
{
  std::vector<glm::vec3> values;
  for (const glm::dvec3& p : this->Points)
  {
    values.emplace_back(1.0 + p.x - 0.5 * p.z, 0.3 * p.y, 0.0);
  }
  this->Scene.Measuring = RayMeasuring::VertexBins;
  this->Scene.Components = values.data();
  this->ForEachRay(
    [](double x, double y, std::size_t pixel, const MeasuredRays& measured)
    {
      const MeasuredBin& ray = measured.Bins[pixel];
      ASSERT_NEAR(ray.Integrals[0], 0.75 + x, Tolerance);
      ASSERT_NEAR(ray.Integrals[1], 0.3 * y, Tolerance);
      ASSERT_EQ(ray.Integrals[2], 0.0);
      ASSERT_EQ(ray.Light, 0.0);
    });
}

//------------------------------------------------------------------------------
// Constant attenuation and emission per length, also without attenuation.
TEST_P(MeasuredRaysTest, Emission)
{
  for (const double attenuation : { 0.0, 0.25, 3.0, 200.0 })
  {
    const glm::vec3 value(attenuation, 0.7, 0.0);
    const std::vector<glm::vec3> ofVertices(this->Points.size(), value);
    const std::vector<glm::vec3> ofCells(
      static_cast<std::size_t>(this->Mesh.GetNumberOfCells()), value);
    const double light = attenuation > 0.0 ? -0.7 * std::expm1(-attenuation) / attenuation : 0.7;
    for (const RayMeasuring measuring : { RayMeasuring::VertexBins, RayMeasuring::CellBins })
    {
      this->Scene.Measuring = measuring;
      this->Scene.Emitting = true;
      this->Scene.Components = ofVertices.data();
      this->Scene.CellGradients = ofCells.data();
      this->ForEachRay(
        [&](double, double, std::size_t pixel, const MeasuredRays& measured)
        {
          ASSERT_NEAR(measured.Bins[pixel].Integrals[0], attenuation, Tolerance * attenuation);
          ASSERT_NEAR(measured.Bins[pixel].Light, light, Tolerance);
        });
    }
  }
}

//------------------------------------------------------------------------------
// Parts of a ray joined: the part in front comes first, and hides a part of the light behind it.
TEST(MeasuredRays, Join)
{
  MeasuredBin front;
  front.Integrals = { 0.5, 0.0, 0.0 };
  front.Light = 2.0;
  MeasuredBin behind;
  behind.Integrals = { 0.25, 1.0, 0.0 };
  behind.Light = 3.0;
  front.Join(behind);
  EXPECT_DOUBLE_EQ(front.Integrals[0], 0.75);
  EXPECT_DOUBLE_EQ(front.Integrals[1], 1.0);
  EXPECT_DOUBLE_EQ(front.Light, 2.0 + 3.0 * std::exp(-0.5));

  MeasuredScalar none;
  MeasuredScalar far;
  far.Length = 1.0;
  far.First = 4.0;
  far.Last = 5.0;
  far.Lowest = -0.5;
  far.LowestAt = 4.25;
  far.Highest = 0.5;
  far.HighestAt = 4.5;
  none.Join(far);
  EXPECT_EQ(none.First, 4.0);
  MeasuredScalar near = far;
  near.First = 1.0;
  near.Last = 2.0;
  near.LowestAt = 1.5;
  near.Highest = 0.25;
  near.HighestAt = 1.75;
  near.Join(far);
  near.Join(MeasuredScalar());
  EXPECT_EQ(near.Length, 2.0);
  EXPECT_EQ(near.First, 1.0);
  EXPECT_EQ(near.Last, 5.0);
  EXPECT_EQ(near.LowestAt, 1.5); // of equal extremes, the first
  EXPECT_EQ(near.Highest, 0.5);
  EXPECT_EQ(near.HighestAt, 4.5);
}
