// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Lists of the faces by which rays may enter, for meshes of cells that share no points.
#include "KernelMeshes.h"

#include "TestBasics.h"
#include "Volume/Caster/TileCaster.h"
#include "Volume/Entries/BoundaryRaster.h"
#include "Volume/Entries/EntryTiles.h"
#include "Volume/Packet/Data/PacketRays.h"
#include "Volume/Rays/ExactEdgeTest.h"
#include "Volume/Rays/PlacedVertices.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

using namespace meniscus;
using namespace meniscus::test;

namespace
{

constexpr int Pixels = 96;
constexpr int TileSize = 2;

/** Each cell with its own points, shrunk about their mean. */
MeshArrays Apart(const MeshArrays& arrays, double factor)
{
  MeshArrays apart;
  for (std::size_t c = 0; c < arrays.Cells.size(); c += 4)
  {
    glm::dvec3 mean(0.0);
    for (int i = 0; i < 4; ++i)
    {
      mean += 0.25 * arrays.PointAt(arrays.Cells[c + i]);
    }
    for (int i = 0; i < 4; ++i)
    {
      const glm::dvec3 point = mean + factor * (arrays.PointAt(arrays.Cells[c + i]) - mean);
      apart.Points.insert(apart.Points.end(), { point.x, point.y, point.z });
      apart.Cells.push_back(static_cast<std::int64_t>(c) + i);
    }
  }
  return apart;
}

/** A view from outside, from inside, or parallel. */
RayFrame FrameFrom(const TetrahedralMesh& mesh, const glm::dvec3& eye, double degrees)
{
  RayFrameInput input;
  input.WorldToView = glm::lookAt(eye, glm::dvec3(0.5, 0.52, 0.47), glm::dvec3(0.1, 1.0, 0.2));
  input.ViewToClip = degrees > 0.0 ? glm::perspective(glm::radians(degrees), 1.0, 0.01, 20.0)
                                   : glm::ortho(-0.8, 0.8, -0.8, 0.8, 0.01, 20.0);
  input.Center = mesh.GetCenter();
  input.Radius = mesh.GetRadius();
  input.ImageSize = glm::dvec2(Pixels);
  RayFrame frame;
  EXPECT_EQ(ComputeRayFrame(input, frame), RayFrameStatus::Ok);
  return frame;
}

struct ListCheck
{
  std::int64_t Entries = 0;
  std::int64_t Missing = 0;
  std::int64_t TooNear = 0;
  std::int64_t Disorder = 0;
};

/**
 * Every entry that the native backend finds has to be in the list of its tile, and not before its
 * listed depth.
 */
ListCheck CheckLists(
  const TetrahedralMesh& mesh, const EntryTiles& tiles, const FixedPointRays& rays)
{
  std::vector<PacketVertex> vertices;
  PlaceVertices(mesh, {}, rays, SerialLoop, vertices);
  BoundaryRaster raster;
  raster.Build(vertices, mesh.GetBoundary(), rays);
  ListCheck check;
  BoundaryRaster::Workspace workspace;
  for (int tile = 0; tile < raster.GetNumberOfTiles(); ++tile)
  {
    raster.CollectEntries(tile, workspace);
    const ProjectedFaces::PixelBox box = raster.BoxOfTile(tile);
    for (int pixel = 0; pixel < BoundaryRaster::TileSize * BoundaryRaster::TileSize; ++pixel)
    {
      const int column = box.Left + pixel % BoundaryRaster::TileSize;
      const int row = box.Bottom + pixel / BoundaryRaster::TileSize;
      const EntryLists& lists = workspace.Lists;
      for (std::int32_t e = lists.GetBegin(pixel); e < lists.GetBegin(pixel + 1); ++e)
      {
        const PacketEntry& entry = lists.GetEntries()[e];
        const int number = row / TileSize * tiles.GetNumberOfColumns() + column / TileSize;
        const auto first = tiles.GetFaces().begin() + tiles.GetBegins()[number];
        const auto last = tiles.GetFaces().begin() + tiles.GetBegins()[number + 1];
        const auto found = std::find_if(first, last,
          [&](std::int32_t f) { return mesh.GetBoundary()[f].CellFace == entry.CellFace; });
        ++check.Entries;
        check.Missing += found == last;
        check.TooNear +=
          found != last && rays.ToFrame(entry.Depth) < tiles.GetNearestDepths()[*found];
      }
    }
  }
  for (std::size_t t = 0; t + 1 < tiles.GetBegins().size(); ++t)
  {
    for (std::int32_t i = tiles.GetBegins()[t] + 1; i < tiles.GetBegins()[t + 1]; ++i)
    {
      check.Disorder += tiles.GetNearestDepths()[tiles.GetFaces()[i]] <
        tiles.GetNearestDepths()[tiles.GetFaces()[i - 1]];
    }
  }
  return check;
}

/** Number of the entries of all pixels' rays, found by testing every face, that a raster lacks. */
std::int64_t CountMissedEntries(const TetrahedralMesh& mesh, const FixedPointRays& rays)
{
  using Test = ExactEdgeTest<void>;
  std::vector<PacketVertex> vertices;
  PlaceVertices(mesh, {}, rays, SerialLoop, vertices);
  BoundaryRaster raster;
  raster.Build(vertices, mesh.GetBoundary(), rays);
  ProjectedFaces faces;
  faces.Set(vertices, mesh.GetBoundary(), rays);
  std::int64_t missed = 0;
  BoundaryRaster::Workspace workspace;
  for (int tile = 0; tile < raster.GetNumberOfTiles(); ++tile)
  {
    raster.CollectEntries(tile, workspace);
    for (int pixel = 0; pixel < BoundaryRaster::TileSize * BoundaryRaster::TileSize; ++pixel)
    {
      PacketRay ray;
      BoundaryRaster::SetLine(workspace, static_cast<std::size_t>(pixel), ray);
      std::int64_t entries = 0;
      for (std::size_t face = 0; face < faces.GetNumberOfFaces(); ++face)
      {
        const PacketFace entered = faces.GetEntered(static_cast<std::int32_t>(face));
        const auto corner = [&](int k)
        {
          const std::int32_t vertex = entered.Vertices[k];
          return Test::AboutRay(
            faces.GetVertex(vertex), vertex, ray, rays.GetPivot(), rays.AreFine());
        };
        entries += ExactEntry<void>::Of(corner(0), corner(1), corner(2)).Entered;
      }
      missed += entries - (workspace.Lists.GetBegin(pixel + 1) - workspace.Lists.GetBegin(pixel));
    }
  }
  return missed;
}

/** Entries of selected rays of a refined image, those that differ, and tiles that are not empty. */
struct RefinedCheck
{
  std::int64_t Entries = 0;
  std::int64_t Different = 0;
  std::int64_t Unwanted = 0;
  bool PlacesAlike = false;
};

/** True if two workspaces have the same line and the same entries for a ray of each. */
bool HaveSameRay(const BoundaryRaster::Workspace& a, std::size_t rayOfA,
  const BoundaryRaster::Workspace& b, std::size_t rayOfB)
{
  PacketRay lines[2] = {};
  BoundaryRaster::SetLine(a, rayOfA, lines[0]);
  BoundaryRaster::SetLine(b, rayOfB, lines[1]);
  const auto entriesOf = [](const EntryLists& lists, std::size_t ray)
  {
    std::vector<std::pair<float, std::int32_t>> entries;
    for (std::int32_t e = lists.GetBegin(ray); e < lists.GetBegin(ray + 1); ++e)
    {
      entries.emplace_back(lists.GetEntries()[e].Depth, lists.GetEntries()[e].CellFace);
    }
    return entries;
  };
  const auto entries = entriesOf(a.Lists, rayOfA);
  const bool sameLine = std::equal(std::begin(lines[0].Offset), std::end(lines[0].Offset),
                          std::begin(lines[1].Offset)) &&
    std::equal(std::begin(lines[0].Slope), std::end(lines[0].Slope), std::begin(lines[1].Slope));
  return entries == entriesOf(b.Lists, rayOfB) && (sameLine || entries.empty());
}

/**
 * Compares the entries of random rays in every third tile of a refined image with those of all its
 * rays.
 */
RefinedCheck CheckRefinement(
  const TetrahedralMesh& mesh, const RayFrame& frame, int across, std::mt19937& random)
{
  const FixedPointRays pixels(frame, Pixels, Pixels);
  const FixedPointRays rays(Refined(frame, across), across * Pixels, across * Pixels);
  std::vector<PacketVertex> ofPixels;
  std::vector<PacketVertex> ofRays;
  PlaceVertices(mesh, {}, pixels, SerialLoop, ofPixels);
  PlaceVertices(mesh, {}, rays, SerialLoop, ofRays);
  const int pitch = BoundaryRaster::TileSize / across * across;
  const InstructionSet set = BestInstructionSet();
  BoundaryRaster coarse;
  coarse.Build(ofPixels, mesh.GetBoundary(), pixels);
  BoundaryRaster whole;
  whole.Build(ofRays, mesh.GetBoundary(), rays, SerialLoop, set, pitch);
  std::vector<std::uint8_t> tiles(static_cast<std::size_t>(whole.GetNumberOfTiles()), 0);
  for (std::size_t tile = 0; tile < tiles.size(); tile += 3)
  {
    tiles[tile] = 1;
  }
  BoundaryRaster part;
  part.Build(ofRays, mesh.GetBoundary(), rays, SerialLoop, set, pitch, { &coarse, &tiles });

  RefinedCheck check;
  check.PlacesAlike = rays.PlacesAs(pixels);
  BoundaryRaster::Workspace all;
  BoundaryRaster::Workspace some;
  for (int tile = 0; tile < whole.GetNumberOfTiles(); ++tile)
  {
    if (tiles[static_cast<std::size_t>(tile)] == 0)
    {
      check.Unwanted += part.IsEmpty(tile) ? 0 : 1;
      continue;
    }
    const ProjectedFaces::PixelBox box = whole.BoxOfTile(tile);
    std::vector<std::int16_t> selected;
    for (std::int16_t ray = 0; ray < BoundaryRaster::TileSize * BoundaryRaster::TileSize; ++ray)
    {
      const bool isInside = ray % BoundaryRaster::TileSize < box.Right - box.Left &&
        ray / BoundaryRaster::TileSize < box.Top - box.Bottom;
      if (isInside && random() % 3 == 0)
      {
        selected.push_back(ray);
      }
    }
    std::shuffle(selected.begin(), selected.end(), random);
    whole.CollectEntries(tile, all);
    part.CollectEntries(tile, selected, some);
    for (std::size_t i = 0; i < selected.size(); ++i)
    {
      const auto ray = static_cast<std::size_t>(selected[i]);
      check.Entries += all.Lists.GetBegin(ray + 1) - all.Lists.GetBegin(ray);
      check.Different += HaveSameRay(all, ray, some, i) ? 0 : 1;
    }
  }
  return check;
}

}

TEST(EntryTiles, HoldEveryEntryInTheOrderOfDepth)
{
  for (const double factor : { 1.0, 0.999, 0.5 })
  {
    TetrahedralMesh mesh;
    ASSERT_EQ(mesh.Build(Apart(KuhnGrid(5), factor).View()), MeshStatus::Ok);
    const std::vector<std::pair<glm::dvec3, double>> views{ { { 1.9, 1.3, 2.2 }, 30.0 },
      { { 1.9, 1.3, 2.2 }, 0.0 }, { { 0.5, 0.52, 3.0 }, 0.0 }, { { 0.41, 0.37, 0.9 }, 100.0 },
      { { 0.9, 0.8, 1.1 }, 5.0 } };
    for (const auto& view : views)
    {
      const FixedPointRays rays(FrameFrom(mesh, view.first, view.second), Pixels, Pixels);
      EntryTiles tiles;
      ASSERT_TRUE(tiles.Build(mesh, mesh.GetBoundary(), rays, TileSize));
      const ListCheck check = CheckLists(mesh, tiles, rays);
      EXPECT_GT(check.Entries, 1000);
      EXPECT_EQ(check.Missing, 0);
      EXPECT_EQ(check.TooNear, 0);
      EXPECT_EQ(check.Disorder, 0);
    }
  }
}

TEST(EntryTiles, AreFewFacesLongerThanTheEntriesOfTheirRays)
{
  // The work of a shader: each of a tile's rays examines its faces once. The pixel centres of a
  // tile form a square of side t = 1. Kuhn's faces have a mean area of 0.60 e^2 and a mean
  // perimeter of 3.78 e, with e = 7.5 pixels here; projected along a random direction A = 17 and P
  // = 22, and tiles examine A + 2 t P / pi + t^2 = 1.9 A. A factor of 1.5 allows for a single
  // direction and for needles.
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(Apart(KuhnGrid(8), 1.0).View()), MeshStatus::Ok);
  const FixedPointRays rays(FrameFrom(mesh, { 1.9, 1.3, 2.2 }, 0.0), Pixels, Pixels);
  EntryTiles tiles;
  ASSERT_TRUE(tiles.Build(mesh, mesh.GetBoundary(), rays, TileSize));
  const ListCheck check = CheckLists(mesh, tiles, rays);
  const auto looks = static_cast<std::int64_t>(tiles.GetFaces().size()) * TileSize * TileSize;
  EXPECT_LT(looks, 2.85 * static_cast<double>(check.Entries));
}

TEST(EntryTiles, DoNotDependOnTheLoop)
{
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(Apart(KuhnGrid(7), 0.8).View()), MeshStatus::Ok);
  const FixedPointRays rays(FrameFrom(mesh, { 1.9, 1.3, 2.2 }, 30.0), Pixels, Pixels);
  EntryTiles serial;
  EntryTiles other;
  ASSERT_TRUE(serial.Build(mesh, mesh.GetBoundary(), rays, TileSize));
  ASSERT_TRUE(other.Build(mesh, mesh.GetBoundary(), rays, TileSize,
    [](std::size_t count, const RangeBody& body)
    {
      for (std::size_t i = count; i > 0; --i)
      {
        body(i - 1, i);
      }
    }));
  EXPECT_EQ(serial.GetBegins(), other.GetBegins());
  EXPECT_EQ(serial.GetFaces(), other.GetFaces());
  EXPECT_EQ(serial.GetNearestDepths(), other.GetNearestDepths());
}

TEST(EntryTiles, ExpectedLengthIsThatOfManyViews)
{
  // The estimate is a mean over directions: the mean over 24 random ones is near it.
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(Apart(KuhnGrid(6), 0.9).View()), MeshStatus::Ok);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  double faces = 0.0;
  double covered = 0.0;
  double side = 0.0;
  for (int i = 0; i < 24; ++i)
  {
    const glm::dvec3 direction(normal(random), normal(random), normal(random));
    const glm::dvec3 eye = glm::dvec3(0.5) + 3.0 * glm::normalize(direction);
    const RayFrame frame = FrameFrom(mesh, eye, 0.0);
    EntryTiles tiles;
    ASSERT_TRUE(
      tiles.Build(mesh, mesh.GetBoundary(), FixedPointRays(frame, Pixels, Pixels), TileSize));
    for (std::size_t t = 0; t + 1 < tiles.GetBegins().size(); ++t)
    {
      const std::int32_t length = tiles.GetBegins()[t + 1] - tiles.GetBegins()[t];
      faces += length;
      covered += length > 0 ? 1.0 : 0.0;
    }
    // The side between the centres of its pixels.
    side = (TileSize - 1) * glm::length(frame.Origin.PerColumn);
  }
  const double expected = ExpectedEntriesPerTile(MeasureBoundary(mesh), side);
  EXPECT_NEAR(faces / covered / expected, 1.0, 0.25);
}

TEST(BoundaryRaster, FindsEveryEntryFromAnEyeAtAVertex)
{
  // All rays pass the vertex where the eye is within the rounding of rays, and the pixel that shows
  // it is undetermined. Rays with and without fractions of grid units.
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(Apart(KuhnGrid(3), 1.0).View()), MeshStatus::Ok);
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec3 eye = glm::dvec3(1.0, 1.0, 2.0) / 3.0 + 2.0e-10 * i;
    const RayFrame frame = FrameFrom(mesh, eye, 60.0);
    for (const double spacing : { 0.0, 1.0 })
    {
      const FixedPointRays rays(frame, Pixels, Pixels, frame.NearDepth, spacing);
      ASSERT_EQ(rays.AreFine(), spacing == 0.0);
      EXPECT_EQ(CountMissedEntries(mesh, rays), 0) << i;
    }
  }
}

TEST(BoundaryRaster, FindsTheSameEntriesForPartsOfRefinedImages)
{
  // Views from outside, and from inside, where faces are unbounded in the image. Thirds of a pixel
  // are rounded, so that vertices may have other places about them.
  TetrahedralMesh mesh;
  ASSERT_EQ(mesh.Build(Apart(KuhnGrid(5), 0.9).View()), MeshStatus::Ok);
  std::mt19937 random(7);
  for (const int across : { 2, 3, 4 })
  {
    for (const double degrees : { 0.0, 30.0, 100.0 })
    {
      const glm::dvec3 eye =
        degrees < 60.0 ? glm::dvec3(1.9, 1.3, 2.2) : glm::dvec3(0.41, 0.37, 0.9);
      const RayFrame frame = FrameFrom(mesh, eye, degrees);
      const RefinedCheck check = CheckRefinement(mesh, frame, across, random);
      EXPECT_GT(check.Entries, 1000);
      EXPECT_EQ(check.Different, 0) << across << " " << degrees;
      EXPECT_EQ(check.Unwanted, 0);
      EXPECT_TRUE(check.PlacesAlike || across == 3);
    }
  }
}

TEST(EntryLists, OrderEntriesHoweverTheyCome)
{
  std::mt19937 random(11);
  for (const int count : { 1, 2, 17, 400 })
  {
    std::vector<PacketFace> faces;
    std::vector<PacketHit> hits;
    std::map<std::pair<float, std::int32_t>, int> expected[3];
    for (int i = 0; i < count; ++i)
    {
      const auto ray = static_cast<std::int32_t>(random() % 3);
      // Depths that are often equal, in random order.
      const float depth = static_cast<float>(random() % 20);
      faces.push_back({ { 0, 1, 2 }, i });
      hits.push_back({ ray, i, depth });
      expected[ray][{ depth, i }] = 1;
    }
    EntryLists lists;
    lists.Set(3, hits.data(), hits.size(), faces.data());
    for (int ray = 0; ray < 3; ++ray)
    {
      std::int32_t at = lists.GetBegin(ray);
      for (const auto& entry : expected[ray])
      {
        ASSERT_LT(at, lists.GetBegin(ray + 1));
        EXPECT_EQ(lists.GetEntries()[at].Depth, entry.first.first);
        EXPECT_EQ(lists.GetEntries()[at].CellFace, entry.first.second);
        ++at;
      }
      EXPECT_EQ(at, lists.GetBegin(ray + 1));
    }
  }
}
