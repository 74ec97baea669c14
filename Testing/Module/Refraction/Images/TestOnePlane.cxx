// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Images at one exact plane, which are found as those of a list, against Snell's law by bisection
// and against the search over patches.
#include "Refraction/Images/ObjectImages.h"
#include "Refraction/Stack/PlaneImages.h"
#include "RefractionTestRandom.h"
#include "Stack/StackTestScene.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

const glm::dvec3 Eye(12.0, 75.0, -8.0);
constexpr double Exterior = 1.0;
constexpr double Interior = 1.333;

/** A plane of 200 x 200 below the eye, for both ways. */
struct Pool
{
  CurvedMembraneSolver Geometry;
  RefractionStack Stack;
  ParallelPlanes Plane;

  Pool()
  {
    const auto surface = MakeSurface(MakePlane(0.0, 200.0, 9));
    this->Geometry.SetSurface(surface);
    EXPECT_EQ(this->Geometry.SetEye(Eye, Exterior, Interior), EyeStatus::Ready);
    EXPECT_TRUE(this->Geometry.IsFlat());
    this->Stack.SetInterfaces({ { surface, { Exterior, Interior } } });
    EXPECT_EQ(this->Stack.SetEye(Eye), EyeStatus::Ready);
    this->Plane.Set(this->Stack);
    EXPECT_TRUE(this->Plane.AreExact());
  }
};

/** Exact direction of the sight ray to a point below the plane. */
glm::dvec3 FindSight(const glm::dvec3& point)
{
  const glm::dvec2 away(point.x - Eye.x, point.z - Eye.z);
  const double distance = glm::length(away);
  const double sine = BisectSine({ Eye.y, -point.y }, { Exterior, Interior }, distance);
  const glm::dvec2 side = distance > 0.0 ? away / distance : away;
  return { sine * side.x, -std::sqrt((1.0 - sine) * (1.0 + sine)), sine * side.y };
}

/** A wavy grid of quads, which pierces the plane or not, with `cells` of the size `size`. */
struct Grid
{
  std::vector<glm::dvec3> Points;
  std::vector<std::int64_t> Connectivity;
  std::vector<std::int64_t> Offsets{ 0 };
  std::vector<std::int64_t> Names;

  Grid(int cells, double size, double height, double amplitude)
  {
    for (int i = 0; i <= cells; ++i)
    {
      for (int j = 0; j <= cells; ++j)
      {
        const glm::dvec2 place = size * glm::dvec2(i - 0.5 * cells, j - 0.5 * cells);
        this->Points.emplace_back(
          place.x, height + amplitude * std::sin(0.07 * (place.x + 2.0 * place.y)), place.y);
      }
    }
    for (int i = 0; i < cells; ++i)
    {
      for (int j = 0; j < cells; ++j)
      {
        const std::int64_t a = i * (cells + 1) + j;
        this->Connectivity.insert(
          this->Connectivity.end(), { a, a + 1, a + cells + 2, a + cells + 1 });
        this->Offsets.push_back(static_cast<std::int64_t>(this->Connectivity.size()));
        this->Names.push_back(static_cast<std::int64_t>(this->Names.size()));
      }
    }
  }
};

struct Drawn
{
  ImageMesh Pieces;
  ImageMesh Whole;
  std::vector<unsigned char> IsMapped;
  CellReport Report;
};

Drawn Draw(ObjectImages& images, const Grid& grid, bool mayCross, double tolerance)
{
  const std::size_t count = grid.Points.size();
  images.SetPoints(&grid.Points[0].x, count, mayCross);
  images.PrepareUnique(count, grid.Names.size(), SerialLoop);
  images.SetTolerance(tolerance);
  images.SolvePoints(0, count);
  images.FinishPoints();
  Drawn drawn;
  drawn.IsMapped.assign(grid.Names.size(), 0);
  const auto halve = [](const std::int64_t*, std::size_t, std::vector<std::int64_t>& triangles) {
    triangles = { 0, 1, 2, 0, 2, 3 };
  };
  drawn.Report =
    images.MapPolygons({ grid.Offsets.data(), grid.Connectivity.data() }, grid.Names.data(), 0,
      grid.Names.size(), halve, drawn.Pieces, drawn.Whole, drawn.IsMapped.data());
  return drawn;
}

}

//------------------------------------------------------------------------------
// Points below the plane, in front of it, on it, beyond its border and out of reach.
TEST(RefractionOnePlane, PointsHaveTheImagesOfTheSearch)
{
  Pool pool;
  pool.Geometry.PrepareSides();
  Random random(41);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 3000; ++i)
  {
    points.push_back(random.Point({ -160.0, -80.0, -160.0 }, { 160.0, 20.0, 160.0 }));
  }
  points.insert(points.end(),
    { { 3.0, 0.0, 5.0 }, { 0.0, 0.0, 0.0 }, { std::nan(""), -3.0, 1.0 }, { 1e300, -1.0, 0.0 },
      { 1e300, 1.0, 0.0 }, Eye, { Eye.x, -30.0, Eye.z } });
  ObjectImages byList(pool.Geometry, &pool.Plane);
  ObjectImages bySearch(pool.Geometry);
  for (ObjectImages* images : { &byList, &bySearch })
  {
    images->SetPoints(&points[0].x, points.size(), true);
    images->SolvePoints(0, points.size());
    images->FinishPoints();
  }
  std::vector<VirtualVertex> first(points.size());
  std::vector<unsigned char> isOpen(points.size(), 1);
  EXPECT_TRUE(SolveAtPlane(
    pool.Plane, &points[0].x, 0, points.size(), first.data(), isOpen.data())); // on the plane
  EXPECT_LE(std::count(isOpen.begin(), isOpen.end(), 1), 6);
  int seen = 0;
  for (std::size_t i = 0, image = 0; i < points.size(); ++i)
  {
    SCOPED_TRACE(::testing::Message() << i);
    ASSERT_EQ(byList.GetState(i), bySearch.GetState(i));
    ASSERT_EQ(byList.GetNumberOfImages(i), bySearch.GetNumberOfImages(i));
    for (std::size_t k = 0; k < byList.GetNumberOfImages(i); ++k, ++image)
    {
      const VirtualVertex& a = byList.GetPointImages()[image].Vertex;
      const VirtualVertex& b = bySearch.GetPointImages()[image].Vertex;
      EXPECT_LE(glm::length(a.Position - b.Position), 1e-9);
      EXPECT_LE(glm::length(a.SightPoint - b.SightPoint), 1e-9);
      EXPECT_NEAR(a.Depth, b.Depth, 1e-9);
      EXPECT_NEAR(a.Reflectance, b.Reflectance, 1e-12);
      EXPECT_EQ(a.Orientation, b.Orientation);
      EXPECT_EQ(a.Facet == CurvedPatches::NoFacet, b.Facet == CurvedPatches::NoFacet);
      if (a.Depth > 0.0)
      {
        const glm::dvec3 sight = FindSight(points[i]);
        EXPECT_LE(glm::length(glm::cross(sight, glm::normalize(a.Position - Eye))), 1e-12);
        ++seen;
      }
      if (!isOpen[i] && a.Depth > 0.0)
      {
        EXPECT_EQ(first[i].Position, a.Position);
      }
    }
    if (!isOpen[i] && points[i].y > 0.0)
    {
      EXPECT_EQ(first[i].State, ImageState::NoImage);
    }
  }
  EXPECT_GT(seen, 1000);
}

//------------------------------------------------------------------------------
// Every place of a whole cell is drawn within the tolerance of its sight ray; cells that are not
// kept are the same as without the list.
TEST(RefractionOnePlane, WholeCellsAreDrawnWithinTheTolerance)
{
  struct Trial
  {
    Grid Object;
    bool MayCross;
    double Tolerance;
  };
  for (const Trial& trial : { Trial{ Grid(24, 5.0, -40.0, 4.0), false, 1e-5 },
         Trial{ Grid(24, 5.0, -40.0, 4.0), false, 1e-3 },
         Trial{ Grid(6, 30.0, -30.0, 2.0), false, 3e-4 },
         Trial{ Grid(24, 5.0, 0.3, 12.0), true, 5e-5 } })
  {
    Pool pool;
    pool.Geometry.PrepareField();
    pool.Geometry.PrepareSides();
    const Grid& grid = trial.Object;
    const double tolerance = trial.Tolerance;
    ObjectImages byList(pool.Geometry, &pool.Plane);
    const Drawn own = Draw(byList, grid, trial.MayCross, tolerance);
    ObjectImages bySearch(pool.Geometry);
    const Drawn other = Draw(bySearch, grid, trial.MayCross, tolerance);
    EXPECT_EQ(own.IsMapped, other.IsMapped);
    EXPECT_EQ(own.Report.Without, other.Report.Without);
    EXPECT_EQ(own.Report.Mapped, other.Report.Mapped);
    EXPECT_EQ(own.Report.Whole + own.Report.Divided, other.Report.Whole + other.Report.Divided);
    EXPECT_EQ(own.Report.Mapped > 0, trial.MayCross);
    double largest = 0.0;
    std::int64_t begin = 0;
    for (std::size_t cell = 0; cell < own.Whole.Ends.size(); ++cell)
    {
      std::vector<glm::dvec3> real;
      std::vector<glm::dvec3> seen;
      for (; begin < own.Whole.Ends[cell]; ++begin)
      {
        const ImagePoint& image = byList.GetPointImages()[static_cast<std::size_t>(
          own.Whole.Connectivity[static_cast<std::size_t>(begin)])];
        seen.push_back(image.Vertex.Position);
        real.push_back(grid.Points[static_cast<std::size_t>(image.Source[0])]);
      }
      const double highest = std::max({ real[0].y, real[1].y, real[2].y, real[3].y });
      for (int i = 0; i <= 8 && highest < -1e-9; ++i)
      {
        const double u = i / 8.0;
        const auto along = [u](const std::vector<glm::dvec3>& p, std::size_t k)
        { return (1.0 - u) * p[k] + u * p[(k + 1) % 4]; };
        for (std::size_t k = 0; k < 4; ++k)
        {
          const glm::dvec3 drawn = glm::normalize(along(seen, k) - Eye);
          largest = std::max(largest, glm::length(glm::cross(drawn, FindSight(along(real, k)))));
        }
      }
    }
    EXPECT_LE(largest, tolerance);
    EXPECT_GT(own.Report.Whole, 0u);
  }
}
