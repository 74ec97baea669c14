// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Transmittance from vertices to a light, against closed forms.
#include "KernelMeshes.h"
#include "KernelPicture.h"

#include "Volume/Caster/PacketTables.h"
#include "Volume/Illumination/FibonacciSphere.h"
#include "Volume/Illumination/VertexShadows.h"

#include <glm/vector_relational.hpp>

namespace
{

using namespace meniscus;

/** A mesh with a medium, and its shadows. The base frame has the world's axes, but for the depth,
 * which is along -z. */
class Shadows
{
public:
  Shadows(const test::MeshArrays& arrays, double attenuation, InstructionSet set)
    : Shadows(arrays, test::ConstantFunction(attenuation), set)
  {
  }
  Shadows(const test::MeshArrays& arrays, const std::vector<TransferFunctionInterval>& function,
    InstructionSet set)
  {
    this->Mesh.Build(arrays.View());
    this->Scalars.assign(static_cast<std::size_t>(this->Mesh.GetNumberOfVertices()), 0.0f);
    this->Tables.Intervals = PackIntervals(function);
    this->Scene.Medium.Mesh = &this->Mesh;
    this->Scene.Medium.Passages = &this->Passages;
    this->Scene.Medium.Tables = &this->Tables;
    this->Scene.Medium.Set = set;
    this->Scene.Scalars = &this->Scalars;
    this->Scene.Tree = &this->Tree;
    this->Scene.Starts = &this->Starts;
    this->Scene.Base = test::FrameAlongZ(this->Mesh, 1.0, 1);
  }

  /** World position of a vertex. */
  glm::dvec3 PlaceOf(std::int32_t vertex) const
  {
    return this->Mesh.GetCenter() + this->Mesh.GetRadius() * this->Mesh.GetPosition(vertex);
  }
  /** A vector of the world in the base frame. */
  glm::dvec3 ToBase(const glm::dvec3& vector) const
  {
    const glm::dmat3 rows(this->Scene.Base.RowX, this->Scene.Base.RowY, this->Scene.Base.RowDepth);
    return vector / this->Mesh.GetRadius() * rows;
  }

  /** Transmittances of all vertices; -1 for vertices without one. */
  std::vector<float> Cast(const glm::dvec4& light)
  {
    this->Tree.Build(this->Mesh);
    this->Starts.Build(this->Mesh);
    this->Passages = FindPassages(this->Mesh);
    std::vector<float> result(this->Scalars.size(), -1.0f);
    this->Sums = CastShadows(this->Scene, light, SerialLoop,
      [&result](std::int32_t vertex, float transmittance)
      {
        EXPECT_EQ(result[static_cast<std::size_t>(vertex)], -1.0f) << "taken twice";
        result[static_cast<std::size_t>(vertex)] = transmittance;
      });
    EXPECT_EQ(this->Sums.Lost, 0);
    return result;
  }
  std::vector<float> CastParallel(const glm::dvec3& direction)
  {
    return this->Cast(glm::dvec4(this->ToBase(direction), 0.0));
  }
  std::vector<float> CastFrom(const glm::dvec3& position)
  {
    return this->Cast(glm::dvec4(this->ToBase(position - this->Mesh.GetCenter()), 1.0));
  }

  TetrahedralMesh Mesh;
  std::vector<CellPassages> Passages;
  std::vector<float> Scalars;
  PacketTables Tables;
  BoundaryTree Tree;
  ShadowStarts Starts;
  ShadowScene Scene;
  RayStatistics Sums;
};

/** Length of the ray from a point in the unit cube to its border. */
double LengthInCube(const glm::dvec3& place, const glm::dvec3& direction)
{
  double length = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (direction[axis] != 0.0)
    {
      length =
        std::min(length, ((direction[axis] > 0.0 ? 1.0 : 0.0) - place[axis]) / direction[axis]);
    }
  }
  return std::max(length, 0.0);
}

/** Error by the places of lines next to vertices, with that of single precision. */
double ErrorOf(double attenuation, double edge)
{
  return 2.0 * attenuation * edge * ShadowStarts::Share + 2.0e-6;
}

class VertexShadowsTest : public ::testing::TestWithParam<InstructionSet>
{
};

TEST_P(VertexShadowsTest, CubeHasClosedForm)
{
  constexpr double attenuation = 0.8;
  Shadows shadows(test::KuhnGrid(8), attenuation, GetParam());
  const glm::dvec3 directions[] = { { 0, 0, 1 }, { 0, -1, 0 }, { 1, 0, 0 }, { 1, 1, 0 },
    { 1, 1, 1 }, { -0.3, 0.5, 0.8 } };
  for (const glm::dvec3& given : directions)
  {
    const glm::dvec3 direction = glm::normalize(given);
    const std::vector<float> result = shadows.CastParallel(direction);
    for (std::size_t v = 0; v < result.size(); ++v)
    {
      const double length = LengthInCube(shadows.PlaceOf(static_cast<std::int32_t>(v)), direction);
      // A place next to a vertex where the border's faces meet is as far inside of all of them, as
      // seen along the steepest one.
      const double grazing =
        std::max({ std::abs(direction.x) > 1e-6 ? 1 / std::abs(direction.x) : 1,
          std::abs(direction.y) > 1e-6 ? 1 / std::abs(direction.y) : 1,
          std::abs(direction.z) > 1e-6 ? 1 / std::abs(direction.z) : 1 });
      ASSERT_NEAR(result[v], std::exp(-attenuation * length), grazing * ErrorOf(attenuation, 0.125))
        << "vertex " << v << ", direction " << given.x << ' ' << given.y << ' ' << given.z;
    }
  }
}

TEST_P(VertexShadowsTest, LightsAnywhereHaveClosedForm)
{
  constexpr double attenuation = 2.0;
  Shadows shadows(test::KuhnGrid(6), attenuation, GetParam());
  // Outside, inside of a cell, on a vertex, in the centre, far away.
  const glm::dvec3 places[] = { { 0.3, 0.2, 3.0 }, { 0.31, 0.42, 0.57 }, { 0.5, 0.5, 1.0 / 3.0 },
    { 0.5, 0.5, 0.5 }, { 1.0e+6, 2.0e+6, -3.0e+6 } };
  for (const glm::dvec3& light : places)
  {
    const std::vector<float> result = shadows.CastFrom(light);
    for (std::size_t v = 0; v < result.size(); ++v)
    {
      const glm::dvec3 place = shadows.PlaceOf(static_cast<std::int32_t>(v));
      const double distance = glm::length(light - place);
      const double length =
        distance > 0.0 ? std::min(distance, LengthInCube(place, (light - place) / distance)) : 0.0;
      ASSERT_NEAR(result[v], std::exp(-attenuation * length), 8.0 * ErrorOf(attenuation, 0.3))
        << "vertex " << v << ", light " << light.x << ' ' << light.y << ' ' << light.z;
    }
  }
}

TEST_P(VertexShadowsTest, LineEndsAtReach)
{
  Shadows shadows(test::KuhnGrid(4), 1.0, GetParam());
  const double unit = shadows.Mesh.GetRadius() / glm::length(shadows.Scene.Base.RowX);
  shadows.Scene.Reach = 0.25 / unit;
  const std::vector<float> result = shadows.CastParallel({ 0, 0, 1 });
  for (std::size_t v = 0; v < result.size(); ++v)
  {
    const double above = 1.0 - shadows.PlaceOf(static_cast<std::int32_t>(v)).z;
    ASSERT_NEAR(result[v], std::exp(-std::min(above, 0.25)), ErrorOf(1.0, 0.25)) << v;
  }
}

TEST_P(VertexShadowsTest, GapIsPassed)
{
  // Two cubes with a gap of 1 between them, along z.
  const test::MeshArrays arrays = test::Joined(test::KuhnGrid(2),
    test::Moved(
      test::KuhnGrid(2), [](const glm::dvec3& p) { return p + glm::dvec3(0.0, 0.0, 2.0); }));
  Shadows shadows(arrays, 0.7, GetParam());
  const std::vector<float> result = shadows.CastParallel({ 0, 0, 1 });
  for (std::size_t v = 0; v < result.size(); ++v)
  {
    const double z = shadows.PlaceOf(static_cast<std::int32_t>(v)).z;
    const double length = z < 1.5 ? 2.0 - z : 3.0 - z;
    ASSERT_NEAR(result[v], std::exp(-0.7 * length), ErrorOf(0.7, 0.5)) << z;
  }
}

TEST_P(VertexShadowsTest, HoleIsPassedInAllDirections)
{
  // A cube with a cubic hole: lines from one half of its vertices enter the mesh again.
  const glm::dvec3 low(0.25);
  const glm::dvec3 high(0.75);
  const test::MeshArrays cube = test::KuhnGrid(8);
  test::MeshArrays arrays;
  arrays.Points = cube.Points;
  for (std::size_t cell = 0; cell < cube.Cells.size(); cell += 4)
  {
    glm::dvec3 center(0.0);
    for (std::size_t k = 0; k < 4; ++k)
    {
      center += 0.25 * cube.PointAt(cube.Cells[cell + k]);
    }
    if (glm::any(glm::lessThan(center, low)) || glm::any(glm::greaterThan(center, high)))
    {
      arrays.Cells.insert(
        arrays.Cells.end(), cube.Cells.data() + cell, cube.Cells.data() + cell + 4);
    }
  }
  constexpr double attenuation = 1.5;
  Shadows shadows(arrays, attenuation, GetParam());
  for (int i = 0; i < 12; ++i)
  {
    const glm::dvec3 direction = FibonacciDirection(i, 12);
    const double steepest =
      std::min({ std::abs(direction.x), std::abs(direction.y), std::abs(direction.z) });
    const std::vector<float> result = shadows.CastParallel(direction);
    for (std::size_t v = 0; v < result.size(); ++v)
    {
      if (result[v] < 0.0f)
      {
        continue; // a vertex in the hole
      }
      const glm::dvec3 place = shadows.PlaceOf(static_cast<std::int32_t>(v));
      const glm::dvec3 toLow = (low - place) / direction;
      const glm::dvec3 toHigh = (high - place) / direction;
      const glm::dvec3 near = glm::min(toLow, toHigh);
      const glm::dvec3 far = glm::max(toLow, toHigh);
      const double enters = std::max({ near.x, near.y, near.z, 0.0 });
      const double hole = std::max(std::min({ far.x, far.y, far.z }) - enters, 0.0);
      // The hole has two more borders that displace the length.
      ASSERT_NEAR(result[v], std::exp(-attenuation * (LengthInCube(place, direction) - hole)),
        3.0 / steepest * ErrorOf(attenuation, 0.125))
        << "vertex " << v << ", direction " << i;
    }
  }
}

TEST_P(VertexShadowsTest, OneCellAndNoOpacity)
{
  Shadows one(test::SingleTetrahedron(), 3.0, GetParam());
  for (const float transmittance : one.CastParallel({ -1, -1, -1 }))
  {
    EXPECT_GT(transmittance, 0.1f);
    EXPECT_LE(transmittance, 1.0f);
  }
  Shadows clear(test::KuhnGrid(2), 0.0, GetParam());
  for (const float transmittance : clear.CastParallel({ 1, 2, 3 }))
  {
    EXPECT_EQ(transmittance, 1.0f);
  }
}

TEST_P(VertexShadowsTest, OpaqueMediumIsDark)
{
  Shadows shadows(test::KuhnGrid(3), 1.0e+6, GetParam());
  const std::vector<float> result = shadows.CastParallel({ 0, 0, 1 });
  for (std::size_t v = 0; v < result.size(); ++v)
  {
    if (shadows.PlaceOf(static_cast<std::int32_t>(v)).z < 0.9)
    {
      EXPECT_LE(result[v], OpaqueShadow) << v;
    }
  }
}

TEST_P(VertexShadowsTest, InactiveCellsCastNoShadow)
{
  Shadows shadows(test::KuhnGrid(4), 1.0, GetParam());
  // Cells above 1/2 are left out.
  std::vector<std::uint8_t> active;
  for (const TetrahedralMesh::Cell& cell : shadows.Mesh.GetCells())
  {
    double sum = 0.0;
    for (const std::int32_t vertex : cell.Vertices)
    {
      sum += 0.25 * shadows.PlaceOf(vertex).z;
    }
    active.push_back(sum < 0.5 ? 1 : 0);
  }
  shadows.Mesh.SetActiveCells(active, 0);
  const std::vector<float> result = shadows.CastParallel({ 0, 0, 1 });
  for (std::size_t v = 0; v < result.size(); ++v)
  {
    const double z = shadows.PlaceOf(static_cast<std::int32_t>(v)).z;
    if (z > 0.6)
    {
      EXPECT_EQ(result[v], -1.0f) << "a vertex without active cells is not needed";
      continue;
    }
    ASSERT_NEAR(result[v], std::exp(z - 0.5), ErrorOf(1.0, 0.25)) << z;
  }
}

TEST_P(VertexShadowsTest, TangledMeshLosesNoLine)
{
  test::MeshArrays arrays = test::KuhnGrid(5);
  test::Jitter(arrays, 0.25, 7);
  Shadows shadows(arrays, 1.0, GetParam());
  for (int i = 0; i < 8; ++i)
  {
    for (const float transmittance : shadows.CastParallel(FibonacciDirection(i, 8)))
    {
      ASSERT_GT(transmittance, 0.0f);
      ASSERT_LE(transmittance, 1.0f);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
  Sets, VertexShadowsTest, ::testing::ValuesIn(GetInstructionSets()), test::TestNameOf);

TEST(VertexShadows, FibonacciDirectionsCoverTheSphere)
{
  glm::dvec3 mean(0.0);
  for (int i = 0; i < 32; ++i)
  {
    const glm::dvec3 direction = FibonacciDirection(i, 32);
    EXPECT_NEAR(glm::length(direction), 1.0, 1e-14);
    mean += direction / 32.0;
  }
  EXPECT_LT(glm::length(mean), 0.02);
}

}
