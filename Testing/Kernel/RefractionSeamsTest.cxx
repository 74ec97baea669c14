// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Pieces of images: within their cells, and without cracks between them.
#include "HeightField.h"
#include "MembraneMeshes.h"
#include "Refraction/CurvedGeometry.h"
#include "Refraction/ObjectImages.h"
#include "RefractionTestRandom.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <vector>

namespace
{

using meniscus::CurvedGeometry;
using meniscus::ImageMesh;
using meniscus::ImagePoint;
using meniscus::ObjectImages;
using meniscus::reference::HeightField;
using meniscus::reference::MembraneMesh;

const double Pi = std::acos(-1.0);

/// Triangles.
struct Object
{
  std::vector<glm::dvec3> points;
  std::vector<std::int64_t> offsets{ 0 };
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> names;

  void Add(const std::vector<std::int64_t>& ids)
  {
    this->connectivity.insert(this->connectivity.end(), ids.begin(), ids.end());
    this->offsets.push_back(static_cast<std::int64_t>(this->connectivity.size()));
    this->names.push_back(static_cast<std::int64_t>(this->names.size()));
  }
};

Object MakeBall(const glm::dvec3& center, double radius, int rings)
{
  Object ball;
  const int columns = 2 * rings;
  ball.points.push_back(center + glm::dvec3(0.0, radius, 0.0));
  for (int i = 1; i < rings; ++i)
  {
    for (int j = 0; j < columns; ++j)
    {
      const double polar = Pi * i / rings;
      const double turn = 2.0 * Pi * j / columns;
      ball.points.push_back(center +
        radius *
          glm::dvec3(
            std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn)));
    }
  }
  ball.points.push_back(center - glm::dvec3(0.0, radius, 0.0));
  const auto last = static_cast<std::int64_t>(ball.points.size()) - 1;
  const auto at = [columns](int i, int j) -> std::int64_t
  { return 1 + (i - 1) * columns + j % columns; };
  for (int j = 0; j < columns; ++j)
  {
    ball.Add({ 0, at(1, j + 1), at(1, j) });
    ball.Add({ last, at(rings - 1, j), at(rings - 1, j + 1) });
    for (int i = 1; i + 1 < rings; ++i)
    {
      ball.Add({ at(i, j), at(i, j + 1), at(i + 1, j) });
      ball.Add({ at(i, j + 1), at(i + 1, j + 1), at(i + 1, j) });
    }
  }
  return ball;
}

/// All images of an object's cells.
struct Drawn
{
  ImageMesh pieces;
  ImageMesh whole;
  std::vector<ImagePoint> points; ///< of `whole`
  meniscus::CellReport report;
};

Drawn Draw(CurvedGeometry& geometry, const Object& object, double tolerance)
{
  geometry.PrepareField();
  geometry.PrepareSides();
  ObjectImages images(geometry);
  images.SetTolerance(tolerance);
  const std::size_t count = object.points.size();
  images.SetPoints(&object.points[0].x, count, true);
  images.PrepareUnique(std::numeric_limits<std::uint32_t>::max(), meniscus::SerialLoop);
  images.SolvePoints(0, count);
  images.FinishPoints();
  Drawn drawn;
  std::vector<unsigned char> isMapped(object.names.size(), 0);
  const meniscus::ObjectCells cells{ object.offsets.data(), object.connectivity.data() };
  drawn.report = images.MapPolygons(cells, object.names.data(), 0, object.names.size(), nullptr,
    drawn.pieces, drawn.whole, isMapped.data());
  images.MeetNeighbours(cells, object.names.size(), isMapped.data(), drawn.whole, drawn.pieces);
  drawn.points = images.GetPointImages();
  return drawn;
}

template <typename Visit>
void VisitSides(const ImageMesh& mesh, const std::vector<ImagePoint>& points, const Visit& visit)
{
  std::int64_t begin = 0;
  for (const std::int64_t end : mesh.ends)
  {
    for (std::int64_t i = begin; i < end; ++i)
    {
      const std::int64_t next = i + 1 < end ? i + 1 : begin;
      visit(points[static_cast<std::size_t>(mesh.connectivity[static_cast<std::size_t>(i)])],
        points[static_cast<std::size_t>(mesh.connectivity[static_cast<std::size_t>(next)])]);
    }
    begin = end;
  }
}

/// Sides of pieces that an odd number of pieces has, by the positions of their ends bit by bit.
std::size_t CountOpenSides(const Drawn& drawn, bool print = false)
{
  using Key = std::tuple<double, double, double>;
  std::map<std::pair<Key, Key>, std::pair<int, std::array<ImagePoint, 2>>> sides;
  const auto add = [&sides](const ImagePoint& a, const ImagePoint& b)
  {
    const Key first(a.vertex.position.x, a.vertex.position.y, a.vertex.position.z);
    const Key last(b.vertex.position.x, b.vertex.position.y, b.vertex.position.z);
    if (first != last)
    {
      auto& side = sides[std::minmax(first, last)];
      ++side.first;
      side.second = { a, b };
    }
  };
  VisitSides(drawn.pieces, drawn.pieces.points, add);
  VisitSides(drawn.whole, drawn.points, add);
  std::size_t open = 0;
  for (const auto& [ends, side] : sides)
  {
    open += side.first % 2;
    if (print && side.first % 2 == 1)
    {
      for (const ImagePoint& p : side.second)
      {
        std::printf(
          "[%.6f %.6f %.6f] sight %.4f %.4f %.4f f %d: %lld %.17g %lld %.17g %lld %.17g | ",
          p.vertex.position.x, p.vertex.position.y, p.vertex.position.z, p.vertex.sightPoint.x,
          p.vertex.sightPoint.y, p.vertex.sightPoint.z, p.vertex.facet, (long long)p.source[0],
          p.weight[0], (long long)p.source[1], p.weight[1], (long long)p.source[2], p.weight[2]);
      }
      std::printf("\n");
    }
  }
  return open;
}

struct SeamCase
{
  const char* name;
  HeightField field;
  int cells; ///< of the membrane
  glm::dvec3 eye;
  glm::dvec3 center;
  double radius;
  int rings;
};

const SeamCase Cases[] = {
  { "flat, coarse ball", { HeightField::Shape::Waves, 400.0, 0.0, 0.03 * Pi, 1.0, 1.333 }, 12,
    { 13.0, 151.0, 37.0 }, { 3.1, -47.3, 1.7 }, 31.7, 5 },
  { "waves, coarse ball", { HeightField::Shape::Waves, 400.0, 3.0, 0.03 * Pi, 1.0, 1.333 }, 64,
    { 13.0, 251.0, 37.0 }, { 3.1, -47.3, 1.7 }, 31.7, 5 },
  { "waves, fine ball", { HeightField::Shape::Waves, 400.0, 3.0, 0.03 * Pi, 1.0, 1.333 }, 64,
    { 13.0, 251.0, 37.0 }, { 3.1, -147.3, 1.7 }, 31.7, 24 },
  { "flat, ball half in water", { HeightField::Shape::Waves, 400.0, 0.0, 0.03 * Pi, 1.0, 1.333 },
    12, { 13.0, 151.0, 37.0 }, { 3.1, 1.7, 1.7 }, 31.7, 8 },
  { "waves, ball half in water", { HeightField::Shape::Waves, 400.0, 3.0, 0.03 * Pi, 1.0, 1.333 },
    64, { 13.0, 251.0, 37.0 }, { 3.1, 1.7, 1.7 }, 31.7, 8 },
};

class RefractionSeams : public ::testing::TestWithParam<SeamCase>
{
};

TEST_P(RefractionSeams, Print)
{
  const SeamCase& test = GetParam();
  CurvedGeometry geometry;
  ASSERT_EQ(geometry.SetMembrane(test.field.MakeMesh(test.cells).AsInput()),
    meniscus::MembraneStatus::Ready);
  ASSERT_EQ(geometry.SetEye(test.eye, test.field.exterior, test.field.interior),
    meniscus::EyeStatus::Ready);
  const Drawn drawn =
    Draw(geometry, MakeBall(test.center, test.radius, test.rings), 0.005 * Pi / 180);
  std::printf("%s: whole %zu divided %zu mapped %zu without %zu; pieces %zu, open %zu\n", test.name,
    drawn.report.whole, drawn.report.divided, drawn.report.mapped, drawn.report.without,
    drawn.pieces.GetNumberOfCells(), CountOpenSides(drawn, std::getenv("SHOW") != nullptr));
  double least = 0.0;
  double sum = 0.0;
  for (const ImagePoint& p : drawn.pieces.points)
  {
    least = std::min({ least, p.weight[0], p.weight[1], p.weight[2] });
    sum = std::max(sum, std::fabs(p.weight[0] + p.weight[1] + p.weight[2] - 1.0));
  }
  std::printf("least weight %g, sum off %g\n", least, sum);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RefractionSeams, ::testing::ValuesIn(Cases));

}
