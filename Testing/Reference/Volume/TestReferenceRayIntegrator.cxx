// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceRayIntegrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace meniscus::reference;

namespace
{

using Rgba = std::array<double, 4>;
using Nodes = std::vector<TransferFunctionNode>;
using Field = std::function<double(double, double, double)>;

constexpr double Pi = 3.14159265358979323846;

struct Mesh
{
  std::vector<double> Points;
  std::vector<std::int64_t> Cells;
  std::vector<double> Scalars;

  ReferenceRayIntegrator GetIntegrator() const
  {
    return ReferenceRayIntegrator(this->Points, this->Cells, this->Scalars);
  }
};

// Appends the box [low, high]^3 of n^3 cubes, each split in six tetrahedra around its diagonal.
void AppendBox(Mesh& mesh, double low, double high, int n, const Field& field)
{
  const auto base = static_cast<std::int64_t>(mesh.Points.size() / 3);
  const auto at = [&](int i) { return low + (high - low) * i / n; };
  const auto id = [&](int i, int j, int k)
  {
    return base + i + static_cast<std::int64_t>(n + 1) * (j + static_cast<std::int64_t>(n + 1) * k);
  };
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        mesh.Points.insert(mesh.Points.end(), { at(i), at(j), at(k) });
        mesh.Scalars.push_back(field(at(i), at(j), at(k)));
      }
    }
  }
  const int paths[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
    { 2, 1, 0 } };
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    for (const auto& path : paths)
    {
      int corner[3] = { cube % n, cube / n % n, cube / (n * n) };
      mesh.Cells.push_back(id(corner[0], corner[1], corner[2]));
      for (const int axis : path)
      {
        ++corner[axis];
        mesh.Cells.push_back(id(corner[0], corner[1], corner[2]));
      }
    }
  }
}

ReferenceTransferFunction ConstantOptics(double attenuation, double red = 1.0)
{
  return ReferenceTransferFunction(Nodes{ { 0.0, { attenuation, { red, 0.5, 0.0 } } } });
}

Ray AlongZ(double x, double y, double begin = 0.0, double end = 100.0)
{
  return Ray{ { x, y, -10.0 }, { 0.0, 0.0, 1.0 }, begin, end };
}

// Independent quadrature: fine Simpson steps in long double over a closed-form field along the ray.
Rgba BruteForce(const std::function<OpticalSample(double)>& optics, double pathLength, int steps)
{
  long double color[3] = { 0, 0, 0 };
  long double depth = 0;
  const long double h = static_cast<long double>(pathLength) / steps;
  for (int i = 0; i < steps; ++i)
  {
    const OpticalSample a = optics(static_cast<double>(i * h));
    const OpticalSample m = optics(static_cast<double>((i + 0.5L) * h));
    const OpticalSample b = optics(static_cast<double>((i + 1) * h));
    const long double half = h / 24 *
      (5 * static_cast<long double>(a.Attenuation) + 8 * static_cast<long double>(m.Attenuation) -
        b.Attenuation);
    const long double full =
      h / 6 * (static_cast<long double>(a.Attenuation) + 4 * m.Attenuation + b.Attenuation);
    for (int c = 0; c < 3; ++c)
    {
      color[c] += h / 6 *
        (a.Attenuation * a.Color[c] * std::exp(-depth) +
          4 * m.Attenuation * m.Color[c] * std::exp(-depth - half) +
          b.Attenuation * b.Color[c] * std::exp(-depth - full));
    }
    depth += full;
  }
  return { static_cast<double>(color[0]), static_cast<double>(color[1]),
    static_cast<double>(color[2]), static_cast<double>(1 - std::exp(-depth)) };
}

void ExpectNear(const Rgba& a, const Rgba& b, double tolerance)
{
  for (int c = 0; c < 4; ++c)
  {
    EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
  }
}

// Target of the quadrature, see ReferenceRayIntegrator.cxx.
constexpr double Target = 1e-10;

// Half-spaces are widened by 1e-13 of the diagonal (below 6 here) at both ends of a ray, and
// optical depth changes alpha by at most its own change; includes a factor of 5.
constexpr double Widening = 5e-12;

} // anonymous namespace

TEST(ReferenceRayIntegrator, ConstantFieldGivesBeerLambert)
{
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 4, [](double, double, double) { return 0.0; });
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  for (const double attenuation : { 1e-6, 0.1, 1.0, 7.0, 500.0 })
  {
    const double alpha = -std::expm1(-2.0 * attenuation);
    ExpectNear(integrator.Trace(AlongZ(0.13, 0.21), ConstantOptics(attenuation, 0.8)),
      { 0.8 * alpha, 0.5 * alpha, 0.0, alpha }, 1e-13);
  }
}

TEST(ReferenceRayIntegrator, LengthIsWorldLengthForAnyDirectionLength)
{
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 3, [](double, double, double) { return 0.0; });
  const Ray ray{ { -4.0, 0.1, -4.0 }, { 0.25, 0.0, 0.25 }, 0.0, 1e3 };
  const double alpha = -std::expm1(-0.3 * 2.0 * std::sqrt(2.0));
  EXPECT_NEAR(mesh.GetIntegrator().Trace(ray, ConstantOptics(0.3))[3], alpha, Widening);
}

TEST(ReferenceRayIntegrator, LinearFieldMatchesErrorFunction)
{
  // tau(z) = k (z + 1) on [-1, 1], colour linear from 0 to 1: C = integral of k u (u/2) exp(-k
  // u^2/2)
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 5, [](double, double, double z) { return z; });
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  for (const double k : { 0.01, 0.5, 3.0, 40.0 })
  {
    const ReferenceTransferFunction function(
      Nodes{ { -1.0, { 0.0, { 0.0, 1.0, 0.0 } } }, { 1.0, { 2.0 * k, { 1.0, 1.0, 0.0 } } } });
    const double gauss = std::sqrt(Pi / (2.0 * k)) * std::erf(2.0 * std::sqrt(k / 2.0));
    const double red = 0.5 * (gauss - 2.0 * std::exp(-2.0 * k));
    const double alpha = -std::expm1(-2.0 * k);
    ExpectNear(integrator.Trace(AlongZ(-0.3, 0.4), function), { red, alpha, 0.0, alpha }, Target);
  }
}

TEST(ReferenceRayIntegrator, SplitsAtTransferFunctionNodes)
{
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 2, [](double x, double, double z) { return z + 0.5 * x; });
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  std::mt19937 random(20261121);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<TransferFunctionNode> nodes;
  for (int i = 0; i <= 32; ++i)
  {
    nodes.push_back({ -1.0 + i / 16.0,
      { 20.0 * uniform(random) * (i % 4 == 0 && i % 32 != 0),
        { uniform(random), uniform(random), 0.2 } } });
  }
  const ReferenceTransferFunction function(nodes, ReferenceTransferFunction::Outside::Zero);
  // The field is linear along the ray: 65536 steps put the nodes on step ends for x = 0.5.
  const Rgba truth =
    BruteForce([&](double u) { return function.GetValue(std::min(u - 0.75, 1.25)); }, 2.0, 65536);
  ExpectNear(integrator.Trace(AlongZ(0.5, 0.3), function), truth, 1e-9);
  // On the reverse ray the nodes are met in the opposite order.
  const Ray backwards{ { 0.5, 0.3, 10.0 }, { 0.0, 0.0, -1.0 }, 0.0, 100.0 };
  const Rgba mirrored =
    BruteForce([&](double u) { return function.GetValue(1.25 - u); }, 2.0, 65536);
  ExpectNear(integrator.Trace(backwards, function), mirrored, 1e-9);
}

TEST(ReferenceRayIntegrator, JumpOfTheTransferFunctionIsExact)
{
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 3, [](double, double, double z) { return z; });
  const ReferenceTransferFunction function(
    Nodes{ { -1.0, { 0.0, { 0, 0, 0 } } }, { 0.25, { 0.0, { 0, 0, 0 } } },
      { 0.25, { 2.0, { 1, 1, 1 } } }, { 1.0, { 2.0, { 1, 1, 1 } } } });
  const double alpha = -std::expm1(-2.0 * 0.75);
  ExpectNear(mesh.GetIntegrator().Trace(AlongZ(0.1, 0.2), function), { alpha, alpha, alpha, alpha },
    Widening);
}

TEST(ReferenceRayIntegrator, RayThroughVerticesEdgesAndFaces)
{
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 4, [](double, double, double z) { return z; });
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  const ReferenceTransferFunction function(
    Nodes{ { -1.0, { 0.2, { 0.1, 0.2, 0.3 } } }, { 1.0, { 1.4, { 0.9, 0.3, 0.1 } } } });
  const Rgba truth = integrator.Trace(AlongZ(0.0312, -0.0177), function);
  for (const auto& at : std::vector<std::array<double, 2>>{
         { 0.0, 0.0 }, { 0.5, 0.0 }, { 0.5, 0.1 }, { 0.1, 0.1 }, { 0.25, -0.25 }, { -0.5, 0.5 } })
  {
    std::vector<RaySegment> segments;
    const RayReport report = integrator.FindSegments(AlongZ(at[0], at[1]), segments);
    EXPECT_EQ(report.Gaps, 0u);
    ExpectNear(integrator.Trace(AlongZ(at[0], at[1]), function), truth, Widening);
  }
}

TEST(ReferenceRayIntegrator, OverlappingCellsFollowTheRunningMaximum)
{
  // Boxes [-1, 1] (scalar 0) and [0, 2] (scalar 1) along z: the first one is used up to its exit.
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 1, [](double, double, double) { return 0.0; });
  AppendBox(mesh, 0.0, 2.0, 1, [](double, double, double) { return 1.0; });
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  const ReferenceTransferFunction function(
    Nodes{ { 0.0, { 0.4, { 1, 0, 0 } } }, { 1.0, { 0.8, { 0, 1, 0 } } } });
  std::vector<RaySegment> segments;
  const Ray ray = AlongZ(0.61, 0.37);
  const RayReport report = integrator.FindSegments(ray, segments);
  EXPECT_GT(report.Overlaps, 0u);
  EXPECT_EQ(report.Gaps, 0u);
  // Each box has its own cells: the overlap [0, 1] belongs to the cell that was entered first at
  // each exit, so only the lengths in the two media, here from the cells, are known in general.
  double lengths[2] = { 0.0, 0.0 };
  double cursor = segments.front().Begin;
  for (const RaySegment& segment : segments)
  {
    EXPECT_NEAR(segment.Begin, cursor, Widening);
    cursor = segment.End;
    lengths[segment.Cell >= 6] += segment.End - segment.Begin;
  }
  EXPECT_NEAR(lengths[0] + lengths[1], 3.0, Widening);
  EXPECT_NEAR(integrator.Trace(ray, function)[3], -std::expm1(-0.4 * lengths[0] - 0.8 * lengths[1]),
    Widening);
}

TEST(ReferenceRayIntegrator, TwoOverlappingCellsExactly)
{
  // Two cells with one vertex each on the axis: intervals [0, 1] and [0.25, 2] along z.
  const Mesh mesh{ { -1, -1, 0, 3, -1, 0, -1, 3, 0, 0, 0, 1, //
                     -1, -1, 0.25, 3, -1, 0.25, -1, 3, 0.25, 0, 0, 2 },
    { 0, 1, 2, 3, 4, 5, 6, 7 }, { 0, 0, 0, 0, 1, 1, 1, 1 } };
  const ReferenceTransferFunction function(
    Nodes{ { 0.0, { 1.0, { 1, 0, 0 } } }, { 1.0, { 2.0, { 0, 1, 0 } } } });
  const double first = -std::expm1(-1.0);
  const double second = std::exp(-1.0) * -std::expm1(-2.0);
  ExpectNear(mesh.GetIntegrator().Trace(AlongZ(0.0, 0.0), function),
    { first, second, 0.0, first + second }, Widening);
}

TEST(ReferenceRayIntegrator, FoldOutwardCountsNowhere)
{
  // The vertex below the shared face is moved above it: the path enters the inverted cell at its
  // far end, 0.5, so only the part of the other cell beyond that is used.
  const Mesh mesh{ { -1, -1, 0, 3, -1, 0, -1, 3, 0, 0, 0, 1, 0, 0, 0.5 },
    { 0, 1, 2, 3, 0, 1, 2, 4 }, { 1, 1, 1, 1, 1 } };
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  EXPECT_EQ(integrator.MakeMesh().NumberOfInvertedCells(), 1u);
  EXPECT_NEAR(
    integrator.Trace(AlongZ(0.0, 0.0), ConstantOptics(1.0))[3], -std::expm1(-0.5), Widening);
}

TEST(ReferenceRayIntegrator, FoldInsideFollowsThePathAcrossFaces)
{
  // A column of three cells along z over one triangle; the vertex ring between the second and the
  // third is folded below that between the first and the second: [0, 2], back to 1, on to 4.
  const Mesh mesh{ { -1, -1, 0, 3, -1, 0, -1, 3, 0, -1, -1, 2, 3, -1, 2, -1, 3, 2, -1, -1, 1, 3, -1,
                     1, -1, 3, 1, -1, -1, 4, 3, -1, 4, -1, 3, 4 },
    { 0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5, 3, 4, 5, 6, 4, 5, 6, 7, 5, 6, 7, 8, 6, 7, 8, 9, 7, 8, 9,
      10, 8, 9, 10, 11 },
    { 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1 } };
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  EXPECT_EQ(integrator.MakeMesh().NumberOfInvertedCells(), 3u);
  // Attenuation 1 on [0, 2] where the scalar is 0, and 3 on [2, 4] where it is 1.
  const ReferenceTransferFunction function(
    Nodes{ { 0.0, { 1.0, { 1, 0, 0 } } }, { 1.0, { 3.0, { 0, 1, 0 } } } });
  const double first = -std::expm1(-2.0);
  const double second = std::exp(-2.0) * -std::expm1(-6.0);
  std::vector<RaySegment> segments;
  EXPECT_TRUE(integrator.FindSegments(AlongZ(0.11, 0.07), segments).Ordered);
  ExpectNear(integrator.Trace(AlongZ(0.11, 0.07), function), { first, second, 0.0, first + second },
    Widening);
}

TEST(ReferenceRayIntegrator, GapAndReentry)
{
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 2, [](double, double, double) { return 0.0; });
  AppendBox(mesh, 1.0, 1.5, 2, [](double, double, double) { return 0.0; });
  mesh.Points[2] = -1.0;
  // Move the second box over the first, with air between them.
  for (std::size_t i = 3 * 27; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] -= 1.25;
    mesh.Points[i + 1] -= 1.25;
    mesh.Points[i + 2] += 3.0;
  }
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  std::vector<RaySegment> segments;
  const RayReport report = integrator.FindSegments(AlongZ(0.05, 0.1), segments);
  EXPECT_EQ(report.Gaps, 1u);
  EXPECT_EQ(integrator.CoveredSpans(AlongZ(0.05, 0.1)).size(), 2u);
  EXPECT_NEAR(
    integrator.Trace(AlongZ(0.05, 0.1), ConstantOptics(0.7))[3], -std::expm1(-0.7 * 2.5), Widening);
  EXPECT_NEAR(
    integrator.Trace(AlongZ(0.6, 0.7), ConstantOptics(0.7))[3], -std::expm1(-0.7 * 2.0), Widening);
}

TEST(ReferenceRayIntegrator, RayEndsAreRespected)
{
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 3, [](double, double, double z) { return z; });
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  // Inside from z = -0.5 to z = 0.75 (origin at z = -10).
  const Rgba inside = integrator.Trace(AlongZ(0.2, 0.3, 9.5, 10.75), ConstantOptics(0.9));
  EXPECT_NEAR(inside[3], -std::expm1(-0.9 * 1.25), Widening);
  ExpectNear(integrator.Trace(AlongZ(0.2, 0.3, 0.0, 8.9), ConstantOptics(0.9)), Rgba{}, 0.0);
}

TEST(ReferenceRayIntegrator, EmptyMeshAndEmptyFunction)
{
  const Mesh empty;
  ExpectNear(empty.GetIntegrator().Trace(AlongZ(0.0, 0.0), ConstantOptics(1.0)), Rgba{}, 0.0);
  EXPECT_EQ(
    empty.GetIntegrator().Classify(AlongZ(0.0, 0.0), 1e-6, ConstantOptics(1.0)), RayClass::Missed);
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 1, [](double, double, double) { return 0.0; });
  ExpectNear(
    mesh.GetIntegrator().Trace(AlongZ(0.1, 0.2), ReferenceTransferFunction()), Rgba{}, 0.0);
}

TEST(ReferenceRayIntegrator, FarFromTheOrigin)
{
  Mesh mesh;
  AppendBox(mesh, 1e6, 1e6 + 2.0, 4, [](double, double, double z) { return z - 1e6; });
  const Ray ray{ { 1e6 + 0.7, 1e6 + 1.1, 1e6 - 5.0 }, { 0, 0, 1 }, 0.0, 100.0 };
  const ReferenceTransferFunction function(
    Nodes{ { 0.0, { 0.0, { 1, 1, 1 } } }, { 2.0, { 1.0, { 1, 1, 1 } } } });
  EXPECT_NEAR(mesh.GetIntegrator().Trace(ray, function)[3], -std::expm1(-1.0), 1e-9);
}

TEST(ReferenceRayIntegrator, ClassifiesSilhouettes)
{
  Mesh mesh;
  AppendBox(mesh, -1.0, 1.0, 4, [](double, double, double) { return 0.0; });
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  const double distance = integrator.SilhouetteDistance();
  EXPECT_EQ(
    integrator.Classify(AlongZ(0.1, 0.2), distance, ConstantOptics(1.0)), RayClass::Covered);
  EXPECT_EQ(
    integrator.Classify(AlongZ(0.5, 0.5), distance, ConstantOptics(1.0)), RayClass::Covered);
  EXPECT_EQ(integrator.Classify(AlongZ(1.0 - 10.0 * distance, 0.2), distance, ConstantOptics(1.0)),
    RayClass::Covered);
  EXPECT_EQ(integrator.Classify(AlongZ(1.0 - 0.5 * distance, 0.2), distance, ConstantOptics(1.0)),
    RayClass::Silhouette);
  EXPECT_EQ(integrator.Classify(AlongZ(1.0 + 0.5 * distance, 0.2), distance, ConstantOptics(1.0)),
    RayClass::Silhouette);
  EXPECT_EQ(
    integrator.Classify(AlongZ(1.0, 1.0), distance, ConstantOptics(1.0)), RayClass::Silhouette);
  EXPECT_EQ(integrator.Classify(AlongZ(1.0 + 10.0 * distance, 0.2), distance, ConstantOptics(1.0)),
    RayClass::Missed);
}

TEST(ReferenceRayIntegrator, SteepFaceIsNotASilhouette)
{
  // A ray across a face tilted by 45 degrees, well inside it: the span moves in proportion.
  const Mesh mesh{ { 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4 }, { 0, 1, 2, 3 }, { 0, 0, 0, 0 } };
  const ReferenceRayIntegrator integrator = mesh.GetIntegrator();
  EXPECT_EQ(integrator.Classify(AlongZ(1.0, 1.0), 1e-5, ConstantOptics(1.0)), RayClass::Covered);
}
