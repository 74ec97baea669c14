// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lengths of rays that cross large cells next to a corner, compared with closed forms.
#include "KernelMeshes.h"
#include "KernelPicture.h"

#include "Volume/Caster/PacketTables.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Rays/PlacedVertices.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

constexpr int Size = 32;
constexpr double Extent = 0.6;
constexpr double Pixel = 2.0 * Extent / Size;

/** Place of a pixel's ray along x or y. */
double PlaceOf(int pixel)
{
  return 0.5 - Extent + (pixel + 0.5) * Pixel;
}

constexpr int Column = 20;
constexpr int Row = 13;

/** A tetrahedron as high as the mesh, with a corner behind the ray of a pixel, and its length. */
struct Wedge
{
  MeshArrays Arrays;
  double Length;
};

/** @param behind distance of the corner from the ray. */
Wedge MakeWedge(double behind, double cornerHeight)
{
  const double left = PlaceOf(0);
  const double corner = PlaceOf(Column) + behind;
  const double y = PlaceOf(Row);
  constexpr double half = 0.5;
  // The opposite side is a triangle. Seen from the corner, the ray is on it at 3/4 of its height,
  // between its base and one of the other sides.
  return { { { corner, y, cornerHeight, left, y + half / 3.0, 1.0, left, y - half, 0.0, left,
               y + half, 0.0 },
             { 0, 1, 2, 3 } },
    0.75 * behind / (corner - left) };
}

/** Length in the wedge of the pixel's ray. */
double MeasureLength(const TetrahedralMesh& mesh, InstructionSet set)
{
  const std::vector<float> scalars(mesh.GetSourcePoints().size(), 0.0f);
  PacketTables tables;
  TileCaster::Scene scene;
  scene.Rays = FixedPointRays(FrameAlongZ(mesh, Extent, Size), Size, Size);
  PlaceVertices(mesh, scalars, scene.Rays, SerialLoop, tables.Vertices);
  tables.Intervals = PackIntervals(ConstantFunction(1.0));
  const std::vector<CellPassages> passages = FindPassages(mesh);
  scene.Mesh = &mesh;
  scene.Passages = &passages;
  scene.Boundary = &mesh.GetBoundary();
  scene.Tables = &tables;
  scene.Set = set;
  scene.Measuring = RayMeasuring::Scalars;
  const TileCaster caster(scene);
  TileCaster::Workspace workspace;
  EXPECT_EQ(caster.GetNumberOfTiles(), 1);
  EXPECT_EQ(caster.Measure(0, workspace).Lost, 0);
  const auto box = caster.GetBox(0);
  const int pixel = (Row - box.Bottom) * RefractedRayTiles::TileSize + Column - box.Left;
  return workspace.Measured.Scalars[static_cast<std::size_t>(pixel)].Length;
}

class SegmentLengths : public ::testing::TestWithParam<InstructionSet>
{
};

INSTANTIATE_TEST_SUITE_P(
  Sets, SegmentLengths, ::testing::ValuesIn(GetInstructionSets()), TestNameOf);

}

//------------------------------------------------------------------------------
/**
 * The depths of the cells' corners are 1 apart, and the lengths are down to 3e-6. Vertices and rays
 * are rounded by half a grid unit along each axis, which moves the corner by a unit relative to the
 * ray; the sides have slopes below 2. What remains is the rounding of floats, a few times 2^-24 of
 * the length.
 */
TEST_P(SegmentLengths, NextToCornersAreThoseOfTheRoundedCells)
{
  for (int number = 0; number < 64; ++number)
  {
    const double behind = 1.0e-2 * std::pow(3.0e-4, number / 63.0);
    const Wedge wedge = MakeWedge(behind, 0.1 + 0.0125 * number);
    TetrahedralMesh mesh;
    mesh.Build(wedge.Arrays.View());
    const double grid = 2.0 * 2.0 * 0x1p-30 * mesh.GetRadius();
    EXPECT_NEAR(MeasureLength(mesh, GetParam()), wedge.Length, grid + 8.0 * 0x1p-24 * wedge.Length)
      << "corner at " << behind;
  }
}
