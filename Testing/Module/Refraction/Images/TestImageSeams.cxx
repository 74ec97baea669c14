// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Pieces of images: within their cells, and without cracks between them.
#include "HeightField.h"
#include "ReadySolver.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ObjectImages.h"
#include "RefractionTestRandom.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

const double Pi = std::acos(-1.0);

/** An object of triangles. */
struct Object
{
  std::vector<glm::dvec3> Points;
  std::vector<std::int64_t> Offsets{ 0 };
  std::vector<std::int64_t> Connectivity;
  std::vector<std::int64_t> Names;

  void Add(const std::vector<std::int64_t>& ids)
  {
    this->Connectivity.insert(this->Connectivity.end(), ids.begin(), ids.end());
    this->Offsets.push_back(static_cast<std::int64_t>(this->Connectivity.size()));
    this->Names.push_back(static_cast<std::int64_t>(this->Names.size()));
  }
};

Object MakeBall(const glm::dvec3& center, double radius, int rings)
{
  Object ball;
  const int columns = 2 * rings;
  ball.Points.push_back(center + glm::dvec3(0.0, radius, 0.0));
  for (const auto& [i, j] : Product(Numbers(1, rings), columns))
  {
    const double polar = Pi * i / rings;
    const double turn = 2.0 * Pi * j / columns;
    ball.Points.push_back(center +
      radius *
        glm::dvec3(
          std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn)));
  }
  ball.Points.push_back(center - glm::dvec3(0.0, radius, 0.0));
  const auto last = static_cast<std::int64_t>(ball.Points.size()) - 1;
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

/** All images of an object's cells. */
struct Drawn
{
  ImageMesh Pieces;
  ImageMesh Whole;
  std::vector<ImagePoint> Points; ///< points of `Whole`
  meniscus::CellReport Report;
};

Drawn Draw(CurvedMembraneSolver& geometry, const Object& object, double tolerance,
  std::size_t wanted = std::numeric_limits<std::uint32_t>::max(),
  const meniscus::RangeLoop& loop = meniscus::SerialLoop)
{
  geometry.PrepareField();
  geometry.PrepareSides();
  ObjectImages images(geometry);
  images.SetTolerance(tolerance);
  const std::size_t count = object.Points.size();
  images.SetPoints(&object.Points[0].x, count, true);
  images.PrepareUnique(wanted, object.Names.size(), meniscus::SerialLoop);
  images.SolvePoints(0, count);
  images.FinishPoints();
  Drawn drawn;
  std::vector<unsigned char> isMapped(object.Names.size(), 0);
  const meniscus::ObjectCells cells{ object.Offsets.data(), object.Connectivity.data() };
  drawn.Report = images.MapPolygons(cells, object.Names.data(), 0, object.Names.size(), nullptr,
    drawn.Pieces, drawn.Whole, isMapped.data());
  images.MeetNeighbours(
    cells, object.Names.size(), isMapped.data(), true, drawn.Whole, drawn.Pieces, loop);
  drawn.Points = images.GetPointImages();
  return drawn;
}

template <typename Visit>
void VisitSides(const ImageMesh& mesh, const std::vector<ImagePoint>& points, const Visit& visit)
{
  std::int64_t begin = 0;
  for (const std::int64_t end : mesh.Ends)
  {
    for (std::int64_t i = begin; i < end; ++i)
    {
      const std::int64_t next = i + 1 < end ? i + 1 : begin;
      visit(points[static_cast<std::size_t>(mesh.Connectivity[static_cast<std::size_t>(i)])],
        points[static_cast<std::size_t>(mesh.Connectivity[static_cast<std::size_t>(next)])]);
    }
    begin = end;
  }
}

/** True if the membrane shows a point of the object at a sight point. */
bool HasImage(const CurvedMembraneSolver& geometry, const glm::dvec3& point,
  const glm::dvec3& sight, double distance)
{
  std::vector<VirtualVertex> images;
  geometry.FindImages(point, images);
  return std::any_of(images.begin(), images.end(),
    [&sight, distance](const VirtualVertex& image)
    { return glm::length(image.SightPoint - sight) < distance; });
}

/**
 * True if a piece ends here at a caustic: it draws a corner of the object where that has no image.
 */
bool IsBeyondCaustic(
  const CurvedMembraneSolver& geometry, const Object& object, double size, const ImagePoint& point)
{
  return point.GetSource() >= 0 && point.Vertex.Facet >= 0 &&
    !HasImage(geometry, object.Points[static_cast<std::size_t>(point.GetSource())],
      point.Vertex.SightPoint, 1e-6 * size);
}

/** Sides that belong to an odd number of pieces, identified by their ends' positions bit by bit. */
std::vector<std::array<ImagePoint, 2>> FindOpenSides(const Drawn& drawn)
{
  using Key = std::tuple<double, double, double>;
  std::map<std::pair<Key, Key>, std::pair<int, std::array<ImagePoint, 2>>> sides;
  const auto add = [&sides](const ImagePoint& a, const ImagePoint& b)
  {
    const Key first(a.Vertex.Position.x, a.Vertex.Position.y, a.Vertex.Position.z);
    const Key last(b.Vertex.Position.x, b.Vertex.Position.y, b.Vertex.Position.z);
    if (first != last)
    {
      auto& side = sides[std::minmax(first, last)];
      ++side.first;
      side.second = { a, b };
    }
  };
  VisitSides(drawn.Pieces, drawn.Pieces.Points, add);
  VisitSides(drawn.Whole, drawn.Points, add);
  std::vector<std::array<ImagePoint, 2>> open;
  for (const auto& [ends, side] : sides)
  {
    if (side.first % 2 == 1)
    {
      open.push_back(side.second);
    }
  }
  return open;
}

/** Waves in water, and a ball under them or half in them. */
struct SeamScene
{
  HeightField Field;
  int Cells; ///< cells of the membrane along an axis
  glm::dvec3 Eye;
  glm::dvec3 Center;
  Object Ball;

  glm::dvec3 GetPlace(const ImagePoint& point) const
  {
    glm::dvec3 place(0.0);
    for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
    {
      place += point.Weight[k] * this->Ball.Points[static_cast<std::size_t>(point.Source[k])];
    }
    return place;
  }
};

SeamScene MakeScene(int index)
{
  meniscus::test::Random random(static_cast<unsigned>(index + 1));
  SeamScene scene;
  const double length = random(40.0, 120.0);
  const bool crosses = index % 3 == 1;
  // A coarse ball whose triangles all but touch steep waves has an ill-conditioned waterline.
  const double slope = index % 4 == 0 ? 0.0 : random(0.02, crosses ? 0.1 : 0.35);
  const double interior = random(1.1, 1.8);
  scene.Field = { HeightField::Shape::Waves, 400.0, slope * length / (2.0 * Pi), 2.0 * Pi / length,
    1.0, interior };
  scene.Cells = 24 + 8 * (index % 5);
  scene.Eye = random.Point({ -60.0, 80.0, -60.0 }, { 60.0, 300.0, 60.0 });
  const double radius = random(10.0, 40.0);
  const double depth = crosses ? random(-0.7, 0.7) * radius : random(1.2 * radius + 20.0, 200.0);
  scene.Center = random.Point({ -20.0, -depth, -20.0 }, { 20.0, -depth, 20.0 });
  scene.Ball = MakeBall(scene.Center, radius, 4 + index % 7 * 3);
  return scene;
}

class RefractionSeams : public ::testing::TestWithParam<int>
{
};

// A ball is closed and entirely visible, so every side of a piece belongs to two pieces, of the
// same triangle or of two, behind the membrane or in front of it. Only at caustics, where an image
// ends, may a side belong to one piece.
TEST_P(RefractionSeams, PiecesOfABallHaveNoBorder)
{
  const SeamScene scene = MakeScene(GetParam());
  CurvedMembraneSolver geometry;
  ASSERT_EQ(geometry.SetMembrane(scene.Field.MakeMesh(scene.Cells).AsInput()),
    meniscus::MembraneStatus::Ready);
  ASSERT_EQ(geometry.SetEye(scene.Eye, scene.Field.Exterior, scene.Field.Interior),
    meniscus::EyeStatus::Ready);
  const Drawn drawn = Draw(geometry, scene.Ball, 0.005 * Pi / 180.0);
  ASSERT_GT(drawn.Whole.GetNumberOfCells() + drawn.Pieces.GetNumberOfCells(), 40u);
  const double size = scene.Field.Side / scene.Cells;
  std::size_t open = 0;
  for (const auto& side : FindOpenSides(drawn))
  {
    open += !IsBeyondCaustic(geometry, scene.Ball, size, side[0]) &&
      !IsBeyondCaustic(geometry, scene.Ball, size, side[1]);
  }
  // With several images, two polygons may place the end of one of them in different sub-cells.
  const std::size_t count = scene.Ball.Points.size();
  const bool hasCaustic = drawn.Points.size() > count;
  EXPECT_LE(open, hasCaustic ? drawn.Pieces.GetNumberOfCells() / 1000 : 0);
}

// Weights are those of a place in the triangle; position and sight point are those of an image of
// this place.
TEST_P(RefractionSeams, CornersAreImagesOfPlacesInTheirCells)
{
  const SeamScene scene = MakeScene(GetParam());
  ReadySolver geometry(
    scene.Field.MakeMesh(scene.Cells), scene.Eye, scene.Field.Exterior, scene.Field.Interior);
  const Drawn drawn = Draw(geometry, scene.Ball, 0.005 * Pi / 180.0);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double rounding = 100.0 * epsilon * scene.Field.Side;
  const double size = scene.Field.Side / scene.Cells;
  std::size_t wrong = 0;
  std::size_t searched = 0;
  for (std::size_t i = 0; i < drawn.Pieces.Points.size(); ++i)
  {
    const ImagePoint& point = drawn.Pieces.Points[i];
    ASSERT_GE(std::min({ point.Weight[0], point.Weight[1], point.Weight[2] }), 0.0);
    ASSERT_NEAR(point.Weight[0] + point.Weight[1] + point.Weight[2], 1.0, 4.0 * epsilon);
    const glm::dvec3 place = scene.GetPlace(point);
    if (point.Vertex.Facet < 0)
    {
      ASSERT_LT(glm::length(place - point.Vertex.Position), 1e-11 * scene.Field.Side);
      continue;
    }
    ASSERT_NEAR(
      glm::length(place - point.Vertex.SightPoint), point.Vertex.Depth, 1e-11 * scene.Field.Side);
    // The search takes a while; for a point on the membrane itself it tests nothing.
    if (i % 40 == 0 && point.Vertex.Depth > rounding)
    {
      ++searched;
      wrong += !HasImage(geometry, place, point.Vertex.SightPoint, 1e-6 * size) &&
        !IsBeyondCaustic(geometry, scene.Ball, size, point);
    }
  }
  // Newton's method has no solution at a caustic.
  EXPECT_LE(wrong, searched / 50);
}

// In scenes 11 and 31 triangles are seen nearly edge-on, over a stretch longer than a facet.
INSTANTIATE_TEST_SUITE_P(Scenes, RefractionSeams, ::testing::Range(0, 55));

// Triangles are seen edge-on at a place within a facet: with balls that cross the waves next to the
// waterline (55 to 361), with others at any depth. Interpolation has put ends on the wrong side of
// the membrane, and sides of strips in the wrong order.
INSTANTIATE_TEST_SUITE_P(EdgeOn, RefractionSeams,
  ::testing::Values(55, 97, 115, 136, 145, 151, 208, 214, 286, 310, 313, 352, 361, 137, 155, 222,
    233, 239, 269, 323, 350, 362));

// A triangle is seen edge-on, and the strip beyond that place ends in the same sub-cell.
INSTANTIATE_TEST_SUITE_P(StripEndsInside, RefractionSeams, ::testing::Values(566, 851));

// A sub-cell next to a caustic: the rays at its corners miss the triangle, and rays between them
// meet it.
INSTANTIATE_TEST_SUITE_P(NextToCaustics, RefractionSeams, ::testing::Values(698, 986));

// A side between two facets that is straight at its middle but not at a quarter.
INSTANTIATE_TEST_SUITE_P(WholeNeighbours, RefractionSeams, ::testing::Values(866, 957));

// A side of the ball crosses the water at such a small angle that the two are within the tolerance.
INSTANTIATE_TEST_SUITE_P(AlongTheWater, RefractionSeams, ::testing::Values(895));

// A triangle is seen edge-on where it meets the water, which leaves the sub-cell before a side.
INSTANTIATE_TEST_SUITE_P(EdgeOnAtTheWater, RefractionSeams, ::testing::Values(415, 490));

/** Area of a triangle's pieces, mapped from the membrane, at their true places. */
double MapWholeTriangle(
  const CurvedMembraneSolver& geometry, const std::array<glm::dvec3, 3>& corners)
{
  meniscus::MappedTriangle triangle{ { 0, 1, 2 }, corners };
  std::array<ImagePoint, 3> known;
  double nearest = std::numeric_limits<double>::max();
  double farthest = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    std::vector<VirtualVertex> images;
    geometry.FindImages(corners[k], images);
    EXPECT_EQ(images.size(), 1u);
    known[k].Vertex = images.at(0);
    known[k].Source[0] = static_cast<std::int64_t>(k);
    triangle.Images[k] = { &known[k], 1 };
    nearest = std::min(nearest, images[0].Depth);
    farthest = std::max(farthest, images[0].Depth);
  }
  ImageMesh pieces;
  meniscus::SharedNodes shared(
    geometry.GetMembrane().GetPositions().size(), geometry.GetMembrane().GetFacets().size());
  meniscus::PrimitiveMapper(geometry, 0.005 * Pi / 180.0, nearest, farthest, shared)
    .MapTriangle(triangle, 0, false, pieces);
  double area = 0.0;
  std::int64_t begin = 0;
  for (const std::int64_t end : pieces.Ends)
  {
    const auto getPlace = [&pieces, &corners](std::int64_t i)
    {
      const ImagePoint& point =
        pieces.Points[static_cast<std::size_t>(pieces.Connectivity[static_cast<std::size_t>(i)])];
      glm::dvec3 place(0.0);
      for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
      {
        place += point.Weight[k] * corners[static_cast<std::size_t>(point.Source[k])];
      }
      return place;
    };
    for (std::int64_t i = begin + 2; i < end; ++i)
    {
      area += 0.5 *
        glm::length(glm::cross(getPlace(i - 1) - getPlace(begin), getPlace(i) - getPlace(begin)));
    }
    begin = end;
  }
  return area;
}

//------------------------------------------------------------------------------
// Seen from the denser medium, everything above plane water has one image within Snell's window,
// also next to its rim. Facets are several times as large as the window. The pieces of a triangle
// therefore cover it once: their areas add up to its area.
TEST(RefractionSeamsCriticalAngle, SnellsWindowShowsWholeTriangles)
{
  const HeightField field{ HeightField::Shape::Waves, 400.0, 0.0, 0.03 * Pi, 1.333, 1.0 };
  ReadySolver geometry(field.MakeMesh(4), { 0.7, 20.0, 1.3 }, field.Exterior, field.Interior);
  for (const double away : { 40.0, 60.0, 80.0, 110.0 })
  {
    const std::array<glm::dvec3, 3> corners = { glm::dvec3(away, -8.0, 1.0),
      glm::dvec3(away + 3.0, -8.0, 3.0), glm::dvec3(away + 1.0, -8.0, 6.0) };
    const double area =
      0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    EXPECT_NEAR(MapWholeTriangle(geometry, corners), area, 1e-9 * area) << away;
  }
}

//------------------------------------------------------------------------------
// Snell's window is a small part of facets that are up to a million times as wide as the eye is
// deep, which reflect totally everywhere else.
TEST(RefractionSeamsCriticalAngle, SnellsWindowIsFoundInHugeFacets)
{
  struct Sea
  {
    int Cells;
    double Shift; ///< in widths; with 0, four facets have a corner in the window
  };
  for (const auto& [width, sea] : Product(List(400.0, 2e3, 1e5, 1e7),
         std::vector<Sea>{ Sea{ 1, 0.21 }, Sea{ 2, 0.21 }, Sea{ 8, 0.21 }, Sea{ 2, 0.0 } }))
  {
    const HeightField field{ HeightField::Shape::Waves, width, 0.0, 0.03 * Pi, 1.333, 1.0 };
    MembraneMesh mesh = field.MakeMesh(sea.Cells);
    mesh.Translate(sea.Shift * width * glm::dvec3(1.0, 0.0, -0.7));
    ReadySolver geometry(mesh, { 0.7, 20.0, 1.3 }, field.Exterior, field.Interior);
    const std::array<glm::dvec3, 3> corners = { glm::dvec3(-9.0, -8.0, 1.0),
      glm::dvec3(3.0, -8.0, 7.0), glm::dvec3(1.0, -8.0, -6.0) };
    const double area =
      0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    EXPECT_NEAR(MapWholeTriangle(geometry, corners), area, 1e-9 * area)
      << width << ", " << sea.Cells << " cells, shift " << sea.Shift;
  }
}

//------------------------------------------------------------------------------
// Rays into the thinner medium below a dome leave it through the far flank and meet corners of the
// ball that are in front of the flank. A place that Snell's law shows at a sight point is drawn in
// the direction of this sight point.
TEST(RefractionSeamsExit, CornersBeyondTheFarFlankAreDrawnAtTheirSightPoints)
{
  const HeightField field{ HeightField::Shape::Dome, 200.0, 40.0, 1.0 / 30.0, 1.74, 1.0 };
  const double tolerance = 0.02 * Pi / 180.0;
  CurvedMembraneSolver geometry;
  geometry.SetMembrane(field.MakeMesh(64).AsInput());
  const glm::dvec3 eye(-60.0, 150.0, 5.0);
  geometry.SetEye(eye, field.Exterior, field.Interior);
  std::size_t beyond = 0;
  for (const double x : { 36.0, 38.0, 40.0, 42.0, 44.0, 46.0 })
  {
    const Object ball = MakeBall({ x, field.GetHeight(x, 1.0) - 2.0, 1.0 }, 8.0, 6);
    const Drawn drawn = Draw(geometry, ball, tolerance);
    for (const ImagePoint& point : drawn.Pieces.Points)
    {
      if (point.Vertex.Facet < 0 || !(point.Vertex.Depth > 1.0))
      {
        continue;
      }
      glm::dvec3 place(0.0);
      for (std::size_t k = 0; k < point.GetNumberOfSources(); ++k)
      {
        place += point.Weight[k] * ball.Points[static_cast<std::size_t>(point.Source[k])];
      }
      const auto shown = field.Refract(eye, point.Vertex.SightPoint, point.Vertex.Depth);
      // The patches' normals deviate from the dome's by some 1e-4.
      if (!shown || glm::length(*shown - place) > 1e-2 * point.Vertex.Depth)
      {
        continue;
      }
      beyond += place.y > field.GetHeight(place.x, place.z);
      const glm::dvec3 sight = glm::normalize(point.Vertex.SightPoint - eye);
      const glm::dvec3 seen = glm::normalize(point.Vertex.Position - eye);
      EXPECT_LT(glm::length(glm::cross(sight, seen)), 2.0 * tolerance) << x;
    }
  }
  EXPECT_GT(beyond, 0u);
}

namespace
{

// Low waves, and an eye above them.
void SetLowWaves(CurvedMembraneSolver& geometry)
{
  const HeightField field{ HeightField::Shape::Waves, 400.0, 0.5, 0.03 * Pi, 1.0, 1.333 };
  geometry.SetMembrane(field.MakeMesh(64).AsInput());
  geometry.SetEye({ 20.0, 300.0, 10.0 }, field.Exterior, field.Interior);
}

// A ball half in front of them.
Object MakePiercingBall()
{
  return MakeBall({ 3.1, -1.7, 1.7 }, 31.7, 48);
}

}

//------------------------------------------------------------------------------
// The part of a triangle in front of a membrane that it intersects is no finer than the pieces
// behind.
TEST(RefractionSeamsCost, TrianglesThatPierceTheMembraneAreNotShredded)
{
  CurvedMembraneSolver geometry;
  SetLowWaves(geometry);
  const Object ball = MakePiercingBall();
  const Drawn drawn = Draw(geometry, ball, 0.005 * Pi / 180.0);
  ASSERT_GT(drawn.Report.Mapped, 150u);
  // One part in front and one to four behind: triangles are smaller than facets.
  EXPECT_LT(drawn.Pieces.GetNumberOfCells(), 6 * drawn.Report.Mapped);
}

//------------------------------------------------------------------------------
// Seams are closed in blocks of work, in any order.
TEST(RefractionSeamsThreads, ResultsDoNotDependOnTheOrderOfBlocks)
{
  CurvedMembraneSolver geometry;
  SetLowWaves(geometry);
  const Object ball = MakePiercingBall();
  const double tolerance = 0.005 * Pi / 180.0;
  const std::size_t all = std::numeric_limits<std::uint32_t>::max();
  std::size_t blocks = 0;
  const Drawn forward = Draw(geometry, ball, tolerance, all);
  const Drawn backward = Draw(geometry, ball, tolerance, all,
    [&blocks](std::size_t count, const meniscus::RangeBody& body)
    {
      blocks = std::max(blocks, count);
      for (std::size_t i = count; i > 0; --i)
      {
        body(i - 1, i);
      }
    });
  EXPECT_GT(blocks, 2u);
  ASSERT_EQ(forward.Pieces.Connectivity, backward.Pieces.Connectivity);
  EXPECT_EQ(forward.Pieces.Ends, backward.Pieces.Ends);
  EXPECT_EQ(forward.Pieces.SourceCells, backward.Pieces.SourceCells);
  for (std::size_t i = 0; i < forward.Pieces.Points.size(); ++i)
  {
    EXPECT_EQ(forward.Pieces.Points[i].Vertex.Position, backward.Pieces.Points[i].Vertex.Position);
  }
}

//------------------------------------------------------------------------------
// A large floor has few points for the facets that it is seen through, but mapping it from all of
// these makes many pieces.
TEST(RefractionSeamsCost, FloorsOfFewPointsAreDivided)
{
  const HeightField field{ HeightField::Shape::Waves, 200.0, 0.5, 0.03 * Pi, 1.0, 1.333 };
  ReadySolver geometry(field.MakeMesh(64), { 20.0, 300.0, 10.0 }, field.Exterior, field.Interior);
  Object floor;
  floor.Points = { { -60.0, -50.0, -60.0 }, { 60.0, -50.0, -60.0 }, { 60.0, -50.0, 60.0 },
    { -60.0, -50.0, 60.0 } };
  floor.Add({ 0, 1, 2 });
  floor.Add({ 0, 2, 3 });
  const Drawn drawn = Draw(geometry, floor, 0.05 * Pi / 180.0, floor.Points.size());
  EXPECT_EQ(drawn.Report.Divided, 2u);
  EXPECT_EQ(drawn.Report.Mapped, 0u);
  EXPECT_LT(drawn.Pieces.GetNumberOfCells(), 2000u); // it is seen through about 3,000 facets
}

//------------------------------------------------------------------------------
// A triangle with a corner that is not finite has no image, and does not disturb its neighbour.
TEST(RefractionImageCells, CellsWithPointsThatAreNotFiniteHaveNoImage)
{
  CurvedMembraneSolver geometry;
  const MembraneMesh mesh = meniscus::reference::MakeWaves(200.0, 8, 3.0, 2.0);
  ASSERT_EQ(geometry.SetMembrane(mesh.AsInput()), meniscus::MembraneStatus::Ready);
  ASSERT_EQ(geometry.SetEye({ 20.0, 300.0, 10.0 }, 1.0, 1.333), meniscus::EyeStatus::Ready);
  Object object;
  object.Points = { { -20.0, -30.0, -20.0 }, { 20.0, -30.0, -20.0 }, { 0.0, -30.0, 20.0 },
    { 0.0, -30.0, 0.0 } };
  object.Add({ 0, 1, 2 });
  const Drawn alone = Draw(geometry, object, 0.01);
  object.Add({ 0, 1, 3 });
  for (const double bad :
    { std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN() })
  {
    object.Points[3].z = bad;
    const Drawn drawn = Draw(geometry, object, 0.01);
    EXPECT_EQ(drawn.Report.Without, 1u);
    EXPECT_EQ(drawn.Pieces.GetNumberOfCells() + drawn.Whole.GetNumberOfCells(),
      alone.Pieces.GetNumberOfCells() + alone.Whole.GetNumberOfCells());
    for (const ImagePoint& point : drawn.Pieces.Points)
    {
      EXPECT_TRUE(
        std::isfinite(point.Vertex.Position.x + point.Vertex.Position.y + point.Vertex.Position.z));
    }
  }
}

}
