// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RefractionTriangles.h"

#include "Refraction/Images/ObjectImages.h"

namespace meniscus::test
{

namespace
{

using reference::OracleAnswer;
using reference::OracleImage;
using Triangle = std::array<glm::dvec3, 3>;

// Tolerance of images, in radians at the eye: the filter's default of 0.005 degrees.
constexpr double Tolerance = 0.005 * 3.14159265358979323846 / 180.0;
constexpr int PlacesPerTriangle = 8;

/**
 * A triangle of a fan: its drawn corners, and the place on the object that each shows, in
 * barycentric coordinates.
 */
struct Piece
{
  std::array<glm::dvec3, 3> Drawn;
  std::array<glm::dvec3, 3> Sight;
  std::array<glm::dvec3, 3> Weights;
};

glm::dvec3 WeightsOf(const ImagePoint& point)
{
  glm::dvec3 result(0.0);
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (point.Source[k] >= 0)
    {
      result[static_cast<int>(point.Source[k])] += point.Weight[k];
    }
  }
  return result;
}

void AddPieces(
  const ImageMesh& mesh, const std::vector<ImagePoint>& points, std::vector<Piece>& pieces)
{
  std::int64_t begin = 0;
  for (const std::int64_t end : mesh.Ends)
  {
    for (std::int64_t k = begin + 2; k < end; ++k)
    {
      Piece piece;
      const std::int64_t ids[3] = { begin, k - 1, k };
      for (std::size_t i = 0; i < 3; ++i)
      {
        const ImagePoint& point =
          points[static_cast<std::size_t>(mesh.Connectivity[static_cast<std::size_t>(ids[i])])];
        piece.Drawn[i] = point.Vertex.Position;
        piece.Sight[i] = point.Vertex.SightPoint;
        piece.Weights[i] = WeightsOf(point);
      }
      pieces.push_back(piece);
    }
    begin = end;
  }
}

std::vector<Piece> Draw(CurvedMembraneSolver& geometry, const Triangle& triangle)
{
  ObjectImages images(geometry);
  images.SetTolerance(Tolerance);
  images.SetPoints(&triangle[0].x, 3, false);
  images.PrepareUnique(std::numeric_limits<std::uint32_t>::max(), 0, SerialLoop);
  images.SolvePoints(0, 3);
  images.FinishPoints();
  const std::int64_t offsets[2] = { 0, 3 };
  const std::int64_t connectivity[3] = { 0, 1, 2 };
  const std::int64_t name = 0;
  ImageMesh pieces;
  ImageMesh whole;
  unsigned char isMapped = 0;
  images.MapPolygons({ offsets, connectivity }, &name, 0, 1, nullptr, pieces, whole, &isMapped);
  std::vector<Piece> result;
  AddPieces(pieces, pieces.Points, result);
  AddPieces(whole, images.GetPointImages(), result);
  return result;
}

// Coordinates of `weights` in the piece; returns false if they are outside by more than `slack`.
bool Locate(const Piece& piece, const glm::dvec3& weights, double slack, glm::dvec3& inside)
{
  const auto cross = [](const glm::dvec3& a, const glm::dvec3& b) { return a.y * b.z - a.z * b.y; };
  const glm::dvec3 u = piece.Weights[1] - piece.Weights[0];
  const glm::dvec3 v = piece.Weights[2] - piece.Weights[0];
  const glm::dvec3 w = weights - piece.Weights[0];
  const double area = cross(u, v);
  inside.y = cross(w, v) / area;
  inside.z = cross(u, w) / area;
  inside.x = 1.0 - inside.y - inside.z;
  return std::min({ inside.x, inside.y, inside.z }) >= -slack;
}

//------------------------------------------------------------------------------
class TriangleChecker
{
public:
  TriangleChecker(const RefractionCase& test, const reference::SightOracle& oracle,
    const reference::SurfaceError& error)
    : Test(test)
    , Oracle(oracle)
    , Error(error)
  {
  }

  void CheckResult(CurvedMembraneSolver& geometry, const Triangle& triangle, StressRandom& random)
  {
    const std::vector<Piece> pieces = Draw(geometry, triangle);
    for (int i = 0; i < PlacesPerTriangle; ++i)
    {
      double u = random.Uniform();
      double v = random.Uniform();
      if (u + v > 1.0)
      {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      this->CheckPlace(triangle, pieces, { 1.0 - u - v, u, v });
    }
  }

  RefractionTally Tally;

private:
  struct Shown
  {
    glm::dvec3 Direction;
    bool IsTrue;
  };

  void CheckPlace(
    const Triangle& triangle, const std::vector<Piece>& pieces, const glm::dvec3& weights)
  {
    const glm::dvec3 place =
      weights.x * triangle[0] + weights.y * triangle[1] + weights.z * triangle[2];
    ++this->Tally.Points;
    const OracleAnswer answer = this->Oracle.Find(place);
    if (!answer.Complete)
    {
      ++this->Tally.GivenUp;
      return;
    }
    this->Tally.Uncertain += !answer.Uncertain.empty();
    std::vector<Shown> shown;
    for (const Piece& piece : pieces)
    {
      glm::dvec3 inside;
      if (Locate(piece, weights, 1e-9, inside))
      {
        const glm::dvec3 drawn =
          inside.x * piece.Drawn[0] + inside.y * piece.Drawn[1] + inside.z * piece.Drawn[2];
        const glm::dvec3 sight =
          inside.x * piece.Sight[0] + inside.y * piece.Sight[1] + inside.z * piece.Sight[2];
        const glm::dvec3 direction = glm::normalize(drawn - this->Test.Eye);
        shown.push_back({ direction, this->Shows(triangle, place, direction, sight) });
        if (!shown.back().IsTrue)
        {
          this->GetCount(&RefractionTally::False, "a piece shows another place", place, sight);
        }
      }
    }
    for (const OracleImage& image : answer.Images)
    {
      ++this->Tally.Images;
      this->CheckImage(answer, image, shown, place);
    }
  }

  // Place where the triangle's plane is seen in a direction; returns false if it is not seen.
  bool Trace(
    const Triangle& triangle, const glm::dvec3& direction, double distance, glm::dvec3& hit) const
  {
    const glm::dvec3 s = this->Test.Surface.Intersect(this->Test.Eye, direction, distance);
    const auto ray =
      this->Test.Surface.Refract(this->Test.Eye, s, this->Test.Exterior / this->Test.Interior);
    if (!ray)
    {
      return false;
    }
    const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double t = glm::dot(triangle[0] - s, normal) / glm::dot(*ray, normal);
    hit = s + t * *ray;
    return t > 0.0 && std::isfinite(t);
  }

  // True if light from `place` arrives within a few tolerances of a direction: the places that are
  // seen on a ring around the direction surround it.
  bool Shows(const Triangle& triangle, const glm::dvec3& place, const glm::dvec3& direction,
    const glm::dvec3& sight) const
  {
    const double distance = glm::length(sight - this->Test.Eye);
    glm::dvec3 middle;
    if (!this->Trace(triangle, direction, distance, middle))
    {
      return true; // at the critical angle or at grazing incidence
    }
    const double angle =
      4.0 * Tolerance + 4.0 * (this->Error.Position / distance + 2.0 * this->Error.Normal);
    const glm::dvec3 right = glm::normalize(glm::cross(
      direction, std::fabs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 up = glm::cross(right, direction);
    double reach = 0.0;
    for (int k = 0; k < 16; ++k)
    {
      const double turn = 0.39269908169872414 * k;
      glm::dvec3 hit;
      const glm::dvec3 near =
        glm::normalize(direction + angle * (std::cos(turn) * right + std::sin(turn) * up));
      if (!this->Trace(triangle, near, distance, hit))
      {
        return true;
      }
      reach = std::max(reach, glm::length(hit - middle));
    }
    return glm::length(place - middle) <= reach;
  }

  void CheckImage(const OracleAnswer& answer, const OracleImage& image,
    const std::vector<Shown>& shown, const glm::dvec3& place)
  {
    const glm::dvec3 direction = glm::normalize(image.Sight - this->Test.Eye);
    const double distance = glm::length(image.Sight - this->Test.Eye);
    // Half of the distance to a possible other image.
    double limit = 0.1;
    for (const OracleImage& other : answer.Images)
    {
      const double apart = glm::length(glm::normalize(other.Sight - this->Test.Eye) - direction);
      limit = apart > 0.0 ? std::min(limit, 0.5 * apart) : limit;
    }
    limit = std::max(limit, 8.0 * Tolerance + 2.0 * image.Radius / distance);
    const bool found = std::any_of(shown.begin(), shown.end(),
      [&](const Shown& other)
      { return other.IsTrue && glm::length(other.Direction - direction) <= limit; });
    if (!found)
    {
      this->GetCount(&RefractionTally::Missed, "no piece shows an image", place, image.Sight);
    }
  }

  void GetCount(std::int64_t RefractionTally::*fault, const char* what, const glm::dvec3& place,
    const glm::dvec3& sight)
  {
    ++(this->Tally.*fault);
    if (this->Tally.First.empty())
    {
      std::ostringstream text;
      text.precision(10);
      text << what << " of (" << place.x << ", " << place.y << ", " << place.z << ") at x "
           << sight.x << ", z " << sight.z;
      this->Tally.First = text.str();
    }
  }

  const RefractionCase& Test;
  const reference::SightOracle& Oracle;
  reference::SurfaceError Error;
};

} // anonymous namespace

//------------------------------------------------------------------------------
RefractionTally CheckTriangles(const RefractionCase& test, CurvedMembraneSolver& geometry,
  const reference::SightOracle& oracle, const reference::SurfaceError& error)
{
  TriangleChecker checker(test, oracle, error);
  StressRandom random(test.Triangles.size());
  for (const Triangle& triangle : test.Triangles)
  {
    checker.CheckResult(geometry, triangle, random);
  }
  return checker.Tally;
}

} // namespace meniscus::test
