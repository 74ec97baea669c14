// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// A second surface that ends in a curve: the wall of a tank with water behind its lower part, up to
// the waterline of waves. Truth: rays through the two sides, exactly, that meet the back below the
// line. The front is a plane, or has waves itself.
#include "StackCellScene.h"
#include "StackTestScene.h"

namespace
{

using meniscus::StackSolver;
using meniscus::reference::MembraneMesh;
using namespace meniscus::test;

constexpr double HalfWidth = 3.0;
constexpr double Bottom = -2.0;
const double FilterTolerance = 0.005 * std::acos(-1.0) / 180.0; ///< the filter's default
constexpr double Thickness = 0.1; ///< of the wall, between y = 0 and y = Thickness

/** The waterline, at points of equal distance with straight lines between them. */
class Waterline
{
public:
  explicit Waterline(int parts)
  {
    for (int i = 0; i <= parts; ++i)
    {
      const double x = HalfWidth * (2.0 * i / parts - 1.0);
      this->Heights.push_back(0.06 * std::sin(4.0 * x + 0.3) + 0.03 * std::sin(13.0 * x));
    }
  }

  int GetParts() const { return static_cast<int>(this->Heights.size()) - 1; }
  double GetX(int i) const { return HalfWidth * (2.0 * i / this->GetParts() - 1.0); }
  double GetPointHeight(int i) const { return this->Heights[static_cast<std::size_t>(i)]; }
  double GetHeight(double x) const
  {
    const double place = 0.5 * (x / HalfWidth + 1.0) * this->GetParts();
    const int i = std::clamp(static_cast<int>(place), 0, this->GetParts() - 1);
    return glm::mix(this->GetPointHeight(i), this->GetPointHeight(i + 1), place - i);
  }

private:
  std::vector<double> Heights;
};

/** A wall across y with points at (x, z) = place(i, j); its normals point to -y, to the eye. */
template <typename Place>
MembraneMesh MakeWall(double y, int columns, int rows, const Place& place)
{
  MembraneMesh mesh;
  for (const auto& [j, i] : Product(rows + 1, columns + 1))
  {
    const glm::dvec2 at = place(i, j);
    mesh.AddPoint({ at.x, y, at.y }, { 0.0, -1.0, 0.0 });
  }
  for (const auto& [j, i] : Product(rows, columns))
  {
    const std::int64_t corner = j * (columns + 1) + i;
    mesh.AddTriangle(corner, corner + 1, corner + columns + 2);
    mesh.AddTriangle(corner, corner + columns + 2, corner + columns + 1);
  }
  return mesh;
}

struct Wall
{
  const char* Name;
  int FrontCells;
  int LineParts;
  double Field; ///< half width of the view at the distance of the wall
  bool IsBelow; ///< the part of the back that is below the line, with water behind it
  glm::dvec3 Eye;
  double Waves = 0.0; ///< amplitude of waves of the front

  static constexpr double WaveNumber = 5.0;

  /** Place of the front, and its derivatives by x and z. */
  double GetFront(double x, double z) const
  {
    return this->Waves * std::sin(WaveNumber * x) * std::sin(WaveNumber * z);
  }
  glm::dvec2 GetSlopes(double x, double z) const
  {
    return this->Waves * WaveNumber *
      glm::dvec2(std::cos(WaveNumber * x) * std::sin(WaveNumber * z),
        std::sin(WaveNumber * x) * std::cos(WaveNumber * z));
  }
  /** Unit normal of the front, to the eye. */
  glm::dvec3 GetNormal(double x, double z) const
  {
    const glm::dvec2 slopes = this->GetSlopes(x, z);
    return glm::normalize(glm::dvec3(slopes.x, -1.0, slopes.y));
  }
};

std::ostream& operator<<(std::ostream& out, const Wall& wall)
{
  return out << wall.Name;
}

/** A view of a board behind the wall. */
class Scene
{
public:
  static constexpr int Pixels = 192;
  static constexpr double BoardAt = 1.0;
  static constexpr double BoardSize = 1.2;

  explicit Scene(const Wall& wall)
    : Tested(wall)
    , Line(wall.LineParts)
  {
    const glm::dvec3 target(0.0, 0.0, 0.0);
    this->Forward = glm::normalize(target - wall.Eye);
    this->Right = glm::normalize(glm::cross(this->Forward, glm::dvec3(0.0, 0.0, 1.0)));
    this->Up = glm::cross(this->Right, this->Forward);
    this->Pixel = 2.0 * wall.Field / Pixels / glm::length(wall.Eye);
  }

  MembraneMesh MakeFront() const
  {
    const int cells = this->Tested.FrontCells;
    MembraneMesh mesh = MakeWall(0.0, cells, cells,
      [cells](int i, int j) {
        return glm::dvec2(HalfWidth * (2.0 * i / cells - 1.0), -Bottom * (2.0 * j / cells - 1.0));
      });
    for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
    {
      const double x = mesh.Points[i];
      const double z = mesh.Points[i + 2];
      const glm::dvec3 normal = this->Tested.GetNormal(x, z);
      mesh.Points[i + 1] = this->Tested.GetFront(x, z);
      std::copy(&normal.x, &normal.x + 3, mesh.Normals.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return mesh;
  }

  MembraneMesh MakeBack() const
  {
    constexpr int rows = 4;
    return MakeWall(Thickness, this->Line.GetParts(), rows,
      [this](int i, int j)
      {
        const double part = static_cast<double>(j) / rows;
        const double line = this->Line.GetPointHeight(i);
        return glm::dvec2(this->Line.GetX(i),
          this->Tested.IsBelow ? glm::mix(Bottom, line, part) : glm::mix(line, -Bottom, part));
      });
  }

  glm::dvec3 GetDirection(double column, double row) const
  {
    return glm::normalize(this->Forward +
      this->Pixel * ((column - 0.5 * Pixels) * this->Right + (row - 0.5 * Pixels) * this->Up));
  }
  double GetPixel() const { return this->Pixel; }
  double GetBehind() const { return this->Tested.IsBelow ? 1.333 : 1.0; }

  /** True if the ray shows the board through both sides. */
  bool ShowsBoard(const glm::dvec3& direction) const
  {
    glm::dvec3 at = this->Tested.Eye;
    glm::dvec3 way = direction;
    this->MeetFront(at, way);
    if (!IsOnWall(at) || !Refract(this->Tested.GetNormal(at.x, at.z), 1.0 / 1.5, way))
    {
      return false;
    }
    at += (Thickness - at.y) / way.y * way;
    if (!IsOnWall(at) || (at.z < this->Line.GetHeight(at.x)) != this->Tested.IsBelow ||
      !Refract(glm::dvec3(0.0, -1.0, 0.0), 1.5 / this->GetBehind(), way))
    {
      return false;
    }
    at += (BoardAt - at.y) / way.y * way;
    return std::fabs(at.x) < BoardSize && std::fabs(at.z) < BoardSize;
  }

private:
  static bool IsOnWall(const glm::dvec3& at)
  {
    return std::fabs(at.x) <= HalfWidth && at.z >= Bottom && at.z <= -Bottom;
  }

  // Snell's law; false under total reflection.
  static bool Refract(const glm::dvec3& normal, double ratio, glm::dvec3& way)
  {
    const double cosine = -glm::dot(way, normal);
    const double squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    way = ratio * way + (ratio * cosine - std::sqrt(std::max(squared, 0.0))) * normal;
    return squared > 0.0;
  }

  // Newton's method, from the plane on; the front is nearly flat.
  void MeetFront(glm::dvec3& at, const glm::dvec3& way) const
  {
    for (int i = 0; i < 8; ++i)
    {
      const glm::dvec2 slopes = this->Tested.GetSlopes(at.x, at.z);
      at += (this->Tested.GetFront(at.x, at.z) - at.y) /
        (way.y - slopes.x * way.x - slopes.y * way.z) * way;
    }
  }

  Wall Tested;
  Waterline Line;
  glm::dvec3 Forward;
  glm::dvec3 Right;
  glm::dvec3 Up;
  double Pixel;
};

struct Difference
{
  int Covered = 0;
  int Wrong = 0;   ///< pixels that differ from the truth at all places within a fifth of a pixel
  int Missing = 0; ///< of these: pixels without an image
  int Twice = 0;   ///< pixels with several pieces at all of these places
};

Difference Compare(const Scene& scene, const Object& object, const glm::dvec3& eye)
{
  constexpr double within = 0.2;
  constexpr int around = 16;
  const std::vector<Piece> pieces = ListPieces(object, eye);
  const auto countPieces = [&pieces](const glm::dvec3& direction)
  {
    return std::count_if(pieces.begin(), pieces.end(),
      [&direction](const Piece& piece)
      {
        return glm::dot(direction, piece.Middle) >= piece.Cosine - 1e-12 &&
          Covers(piece.Corners, direction);
      });
  };
  Difference result;
  for (const auto& [row, column] : Product(Scene::Pixels, Scene::Pixels))
  {
    const double x = column + 0.5;
    const double y = row + 0.5;
    const glm::dvec3 direction = scene.GetDirection(x, y);
    const bool truth = scene.ShowsBoard(direction);
    const auto count = countPieces(direction);
    result.Covered += truth;
    bool isTwice = count > 1;
    bool isWrong = truth != (count > 0);
    for (int k = 0; k < around && (isTwice || isWrong); ++k)
    {
      const double angle = 2.0 * std::acos(-1.0) * k / around;
      const glm::dvec3 near =
        scene.GetDirection(x + within * std::cos(angle), y + within * std::sin(angle));
      isTwice = isTwice && countPieces(near) > 1;
      isWrong = isWrong && scene.ShowsBoard(near) == truth;
    }
    result.Twice += isTwice;
    result.Wrong += isWrong;
    result.Missing += isWrong && truth;
  }
  return result;
}

class RefractionStackWall : public ::testing::TestWithParam<Wall>
{
};

const glm::dvec3 InFront(0.3, -4.0, 0.4);
const glm::dvec3 AtASlant(2.5, -3.0, 1.5);

}

//------------------------------------------------------------------------------
TEST_P(RefractionStackWall, BordersAreFollowedToAFifthOfAPixel)
{
  const Scene scene(GetParam());
  StackSolver solver;
  SetStack(solver,
    { { MakeSurface(scene.MakeFront()), { 1.0, 1.5 } },
      { MakeSurface(scene.MakeBack()), { 1.5, scene.GetBehind() } } },
    GetParam().Eye);
  Object board;
  constexpr int cells = 16; // their sides cross the border
  constexpr double size = 2.0 * Scene::BoardSize / cells;
  for (int i = 0; i < cells * cells; ++i)
  {
    board.AddQuad({ size * (i % cells) - Scene::BoardSize, Scene::BoardAt,
                    size * (i / cells) - Scene::BoardSize },
      { size, 0.0, 0.0 }, { 0.0, 0.0, size });
  }
  board.Map(solver, FilterTolerance);
  const Difference result = Compare(scene, board, GetParam().Eye);
  EXPECT_GT(result.Covered, 5000);
  EXPECT_EQ(result.Wrong, 0) << "missing " << result.Missing << " twice " << result.Twice;
  EXPECT_EQ(result.Twice, 0);
  EXPECT_EQ(solver.GetNumberOfUndecidedSearches(), 0);
}

INSTANTIATE_TEST_SUITE_P(Walls, RefractionStackWall,
  ::testing::Values(Wall{ "WaterBehindTwoFacets", 1, 240, 0.3, true, InFront },
    Wall{ "WaterBehindFewFacets", 4, 120, 0.3, true, InFront },
    Wall{ "WaterBehindAFineLine", 4, 600, 0.3, true, InFront },
    Wall{ "WaterAtASlant", 4, 120, 1.0, true, AtASlant },
    Wall{ "AirBehindTwoFacets", 1, 120, 0.5, false, InFront },
    Wall{ "AirAtASlant", 10, 120, 0.5, false, AtASlant },
    Wall{ "WaterBehindWaves", 48, 120, 0.3, true, InFront, 0.02 },
    Wall{ "WaterBehindWavesAtASlant", 48, 120, 1.0, true, AtASlant, 0.02 },
    Wall{ "AirBehindWaves", 48, 120, 0.5, false, InFront, 0.02 }),
  [](const ::testing::TestParamInfo<Wall>& wall) { return wall.param.Name; });

//------------------------------------------------------------------------------
// The rim of a flat and of a curved disc behind a large plane: a closed border within few facets.
TEST(RefractionStackBorders, TheRimOfADiscIsFollowed)
{
  struct Disc
  {
    int Facets; ///< of the plane in front, along a side
    double SphereRadius;
  };
  for (const Disc& disc : { Disc{ 1, 3.0 }, Disc{ 3, 0.0 } })
  {
    MembraneMesh mesh = meniscus::reference::MakeDisc(1.0, 5, disc.SphereRadius);
    mesh.Translate({ 0.1, -0.5, 0.05 });
    StackSolver solver;
    SetStack(solver,
      { { MakeSurface(meniscus::reference::MakePlane(0.0, 3.0, disc.Facets)), { 1.0, 1.333 } },
        { MakeSurface(mesh), { 1.333, 1.5 } } },
      { 0.3, 2.0, 0.4 });
    Object object;
    object.AddQuad({ -3.0, -2.2, -3.0 }, { 6.0, 0.0, 0.0 }, { 0.0, 0.0, 6.0 });
    object.Map(solver, FilterTolerance);
    const Comparison result = Compare(solver, object, 60000, 5);
    EXPECT_GT(result.Hits, 10000);
    EXPECT_EQ(result.Wrong, 0) << disc.Facets;
  }
}
