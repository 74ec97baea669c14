// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
// Terms of the edges that make n^2 quadratic in the cells.
#include "GradedScene.h"
#include "TestBasics.h"

using namespace meniscus;
using namespace meniscus::test;

namespace
{

/** Calls body(term, first point, second point) for all edges of all cells. */
template <typename Body>
void ForEachEdge(const GradedScene& scene, Body&& body)
{
  const double radius = scene.Mesh.GetRadius();
  for (std::size_t c = 0; c < scene.Terms.size(); ++c)
  {
    const auto& vertices = scene.Mesh.GetCells()[c].Vertices;
    std::size_t edge = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      for (std::size_t k = i + 1; k < 4; ++k)
      {
        body(static_cast<double>(scene.Terms[c][edge++]),
          scene.Mesh.GetCenter() + radius * scene.Mesh.GetPosition(vertices[i]),
          scene.Mesh.GetCenter() + radius * scene.Mesh.GetPosition(vertices[k]));
      }
    }
  }
}

MeshArrays JitteredGrid(int n)
{
  MeshArrays arrays = KuhnGrid(n);
  Jitter(arrays, 0.15 / n, 7);
  return arrays;
}

}

// Along an edge e, f = linear + t (1 - t) term: the second derivative is -2 term = e H e.
TEST(QuadraticIndex, QuadraticFieldsAreExact)
{
  const GradedScene scene(JitteredGrid(6),
    [](const glm::dvec3& p) { return 2.0 + p.x - 0.5 * p.y * p.y + 0.3 * p.x * p.z; });
  ForEachEdge(scene,
    [](double term, const glm::dvec3& a, const glm::dvec3& b)
    {
      const glm::dvec3 e = b - a;
      EXPECT_NEAR(term, 0.5 * e.y * e.y - 0.3 * e.x * e.z, 1.0e-7);
    });
}

TEST(QuadraticIndex, TermsOfSmoothFieldsAreOfThirdOrder)
{
  double errors[2];
  for (int k = 0; k < 2; ++k)
  {
    const GradedScene scene(JitteredGrid(k == 0 ? 8 : 16),
      [](const glm::dvec3& p) { return 2.0 + std::exp(p.x) * std::sin(2.0 * p.y); });
    double sum = 0.0;
    std::int64_t count = 0;
    ForEachEdge(scene,
      [&](double term, const glm::dvec3& a, const glm::dvec3& b)
      {
        const glm::dvec3 m = 0.5 * (a + b);
        const glm::dvec3 e = b - a;
        const double sine = std::exp(m.x) * std::sin(2.0 * m.y);
        const double cosine = std::exp(m.x) * std::cos(2.0 * m.y);
        const double second = sine * e.x * e.x + 4.0 * cosine * e.x * e.y - 4.0 * sine * e.y * e.y;
        sum += (term + 0.5 * second) * (term + 0.5 * second);
        ++count;
      });
    errors[k] = std::sqrt(sum / static_cast<double>(count));
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 2.8) << errors[0] << " " << errors[1];
}

TEST(QuadraticIndex, LinearFieldsStayLinear)
{
  const GradedScene scene(
    JitteredGrid(5), [](const glm::dvec3& p) { return 2.0 + 0.3 * p.x - 0.2 * p.y + 0.1 * p.z; });
  // Positions of the mesh are rounded.
  ForEachEdge(scene,
    [](double term, const glm::dvec3&, const glm::dvec3&) { EXPECT_NEAR(term, 0.0, 1.0e-8); });
}

// A jump between two layers of vertices: n^2 is nearly linear there and overshoots by a quarter of
// a term at most.
TEST(QuadraticIndex, JumpsAreHardlyOvershot)
{
  const GradedScene scene(
    CenteredGrid(9, 1.0), [](const glm::dvec3& p) { return p.x > 0.0 ? 2.0 : 1.0; });
  ForEachEdge(scene,
    [](double term, const glm::dvec3&, const glm::dvec3&) { EXPECT_LT(std::abs(term), 0.125); });
}

// However rough the field is, n^2 is at least half the linear one.
TEST(QuadraticIndex, SquareStaysPositive)
{
  const GradedScene scene(JitteredGrid(6),
    [](const glm::dvec3& p)
    { return 0.02 + std::pow(std::sin(40.0 * p.x) * std::sin(43.0 * p.y + p.z), 2.0); });
  bool isLimited = false;
  for (std::size_t c = 0; c < scene.Terms.size(); ++c)
  {
    const auto& vertices = scene.Mesh.GetCells()[c].Vertices;
    double terms = 0.0;
    std::size_t edge = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      for (std::size_t k = i + 1; k < 4; ++k)
      {
        const double least = std::min(scene.Squares[static_cast<std::size_t>(vertices[i])],
          scene.Squares[static_cast<std::size_t>(vertices[k])]);
        const auto term = static_cast<double>(scene.Terms[c][edge++]);
        EXPECT_GE(term, -least * (1.0 + 1.0e-6));
        isLimited |= term < -0.99 * least;
        terms += term;
      }
    }
  }
  EXPECT_TRUE(isLimited);
}

// Too few vertices for a fit, or all in a plane or at one place: linear.
TEST(QuadraticIndex, FewVerticesAreLinear)
{
  const auto field = [](const glm::dvec3& p) { return 1.0 + glm::dot(p, p); };
  const MeshArrays flat =
    Moved(KuhnGrid(3), [](const glm::dvec3& p) { return glm::dvec3(p.x, p.y, 0.5); });
  const MeshArrays point = Moved(KuhnGrid(2), [](const glm::dvec3&) { return glm::dvec3(0.25); });
  for (const MeshArrays& arrays : { SingleTetrahedron(), flat, point, MeshArrays{ {}, {} } })
  {
    const GradedScene scene(arrays, field);
    ForEachEdge(
      scene, [](double term, const glm::dvec3&, const glm::dvec3&) { EXPECT_EQ(term, 0.0); });
  }
}
