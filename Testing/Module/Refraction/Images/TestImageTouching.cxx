// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Triangles that touch a plane membrane with a side or a corner, or lie in it. Truth: Snell's law
// at the plane in closed form, and the object itself: a plane shows each of its places once.
#include "ExactStack.h"
#include "Refraction/Curved/CurvedMembraneSolver.h"
#include "Refraction/Images/ObjectImages.h"
#include "RefractionTestRandom.h"
#include "Stack/StackCellScene.h"
#include "TestBasics.h"

namespace
{

using namespace meniscus;
using namespace meniscus::reference;
using namespace meniscus::test;

const double Pi = std::acos(-1.0);

/** Plane, eye and media. */
struct Setting
{
  const char* Name;
  int Cells;
  glm::dvec3 Eye;
  double Angle;      ///< by which the scene is turned
  double Digits;     ///< binary digits behind the point of all coordinates
  glm::dvec3 Offset; ///< of the scene from the origin
  double Exterior;
  double Interior;

  glm::dvec3 Turn(const glm::dvec3& p) const
  {
    const double c = std::cos(this->Angle);
    const double s = std::sin(this->Angle);
    const glm::dvec3 first(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
    return { first.x, c * first.y - s * first.z, s * first.y + c * first.z };
  }

  glm::dvec3 Place(const glm::dvec3& p) const
  {
    const double unit = std::exp2(this->Digits);
    return glm::round((this->Turn(p) + this->Offset) * unit) / unit;
  }
};

constexpr Setting Settings[] = {
  { "Coarse", 2, { 5.0, 80.0, -3.0 }, 0.0, 40.0, {}, 1.0, 1.333 },
  { "Straight", 8, { 5.0, 80.0, -3.0 }, 0.0, 40.0, {}, 1.0, 1.333 },
  { "Slanting", 8, { 31.7, 45.3, 60.1 }, 0.0, 40.0, {}, 1.0, 1.5 },
  { "Fine", 48, { 31.7, 45.3, 60.1 }, 0.0, 40.0, {}, 1.0, 1.333 },
  { "Turned", 8, { 5.0, 80.0, -3.0 }, 0.3, 40.0, {}, 1.0, 1.333 },
  { "TurnedAway", 20, { 31.7, 45.3, 60.1 }, 0.7, 40.0, { 1000.0, -300.0, 20.0 }, 1.0, 1.333 },
  { "Single", 8, { 5.0, 80.0, -3.0 }, 0.3, 17.0, {}, 1.0, 1.333 },
  { "SingleAway", 20, { 31.7, 45.3, 60.1 }, 0.7, 13.0, { 1000.0, -300.0, 20.0 }, 1.0, 1.333 },
  { "FromWater", 8, { 5.0, 80.0, -3.0 }, 0.0, 40.0, {}, 1.333, 1.0 },
};

/** Place of a triangle relative to the plane y = 0. */
struct Kind
{
  const char* Name;
  int Heights[3]; ///< -1 behind the plane, 0 on it, 1 in front of it
  bool IsOnGrid;  ///< the first side is on a line of facet edges, and begins at a vertex
};

constexpr Kind Kinds[] = { { "SideOfPartBehind", { 0, 0, -1 }, false },
  { "SideOfPartInFront", { 0, 0, 1 }, false }, { "CornerOfPartBehind", { 0, -1, -1 }, false },
  { "CornerOfPartInFront", { 0, 1, 1 }, false }, { "CornerBetween", { 0, 1, -1 }, false },
  { "InPlane", { 0, 0, 0 }, false }, { "SideOnEdges", { 0, 0, -1 }, true },
  { "InFrontOnEdges", { 0, 0, 1 }, true }, { "BetweenOnEdges", { 0, 1, -1 }, true } };

/** A scene of triangles of one kind, and its image. */
struct TouchingScene
{
  const Setting& Where;
  CurvedMembraneSolver Geometry;
  Object Shapes;
  ExactSurface Plane;
  glm::dvec3 Eye;

  TouchingScene(const Setting& setting, const Kind& kind, unsigned seed, int count)
    : Where(setting)
  {
    MembraneMesh mesh = meniscus::reference::MakePlane(0.0, Side, setting.Cells, false);
    for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
    {
      double* p = mesh.Points.data() + i;
      const glm::dvec3 place = setting.Place({ p[0], p[1], p[2] });
      std::copy(&place.x, &place.x + 3, p);
      const glm::dvec3 normal = setting.Turn({ 0.0, 1.0, 0.0 });
      std::copy(&normal.x, &normal.x + 3, mesh.Normals.data() + i);
    }
    this->Eye = setting.Place(setting.Eye);
    this->Plane = { setting.Exterior, setting.Interior, setting.Place({}), 0.0,
      setting.Turn({ 0.0, 1.0, 0.0 }) };
    EXPECT_EQ(this->Geometry.SetMembrane(mesh.AsInput()), meniscus::MembraneStatus::Ready);
    EXPECT_EQ(this->Geometry.SetEye(this->Eye, setting.Exterior, setting.Interior),
      meniscus::EyeStatus::Ready);
    Random random(seed);
    for (int i = 0; i < count; ++i)
    {
      this->AddTriangle(kind, random);
    }
    this->Map();
  }

  static constexpr double Side = 200.0;

  void AddTriangle(const Kind& kind, Random& random)
  {
    const double cell = Side / this->Where.Cells;
    const glm::dvec3 middle = random.Point({ -30.0, 0.0, -30.0 }, { 30.0, 0.0, 30.0 });
    std::array<glm::dvec3, 3> corners;
    double area = 0.0;
    do
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        corners[k] = middle + random.Point({ -20.0, 2.0, -20.0 }, { 20.0, 25.0, 20.0 });
        corners[k].y *= kind.Heights[k];
      }
      if (kind.IsOnGrid)
      {
        corners[0] = cell * glm::round(corners[0] / cell);
        const double diagonal = random(0.0, 1.0) < 0.5 ? 0.0 : 1.0;
        corners[1].x = corners[0].x + diagonal * (corners[1].z - corners[0].z);
      }
      area = glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    } while (area < 100.0);
    const auto first = static_cast<std::size_t>(random(0.0, 3.0));
    this->Shapes.AddTriangle(this->Where.Place(corners[first]),
      this->Where.Place(corners[(first + 1) % 3]), this->Where.Place(corners[(first + 2) % 3]));
  }

  void Map()
  {
    Object& o = this->Shapes;
    std::vector<std::int64_t> offsets;
    std::vector<std::int64_t> names;
    for (std::size_t i = 0; i <= o.GetCount(); ++i)
    {
      offsets.push_back(static_cast<std::int64_t>(3 * i));
      names.push_back(static_cast<std::int64_t>(i));
    }
    this->Geometry.PrepareField();
    this->Geometry.PrepareSides();
    ObjectImages images(this->Geometry);
    images.SetTolerance(Tolerance);
    images.SetPoints(&o.Points[0].x, o.Points.size(), true);
    images.PrepareUnique(o.Points.size(), 0, meniscus::SerialLoop);
    images.SolvePoints(0, o.Points.size());
    images.FinishPoints();
    std::vector<unsigned char> isMapped(o.GetCount());
    const meniscus::ObjectCells cells{ offsets.data(), o.Connectivity.data() };
    o.Report = images.MapPolygons(
      cells, names.data(), 0, o.GetCount(), nullptr, o.Pieces, o.Whole, isMapped.data());
    images.MeetNeighbours(
      cells, o.GetCount(), isMapped.data(), true, o.Whole, o.Pieces, meniscus::SerialLoop);
    o.PointImages = images.GetPointImages();
  }
};

/** Area of the pieces of each triangle at their places in it, over the triangle's area. */
std::vector<double> GetCoverage(const Object& object)
{
  std::vector<double> sums(object.GetCount(), 0.0);
  for (const std::int64_t cell : object.Whole.SourceCells)
  {
    sums[static_cast<std::size_t>(cell)] += 1.0;
  }
  std::int64_t begin = 0;
  for (std::size_t i = 0; i < object.Pieces.GetNumberOfCells(); ++i)
  {
    const auto cell = static_cast<std::size_t>(object.Pieces.SourceCells[i]);
    const auto getPlace = [&object](std::int64_t k)
    {
      return object.GetPoint(object.Pieces.Points[static_cast<std::size_t>(
        object.Pieces.Connectivity[static_cast<std::size_t>(k)])]);
    };
    const glm::dvec3 corner = object.GetCorner(cell, 0);
    const glm::dvec3 whole =
      glm::cross(object.GetCorner(cell, 1) - corner, object.GetCorner(cell, 2) - corner);
    for (std::int64_t k = begin + 2; k < object.Pieces.Ends[i]; ++k)
    {
      const glm::dvec3 from = getPlace(begin);
      sums[cell] +=
        std::fabs(glm::dot(whole, glm::cross(getPlace(k - 1) - from, getPlace(k) - from))) /
        glm::dot(whole, whole);
    }
    begin = object.Pieces.Ends[i];
  }
  return sums;
}

/**
 * True if all rays to a triangle meet its plane at more than 6 degrees from the same side. Where it
 * is seen edge-on, all of its places on a ray have one image.
 */
bool IsSeenFlatOn(const TouchingScene& scene, std::size_t cell)
{
  const glm::dvec3 corner = scene.Shapes.GetCorner(cell, 0);
  const glm::dvec3 normal = glm::normalize(
    glm::cross(scene.Shapes.GetCorner(cell, 1) - corner, scene.Shapes.GetCorner(cell, 2) - corner));
  double least = 1.0;
  double most = -1.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto point = static_cast<std::size_t>(scene.Shapes.Connectivity[3 * cell + k]);
    const glm::dvec3 sight = scene.Shapes.PointImages[point].Vertex.SightPoint - scene.Eye;
    const auto path =
      meniscus::reference::TraceExactly({ scene.Plane }, scene.Eye, glm::normalize(sight));
    const double slope = path ? glm::dot(normal, path->Directions[1]) : 0.0;
    least = std::min(least, slope);
    most = std::max(most, slope);
  }
  return least > 0.1 || most < -0.1;
}

/** Number of times that a sight ray shows each triangle. */
std::vector<int> FindTruth(const TouchingScene& scene, const glm::dvec3& direction)
{
  const std::optional<ExactPath> path =
    meniscus::reference::TraceExactly({ scene.Plane }, scene.Eye, direction);
  std::vector<int> truth(scene.Shapes.GetCount(), 0);
  for (std::size_t leg = 0; leg < (path ? 2u : 1u); ++leg)
  {
    const glm::dvec3 from = leg == 0 ? scene.Eye : path->Points[0];
    const glm::dvec3 way = leg == 0 ? direction : path->Directions[1];
    // A place that is on the plane within rounding is behind it.
    constexpr double slack = 1e-3;
    const double most = leg == 0 ? glm::dot(scene.Plane.Centre - scene.Eye, scene.Plane.Normal) /
          glm::dot(direction, scene.Plane.Normal) -
        slack
                                 : std::numeric_limits<double>::infinity();
    for (std::size_t cell = 0; cell < scene.Shapes.GetCount(); ++cell)
    {
      const glm::dvec3 a = scene.Shapes.GetCorner(cell, 0);
      const glm::dvec3 u = scene.Shapes.GetCorner(cell, 1) - a;
      const glm::dvec3 v = scene.Shapes.GetCorner(cell, 2) - a;
      const glm::dvec3 n = glm::cross(u, v);
      const double t = glm::dot(a - from, n) / glm::dot(way, n);
      const glm::dvec3 at = from + t * way - a;
      const double y = glm::dot(glm::cross(at, v), n) / glm::dot(n, n);
      const double z = glm::dot(glm::cross(u, at), n) / glm::dot(n, n);
      truth[cell] += t > -slack && t <= most && y >= 0.0 && z >= 0.0 && y + z <= 1.0;
    }
  }
  return truth;
}

/** True if a direction is in the cone over a piece, by the number of its sides on one ray. */
bool IsInCone(const Piece& piece, const glm::dvec3& direction)
{
  const glm::dvec3 x = glm::normalize(glm::cross(piece.Middle, glm::dvec3(0.36, 0.48, 0.8)));
  const glm::dvec3 y = glm::cross(piece.Middle, x);
  const auto project = [&](const glm::dvec3& v)
  { return glm::dvec2(glm::dot(v, x), glm::dot(v, y)) / glm::dot(v, piece.Middle); };
  const glm::dvec2 at = project(direction);
  bool isIn = false;
  for (std::size_t i = 0; i < piece.Corners.size(); ++i)
  {
    const glm::dvec2 a = project(piece.Corners[i]) - at;
    const glm::dvec2 b = project(piece.Corners[(i + 1) % piece.Corners.size()]) - at;
    isIn = isIn != ((a.y > 0.0) != (b.y > 0.0) && a.x - a.y * (b.x - a.x) / (b.y - a.y) > 0.0);
  }
  return isIn;
}

/**
 * Rays whose hits of triangles that are seen flat-on differ from the pieces. Rays within the
 * tolerance of a side are left out.
 */
Comparison CompareRays(const TouchingScene& scene, int rays, unsigned seed)
{
  const std::vector<Piece> pieces = ListPieces(scene.Shapes, scene.Eye);
  Random random(seed);
  Comparison result;
  for (int i = 0; i < rays; ++i)
  {
    const glm::dvec3 aim = random.Point({ -60.0, 0.0, -60.0 }, { 60.0, 0.0, 60.0 });
    const glm::dvec3 direction = glm::normalize(scene.Where.Place(aim) - scene.Eye);
    const std::vector<int> truth = FindTruth(scene, direction);
    const glm::dvec3 x = glm::normalize(glm::cross(direction, glm::dvec3(0.36, 0.48, 0.8)));
    const glm::dvec3 y = glm::cross(direction, x);
    bool isClear = true;
    for (int k = 0; k < 16 && isClear; ++k)
    {
      const double angle = 2.0 * Pi * k / 16.0;
      isClear = truth ==
        FindTruth(scene,
          glm::normalize(direction + Tolerance * (std::cos(angle) * x + std::sin(angle) * y)));
    }
    if (!isClear)
    {
      continue;
    }
    std::vector<int> found(truth.size(), 0);
    for (const Piece& piece : pieces)
    {
      found[piece.Cell] +=
        glm::dot(direction, piece.Middle) >= piece.Cosine - 1e-12 && IsInCone(piece, direction);
    }
    ++result.Rays;
    for (std::size_t cell = 0; cell < truth.size(); ++cell)
    {
      const bool isFlatOn = IsSeenFlatOn(scene, cell);
      result.Hits += isFlatOn && truth[cell] > 0;
      result.Wrong += isFlatOn && found[cell] != truth[cell];
    }
  }
  return result;
}

}

//------------------------------------------------------------------------------
TEST(RefractionTouching, TrianglesThatTouchAPlaneAreSeenAsRaysShowThem)
{
  for (const Setting& setting : Settings)
  {
    for (const Kind& kind : Kinds)
    {
      const TouchingScene scene(setting, kind, 71, 40);
      const Comparison result = CompareRays(scene, 1500, 72);
      EXPECT_GT(result.Hits, 40) << setting.Name << " " << kind.Name;
      EXPECT_EQ(result.Wrong, 0) << setting.Name << " " << kind.Name;
    }
  }
}

//------------------------------------------------------------------------------
// A plane shows each place of a triangle on one side of it once.
TEST(RefractionTouching, PiecesCoverTrianglesThatTouchAPlane)
{
  for (const Setting& setting : Settings)
  {
    for (const Kind& kind : Kinds)
    {
      const bool isOnOneSide = std::abs(kind.Heights[1] - kind.Heights[2]) < 2;
      if (setting.Digits < 40.0 || !isOnOneSide)
      {
        continue;
      }
      const TouchingScene scene(setting, kind, 73, 60);
      ASSERT_EQ(scene.Shapes.PointImages.size(), scene.Shapes.Points.size());
      const std::vector<double> coverage = GetCoverage(scene.Shapes);
      for (std::size_t cell = 0; cell < coverage.size(); ++cell)
      {
        EXPECT_TRUE(!IsSeenFlatOn(scene, cell) || std::fabs(coverage[cell] - 1.0) < 1e-9)
          << setting.Name << " " << kind.Name << " " << cell << ": " << coverage[cell];
      }
    }
  }
}
