// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Gradients of the scalar at vertices and in cells.
#include "KernelMeshes.h"

#include "Simd/InstructionSets.h"
#include "TestBasics.h"
#include "Volume/Mesh/ScalarGradients.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** One value per vertex of a mesh, a function of its normalised position. */
template <typename Function>
std::vector<double> Evaluate(const TetrahedralMesh& mesh, const Function& field)
{
  std::vector<double> values;
  for (std::int64_t v = 0; v < mesh.GetNumberOfVertices(); ++v)
  {
    values.push_back(field(mesh.GetPosition(v)));
  }
  return values;
}

TetrahedralMesh BuildJittered(int cubes, double amount, unsigned int seed)
{
  MeshArrays arrays = KuhnGrid(cubes);
  Jitter(arrays, amount, seed);
  TetrahedralMesh mesh;
  mesh.Build(arrays.View());
  return mesh;
}

}

TEST(VertexGradients, LinearFieldIsExact)
{
  const TetrahedralMesh mesh = BuildJittered(4, 0.05, 3);
  const glm::dvec3 slope(0.5, -1.0, 0.25);
  const auto scalars = Evaluate(mesh, [&](const glm::dvec3& p) { return glm::dot(slope, p); });
  for (const glm::vec3& gradient : ComputeVertexGradients(mesh, scalars, 1.0))
  {
    // Three components of up to 1, each rounded to 2^-25 of itself.
    EXPECT_NEAR(glm::length(glm::dvec3(gradient) - slope), 0.0, 6e-8);
  }
}

TEST(CellGradients, NearlyEqualScalarsKeepTheDirection)
{
  // Changes of 1e-12 at a scalar of 1: normalised floats would all be equal.
  const TetrahedralMesh mesh = BuildJittered(4, 0.05, 3);
  const glm::dvec3 slope(0.5, -1.0, 0.25);
  constexpr double change = 1.0e-12;
  const auto scalars =
    Evaluate(mesh, [&](const glm::dvec3& p) { return 1.0 + change * glm::dot(slope, p); });
  const auto gradients = ComputeCellGradients(mesh, scalars, 1.0 / change);
  ASSERT_EQ(static_cast<std::int64_t>(gradients.size()), mesh.GetNumberOfCells());
  for (const glm::vec3& gradient : gradients)
  {
    // Scalars are rounded to 2^-53, 1.1e-4 of the change; cells are about 0.2 wide.
    EXPECT_NEAR(glm::length(glm::dvec3(gradient) - slope), 0.0, 5e-3);
  }
}

TEST(CellGradients, EqualScalarsHaveNone)
{
  const TetrahedralMesh mesh = BuildJittered(3, 0.05, 5);
  const auto scalars = Evaluate(mesh, [](const glm::dvec3&) { return 0.1; });
  for (const glm::vec3& gradient : ComputeCellGradients(mesh, scalars, 1.0))
  {
    EXPECT_EQ(gradient, glm::vec3(0.0f));
  }
  for (const glm::vec3& gradient : ComputeVertexGradients(mesh, scalars, 1.0))
  {
    EXPECT_EQ(gradient, glm::vec3(0.0f));
  }
}

TEST(CellGradients, FarScalarsHaveFiniteSquares)
{
  const MeshArrays arrays{ { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, { 0, 1, 2, 3 } };
  TetrahedralMesh mesh;
  mesh.Build(arrays.View());
  const double largest = std::numeric_limits<double>::max();
  for (const double fill : { 1.0e36, 1.0e300, largest })
  {
    for (const double other : { 0.0, -fill })
    {
      std::vector<double> scalars(4, other);
      scalars[1] = fill;
      const glm::vec3 gradient = ComputeCellGradients(mesh, scalars, 1.0)[0];
      const float square = glm::dot(gradient, gradient);
      EXPECT_TRUE(std::isfinite(square)) << fill;
      EXPECT_GT(square, 1.0e35f) << fill;
    }
  }
}

TEST(CellGradients, CellsWithoutVolumeOrScalarHaveNone)
{
  const MeshArrays arrays{ { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1 },
    { 0, 1, 2, 3, 0, 1, 2, 4 } };
  TetrahedralMesh mesh;
  mesh.Build(arrays.View());
  for (const double scalar :
    { 1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    std::vector<double> scalars = Evaluate(mesh, [](const glm::dvec3& p) { return p.x; });
    for (std::size_t v = 0; v < scalars.size(); ++v)
    {
      scalars[v] = mesh.GetSourcePoints()[v] == 4 ? scalar : scalars[v];
    }
    for (std::size_t c = 0; c < 2; ++c)
    {
      const auto& vertices = mesh.GetCells()[c].Vertices;
      const bool flat = std::none_of(vertices.begin(), vertices.end(),
        [&mesh](std::int32_t v) { return mesh.GetSourcePoints()[v] == 4; });
      const bool none = flat || !std::isfinite(scalar);
      EXPECT_EQ(ComputeCellGradients(mesh, scalars, 1.0)[c] == glm::vec3(0.0f), none) << scalar;
    }
  }
}

TEST(VertexGradients, MeansAreWeightedByVolume)
{
  // Two tetrahedra on both sides of the face 0, 1, 2; the second is three times as high.
  const MeshArrays arrays{ { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -3 },
    { 0, 1, 2, 3, 0, 1, 2, 4 } };
  TetrahedralMesh mesh;
  mesh.Build(arrays.View());
  // The scalar |z|: gradients +1 and -1 along z.
  const auto scalars = Evaluate(mesh,
    [&](const glm::dvec3& p)
    { return std::abs(p.z * mesh.GetRadius() + mesh.GetCenter().z) / mesh.GetRadius(); });
  const auto gradients = ComputeVertexGradients(mesh, scalars, 1.0);
  for (std::size_t v = 0; v < gradients.size(); ++v)
  {
    const std::int64_t point = mesh.GetSourcePoints()[v];
    const double expected = point == 3 ? 1.0 : (point == 4 ? -1.0 : (1.0 - 3.0) / 4.0);
    EXPECT_NEAR(gradients[v].z, expected, 1e-6) << point;
    EXPECT_NEAR(gradients[v].x, 0.0, 1e-6) << point;
  }
}

TEST(VertexGradients, DoNotDependOnTheLoop)
{
  const TetrahedralMesh mesh = BuildJittered(30, 0.005, 7); // 162,000 cells, more than one chunk
  const auto scalars =
    Evaluate(mesh, [](const glm::dvec3& p) { return std::sin(3.0 * p.x) * p.y + p.z * p.z; });
  const auto backwards = [](std::size_t count, const RangeBody& body)
  {
    for (std::size_t i = count; i > 0; --i)
    {
      body(i - 1, i);
    }
  };
  EXPECT_EQ(ComputeVertexGradients(mesh, scalars, 1.0),
    ComputeVertexGradients(mesh, scalars, 1.0, backwards));
  EXPECT_EQ(
    ComputeCellGradients(mesh, scalars, 1.0), ComputeCellGradients(mesh, scalars, 1.0, backwards));
}

TEST(VertexGradients, AreTheSameWithAllInstructionSets)
{
  const TetrahedralMesh mesh = BuildJittered(7, 0.05, 7);
  auto scalars = Evaluate(mesh, [](const glm::dvec3& p) { return std::sin(3.0 * p.x) * p.y; });
  scalars[17] = std::numeric_limits<double>::quiet_NaN();
  constexpr const char* variable = "MENISCUS_INSTRUCTION_SET";
  std::vector<std::vector<glm::vec3>> ofSets[2];
  for (const InstructionSet set : GetInstructionSets())
  {
    setenv(variable, NameOf(set), 1);
    ofSets[0].push_back(ComputeVertexGradients(mesh, scalars, 1.0));
    ofSets[1].push_back(ComputeCellGradients(mesh, scalars, 1.0));
  }
  unsetenv(variable);
  for (const auto& gradients : ofSets)
  {
    EXPECT_GT(glm::length(gradients.front().back()), 0.0f);
    for (const auto& others : gradients)
    {
      EXPECT_EQ(others, gradients.front());
    }
  }
}

TEST(VertexGradients, CellsWithoutVolumeOrScalarDoNotCount)
{
  MeshArrays arrays = KuhnGrid(2);
  const std::int64_t points = static_cast<std::int64_t>(arrays.Points.size() / 3);
  arrays.Points.insert(arrays.Points.end(), { 3.0, 0.0, 0.0 });
  // A flat cell on the line of x, and the only one of the new point.
  arrays.Cells.insert(arrays.Cells.end(), { 0, 1, 2, points });
  TetrahedralMesh mesh;
  mesh.Build(arrays.View());
  auto scalars = Evaluate(mesh, [](const glm::dvec3& p) { return p.x; });
  std::size_t lonely = 0;
  std::size_t broken = 0;
  for (std::size_t v = 0; v < scalars.size(); ++v)
  {
    lonely = mesh.GetSourcePoints()[v] == points ? v : lonely;
    broken = mesh.GetSourcePoints()[v] == points - 1 ? v : broken;
  }
  scalars[broken] = std::numeric_limits<double>::quiet_NaN();
  const auto gradients = ComputeVertexGradients(mesh, scalars, 1.0);
  EXPECT_EQ(gradients[lonely], glm::vec3(0.0f));
  for (std::size_t v = 0; v < gradients.size(); ++v)
  {
    EXPECT_TRUE(std::isfinite(gradients[v].x)) << v;
    EXPECT_TRUE(v == lonely || v == broken || std::abs(gradients[v].x - 1.0f) < 1e-5f ||
      gradients[v] == glm::vec3(0.0f))
      << v << ": " << gradients[v].x;
  }
}
